//! Lines of a GPIO chip, by the kernel's character device.

use std::io;

use afp_core::Instant;
use afp_drive::parts::{Quadrature, Ranger, Switch};
use gpiocdev::Request;
use gpiocdev::line::{Bias, EdgeDetection, EdgeEvent, EdgeKind, Value};
use gpiocdev_embedded_hal::{InputPin, OutputPin};

use crate::guard::EnableLine;

/// Edges that the kernel keeps between two steps: enough for 70 turns a second at 1440 ticks.
const KEPT: u32 = 1024;
/// Edges of one read.
const CHUNK: usize = 64;

/// Names the line of an error.
fn at(chip: &str, line: u32) -> impl Fn(gpiocdev::Error) -> io::Error {
    move |error| io::Error::other(format!("line {line} of '{chip}': {error}"))
}

/// An output, low.
pub(super) fn output(chip: &str, line: u32) -> io::Result<OutputPin> {
    let request = Request::builder()
        .on_chip(chip)
        .with_consumer("afp")
        .with_line(line)
        .as_output(Value::Inactive)
        .request();
    OutputPin::try_from(request.map_err(at(chip, line))?).map_err(io::Error::other)
}

/// A switch between a line and ground.
pub(super) fn switch(chip: &str, line: u32) -> io::Result<Switch<InputPin>> {
    let request = Request::builder()
        .on_chip(chip)
        .with_consumer("afp")
        .with_line(line)
        .as_input()
        .with_bias(Bias::PullUp)
        .request();
    let pin = InputPin::try_from(request.map_err(at(chip, line))?).map_err(io::Error::other)?;
    Ok(Switch::new(pin))
}

/// Lines whose edges the kernel notes with their times.
#[derive(Debug)]
struct Edges {
    request: Request,
    buffer: Vec<u64>,
}

impl Edges {
    fn open(chip: &str, lines: &[u32], bias: Bias) -> io::Result<Edges> {
        let request = Request::builder()
            .on_chip(chip)
            .with_consumer("afp")
            .with_lines(lines)
            .as_input()
            .with_bias(bias)
            .with_edge_detection(EdgeDetection::BothEdges)
            .with_kernel_event_buffer_size(KEPT)
            .request()
            .map_err(at(chip, lines.first().copied().unwrap_or_default()))?;
        let buffer = vec![0; CHUNK * request.edge_event_u64_size()];
        Ok(Edges { request, buffer })
    }

    /// Takes the edges since the last call.
    fn each(&mut self, mut take: impl FnMut(EdgeEvent)) -> io::Result<()> {
        let size = self.request.edge_event_u64_size();
        while self.request.has_edge_event().map_err(io::Error::other)? {
            let read = self.request.read_edge_events_into_slice(&mut self.buffer);
            let read = read.map_err(io::Error::other)?;
            for event in self.buffer.get(..read).unwrap_or_default().chunks_exact(size) {
                take(self.request.edge_event_from_slice(event).map_err(io::Error::other)?);
            }
        }
        Ok(())
    }
}

/// A wheel encoder.
#[derive(Debug)]
pub(super) struct Encoder {
    edges: Edges,
    second: u32,
    wheel: Quadrature,
}

impl Encoder {
    pub(super) fn open(chip: &str, lines: [u32; 2]) -> io::Result<Encoder> {
        let edges = Edges::open(chip, &lines, Bias::PullUp)?;
        let level = |line| edges.request.value(line).map(|value| value == Value::Active);
        let levels = [level(lines[0]), level(lines[1])];
        let [a, b] = levels.map(|level| level.map_err(io::Error::other));
        Ok(Encoder { wheel: Quadrature::new([a?, b?]), edges, second: lines[1] })
    }

    pub(super) fn count(&mut self) -> io::Result<i32> {
        let Encoder { edges, second, wheel } = self;
        edges.each(|event| wheel.edge(event.offset == *second, event.kind == EdgeKind::Rising))?;
        Ok(wheel.count())
    }
}

/// A range sensor HC-SR04.
#[derive(Debug)]
pub(super) struct Sonar {
    trigger: OutputPin,
    echo: Edges,
    ranger: Ranger,
}

impl Sonar {
    pub(super) fn open(chip: &str, trigger: u32, echo: u32) -> io::Result<Sonar> {
        let trigger = output(chip, trigger)?;
        let echo = Edges::open(chip, &[echo], Bias::PullDown)?;
        Ok(Sonar { trigger, echo, ranger: Ranger::default() })
    }

    /// The ping that was completed since the last call. Sends the next one.
    pub(super) fn ping(&mut self, now: Instant) -> io::Result<Option<Option<f32>>> {
        use embedded_hal::digital::OutputPin as _;
        let (mut ping, ranger) = (None, &mut self.ranger);
        self.echo.each(|event| {
            let rises = event.kind == EdgeKind::Rising;
            ping = ranger.edge(rises, event.timestamp_ns).or(ping);
        })?;
        if self.ranger.is_due(now) {
            self.trigger.set_high().map_err(io::Error::other)?;
            // The sensor needs 10 us; a longer pulse does no harm.
            std::thread::sleep(std::time::Duration::from_micros(10));
            self.trigger.set_low().map_err(io::Error::other)?;
        }
        Ok(ping)
    }
}

/// The enable line of the motors.
#[derive(Debug)]
pub(super) struct Enable(OutputPin);

impl Enable {
    pub(super) fn open(chip: &str, line: u32) -> io::Result<Enable> {
        output(chip, line).map(Enable)
    }
}

impl EnableLine for Enable {
    fn set(&mut self, on: bool) -> io::Result<()> {
        use embedded_hal::digital::OutputPin as _;
        self.0.set_state(on.into()).map_err(io::Error::other)
    }
}
