//! Likely meanings of unknown names: an element, a part of a unit.

use std::sync::Arc;

use super::{PlanHead, Program};
use crate::toolbox::{Template, TemplateKind, Toolbox};
use crate::types::text::written;
use afp_syntax::ast;
use afp_syntax::diagnostics::{Code, Diagnostic, Message, Subject, list};
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::units::Unit;

/// Explains an unknown name that has a meaning of another kind.
pub(super) fn explain(program: &Program<'_>, plan: Option<usize>, error: Diagnostic) -> Diagnostic {
    let head = plan.and_then(|index| program.plans.get(index));
    let Some(text) = head.and_then(|head| program.files.get(head.file)).map(|file| file.text)
    else {
        return error;
    };
    if error.subject == Subject::Event {
        return head.and_then(|head| behind_word(program, head, text, &error)).unwrap_or(error);
    }
    if error.subject == Subject::Value {
        return value(program, text, &error).unwrap_or(error);
    }
    let Some(name) = text.get(error.span.start as usize..error.span.end as usize) else {
        return error;
    };
    match error.code {
        Code::E0209 => unit(text, &error)
            .or_else(|| unit_alone(text, name, &error))
            .or_else(|| entry(head?, name, &error)),
        Code::E0239 => head.and_then(|head| path(program, head, (text, name), &error)),
        Code::E0210 => head.and_then(|head| event(program, head, (text, name), &error)),
        Code::E0216 => element(program, plan, name, &error)
            .or_else(|| no_element(program, head?, name, &error)),
        _ => None,
    }
    .unwrap_or(error)
}

/// `20 cm / s`, `20 cm/sec`, `1 m/s2`
fn unit(text: &str, error: &Diagnostic) -> Option<Diagnostic> {
    let (before, rest) = text.split_at(error.span.start as usize);
    let last = &rest[..(error.span.end - error.span.start) as usize];
    let left = before.trim_end();
    let sign = left.chars().last().filter(|sign| matches!(sign, '/' | '*'))?;
    let left = left[..left.len() - 1].trim_end();
    let letters = |each: char| each.is_ascii_alphanumeric() || matches!(each, '/' | '*' | '^');
    let first = left.trim_end_matches(letters);
    let follows_number = first.trim_end().ends_with(|each: char| each.is_ascii_digit());
    let of = |last: &str| format!("{}{sign}{last}", &left[first.len()..]);
    let is_unit = |whole: &String| Unit::parse(whole).is_some();
    let meant = || Unit::meant(last).map(str::to_owned).or_else(|| Unit::power_meant(last));
    let spelled = Some(of(last)).filter(is_unit);
    if !follows_number {
        return None;
    }
    let said = error.bare();
    let ours = if spelled.is_some() { last.to_owned() } else { meant()? };
    let whole = Some(of(&ours)).filter(is_unit)?;
    // `20 cm/sec`, `1 m/s2`
    if spelled.is_none() && left.len() + 1 == before.len() {
        return Some(said.help(message!("write '{}'", whole)).replace(ours));
    }
    let mut place = error.span;
    place.start = u32::try_from(first.len()).ok()?;
    let help = message!("a unit has no spaces: write '{}'", whole);
    Some(said.help(help).fix(place, whole))
}

/// `d / cm`: a unit without a number.
fn unit_alone(text: &str, name: &str, error: &Diagnostic) -> Option<Diagnostic> {
    let is_factor = text[..error.span.start as usize].trim_end().ends_with(['/', '*']);
    let unit = Unit::parse(name).filter(|_| name.len() > 1 || is_factor)?;
    let better = format!("1 {name}");
    let help = message!("a unit needs a number: write '{}'", better);
    (!unit.celsius).then(|| error.bare().help(help).replace(better))
}

/// `leg.driven`, `Main.far`: a dot before the entry of an element or of another plan.
fn path(
    program: &Program<'_>,
    head: &PlanHead,
    (text, home): (&str, &str),
    error: &Diagnostic,
) -> Option<Diagnostic> {
    let behind = text.get(error.span.end as usize..)?.strip_prefix('.')?;
    let ends = behind.find(|each: char| !each.is_ascii_alphanumeric() && each != '_');
    let port = &behind[..ends.unwrap_or(behind.len())];
    let said = |message: Message| Diagnostic::new(error.code, error.span, message);
    let plan_of = |name: &str| {
        let is_it = |head: &&PlanHead| head.name.as_ref().is_some_and(|it| it.text == name);
        program.plans.iter().find(is_it)
    };
    let type_of = |plan: Option<&PlanHead>| {
        let entry = plan?.entries.iter().find(|entry| entry.name.text == port)?;
        entry.ty.as_ref().map(written)
    };
    let elements = head.node.elements();
    if let Some(element) = elements.iter().find(|it| it.name().is_some_and(|it| it.text == home)) {
        let of = element.template().and_then(|template| template.name()).map(|name| name.text);
        let of = of.unwrap_or_default();
        let templates = program.toolboxes.iter().flat_map(|toolbox| &toolbox.templates);
        let outputs = templates.filter(|it| it.name == of).flat_map(|it| &it.outputs);
        let output = { outputs }.find(|it| it.name == port).map(|output| written(&output.ty));
        let ty = type_of(plan_of(&of)).or(output).unwrap_or_else(|| "float".to_owned());
        let help = message!(
            "declare 'var {}: {}', write '{}({} => {})', and read '{}'",
            port,
            ty,
            of,
            port,
            port,
            port
        );
        let said = said(message!("formulas read entries, and '{}' is an element", home));
        return Some(said.note(element.name()?.span, "declared here").help(help));
    }
    let ty = type_of(Some(plan_of(home)?)).unwrap_or_else(|| "float".to_owned());
    let own = head.name.as_ref().map_or("", |name| &name.text);
    let help =
        message!("declare 'in {}: {}' in '{}', and pass it where that is used", port, ty, own);
    let said =
        said(message!("'{}' sees only its own entries, and '{}' is another plan", own, home));
    Some(said.help(help))
}

/// `on TouchSensorPressed -> back`: an event of a supervisor after a word.
fn behind_word(
    program: &Program<'_>,
    head: &PlanHead,
    text: &str,
    error: &Diagnostic,
) -> Option<Diagnostic> {
    let behind = text.get(error.span.end as usize..)?;
    let start = text.len() - behind.trim_start().len();
    let name = text.get(start..)?;
    let name = &name[..name.find(|each: char| !each.is_ascii_alphanumeric() && each != '_')?];
    let [start, end] = [start, start + name.len()].map(|at| u32::try_from(at).ok());
    let place = Span { start: start?, end: end?, ..error.span };
    let of_event = Diagnostic::new(error.code, place, "");
    let mut said = event(program, head, (text, name), &of_event)?;
    let fix = said.fix.take()?;
    said.span = error.span.to(fix.span);
    Some(said.replace(fix.text))
}

/// `Forward(30 cm)`: a value without its port, which its position may show.
fn value(program: &Program<'_>, text: &str, error: &Diagnostic) -> Option<Diagnostic> {
    let (before, behind) = text.split_at_checked(error.span.start as usize)?;
    if behind.starts_with('(') {
        return None;
    }
    let (mut depth, mut commas, mut open) = (0_usize, 0, None);
    for (at, sign) in before.char_indices().rev() {
        match sign {
            ')' => depth += 1,
            '(' if depth == 0 => {
                open = Some(at);
                break;
            }
            '(' => depth -= 1,
            ',' if depth == 0 => commas += 1,
            '{' | '}' => return None,
            _ => {}
        }
    }
    let head = before[..open?].trim_end();
    let name = head.rsplit(|each: char| !each.is_ascii_alphanumeric() && each != '_').next()?;
    let templates = program.toolboxes.iter().flat_map(|toolbox| &toolbox.templates);
    let template = { templates }.find(|it| it.name == name)?;
    let port = &template.inputs.get(commas)?.name;
    let message = message!("the value has no port; this one may be for '{}'", port);
    let said = Diagnostic::new(error.code, error.span, message);
    let better = format!("{port} = ");
    Some(
        said.help(message!("write '{}' before it", better.trim_end()))
            .fix(error.span.before(), better),
    )
}

/// An event of a supervisor in the place of a state.
fn event(
    program: &Program<'_>,
    head: &PlanHead,
    (text, name): (&str, &str),
    error: &Diagnostic,
) -> Option<Diagnostic> {
    let templates = || program.toolboxes.iter().flat_map(|toolbox| &toolbox.templates);
    let has = |it: &Template| it.outcomes.iter().any(|outcome| outcome.name == name);
    if templates().any(|it| it.kind != TemplateKind::Supervisor && has(it)) {
        return None;
    }
    let mut watching = templates().filter(|it| it.kind == TemplateKind::Supervisor);
    let template = watching.find(|it| has(it))?;
    let behind = text.get(error.span.end as usize..)?;
    let target = behind.trim_start().strip_prefix("->")?.trim_start();
    let ends = target.find(|each: char| !each.is_ascii_alphanumeric() && each != '_')?;
    let end = u32::try_from(text.len() - target.len() + ends).ok()?;
    let whole = Span { end, ..error.span };
    let edges = template.outcomes.iter().map(|event| match event.name == name {
        true => format!("{name} -> {}", &target[..ends]),
        false => format!("{} -> ignore", event.name),
    });
    let edges: Vec<_> = edges.collect();
    let guards = head.node.guards().into_iter();
    let made_of = |guard: &ast::Guard| guard.template().and_then(|it| it.name()).map(|it| it.text);
    let global = guards.filter(|it| made_of(it).as_ref() == Some(&template.name));
    if let Some(global) = { global }.find_map(|it| it.name()) {
        let better = format!("on {} {{ {name} -> {} }}", global.text, &target[..ends]);
        let message = message!("'{}' is an event of '{}'", name, global.text);
        let said = Diagnostic::new(error.code, error.span, message);
        return Some(said.help(message!("write '{}'", better)).fix(whole, better));
    }
    let watched = &template.name;
    let better = format!("supervise watch: {watched} {{ {} }}", edges.join("  "));
    let message = message!("'{}' is an event of '{}', which a supervisor reports", name, watched);
    let said = Diagnostic::new(error.code, error.span, message);
    Some(said.help(message!("write '{}'", better)).fix(whole, better))
}

/// An element in the place of an entry.
fn entry(head: &PlanHead, name: &str, error: &Diagnostic) -> Option<Diagnostic> {
    let elements = head.node.elements();
    let element = elements.iter().filter_map(|it| it.name()).find(|it| it.text == name)?;
    let said = error.bare();
    let help = "formulas read entries: write an output of the element to an entry with '=>', and read the entry";
    Some(said.note(element.span, message!("'{}' is an element", name)).help(help))
}

/// An element of another plan.
fn element(
    program: &Program<'_>,
    plan: Option<usize>,
    name: &str,
    error: &Diagnostic,
) -> Option<Diagnostic> {
    let others = program.plans.iter().enumerate().filter(|(index, _)| Some(*index) != plan);
    let mut found = others.filter_map(|(_, head)| {
        let elements = head.node.elements();
        let element = elements.iter().filter_map(|it| it.name()).find(|it| it.text == name)?;
        Some((head.name.as_ref()?.text.clone(), element.span))
    });
    let (other, place) = found.next()?;
    let said = error.bare();
    let help =
        message!("lead to a 'subplan' made from '{}', or add an element '{}' here", other, name);
    Some(said.note(place, message!("'{}' is an element of '{}'", name, other)).help(help))
}

/// The error for a target that is not an element.
fn no_element(
    program: &Program<'_>,
    head: &PlanHead,
    name: &str,
    error: &Diagnostic,
) -> Option<Diagnostic> {
    let said = error.bare();
    let guards = head.node.guards().into_iter();
    if let Some(guard) = guards.filter_map(|it| it.name()).find(|it| it.text == name) {
        let note = message!("'{}' is a supervisor, not an element", name);
        let elements = head.node.elements().into_iter().filter_map(|it| it.name()).take(4);
        let names: Vec<_> = elements.map(|name| name.text).collect();
        let help = message!("lead to an element: {}", list(names.iter().map(String::as_str), "or"));
        return Some(said.note(guard.span, note).help(help));
    }
    let mut plans = program.plans.iter().filter_map(|head| head.name.as_ref());
    if let Some(plan) = plans.find(|plan| plan.text == name) {
        let help =
            message!("add an element made from it, 'subplan NAME: {}', and lead to it", name);
        return Some(said.note(plan.span, message!("'{}' is a plan", name)).help(help));
    }
    let is_it = |toolbox: &&Arc<Toolbox>| toolbox.templates.iter().any(|it| it.name == name);
    program.toolboxes.iter().find(is_it).filter(|_| error.fix.is_none())?;
    let help = message!("add an element made from '{}', and lead to it by its name", name);
    Some(said.help(help))
}

/// The help for two values that may be one number with a decimal comma.
pub(super) fn decimal_comma<'a>(
    values: impl Iterator<Item = &'a ast::Formula> + Clone,
) -> Option<Message> {
    let mut pairs = values.clone().zip(values.skip(1));
    let better = pairs.find_map(|(value, next)| value.with_decimal_point(next))?;
    Some(message!("; if '{}' is one number, write '{}'", better.replace('.', ","), better))
}
