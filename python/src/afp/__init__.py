"""Action Flow Plans for robots: check, draw, simulate and extend plans.

>>> import afp
>>> plan = afp.Plan('use carbot\\nplan P { start go actor go: Forward(distance = 30) { ForwardSuccessful -> terminate } }')
>>> plan.ok
False
>>> plan.diagnostics[0].code
'E0203'
"""

from ._afp import (
    AfpError,
    Broken,
    Carbot,
    Diagnostic,
    Event,
    PlanError,
    Robot,
    Scenario,
    Verdict,
    World,
    __version__,
    faults,
)
from .components import Toolbox, tick
from .log import Log
from .plan import Plan, load, new_plan
from .result import Collision, ComponentError, Result
from .simulation import Simulation
from .sweeps import Runs, sweep
from .units import (
    Angle,
    AngularSpeed,
    Duration,
    Length,
    Quantity,
    Speed,
    cm,
    deg,
    deg_per_s,
    kmh,
    m,
    m_per_s,
    minutes,
    mm,
    ms,
    rad,
    rad_per_s,
    s,
)

__all__ = [
    "AfpError",
    "Angle",
    "AngularSpeed",
    "Broken",
    "Carbot",
    "Collision",
    "ComponentError",
    "Diagnostic",
    "Duration",
    "Event",
    "Length",
    "Log",
    "Plan",
    "PlanError",
    "Quantity",
    "Result",
    "Robot",
    "Runs",
    "Scenario",
    "Simulation",
    "Speed",
    "Toolbox",
    "Verdict",
    "World",
    "__version__",
    "cm",
    "deg",
    "deg_per_s",
    "faults",
    "kmh",
    "load",
    "m",
    "m_per_s",
    "minutes",
    "mm",
    "ms",
    "new_plan",
    "rad",
    "rad_per_s",
    "s",
    "sweep",
    "tick",
]
