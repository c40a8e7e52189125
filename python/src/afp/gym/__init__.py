"""Gymnasium environments of the simulated Carbot; they need gymnasium.

    import gymnasium
    env = gymnasium.make("afp.gym:afp/Carbot-v0")
    envs = gymnasium.make_vec("afp.gym:afp/Carbot-v0", num_envs=16)

Gymnasium imports the part before the colon to find the part after it. After `import afp.gym` the
short names work, too.

| environment | task |
|---|---|
| `afp/Carbot-v0` | get as far as possible without a collision (`ROAM`) |
| `afp/CarbotWallFollow-v0` | get ahead along a wall, 30 cm to the left of it (`WALL_FOLLOW`) |
| `afp/CarbotFindInfrared-v0` | find the beacon and drive to it (`FIND_INFRARED`) |
| `afp/CarbotReachGoal-v0` | drive to a known place (`REACH_GOAL`) |

**Action**, `Box(-1, 1, (2,))`: speed and turn rate as shares of `SPEED` and `TURN`; negative values
mean backwards and to the right. With `point=True` a third number points the range sensor, as a
share of 90 degrees to the left. An action lasts 100 ms of simulated time.

**Observation**, `Box(float32)`: the parts listed in `observe`, one after the other.

| part | numbers |
|---|---|
| `distance` | the range sensor's value, m (`RANGE` for silence and unknown values), and 1 if it is known, else 0 |
| `odometry` | x and y, m, sine and cosine of the heading, speed (m/s), turn rate (rad/s), as counted by the wheels |
| `motion` | only speed and turn rate |
| `bumper` | 1 if it is pressed |
| `fan` | the last distance along each bearing of `fan` (`fan=[0, afp.deg(45)]`), which the range sensor sweeps over, m |
| `target` | the distance of the target (`reach="goal"` or `"light"`) by the odometry, m, and sine and cosine of its bearing |
| `glow` | 1 if infrared light is seen, its bearing (rad) and strength |
| `color` | red, green and blue of the floor, and 1 if they are known |
| `battery` | its voltage, and the remaining share of its charge |
| `valid` | 1 for each of odometry, bumper, infrared sensor, colour sensor and battery that responds |

A broken device keeps its last value; no fault raises. Ground truth is only in `info`: `time`,
`pose`, `collisions`; after `reset` also `world`, and `target` if there is one.

**Reward.** The sum of the terms that `reward` weighs; `ends` lists those that end the episode.

| term | value for a step |
|---|---|
| `ahead` | the distance along the robot's heading, m, negative backwards |
| `crash` | 1 for a collision, else 0; may end the episode |
| `wall` | `ahead` times the quality of wall following at the right: 1 at a gap of 30 cm, 0 at none and from 60 cm on |
| `nearer` | the decrease of the target's distance, m |
| `reached` | 1 when the target is first reached, else 0; may end the episode |
| `time` | the duration, s |

**Plans.** `PlanEnv` is a plan as an environment whose policy chooses parameters or decisions.

**Episodes.** `gymnasium.make` truncates them after 60 s (`max_episode_steps`). `reset(options=...)`
takes `world`, `pose` (x and y in metres, heading in radians), `goal` (x, y) and `faults` for only
this episode. Without a world each episode has a new random room. `faults` are `afp.Fault`, as in
`Simulation.fail`. Given to the environment, they apply in every episode. A function of a random
generator can also draw them.

**Seeds.** `reset(seed=...)` decides everything: the same seed and actions give the same trajectory,
bit for bit, on every machine, in a single or in a vector environment.
"""

from __future__ import annotations

from .._afp import own_robot
from ..tables import need

if own_robot is not None:
    raise ImportError("afp.gym is for the Carbot, and this process has another robot: start another Python for it")

gymnasium = need("gymnasium")

from .env import CarbotEnv, Saved  # noqa: E402
from .options import PlanEnv  # noqa: E402
from .score import Score, evaluate, plan_of  # noqa: E402
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
    "PlanEnv",
    "Saved",
    "Score",
    "Task",
    "evaluate",
    "plan_of",
]

for _id, _task in TASKS.items():
    gymnasium.register(
        id=_id,
        entry_point="afp.gym:CarbotEnv",
        vector_entry_point="afp.gym:CarbotVectorEnv",
        max_episode_steps=round(_task.seconds / STEP),
        kwargs={"task": _task.name},
    )
