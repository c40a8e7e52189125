//! Compares the times of short operations.
//!
//! Each case has a closure that repeats its operation. The cases take turns with one short batch
//! each. The result of a case is its median, and a ratio is the median of the ratios of all turns.
//! This is steady on a busy machine, because a disturbance changes few turns.

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
    /// Nanoseconds per operation, the median of all turns.
    pub median: f64,
    turns: Vec<f64>,
}

impl<'a> Race<'a> {
    pub fn add(&mut self, name: &str, operation: impl FnMut(u64) + 'a) {
        self.cases.push((name.to_owned(), Box::new(operation)));
    }

    /// Runs all cases in turns, after one turn to warm up.
    pub fn run(mut self, turns: u32) -> Vec<Times> {
        let batches: Vec<u64> = self.cases.iter_mut().map(|(_, run)| batch_size(run)).collect();
        let mut times: Vec<Vec<f64>> = vec![Vec::new(); self.cases.len()];
        for _ in 0..turns.max(1) {
            for ((times, (_, run)), batch) in times.iter_mut().zip(&mut self.cases).zip(&batches) {
                times.push(time(run, *batch) / *batch as f64);
            }
        }
        let names = self.cases.into_iter().map(|(name, _)| name);
        names.zip(times).map(|(name, turns)| Times::new(name, turns)).collect()
    }
}

impl Times {
    fn new(name: String, turns: Vec<f64>) -> Self {
        Times { name, median: median(turns.iter().copied()), turns }
    }

    /// The ratio to another case, the median of all turns.
    pub fn ratio(&self, other: &Times) -> f64 {
        median(self.turns.iter().zip(&other.turns).map(|(own, other)| own / other))
    }

    /// The difference to another case in nanoseconds, the median of all turns.
    pub fn beyond(&self, other: &Times) -> f64 {
        median(self.turns.iter().zip(&other.turns).map(|(own, other)| own - other))
    }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
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
