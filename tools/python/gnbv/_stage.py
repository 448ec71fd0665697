"""What the episodes of an environment share: the loaded world, the spaces, what an action means."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from gnbv import _core
from gnbv._errors import BadInput
from gnbv._frames import Frame
from gnbv._mission import MOST_THREADS, settings, text_of, whole

METADATA: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 4}
OBSERVE = ("depth", "rgb", "crop", "poses")
Array = npt.NDArray[Any]
Observation = dict[str, Array]


class Stage:
    """What episodes share: the loaded world, the spaces, and what an action means."""

    def __init__(
        self,
        scenario: str,
        action: str,
        goal: float,
        set: Mapping[str, Any] | None,
        threads: int,
        render_mode: str | None,
        seeds: int,
        observe: Sequence[str] = (),
        crop: int = 32,
    ) -> None:
        if action not in ("view", "candidate"):
            raise ValueError(f"action={action!r}: expected 'view' or 'candidate'")
        if render_mode not in (None, *METADATA["render_modes"]):
            raise ValueError(f"render_mode={render_mode!r}: expected None or 'rgb_array'")
        if not 0.0 <= goal <= 1.0:
            raise BadInput(f"goal: value {goal!r}: expected a share of the ceiling, 0 to 1")
        seeds = whole("seeds", seeds, 0, 2**31)
        threads = whole("threads", threads, 0, MOST_THREADS)
        crop = whole("crop", crop, 1, 256)
        self.seeds = seeds or 2**31
        unknown = [name for name in observe if name not in OBSERVE]
        if unknown or isinstance(observe, str):
            raise ValueError(f"observe={observe!r}: expected some of {', '.join(OBSERVE)}")
        if "poses" in observe and action != "candidate":
            raise ValueError("observe: poses are those of action='candidate'")
        self.observe, self.crop = tuple(observe), crop
        made_of = (repr(dict(set or {})), render_mode, seeds, self.observe, crop)
        self.made_by = (str(scenario), action, goal, *made_of)
        self.draws = render_mode is not None
        self.core = _core.EnvStage(text_of("scenario", scenario), settings(set), goal, seeds)
        self.permits = _core.Permits(max(1, threads or os.cpu_count() or 1))
        self.about: dict[str, Any] = self.core.description
        self.is_candidate = action == "candidate"
        self.low = np.array(self.about["low_m"])
        self.high = np.array(self.about["high_m"])
        self.gimbal = self.about.get("gimbal_rad")

    def mission(self) -> Any:
        sees = self.observe
        wishes = _core.EnvWishes(
            candidates=self.is_candidate,
            top=self.draws,
            frames="depth" in sees or "rgb" in sees,
            colour="rgb" in sees,
            crop=self.crop if "crop" in sees else 0,
        )
        return _core.EnvMission(self.core, self.permits, wishes)

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
        if "poses" in self.observe:
            shape = (self.about["candidates"], 6)
            parts["candidate_poses"] = spaces.Box(-1.0, 1.0, shape, np.float32)
        if "crop" in self.observe:
            parts["crop"] = spaces.Box(0.0, 1.0, (2, *3 * (self.crop,)), np.float32)
        for name, height, width, range_max_m in self.about["cameras"]:
            if "depth" in self.observe:
                box = spaces.Box(0.0, range_max_m, (height, width), np.float32)
                parts[f"depth_{name}"] = box
            if "rgb" in self.observe:
                parts[f"rgb_{name}"] = spaces.Box(0, 255, (height, width, 3), np.uint8)
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
        if "poses" in self.observe:
            seen["candidate_poses"] = self._poses(state["views"])
        if "crop" in self.observe:
            seen["crop"] = state["crop"].reshape(2, *3 * (self.crop,)).copy()
        if "depth" in self.observe or "rgb" in self.observe:
            seen.update(self._images(state.get("frames", [])))
        return seen

    def _poses(self, views: Array) -> Array:
        """Of each candidate x, y, z of the navigation box, sine and cosine of its yaw, its pitch
        as a share of a right angle; in [-1, 1]."""
        place = 2.0 * (views[:, :3] - self.low) / (self.high - self.low) - 1.0
        turned = [np.sin(views[:, 3]), np.cos(views[:, 3]), views[:, 4] / (np.pi / 2)]
        poses: Array = np.column_stack([place, *turned])
        return poses.clip(-1.0, 1.0).astype(np.float32)

    def _images(self, frames: list[tuple[Any, ...]]) -> Observation:
        """Of each camera; black where its frame was lost."""
        found = {frame.camera: frame for frame in (Frame(*fields) for fields in frames)}
        out: Observation = {}
        for name, height, width, range_max_m in self.about["cameras"]:
            frame = found.get(name)
            if "depth" in self.observe:
                depth_m = frame.depth_m if frame else np.zeros((height, width), np.float32)
                depth_m = np.nan_to_num(depth_m, nan=0.0, posinf=range_max_m)
                out[f"depth_{name}"] = np.clip(depth_m, 0.0, np.float32(range_max_m))
            if "rgb" in self.observe:
                rgb = frame.rgb if frame else None
                black = np.zeros((height, width, 3), np.uint8)
                out[f"rgb_{name}"] = black if rgb is None else rgb.copy()
        return out
