"""`python tests/stress/memory.py [10000]`: makes simulations and reports the growth of memory, in
megabytes.

The memory of the process varies by some megabytes, since the allocators of Python and Rust keep and
release pages. The result therefore compares the medians of the second and the first half, after a
warm-up of a tenth of the simulations.

The simulations are of every kind: complete and incomplete, with logs, and with components in Python
that raise, refer back to their own simulation, or are interrupted.
"""

from __future__ import annotations

import gc
import os
import sys
import tempfile
from pathlib import Path
from statistics import median

import afp

ROOT = Path(__file__).resolve().parents[3]
SHIPPED = afp.load(ROOT / "plans/wall_following.afp")
WORLD = afp.World.load(ROOT / "worlds/wall_following.toml")


def resident() -> float:
    """The memory of the process, in megabytes."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def shipped(number: int, folder: Path) -> None:
    """A shipped plan."""
    log = folder / "run.mcap" if number % 20 == 0 else None
    with afp.Simulation(SHIPPED, WORLD, seed=number, log=log) as simulation:
        simulation.run_to(0.1)
        simulation.fire("searchFirstWall.touch", "TouchSensorPressed", at=0.15)
        simulation.run(until=0.2)
        assert simulation.camera is not None and simulation.events


def circular(number: int) -> None:
    """A plan with components in Python, which raise and refer back to the simulation."""
    tools = afp.Toolbox("tools")
    kept: list[object] = [tools, bytes(10_000)]

    @tools.actor(states=["Done"], uses=["navigator"])
    async def Go(robot: afp.Robot) -> str:
        while robot.time < 0.05 or number % 3:
            assert kept
            robot.drive(0.2)
            await afp.tick()
        raise ValueError("on purpose")

    text = "use tools\nplan P { start go actor go: Go { Done -> terminate } }"
    plan = afp.Plan(text, toolboxes=[tools])
    simulation = afp.Simulation(plan, WORLD, seed=number)
    kept.append(simulation)
    kept.append(simulation.run(until=0.1))


def main() -> int:
    """Prints the growth."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    warm, often = max(count // 10, 100), max(count // 100, 10)
    occupied = []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            if number >= warm and number % often == 0:
                gc.collect()
                occupied.append(resident())
            shipped(number, Path(folder)) if number % 2 else circular(number)
    half = len(occupied) // 2
    print(f"{median(occupied[half:]) - median(occupied[:half]):.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
