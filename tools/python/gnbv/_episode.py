"""One mission of an environment of gnbv.gym, step by step, and how it is kept."""

from __future__ import annotations

import copy
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gnbv import _picture
from gnbv._planner import Belief
from gnbv._stage import Array, Observation, Stage

_OVER = ("coverage_reached", "collision", "off_course")


@dataclass(frozen=True)
class State:
    """An environment as clone_state() found it, for restore_state() of one that was made alike.

    It holds a copy of the mission. One that was pickled holds the actions instead, as does one of a
    vehicle that touches something: to be restored it is flown again from reset() on.
    """

    made_by: tuple[Any, ...]
    seed: int
    actions: tuple[Array, ...]
    moment: Any
    now: tuple[Any, ...]
    random: np.random.Generator | None = None

    def __getstate__(self) -> dict[str, Any]:
        return replace(self, moment=None).__dict__


class Episode:
    """One mission, step by step: check_ready(), act() and then result()."""

    def __init__(self, stage: Stage) -> None:
        self.stage = stage
        self.mission = stage.mission()
        self.state: dict[str, Any] = {}
        self.steps = 0
        self._refused = ""
        self._acts = False
        self.lacks = "was not reset"  # why there can be no step; ""
        self.way: list[Array] = []
        self.seed = 0
        self.actions: list[Array] = []

    def begin(self, random: np.random.Generator) -> None:
        self._begin(int(random.integers(self.stage.seeds)))

    def _begin(self, seed: int) -> None:
        self.lacks = "was interrupted, or its mission failed, as it began"
        self.mission.begin(seed)
        self.seed = seed
        self.actions = []
        self.steps = 0

    def begun(self) -> tuple[Observation, dict[str, Any]]:
        self._refused = ""
        self.state = self.mission.wait()
        self.lacks = ""
        self.way = [self.state["view"][0]]
        return self.stage.observation(self.state, self.steps), self.info()

    def need(self, asked: str) -> None:
        """Raises RuntimeError where there is no mission that could answer."""
        if self.lacks not in ("", "is over"):
            raise RuntimeError(f"{asked}: the episode {self.lacks}; call reset()")

    def check_ready(self) -> None:
        if self.lacks:
            raise RuntimeError(f"step: the episode {self.lacks}; call reset()")

    def act(self, action: Array) -> None:
        """Of a checked action. Until result() returns nothing can follow."""
        self.lacks = "was interrupted, or its mission failed, in the step before"
        self.steps += 1
        self.actions.append(action.copy())
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

    def belief(self) -> Belief:
        self.need("belief")
        frames = self.state.get("frames")  # as observations have them
        copied = None if frames is None else lambda: copy.deepcopy(frames)
        return Belief(self.mission.belief(), copied)

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

    def kept(self) -> State:
        """Raises RuntimeError where a step would raise for want of a mission."""
        self.need("clone_state")
        try:
            moment = self.mission.keep()
        except RuntimeError:  # the vehicle touches something
            moment = None
        now = (self.steps, self._refused, self.lacks, tuple(self.way))
        return State(self.stage.made_by, self.seed, tuple(self.actions), moment, now)

    def restore(self, state: State) -> None:
        if state.made_by != self.stage.made_by:
            raise ValueError(
                f"restore_state: a state of {state.made_by}, this is {self.stage.made_by}"
            )
        self.lacks = "was interrupted, or its mission failed, as it was restored"
        if state.moment is None:
            self._begin(state.seed)
            self.begun()
            for action in state.actions:
                self.act(action)
                self.result()
            return
        self.mission.resume(state.moment)
        self.state = self.mission.wait()
        self.seed, self.actions = state.seed, list(state.actions)
        self.steps, self._refused, self.lacks, way = state.now
        self.way = list(way)

    def close(self) -> None:
        self.lacks = "is closed"
        self.mission.close()
