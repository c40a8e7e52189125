"""A Gymnasium environment of the simulated Carbot; it needs gymnasium.

    import gymnasium, afp.gym
    env = gymnasium.make("afp/Carbot-v0")

**Task.** Get as far as possible through a room without running into anything.

**Action**, `Box(-1, 1, (2,))`: speed and turn rate as shares of `SPEED` and `TURN`; backwards and to the right where
negative. An action lasts 100 ms of simulated time.

**Observation**, `Box(float32, (9,))`: the distance that the range sensor reports (m, `RANGE` for silence), 1 if it is
known, else 0 and the distance is `RANGE`: before the first echo, and for an echo that the sensor cannot measure; from the odometry x and y (m), sine and cosine of the heading, speed (m/s) and turn rate (rad/s);
1 if the bumper is pressed. What the robot cannot know is in `info` only: `pose`, `collisions`, `time`.

**Reward.** For each step the way in metres by which the robot got ahead (negative backwards); minus 10 for
running into something, which ends the episode. After `time_limit` seconds it is truncated.

**Seeds.** `reset(seed=...)` decides everything: the same seed and actions give the same trajectory, bit for bit, on
every machine. Without a `world` each episode takes place in a room made up anew from the seed.
"""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._afp import Carbot, World
from .tables import need

gymnasium = need("gymnasium")

__all__ = ["RANGE", "SPEED", "TURN", "CarbotEnv"]

SPEED = 0.5
"""The speed of a full action, m/s."""
TURN = 2.0
"""The turn rate of a full action, rad/s."""
RANGE = 2.5
"""What silence of the range sensor is observed as, metres."""
STEP = 0.1
"""How long an action lasts, seconds."""
CRASH = -10.0
"""What running into something costs."""
PIXELS = 256
"""The edge of the picture from above."""
_FAR = 1e3


class CarbotEnv(gymnasium.Env):  # type: ignore[misc, name-defined]
    """The simulated Carbot; see the module for actions, observations and reward.

    `world` is a `World` or the path of its file; `None` makes up a room for each episode. `view` is what `rgb_array`
    shows: the room from `top`, or the robot's own `camera`.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": round(1 / STEP)}

    def __init__(
        self,
        world: World | str | os.PathLike[str] | None = None,
        *,
        time_limit: float = 60.0,
        render_mode: str | None = None,
        view: str = "top",
    ) -> None:
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"no render mode '{render_mode}'; there is: rgb_array")
        if view not in ("top", "camera"):
            raise ValueError(f"no view '{view}'; there are: top, camera")
        self._given = world if world is None or isinstance(world, World) else World.load(world)
        self._steps_at_most = max(1, math.ceil(time_limit / STEP - 1e-9))
        self.render_mode = render_mode
        self._view = view
        box = gymnasium.spaces.Box
        self.action_space = box(-1.0, 1.0, (2,), np.float32)
        low = [0, 0, -_FAR, -_FAR, -1, -1, -5, -20, 0]
        high = [10, 1, _FAR, _FAR, 1, 1, 5, 20, 1]
        self.observation_space = box(np.array(low, np.float32), np.array(high, np.float32), dtype=np.float32)
        self._carbot: Carbot | None = None
        self._world: World | None = None
        self._background: NDArray[np.uint8] | None = None
        self._steps = 0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Puts the robot at the start of its world, or of a new one."""
        super().reset(seed=seed)
        room, noise = (int(number) for number in self.np_random.integers(0, 2**32, 2))
        self._world = self._given or World.random(room)
        self._background = None
        self._carbot = Carbot(self._world, noise)
        self._steps = 0
        return self._observe(self._carbot), self._info(self._carbot)

    def step(self, action: Any) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Drives for 100 ms."""
        if self._carbot is None:
            raise gymnasium.error.ResetNeeded("call reset() before step()")
        speed, turn = (float(share) for share in np.clip(np.asarray(action, np.float64), -1.0, 1.0))
        x, y, heading = self._carbot.pose
        hits = len(self._carbot.touched)
        self._carbot.drive(speed * SPEED, turn * TURN, STEP)
        self._steps += 1
        new_x, new_y, _ = self._carbot.pose
        reward = (new_x - x) * math.cos(heading) + (new_y - y) * math.sin(heading)
        crashed = len(self._carbot.touched) > hits
        if crashed:
            reward += CRASH
        late = self._steps >= self._steps_at_most
        return self._observe(self._carbot), reward, crashed, late, self._info(self._carbot)

    def render(self) -> NDArray[np.uint8] | None:
        """The room from above, or what the camera sees; `None` without `render_mode="rgb_array"`."""
        if self.render_mode is None:
            gymnasium.logger.warn('render() shows nothing without render_mode="rgb_array"')
            return None
        if self._carbot is None or self._world is None:
            raise gymnasium.error.ResetNeeded("call reset() before render()")
        if self._view == "camera":
            picture = self._carbot.sense("camera")
            return np.zeros((PIXELS, PIXELS, 3), np.uint8) if picture is None else picture
        if self._background is None:
            self._background = _draw(self._world)
        return _with_robot(self._background, self._world, self._carbot.pose)

    def close(self) -> None:
        """Lets go of the simulation."""
        self._carbot = None

    def _observe(self, carbot: Carbot) -> NDArray[np.float32]:
        echo = carbot.sense("distance")
        x, y, heading, speed, turn = carbot.sense("odometry")
        distance = RANGE if echo is None else min(echo, RANGE)
        rest = [x, y, math.sin(heading), math.cos(heading), speed, turn, float(carbot.sense("touched") or False)]
        all = np.array([distance, float(echo is not None), *rest], np.float32)
        seen: NDArray[np.float32] = np.clip(all, self.observation_space.low, self.observation_space.high)
        return seen

    def _info(self, carbot: Carbot) -> dict[str, Any]:
        world = self._world.name if self._world else ""
        return {"time": carbot.time, "pose": carbot.pose, "collisions": len(carbot.touched), "world": world}


# The picture from above


def _frame(world: World) -> tuple[float, float, float]:
    """The corner at the lower left, and metres for each pixel: everything with a margin."""
    points = np.vstack([*world.outlines(), [world.start[:2]]])
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max()) * 1.04 + 0.1
    left, bottom = (low + high) / 2 - size / 2
    return float(left), float(bottom), size / PIXELS


def _centres(world: World) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where the middle of each pixel lies, rows from the top."""
    left, bottom, metres = _frame(world)
    along = (np.arange(PIXELS) + 0.5) * metres
    x, y = np.meshgrid(left + along, bottom + along[::-1])
    return x, y


def _draw(world: World) -> NDArray[np.uint8]:
    picture = np.full((PIXELS, PIXELS, 3), 245, np.uint8)
    x, y = _centres(world)
    for corners in world.outlines():
        picture[_inside(corners, x, y)] = (90, 90, 90)
    return picture


def _inside(
    corners: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Which points lie in a polygon: those with an odd number of edges to their right."""
    inside = np.zeros(x.shape, np.bool_)
    for (x1, y1), (x2, y2) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if y1 != y2:
            spans = (y1 > y) != (y2 > y)
            inside ^= spans & (x < x1 + (y - y1) * (x2 - x1) / (y2 - y1))
    return inside


def _with_robot(
    background: NDArray[np.uint8], world: World, pose: tuple[float, float, float]
) -> NDArray[np.uint8]:
    """The picture with the robot in it: its body, the bow brighter."""
    picture = background.copy()
    x, y = _centres(world)
    dx, dy = x - pose[0], y - pose[1]
    ahead = dx * math.cos(pose[2]) + dy * math.sin(pose[2])
    aside = dy * math.cos(pose[2]) - dx * math.sin(pose[2])
    length, width = Carbot.half_length, Carbot.half_width
    body = (abs(ahead) <= length) & (abs(aside) <= width)
    picture[body] = (0, 114, 178)
    picture[body & (ahead > length / 2)] = (213, 94, 0)
    return picture


gymnasium.register(id="afp/Carbot-v0", entry_point="afp.gym:CarbotEnv")
