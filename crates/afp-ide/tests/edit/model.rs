//! The content of a text, without its format.

use std::ops::Range;

use afp_ide::edit::Change;
use afp_syntax::ast::{self, Bind, ElementKind};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::item::Item;
use afp_syntax::source::Span;
use afp_syntax::{kind::Kind, parse};

#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub plans: Vec<Plan>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub name: String,
    pub entries: Vec<Entry>,
    pub starts: Vec<(String, Place)>,
    pub guards: Vec<Component>,
    pub elements: Vec<Component>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    pub keyword: String,
    pub name: String,
    pub ty: Option<String>,
    pub value: Option<Text>,
    pub place: Place,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    pub kind: Option<ElementKind>,
    pub name: String,
    pub template: String,
    /// Port, and sign with value.
    pub binds: Vec<(String, Text, Place)>,
    pub timings: Vec<(String, String)>,
    pub guards: Vec<Component>,
    pub edges: Vec<(String, String, Place)>,
    pub place: Place,
}

/// The words of a formula or output.
pub type Text = Vec<String>;

/// The place of a part; all places are equal.
#[derive(Clone, Debug, Default)]
pub struct Place(pub Range<usize>);

impl PartialEq for Place {
    fn eq(&self, _: &Place) -> bool {
        true
    }
}

pub fn comments(text: &str) -> Vec<(usize, String)> {
    let root = parse(text, 0, &mut Diagnostics::default()).root();
    let tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
    tokens
        .filter(|token| matches!(token.kind(), Kind::Comment | Kind::Doc))
        .map(|token| (token.text_range().start().into(), token.text().trim_end().to_owned()))
        .collect()
}

impl Model {
    pub fn of(text: &str) -> Model {
        let parse = parse(text, 0, &mut Diagnostics::default());
        let tokens = parse.root().descendants_with_tokens().filter_map(|each| each.into_token());
        let solid = tokens.filter(|token| !token.kind().is_trivia());
        let words = solid.map(|token| (token.text_range().start().into(), token.text().to_owned()));
        let words = Words(words.collect());
        let file = parse.file();
        let plans = file.items().into_iter().filter_map(|item| match item {
            ast::Item::Plan(plan) => Some(plan),
            _ => None,
        });
        Model { plans: plans.map(|plan| self::plan(&plan, &words)).collect() }
    }

    /// The model with elements and entries sorted by name.
    pub fn sorted(mut self) -> Model {
        for plan in &mut self.plans {
            plan.elements.sort_by(|a, b| a.name.cmp(&b.name));
            plan.entries.sort_by(|a, b| a.name.cmp(&b.name));
        }
        self
    }

    pub fn plan(&mut self, name: &str) -> &mut Plan {
        self.plans.iter_mut().find(|plan| plan.name == name).unwrap()
    }

    pub fn component(&mut self, item: &Item) -> Option<&mut Component> {
        let plan = self.plan(item.plan_name());
        match item {
            Item::Local { owner, name, .. } => {
                let owner = plan.elements.iter_mut().find(|element| element.name == *owner)?;
                owner.guards.iter_mut().find(|guard| guard.name == *name)
            }
            _ => {
                let mut all = plan.elements.iter_mut().chain(&mut plan.guards);
                all.find(|component| component.name == item.name())
            }
        }
    }

    /// The places of the parts that a change removes.
    pub fn removed_by(mut self, change: &Change) -> Vec<Range<usize>> {
        let mut places = Vec::new();
        match change {
            Change::Disconnect { from, outcome } => {
                let component = self.component(from).unwrap();
                places.extend(
                    component.edges.iter().filter(|e| e.0 == *outcome).map(|e| e.2.0.clone()),
                );
            }
            Change::Unbind { component, port } => {
                let component = self.component(component).unwrap();
                places
                    .extend(component.binds.iter().filter(|b| b.0 == *port).map(|b| b.2.0.clone()));
            }
            Change::Remove { item } => {
                places.extend(self.component(item).map(|component| component.place.0.clone()));
                let plan = self.plan(item.plan_name());
                let entries = plan.entries.iter().filter(|entry| entry.name == item.name());
                places.extend(entries.map(|entry| entry.place.0.clone()));
                for component in plan.components() {
                    let edges = component.edges.iter().filter(|edge| edge.1 == item.name());
                    places.extend(edges.map(|edge| edge.2.0.clone()));
                    let binds = component.binds.iter().filter(|bind| {
                        bind.1.first().is_some_and(|sign| sign == "=>") && bind.1[1] == item.name()
                    });
                    places.extend(binds.map(|bind| bind.2.0.clone()));
                }
                let starts = plan.starts.iter().filter(|start| start.0 == item.name());
                places.extend(starts.map(|start| start.1.0.clone()));
                let users = self.plans.iter().flat_map(|plan| &plan.elements);
                for user in users.filter(|user| user.template == item.plan_name()) {
                    let ports = user.binds.iter().filter(|bind| bind.0 == item.name());
                    places.extend(ports.map(|bind| bind.2.0.clone()));
                }
            }
            _ => {}
        }
        places
    }
}

impl Plan {
    /// All components, local supervisors included.
    pub fn components(&self) -> Vec<&Component> {
        let outer = self.elements.iter().chain(&self.guards);
        outer.flat_map(|one| std::iter::once(one).chain(&one.guards)).collect()
    }

    /// Changes all components, including local supervisors.
    pub fn change_all(&mut self, mut change: impl FnMut(&mut Component)) {
        for one in self.elements.iter_mut().chain(&mut self.guards) {
            change(one);
            one.guards.iter_mut().for_each(&mut change);
        }
    }
}

fn plan(plan: &ast::Plan, words: &Words) -> Plan {
    Plan {
        name: plan.name().unwrap().text,
        entries: plan.entries().iter().map(|entry| self::entry(entry, words)).collect(),
        starts: plan.starts().iter().map(start).collect(),
        guards: plan.guards().iter().map(|each| guard(each, words)).collect(),
        elements: plan.elements().iter().map(|each| element(each, words)).collect(),
    }
}

fn start(start: &ast::Start) -> (String, Place) {
    (start.target().unwrap().text, place(start.span()))
}

fn entry(entry: &ast::Entry, words: &Words) -> Entry {
    Entry {
        keyword: entry.keyword(),
        name: entry.name().unwrap().text,
        ty: entry.ty().map(|ty| words.of(ty.span()).concat()),
        value: entry.init().map(|value| words.of(value.span())),
        place: place(entry.span()),
    }
}

fn element(element: &ast::Element, words: &Words) -> Component {
    Component {
        kind: Some(element.kind()),
        name: element.name().unwrap().text,
        template: words.of(element.template().unwrap().span()).concat(),
        binds: element.binds().iter().map(|each| bind(each, words)).collect(),
        timings: Vec::new(),
        guards: element.guards().iter().map(|each| guard(each, words)).collect(),
        edges: element.edges().iter().flat_map(edge).collect(),
        place: place(element.span()),
    }
}

fn guard(guard: &ast::Guard, words: &Words) -> Component {
    let timing = |timing: &ast::Timing| {
        (timing.keyword().unwrap().text, words.of(timing.value().unwrap().span()).join(" "))
    };
    Component {
        kind: None,
        name: guard.name().unwrap().text,
        template: words.of(guard.template().unwrap().span()).concat(),
        binds: guard.binds().iter().map(|each| bind(each, words)).collect(),
        timings: guard.timings().iter().map(timing).collect(),
        guards: Vec::new(),
        edges: guard.edges().iter().flat_map(edge).collect(),
        place: place(guard.span()),
    }
}

fn bind(bind: &Bind, words: &Words) -> (String, Text, Place) {
    let (port, sign, value) = match bind {
        Bind::In { port, formula, .. } => (port, "=", formula.as_ref().unwrap().span()),
        Bind::Out { port, entry, .. } => (port, "=>", entry.as_ref().unwrap().span),
    };
    let mut value_words = words.of(value);
    value_words.insert(0, sign.to_owned());
    (port.text.clone(), value_words, place(port.span.to(value)))
}

fn edge(edge: &ast::Edge) -> Vec<(String, String, Place)> {
    let reason = edge.reason.as_ref().map(|reason| format!(" {}", reason.text));
    let target = edge.target.clone().unwrap().text + &reason.unwrap_or_default();
    let each = |name: ast::Name| (name.text, target.clone(), place(edge.span().unwrap()));
    edge.names.iter().cloned().map(each).collect()
}

fn place(span: Span) -> Place {
    Place(span.start as usize..span.end as usize)
}

/// The solid tokens, with their places.
struct Words(Vec<(u32, String)>);

impl Words {
    /// The tokens in a place.
    fn of(&self, span: Span) -> Text {
        let start = self.0.partition_point(|(place, _)| *place < span.start);
        let rest = self.0[start..].iter();
        rest.take_while(|(place, _)| *place < span.end).map(|(_, word)| word.clone()).collect()
    }
}
