//! The program of the second controller, for any board. [`afp_drive`] decides; a board has pins, a
//! clock and a serial line.
#![no_std]
#![forbid(unsafe_code)]

use afp_drive::{Controller, Inputs, LONGEST, Outputs};
use afp_types::Instant;

/// The most bytes that a step takes from the line. The computer sends fewer in 10 ms.
const CHUNK: usize = 256;

/// The pins and the serial line of a board.
pub trait Board {
    /// Takes bytes that have arrived; returns their number.
    fn receive(&mut self, bytes: &mut [u8]) -> usize;

    /// Takes the readings since the last step.
    fn read(&mut self, now: Instant) -> Inputs;

    /// Applies the commands.
    fn apply(&mut self, outputs: &Outputs);

    /// Sends bytes. Bytes that the line does not take are lost.
    fn send(&mut self, bytes: &[u8]);
}

/// Makes one step. The board calls it every [`STEP`](afp_drive::STEP).
pub fn step(controller: &mut Controller, board: &mut impl Board, now: Instant) {
    let mut bytes = [0; CHUNK];
    let received = board.receive(&mut bytes);
    for byte in bytes.get(..received).unwrap_or_default() {
        controller.receive(*byte, now);
    }
    let inputs = board.read(now);
    let outputs = controller.step(&inputs, now);
    board.apply(&outputs);
    let mut frames = [0; 2 * LONGEST];
    let frames = controller.transmit(now, &mut frames);
    if !frames.is_empty() {
        board.send(frames);
    }
}
