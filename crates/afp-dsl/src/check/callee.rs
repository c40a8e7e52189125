//! Finds the template or plan that an element or supervisor names.

use crate::check::Context;
use crate::check::names::unknown;
use crate::check::signature::{Signature, SignatureKind};
use crate::check::types::qualified;
use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::graph::{TemplateId, ToolboxId};
use crate::source::Span;
use crate::syntax::ast::{Name, Ref};
use crate::toolbox::TemplateKind;
use crate::words;

/// What the keyword in front of a component asks for, and where it stands.
pub(crate) struct Wanted {
    /// The keyword.
    pub keyword: &'static str,
    /// Its place; `None` for `supervise`, which cannot be exchanged for another keyword.
    pub span: Option<Span>,
}

impl Context<'_> {
    /// What `reference` names; reports when there is nothing, too much, or the wrong thing.
    pub fn callee(
        &self,
        reference: &Ref,
        wanted: &Wanted,
        diags: &mut Diagnostics,
    ) -> Option<Signature> {
        let name = reference.name()?;
        let home = reference.home();
        let mut found = self.candidates(&name, home.as_ref());
        // The keyword decides between a plan and a template of the same name.
        if found.iter().any(|(_, each)| each.kind.keyword() == wanted.keyword) {
            found.retain(|(_, each)| each.kind.keyword() == wanted.keyword);
        }
        if found.len() > 1 {
            diags.push(ambiguous(&name, reference.span(), &found));
            return None;
        }
        let Some((_, signature)) = found.pop() else {
            // It may be in the toolbox that is missing.
            if self.types.incomplete && wanted.keyword != "subplan" {
                return None;
            }
            diags.push(self.not_found(&name, home.as_ref(), reference.span(), wanted));
            return None;
        };
        if signature.kind.keyword() == wanted.keyword {
            return Some(signature);
        }
        diags.push(unfit(&signature, reference.span(), wanted));
        None
    }

    /// Everything of that name, each with how it is written in full.
    fn candidates(&self, name: &Name, home: Option<&Name>) -> Vec<(String, Signature)> {
        let mut found = Vec::new();
        if home.is_none() {
            let plans = self.plans.iter().enumerate();
            let named = plans.filter(|(_, head)| {
                head.name.as_ref().is_some_and(|known| known.text == name.text)
            });
            // A plan declared twice is reported where it is declared.
            let first = named.take(1);
            found.extend(first.map(|(at, head)| (name.text.clone(), Signature::of_plan(at, head))));
        }
        for (place, import) in self.imports.iter().enumerate() {
            if home.is_some_and(|home| home.text != import.qualifier) {
                continue;
            }
            let templates = &import.toolbox.templates;
            let Some(index) = templates.iter().position(|each| each.name == name.text) else {
                continue;
            };
            if let (Ok(place), Ok(index)) = (u16::try_from(place), u16::try_from(index)) {
                let id = TemplateId { toolbox: ToolboxId(place), index };
                let full = qualified(Some(&import.qualifier), &name.text);
                found.push((full, Signature::of_template(import.toolbox.clone(), id)));
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
            && !self.imports.iter().any(|import| import.qualifier == home.text)
        {
            let known = self.imports.iter().map(|import| import.qualifier.as_str());
            let message = format!("no toolbox is used as '{}'", home.text);
            let none = format!("add 'use {}' at the top of the file", home.text);
            return unknown(Code::E0201, home.span, message, &home.text, known, &none);
        }
        let message = match wanted.keyword {
            "subplan" => format!("there is no plan '{}'", name.text),
            _ => format!("there is no template '{}'", name.text),
        };
        let others = self
            .toolboxes
            .iter()
            .filter(|toolbox| toolbox.templates.iter().any(|template| template.name == name.text));
        if let Some(other) = others.into_iter().next() {
            let line = format!("use {}", other.name);
            return Diagnostic::new(Code::E0201, span, message)
                .help(format!("add '{line}' at the top of the file"))
                .fix(self.top, format!("{line}\n"));
        }
        let templates = self.imports.iter().flat_map(|import| &import.toolbox.templates);
        let fitting = templates
            .filter(|template| SignatureKind::Template(template.kind).keyword() == wanted.keyword);
        let mut known: Vec<&str> = fitting.map(|template| template.name.as_str()).collect();
        if wanted.keyword == "subplan" {
            known = self
                .plans
                .iter()
                .filter_map(|head| Some(head.name.as_ref()?.text.as_str()))
                .collect();
        }
        known.sort_unstable();
        known.dedup();
        unknown(
            Code::E0201,
            span,
            message,
            &name.text,
            known,
            "add 'use carbot' or another toolbox at the top of the file",
        )
    }
}

fn ambiguous(name: &Name, span: Span, found: &[(String, Signature)]) -> Diagnostic {
    let full = words::list(found.iter().map(|(full, _)| full.as_str()), "or");
    Diagnostic::new(Code::E0237, span, format!("several toolboxes have a template '{}'", name.text))
        .help(format!("write {full}"))
}

fn unfit(signature: &Signature, span: Span, wanted: &Wanted) -> Diagnostic {
    let name = &signature.name;
    let right = signature.kind.keyword();
    let message = format!("'{name}' is {}", signature.kind.describe());
    let supervisor = signature.kind == SignatureKind::Template(TemplateKind::Supervisor);
    match wanted.span {
        Some(keyword) if !supervisor => Diagnostic::new(Code::E0217, keyword, message)
            .note(span, "used here")
            .help(format!("write '{right}'"))
            .replace(right),
        Some(keyword) => Diagnostic::new(Code::E0217, keyword, message)
            .note(span, "used here")
            .help("attach it to an actor with 'supervise', or name an actor's template"),
        None => Diagnostic::new(Code::E0217, span, message)
            .help("name a supervisor's template, or use it as an element of the plan"),
    }
}
