//! What the floor does to the body where wheels and castors stand on it.
//!
//! Each contact stops its slip as far as friction can hold, in every direction alike (the friction circle), and a
//! driven wheel along its way no further than its motor can: then the wheel turns as the floor lets it. All
//! push the same body, so what they do is found together: by projected Gauss-Seidel iteration that begins
//! with the step before (E. Catto, Iterative Dynamics with Temporal Coherence, GDC 2005). What else pushes the
//! body, boxes and walls, shows only afterwards in how it moves; the wheels hold against what it was last.

/// At most so many rounds over the contacts in a step; with what they remember, most steps take half of them.
const ROUNDS: usize = 12;
/// No contact has changed its mind by more than this in the last round, newton seconds: 2 um/s of the body.
const SETTLED: f64 = 1e-5;
/// What moves a body: it yields per kilogram, and per kilogram square metre. Rounds do not divide.
#[derive(Clone, Copy, Debug)]
struct Yielding {
    mass: f64,
    inertia: f64,
    per_mass: f64,
    per_inertia: f64,
}

/// How the body moves, in its own frame: ahead, to the left, turning.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// Ahead, metres a second.
    pub x: f64,
    /// To the left, metres a second.
    pub y: f64,
    /// Counter-clockwise, radians a second.
    pub turn: f64,
}

/// What pushes the body, in its own frame: newtons and newton metres about the centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Push {
    /// Ahead, newtons.
    pub x: f64,
    /// To the left, newtons.
    pub y: f64,
    /// Counter-clockwise, newton metres.
    pub turn: f64,
}

/// A place of the body that touches the floor.
#[derive(Clone, Debug)]
struct Contact {
    /// Ahead and to the left of the body's centre, metres.
    at: (f64, f64),
    /// The mass that it moves, at least, kilograms: in the direction in which the body yields most.
    mass: f64,
    /// What it did to the body in the step before, newton seconds.
    impulse: (f64, f64),
    /// Whether that was all that friction holds.
    slides: bool,
    /// Whether its motor could not do what it should.
    yields: bool,
}

/// What a contact wants and what it can do in a step.
#[derive(Clone, Copy, Debug)]
pub struct Demand {
    /// The velocity at which nothing slips, in the body's frame: that of the wheel's rim.
    pub rim: (f64, f64),
    /// The most that friction holds, newtons.
    pub most: f64,
    /// What drives it; none for what rolls along or is blocked.
    pub motor: Option<Motor>,
}

/// What drives a wheel.
#[derive(Clone, Copy, Debug)]
pub struct Motor {
    /// The direction in which the wheel rolls, in the body's frame.
    pub direction: (f64, f64),
    /// The most that it pushes, forwards and backwards, newtons at the rim.
    pub force: f64,
}

/// Where the body stands on the floor.
#[derive(Clone, Debug)]
pub struct Footing<const N: usize> {
    contacts: [Contact; N],
    body: Yielding,
    /// How the body moves after the step before unless something else pushed it.
    expected: Twist,
    /// How it moves if what else pushed it goes on.
    motion: Twist,
}

impl<const N: usize> Footing<N> {
    /// A body of a mass, kilograms, and an inertia about its centre, kilogram square metres, on those places, ahead and to
    /// the left of the centre, metres.
    pub fn new(mass: f64, inertia: f64, places: [(f64, f64); N]) -> Self {
        let still = Twist::default();
        let body = Yielding { mass, inertia, per_mass: 1.0 / mass, per_inertia: 1.0 / inertia };
        let contacts = places.map(|at| Contact::new(at, &body));
        Footing { contacts, body, expected: still, motion: still }
    }

    /// How fast the floor passes below a contact along a direction, where a motor could not do what it should in
    /// the last step: so fast its wheel turns.
    pub fn yielding(&self, contact: usize, (x, y): (f64, f64)) -> Option<f64> {
        let contact = self.contacts.get(contact).filter(|contact| contact.yields)?;
        let (across, along) = contact.velocity(&self.motion);
        Some(across * x + along * y)
    }

    /// What the contacts do together to a body that moves like this, within a step of `dt` seconds.
    pub fn push(&mut self, demands: [Demand; N], body: Twist, dt: f64) -> Push {
        let others = body.less(self.expected);
        let mut after =
            Twist { x: body.x + others.x, y: body.y + others.y, turn: body.turn + others.turn };
        for contact in &self.contacts {
            contact.act(contact.impulse, &mut after, &self.body);
        }
        for round in 0..ROUNDS {
            let mut change = 0.0_f64;
            for (contact, demand) in self.contacts.iter_mut().zip(demands) {
                // What slides gives all it has, wherever the others settle.
                if round == 0 || !contact.slides {
                    change = change.max(contact.solve(demand, &mut after, &self.body, dt));
                }
            }
            if change < SETTLED {
                break;
            }
        }
        self.motion = after;
        self.expected = after.less(others);
        let gained = self.expected.less(body);
        let Yielding { mass, inertia, .. } = self.body;
        Push { x: gained.x * mass / dt, y: gained.y * mass / dt, turn: gained.turn * inertia / dt }
    }
}

impl Twist {
    /// What is left without another.
    fn less(self, other: Twist) -> Twist {
        Twist { x: self.x - other.x, y: self.y - other.y, turn: self.turn - other.turn }
    }
}

impl Contact {
    fn new((x, y): (f64, f64), body: &Yielding) -> Self {
        let mass = 1.0 / (body.per_mass + (x * x + y * y) * body.per_inertia);
        Contact { at: (x, y), mass, impulse: (0.0, 0.0), slides: false, yields: false }
    }

    /// How the body moves there.
    fn velocity(&self, body: &Twist) -> (f64, f64) {
        let (x, y) = self.at;
        (body.x - body.turn * y, body.y + body.turn * x)
    }

    /// Changes the impulse so that less slips, and the body's motion by it; by how much.
    fn solve(&mut self, demand: Demand, body: &mut Twist, of: &Yielding, dt: f64) -> f64 {
        let (vx, vy) = self.velocity(body);
        let (px, py) = self.impulse;
        // The same share in every direction: so what slips is braked against the way it slips.
        let wanted = (px - (vx - demand.rim.0) * self.mass, py - (vy - demand.rim.1) * self.mass);
        let most = demand.most * dt;
        (self.impulse, self.slides) = limited(wanted, most);
        // Where the floor holds less than the motor gives, the wheel spins.
        let motor = demand.motor.and_then(|motor| motor.overcome(wanted, self.impulse, most, dt));
        self.yields = motor.is_some();
        self.impulse = motor.unwrap_or(self.impulse);
        let (dx, dy) = (self.impulse.0 - px, self.impulse.1 - py);
        self.act((dx, dy), body, of);
        dx.abs().max(dy.abs())
    }

    /// Lets an impulse act on the body.
    fn act(&self, (px, py): (f64, f64), body: &mut Twist, of: &Yielding) {
        let (x, y) = self.at;
        body.x += px * of.per_mass;
        body.y += py * of.per_mass;
        body.turn += (x * py - y * px) * of.per_inertia;
    }
}

impl Motor {
    /// The impulse of a step of `dt` seconds where the motor is too weak for the `held` one, the part of what is `wanted`
    /// that the floor can hold: along the wheel's way what the motor gives, and across it what the floor holds beside that.
    fn overcome(
        &self,
        wanted: (f64, f64),
        held: (f64, f64),
        most: f64,
        dt: f64,
    ) -> Option<(f64, f64)> {
        let (dx, dy) = self.direction;
        let (along, force) = (held.0 * dx + held.1 * dy, self.force * dt);
        if along.abs() <= force {
            return None;
        }
        let beside = libm::sqrt((most * most - force * force).max(0.0));
        let across = (wanted.1 * dx - wanted.0 * dy).clamp(-beside, beside);
        let along = force.copysign(along);
        Some((along * dx - across * dy, along * dy + across * dx))
    }
}

/// An impulse no larger than `most`, and whether it would have been.
fn limited((x, y): (f64, f64), most: f64) -> ((f64, f64), bool) {
    let square = x * x + y * y;
    if square <= most * most {
        return ((x, y), false);
    }
    let share = most / libm::sqrt(square);
    ((x * share, y * share), true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chassis::Chassis;

    const DT: f64 = 0.005;

    const MASS: f64 = Chassis::CARBOT.mass;

    fn inertia() -> f64 {
        Chassis::CARBOT.inertia()
    }

    const CORNERS: [(f64, f64); 4] = [(0.13, 0.14), (0.13, -0.14), (-0.13, 0.14), (-0.13, -0.14)];

    /// What the floor does in a step to a body that moved like this before, too.
    fn push(body: Twist, demand: Demand) -> Push {
        let mut footing = Footing::new(MASS, inertia(), CORNERS);
        footing.expected = body;
        footing.push([demand; 4], body, DT)
    }

    /// The motion after a step.
    fn after(body: Twist, push: Push) -> Twist {
        Twist {
            x: body.x + push.x * DT / MASS,
            y: body.y + push.y * DT / MASS,
            turn: body.turn + push.turn * DT / inertia(),
        }
    }

    #[test]
    fn what_friction_can_hold_stands_after_a_step() {
        let body = Twist { x: 0.02, y: -0.01, turn: 0.05 };
        let hold = Demand { rim: (0.0, 0.0), most: 50.0, motor: None };
        let end = after(body, push(body, hold));
        assert!(end.x.abs().max(end.y.abs()).max(end.turn.abs()) < 1e-6, "{end:?}");
    }

    #[test]
    fn what_slides_is_braked_with_all_friction_against_its_way() {
        let body = Twist { x: 0.3, y: 0.4, turn: 0.0 };
        let slide = Demand { rim: (0.0, 0.0), most: 1.5, motor: None };
        let push = push(body, slide);
        assert!((push.x + 6.0 * 0.6).abs() < 1e-3 && (push.y + 6.0 * 0.8).abs() < 1e-3, "{push:?}");
        assert!(push.turn.abs() < 1e-3, "{push:?}");
    }

    #[test]
    fn a_motor_yields_where_the_floor_holds_more_along_its_wheel_than_it_gives() {
        let motor = Some(Motor { direction: (1.0, 0.0), force: 5.0 });
        let wheel = |rim| Demand { rim, most: 8.0, motor };
        let still = Twist::default();
        let impulses = [(1.0, 1.5, false), (1.0, 0.5, true), (1.0, 0.0, true)];
        for (ahead, aside, yields) in impulses {
            let mut footing = Footing::new(MASS, inertia(), CORNERS);
            let push = footing.push([wheel((ahead, aside)); 4], still, DT);
            let what = format!("{ahead} m/s ahead, {aside} m/s aside: {push:?}");
            let along = if yields { 4.0 * 5.0 } else { 4.0 * 8.0 * ahead / ahead.hypot(aside) };
            assert_eq!(footing.yielding(0, (1.0, 0.0)).is_some(), yields, "{what}");
            assert!((push.x - along).abs() < 0.01, "{what}");
            assert!(push.x.hypot(push.y) < 4.0 * 8.0 + 1e-3, "{what}");
        }
    }

    #[test]
    fn a_body_that_spins_is_braked_by_all_friction_at_its_corners() {
        let body = Twist { turn: 9.0, ..Twist::default() };
        let slide = Demand { rim: (0.0, 0.0), most: 1.5, motor: None };
        let push = push(body, slide);
        let lever = libm::hypot(0.13, 0.14);
        assert!((push.turn + 6.0 * lever).abs() < 1e-3, "{push:?}");
    }

    #[test]
    fn wheels_that_agree_carry_the_body_with_them() {
        let (x, turn) = (0.2, 0.4);
        let demands = CORNERS.map(|(ahead, left)| Demand {
            rim: (x - turn * left, turn * ahead),
            most: 50.0,
            motor: None,
        });
        let mut footing = Footing::new(MASS, inertia(), CORNERS);
        let mut body = Twist::default();
        for _ in 0..4 {
            body = after(body, footing.push(demands, body, DT));
        }
        assert!((body.x - x).abs() < 1e-6 && body.y.abs() < 1e-6, "{body:?}");
        assert!((body.turn - turn).abs() < 1e-6, "{body:?}");
    }

    #[test]
    fn wheels_that_hold_do_not_give_way_to_a_steady_push() {
        let hold = Demand { rim: (0.0, 0.0), most: 5.0, motor: None };
        let mut footing = Footing::new(MASS, inertia(), CORNERS);
        let (mut body, mut aside) = (Twist::default(), 0.0);
        for _ in 0..200 {
            body = after(body, footing.push([hold; 4], body, DT));
            // A box pushes with 10 N to the left; 20 N would hold.
            body.y += 10.0 * DT / MASS;
            aside += body.y * DT;
        }
        assert!(aside.abs() < 1e-4, "{aside}");
    }
}
