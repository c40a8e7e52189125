//! Outcomes as columns, the same for every kind of table.

use crate::findings::Measure;
use crate::grid::{Row, Sweep};
use crate::outcome::Outcome;

/// A column.
pub struct Column {
    /// Its name, with its unit.
    pub name: String,
    /// What stands in it.
    pub cells: Cells,
}

/// The cells of a column.
pub enum Cells {
    /// Counts.
    Counts(Vec<u64>),
    /// Numbers, where there is one.
    Numbers(Vec<Option<f64>>),
    /// Texts.
    Texts(Vec<String>),
}

impl Column {
    /// A cell as text; empty where there is nothing.
    pub(crate) fn text(&self, row: usize) -> String {
        match &self.cells {
            Cells::Counts(all) => all.get(row).map(u64::to_string),
            Cells::Numbers(all) => all.get(row).copied().flatten().map(|number| number.to_string()),
            Cells::Texts(all) => all.get(row).cloned(),
        }
        .unwrap_or_default()
    }
}

/// The columns of outcomes: numbers, world, seed, values, what came of it, the command, what it took.
pub fn columns(sweep: &Sweep, outcomes: &[Outcome]) -> Vec<Column> {
    let rows: Vec<Row<'_>> = outcomes.iter().map(|outcome| sweep.row(outcome.run)).collect();
    let counts = |name: &str, count: fn(&Outcome) -> u64| {
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
        counts("run", |it| it.run),
        column("world", of_rows(&rows, |row| row.world.name().unwrap_or_default().to_owned())),
        column("seed", Cells::Counts(rows.iter().map(|row| row.seed).collect())),
    ];
    for (number, axis) in sweep.axes.iter().enumerate() {
        let point = |row: &Row<'_>| row.values.get(number).map(|(_, point)| (*point).clone());
        let text = |row: &Row<'_>| point(row).map(|point| point.text).unwrap_or_default();
        all.push(column(&axis.name, of_rows(&rows, text)));
        if axis.points.iter().any(|point| point.si.is_some()) {
            let cells = rows.iter().map(|row| point(row).and_then(|point| point.si)).collect();
            all.push(column(&format!("{}_si", axis.name), Cells::Numbers(cells)));
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
    all.extend(Measure::of_figures(outcomes).iter().map(numbers));
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
