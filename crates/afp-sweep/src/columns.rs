//! Outcomes as columns, shared by all table formats.

use std::collections::HashSet;

use crate::findings::Measure;
use crate::grid::{Axis, Row, Sweep};
use crate::outcome::{FIXED, Outcome, of_robot};

pub struct Column {
    pub name: String,
    pub cells: Cells,
}

pub enum Cells {
    /// Counts, with gaps.
    Counts(Vec<Option<u64>>),
    /// Numbers, with gaps.
    Numbers(Vec<Option<f64>>),
    Texts(Vec<String>),
}

impl Column {
    /// Returns a cell as text; a missing value is empty.
    pub(crate) fn text(&self, row: usize) -> String {
        match &self.cells {
            Cells::Counts(all) => all.get(row).copied().flatten().map(|count| count.to_string()),
            // With a decimal point, so that readers infer the type of the whole column.
            Cells::Numbers(all) => {
                all.get(row).copied().flatten().map(|number| format!("{number:?}"))
            }
            Cells::Texts(all) => all.get(row).cloned(),
        }
        .unwrap_or_default()
    }
}

/// Returns the column names of each axis, for the written value and the SI value. If a fixed column
/// has the name, it gets the prefix `in.`.
fn names_of_axes(sweep: &Sweep) -> Vec<[String; 2]> {
    let mut known: HashSet<String> = FIXED.map(str::to_owned).into();
    let names = |name: String| [format!("{name}_si"), name];
    let free = |axis: &Axis| {
        let own = names(axis.name.clone());
        let [si, name] = match own.iter().any(|name| known.contains(name)) {
            true => names(format!("in.{}", axis.name)),
            false => own,
        };
        known.extend([name.clone(), si.clone()]);
        [name, si]
    };
    sweep.axes.iter().map(free).collect()
}

/// Returns the columns of outcomes: number, world, seed, values, results, command and duration. All
/// names differ.
pub fn columns(sweep: &Sweep, outcomes: &[Outcome]) -> Vec<Column> {
    let rows: Vec<Row<'_>> = outcomes.iter().map(|outcome| sweep.row(outcome.run)).collect();
    // A run that never started has no results.
    let counts = |name: &str, count: fn(&Outcome) -> u64| {
        let count = |it: &Outcome| it.has_started().then(|| count(it));
        column(name, Cells::Counts(outcomes.iter().map(count).collect()))
    };
    let numbers = |measure: &Measure| {
        let cells = outcomes.iter().map(|outcome| measure.of(outcome)).collect();
        column(measure.name(), Cells::Numbers(cells))
    };
    let texts = |name: &str, text: fn(&Outcome) -> &str| {
        column(name, Cells::Texts(outcomes.iter().map(|it| text(it).to_owned()).collect()))
    };
    let mut all = vec![
        column("run", Cells::Counts(outcomes.iter().map(|it| Some(it.run)).collect())),
        column("world", of_rows(&rows, |row| row.world.name().unwrap_or_default().to_owned())),
        column("seed", Cells::Counts(rows.iter().map(|row| Some(row.seed)).collect())),
    ];
    let names = names_of_axes(sweep);
    for (number, (axis, [name, si])) in sweep.axes.iter().zip(&names).enumerate() {
        let point = |row: &Row<'_>| row.values.get(number).map(|(_, point)| (*point).clone());
        let text = |row: &Row<'_>| point(row).map(|point| point.text).unwrap_or_default();
        all.push(column(name, of_rows(&rows, text)));
        if axis.points.iter().any(|point| point.si.is_some()) {
            let cells = rows.iter().map(|row| point(row).and_then(|point| point.si)).collect();
            all.push(column(si, Cells::Numbers(cells)));
        }
    }
    all.extend([
        texts("ending", |it| it.ending.name()),
        texts("where", |it| &it.place),
        texts("why", |it| &it.why),
        numbers(&Measure::Time),
        numbers(&Measure::Distance),
        counts("collisions", |it| it.collisions),
        column("touched", Cells::Texts(outcomes.iter().map(Outcome::touched_text).collect())),
        counts("interruptions", |it| it.interruptions),
        counts("deadline_misses", |it| it.deadline_misses),
    ]);
    for figure in Measure::of_figures(outcomes) {
        let mut column = numbers(&figure);
        if names.as_flattened().contains(&column.name) {
            column.name = of_robot(&column.name);
        }
        all.push(column);
    }
    all.extend([
        texts("trace", |it| &it.trace),
        column("command", of_rows(&rows, |row| sweep.command(row))),
        column("took_s", Cells::Numbers(outcomes.iter().map(|it| Some(it.took_s)).collect())),
    ]);
    all
}

fn column(name: &str, cells: Cells) -> Column {
    Column { name: name.to_owned(), cells }
}

fn of_rows(rows: &[Row<'_>], text: impl Fn(&Row<'_>) -> String) -> Cells {
    Cells::Texts(rows.iter().map(text).collect())
}

#[cfg(test)]
mod tests {
    use afp_core::Duration;

    use super::*;
    use crate::grid::{Point, WorldChoice};
    use crate::outcome::Ending;
    use crate::seeds::Seeds;

    #[test]
    fn each_column_has_a_different_name() {
        let axis = |name: &str| Axis {
            name: name.to_owned(),
            points: vec![Point { text: "1".to_owned(), si: Some(1.0) }],
            by_seed: false,
        };
        let mut sweep = Sweep {
            plan: "p.afp".to_owned(),
            worlds: vec![WorldChoice::OfPlan],
            worlds_by_seed: false,
            axes: vec![],
            seeds: Seeds::new(0..1),
            presses: vec![],
            failures: vec![],
            until: Duration::from_secs(1),
            caveat: None,
        };
        let mut outcome = Outcome::failed(0, Ending::Ok, String::new());
        outcome.figures.insert("n".to_owned(), Some(3.0));
        let names = |sweep: &Sweep, outcome: &Outcome| -> Vec<_> {
            let columns = columns(sweep, std::slice::from_ref(outcome)).into_iter();
            columns.map(|column| column.name).collect()
        };
        let plain = names(&sweep, &Outcome::failed(0, Ending::Ok, String::new()));
        assert_eq!(plain, FIXED);
        sweep.axes = ["seed", "n", "n_si"].map(axis).into();
        let all = names(&sweep, &outcome);
        assert_eq!(all[3..9], ["in.seed", "in.seed_si", "n", "n_si", "in.n_si", "in.n_si_si"]);
        assert!(all.contains(&"robot.n".to_owned()), "{all:?}");
        assert_eq!(all.iter().collect::<HashSet<_>>().len(), all.len());
    }
}
