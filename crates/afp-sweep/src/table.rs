//! Tables of outcomes as files: CSV for people and spreadsheets, Parquet for programs.
//!
//! The Parquet writer takes longer to build than the simulator's physics, and few sweeps need it.
//! The feature `parquet` enables it.

#[cfg(feature = "parquet")]
mod parquet;

use std::io;

use crate::columns::columns;
use crate::grid::Sweep;
use crate::header::Header;
use crate::outcome::Outcome;

#[cfg(feature = "parquet")]
pub use parquet::to_parquet;

/// Writes the outcomes as CSV in run order, with a header line.
///
/// # Errors
/// The memory is exhausted.
pub fn to_csv(sweep: &Sweep, outcomes: &[Outcome], _: &Header) -> io::Result<Vec<u8>> {
    let columns = columns(sweep, outcomes);
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(columns.iter().map(|column| &column.name))?;
    for row in 0..outcomes.len() {
        table.write_record(columns.iter().map(|column| column.text(row)))?;
    }
    table.into_inner().map_err(|error| error.into_error())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::Ending;
    use crate::ranges::{axis, seeds};

    pub(super) fn sweep() -> Sweep {
        Sweep {
            caveat: None,
            presses: Vec::new(),
            failures: Vec::new(),
            plan: "a.afp".to_owned(),
            worlds: vec![crate::WorldChoice::OfPlan],
            worlds_by_seed: false,
            axes: vec![axis("d=20cm,30cm").unwrap()],
            seeds: seeds("3..5").unwrap(),
            until: afp_core::Duration::from_secs(60),
        }
    }

    pub(super) fn header() -> Header {
        Header {
            sweep_journal: 2,
            program: "afp 0.1.0".to_owned(),
            plan: "1234".to_owned(),
            worlds: "5678".to_owned(),
            grid: sweep().signature(),
            parts: crate::Parts::new(),
        }
    }

    pub(super) fn outcomes() -> [Outcome; 2] {
        let failed = |run| Outcome::failed(run, Ending::Error, "a, \"b\"".to_owned());
        [
            failed(1),
            Outcome {
                trace: "ab".to_owned(),
                figures: [("wall_error_mean_m".to_owned(), Some(0.1))].into(),
                run: u64::MAX / 4 * 4,
                ..failed(2)
            },
        ]
    }

    #[test]
    fn csv_has_names_and_quotes() {
        let text = String::from_utf8(to_csv(&sweep(), &outcomes(), &header()).unwrap()).unwrap();
        let mut lines = text.lines();
        assert!(lines.next().unwrap().starts_with("run,world,seed,d,ending,where,why,time_s,"));
        let first = lines.next().unwrap();
        assert!(first.starts_with("1,,4,20cm,error,,\"a, \"\"b\"\"\",,,,,,,,,"), "{first}");
        assert!(first.ends_with("afpc run a.afp --seed 4 --set d=20cm --until 60s,0.0"), "{first}");
    }
}
