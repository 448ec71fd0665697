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

With `observe`, some of "depth", "rgb", "crop", "poses", also: "depth_NAME" (H, W) of each camera, m
along the optical axis, 0 nearer than it measures and its range where nothing returns; "rgb_NAME"
(H, W, 3), sRGB; "crop" (2, `crop`, `crop`, `crop`), the map's own voxels (z, y, x) around the
vehicle: the probability of occupied, 0.5 unmeasured and outside, and the density of the cloud's
points, a share of belief.density_max; "candidate_poses": x, y, z of the navigation box, sine and
cosine of the yaw, pitch / (pi / 2). `env.belief` is all that is believed, as a planner of gnbv.run
gets it.

State: `clone_state()` and `restore_state(state)` go back to any step, exactly, as do
copy.deepcopy(env) and pickle: the former by a copy of the mission, the latter by flying its actions
again. With `seeds=N` episodes are of seeds 0 to N - 1, and the profile of each is flown once: steps
are then several times as fast. The profile of a scenario whose seed changes nothing of it is kept
anyway.

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

import copy
from collections.abc import Mapping, Sequence
from dataclasses import replace
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

from gnbv._episode import Episode, State
from gnbv._mission import whole
from gnbv._planner import Belief
from gnbv._stage import METADATA, Array, Observation, Stage

SCENARIOS = {
    "Aircraft": "aircraft",
    "PowerPlant": "power_plant",
    "LabModel": "lab_model",
    "LabAirplane": "lab_airplane",
    "Smoke": "smoke",
}
_VECTOR_METADATA: dict[str, Any] = dict(METADATA)
if hasattr(gymnasium.vector, "AutoresetMode"):  # Gymnasium 1.0 has no word for what it does
    _VECTOR_METADATA["autoreset_mode"] = gymnasium.vector.AutoresetMode.NEXT_STEP


_OWN = ("_stage", "_episode")  # of an environment: neither copied nor pickled


class NbvEnv(gymnasium.Env[Observation, Any]):
    """One mission at a time; see the module's text."""

    metadata = METADATA

    def __init__(
        self,
        scenario: str = "smoke",
        action: str = "view",
        goal: float = 0.95,
        set: Mapping[str, Any] | None = None,
        render_mode: str | None = None,
        seeds: int = 0,
        observe: Sequence[str] = (),
        crop: int = 32,
    ) -> None:
        """`goal`: share of the ceiling at which an episode ends, 0: never; `set`: values of the
        scenario by key; `seeds`: episodes are missions of so many seeds, 0 to seeds - 1, whose
        profiles are kept; 0: of any; `observe`, `crop`: what more is observed, and the crop's edge
        in voxels. Raises gnbv.BadInput."""
        self.render_mode = render_mode
        flown = (scenario, action, goal, dict(set or {}), 1)
        self._made = (*flown, render_mode, seeds, tuple(observe), crop)
        self._stage = Stage(*self._made)
        self._episode = Episode(self._stage)
        self.action_space = self._stage.action_space()
        self.observation_space: spaces.Space[Any] = self._stage.observation_space()

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """A new mission: the same seed repeats it bit by bit."""
        super().reset(seed=seed)
        self._episode.begin(self.np_random)
        return self._episode.begun()

    def step(self, action: Any) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        self._episode.check_ready()
        given = self._stage.checked(action)
        self._stage.check(given)
        self._episode.act(given)
        return self._episode.result()

    def render(self) -> Any:
        return self._episode.picture()

    @property
    def belief(self) -> Belief:
        """What is believed now: gnbv.Belief, a copy that stays as it is."""
        return self._episode.belief()

    def action_masks(self) -> Array:
        """As info["action_mask"], under the name that sb3-contrib asks for."""
        self._episode.need("action_masks")
        return np.asarray(self._episode.state["mask"], dtype=bool)

    def clone_state(self) -> State:
        """All that the episode is, its random numbers included: from a restored state the same
        actions bring the same. Costs a copy of what is believed; the mission does not go on."""
        return replace(self._episode.kept(), random=copy.deepcopy(self.np_random))

    def restore_state(self, state: State) -> None:
        """Goes on where clone_state() was called, of this or of another environment made with the
        same arguments; ValueError for one that was not."""
        self._episode.restore(state)
        self._np_random = copy.deepcopy(state.random)

    @property
    def result_sha256(self) -> str:
        """Of a mission that is over what summary.json of `gnbv run` says; "" otherwise."""
        return str(self._episode.mission.result_sha256())

    def __getstate__(self) -> dict[str, Any]:
        kept = {key: value for key, value in self.__dict__.items() if key not in _OWN}
        is_there = self._episode.lacks in ("", "is over")
        return {**kept, "_state": self.clone_state() if is_there else None}

    def _take_over(self, given: dict[str, Any], state: State | None, stage: Stage) -> None:
        self.__dict__.update(given)
        self._stage = stage
        self._episode = Episode(stage)
        if state is not None:
            self.restore_state(state)

    def __setstate__(self, given: dict[str, Any]) -> None:
        self._take_over(given, given.pop("_state"), Stage(*given["_made"]))

    def __deepcopy__(self, memo: dict[int, Any]) -> NbvEnv:
        """Another one, in the same state; what does not change is shared."""
        made = type(self).__new__(type(self))
        given = self.__getstate__()
        state = given.pop("_state")
        made._take_over(copy.deepcopy(given, memo), state, self._stage)
        return made

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
        seeds: int = 0,
        observe: Sequence[str] = (),
        crop: int = 32,
    ) -> None:
        self.num_envs = num_envs = whole("num_envs", num_envs, 1, 2**31)
        self.render_mode = render_mode
        self._stage = Stage(scenario, action, goal, set, threads, render_mode, seeds, observe, crop)
        self._episodes = [Episode(self._stage) for _ in range(num_envs)]
        self._over = np.zeros(num_envs, dtype=bool)
        self._randoms: list[Any] = [None] * num_envs
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
        self._randoms = [  # no seed goes on with the random numbers that there are
            before if s is None and before else gymnasium.utils.seeding.np_random(s)[0]
            for s, before in zip(seeds, self._randoms, strict=True)
        ]
        self._over[:] = False
        for episode, random in zip(self._episodes, self._randoms, strict=True):
            episode.begin(random)
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
                episode.begin(self._randoms[i])
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
