//! `afpc templates`: the contents of toolboxes, from their files.

use std::fmt::Write;
use std::path::Path;

use afp_dsl::Toolboxes;
use afp_dsl::toolbox::{Template, TemplateKind, Toolbox};
use afp_project::ProjectFile;
use afp_run::{RunError, say};
use afp_syntax::diagnostics::words::nearest;
use afp_syntax::source::{Sources, Span};
use afp_toolboxes::project::OwnToolboxes;
use clap::Args;

use super::print;
use crate::declared::one_line;
use crate::no_plan::NoPlan;

/// Arguments of `afpc templates`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// A toolbox, or a template: Forward, carbot.Forward [default: all toolboxes]
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc templates
  afpc templates carbot
  afpc templates Forward

The list has the built-in toolboxes and the toolboxes of the project in this folder.";

/// The width of kind and name together.
const COLUMN: usize = 32;

/// Prints toolboxes or templates.
///
/// # Errors
/// The project or a toolbox file is invalid, or the name is unknown.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let own = OwnToolboxes::read(ProjectFile::find(Path::new("."))?)?;
    let toolboxes = own.with_built_in()?;
    if toolboxes.diagnostics().has_errors() {
        say(toolboxes.diagnostics().render(toolboxes.sources(), true));
        return Err(NoPlan::Wrong);
    }
    print(&text(&toolboxes, arguments.name.as_deref())?)
}

/// The text for a name.
fn text(toolboxes: &Toolboxes, name: Option<&str>) -> Result<String, RunError> {
    let Some(name) = name else {
        let lists: Vec<_> = toolboxes.iter().map(|toolbox| list(toolbox)).collect();
        return Ok(lists.join("\n"));
    };
    if let Some(toolbox) = toolboxes.get(name) {
        return Ok(list(toolbox));
    }
    let asked = name;
    let (of, name) = name.split_once('.').map_or((None, name), |(of, name)| (Some(of), name));
    let all = toolboxes.iter().filter(|toolbox| of.is_none_or(|of| toolbox.name == of));
    let found = all.flat_map(|toolbox| {
        let named = move |template: &&Template| template.name.eq_ignore_ascii_case(name);
        toolbox.templates.iter().filter(named).map(move |template| (toolbox, template))
    });
    let found: Vec<_> =
        found.map(|(toolbox, template)| describe(toolbox, template, toolboxes.sources())).collect();
    match found.is_empty() {
        false => Ok(found.join("\n")),
        true => Err(unknown(toolboxes, of, asked)),
    }
}

/// The error for an unknown name, with suggestions.
fn unknown(toolboxes: &Toolboxes, of: Option<&str>, asked: &str) -> RunError {
    let message = format!("there is no toolbox or template '{asked}'");
    let name = asked.split_once('.').map_or(asked, |(_, name)| name);
    let templates = || {
        let all = toolboxes.iter().filter(|toolbox| of.is_none_or(|of| toolbox.name == of));
        all.flat_map(|toolbox| toolbox.templates.iter().map(|template| &*template.name))
    };
    let names = toolboxes.iter().map(|toolbox| &*toolbox.name).chain(templates());
    let help = match nearest(name, names) {
        Some(meant) => format!("write '{meant}'; 'afpc templates' lists all names"),
        None => "'afpc templates' lists all names".to_owned(),
    };
    RunError::usage(message, help)
}

/// A toolbox with one line for each template.
fn list(toolbox: &Toolbox) -> String {
    let mut text = format!("{}: {}\n", toolbox.name, one_line(&toolbox.doc));
    for template in &toolbox.templates {
        let name = format!("  {} {}", kind(template), template.name);
        let _ = writeln!(text, "{name:COLUMN$} {}", one_line(&template.doc));
    }
    text
}

/// A template's declaration, with help after each line.
fn describe(toolbox: &Toolbox, template: &Template, sources: &Sources) -> String {
    let mut text = format!("{} {} of '{}'\n", kind(template), template.name, toolbox.name);
    match one_line(&template.doc).as_str() {
        "" => text.push('\n'),
        doc => {
            let _ = writeln!(text, "  {doc}\n");
        }
    }
    let written = |word: &str, span| format!("{word}{}", declared(span, sources));
    let inputs = template.inputs.iter().map(|port| match &template.reads_table {
        // Port types cannot express this.
        Some(reads) if reads.port.name == port.name => {
            (format!("in {}: (a table)", port.name), one_line(&port.doc))
        }
        _ if port.live => (written("in live ", port.span), one_line(&port.doc)),
        _ => (written("in ", port.span), one_line(&port.doc)),
    });
    let outputs =
        template.outputs.iter().map(|port| (written("out ", port.span), one_line(&port.doc)));
    let outcomes = template.outcomes.iter().map(|outcome| {
        let line = match template.kind {
            TemplateKind::Supervisor => written("event ", outcome.span),
            _ => format!("state {}", outcome.name),
        };
        (line, one_line(&outcome.doc))
    });
    let states = template.states_of.iter();
    let states = states.map(|states| (written("", states.span), one_line(&states.doc)));
    let lines: Vec<_> = inputs.chain(outputs).chain(outcomes).chain(states).collect();
    let width = lines.iter().map(|(line, _)| line.chars().count()).max().unwrap_or(0);
    for (line, help) in lines {
        let _ = writeln!(text, "  {}", format!("{line:width$}  {help}").trim_end());
    }
    let _ = writeln!(text, "\n  {}", timing(template));
    text
}

/// The commanded device and the timing of a template, and whether it can be suspended.
fn timing(template: &Template) -> String {
    let time = |word: &str, nanos: u64| {
        let text = match nanos {
            nanos if nanos.is_multiple_of(1_000_000) => format!("{} ms", nanos / 1_000_000),
            nanos => format!("{} us", nanos as f64 / 1e3),
        };
        format!("{word} {text}")
    };
    let mut parts: Vec<_> = template.uses.iter().map(|name| format!("uses {name}")).collect();
    parts.extend(template.needs.iter().map(|name| format!("needs {name}")));
    if template.kind != TemplateKind::Computation {
        parts.push(time("every", template.every));
    }
    let rest =
        [("deadline", template.deadline), ("budget", template.budget), ("stop", template.stop)];
    parts.extend(rest.into_iter().filter_map(|(word, nanos)| Some(time(word, nanos?))));
    if template.resumable {
        let supervises = template.kind == TemplateKind::Supervisor;
        let what = if supervises { "continues after a suspension" } else { "can be suspended" };
        parts.push(what.to_owned());
    }
    parts.join(", ")
}

fn kind(template: &Template) -> &'static str {
    match template.kind {
        TemplateKind::Actor => "actor",
        TemplateKind::Supervisor => "supervisor",
        TemplateKind::Computation => "computation",
    }
}

/// The text of a declaration from its name to the next declaration, on one line.
fn declared(name: Span, sources: &Sources) -> String {
    let text = sources.get(name.file).map_or("", |source| &source.text);
    let rest = text.get(name.start as usize..).and_then(|rest| rest.lines().next());
    let mut words = rest.unwrap_or_default().split_whitespace();
    let first = words.next();
    let more = words.take_while(|word| !PARTS.contains(word) && !word.starts_with('}'));
    let all = first.into_iter().chain(more).collect::<Vec<_>>().join(" ");
    all.trim_end_matches('}').to_owned()
}

/// The words at the start of a template's parts; several parts may share a line.
const PARTS: [&str; 13] = [
    "budget",
    "deadline",
    "event",
    "every",
    "exclusive",
    "icon",
    "in",
    "needs",
    "out",
    "state",
    "states",
    "stop",
    "uses",
];

#[cfg(test)]
mod tests {
    use super::*;
    use afp_syntax::source::Source;

    #[test]
    fn a_template_on_one_line_is_described_part_by_part() {
        let mut toolboxes = Toolboxes::default();
        let line = "actor Dig resumable { uses arm in deep: length = 1 m from 0 m to 2 m in live n: int out went: length state Done state Stuck }";
        toolboxes
            .add(Source::new("own.afp", format!("toolbox own version \"1\"\n{line}\n")), "own");
        assert!(!toolboxes.diagnostics().has_errors(), "{:?}", toolboxes.diagnostics());
        let said = text(&toolboxes, Some("Dig")).unwrap();
        let lines: Vec<_> = said.lines().collect();
        let all = [
            "actor Dig of 'own'",
            "",
            "  in deep: length = 1 m from 0 m to 2 m",
            "  in live n: int",
            "  out went: length",
            "  state Done",
            "  state Stuck",
            "",
            "  uses arm, every 10 ms, can be suspended",
        ];
        assert_eq!(lines, all);
    }
}
