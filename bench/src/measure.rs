//! Compares the times of short operations.
//!
//! Each case has a closure that repeats its operation. The cases take turns with one short batch
//! each. Disturbances only add time, so the result of a case is its best batch, and a ratio
//! compares two best batches. This is steady on a busy machine.

use std::time::{Duration, Instant};

const BATCH: Duration = Duration::from_micros(250);

/// An operation to time; its argument is the number of repetitions.
pub type Operation<'a> = Box<dyn FnMut(u64) + 'a>;

/// Cases that are compared with each other.
#[derive(Default)]
pub struct Race<'a> {
    cases: Vec<(String, Operation<'a>)>,
}

/// The result of a case.
#[derive(Clone, Debug)]
pub struct Times {
    pub name: String,
    /// Nanoseconds per operation in the best turn.
    pub best: f64,
}

impl<'a> Race<'a> {
    pub fn add(&mut self, name: &str, operation: impl FnMut(u64) + 'a) {
        self.cases.push((name.to_owned(), Box::new(operation)));
    }

    /// Runs all cases in turns, after one turn to warm up.
    pub fn run(mut self, turns: u32) -> Vec<Times> {
        let batches: Vec<u64> = self.cases.iter_mut().map(|(_, run)| batch_size(run)).collect();
        let mut times: Vec<Times> = self.cases.iter().map(|(name, _)| Times::new(name)).collect();
        for _ in 0..turns {
            for ((times, (_, run)), batch) in times.iter_mut().zip(&mut self.cases).zip(&batches) {
                times.best = times.best.min(time(run, *batch) / *batch as f64);
            }
        }
        times
    }
}

impl Times {
    fn new(name: &str) -> Self {
        Times { name: name.to_owned(), best: f64::INFINITY }
    }

    /// The ratio of two best turns.
    pub fn ratio(&self, other: &Times) -> f64 {
        self.best / other.best
    }
}

/// The nanoseconds of a number of operations.
fn time(run: &mut Operation<'_>, count: u64) -> f64 {
    let start = Instant::now();
    run(count);
    start.elapsed().as_nanos() as f64
}

fn batch_size(run: &mut Operation<'_>) -> u64 {
    let mut count = 1;
    loop {
        let took = time(run, count);
        if took * 4.0 >= BATCH.as_nanos() as f64 {
            let wanted = count as f64 * BATCH.as_nanos() as f64 / took;
            return (wanted as u64).max(1);
        }
        count *= 2;
    }
}
