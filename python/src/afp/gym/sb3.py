"""Vector environments for stable-baselines3; needs stable-baselines3."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..tables import need
from .setting import gymnasium
from .vector import CarbotVectorEnv

__all__ = ["CarbotVecEnv"]

try:
    _VecEnv: Any = need("stable_baselines3.common.vec_env").VecEnv
except ImportError:
    # The constructor then raises with the package to install.
    _VecEnv = object


class CarbotVecEnv(_VecEnv):  # type: ignore[misc]
    """A vector environment for stable-baselines3: `PPO("MlpPolicy", CarbotVecEnv(16,
    task="ReachGoal"))`.

    `settings` are those of `CarbotVectorEnv`. All robots are simulated in this process on all
    cores, so `SubprocVecEnv` gains nothing.
    """

    def __init__(self, num_envs: int, seed: int | None = None, **settings: Any) -> None:
        need("stable_baselines3")
        mode = gymnasium.vector.AutoresetMode.SAME_STEP
        self.envs = CarbotVectorEnv(num_envs, autoreset_mode=mode, **settings)
        self.render_mode = self.envs.render_mode
        self._first: int | list[int | None] | None = seed
        self._actions: NDArray[np.float64] | None = None
        super().__init__(num_envs, self.envs.single_observation_space, self.envs.single_action_space)

    def seed(self, seed: int | None = None) -> Sequence[int | None]:
        """Set the seed of the next `reset`; each environment gets one more than the previous."""
        self._first = seed
        return [None if seed is None else seed + index for index in range(self.num_envs)]

    def reset(self) -> NDArray[np.float32]:
        """Start all episodes."""
        seen, _ = self.envs.reset(seed=self._first)
        self._first = None
        return seen

    def step_async(self, actions: Any) -> None:
        """Set the next actions."""
        self._actions = np.asarray(actions, np.float64)

    def step_wait(self) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.bool_], list[dict[str, Any]]]:
        """Make a step."""
        seen, rewards, ended, late, told = self.envs.step(self._actions)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for index in np.flatnonzero(ended | late):
            infos[index]["terminal_observation"] = told["final_obs"][index]
            infos[index]["TimeLimit.truncated"] = bool(late[index] and not ended[index])
        return seen, rewards.astype(np.float32), ended | late, infos

    def close(self) -> None:
        """End the simulations."""
        self.envs.close()

    def get_images(self) -> Sequence[NDArray[np.uint8] | None]:
        """The rooms from above, with `render_mode="rgb_array"`."""
        return self.envs.render() or [None] * self.num_envs

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """An attribute that all environments share."""
        value = getattr(self.envs, attr_name)
        return [value for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Raises: attributes of a running environment cannot be set."""
        raise AttributeError(f"'{attr_name}' of running environments cannot be set; make them again")

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        """Raises: the single environments have no methods."""
        raise AttributeError(f"the environments have no method '{method_name}'")

    def env_is_wrapped(self, wrapper_class: type[Any], indices: Any = None) -> list[bool]:
        """Always false."""
        return [False for _ in self._get_indices(indices)]
