"""What cameras saw: belief.frames and run.frames."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, Optional, Union, overload

import numpy as np
import numpy.typing as npt


class Frame(NamedTuple):
    """What one camera saw at one view, and from where.

    The centre of the pixel of column u and row v lies at (u + 0.5, v + 0.5), and the point it
    sees, in the camera's optical frame (x right, y down, z forward), is
    depth_m[v, u] * inv(K) @ (u + 0.5, v + 0.5, 1). Where cameras.N.distortion bends the image,
    inv(K) @ ... is the distorted direction: undo that first, with OpenCV's undistortPoints.

    Attributes:
        depth_m: (H, W) float32, m along the optical axis. Of belief.frames, inf: no return up to
            the camera's range, NaN: nearer than it measures. Of run.frames, which come from files
            of millimetres, NaN for both.
        rgb: (H, W, 3) uint8, sRGB; None of belief.frames where the mission keeps no frames.
        K: (3, 3), pixels.
        T_world_camera: (4, 4), m, world ENU; as believed.
    """

    camera: str
    iteration: int
    time_s: float
    depth_m: npt.NDArray[np.float32]
    rgb: Optional[npt.NDArray[np.uint8]]
    K: npt.NDArray[np.float64]
    T_world_camera: npt.NDArray[np.float64]


class Frames(Sequence[Frame]):
    """The frames of a run: by iteration, then by camera; each is read when it is asked for."""

    def __init__(self, record: Any) -> None:
        self._record = record

    def __len__(self) -> int:
        return len(self._record)

    @overload
    def __getitem__(self, index: int) -> Frame: ...
    @overload
    def __getitem__(self, index: slice) -> list[Frame]: ...
    def __getitem__(self, index: Union[int, slice]) -> Union[Frame, list[Frame]]:
        places = range(len(self))[index]
        if isinstance(places, range):
            return [Frame(*self._record.read(i)) for i in places]
        return Frame(*self._record.read(places))
