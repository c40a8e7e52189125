//! The program for the BBC micro:bit that QEMU emulates, on its serial port. It has the Pico's
//! instruction set. Two motors that turn as commanded are part of the program.
#![no_std]
#![no_main]

use core::panic::PanicInfo;

use afp_drive::{Controller, Inputs, Outputs, STEP, Setup};
use afp_types::{Duration, Instant};
use cortex_m_rt::entry;
use firmware_drive::Board;
use nrf51_pac::{Peripherals, TIMER0, UART0};

struct Microbit {
    uart: UART0,
    /// Bytes that have arrived since the last step.
    inbox: [u8; 256],
    length: usize,
    /// The power of the motors, and their ticks.
    power: [f32; 2],
    ticks: [f32; 2],
}

impl Microbit {
    fn new(uart: UART0) -> Microbit {
        uart.enable.write(|w| w.enable().enabled());
        // Safety: any value starts a task.
        uart.tasks_startrx.write(|w| unsafe { w.bits(1) });
        // Safety: as above.
        uart.tasks_starttx.write(|w| unsafe { w.bits(1) });
        Microbit { uart, inbox: [0; 256], length: 0, power: [0.0; 2], ticks: [0.0; 2] }
    }

    /// Takes a byte if one has arrived: the line keeps only six.
    fn poll(&mut self) {
        if self.uart.events_rxdrdy.read().bits() == 0 {
            return;
        }
        self.uart.events_rxdrdy.reset();
        let byte = self.uart.rxd.read().rxd().bits();
        if let Some(place) = self.inbox.get_mut(self.length) {
            *place = byte;
            self.length += 1;
        }
    }
}

impl Board for Microbit {
    fn receive(&mut self, bytes: &mut [u8]) -> usize {
        let length = core::mem::take(&mut self.length);
        for (place, byte) in bytes.iter_mut().zip(self.inbox) {
            *place = byte;
        }
        length.min(bytes.len())
    }

    fn read(&mut self, _: Instant) -> Inputs {
        let setup = Setup::default();
        let most = setup.at_full_power() * STEP.as_secs_f64() as f32 / setup.metres_per_tick[0];
        for (ticks, power) in self.ticks.iter_mut().zip(self.power) {
            *ticks += power * most;
        }
        let counts = self.ticks.map(|ticks| ticks as i32);
        Inputs { counts, bumper: true, button: true, ping: None }
    }

    fn apply(&mut self, outputs: &Outputs) {
        self.power = outputs.power;
    }

    fn send(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.uart.events_txdrdy.reset();
            self.uart.txd.write(|w| w.txd().variant(*byte));
            while self.uart.events_txdrdy.read().bits() == 0 {
                self.poll();
            }
        }
    }
}

/// A clock of a megahertz, which overflows after an hour.
struct Clock {
    timer: TIMER0,
    last: u32,
    now: Instant,
}

impl Clock {
    fn new(timer: TIMER0) -> Clock {
        timer.bitmode.write(|w| w.bitmode()._32bit());
        timer.prescaler.write(|w| w.prescaler().variant(4));
        // Safety: any value starts a task.
        timer.tasks_start.write(|w| unsafe { w.bits(1) });
        Clock { timer, last: 0, now: Instant::ZERO }
    }

    fn now(&mut self) -> Instant {
        let Some((capture, cc)) = self.timer.tasks_capture.first().zip(self.timer.cc.first())
        else {
            return self.now;
        };
        // Safety: any value starts a task.
        capture.write(|w| unsafe { w.bits(1) });
        let count = cc.read().bits();
        self.now += Duration::from_micros(count.wrapping_sub(self.last).into());
        self.last = count;
        self.now
    }
}

#[entry]
fn main() -> ! {
    let Some(p) = Peripherals::take() else { stop() };
    // Safety: any value starts a task.
    p.RNG.tasks_start.write(|w| unsafe { w.bits(1) });
    let boot = core::array::from_fn(|_| {
        while p.RNG.events_valrdy.read().bits() == 0 {}
        p.RNG.events_valrdy.reset();
        p.RNG.value.read().value().bits()
    });
    let mut controller = Controller::new(u32::from_le_bytes(boot));
    let mut board = Microbit::new(p.UART0);
    let mut clock = Clock::new(p.TIMER0);
    let mut due = clock.now();
    loop {
        board.poll();
        let now = clock.now();
        if now >= due {
            due = now + STEP;
            firmware_drive::step(&mut controller, &mut board, now);
        }
    }
}

fn stop() -> ! {
    loop {
        core::hint::spin_loop();
    }
}

/// Never linked: the gate sees to that.
#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    stop()
}
