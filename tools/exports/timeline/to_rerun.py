"""A run as one Rerun recording, `rerun run.rrd`."""

from __future__ import annotations

from typing import Any

import numpy as np
import rerun as rr
from recorded_run import Camera, RecordedRun

if tuple(map(int, rr.__version__.split(".")[:2])) < (0, 28):
    raise ImportError(f"rerun-sdk 0.28 or newer is needed, this is {rr.__version__}", name="rerun")

MISSION, VIEW = "mission", "view"  # the timelines: seconds, and the number of the view


def write(run: RecordedRun, file: str) -> dict[str, int]:
    """What was written, by kind."""
    rec = rr.RecordingStream("gnbv", recording_id=run.id)
    rec.save(file)
    rec.disable_timeline("log_time")  # when it was written is no part of it
    rec.send_recording_name(run.name)
    rec.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    written = {
        "triangles": _structure(rec, run),
        "poses": _body(rec, run),
        "points": _cloud(rec, run),
        "plots": _plots(rec, run),
    }
    for camera in run.cameras:
        for kind, count in _camera(rec, camera).items():
            written[kind] = written.get(kind, 0) + count
    rec.flush()
    rec.disconnect()
    return written


def _structure(rec: Any, run: RecordedRun) -> int:
    if run.structure is None:
        return 0
    mesh = run.structure
    # a colour a triangle: each has corners of its own
    rec.log(
        "world/structure",
        rr.Mesh3D(
            vertex_positions=mesh.vertices[mesh.triangles].reshape(-1, 3),
            triangle_indices=np.arange(3 * len(mesh.triangles)).reshape(-1, 3),
            vertex_colors=np.repeat(mesh.colours, 3, axis=0),
        ),
        static=True,
    )
    return len(mesh.triangles)


def _body(rec: Any, run: RecordedRun) -> int:
    path = run.trajectory
    if not len(path):
        return 0
    rec.log("world/path", rr.LineStrips3D([path[:, 1:4]], radii=0.01), static=True)
    rec.send_columns(
        "world/body",
        indexes=[rr.TimeColumn(MISSION, duration=path[:, 0])],
        columns=rr.Transform3D.columns(translation=path[:, 1:4], quaternion=path[:, 4:8]),
    )
    rec.log("world/body", rr.TransformAxes3D(0.5), static=True)
    return len(path)


def _at(rec: Any, view: int, time_s: float) -> None:
    rec.set_time(MISSION, duration=time_s)
    rec.set_time(VIEW, sequence=view)


def _cloud(rec: Any, run: RecordedRun) -> int:
    """An entity for what each view brought, so that all of them together are the cloud so far."""
    for grown in run.growth:
        _at(rec, grown.view, grown.time_s)
        name = "profile" if grown.view < 0 else f"view_{grown.view:04d}"
        shade = [120, 120, 120] if grown.view < 0 else [40, 110, 200]
        rec.log(f"world/cloud/{name}", rr.Points3D(grown.points, radii=0.01, colors=shade))
    return sum(len(grown.points) for grown in run.growth)


def _camera(rec: Any, camera: Camera) -> dict[str, int]:
    entity = f"world/cameras/{camera.name}"
    pinhole = rr.Pinhole(
        image_from_camera=[
            [camera.fx_px, camera.skew_px, camera.cx_px],
            [0.0, camera.fy_px, camera.cy_px],
            [0.0, 0.0, 1.0],
        ],
        resolution=[camera.width_px, camera.height_px],
        image_plane_distance=0.5,
    )
    rec.log(entity, pinhole, static=True)
    written = {"frusta": len(camera.frames), "colour": 0, "depth": 0}
    for frame in camera.frames:
        _at(rec, frame.view, frame.time_s)
        rec.log(entity, rr.Transform3D(translation=frame.position, quaternion=frame.quaternion))
        if frame.colour is not None:
            image = frame.colour.read_bytes()
            rec.log(f"{entity}/colour", rr.EncodedImage(contents=image, media_type="image/png"))
            written["colour"] += 1
        if frame.depth is not None:
            image = frame.depth.read_bytes()
            rec.log(
                f"{entity}/depth", rr.EncodedDepthImage(image, media_type="image/png", meter=1000.0)
            )
            written["depth"] += 1
    return written


def _plots(rec: Any, run: RecordedRun) -> int:
    for name, (times_s, values) in run.plots.items():
        rec.send_columns(
            f"plots/{name}",
            indexes=[rr.TimeColumn(MISSION, duration=times_s)],
            columns=rr.Scalars.columns(scalars=values),
        )
    return len(run.plots)
