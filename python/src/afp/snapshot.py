"""Moments of simulations."""

from __future__ import annotations

from typing import NoReturn

from ._afp import Plan, Runner, World

__all__ = ["Snapshot"]


class Snapshot:
    """A moment of a simulation, from which `Simulation.restore` can continue any number of times."""

    def __init__(self, runner: Runner, plan: Plan, world: World, seed: int) -> None:
        self._runner = runner
        self._plan = plan
        self._world = world
        self._seed = seed

    @property
    def time(self) -> float:
        """The time of the moment, in seconds since the start."""
        return self._runner.time

    def _is_of(self, plan: Plan, world: World, seed: int) -> bool:
        return self._plan is plan and self._world is world and self._seed == seed

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Snapshot cannot be pickled; create the simulation again from its plan, world and seed")

    def __repr__(self) -> str:
        return f"<Snapshot of {self._plan.name} in '{self._world.name}' at {self.time:.3f} s>"
