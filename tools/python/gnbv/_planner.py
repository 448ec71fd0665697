"""What a planner of your own sees: Belief and History. None of it knows the true structure.

The program runs this file, too, where a planner flies from its source: it needs NumPy alone.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from gnbv._errors import BadInput

HISTORY_DTYPE = np.dtype(
    [("iteration", "i8"), ("x", "f8"), ("y", "f8"), ("z", "f8"), ("yaw", "f8")]
    + [("gimbal_pitch", "f8"), ("entropy_nat", "f8"), ("cloud_points", "i8")]
    + [("flown_m", "f8"), ("time_s", "f8")]
)


class View(NamedTuple):
    """Where to look from: the body's position (m, world ENU), yaw and gimbal pitch (rad)."""

    x: float
    y: float
    z: float
    yaw: float
    gimbal_pitch: float = 0.0


Views = Union[View, npt.ArrayLike]


class Belief:
    """What the planner believes, for the call that it was handed to.

    The arrays share the map's memory and cannot be written. Copy what is to outlast the call: a
    planner that keeps one of them beyond it ends the mission with BufferError. (A planner that
    flies from a file has copies.)
    """

    def __init__(self, view: Any, frames: Any = None) -> None:
        self._view = view
        self._frames = frames

    @property
    def log_odds(self) -> npt.NDArray[np.float32]:
        """Of occupied, natural logarithm, 0 = unmeasured; shape (z, y, x); shared memory."""
        return self._view.log_odds  # type: ignore[no-any-return]

    @property
    def words(self) -> npt.NDArray[np.uint32]:
        """All that is known of each voxel, packed: bits 0-1 its state; bit 2 measured; bit 3
        predicted by symmetry; bits 8-31 ln 2 minus its entropy, in 2^-24 nat. Shared memory."""
        return self._view.words  # type: ignore[no-any-return]

    @property
    def state(self) -> npt.NDArray[np.uint8]:
        """0 unknown, 1 free, 2 occupied; shape (z, y, x)."""
        return (self.words & 3).astype(np.uint8)

    @property
    def is_predicted(self) -> npt.NDArray[np.bool_]:
        """Whether symmetry predicts surface there; shape (z, y, x)."""
        return (self.words & 8).astype(np.bool_)

    @property
    def entropy(self) -> npt.NDArray[np.float32]:
        """Of each voxel, nat; ln 2 while unmeasured; shape (z, y, x)."""
        return ((11629080 - (self.words >> 8)) * np.float32(2.0**-24)).astype(np.float32)

    @property
    def entropy_nat(self) -> float:
        """Sum over all voxels, nat."""
        return float(self._view.entropy_nat)

    @property
    def resolution_m(self) -> float:
        return float(self._view.resolution_m)

    @property
    def origin_m(self) -> npt.NDArray[np.float64]:
        """The lowest corner of voxel (0, 0, 0): x, y, z."""
        return np.array(self._view.origin_m)

    @property
    def navigation_m(self) -> npt.NDArray[np.float64]:
        """Where views may be: the lowest and the highest corner; shape (2, 3)."""
        return self._view.navigation_m  # type: ignore[no-any-return]

    @property
    def cloud(self) -> npt.NDArray[np.float32]:
        """Points of the surface so far, n x 3, m; shared memory."""
        return self._view.cloud  # type: ignore[no-any-return]

    @property
    def density(self) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.float64]]:
        """Flat indices (of shape z, y, x) of the voxels with points; their density: the mean
        number of neighbours of a point within voxel / sqrt(2)."""
        return self._view.density  # type: ignore[no-any-return]

    @property
    def density_max(self) -> float:
        """What densities are shares of: 3 (voxel / leaf of the cloud)^2. No plane reaches it."""
        return float(self._view.density_max)

    @property
    def frames(self) -> list[Any]:
        """What each camera saw at the latest view: gnbv.Frame, its own copies. In colour where the
        mission keeps frames (gnbv.run(..., frames=True)) or an environment observes "rgb". Raises
        BadInput for a planner that flies from a file, and for an environment that observes neither
        "depth" nor "rgb"."""
        if self._frames is None:
            raise BadInput(
                "belief.frames: only a planner of this process, gnbv.run(planner=), has, and an "
                "environment made with observe=('depth',) or 'rgb'"
            )
        self._view.current  # noqa: B018  (raises after the call)
        from gnbv._frames import Frame  # a planner in a file has this module alone

        return [Frame(*fields) for fields in self._frames()]

    @property
    def current(self) -> View:
        """The latest view."""
        return View(*map(float, self._view.current[0]))

    def sample(self, scale: float = 1.0) -> npt.NDArray[np.float64]:
        """Views on the grid around the current one (AGVS), its steps times `scale`; n x 5, as
        View."""
        given = numbers(scale)
        if given is None or given.ndim or not 0.0 <= given < np.inf:
            raise BadInput(f"sample: scale {scale!r}: expected a number from 0")
        return self._view.sample(float(given))  # type: ignore[no-any-return]

    def sample_frontiers(self) -> npt.NDArray[np.float64]:
        """Views of the thinly sampled surface (FVS); n x 5, as View."""
        return self._view.sample_frontiers()  # type: ignore[no-any-return]

    def validate(self, views: Views) -> tuple[npt.NDArray[np.str_], npt.NDArray[np.float64]]:
        """For each view "" or why it would be refused as the next one, and the way's length (m).

        What blocks the straight way is flown around, and a view may be taken again.
        """
        reasons, path_m = self._view.validate(view_rows(views))
        return np.array(reasons, dtype="U24"), path_m

    def valid(self, views: Views) -> npt.NDArray[np.float64]:
        """Those that may be flown to."""
        rows = view_rows(views)
        kept: npt.NDArray[np.float64] = rows[self.validate(rows)[0] == ""]
        return kept

    def evaluate(self, views: Views) -> npt.NDArray[Any]:
        """What each view would see: a structured array, a row a view.

        Voxels that the rays of all cameras cross, up to and with the first occupied one of each
        ray. Each voxel once: free_voxels, unknown_voxels, occupied_voxels, predicted_voxels (the
        first of each ray), sparse_voxels, entropy_nat (nat), density_sum and density_max (points
        a voxel), voxel_m3 (m3 of one). Once a ray: entropy_per_ray_nat (nat). Of the rays (counts
        but where a unit says else): rays, rays_occupied, occlusion_aware_nat, unobserved_nat,
        rear_side_rays, rear_side_nat, crossed_by_occupied (voxels), entropy_of_occupied_nat,
        unknown_volume_m3, front_rays. path_m: the straight way (m), also where a utility gets the
        length of the way around. Only utilities get proximity_sum, shadow_rays and
        the pose.
        """
        rows = view_rows(views)
        for i in np.flatnonzero(np.abs(rows[:, :3]).max(axis=1, initial=0.0) > _FARTHEST_M)[:1]:
            raise BadInput(f"evaluate: view {i}, {View(*rows[i].tolist())}: is beyond all maps")
        return np.frombuffer(self._view.evaluate(rows), np.dtype(self._view.stats_dtype))

    def find_path(
        self, start: npt.ArrayLike, goal: npt.ArrayLike
    ) -> npt.NDArray[np.float64] | None:
        """Points (n x 3, m) between the two where the straight way is blocked; None: no way.

        The ends are x, y, z (m), or views.
        """
        ends = []
        for given in (start, goal):
            point = numbers(given)
            if point is None or point.ndim != 1 or len(point) < 3 or not np.isfinite(point).all():
                raise BadInput(f"find_path: expected finite x, y, z, got {given!r:.200}")
            ends.append(point[:3].tolist())
        return self._view.find_path(*ends)  # type: ignore[no-any-return]


class History:
    """What was done so far.

    Attributes:
        refused: (View, reason) of those that could not be flown since the latest view.
    """

    def __init__(self) -> None:
        self._rows: list[tuple[Any, ...]] = []
        self.refused: list[tuple[View, str]] = []

    @property
    def views(self) -> npt.NDArray[Any]:
        """A row a view that was taken, the latest last.

        iteration (from 0); x, y, z of the body (m, world ENU); yaw and gimbal_pitch (rad);
        entropy_nat of the map and cloud_points after the view; flown_m and time_s (simulated)
        since the start.
        """
        return np.array(self._rows, dtype=HISTORY_DTYPE)

    def __len__(self) -> int:
        return len(self._rows)


Answer = Optional[Views]
Planner = Callable[[Belief, History], Answer]
_MOST_REFUSED = 1000
_FARTHEST_M = 1e6


class AskedPlanner:
    """A planner as the mission asks it. The names are those that _core.run calls."""

    def __init__(self, planner: Planner) -> None:
        self._planner = planner
        self._history = History()
        self._latest: View | None = None

    def plan(self, view: Any, frames: Any = None) -> npt.NDArray[np.float64] | None:
        if len(self._history.refused) >= _MOST_REFUSED:
            raise BadInput(f"planner: {_MOST_REFUSED} views in a row could not be flown")
        answer = self._planner(Belief(view, frames), self._history)
        if answer is None:
            return None
        rows = view_rows(answer)
        if len(rows) > 1:  # candidates: the first that may be flown to
            valid = Belief(view).valid(rows)
            rows = valid if len(valid) else rows
        if not len(rows):
            return None
        self._latest = View(*map(float, rows[0]))
        return rows[:1]

    def on_view(self, row: dict[str, Any]) -> None:
        self._history._rows.append(tuple(row[name] for name in HISTORY_DTYPE.names or ()))
        self._history.refused = []

    def on_refused(self, reason: str) -> None:
        if self._latest is not None:
            self._history.refused.append((self._latest, reason))

    def kept(self) -> None:
        raise BufferError(
            "planner: kept an array of the belief beyond its call, after which it changes: copy it"
        )


def numbers(given: Any) -> npt.NDArray[np.float64] | None:
    """As an array. None for what is no real numbers, such as text, complex or masked ones."""
    try:
        array = np.asanyarray(given)
        if array.dtype.kind not in "biufO" or np.ma.is_masked(array):
            return None
        return np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        return None


def view_rows(views: Any) -> npt.NDArray[np.float64]:
    """Views as rows of five finite numbers. Raises BadInput for anything else."""
    rows = numbers(views)
    if rows is not None and rows.size == 0:
        return np.empty((0, 5))
    if rows is not None:
        rows = np.atleast_2d(rows)
    if rows is None or rows.ndim != 2 or rows.shape[1] not in (4, 5) or not np.isfinite(rows).all():
        raise BadInput(
            f"view: expected finite x, y, z, yaw and perhaps gimbal_pitch, got {views!r:.200}"
        )
    if rows.shape[1] == 4:
        rows = np.hstack([rows, np.zeros((len(rows), 1))])
    return np.ascontiguousarray(rows)
