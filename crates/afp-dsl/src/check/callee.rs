//! Finds the template or plan of an element or supervisor.

use std::rc::Rc;

use crate::check::foreign;
use crate::check::imports::Import;
use crate::check::names::{ambiguous, offer};
use crate::check::signature::{Signature, SignatureKind};
use crate::check::{Context, PlanHead};
use crate::files::relative;
use crate::toolbox::{Template, TemplateKind, Toolbox};
use afp_syntax::ast::{Name, Ref};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Sought, Words, list, words};
use afp_syntax::message;
use afp_syntax::source::Span;

/// A candidate with the name.
struct Candidate<'a> {
    signature: Rc<Signature>,
    /// The name that qualifies it.
    home: Option<&'a str>,
    /// The span of its declaration.
    span: Span,
    reach: Reach,
}

/// The distance of a declaration from its use; the nearest one wins.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Reach {
    /// A computation of the file.
    File,
    /// A plan, or a template of a toolbox of the project.
    Project,
    /// A template of a built-in toolbox.
    BuiltIn,
}

/// The expected kind of a component, by its keyword, and the span of the keyword.
pub(crate) struct Wanted {
    pub keyword: &'static str,
    /// Its span; `None` for `supervise`, which cannot be replaced by another keyword.
    pub span: Option<Span>,
}

impl Context<'_> {
    /// The template or plan that `reference` names; reports an unknown, an ambiguous or a wrong
    /// one.
    pub fn callee(
        &self,
        reference: &Ref,
        wanted: &Wanted,
        diags: &mut Diagnostics,
    ) -> Option<Rc<Signature>> {
        let name = reference.name()?;
        let home = reference.home();
        let record = self.program.record;
        if let Some(home) = &home {
            self.file.types.qualifier(home, record);
        }
        let mut found = self.candidates(&name, home.as_ref());
        let fits = |each: &Candidate<'_>| each.signature.kind.keyword() == wanted.keyword;
        // The keyword decides between a plan and a template of the same name.
        if found.iter().any(fits) {
            found.retain(fits);
        }
        nearest(&mut found, (&name, reference.span()), diags);
        if found.len() > 1 {
            record.several(name.span, found.iter().map(|each| each.span));
            let plans = found.iter().all(|each| each.home.is_none());
            let what = if plans { found[0].signature.kind.describe() } else { "a template" };
            let places: Vec<_> = found.iter().map(|each| (each.home, each.span)).collect();
            diags.push(ambiguous(what, &name.text, reference.span(), &places));
            return None;
        }
        let Some(Candidate { signature, span, .. }) = found.pop() else {
            record.unknown(name.span);
            // It may be in the missing toolbox or file.
            let subplan = wanted.keyword == "subplan";
            if if subplan { self.file.incomplete } else { self.file.types.incomplete } {
                return None;
            }
            diags.push(self.not_found(&name, home.as_ref(), reference.span(), wanted));
            return None;
        };
        let is_fit = signature.kind.keyword() == wanted.keyword;
        let is_plan = matches!(signature.kind, SignatureKind::Plan(_));
        match !is_fit && is_plan && self.file.types.incomplete {
            // The template of that name may be in the missing toolbox.
            true => record.unknown(name.span),
            false => record.definition(name.span, span),
        }
        if is_fit {
            foreign::check(self.program.toolboxes, &signature, reference.span(), diags);
            return Some(signature);
        }
        let of_itself =
            is_plan && !self.other_plans(reference.span()).any(|other| other == name.text);
        diags.push(match unfit(&signature, reference.span(), wanted) {
            error if of_itself => error
                .bare()
                .at(reference.span())
                .help("name a template: a plan cannot be part of itself"),
            error => error,
        });
        None
    }

    fn candidates(&self, name: &Name, home: Option<&Name>) -> Vec<Candidate<'_>> {
        let mut found = Vec::new();
        let plans = self.file.plans.get(&name.text).filter(|_| home.is_none());
        for index in plans.into_iter().flatten() {
            let head = &self.program.plans[*index];
            let span = head.name.as_ref().map_or_else(|| head.node.span(), |name| name.span);
            let signature = self.program.signatures.plan(*index).clone();
            found.push(Candidate { signature, home: None, span, reach: Reach::Project });
        }
        let fits = |import: &&Import| home.is_none_or(|home| home.text == import.qualifier);
        for import in self.file.imports.iter().chain(&self.file.computations).filter(fits) {
            let templates = &import.toolbox.templates;
            let Some(index) = templates.iter().position(|each| each.name == name.text) else {
                continue;
            };
            if let Some(signature) = self.program.signatures.template(import.id, index) {
                let home = Some(import.qualifier.as_str()).filter(|home| !home.is_empty());
                let span = templates[index].span;
                let reach = match home {
                    None => Reach::File,
                    Some(_) if import.toolbox.is_built_in() => Reach::BuiltIn,
                    Some(_) => Reach::Project,
                };
                found.push(Candidate { signature: signature.clone(), home, span, reach });
            }
        }
        found
    }

    fn not_found(
        &self,
        name: &Name,
        home: Option<&Name>,
        span: Span,
        wanted: &Wanted,
    ) -> Diagnostic {
        if let Some(home) = home
            && !self.file.imports.iter().any(|import| import.qualifier == home.text)
        {
            let known = self.file.imports.iter().map(|import| import.qualifier.as_str());
            let message = message!("no toolbox is used as '{}'", home.text);
            let error = Diagnostic::new(Code::E0201, span, message);
            let error = error.unknown(Sought::Template, &home.text);
            if words::nearest(&home.text, known.clone()).is_none()
                && let Some(error) = self.in_another_toolbox(name, Some(home), &error)
            {
                return error;
            }
            let none = message!("add 'use {}' at the top of the file", home.text);
            return offer(error.at(home.span), &home.text, known, none);
        }
        let message = match wanted.keyword {
            "subplan" => message!("there is no plan '{}'", name.text),
            _ => message!("there is no template '{}'", name.text),
        };
        let error = Diagnostic::new(Code::E0201, span, message);
        let error = error.unknown(Sought::Template, &name.text);
        if wanted.keyword == "subplan"
            && let Some(path) = self.home_of_plan(name)
        {
            let line = format!("use \"{path}\"");
            return error
                .help(message!("add '{}' at the top of the file", line))
                .fix(self.file.top, format!("{line}\n"));
        }
        if let Some(error) = self.in_another_toolbox(name, home, &error) {
            return error;
        }
        let imports = self.file.imports.iter().chain(&self.file.computations);
        let templates = imports.flat_map(|import| &import.toolbox.templates);
        let fitting = templates
            .filter(|template| SignatureKind::Template(template.kind).keyword() == wanted.keyword);
        if words::nearest(&name.text, fitting.clone().map(|template| template.name.as_str()))
            .is_none()
            && let alike = alike(&name.text, fitting.clone())
            && !alike.is_empty()
        {
            return error.help(message!("write {}", list(alike, "or")));
        }
        let mut known: Vec<&str> = fitting.map(|template| template.name.as_str()).collect();
        if wanted.keyword == "subplan" {
            known = self.other_plans(span).collect();
        }
        known.sort_unstable();
        known.dedup();
        offer(
            error,
            &name.text,
            known,
            match wanted.keyword {
                "subplan" => "write a plan of that name, or add 'use' and the file that has it",
                _ => "add 'use' and the name of its toolbox at the top of the file",
            },
        )
    }

    /// Names the toolbox of a template that is not used, or not the named one.
    fn in_another_toolbox(
        &self,
        name: &Name,
        home: Option<&Name>,
        error: &Diagnostic,
    ) -> Option<Diagnostic> {
        let error = error.bare();
        let has = |toolbox: &Toolbox| toolbox.templates.iter().any(|it| it.name == name.text);
        if let Some(used) = self.file.imports.iter().find(|import| has(&import.toolbox)) {
            let better = format!("{}.{}", used.qualifier, name.text);
            return Some(error.write(better));
        }
        let is_named = |toolbox: &Toolbox| home.is_some_and(|home| home.text == toolbox.name);
        let others = self.program.toolboxes.iter().filter(|toolbox| has(toolbox));
        // The first of equally good candidates.
        let other = others.min_by_key(|toolbox| !is_named(toolbox))?;
        let taken = |word: &str| self.file.imports.iter().any(|import| import.qualifier == word);
        let numbered = (2_u32..).map(|number| format!("{}{number}", other.name));
        let mut words = std::iter::once(other.name.clone()).chain(numbered);
        let word = words.find(|word| !taken(word))?;
        let line = match word == other.name {
            true => format!("use {word}"),
            false => format!("use {} as {word}", other.name),
        };
        let add = message!("add '{}' at the top of the file", line);
        Some(match home {
            Some(home) if home.text != word => {
                error.help(message!("{}, and write '{}.{}'", add, word, name.text))
            }
            _ => error.help(add).fix(self.file.top, format!("{line}\n")),
        })
    }

    /// The plans except the one around a place: a plan cannot contain itself.
    fn other_plans(&self, place: Span) -> impl Iterator<Item = &str> {
        let own = move |plan: &usize| self.program.plans[*plan].node.span().contains(place);
        let others = self.file.plans.iter().filter(move |(_, plans)| !plans.iter().any(own));
        others.map(|(name, _)| name.as_str())
    }

    /// The path of a file that has a plan of that name and is used only indirectly.
    fn home_of_plan(&self, name: &Name) -> Option<String> {
        let is_it = |head: &&PlanHead| head.name.as_ref().is_some_and(|n| n.text == name.text);
        let head = self.program.plans.iter().find(is_it)?;
        relative(self.file.path, self.program.files[head.file].path)
    }
}

/// Keeps the nearest template of a name and reports the hidden ones: a template that is added to
/// another toolbox changes no plan with its own template.
fn nearest(found: &mut Vec<Candidate<'_>>, place: (&Name, Span), diags: &mut Diagnostics) {
    let nearest = found.iter().map(|each| each.reach).min();
    let (near, far): (Vec<_>, Vec<_>) = found.iter().partition(|each| Some(each.reach) == nearest);
    if let ([own], [hidden, ..]) = (&*near, &*far)
        && matches!(own.signature.kind, SignatureKind::Template(_))
    {
        diags.push(hides(place, own, hidden));
        found.retain(|each| Some(each.reach) == nearest);
    }
}

/// Reports a template that hides another one of the same name.
fn hides((name, span): (&Name, Span), own: &Candidate<'_>, hidden: &Candidate<'_>) -> Diagnostic {
    let other = hidden.home.unwrap_or_default();
    let of_other = format!("{other}.{}", name.text);
    let (note, which) = match hidden.reach {
        Reach::BuiltIn => ("the built-in template", "the built-in one"),
        _ => ("the hidden template", "the hidden one"),
    };
    let (message, help) = match own.home {
        Some(home) => (
            message!("'{}' is the template of '{}', not of '{}'", name.text, home, other),
            message!(
                "write '{}' to be clear, or '{}' for {}",
                format!("{home}.{}", name.text),
                of_other,
                Words(which)
            ),
        ),
        None => (
            message!("'{}' is the computation of this file, not of '{}'", name.text, other),
            message!("write '{}' for {}, or rename the computation", of_other, Words(which)),
        ),
    };
    Diagnostic::new(Code::E0254, span, message).note(hidden.span, note).help(help)
}

fn unfit(signature: &Signature, span: Span, wanted: &Wanted) -> Diagnostic {
    let name = &signature.name;
    let right = signature.kind.keyword();
    let message = message!("'{}' is {}", name, Words(signature.kind.describe()));
    let supervisor = signature.kind == SignatureKind::Template(TemplateKind::Supervisor);
    match wanted.span {
        Some(keyword) if !supervisor => {
            Diagnostic::new(Code::E0217, keyword, message).note(span, "used here").write(right)
        }
        Some(keyword) => Diagnostic::new(Code::E0217, keyword, message)
            .note(span, "used here")
            .help("attach it to an actor with 'supervise', or name an actor's template"),
        None => Diagnostic::new(Code::E0217, span, message)
            .help("name a supervisor's template, or use it as an element of the plan"),
    }
}

/// The templates that another word for them names, best first: `DriveTo` for `NavigateTo`.
fn alike<'t>(name: &str, templates: impl Iterator<Item = &'t Template>) -> Vec<&'t str> {
    /// The maximum number of templates in a help.
    const MOST: usize = 4;
    let parts = name.split('_').flat_map(|part| {
        let large: Vec<usize> = part
            .char_indices()
            .filter(|(_, it)| it.is_ascii_uppercase())
            .map(|(at, _)| at)
            .collect();
        let ends = large.iter().copied().chain([part.len()]);
        let starts = std::iter::once(0).chain(large.clone());
        starts.zip(ends).map(|(from, to)| part[from..to].to_ascii_lowercase()).collect::<Vec<_>>()
    });
    let parts: Vec<String> = parts.filter(|part| part.len() > 2).collect();
    let hits = |template: &Template| {
        let also = template.doc.split_once("Also:").map_or("", |(_, also)| also);
        let own = template.name.to_ascii_lowercase();
        let words = also.split(|each: char| !each.is_alphanumeric());
        parts
            .iter()
            .filter(|part| own.contains(&***part) || words.clone().any(|word| word == **part))
            .count()
    };
    let mut found: Vec<_> =
        templates.map(|template| (hits(template), template.name.as_str())).collect();
    found.retain(|(hits, _)| *hits > 0);
    found.sort_by_key(|(hits, _)| std::cmp::Reverse(*hits));
    let best = found.first().map_or(0, |(hits, _)| *hits);
    found.into_iter().filter(|(hits, _)| *hits == best).map(|(_, name)| name).take(MOST).collect()
}
