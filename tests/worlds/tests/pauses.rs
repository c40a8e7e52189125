//! A plan that is paused five times ends where it ends without a pause, over several seeds of the
//! robot's noise. `AFP_PAUSES` sets their number.

use std::env;
use std::fmt::Write;

use afp_core::trace::Ending;
use afp_core::{Duration, Instant};
use afp_sim::{Pose, World};
use afp_worlds::{Case, Chance, Outcome, Plan, Stimulus, plan_of, run};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// The default number of seeds.
const SEEDS: u64 = 8;
/// The pauses of a run. Each begins and ends with a click.
const PAUSES: u32 = 5;
const LONG: Duration = Duration::from_secs(3);
const CLICK: Duration = Duration::from_millis(40);
/// The longest run.
const UNTIL: Duration = Duration::from_secs(120);
/// The largest distance between the mean ends, in metres and degrees.
const FAR: f64 = 0.02;
const WIDE: f64 = 2.0;
/// The largest spread with pauses, relative to the spread without. Samples of equal spread stay
/// below with a probability of 95 %.
const SPREAD: f64 = 1.3;

const ROOM: &str = "
version = 1
name = \"Empty room\"

[robot]
pose_m_deg = [1.5, 1.5, 0.0]

[[wall]]
name = \"room\"
points_m = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]]
closed = true
";

/// The templates that are paused, each in a plan with the elements that lead to it.
const WALKS: [(&str, &str); 5] = [
    ("Forward", "actor a: Forward(distance = 2 m) { ForwardSuccessful -> terminate }"),
    ("Turn", "actor a: Turn(angle = 330 deg) { TurnSuccessful -> terminate }"),
    ("Curve", "actor a: Curve(radius = 80 cm, angle = 150 deg) { CurveSuccessful -> terminate }"),
    (
        "square",
        "actor a: Forward(distance = 80 cm) { ForwardSuccessful -> turn }
    actor turn: Turn(angle = 90 deg) { TurnSuccessful -> b }
    actor b: Forward(distance = 60 cm) { ForwardSuccessful -> back }
    actor back: Retrace(distance = 30 cm) { Retraced -> terminate }",
    ),
    (
        "wall",
        "actor a: Turn(angle = -90 deg) { TurnSuccessful -> near }
    actor near: Forward(distance = 90 cm) { ForwardSuccessful -> along }
    actor along: Turn(angle = 90 deg) { TurnSuccessful -> follow }
    actor follow: WallForward(walldist = 40 cm, step = 2 m) {
        ForwardSuccessful -> terminate
        LaneNotFree       -> fail
        WallLost          -> fail
    }",
    ),
];

fn plan(name: &str, elements: &str) -> &'static Plan {
    let text = format!(
        "use carbot

plan Walk {{
    start a
    supervise button: CheckTouchSensorClick {{ TouchSensorClicked -> suspend pause }}
    {elements}
    actor pause: Hold {{ on button {{ TouchSensorClicked -> return }} }}
}}
"
    );
    Box::leak(Box::new(plan_of(name, &text)))
}

/// The clicks of pauses that divide a time without pauses.
fn clicks(lasting: Duration, seed: u64) -> Chance {
    let mut stimuli = Vec::new();
    for pause in 0..PAUSES {
        // Not at the same times for every seed.
        let share = (f64::from(pause) + 0.1 + 0.08 * (seed % 10) as f64) / f64::from(PAUSES);
        let begin =
            Duration::from_secs_f64(lasting.as_secs_f64() * share) + LONG * u64::from(pause);
        for at in [begin, begin + LONG] {
            let at = Instant::ZERO + at;
            stimuli.push((at, Stimulus::Bump(true)));
            stimuli.push((at + CLICK, Stimulus::Bump(false)));
        }
    }
    Chance(stimuli)
}

/// The ends of all seeds, in metres and degrees: without and with pauses.
fn ends(plan: &'static Plan, seeds: u64) -> [Vec<[f64; 3]>; 2] {
    let world = World::parse(ROOM).expect("the room is well-formed");
    let case = |seed, chance| Case {
        chance,
        until: Instant::ZERO + UNTIL,
        ..Case::quiet(plan, world.clone(), seed)
    };
    let both = |seed| {
        let still = run(&case(seed, Chance::default()));
        let lasting = still.at.since(Instant::ZERO);
        let paused = run(&case(seed, clicks(lasting, seed)));
        let pauses = paused.timeline.matches(" -> suspend pause").count();
        assert!(pauses >= 4, "{} seed {seed}: {pauses} pauses\n{}", plan.name, paused.timeline);
        [end(plan, seed, &still), end(plan, seed, &paused)]
    };
    let all: Vec<_> = (0..seeds).into_par_iter().map(both).collect();
    [0, 1].map(|of| all.iter().map(|pair| pair[of]).collect())
}

fn end(plan: &Plan, seed: u64, outcome: &Outcome) -> [f64; 3] {
    let text = &outcome.timeline;
    assert_eq!(outcome.ending, Some(Ending::Ok), "{} seed {seed}\n{text}", plan.name);
    let Pose { x, y, heading } = outcome.pose;
    // From -225 deg to 135 deg: no plan ends near these headings.
    [x, y, (heading.to_degrees() + 225.0).rem_euclid(360.0) - 225.0]
}

/// The mean, and the root mean square of the distances from it: of the places, and of the headings.
fn spread(ends: &[[f64; 3]]) -> ([f64; 3], [f64; 2]) {
    let count = ends.len() as f64;
    let mean = [0, 1, 2].map(|of| ends.iter().map(|end| end[of]).sum::<f64>() / count);
    let square =
        |of: usize| ends.iter().map(|end| (end[of] - mean[of]).powi(2)).sum::<f64>() / count;
    (mean, [(square(0) + square(1)).sqrt(), square(2).sqrt()])
}

#[test]
fn five_pauses_end_where_an_uninterrupted_run_ends() {
    let seeds = env::var("AFP_PAUSES").map_or(SEEDS, |count| count.parse().expect("a number"));
    let (mut report, mut wrong) = (String::new(), Vec::new());
    for (name, elements) in WALKS {
        let [still, paused] = ends(plan(name, elements), seeds);
        let ((from, spread_still), (to, spread_paused)) = (spread(&still), spread(&paused));
        let far = (to[0] - from[0]).hypot(to[1] - from[1]);
        let wide = (to[2] - from[2]).abs();
        let ([a, b], [c, d]) = (spread_still, spread_paused);
        let _ = writeln!(
            report,
            "{name}: the mean is off by {:.1} mm and {wide:.2} deg; spread {:.1} mm and {b:.2} deg, \
             with pauses {:.1} mm and {d:.2} deg",
            far * 1e3,
            a * 1e3,
            c * 1e3,
        );
        // Below a millimetre and a tenth of a degree, the last poll causes the spread.
        let spreads = c <= SPREAD * a.max(0.001) && d <= SPREAD * b.max(0.1);
        if far > FAR || wide > WIDE || seeds >= 50 && !spreads {
            wrong.push(name);
        }
    }
    println!("{seeds} seeds, {PAUSES} pauses each\n{report}");
    assert!(wrong.is_empty(), "{wrong:?}\n{report}");
}
