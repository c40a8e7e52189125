//! The program for a Raspberry Pi Pico, on USB.
//!
//! Encoders and the echo wake an executor in an interrupt, so that the control step does not delay
//! their edges. The watchdog restarts a program that hangs or panics. All pins are inputs then, and
//! the resistor at the driver's enable pin keeps the motors off.
#![no_std]
#![no_main]

use core::panic::PanicInfo;
use core::sync::atomic::{AtomicI32, Ordering};

use afp_drive::parts::{Motor, Quadrature, Ranger, Switch, servo_pulse};
use afp_drive::{Controller, Inputs, Outputs, STEP};
use embassy_executor::{InterruptExecutor, Spawner};
use embassy_futures::join::{join, join3};
use embassy_futures::select::select;
use embassy_rp::clocks::RoscRng;
use embassy_rp::gpio::{Input, Level, Output, Pull};
use embassy_rp::interrupt::{self, InterruptExt, Priority};
use embassy_rp::peripherals::USB;
use embassy_rp::pwm::{self, Pwm, PwmOutput, SetDutyCycle};
use embassy_rp::usb::Driver;
use embassy_rp::watchdog::Watchdog;
use embassy_rp::{Peripherals, bind_interrupts, usb};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use embassy_sync::pipe::Pipe;
use embassy_time::{Duration, Instant, Ticker, block_for};
use embassy_usb::class::cdc_acm::{CdcAcmClass, Receiver, Sender, State};
use embassy_usb::{Builder, Config};
use firmware_drive::Board;

/// The number of steps of the motors' and of the servo's PWM.
const MOTOR: u16 = 6250;
const SERVO: u16 = 20_000;
/// The clock of the PWM over its steps: 20 kHz for a TB6612, 1 kHz for an L298N, 50 Hz for a servo.
const TB6612: u8 = 1;
const L298N: u8 = 20;
const MICROSECOND: u8 = 125;
/// The program restarts after this time without a step.
const HANGS: Duration = Duration::from_millis(50);
/// A full packet would wait for the next one at the computer.
const PACKET: usize = 63;

static EXECUTOR: InterruptExecutor = InterruptExecutor::new();
static COUNTS: [AtomicI32; 2] = [const { AtomicI32::new(0) }; 2];
/// Edges of the echo: whether it rises, and its time in nanoseconds.
static ECHO: Channel<CriticalSectionRawMutex, (bool, u64), 8> = Channel::new();
static RECEIVED: Pipe<CriticalSectionRawMutex, 512> = Pipe::new();
static SENT: Pipe<CriticalSectionRawMutex, 512> = Pipe::new();

bind_interrupts!(struct Interrupts {
    USBCTRL_IRQ => usb::InterruptHandler<USB>;
});

type Wheel = Motor<PwmOutput<'static>, Output<'static>, Output<'static>>;

struct Pico {
    motors: [Wheel; 2],
    servo: Pwm<'static>,
    trigger: Output<'static>,
    ranger: Ranger,
    bumper: Switch<Input<'static>>,
    button: Switch<Input<'static>>,
}

impl Pico {
    /// Sets up the pins, and starts to count.
    fn new(p: Peripherals) -> Option<(Pico, Driver<'static, USB>, Watchdog)> {
        let pulled = Pull::Up;
        // A wire to ground selects the slower PWM.
        let bridge = if Input::new(p.PIN_9, pulled).is_low() { L298N } else { TB6612 };
        let pwm = Pwm::new_output_ab(p.PWM_SLICE1, p.PIN_2, p.PIN_3, period(MOTOR, bridge));
        let (left, right) = pwm.split();
        let low = Level::Low;
        let motors = [
            Motor::new(left?, Output::new(p.PIN_4, low), Output::new(p.PIN_5, low)),
            Motor::new(right?, Output::new(p.PIN_6, low), Output::new(p.PIN_7, low)),
        ];
        let encoders = [
            [Input::new(p.PIN_10, pulled), Input::new(p.PIN_11, pulled)],
            [Input::new(p.PIN_12, pulled), Input::new(p.PIN_13, pulled)],
        ];
        interrupt::SWI_IRQ_0.set_priority(Priority::P2);
        let spawner = EXECUTOR.start(interrupt::SWI_IRQ_0);
        for (lines, count) in encoders.into_iter().zip(&COUNTS) {
            spawner.spawn(counts(lines, count).ok()?);
        }
        spawner.spawn(echoes(Input::new(p.PIN_17, Pull::Down)).ok()?);
        let pico = Pico {
            motors,
            servo: Pwm::new_output_b(p.PWM_SLICE7, p.PIN_15, period(SERVO, MICROSECOND)),
            trigger: Output::new(p.PIN_16, low),
            ranger: Ranger::default(),
            bumper: Switch::new(Input::new(p.PIN_18, pulled)),
            button: Switch::new(Input::new(p.PIN_19, pulled)),
        };
        // The motors stay enabled until the program ends.
        core::mem::forget(Output::new(p.PIN_8, Level::High));
        Some((pico, Driver::new(p.USB, Interrupts), Watchdog::new(p.WATCHDOG)))
    }
}

impl Board for Pico {
    fn receive(&mut self, bytes: &mut [u8]) -> usize {
        RECEIVED.try_read(bytes).unwrap_or_default()
    }

    fn read(&mut self, now: afp_types::Instant) -> Inputs {
        let mut ping = None;
        while let Ok((rises, at)) = ECHO.try_receive() {
            ping = self.ranger.edge(rises, at).or(ping);
        }
        if self.ranger.is_due(now) {
            self.trigger.set_high();
            block_for(Duration::from_micros(10));
            self.trigger.set_low();
        }
        Inputs {
            counts: COUNTS.each_ref().map(|count| count.load(Ordering::Relaxed)),
            // The pins of a microcontroller cannot fail.
            bumper: self.bumper.is_closed(now).unwrap_or_default(),
            button: self.button.is_closed(now).unwrap_or_default(),
            ping,
        }
    }

    fn apply(&mut self, outputs: &Outputs) {
        for (motor, power) in self.motors.iter_mut().zip(outputs.power) {
            let _ = motor.set(power);
        }
        let _ = self.servo.set_duty_cycle(servo_pulse(outputs.bearing));
    }

    fn send(&mut self, bytes: &[u8]) {
        put(&SENT, bytes);
    }
}

/// Writes as many bytes as fit. A pipe takes only the bytes up to the end of its memory at once.
fn put(pipe: &Pipe<CriticalSectionRawMutex, 512>, mut bytes: &[u8]) {
    while let Ok(written) = pipe.try_write(bytes) {
        bytes = bytes.get(written..).unwrap_or_default();
        if bytes.is_empty() {
            return;
        }
    }
}

/// A PWM without power.
fn period(steps: u16, divider: u8) -> pwm::Config {
    let mut config = pwm::Config::default();
    config.divider = divider.into();
    config.top = steps - 1;
    config
}

#[embassy_executor::task(pool_size = 2)]
async fn counts(lines: [Input<'static>; 2], count: &'static AtomicI32) {
    let [mut a, mut b] = lines;
    let mut wheel = Quadrature::new([a.is_high(), b.is_high()]);
    loop {
        select(a.wait_for_any_edge(), b.wait_for_any_edge()).await;
        wheel.look([a.is_high(), b.is_high()]);
        count.store(wheel.count(), Ordering::Relaxed);
    }
}

#[embassy_executor::task]
async fn echoes(mut echo: Input<'static>) {
    loop {
        echo.wait_for_any_edge().await;
        let _ = ECHO.try_send((echo.is_high(), Instant::now().as_micros() * 1000));
    }
}

#[embassy_rp::interrupt]
unsafe fn SWI_IRQ_0() {
    // Safety: only this handler calls it, and the executor enables the interrupt when it starts.
    unsafe { EXECUTOR.on_interrupt() }
}

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let p = embassy_rp::init(embassy_rp::config::Config::default());
    let Some((pico, usb, watchdog)) = Pico::new(p) else { hang() };
    join(serve(usb), drive(pico, watchdog)).await;
}

/// Makes a step every 10 ms.
async fn drive(mut pico: Pico, mut watchdog: Watchdog) {
    let mut controller = Controller::new(RoscRng.next_u32());
    watchdog.start(HANGS);
    let mut ticker = Ticker::every(Duration::from_micros(STEP.as_nanos() / 1000));
    loop {
        ticker.next().await;
        watchdog.feed(HANGS);
        let now = afp_types::Instant::from_nanos(Instant::now().as_micros() * 1000);
        firmware_drive::step(&mut controller, &mut pico, now);
    }
}

/// Is a serial port on USB.
async fn serve(driver: Driver<'_, USB>) {
    let mut config = Config::new(0x2e8a, 0x000a);
    config.manufacturer = Some("AFP");
    config.product = Some("Drive controller");
    let (mut descriptor, mut bos, mut control) = ([0; 128], [0; 16], [0; 64]);
    let mut state = State::new();
    let mut builder =
        Builder::new(driver, config, &mut descriptor, &mut bos, &mut [], &mut control);
    let (sender, receiver) = CdcAcmClass::new(&mut builder, &mut state, 64).split();
    let mut usb = builder.build();
    join3(usb.run(), receive(receiver), send(sender)).await;
}

async fn receive<'d>(mut line: Receiver<'d, Driver<'d, USB>>) {
    let mut bytes = [0; 64];
    loop {
        line.wait_connection().await;
        while let Ok(read) = line.read_packet(&mut bytes).await {
            // Bytes of a computer that sends too fast are lost.
            put(&RECEIVED, bytes.get(..read).unwrap_or_default());
        }
    }
}

async fn send<'d>(mut line: Sender<'d, Driver<'d, USB>>) {
    let mut bytes = [0; PACKET];
    loop {
        line.wait_connection().await;
        // Earlier reports do not count.
        SENT.clear();
        loop {
            let read = SENT.read(&mut bytes).await;
            if line.write_packet(bytes.get(..read).unwrap_or_default()).await.is_err() {
                break;
            }
        }
    }
}

/// Waits for the watchdog, which restarts the board.
fn hang() -> ! {
    cortex_m::interrupt::disable();
    loop {
        core::hint::spin_loop();
    }
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    hang()
}
