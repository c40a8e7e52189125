//! The palette of a plan: templates of all toolboxes and visible plans, each with its text.

use crate::View;
use crate::completion::Piece;
use crate::completion::bodies::{body_of_plan, body_of_template, component, instance_name};
use crate::describe::{component_kind, declaration};
use crate::edit::Taken;
use afp_dsl::index::{DefinitionId, DefinitionKind};
use afp_dsl::outline::ComponentKind;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    pub name: String,
    /// The usual name of a new item of it.
    pub instance: String,
    pub kind: ComponentKind,
    /// Its toolbox; `None` for a plan and for a computation of a plan file.
    pub toolbox: Option<String>,
    pub icon: Option<String>,
    pub help: String,
    pub ports: Vec<String>,
    pub exits: Vec<String>,
    /// The text of the item, with placeholders for its name, its required inputs and its targets.
    pub insert: Vec<Piece>,
    /// The toolbox to import first.
    pub missing_use: Option<String>,
}

/// Returns all offers whose name and help contain every word of `query`, best first: prefixes of
/// names before other matches in names before matches in help, and then visible offers before
/// others. Templates of another robot are offered only if the file uses its toolbox.
pub fn palette(view: &View, query: &str) -> Vec<Offer> {
    let query = query.to_lowercase();
    let words: Vec<_> = query.split_whitespace().collect();
    let joined = words.concat();
    let is_offered = |kind| matches!(kind, DefinitionKind::Template(_) | DefinitionKind::Plan);
    let visible = view.index().visible(view.file, 0, is_offered);
    let mut ranked: Vec<(u8, Offer)> = Vec::new();
    for (id, definition) in view.index().definitions() {
        let seen = visible.contains(&id);
        let offer = match definition.kind {
            DefinitionKind::Template(_) => of_template(view, id, seen),
            DefinitionKind::Plan if seen => of_plan(view, id),
            _ => None,
        };
        let Some(offer) = offer else { continue };
        let (name, help) = (offer.name.to_lowercase(), offer.help.to_lowercase());
        let fit = match () {
            () if name.starts_with(&joined) => 0,
            () if name.contains(&joined) => 1,
            () if words.iter().all(|word| name.contains(word) || help.contains(word)) => 2,
            () => continue,
        };
        ranked.push((2 * fit + u8::from(!seen), offer));
    }
    ranked.sort_by(|(a, one), (b, other)| (a, &one.name).cmp(&(b, &other.name)));
    ranked.into_iter().map(|(_, offer)| offer).collect()
}

fn of_template(view: &View, id: DefinitionId, seen: bool) -> Option<Offer> {
    let definition = view.index().definition(id);
    let (toolbox, template) = view.template(definition)?;
    if !seen && view.toolboxes.is_of_another_robot(toolbox) {
        return None;
    }
    let kind = component_kind(template.kind);
    Some(Offer {
        name: template.name.clone(),
        instance: instance_name(&template.name, &Taken::default()),
        kind,
        toolbox: toolbox.is_named().then(|| toolbox.name.clone()),
        icon: template.icon.clone(),
        help: template.doc.clone(),
        ports: ports(view, id),
        exits: template.outcomes.iter().map(|outcome| outcome.name.clone()).collect(),
        insert: item(kind, &template.name, body_of_template(template)),
        missing_use: (!seen).then(|| toolbox.name.clone()),
    })
}

fn of_plan(view: &View, id: DefinitionId) -> Option<Offer> {
    let definition = view.index().definition(id);
    let plan = view.outline().plans.iter().find(|plan| plan.span == definition.span)?;
    let name = view.name_of(id).to_owned();
    let interrupted = plan.interruptible.then(|| "Interrupted".to_owned());
    Some(Offer {
        instance: instance_name(&name, &Taken::default()),
        kind: ComponentKind::SubPlan,
        toolbox: None,
        icon: None,
        help: plan.doc.clone(),
        ports: ports(view, id),
        exits: std::iter::once("OK".to_owned()).chain(interrupted).collect(),
        insert: item(ComponentKind::SubPlan, &name, body_of_plan(view, plan)),
        missing_use: None,
        name,
    })
}

fn ports(view: &View, id: DefinitionId) -> Vec<String> {
    use DefinitionKind::{Entry, Input, Output};
    use afp_dsl::graph::EntryKind::{In, Out};

    let is_port = |kind| matches!(kind, Input | Output | Entry(In | Out));
    let members = view.index().members(id).filter(|(_, member)| is_port(member.kind));
    members.map(|(id, _)| declaration(view, id)).collect()
}

fn item(kind: ComponentKind, template: &str, body: Vec<Piece>) -> Vec<Piece> {
    component(kind, &instance_name(template, &Taken::default()), template, &body)
}

#[cfg(test)]
mod tests {
    use super::palette;
    use crate::View;
    use afp_dsl::Toolboxes;
    use afp_dsl::compile;
    use afp_syntax::source::Source;

    const VACUUM: &str = include_str!("../../../examples/vacuum/vacuum.afp");

    /// Toolboxes name other words of a template in its help.
    #[test]
    fn templates_are_found_by_other_words() {
        let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        let compiled = compile(&Source::new("p.afp", "use carbot\n"), &toolboxes, &|_: &str| {
            Err(String::new())
        });
        let file = u16::try_from(compiled.plan_files.start).unwrap();
        let view = View::new(&compiled, &toolboxes, file);
        for (query, name) in [
            ("rotate", "Turn"),
            ("turn left", "Turn"),
            ("sleep", "Wait"),
            ("camera", "FindObject"),
            ("if", "Compare"),
            ("bump", "CheckTouchSensor"),
            ("line", "CheckLine"),
            ("touch sensor", "CheckTouchSensor"),
        ] {
            let found = palette(&view, query);
            assert!(found.iter().any(|offer| offer.name == name), "{query}: {name}");
        }
        // A name fits better than help, also if its toolbox has to be imported.
        for (query, name) in [("touch sensor", "CheckTouchSensor"), ("wait", "Wait")] {
            assert_eq!(palette(&view, query)[0].name, name);
        }
        assert!(palette(&view, "no such thing").is_empty());
    }

    /// A vacuum cleaner must not get a camera template.
    #[test]
    fn another_robots_templates_are_offered_only_if_they_are_used() {
        let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        toolboxes.add(Source::new("vacuum.afp", VACUUM), "vacuum");
        let offered = |toolboxes: &Toolboxes, plan: &str| {
            let compiled =
                compile(&Source::new("p.afp", plan), toolboxes, &|_: &str| Err(String::new()));
            let file = u16::try_from(compiled.plan_files.start).unwrap();
            let offers = palette(&View::new(&compiled, toolboxes, file), "");
            ["Roll", "Wait", "FindObject"].map(|name| offers.iter().any(|offer| offer.name == name))
        };
        assert_eq!(offered(&toolboxes, ""), [true; 3], "without a robot");
        toolboxes.set_robot("vacuum");
        assert_eq!(offered(&toolboxes, ""), [true, true, false]);
        assert_eq!(offered(&toolboxes, "use carbot\n"), [true; 3]);
    }
}
