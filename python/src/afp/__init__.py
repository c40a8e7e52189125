"""Action Flow Plans for robots: check, draw, simulate and extend plans.

>>> import afp
>>> plan = afp.Plan('use carbot\\nplan P { start go actor go: Forward(distance = 30) { ForwardSuccessful -> terminate } }')
>>> plan.ok
False
>>> plan.diagnostics[0].code
'E0203'
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from ._choice import use

if TYPE_CHECKING:
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
    from .builder import WorldBuilder
    from .components import Toolbox, tick
    from .estimates import Estimate
    from .log import Log
    from .picture import Picture
    from .plan import Plan, load, new_plan
    from .result import Collision, ComponentError, Ending, Result
    from .runs import Runs
    from .simulation import Simulation
    from .snapshot import Snapshot
    from .stimuli import Fault, Press
    from .structure import Edge, Element, Entry
    from .sweeps import sweep
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
    "Edge",
    "Element",
    "Ending",
    "Entry",
    "Estimate",
    "Event",
    "Fault",
    "Length",
    "Log",
    "Picture",
    "Plan",
    "PlanError",
    "Press",
    "Quantity",
    "Result",
    "Robot",
    "Runs",
    "Scenario",
    "Simulation",
    "Snapshot",
    "Speed",
    "Toolbox",
    "Verdict",
    "World",
    "WorldBuilder",
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
    "use",
]

# Modules are loaded on first use, so that a robot can be chosen before.
_WHERE = {
    "_afp": "AfpError Broken Carbot Diagnostic Event PlanError Robot Scenario Verdict World __version__ faults",
    "units": "Angle AngularSpeed Duration Length Quantity Speed cm deg deg_per_s kmh m m_per_s minutes mm ms rad rad_per_s s",
    "estimates": "Estimate",
    "result": "Collision ComponentError Ending Result",
    "log": "Log",
    "plan": "Plan load new_plan",
    "runs": "Runs",
    "sweeps": "sweep",
    "simulation": "Simulation",
    "snapshot": "Snapshot",
    "stimuli": "Fault Press",
    "structure": "Edge Element Entry",
    "components": "Toolbox tick",
    "builder": "WorldBuilder",
    "picture": "Picture",
}
_MODULES = {*_WHERE, "metrics", "plots", "tables"}


def __getattr__(name: str) -> Any:
    module = next((module for module, names in _WHERE.items() if name in names.split()), None)
    if module is None and name in _MODULES:
        return importlib.import_module(f".{name}", __name__)
    if module is None:
        raise AttributeError(f"module 'afp' has no attribute '{name}'")
    _load()
    found = importlib.import_module(f".{module}", __name__)
    if not hasattr(found, name):
        raise AttributeError(f"'afp.{name}' is for the Carbot, and this process has another robot")
    globals()[name] = getattr(found, name)
    return globals()[name]


def _load() -> None:
    """Load all modules with the first name, and numpy's generators.

    Python loses the exception of a signal handler that it calls at a certain point of an import, so
    a run must not begin with imports.
    """
    for module in ("numpy.random", *(f"{__name__}.{module}" for module in _MODULES)):
        importlib.import_module(module)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
