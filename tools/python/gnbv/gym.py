"""Environments for Gymnasium; importing this registers them.

    import gymnasium, gnbv.gym
    env = gymnasium.make("gnbv/Aircraft-v0", action="candidate")
    envs = gymnasium.make_vec("gnbv/Smoke-v0", num_envs=8)

One step is one view: the vehicle flies there, looks, and believes what it saw.

Actions: `action="view"` a box in [-1, 1]: x, y, z of the navigation box, yaw / pi and, with a
gimbal, its pitch; `action="candidate"` the index of one of the sampled candidates, of which
info["action_mask"] says which may be taken. What cannot be flown to costs a step and moves nothing;
info["refused"] says why.

Observations: "map" (3, 8, 16, 16), shares of unknown, free and occupied voxels by cell (z, y, x);
"pose": x, y, z of the navigation box in [-1, 1], sine and cosine of the yaw; "progress": the
entropy left and the share of the budget of views used; with candidates also "candidates": for each
the logarithms of its free, unknown, occupied, predicted and thinly sampled voxels and of its
entropy, its density and the length of the way, 0 for those that may not be taken. All of it is
belief.

Reward: the coverage gained, in shares of the ceiling (of what can be reached at all): the truth, as
a benchmark knows it. The ceiling is searched when a scenario is first made (up to minutes; the
cache keeps it); with goal=0 nobody needs it, and rewards are shares of the whole surface. An
episode is terminated by the goal (95 % of the ceiling), a collision or being carried off course,
and truncated by its budget: max_iterations views, the start's being the first and refused ones
counted, or the scenario's own (battery, metres, time).

An action of another shape, or with a number that is none, raises ValueError before anything moves,
in a batch, too. An environment lives in the process that made it: a forked child's step() and
reset() raise RuntimeError. `render_mode="rgb_array"`: render() draws the map from above, the way
and the vehicle, as (H, W, 3) bytes.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Optional, Union

try:
    import gymnasium
    from gymnasium import spaces
    from gymnasium.vector import VectorEnv
    from gymnasium.vector.utils import batch_space
except ImportError as error:
    raise ImportError(f"gnbv.gym needs Gymnasium ({error}): pip install 'gnbv[gym]'") from None
if int(gymnasium.__version__.split(".")[0]) < 1:
    raise ImportError(
        f"gnbv.gym needs Gymnasium 1.0 or newer, this is {gymnasium.__version__}: "
        "pip install 'gnbv[gym]'"
    )
import numpy as np
import numpy.typing as npt

from gnbv import _core, _picture
from gnbv._mission import _yaml

SCENARIOS = {
    "Aircraft": "aircraft",
    "PowerPlant": "power_plant",
    "LabModel": "lab_model",
    "LabAirplane": "lab_airplane",
    "Smoke": "smoke",
}
_METADATA: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 4}
_VECTOR_METADATA: dict[str, Any] = dict(_METADATA)
if hasattr(gymnasium.vector, "AutoresetMode"):  # Gymnasium 1.0 has no word for what it does
    _VECTOR_METADATA["autoreset_mode"] = gymnasium.vector.AutoresetMode.NEXT_STEP
_OVER = ("coverage_reached", "collision", "off_course")
Array = npt.NDArray[Any]
Observation = dict[str, Array]


class _Stage:
    """What episodes share: the loaded world, the spaces, and what an action means."""

    def __init__(
        self,
        scenario: str,
        action: str,
        goal: float,
        set: Mapping[str, Any] | None,
        threads: int,
        render_mode: str | None,
    ) -> None:
        if action not in ("view", "candidate"):
            raise ValueError(f"action={action!r}: expected 'view' or 'candidate'")
        if render_mode not in (None, *_METADATA["render_modes"]):
            raise ValueError(f"render_mode={render_mode!r}: expected None or 'rgb_array'")
        self.draws = render_mode is not None
        overrides = [f"{key}={_yaml(value)}" for key, value in (set or {}).items()]
        self.core = _core.EnvStage(scenario, overrides, goal)
        self.permits = _core.Permits(max(1, threads or os.cpu_count() or 1))
        self.about: dict[str, Any] = self.core.description
        self.is_candidate = action == "candidate"
        self.low = np.array(self.about["low_m"])
        self.high = np.array(self.about["high_m"])
        self.gimbal = self.about.get("gimbal_rad")

    def mission(self) -> Any:
        return _core.EnvMission(self.core, self.permits, self.is_candidate, self.draws)

    def action_space(self) -> spaces.Space[Any]:
        if self.is_candidate:
            return spaces.Discrete(self.about["candidates"])
        return spaces.Box(-1.0, 1.0, (4 if self.gimbal is None else 5,), np.float32)

    def observation_space(self) -> spaces.Dict:
        parts: dict[str, spaces.Space[Any]] = {
            "map": spaces.Box(0.0, 1.0, self.about["map_shape"], np.float32),
            "pose": spaces.Box(-1.0, 1.0, (5,), np.float32),
            "progress": spaces.Box(-1.0, 1.0, (2,), np.float32),
        }
        if self.is_candidate:
            shape = (self.about["candidates"], self.about["features"])
            parts["candidates"] = spaces.Box(-1.0, 1.0, shape, np.float32)
        return spaces.Dict(parts)

    def checked(self, actions: Any, *batch: int) -> Array:
        """Actions of that batch as an array. Raises ValueError for another shape; what they hold is
        for `check` to look at."""
        given = np.asarray(actions)
        shape = (*batch, *self.action_space().shape)  # type: ignore[misc]
        kinds, words = ("iu", "whole numbers") if self.is_candidate else ("iuf", "numbers")
        if given.shape != shape or given.dtype.kind not in kinds:
            raise ValueError(
                f"step: expected {words} of shape {shape}, got shape {given.shape} of {given.dtype}"
            )
        return given

    def check(self, action: Array, where: str = "") -> None:
        """Raises ValueError for one that is none, which a policy that diverged gives."""
        if self.is_candidate and not 0 <= action < self.about["candidates"]:
            raise ValueError(
                f"step: action{where} {action}: expected 0 to {self.about['candidates'] - 1}"
            )
        if not np.isfinite(action).all():
            raise ValueError(f"step: action{where} {action}: NaN or infinite is no view")

    def view_of(self, action: Array, state: dict[str, Any]) -> Array | None:
        """The view (1 x 5) that an action means; None: a candidate that may not be taken."""
        if self.is_candidate:
            index = int(action)
            return state["views"][index : index + 1] if state["mask"][index] else None
        given = np.clip(action.astype(np.float64), -1.0, 1.0)
        view = np.zeros((1, 5))
        view[0, :3] = self.low + 0.5 * (given[:3] + 1.0) * (self.high - self.low)
        view[0, 3] = np.pi * given[3]
        if self.gimbal is not None:
            low, high = self.gimbal
            view[0, 4] = low + 0.5 * (given[4] + 1.0) * (high - low)
        return view

    def observation(self, state: dict[str, Any], steps: int) -> Observation:
        used = min(1.0, (1 + steps) / self.about["max_iterations"])
        seen = {
            "map": state["map"].reshape(self.about["map_shape"]).copy(),
            "pose": state["pose"].copy(),
            "progress": np.array([state["entropy_left"], used], np.float32),
        }
        if self.is_candidate:
            seen["candidates"] = state["candidates"].copy()
        return seen


class _Episode:
    """One mission, step by step: check_ready(), act() and then result()."""

    def __init__(self, stage: _Stage) -> None:
        self.stage = stage
        self.mission = stage.mission()
        self.state: dict[str, Any] = {}
        self.steps = 0
        self._refused = ""
        self._acts = False
        self.lacks = "was not reset"  # why there can be no step; ""
        self.way: list[Array] = []

    def begin(self, seed: int) -> None:
        self.lacks = "was interrupted, or its mission failed, as it began"
        self.mission.begin(seed)
        self.steps = 0

    def begun(self) -> tuple[Observation, dict[str, Any]]:
        self._refused = ""
        self.state = self.mission.wait()
        self.lacks = ""
        self.way = [self.state["view"][0]]
        return self.stage.observation(self.state, self.steps), self.info()

    def check_ready(self) -> None:
        if self.lacks:
            raise RuntimeError(f"step: the episode {self.lacks}; call reset()")

    def act(self, action: Array) -> None:
        """Of a checked action. Until result() returns nothing can follow."""
        self.lacks = "was interrupted, or its mission failed, in the step before"
        self.steps += 1
        self._acts = not self.state["ended"]  # it may have ended with the profile
        view = self.stage.view_of(action, self.state) if self._acts else None
        self._refused = "masked" if view is None and self._acts else ""
        self._acts = view is not None
        if view is not None:
            self.mission.act(view)

    def result(self) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        before = self.state["coverage"]
        if self._acts:
            self.state = self.mission.wait()
        reward = (self.state["coverage"] - before) / self.stage.about["ceiling"]
        ended = bool(self.state["ended"])
        terminated = ended and self.state["termination"] in _OVER
        # the start's view is the first; what the mission refuses counts here
        is_spent = 1 + self.steps >= self.stage.about["max_iterations"]
        truncated = not terminated and (ended or is_spent)
        self.lacks = "is over" if terminated or truncated else ""
        self.way.append(self.state["view"][0])
        seen = self.stage.observation(self.state, self.steps)
        return seen, float(reward), terminated, truncated, self.info()

    def info(self) -> dict[str, Any]:
        names = ("coverage", "entropy_nat", "cloud_points", "flown_m", "time_s", "termination")
        info = {name: self.state[name] for name in names}
        info["refused"] = self._refused or self.state["refused"]
        if self.stage.is_candidate:
            info["action_mask"] = self.state["mask"].astype(np.int8)
        return info

    def picture(self) -> Array | None:
        """None where no pictures are asked for."""
        if not self.stage.draws:
            return None
        if not self.way:
            raise RuntimeError("render: the episode was not reset; call reset()")
        top = self.state["top"]
        cells = top.reshape(len(top), -1, 2)
        return _picture.from_above(
            cells, self.state["top_low_m"], self.state["top_high_m"], self.way
        )

    def close(self) -> None:
        self.lacks = "is closed"
        self.mission.close()


class NbvEnv(gymnasium.Env[Observation, Any]):
    """One mission at a time; see the module's text."""

    metadata = _METADATA

    def __init__(
        self,
        scenario: str = "smoke",
        action: str = "view",
        goal: float = 0.95,
        set: Mapping[str, Any] | None = None,
        render_mode: str | None = None,
    ) -> None:
        """`goal`: share of the ceiling at which an episode ends, 0: never; `set`: values of the
        scenario by key. Raises gnbv.BadInput."""
        self.render_mode = render_mode
        self._stage = _Stage(scenario, action, goal, set, 1, render_mode)
        self._episode = _Episode(self._stage)
        self.action_space = self._stage.action_space()
        self.observation_space: spaces.Space[Any] = self._stage.observation_space()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """A new mission: the same seed repeats it bit by bit."""
        super().reset(seed=seed)
        self._episode.begin(int(self.np_random.integers(2**31)))
        return self._episode.begun()

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        self._episode.check_ready()
        given = self._stage.checked(action)
        self._stage.check(given)
        self._episode.act(given)
        return self._episode.result()

    def render(self) -> Any:
        return self._episode.picture()

    def action_masks(self) -> Array:
        """As info["action_mask"], under the name that sb3-contrib asks for."""
        return np.asarray(self._episode.state["mask"], dtype=bool)

    def close(self) -> None:
        self._episode.close()


class NbvVectorEnv(VectorEnv[Any, Any, Any]):
    """Many missions at once, each on a C++ thread, `threads` of them flying at a time (0: as many
    as the machine has). Results do not depend on it. An episode that is over begins anew with the
    next step (AutoresetMode.NEXT_STEP)."""

    metadata = _VECTOR_METADATA

    def __init__(
        self,
        num_envs: int = 1,
        scenario: str = "smoke",
        action: str = "view",
        goal: float = 0.95,
        set: Mapping[str, Any] | None = None,
        threads: int = 0,
        render_mode: str | None = None,
    ) -> None:
        self.num_envs = num_envs
        self.render_mode = render_mode
        self._stage = _Stage(scenario, action, goal, set, threads, render_mode)
        self._episodes = [_Episode(self._stage) for _ in range(num_envs)]
        self._over = np.zeros(num_envs, dtype=bool)
        self._randoms: list[np.random.Generator] = []
        self.single_action_space = self._stage.action_space()
        self.single_observation_space = self._stage.observation_space()
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)

    def reset(
        self,
        *,
        seed: Optional[Union[int, Sequence[Optional[int]]]] = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Observation, dict[str, Any]]:
        """Environment i gets seed + i, and does what a single one with that seed does."""
        seeds = (
            [None if seed is None else int(seed) + i for i in range(self.num_envs)]
            if (seed is None or isinstance(seed, (int, np.integer)))
            else list(seed)
        )
        if len(seeds) != self.num_envs:
            raise ValueError(f"reset: {len(seeds)} seeds for {self.num_envs} environments")
        if seed is not None or not self._randoms:
            self._randoms = [gymnasium.utils.seeding.np_random(s)[0] for s in seeds]
        self._over[:] = False
        for episode, random in zip(self._episodes, self._randoms, strict=True):
            episode.begin(int(random.integers(2**31)))
        seen, infos = zip(*(episode.begun() for episode in self._episodes), strict=True)
        return self._stacked(seen), self._infos(infos)

    def step(self, actions: Any) -> tuple[Observation, Array, Array, Array, dict[str, Any]]:
        again = self._over.copy()
        given = self._stage.checked(actions, self.num_envs)
        for i, episode in enumerate(self._episodes):
            if not again[i] or episode.lacks != "is over":
                episode.check_ready()
                self._stage.check(given[i], f" {i}")
        for i, episode in enumerate(self._episodes):
            if again[i]:
                episode.begin(int(self._randoms[i].integers(2**31)))
            else:
                episode.act(given[i])
        results = []
        for i, episode in enumerate(self._episodes):
            if again[i]:
                first, info = episode.begun()
                results.append((first, 0.0, False, False, info))
            else:
                results.append(episode.result())
        seen, rewards, terminated, truncated, infos = zip(*results, strict=True)
        ended, cut = np.array(terminated), np.array(truncated)
        self._over = ended | cut
        return self._stacked(seen), np.array(rewards), ended, cut, self._infos(infos)

    def _stacked(self, seen: Sequence[Observation]) -> Observation:
        return {key: np.stack([one[key] for one in seen]) for key in seen[0]}

    def _infos(self, infos: Sequence[dict[str, Any]]) -> dict[str, Any]:
        out: dict[str, Any] = {}
        for i, info in enumerate(infos):
            out = self._add_info(out, info, i)
        return out

    def render(self) -> Any:
        """A picture of each."""
        return tuple(episode.picture() for episode in self._episodes) if self.render_mode else None

    def close_extras(self, **kwargs: Any) -> None:
        for episode in getattr(self, "_episodes", []):  # none where __init__ raised
            episode.close()


for _name, _scenario in SCENARIOS.items():
    gymnasium.register(
        id=f"gnbv/{_name}-v0",
        entry_point="gnbv.gym:NbvEnv",
        vector_entry_point="gnbv.gym:NbvVectorEnv",
        kwargs={"scenario": _scenario},
    )
