//! Pictures of runs as SVG: the path over the world, the echoes of the range sensor, the camera's
//! pictures, the times of a control loop.

mod canvas;
mod film;
mod legend;
mod marks;
mod sonar;
mod symbol;
mod times;

use afp_core::Instant;
use afp_core::trace::{ComponentId, ComponentKind, Names};
use afp_session::{AnyWorld, Drawing, Mark, Outlines, Pose2, RunEvent, Track, Waypoint};

use crate::LogNames;

use canvas::{Canvas, View};
pub use film::draw_film;
use legend::Legend;
pub use sonar::draw_sonar;
pub use times::{TimesRow, draw_times};

/// Nearer points of the path count as one, in metres.
const NEAR: f64 = 0.004;

/// An actor that moves less than this acts on the spot, in metres.
const SPOT: f64 = 0.05;

/// Colours of actors, distinguishable for colour-blind readers.
const PALETTE: [&str; 8] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#6a3d9a", "#56b4e9", "#7f7f7f"];
const NOBODY: &str = "#9a9a9a";

/// The contents of a picture.
#[derive(Debug)]
pub struct Picture<'a> {
    /// The room.
    pub world: &'a Drawing,
    /// Two lines above the legend.
    pub title: String,
    /// The second line.
    pub subtitle: String,
    /// The robot's path.
    pub path: &'a [Waypoint],
    /// The events on the path.
    pub marks: &'a [Mark],
    /// Names and values below the legend.
    pub figures: Vec<(String, String)>,
}

/// Current state of a run.
#[derive(Clone, Copy, Debug)]
pub struct SoFar<'a> {
    /// The plan's name.
    pub plan: &'a str,
    /// The world.
    pub world: &'a dyn AnyWorld,
    /// The seed, as text.
    pub seed: &'a str,
    /// The present time.
    pub time: Instant,
    /// The robot's path.
    pub path: &'a [Waypoint],
    /// The events on the path.
    pub marks: &'a [Mark],
    /// The positions of moving objects.
    pub things: &'a Outlines,
}

/// Draws a run's path over its world, up to now.
pub fn draw_run(run: &SoFar<'_>, names: &dyn Names) -> String {
    let SoFar { plan, world, seed, time, path, marks, things } = *run;
    let way = path.windows(2).map(|pair| {
        let (from, to) = (pair[0].pose, pair[1].pose);
        libm::hypot(to.x - from.x, to.y - from.y)
    });
    // An empty sum is a negative zero.
    let distance = way.fold(0.0, |all, piece| all + piece);
    let mut figures = vec![("time".to_owned(), format!("{:.1} s", time.as_secs_f64()))];
    // A robot without a pose signal has no path.
    if !path.is_empty() {
        figures.push(("distance".to_owned(), format!("{distance:.2} m")));
    }
    let subtitle = subtitle(world, seed);
    let world = &world.drawing().ended(things);
    draw(&Picture { world, title: plan.to_owned(), subtitle, figures, path, marks }, names)
}

/// Draws a world with the robot at its start.
pub fn draw_world(world: &dyn AnyWorld) -> String {
    let drawing = &world.drawing();
    let things = drawing.things.len();
    let subtitle = format!("{things} obstacle{}", if things == 1 { "" } else { "s" });
    let (title, figures) = (world.name().to_owned(), Vec::new());
    let picture = Picture { world: drawing, title, subtitle, figures, path: &[], marks: &[] };
    draw(&picture, &LogNames::default())
}

/// The line below the title.
fn subtitle(world: &dyn AnyWorld, seed: &str) -> String {
    format!("{}, seed {seed}", world.name())
}

/// Draws the path of a run.
pub fn draw(picture: &Picture<'_>, names: &dyn Names) -> String {
    let Picture { world, path, marks, .. } = picture;
    let (actors, known) = (actors(path), known_actors(path, names));
    let color = |actor: Option<ComponentId>| {
        let index = actor.and_then(|actor| known.iter().position(|known| *known == actor));
        index.map_or(NOBODY, |index| PALETTE[index % PALETTE.len()])
    };
    let view = View::around(bounds(world, path));
    let mut canvas = room(world, view);
    for thing in world.things.iter().filter(|thing| !thing.path.is_empty()) {
        canvas.way(&thing.path);
    }
    for light in &world.lights {
        canvas.light(*light);
    }
    let stretches = stretches(path);
    canvas.robot(&world.body, world.start, false);
    let whole: Vec<_> = stretches.iter().flat_map(|(_, points)| points.iter().copied()).collect();
    canvas.footprint(&world.body, &whole);
    for (actor, points) in &stretches {
        canvas.path(points, color(*actor));
    }
    let mut beside = 0;
    for (actor, points) in &stretches {
        // An actor that acts on the spot gets a dot next to the path.
        beside = if length(points) < SPOT { beside + 1 } else { 0 };
        if let (1.., Some(actor), Some(at)) = (beside, actor, points.last()) {
            canvas.dot(*at, beside, color(Some(*actor)));
        }
    }
    for thing in world.things.iter().filter(|thing| thing.labelled) {
        let (middle, size) = middle(thing.last());
        canvas.label(middle, size, &thing.name);
    }
    if let Some(last) = path.last() {
        canvas.robot(&world.body, last.pose, true);
    }
    let kinds = marks::kinds(marks, names);
    marks::draw(&mut canvas, marks, &kinds);
    canvas.scale_bar();
    let mut legend = Legend::new(view);
    legend.head(&picture.title, &picture.subtitle);
    // A world without a run has no results.
    if !picture.figures.is_empty() {
        legend.actors(actors.iter().map(|id| (names.component(*id).path, color(Some(*id)))));
        legend.events(marks::counted(marks, &kinds, names));
        legend.figures(&picture.figures);
    }
    canvas.finish(legend.finish())
}

/// The path with the actor at each point, and its events. `events` and `poses` are in the order of
/// time.
pub fn follow<'a>(
    events: impl IntoIterator<Item = &'a RunEvent>,
    poses: &[(Instant, Pose2)],
    names: &dyn Names,
) -> (Vec<Waypoint>, Vec<Mark>) {
    let mut track = Track::new(&[]);
    let mut poses = poses.iter().copied().peekable();
    for event in events {
        // At an instant, the robot's pose comes before the step.
        while let Some((at, pose)) = poses.next_if(|(at, _)| *at <= event.at) {
            track.note_pose(at, pose);
        }
        if let Some(record) = event.record() {
            track.note_record(event.at, &record, names);
        }
    }
    poses.for_each(|(at, pose)| track.note_pose(at, pose));
    (track.path, track.marks)
}

/// The floor with all objects, and the start of each object that has moved.
fn room(world: &Drawing, view: View) -> Canvas {
    let mut canvas = Canvas::new(view);
    canvas.floor();
    for patch in &world.patches {
        canvas.patch(&patch.corners, patch.color);
    }
    for thing in world.things.iter().filter(|thing| thing.end.is_some()) {
        canvas.obstacle(&thing.outline, thing.low, true);
    }
    for thing in &world.things {
        canvas.obstacle(thing.last(), thing.low, false);
    }
    canvas
}

/// The actors that ran, in the order of their first runs.
fn actors(path: &[Waypoint]) -> Vec<ComponentId> {
    let mut actors = Vec::new();
    for actor in path.iter().filter_map(|step| step.actor) {
        if !actors.contains(&actor) {
            actors.push(actor);
        }
    }
    actors
}

/// The actors with colours, in the order of the plan: all actors, so that each has the same colour
/// in every run. In a plan with more actors than colours, only those that ran.
fn known_actors(path: &[Waypoint], names: &dyn Names) -> Vec<ComponentId> {
    let is_actor = |id: &ComponentId| names.component(*id).kind == ComponentKind::Actor;
    let all: Vec<_> = (0..names.components()).map(ComponentId).filter(is_actor).collect();
    if all.len() <= PALETTE.len() {
        return all;
    }
    let mut ran = actors(path);
    ran.sort_unstable();
    ran
}

/// The path, cut at each change of the actor; neighbours share a point.
fn stretches(path: &[Waypoint]) -> Vec<(Option<ComponentId>, Vec<[f64; 2]>)> {
    let mut stretches: Vec<(Option<ComponentId>, Vec<[f64; 2]>)> = Vec::new();
    for step in path {
        let at = [step.pose.x, step.pose.y];
        match stretches.last_mut() {
            Some((actor, points)) if *actor == step.actor => {
                let far = points.last().is_none_or(|last| apart(*last, at) >= NEAR);
                if far {
                    points.push(at);
                }
            }
            last => {
                let from = last.and_then(|(_, points)| points.last().copied());
                stretches.push((step.actor, from.into_iter().chain([at]).collect()));
            }
        }
    }
    stretches
}

fn length(points: &[[f64; 2]]) -> f64 {
    points.windows(2).map(|pair| apart(pair[0], pair[1])).sum()
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// The corners of everything: lower left, upper right.
fn bounds(world: &Drawing, path: &[Waypoint]) -> [[f64; 2]; 2] {
    let outlines = world.things.iter().flat_map(|thing| [&*thing.outline, thing.last()]);
    let corners = outlines.flatten().copied();
    let path = path.iter().flat_map(|step| placed(&world.body, step.pose));
    let all = corners.chain(path).chain(placed(&world.body, world.start));
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for [x, y] in all {
        low = [low[0].min(x), low[1].min(y)];
        high = [high[0].max(x), high[1].max(y)];
    }
    [low, high]
}

fn placed(body: &[[f64; 2]], pose: Pose2) -> impl Iterator<Item = [f64; 2]> {
    // A robot without a known body is a point.
    let point = body.is_empty().then_some([pose.x, pose.y]);
    let corners = body.iter().map(move |[x, y]| {
        let corner = pose.beyond(Pose2 { x: *x, y: *y, heading: 0.0 });
        [corner.x, corner.y]
    });
    corners.chain(point)
}

fn middle(corners: &[[f64; 2]]) -> ([f64; 2], f64) {
    let count = corners.len() as f64;
    let sum = corners.iter().fold([0.0, 0.0], |sum, at| [sum[0] + at[0], sum[1] + at[1]]);
    let xs = || corners.iter().map(|at| at[0]);
    let width = xs().fold(f64::NEG_INFINITY, f64::max) - xs().fold(f64::INFINITY, f64::min);
    ([sum[0] / count, sum[1] / count], width)
}
