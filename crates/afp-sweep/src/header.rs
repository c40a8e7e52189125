//! The identity of a journal: a sweep resumes only with the same program, plan, worlds and grid.

use std::collections::BTreeMap;

use afp_dsl::Compiled;
use afp_dsl::graph::Graph;
use afp_run::hash;
use serde::{Deserialize, Serialize};

use crate::grid::Sweep;
use crate::setting::Setting;

/// The identity of a journal. A sweep resumes only with an equal header.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// The version of the format, 2.
    pub sweep_journal: u32,
    /// The program: its version and commit, and the sources of its own toolboxes.
    pub program: String,
    /// The hash of the plan's texts.
    pub plan: String,
    /// The hash of the worlds' texts.
    pub worlds: String,
    /// The grid, from [`crate::Sweep::signature`].
    pub grid: String,
    /// Other inputs of the outcomes, by their names in messages: `the metric 'q'`.
    #[serde(default, skip_serializing_if = "Parts::is_empty")]
    pub parts: Parts,
}

/// Other inputs of the outcomes, by name: the hash of each, and of everything that it reads.
pub type Parts = BTreeMap<String, (String, BTreeMap<String, String>)>;

impl Header {
    /// Makes the header of a plan and a program.
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

    /// Adds other inputs of the outcomes.
    #[must_use]
    pub fn with(self, parts: Parts) -> Header {
        Header { parts, ..self }
    }

    /// The difference from another header in words; `None` if they are equal.
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

/// The change of an input in words: the input itself, or something that it reads.
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
