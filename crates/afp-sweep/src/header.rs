//! What a journal is of: a sweep goes on only with the same program, plan, worlds and grid.

use std::collections::BTreeMap;

use afp_dsl::Compiled;
use afp_dsl::graph::Graph;
use afp_run::hash;
use serde::{Deserialize, Serialize};

use crate::grid::Sweep;
use crate::setting::Setting;

/// What a journal is of. A sweep goes on only with the same.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// The version of the format, 2.
    pub sweep_journal: u32,
    /// The program: its version and commit, and for one with toolboxes of one's own what it was built from.
    pub program: String,
    /// The hash of the plan's texts.
    pub plan: String,
    /// The hash of the worlds' texts.
    pub worlds: String,
    /// The grid, as [`crate::Sweep::signature`] has it.
    pub grid: String,
    /// What else outcomes come from, by what messages call it: `the metric 'q'`.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    pub parts: Parts,
}

/// What else outcomes come from: the hash of what each does, and of each thing that it reads, by name.
pub type Parts = BTreeMap<String, (String, BTreeMap<String, String>)>;

impl Header {
    /// For a sweep of a plan by a program.
    pub fn new(
        program: String,
        (compiled, graph): (&Compiled, &Graph),
        setting: &Setting<'_>,
        sweep: &Sweep,
    ) -> Header {
        let texts = compiled.plan_texts();
        let texts = texts.iter().map(|(path, text)| format!("{path}\0{text}\0"));
        Header {
            sweep_journal: 2,
            program,
            plan: hash(&format!("{}\0{}", graph.main().name, texts.collect::<String>())),
            worlds: setting.hash(),
            grid: sweep.signature(),
            parts: Parts::new(),
        }
    }

    /// With what else outcomes come from.
    #[must_use]
    pub fn with(self, parts: Parts) -> Header {
        Header { parts, ..self }
    }

    /// What differs from another header, in words; `None` for the same sweep.
    pub(crate) fn differs(&self, other: &Header) -> Option<String> {
        let changes = [
            (self.program != other.program, "the program"),
            (self.plan != other.plan, "the plan"),
            (self.worlds != other.worlds, "a world"),
        ];
        let changed = changes.iter().filter(|(changed, _)| *changed);
        let mut changed: Vec<_> = changed.map(|(_, what)| (*what).to_owned()).collect();
        changed.extend(self.parts.iter().filter_map(|(name, ours)| {
            other.parts.get(name).and_then(|theirs| change(name, ours, theirs))
        }));
        if !changed.is_empty() {
            let have = if changed.len() == 1 { "has" } else { "have" };
            return Some(format!("{} {have} changed since", changed.join(" and ")));
        }
        let (ours, theirs) = (&self.parts, &other.parts);
        if let Some(name) = theirs.keys().find(|name| !ours.contains_key(*name)) {
            return Some(format!("it was started with {name}"));
        }
        if let Some(name) = ours.keys().find(|name| !theirs.contains_key(*name)) {
            return Some(format!("it was started without {name}"));
        }
        let (ours, theirs) = (&self.grid, &other.grid);
        (self != other).then(|| format!("it was started with {theirs}; this is {ours}"))
    }
}

/// What has changed about something, in words: itself, or else something that it reads.
fn change(
    name: &str,
    ours: &(String, BTreeMap<String, String>),
    theirs: &(String, BTreeMap<String, String>),
) -> Option<String> {
    let ((does, reads), (did, read)) = (ours, theirs);
    if does != did {
        return Some(name.to_owned());
    }
    let names = reads.keys().chain(read.keys());
    let mut changed = names.filter(|each| reads.get(*each) != read.get(*each));
    changed.next().map(|each| format!("'{each}', which {name} reads,"))
}
