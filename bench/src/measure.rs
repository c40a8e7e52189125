//! Times short operations against each other.
//!
//! Each case gives a closure that repeats its operation a number of times. The cases take turns,
//! one short batch each. What disturbs a batch only ever adds time, so a case's figure is its best
//! batch, and a ratio is that of two best batches: steady on a machine that does other things too.

use std::time::{Duration, Instant};

/// How long one batch should take.
const BATCH: Duration = Duration::from_micros(250);

/// An operation to time: repeats itself as often as it is told.
pub type Operation<'a> = Box<dyn FnMut(u64) + 'a>;

/// Cases that are compared with each other.
#[derive(Default)]
pub struct Race<'a> {
    cases: Vec<(String, Operation<'a>)>,
}

/// What a case took.
#[derive(Clone, Debug)]
pub struct Times {
    /// The case.
    pub name: String,
    /// Nanoseconds for one operation in its best turn.
    pub best: f64,
}

impl<'a> Race<'a> {
    /// Adds a case.
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

    /// This case's best turn by the other's.
    pub fn ratio(&self, other: &Times) -> f64 {
        self.best / other.best
    }
}

/// Nanoseconds that a number of operations take.
fn time(run: &mut Operation<'_>, count: u64) -> f64 {
    let start = Instant::now();
    run(count);
    start.elapsed().as_nanos() as f64
}

/// How many operations fill a batch.
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
