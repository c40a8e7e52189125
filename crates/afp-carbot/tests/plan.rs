//! The plan of the paper compiles against the toolbox and requires its templates' traits.

mod plan {
    afp_macros::plan!("../../plans/wall_following.afp");
}

use afp_carbot::Carbot;
use afp_core::quantity::Length;
use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{ComponentId, Names, Outcome};
use plan::WallFollowing;

/// Compiles only if every Carbot can run the plan.
pub fn runs_on_every_carbot<E: Carbot>() -> impl Plan<E> {
    WallFollowing::new()
}

#[test]
fn names_equal_the_names_in_the_file() {
    let mut plan = WallFollowing::new();
    let names = plan.names();
    assert_eq!(names.components(), 11);
    assert_eq!(names.component(ComponentId(9)).path, "searchFirstWall.checkLane");
    assert_eq!(names.target(ComponentId(3), Outcome::Declared(1)), "turnAfterWallLost");
    assert_eq!(plan.walldist(), None);
    plan.set_walldist(Length::from_si(0.25)).unwrap();
    assert_eq!(plan.walldist(), Some(Length::from_si(0.25)));
    assert!(plan.set_walldist(Length::from_si(f64::NAN)).is_err());
}
