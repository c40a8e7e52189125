//! Plans at the limit of the scheduler's tables, and beyond it.

use crate::support;

use std::fmt::Write;

use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_syntax::source::Source;

const MOST: usize = 65_535;

/// A toolbox with a computation of a hundred states and a supervisor of 64 events.
fn wide() -> String {
    let mut text = String::from("toolbox wide\n\ncomputation Choose {\n");
    for state in 0..100 {
        let _ = writeln!(text, "    state S{state}");
    }
    text += "}\n\nsupervisor Watch {\n";
    for event in 0..64 {
        let _ = writeln!(text, "    event E{event}");
    }
    text + "}\n\nactor Act { state Done }\n\nsupervisor Look { event Seen }\n"
}

fn compile(text: &str) -> Compiled {
    let mut toolboxes = Toolboxes::default();
    toolboxes.add(Source::new("wide.afp", wide()), "extra");
    assert!(toolboxes.diagnostics().is_empty());
    support::compile(&format!("use wide\n{text}"), &toolboxes)
}

/// The errors of a plan as `line:text: message`.
fn errors(compiled: &Compiled) -> Vec<String> {
    let errors = compiled.diags.iter().filter(|each| each.code.as_str().starts_with("E02"));
    let shown = errors.map(|each| {
        let line = compiled.sources.get(each.span.file).unwrap().line_column(each.span.start).0;
        format!("{line}:{}: {}", compiled.sources.text(each.span), each.message_text())
    });
    shown.collect()
}

fn edges(prefix: &str, count: usize, target: &str) -> String {
    (0..count).map(|n| format!("{prefix}{n} -> {target} ")).collect()
}

/// A plan of `wide` computations with a hundred states each and `narrow` actors with one.
fn states(wide: usize, narrow: usize) -> String {
    let all = edges("S", 100, "a0");
    let mut text = String::from("plan P {\n    start a0\n");
    for n in 0..wide {
        let _ = writeln!(text, "    computation c{n}: Choose {{ {all} }}");
    }
    for n in 0..narrow {
        let _ = writeln!(text, "    actor a{n}: Act {{ Done -> terminate }}");
    }
    text + "}\n"
}

/// A plan of `actors`, each with its own supervisor, and `globals`.
fn watched(globals: usize, actors: usize) -> String {
    let mut text = String::from("plan P {\n    start a0\n");
    for n in 0..globals {
        let _ = writeln!(text, "    supervise g{n}: Look {{ Seen -> terminate }}");
    }
    for n in 0..actors {
        let next = if n + 1 == actors { "terminate".to_owned() } else { format!("a{}", n + 1) };
        let _ = writeln!(
            text,
            "    actor a{n}: Act {{ supervise own: Look {{ Seen -> terminate }} Done -> {next} }}"
        );
    }
    text + "}\n"
}

#[test]
fn states_and_events_can_fill_their_table() {
    let full = compile(&states(655, 35));
    let graph = full.graph.as_ref().unwrap_or_else(|| panic!("{}", full.render(false)));
    let rows = graph.rows(graph.main);
    assert_eq!(rows.edges.len(), MOST);
    assert_eq!(rows.elements[689].states.indices(), MOST - 1..MOST);
    let over = compile(&states(655, 36));
    assert!(over.graph.is_none());
    assert_eq!(errors(&over), ["2:P: 'P' has 65536 states and events; at most 65535 fit"]);
}

#[test]
fn supervisors_of_many_elements_can_fill_their_table() {
    let full = compile(&watched(254, 257));
    let graph = full.graph.as_ref().unwrap_or_else(|| panic!("{}", full.render(false)));
    let rows = graph.rows(graph.main);
    assert_eq!(rows.sweeps.len(), MOST);
    let last = rows.sweep(&rows.elements[256]).last().unwrap();
    assert_eq!(graph.main().supervisors[last.index()].owner.unwrap().index(), 256);
    let over = compile(&watched(256, 257));
    assert!(over.graph.is_none());
    let expected = "2:P: 'P' has 66049 pairs of an element and a supervisor that watches it; \
                    at most 65535 fit";
    assert_eq!(errors(&over), [expected]);
}

#[test]
fn all_tables_that_overflow_are_reported() {
    let mut text = states(656, 1);
    text.truncate(text.len() - 2);
    for n in 0..=MOST {
        let _ = writeln!(text, "    const e{n} = 1");
    }
    let found = errors(&compile(&(text + "}\n")));
    let expected = [
        "2:P: 'P' has 65536 entries; at most 65535 fit",
        "2:P: 'P' has 65601 states and events; at most 65535 fit",
    ];
    assert_eq!(found, expected);
}

#[test]
fn the_last_of_64_events_is_wanted() {
    let others = edges("E", 63, "ignore");
    let text = format!(
        "plan P {{\n    start a\n    supervise w: Watch {{ {others} E63 -> terminate }}\n    \
         actor a: Act {{ Done -> terminate }}\n}}\n"
    );
    let compiled = compile(&text);
    let graph = compiled.graph.as_ref().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    assert_eq!(graph.rows(graph.main).supervisors[0].wanted.bits(), 1 << 63);
}

#[test]
fn sub_plans_are_numbered_after_the_items_before_them() {
    let text = "plan Outer {
    start a
    out x: int = 0
    subplan a: Inner(y = 1, z => x) { OK -> b }
    subplan b: Inner(y = 2, z => x) { OK -> terminate }
    supervise w: Look { Seen -> terminate }
}
plan Inner {
    start c
    in y: int
    out z: int = y
    actor c: Act { supervise l: Look { Seen -> terminate } Done -> terminate }
}
";
    let compiled = compile(&text.replace("{ OK", "{ Interrupted -> b  OK"));
    let graph = compiled.graph.as_ref().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let children = graph.rows(graph.main).elements.iter().map(|row| row.child);
    let children: Vec<_> = children.map(|child| (child.components, child.entries)).collect();
    assert_eq!(children, [(3, 1), (5, 3)]);
    let all = afp_dsl::unfold::unfold(graph);
    assert_eq!(all.components[1 + 5].path, "b.c");
    assert_eq!(all.entries[3].path, "b.y");
}
