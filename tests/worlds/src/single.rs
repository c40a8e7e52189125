//! Single permanent faults: every fault of every device, in every shipped plan and many rooms.

use std::collections::BTreeMap;
use std::fmt::Write;

use afp_carbot::table::{Carbot, TABLE};
use afp_core::devices::{Devices, faults};
use afp_core::trace::Ending;
use afp_core::{Duration, Instant};
use afp_sim::{Fault, World};

use crate::case::Case;
use crate::chance::{Chance, Stimulus};
use crate::drive::Outcome;
use crate::plans::{Plan, plans};

/// The start of the fault.
const FROM: Instant = Instant::from_nanos(5_000_000_000);
/// The end of a run.
const UNTIL: Instant = Instant::from_nanos(60_000_000_000);
/// The longest time that a robot should push against an obstacle in a run; much longer is a
/// failure.
const LONG: Duration = Duration::from_secs(1);
const TOO_LONG: Duration = Duration::from_secs(3);

/// The reasons of a blocked robot, for any fault: an obstacle, or a plan that gave up.
const BLOCKED: [&str; 4] = ["drive-blocked", "drive-stalled", "failed", "no-progress"];

/// A shipped plan in a room, with one permanent fault or none.
#[derive(Clone, Debug)]
pub struct Single {
    /// The plan, in the room, with the fault.
    pub case: Case,
    /// The device and its fault; empty for a run without a fault.
    pub fault: (&'static str, &'static str),
}

impl Single {
    /// All runs of every shipped plan, with every fault and without one, in rooms `0..rooms`.
    pub fn all(rooms: u64) -> Vec<Single> {
        let mut all = Vec::new();
        for plan in plans().iter().filter(|plan| plan.shipped) {
            for room in 0..rooms {
                let world = World::random(room);
                all.push(Single::new(plan, &world, room, ("", ""), None));
                for (id, device, row) in faults(TABLE) {
                    let fault = Carbot::fault(id, None);
                    all.push(Single::new(plan, &world, room, (device.name, row.name), fault));
                }
            }
        }
        all
    }

    fn new(
        plan: &'static Plan,
        world: &World,
        room: u64,
        name: (&'static str, &'static str),
        fault: Option<Fault>,
    ) -> Single {
        let breaks = fault.map(|fault| (FROM, Stimulus::Break(fault, Duration::MAX)));
        let chance = Chance(breaks.into_iter().collect());
        let case = Case { chance, until: UNTIL, ..Case::quiet(plan, world.clone(), room) };
        Single { case, fault: name }
    }

    /// The objections to its ending, usually none.
    pub fn objections(&self, outcome: &Outcome) -> Vec<String> {
        let mut wrong: Vec<String> =
            outcome.broken.iter().map(|(at, why)| format!("{at}: {why}")).collect();
        if outcome.seen.pushing > TOO_LONG {
            wrong.push(format!("it pushed for {}", outcome.seen.pushing));
        }
        if let Some(Ending::Error(fault)) = outcome.ending
            && !self.explains(fault.code())
        {
            wrong.push(format!("it ended with '{}'", fault.code()));
        }
        wrong
    }

    /// Whether the robot pushed for too long: it may slide along a low obstacle at its side that
    /// its sensors do not show.
    pub fn pushes_long(&self, outcome: &Outcome) -> bool {
        // A plan that feels its way touches several obstacles, also with a dead bumper, so
        // `TOO_LONG` applies.
        let feels =
            ["avoid_obstacle", "find_object", "patrol"].contains(&self.case.plan.name.as_str());
        !feels && outcome.seen.pushing > LONG
    }

    /// Whether this fault can cause a reason.
    fn explains(&self, code: &str) -> bool {
        let (device, kind) = self.fault;
        let silent = match (device, kind) {
            // Repeated silence looks like a rotator that does not move.
            ("ultrasonic", "frozen") if code == "stuck-rotator" => code,
            ("ultrasonic", "frozen") => "frozen-range",
            ("ultrasonic", _) => "no-range",
            ("rotator", _) => "stuck-rotator",
            ("controller", "restarted") => "controller-restarted",
            // Several sensors are silent.
            ("controller", "stalled") if code.starts_with("no-") => code,
            ("odometry" | "controller", _) => "no-odometry",
            ("touch", _) => "no-touch",
            ("buttons", _) => "no-button",
            ("infrared", "frozen") => "frozen-infrared",
            ("infrared", _) => "no-infrared",
            ("color", _) => "no-color",
            ("battery", _) => "no-battery",
            ("camera", _) if code == "no-picture" => code,
            ("camera", _) => "no-flow",
            _ => "",
        };
        code == silent || BLOCKED.contains(&code)
    }
}

/// The endings of all runs by fault and plan.
#[derive(Debug, Default)]
pub struct Account(BTreeMap<(String, String), Row>);

/// The runs of one plan with one fault.
#[derive(Debug, Default)]
struct Row {
    endings: BTreeMap<String, usize>,
    contacts: usize,
    pushing: Duration,
    longest: Duration,
}

impl Account {
    pub fn add(&mut self, single: &Single, outcome: &Outcome) {
        let (device, kind) = single.fault;
        let fault = if device.is_empty() { "none".to_owned() } else { format!("{device}.{kind}") };
        let row = self.0.entry((single.case.plan.name.clone(), fault)).or_default();
        let ending = match outcome.ending {
            None => "still running",
            Some(Ending::Ok) => "ok",
            Some(Ending::Interrupted) => "interrupted",
            Some(Ending::Error(fault)) => fault.code(),
        };
        *row.endings.entry(ending.to_owned()).or_default() += 1;
        row.contacts += outcome.contacts.len();
        row.pushing += outcome.seen.pushing;
        row.longest = row.longest.max(outcome.seen.pushing);
    }

    /// The account as Markdown tables, one for each plan.
    pub fn markdown(&self) -> String {
        let mut text = String::new();
        let mut last = "";
        for ((plan, fault), row) in &self.0 {
            if plan != last {
                let _ = write!(text, "\n## `{plan}`\n\n");
                text +=
                    "| fault | endings | contacts | pushing | longest |\n|---|---|--:|--:|--:|\n";
                last = plan;
            }
            let endings: Vec<_> =
                row.endings.iter().map(|(ending, count)| format!("{count} {ending}")).collect();
            let (all, longest) = (row.pushing.as_secs_f64(), row.longest.as_secs_f64());
            let endings = endings.join(", ");
            let _ = writeln!(
                text,
                "| `{fault}` | {endings} | {} | {all:.1} s | {longest:.1} s |",
                row.contacts
            );
        }
        text
    }
}
