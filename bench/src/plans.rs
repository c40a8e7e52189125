//! The plans of the benchmarks, compiled in and loaded.

use afp::load::{LoadedPlan, Registry};
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_syntax::source::Source;

use crate::board::{Board, templates};

pub mod step {
    //! Four guards and a running action.
    afp_macros::plan!("plans/step.afp", toolboxes = { "toolbox/board.afp" => crate::board });
}

pub mod suspending {
    //! As `step`, with a suspension that no event takes.
    afp_macros::plan!("plans/suspending.afp", toolboxes = { "toolbox/board.afp" => crate::board });
}

pub mod transition {
    //! Two actors that hand over to each other.
    afp_macros::plan!("plans/transition.afp", toolboxes = { "toolbox/board.afp" => crate::board });
}

pub mod wall_following {
    //! The plan of the paper.
    afp_macros::plan!("../plans/wall_following.afp");
}

pub mod navigate_room {
    //! Drives to another room, with localisation.
    afp_macros::plan!("../plans/navigate_room.afp");
}

pub mod find_object {
    //! Drives to an object, with the camera.
    afp_macros::plan!("../plans/find_object.afp");
}

/// The plan of [`step`], interpreted.
pub fn loaded_step() -> LoadedPlan<Board> {
    load(include_str!("../plans/step.afp"))
}

/// The plan of [`transition`], interpreted.
pub fn loaded_transition() -> LoadedPlan<Board> {
    load(include_str!("../plans/transition.afp"))
}

fn load(text: &str) -> LoadedPlan<Board> {
    let mut toolboxes = Toolboxes::default();
    toolboxes.add(Source::new("board.afp", templates::SOURCE), "crate::board");
    let compiled = afp_dsl::compile(&Source::new("plan.afp", text), &toolboxes, &Texts::default());
    let graph = compiled.graph.as_ref().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let mut registry = Registry::new();
    templates::register(&mut registry);
    LoadedPlan::new(graph, &registry).unwrap_or_else(|why| panic!("{why}"))
}
