//! The PWM controller on SunFounder's Robot HAT, versions up to 4, on the I2C bus.
//!
//! Each channel belongs to the timer of its group of four. A register takes two bytes, the higher
//! one first.

use std::io;

use embedded_hal::i2c::I2c;

use super::broken;

/// The addresses of the controller: one of them answers.
const ADDRESSES: [u8; 2] = [0x14, 0x15];
/// The first registers of the channels, the prescalers and the periods.
const CHANNEL: u8 = 0x20;
const PRESCALER: u8 = 0x40;
const PERIOD: u8 = 0x44;
/// The clock in hertz, and the steps of a period.
const CLOCK: u32 = 72_000_000;
pub(crate) const STEPS: u16 = 4095;

#[derive(Debug)]
pub(crate) struct Hat<I> {
    bus: I,
    address: u8,
    /// The value of each channel.
    values: [Option<u16>; 20],
}

impl<I: I2c> Hat<I> {
    /// Finds the controller.
    pub(crate) fn new(mut bus: I) -> io::Result<Self> {
        let answers = |address: &u8| bus.write(*address, &[CHANNEL, 0, 0]).is_ok();
        let address = ADDRESSES.into_iter().find(answers);
        let missing = || io::Error::other("no Robot HAT answers at 0x14 or 0x15 of the I2C bus");
        Ok(Hat { bus, address: address.ok_or_else(missing)?, values: [None; 20] })
    }

    /// Sets the frequency of a channel and its group, in hertz.
    pub(crate) fn set_frequency(&mut self, channel: u8, hertz: u32) -> io::Result<()> {
        let group = channel / 4;
        let prescaler = CLOCK / hertz.max(1) / (u32::from(STEPS) + 1);
        let prescaler = u16::try_from(prescaler).unwrap_or(u16::MAX).max(1);
        self.write(PRESCALER + group, prescaler - 1)?;
        self.write(PERIOD + group, STEPS)
    }

    /// Sets the length of a channel's pulses in steps.
    pub(crate) fn set(&mut self, channel: u8, value: u16) -> io::Result<()> {
        let last = self.values.get_mut(usize::from(channel));
        // The bus is slow, so only changes are sent.
        if last.is_some_and(|last| last.replace(value) == Some(value)) {
            return Ok(());
        }
        self.write(CHANNEL + channel, value)
    }

    fn write(&mut self, register: u8, value: u16) -> io::Result<()> {
        let [high, low] = value.to_be_bytes();
        self.bus.write(self.address, &[register, high, low]).map_err(broken)
    }
}

#[cfg(test)]
mod tests {
    use embedded_hal::i2c::{ErrorKind, NoAcknowledgeSource};
    use embedded_hal_mock::eh1::i2c::{Mock, Transaction};

    use super::*;

    #[test]
    fn registers_are_written_at_the_address_that_answers_and_only_changes() {
        let silent = ErrorKind::NoAcknowledge(NoAcknowledgeSource::Address);
        let bus = Mock::new(&[
            Transaction::write(0x14, vec![0x20, 0, 0]).with_error(silent),
            Transaction::write(0x15, vec![0x20, 0, 0]),
            // 50 Hz: 72 MHz / 351 / 4096.
            Transaction::write(0x15, vec![0x40, 0x01, 0x5e]),
            Transaction::write(0x15, vec![0x44, 0x0f, 0xff]),
            Transaction::write(0x15, vec![0x22, 0x01, 0x33]),
        ]);
        let mut hat = Hat::new(bus).unwrap();
        hat.set_frequency(2, 50).unwrap();
        hat.set(2, 0x133).unwrap();
        hat.set(2, 0x133).unwrap();
        hat.bus.done();
    }

    #[test]
    fn a_missing_controller_is_named() {
        let silent = ErrorKind::NoAcknowledge(NoAcknowledgeSource::Address);
        let none = |address| Transaction::write(address, vec![0x20, 0, 0]).with_error(silent);
        let mut bus = Mock::new(&[none(0x14), none(0x15)]);
        assert!(Hat::new(&mut bus).unwrap_err().to_string().contains("0x14 or 0x15"));
        bus.done();
    }
}
