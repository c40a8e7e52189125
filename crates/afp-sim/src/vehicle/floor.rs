//! The floor's effect on the body through the contacts of wheels and castors.
//!
//! Each contact stops its slip as far as friction allows, equally in every direction (the friction
//! circle). Along its rolling direction, a driven wheel is also limited by its motor; then the
//! floor turns the wheel. All contacts push the same body, so they are solved together: by
//! projected Gauss-Seidel iteration that begins with the previous step (E. Catto, Iterative
//! Dynamics with Temporal Coherence, GDC 2005). Other pushes on the body, from boxes and walls, are
//! only visible afterwards in its motion. The wheels hold against the last such push.

/// The maximum number of iterations over the contacts in a step. With a warm start, most steps take
/// half of them.
const ROUNDS: usize = 12;
/// The iteration ends if no contact has changed by more than this in the last round, in newton
/// seconds: 2 um/s of the body.
const SETTLED: f64 = 1e-5;
/// The body's inverse mass and inverse inertia. Rounds do not divide.
#[derive(Clone, Copy, Debug)]
struct Yielding {
    mass: f64,
    inertia: f64,
    per_mass: f64,
    per_inertia: f64,
}

/// The motion of the body, in its own frame: ahead, to the left, turning.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twist {
    /// Ahead, metres a second.
    pub x: f64,
    /// To the left, metres a second.
    pub y: f64,
    /// Counter-clockwise, radians a second.
    pub turn: f64,
}

/// The push on the body, in its own frame: newtons and newton metres about the centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Push {
    /// Ahead, newtons.
    pub x: f64,
    /// To the left, newtons.
    pub y: f64,
    /// Counter-clockwise, newton metres.
    pub turn: f64,
}

#[derive(Clone, Debug)]
struct Contact {
    /// Ahead and to the left of the body's centre, metres.
    at: (f64, f64),
    /// The minimum effective mass at the contact, in kilograms: in the direction in which the body
    /// yields most.
    mass: f64,
    /// Its impulse on the body in the previous step, in newton seconds.
    impulse: (f64, f64),
    /// Whether the impulse was limited by friction.
    slides: bool,
    /// Whether its motor was too weak.
    yields: bool,
}

/// The target and the limits of a contact in a step.
#[derive(Clone, Copy, Debug)]
pub struct Demand {
    /// The slip-free velocity in the body's frame: the velocity of the wheel's rim.
    pub rim: (f64, f64),
    /// The maximum friction, in newtons.
    pub most: f64,
    /// The motor; `None` for a castor or a blocked wheel.
    pub motor: Option<Motor>,
}

/// The motor of a wheel.
#[derive(Clone, Copy, Debug)]
pub struct Motor {
    /// The direction in which the wheel rolls, in the body's frame.
    pub direction: (f64, f64),
    /// The maximum push, forwards and backwards, in newtons at the rim.
    pub force: f64,
}

/// The contacts of the body with the floor.
#[derive(Clone, Debug)]
pub struct Footing<const N: usize> {
    contacts: [Contact; N],
    body: Yielding,
    /// The body's expected motion after the previous step, without other pushes.
    expected: Twist,
    /// The body's motion if the other pushes continue.
    motion: Twist,
}

impl<const N: usize> Footing<N> {
    /// A body with these contacts, ahead and to the left of its centre in metres. `mass` is in
    /// kilograms, and `inertia` about the centre in kilogram square metres.
    pub fn new(mass: f64, inertia: f64, places: [(f64, f64); N]) -> Self {
        let still = Twist::default();
        let body = Yielding { mass, inertia, per_mass: 1.0 / mass, per_inertia: 1.0 / inertia };
        let contacts = places.map(|at| Contact::new(at, &body));
        Footing { contacts, body, expected: still, motion: still }
    }

    /// The speed of the floor below a contact along a direction, if its motor was too weak in the
    /// last step. The wheel turns with this speed.
    pub fn yielding(&self, contact: usize, (x, y): (f64, f64)) -> Option<f64> {
        let contact = self.contacts.get(contact).filter(|contact| contact.yields)?;
        let (across, along) = contact.velocity(&self.motion);
        Some(across * x + along * y)
    }

    /// The push of all contacts on a body with this motion, within a step of `dt` seconds.
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
                // A sliding contact uses all friction, independent of the others.
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
    fn less(self, other: Twist) -> Twist {
        Twist { x: self.x - other.x, y: self.y - other.y, turn: self.turn - other.turn }
    }
}

impl Contact {
    fn new((x, y): (f64, f64), body: &Yielding) -> Self {
        let mass = 1.0 / (body.per_mass + (x * x + y * y) * body.per_inertia);
        Contact { at: (x, y), mass, impulse: (0.0, 0.0), slides: false, yields: false }
    }

    fn velocity(&self, body: &Twist) -> (f64, f64) {
        let (x, y) = self.at;
        (body.x - body.turn * y, body.y + body.turn * x)
    }

    /// Changes the impulse to reduce slip, and the body's motion with it. Returns the change.
    fn solve(&mut self, demand: Demand, body: &mut Twist, of: &Yielding, dt: f64) -> f64 {
        let (vx, vy) = self.velocity(body);
        let (px, py) = self.impulse;
        // The same share in every direction, so that friction acts against the slip.
        let wanted = (px - (vx - demand.rim.0) * self.mass, py - (vy - demand.rim.1) * self.mass);
        let most = demand.most * dt;
        (self.impulse, self.slides) = limited(wanted, most);
        // If the floor holds less than the motor's force, the wheel spins.
        let motor = demand.motor.and_then(|motor| motor.overcome(wanted, self.impulse, most, dt));
        self.yields = motor.is_some();
        self.impulse = motor.unwrap_or(self.impulse);
        let (dx, dy) = (self.impulse.0 - px, self.impulse.1 - py);
        self.act((dx, dy), body, of);
        dx.abs().max(dy.abs())
    }

    fn act(&self, (px, py): (f64, f64), body: &mut Twist, of: &Yielding) {
        let (x, y) = self.at;
        body.x += px * of.per_mass;
        body.y += py * of.per_mass;
        body.turn += (x * py - y * px) * of.per_inertia;
    }
}

impl Motor {
    /// The impulse of a step of `dt` seconds if the motor is too weak for the `held` impulse, the
    /// part of the `wanted` one that friction allows. Along the wheel, the motor limits it; across
    /// the wheel, the remaining friction does.
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

/// Limits an impulse to `most`; returns also whether it was larger.
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

    /// The floor's push on a body that had the same motion in the previous step.
    fn push(body: Twist, demand: Demand) -> Push {
        let mut footing = Footing::new(MASS, inertia(), CORNERS);
        footing.expected = body;
        footing.push([demand; 4], body, DT)
    }

    fn after(body: Twist, push: Push) -> Twist {
        Twist {
            x: body.x + push.x * DT / MASS,
            y: body.y + push.y * DT / MASS,
            turn: body.turn + push.turn * DT / inertia(),
        }
    }

    #[test]
    fn motion_that_friction_can_hold_stops_after_a_step() {
        let body = Twist { x: 0.02, y: -0.01, turn: 0.05 };
        let hold = Demand { rim: (0.0, 0.0), most: 50.0, motor: None };
        let end = after(body, push(body, hold));
        assert!(end.x.abs().max(end.y.abs()).max(end.turn.abs()) < 1e-6, "{end:?}");
    }

    #[test]
    fn sliding_is_braked_with_all_friction_against_the_motion() {
        let body = Twist { x: 0.3, y: 0.4, turn: 0.0 };
        let slide = Demand { rim: (0.0, 0.0), most: 1.5, motor: None };
        let push = push(body, slide);
        assert!((push.x + 6.0 * 0.6).abs() < 1e-3 && (push.y + 6.0 * 0.8).abs() < 1e-3, "{push:?}");
        assert!(push.turn.abs() < 1e-3, "{push:?}");
    }

    #[test]
    fn a_motor_yields_if_the_floor_holds_more_along_its_wheel() {
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
    fn a_spinning_body_is_braked_by_all_friction_at_its_corners() {
        let body = Twist { turn: 9.0, ..Twist::default() };
        let slide = Demand { rim: (0.0, 0.0), most: 1.5, motor: None };
        let push = push(body, slide);
        let lever = libm::hypot(0.13, 0.14);
        assert!((push.turn + 6.0 * lever).abs() < 1e-3, "{push:?}");
    }

    #[test]
    fn wheels_with_one_target_carry_the_body_with_them() {
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
    fn holding_wheels_do_not_give_way_to_a_steady_push() {
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
