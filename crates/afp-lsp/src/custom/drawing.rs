//! The drawing of a plan and its changes.

use std::cell::RefCell;
use std::sync::Arc;

use afp_draw::layout_file::Layout;
use afp_draw::{Options, Scene};
use afp_dsl::outline::{Outline, Plan, PlanId};
use afp_dsl::toolbox::Toolbox;
use afp_ide::edit::item;
use afp_syntax::item::Item;
use lsp_server::{Message, Notification};
use serde::Deserialize;
use serde_json::json;

use super::Document;
use super::scene::Facts;
use super::subscription::{Drawn, Subscription, plans};
use crate::answer::{Answer, Failure, ok};
use crate::server::Server;
use crate::uri;
use crate::workspace::{Analysis, Reads, Workspace};

/// A plan of a document.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Drawing {
    text_document: Document,
    /// Default: the first plan.
    plan: Option<String>,
    /// Elements drawn without details, or the start tag `Plan.start`. Unknown names are ignored.
    #[serde(default)]
    folded: Vec<String>,
    /// Whether the server sends later changes; `false` ends the subscription.
    subscribe: Option<bool>,
}

/// Returns the whole drawing. If the plan cannot be drawn, an older subscription continues.
pub(crate) fn drawing(server: &mut Server, params: Drawing) -> Answer {
    let path = uri::path(&params.text_document.uri);
    let known = server.subscriptions.remove(&path);
    let before =
        known.as_ref().filter(|known| known.plan == params.plan).map(|known| &*known.drawn.scene);
    let folded: Vec<_> = params.folded.iter().filter_map(|path| item(path)).collect();
    let drawn = match draw(server, &path, params.plan.as_deref(), &folded, before) {
        Ok(drawn) => drawn,
        Err(why) => {
            let known = known.filter(|_| params.subscribe != Some(false));
            server.subscriptions.extend(known.map(|known| (path, known)));
            return Err(why);
        }
    };
    let version = server.workspace.documents.get(&path).map(|document| document.version);
    let mut answer = drawn.shown().whole();
    drawn.tell(&mut answer, version);
    if params.subscribe.unwrap_or(known.is_some()) {
        server.subscriptions.insert(path, Subscription { plan: params.plan, folded, drawn });
    }
    ok(answer)
}

fn draw(
    server: &mut Server,
    path: &str,
    plan: Option<&str>,
    folded: &[Item],
    before: Option<&Scene>,
) -> Result<Drawn, Failure> {
    let analysis = server.workspace.analysis(path);
    let analysis = analysis.ok_or_else(no_file)?;
    let outline = &analysis.compiled.outline;
    let id = find(outline, analysis.file, plan)?;
    let mut reads = Reads::default();
    let positions = server.workspace.positions(&analysis, &mut reads);
    let reads = RefCell::new(reads);
    let icons = |toolbox: &Toolbox, name: &str| {
        server.workspace.icon(&analysis.set, toolbox, name, &mut reads.borrow_mut())
    };
    let options = Options {
        plan: id,
        icons: Some(&icons),
        positions: &positions,
        sub_plans: false,
        warnings: true,
        folded,
        ..Options::default()
    };
    let main: Option<&Plan> = id.map(|id| outline.plan(id));
    let scene = match main {
        Some(main) => {
            let name = main.item.name();
            let last = server.drawings.of(path, name);
            let scene = Arc::new(Scene::new(outline, &options, before.or(last.as_deref())));
            server.drawings.keep(path, name, &scene);
            scene
        }
        None => Arc::default(),
    };
    let address = |file| {
        let source = analysis.compiled.sources.get(file)?;
        Some(server.workspace.uri(&source.name).0)
    };
    let facts = main.map(|plan| Facts::new(plan, outline, folded, &address)).unwrap_or_default();
    let plans = plans(&analysis);
    let plan = main.map(|plan| plan.item.name().to_owned());
    let (analysis, reads) = (Arc::clone(&analysis), reads.into_inner());
    Ok(Drawn { scene, facts, plan, plans, analysis, reads })
}

/// The error for a document that is not a plan file.
pub(super) fn no_file() -> Failure {
    Failure::Refused("there is no such plan file".to_owned())
}

/// Finds a plan of a file by name; the default is the first one.
pub(super) fn find(
    outline: &Outline,
    file: u16,
    name: Option<&str>,
) -> Result<Option<PlanId>, Failure> {
    let mut own = (0..).map(PlanId).zip(&outline.plans).filter(|(_, plan)| plan.file() == file);
    match name {
        None => Ok(own.next().map(|(id, _)| id)),
        Some(name) => {
            let found = own.find(|(_, plan)| plan.item.name() == name).map(|(id, _)| id);
            let none = || Failure::Refused(format!("there is no plan '{name}'"));
            found.map(Some).ok_or_else(none)
        }
    }
}

impl Workspace {
    /// Returns the positions of a compilation's plans, by file.
    pub(crate) fn positions(&self, analysis: &Analysis, reads: &mut Reads) -> Vec<Layout> {
        let plan_files = analysis.compiled.plan_files.clone();
        let read = |(file, source): (usize, &afp_syntax::source::Source)| match plan_files
            .contains(&file)
        {
            true => reads.text(self, &format!("{}.layout", source.name)).unwrap_or_default(),
            false => String::new(),
        };
        let texts = analysis.compiled.sources.iter().enumerate().map(read);
        texts.map(|text| Layout::read(&text).0).collect()
    }
}

impl Server {
    pub(crate) fn changed_drawings(&mut self) -> Vec<Message> {
        let workspace = &mut self.workspace;
        let stale = |(path, known): (&String, &Subscription)| {
            (!known.drawn.is_current(workspace, path)).then(|| path.clone())
        };
        let stale: Vec<_> = self.subscriptions.iter().filter_map(stale).collect();
        stale.into_iter().filter_map(|path| self.changed_drawing(&path)).collect()
    }

    fn changed_drawing(&mut self, path: &str) -> Option<Message> {
        let mut known = self.subscriptions.remove(path)?;
        if let Some(analysis) = self.workspace.analysis(path) {
            known.follow(&analysis);
        }
        let drawn =
            draw(self, path, known.plan.as_deref(), &known.folded, Some(&known.drawn.scene));
        // A plan disappears while its name is being edited, and returns afterwards.
        let Ok(drawn) = drawn else {
            self.subscriptions.insert(path.to_owned(), known);
            return None;
        };
        let same_plans = drawn.plans == known.drawn.plans;
        let changed = drawn.shown().since(known.drawn.shown(), same_plans);
        let message = changed.map(|mut params| {
            let document = self.workspace.documents.get(path);
            params["textDocument"] = json!({ "uri": self.workspace.uri(path) });
            drawn.tell(&mut params, document.map(|document| document.version));
            Notification::new("afp/drawingChanged".to_owned(), params).into()
        });
        self.subscriptions.insert(path.to_owned(), Subscription { drawn, ..known });
        message
    }
}
