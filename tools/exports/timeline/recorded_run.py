"""A run as arrays, for what writes it onto a timeline. NumPy alone; metres, seconds since the
beginning of the mission, world ENU."""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np


@dataclass
class Frame:
    """What one camera saw at a view. Files are PNG; None where frames were not kept."""

    view: int
    time_s: float
    position: tuple[float, ...]
    quaternion: tuple[float, ...]  # x y z w; optical frame (x right, y down, z forward) in world
    colour: Path | None
    depth: Path | None  # 16 bits, millimetres along the optical axis, 0 where there is none


@dataclass
class Camera:
    """A pinhole, and its lens's distortion with the coefficients in OpenCV's order."""

    name: str
    width_px: int
    height_px: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    skew_px: float
    distortion: str  # none, brown_conrady or kannala_brandt
    coefficients: list[float]
    frames: list[Frame]


@dataclass
class Growth:
    """Points that came at one time."""

    view: int  # -1: the profile
    time_s: float
    points: np.ndarray


@dataclass
class Mesh:
    """Triangles, and a colour each."""

    vertices: np.ndarray  # n x 3
    triangles: np.ndarray  # m x 3
    colours: np.ndarray  # m x 3, 0 to 255


class RecordedRun:
    """Of what the program knows of the run (timeline.cpp)."""

    def __init__(self, scene: dict[str, Any]) -> None:
        self.name: str = scene["name"]
        self.id: str = scene["id"]
        structure = scene["structure"]
        self.structure = structure and Mesh(
            np.fromfile(structure["vertices"], "<f4").reshape(-1, 3),
            np.fromfile(structure["triangles"], "<u4").reshape(-1, 3),
            np.fromfile(structure["colours"], "u1").reshape(-1, 3),
        )
        # rows of time, x, y, z, qx, qy, qz, qw
        self.trajectory = np.array(scene["trajectory"], float).reshape(-1, 8)
        # times and values
        self.plots = {name: np.array(rows, float).T for name, rows in scene["plots"].items()}
        self.cameras = [
            Camera(**{**camera, "frames": [_frame(*frame) for frame in camera["frames"]]})
            for camera in scene["cameras"]
        ]
        points = np.fromfile(scene["points"], "<f4").reshape(-1, 3)
        self.growth, begin = [], 0
        for view, time_s, end in scene["growth"]:
            self.growth.append(Growth(view, time_s, points[begin:end]))
            begin = end


def _frame(view: int, pose: list[float], colour: str | None, depth: str | None) -> Frame:
    images = (name and Path(name) for name in (colour, depth))
    return Frame(view, pose[0], tuple(pose[1:4]), tuple(pose[4:8]), *images)


def main(scene: dict[str, Any]) -> dict[str, int]:
    """Writes the scene's run in its format; how many of what was written."""
    return importlib.import_module(f"to_{scene['format']}").write(RecordedRun(scene), scene["out"])
