"""Gymnasium environments of the simulated Carbot; they need gymnasium.

    import gymnasium
    env = gymnasium.make("afp.gym:afp/Carbot-v0")
    envs = gymnasium.make_vec("afp.gym:afp/Carbot-v0", num_envs=16)

What stands before the colon is imported for what stands behind it. After `import afp.gym` the short names do.

| environment | task |
|---|---|
| `afp/Carbot-v0` | get as far as possible without running into anything (`ROAM`) |
| `afp/CarbotWallFollow-v0` | get ahead along a wall, 30 cm to the left of it (`WALL_FOLLOW`) |
| `afp/CarbotFindInfrared-v0` | find the beacon and drive to it (`FIND_INFRARED`) |
| `afp/CarbotReachGoal-v0` | drive to a place that is known (`REACH_GOAL`) |

**Action**, `Box(-1, 1, (2,))`: speed and turn rate as shares of `SPEED` and `TURN`; backwards and to the right where
negative. With `point=True` a third number points the range sensor, as a share of 90 degrees to the left. An action lasts
100 ms of simulated time.

**Observation**, `Box(float32)`: the parts that `observe` names, one behind the other.

| part | numbers |
|---|---|
| `distance` | what the range sensor reports, m (`RANGE` for silence and the unknown), and 1 if it is known, else 0 |
| `odometry` | x and y, m, sine and cosine of the heading, speed (m/s), turn rate (rad/s): what the wheels have counted |
| `motion` | speed and turn rate alone |
| `bumper` | 1 if it is pressed |
| `fan` | the last distance along each bearing of `fan` (`fan=[0, afp.deg(45)]`), which the range sensor looks along in turns, m |
| `target` | how far what there is to reach (`reach="goal"` or `"light"`) is by the odometry, m, and sine and cosine of the bearing to it |
| `glow` | 1 if infrared light is seen, its bearing (rad) and strength |
| `color` | red, green and blue of the floor, and 1 if they are known |
| `battery` | its voltage, and the share of its charge that is left |
| `valid` | 1 for each of odometry, bumper, infrared sensor, colour sensor and battery that answers |

A device that is broken is seen as what it said last; no fault raises. What the robot cannot know is in `info` alone: `time`,
`pose`, `collisions`; after `reset` also `world`, and `target` where there is one.

**Reward.** The sum of the terms that `reward` weighs; `ends` names those that end the episode.

| term | is, for a step |
|---|---|
| `ahead` | the way along the robot's heading, m, negative backwards |
| `crash` | 1 if it ran into something, else 0; may end the episode |
| `wall` | `ahead` times how well the wall at the right is kept: 1 at a gap of 30 cm, 0 at none and from 60 cm on |
| `nearer` | by how much what there is to reach is nearer, m |
| `reached` | 1 the first time that it is reached, else 0; may end the episode |
| `time` | how long it took, s |

**Episodes.** `gymnasium.make` cuts them off after 60 s (`max_episode_steps`). `reset(options=...)` takes `world`, `pose` (x and
y in metres, heading in radians), `goal` (x, y) and `faults`, for this episode alone. Without a world each episode has a room
made up anew. `faults` are tuples of device, kind and perhaps a mapping with `at`, `lasting`, `delay`, `share`, as
`Simulation.fail` takes them; given to the environment they break in every episode, and a function of a random generator makes
them up.

**Seeds.** `reset(seed=...)` decides everything: the same seed and actions give the same trajectory, bit for bit, on every
machine, alone or among others in a vector environment.
"""

from __future__ import annotations

from .._afp import own_robot
from ..tables import need

if own_robot is not None:
    raise ImportError("afp.gym is of the Carbot, and this process has another robot: start another Python for it")

gymnasium = need("gymnasium")

from .env import CarbotEnv  # noqa: E402
from .score import Score, evaluate, run_plan  # noqa: E402
from .setting import PIXELS, RANGE, SPEED, STEP, TURN  # noqa: E402
from .tasks import FIND_INFRARED, REACH_GOAL, ROAM, TASKS, WALL_FOLLOW, Task  # noqa: E402
from .vector import CarbotVectorEnv  # noqa: E402

__all__ = [
    "FIND_INFRARED",
    "PIXELS",
    "RANGE",
    "REACH_GOAL",
    "ROAM",
    "SPEED",
    "STEP",
    "TASKS",
    "TURN",
    "WALL_FOLLOW",
    "CarbotEnv",
    "CarbotVectorEnv",
    "Score",
    "Task",
    "evaluate",
    "run_plan",
]

for _id, _task in TASKS.items():
    gymnasium.register(
        id=_id,
        entry_point="afp.gym:CarbotEnv",
        vector_entry_point="afp.gym:CarbotVectorEnv",
        max_episode_steps=round(_task.seconds / STEP),
        kwargs={"task": _task.name},
    )
