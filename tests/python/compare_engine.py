"""Drives manoeuvres with another physics engine and compares them with those of the simulator.

    python compare_engine.py MANOEUVRES.json OURS.jsonl

The other engine is Chipmunk (pymunk). The robot is modelled again there, from the numbers in docs/simulator.md and by other means: contact patches are joints of the engine that hold up to their
friction, a box rests on many patches, and the step is 1 ms instead of 5. No code of the project takes
part. Prints a table of differences and fails where one is larger than its limit.
"""

import json
import math
import sys
from collections import namedtuple
from pathlib import Path

import pymunk

STEP = 0.001
GRAVITY = 9.81
# The robot: metres, kilograms.
SIZE = (0.40, 0.35)
MASS = 4.7
WHEELS = ((0.13, 0.14), (0.13, -0.14))
CASTORS = ((-0.13, 0.14), (-0.13, -0.14))
LOAD = MASS * GRAVITY / 4
FRICTION = 0.7
ROLLING = 0.02
# Motors and steering: seconds, metres and radians per second, and per second squared.
LAG = 0.06
ACCELERATION = 2.0
MOTOR_FORCE = 6.5
# The gear holds a stopping wheel below this speed.
HELD = 0.005
# The mass of a wheel's rim at the motor: the smallest that the engine can compute with.
RIM = 0.02
TOP_SPEED = 0.31
STEER_RATE = 7.0
STEER_REACH = 1.75
# A box: its friction on the floor, and between it and the robot.
FLOOR = 0.4
SIDES = 0.3
# The number of patches along each side of a box.
PATCHES = 4
# The share of the mass in the parts that touch the floor.
IN_PATCHES = 0.3


Patch = namedtuple("Patch", "anchor body")


class Wheel:
    """A wheel that steers and drives; the floor under it moves like its rim, and the rim follows the motor unless it is too weak."""

    def __init__(self, space, chassis, patch):
        self.at = patch.anchor
        self.angle = self.aim = self.speed = 0.0
        self.wanted = (0.0, 0.0)
        self.chassis = chassis
        self.motor = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self.rim = pymunk.Body(RIM, math.inf)
        # The rim does not move sideways, and ahead the motor's force limits it.
        axle = pymunk.GrooveJoint(self.motor, self.rim, (-1, 0), (1, 0), (0, 0))
        axle.max_bias = 0
        self.drive = hold(self.rim, self.motor, MOTOR_FORCE)
        self.grip = hold(patch.body, self.rim, FRICTION * LOAD)
        space.add(self.motor, self.rim, axle, self.drive, self.grip)

    def command(self, speed, turn):
        self.wanted = (speed - turn * self.at[1], turn * self.at[0])
        if math.hypot(*self.wanted) < 1e-4:
            return
        there = math.atan2(self.wanted[1], self.wanted[0])
        ways = (there - math.pi, there, there + math.pi)
        within = [way for way in ways if abs(way) <= STEER_REACH]
        self.aim = min(within, key=lambda way: abs(way - self.angle))

    def step(self):
        self.angle += clamp(self.aim - self.angle, STEER_RATE * STEP)
        target = self.wanted[0] * math.cos(self.angle) + self.wanted[1] * math.sin(self.angle)
        follow = (target - self.speed) * (1 - math.exp(-STEP / LAG))
        self.speed += clamp(follow, ACCELERATION * STEP)
        held = self.wanted == (0.0, 0.0) and abs(self.speed) < HELD
        self.drive.max_force = math.inf if held else MOTOR_FORCE
        self.motor.position = self.rim.position
        self.motor.angle = self.chassis.angle + self.angle
        self.motor.velocity = self.ahead() * self.speed
        self.rim.velocity = self.motor.velocity

    def give_way(self):
        """The rim turns as the floor lets it where the motor is too weak."""
        if self.drive.impulse > 0.999 * MOTOR_FORCE * STEP and not math.isinf(self.drive.max_force):
            self.speed = self.rim.velocity.dot(self.ahead())

    def ahead(self):
        return pymunk.Vec2d.from_polar(1, self.motor.angle)


def hold(patch, floor, force):
    """A patch moves as the floor does, as far as a force in any direction can make it."""
    joint = pymunk.PivotJoint(patch, floor, (0, 0), (0, 0))
    # Friction acts on speeds and does not pull a patch back.
    joint.max_bias = 0
    joint.max_force = force
    return joint


def clamp(value, most):
    return max(-most, min(most, value))


def solid(space, mass, size, at, patches):
    """A rectangle of that mass, and bodies at those places under it that the floor holds.

    They have a share of the mass and do not turn: so the floor acts on a point, in all directions alike.
    """
    each = mass * IN_PATCHES / len(patches)
    far = sum(x * x + y * y for x, y in patches)
    body = pymunk.Body(mass * (1 - IN_PATCHES), pymunk.moment_for_box(mass, size) - each * far)
    body.position, body.angle = at[:2], math.radians(at[2])
    shape = pymunk.Poly.create_box(body, size)
    # The engine multiplies the coefficients of both sides.
    shape.friction = math.sqrt(SIDES)
    shape.elasticity = 0
    space.add(body, shape)
    feet = []
    for place in patches:
        foot = pymunk.Body(each, math.inf)
        foot.position = body.local_to_world(place)
        space.add(foot, pymunk.PivotJoint(body, foot, place, (0, 0)))
        feet.append(Patch(place, foot))
    return body, feet


def drive(manoeuvre):
    """Where robot and box are at each millisecond."""
    space = pymunk.Space()
    space.iterations = 600
    space.collision_slop = 1e-4
    robot, patches = solid(space, MASS, SIZE, (0, 0, 0), WHEELS + CASTORS)
    wheels = [Wheel(space, robot, patch) for patch in patches[:2]]
    space.add(*(hold(patch.body, space.static_body, ROLLING * LOAD) for patch in patches[2:]))
    bodies = [robot] + ([place(space, manoeuvre["box"])] if "box" in manoeuvre else [])
    slip_from, grip = manoeuvre.get("slip", (math.inf, 1.0))
    poses = [[pose(body) for body in bodies]]
    for seconds, speed, turn in manoeuvre["drive"]:
        for wheel in wheels:
            wheel.command(clamp(speed, TOP_SPEED), turn)
        for _ in range(round(seconds / STEP)):
            for wheel in wheels:
                if len(poses) * STEP > slip_from:
                    wheel.grip.max_force = FRICTION * LOAD * grip
                wheel.step()
            space.step(STEP)
            for wheel in wheels:
                wheel.give_way()
            poses.append([pose(body) for body in bodies])
    return poses


def place(space, box):
    """A box that can be pushed."""
    mass, (length, width) = box["mass_kg"], box["size_m"]
    along = [(n + 0.5) / PATCHES - 0.5 for n in range(PATCHES)]
    places = [(a * length, b * width) for a in along for b in along]
    body, patches = solid(space, mass, box["size_m"], box["pose_m_deg"], places)
    share = FLOOR * mass * GRAVITY / len(places)
    space.add(*(hold(patch.body, space.static_body, share) for patch in patches))
    return body


def pose(body):
    return (body.position.x, body.position.y, body.angle)


def pose_of(corners, first):
    """The pose of a box by its corners, against its corners at the start."""
    x, y = (sum(corner[k] for corner in corners) / len(corners) for k in (0, 1))
    side = [math.atan2(c[1][1] - c[0][1], c[1][0] - c[0][0]) for c in (corners, first)]
    return (x, y, side[0] - side[1])


def apart(ours, theirs):
    """How far two poses are from each other: millimetres and degrees."""
    turn = math.remainder(ours[2] - theirs[2], math.tau)
    return 1000 * math.hypot(ours[0] - theirs[0], ours[1] - theirs[1]), abs(math.degrees(turn))


def compare(manoeuvre, ours):
    """The differences of robot and box: over time, millimetres and degrees."""
    theirs = drive(manoeuvre)
    differences = []
    for line in ours:
        poses = [line["robot"]]
        if line["box"]:
            poses.append(pose_of(line["box"], ours[0]["box"]))
        at = theirs[round(line["t"] / STEP)]
        differences.append([apart(*pair) for pair in zip(poses, at, strict=True)])
    return list(zip(*differences))


def report(manoeuvre, ours):
    """Prints the differences of a manoeuvre; gives those that are larger than they may be."""
    name, too_large = manoeuvre["name"], []
    whats = ("robot", "box")[: 1 + ("box" in manoeuvre)]
    compared = zip(whats, compare(manoeuvre, ours), manoeuvre["within_mm_deg"], strict=True)
    for what, series, limits in compared:
        worst = [max(part) for part in zip(*series)]
        cells = [f"{mm:6.1f} mm {deg:5.1f} deg" for mm, deg in (series[-1], worst, limits)]
        print(f"{name:<30} {what:<5}", *cells, sep="  ")
        if not all(is_ <= limit for is_, limit in zip(worst, limits)):
            too_large.append(f"{name}: {what}")
    return too_large


def main(manoeuvres, ours):
    lines = [json.loads(line) for line in ours.read_text(encoding="utf-8").splitlines()]
    print(f"{'':<37}  {'at the end':<18}  {'at most':<18}  limit")
    too_large = []
    for manoeuvre in json.loads(manoeuvres.read_text(encoding="utf-8")):
        mine = [line for line in lines if line["name"] == manoeuvre["name"]]
        assert mine, f"{ours} does not know '{manoeuvre['name']}'"
        too_large += report(manoeuvre, mine)
    if too_large:
        sys.exit("farther apart than they may be: " + "; ".join(too_large))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
