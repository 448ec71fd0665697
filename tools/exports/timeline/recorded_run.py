"""A run folder as arrays, for what writes it onto a timeline. NumPy alone; metres, seconds since
the beginning of the mission, world ENU."""

from __future__ import annotations

import csv
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
    """A pinhole without distortion."""

    name: str
    width_px: int
    height_px: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    frames: list[Frame]


@dataclass
class Growth:
    """Points that came at one time."""

    view: int  # -1: the profile
    time_s: float
    points: np.ndarray


class RecordedRun:
    """`scene` is what the program knows of the run beside its files (timeline.cpp)."""

    def __init__(self, scene: dict[str, Any]) -> None:
        self.name: str = scene["name"]
        self.id: str = scene["id"]
        self.folder = Path(scene["run"])
        self.structure = _mesh(Path(scene["structure"])) if scene["structure"] else None
        self.trajectory = _trajectory(self.folder / "trajectory.tum")
        self.plots = _plots(self.folder)
        self.cameras = [self._camera(camera) for camera in scene["cameras"]]
        self.growth = self._growth(scene["cloud"])

    def _camera(self, camera: dict[str, Any]) -> Camera:
        def file(name: str) -> Path | None:
            return self.folder / "frames" / name if name else None

        frames = [
            Frame(int(f[0]), f[1], tuple(f[2:5]), tuple(f[5:9]), file(f[9]), file(f[10]))
            for f in camera.pop("frames")
        ]
        return Camera(frames=frames, **camera)

    def _growth(self, ends: list[list[float]]) -> list[Growth]:
        """`ends`: view, time and the number of points that there were then."""
        if not ends:
            return []
        points = np.stack([_ply(self.folder / "cloud.ply")[1][axis] for axis in "xyz"], axis=1)
        grown, begin = [], 0
        for view, time_s, end in ends:
            grown.append(Growth(int(view), time_s, points[begin : int(end)]))
            begin = int(end)
        return grown


def _plots(folder: Path) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Times and values by name: of each view, and of the profile where coverage.csv has it."""
    views = _csv(folder / "iterations.csv")
    if not len(views["time_s"]):
        return {}
    names = ("utility", "entropy_nat", "density_points_per_voxel", "cloud_points", "flown_m")
    plots = {name: (views["time_s"], views[name]) for name in names if name in views}
    coverage = _csv(folder / "coverage.csv")
    for name, values in coverage.items():
        if name.startswith("coverage_") and len(values) > 1:
            # its seconds count from the end of the profile, row 0; row 1 is the first view's
            times_s = views["time_s"][0] - coverage["seconds"][1] + coverage["seconds"]
            plots[name.replace("coverage_", "coverage/")] = (times_s, values)
    return plots


def _csv(file: Path) -> dict[str, np.ndarray]:
    """The columns that are numbers; none of a file that is not there."""
    if not file.exists():
        return {"time_s": np.empty(0)}
    with file.open(newline="", encoding="utf-8") as text:
        header, *rows = list(csv.reader(text))
    columns: dict[str, np.ndarray] = {}
    for name, *cells in zip(header, *rows, strict=True):
        try:
            columns[name] = np.array(cells, dtype=float)
        except ValueError:
            continue
    return columns


def _trajectory(file: Path) -> np.ndarray:
    """Rows of time, x, y, z, qx, qy, qz, qw."""
    return np.loadtxt(file, ndmin=2) if file.exists() else np.empty((0, 8))


KINDS = {"float": "<f4", "uchar": "u1", "int": "<i4"}


def _ply(file: Path) -> tuple[list[tuple[str, int]], np.ndarray, bytes]:
    """The elements of a binary PLY, its vertices, and the bytes behind them."""
    head, _, body = file.read_bytes().partition(b"end_header\n")
    elements: list[tuple[str, int]] = []
    vertex: list[tuple[str, str]] = []
    for words in (line.split() for line in head.decode().splitlines()):
        if words[0] == "element":
            elements.append((words[1], int(words[2])))
        elif words[0] == "property" and elements[-1][0] == "vertex":
            vertex.append((words[2], KINDS[words[1]]))
    dtype = np.dtype(vertex)
    size = dtype.itemsize * elements[0][1]
    return elements, np.frombuffer(body[:size], dtype), body[size:]


@dataclass
class Mesh:
    """Triangles, and a colour each."""

    vertices: np.ndarray  # n x 3
    triangles: np.ndarray  # m x 3
    colours: np.ndarray  # m x 3, 0 to 255


def _mesh(file: Path) -> Mesh:
    """A structure as gnbv writes meshes: triangles with colours of their own."""
    elements, vertices, rest = _ply(file)
    face = np.dtype([("corners", "u1"), ("vertex", "<i4", 3), ("rgb", "u1", 3)])
    faces = np.frombuffer(rest, face, elements[1][1])
    corners = np.stack([vertices[axis] for axis in "xyz"], axis=1)
    return Mesh(corners, faces["vertex"], faces["rgb"])


def main(scene: dict[str, Any]) -> dict[str, int]:
    """Writes the scene's run in its format (timeline.cpp); how many of what was written."""
    return importlib.import_module(f"to_{scene['format']}").write(RecordedRun(scene), scene["out"])
