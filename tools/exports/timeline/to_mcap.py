"""A run as one MCAP file of Foxglove's schemas, for Foxglove and whatever else reads MCAP."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from foxglove_schemas_protobuf.CameraCalibration_pb2 import CameraCalibration
from foxglove_schemas_protobuf.CompressedImage_pb2 import CompressedImage
from foxglove_schemas_protobuf.FrameTransform_pb2 import FrameTransform
from foxglove_schemas_protobuf.PackedElementField_pb2 import PackedElementField
from foxglove_schemas_protobuf.PointCloud_pb2 import PointCloud
from foxglove_schemas_protobuf.RawImage_pb2 import RawImage
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from mcap.writer import Writer
from mcap_protobuf.schema import register_schema
from PIL import Image
from recorded_run import Camera, Frame, RecordedRun

MODELS = {
    "none": "",
    "brown_conrady": "rational_polynomial",
    "kannala_brandt": "kannala_brandt",
}
PLOT_SCHEMA = {"title": "gnbv.Plot", "type": "object", "properties": {"value": {"type": "number"}}}


def write(run: RecordedRun, file: str) -> dict[str, int]:
    """What was written, by kind."""
    with open(file, "wb") as stream:
        out = _Out(stream)
        written = {
            "triangles": _structure(out, run),
            "poses": _body(out, run),
            "points": _cloud(out, run),
            "plots": _plots(out, run),
        }
        for camera in run.cameras:
            for kind, count in _camera(out, camera).items():
                written[kind] = written.get(kind, 0) + count
        out.writer.finish()
    return written


class _Out:
    """Messages by topic; a topic is a channel, made with its first message."""

    def __init__(self, stream: Any) -> None:
        self.writer = Writer(stream)
        self.writer.start(profile="", library="gnbv")
        self.schemas: dict[str, int] = {}
        self.channels: dict[str, int] = {}

    def message(self, topic: str, time_s: float, message: Any) -> None:
        kind = message.DESCRIPTOR.full_name
        if kind not in self.schemas:
            self.schemas[kind] = register_schema(self.writer, type(message))
        self._add(topic, time_s, "protobuf", kind, message.SerializeToString())

    def number(self, topic: str, time_s: float, value: float) -> None:
        kind = PLOT_SCHEMA["title"]
        if kind not in self.schemas:
            self.schemas[kind] = self.writer.register_schema(
                kind, "jsonschema", json.dumps(PLOT_SCHEMA).encode()
            )
        data = json.dumps({"value": value if np.isfinite(value) else None}).encode()
        self._add(topic, time_s, "json", kind, data)

    def _add(self, topic: str, time_s: float, encoding: str, kind: str, data: bytes) -> None:
        if topic not in self.channels:
            self.channels[topic] = self.writer.register_channel(topic, encoding, self.schemas[kind])
        time_ns = round(1e9 * time_s)
        self.writer.add_message(self.channels[topic], time_ns, data, time_ns)


def _stamp(message: Any, time_s: float) -> None:
    message.timestamp.FromNanoseconds(round(1e9 * time_s))


def _pose(target: Any, position: Any, quaternion: Any) -> None:
    place, turn = target
    place.x, place.y, place.z = map(float, position)
    turn.x, turn.y, turn.z, turn.w = map(float, quaternion)


def _structure(out: _Out, run: RecordedRun) -> int:
    if run.structure is None:
        return 0
    update = SceneUpdate()
    entity = update.entities.add(id="structure", frame_id="world")
    triangles = entity.triangles.add()
    triangles.pose.orientation.w = 1.0
    for corner in run.structure.vertices[run.structure.triangles].reshape(-1, 3).tolist():
        triangles.points.add(x=corner[0], y=corner[1], z=corner[2])
    for r, g, b in np.repeat(run.structure.colours / 255.0, 3, axis=0).tolist():
        triangles.colors.add(r=r, g=g, b=b, a=1.0)
    out.message("/structure", 0.0, update)
    return len(run.structure.triangles)


def _body(out: _Out, run: RecordedRun) -> int:
    for row in run.trajectory:
        transform = FrameTransform(parent_frame_id="world", child_frame_id="body")
        _stamp(transform, row[0])
        _pose((transform.translation, transform.rotation), row[1:4], row[4:8])
        out.message("/tf", row[0], transform)
    return len(run.trajectory)


def _cloud(out: _Out, run: RecordedRun) -> int:
    """What each view brought: with an endless decay time, Foxglove shows the cloud so far."""
    for grown in run.growth:
        cloud = PointCloud(frame_id="world", point_stride=12)
        _stamp(cloud, grown.time_s)
        cloud.pose.orientation.w = 1.0
        for offset, name in enumerate("xyz"):
            cloud.fields.add(name=name, offset=4 * offset, type=PackedElementField.FLOAT32)
        cloud.data = grown.points.astype("<f4").tobytes()
        out.message("/cloud", grown.time_s, cloud)
    return sum(len(grown.points) for grown in run.growth)


def _camera(out: _Out, camera: Camera) -> dict[str, int]:
    written = {"frusta": 0, "colour": 0, "depth": 0}
    for frame in camera.frames:
        _frustum(out, camera, frame)
        written["frusta"] += 1
        if frame.colour is not None:
            image = CompressedImage(
                frame_id=camera.name, format="png", data=frame.colour.read_bytes()
            )
            _stamp(image, frame.time_s)
            out.message(f"/{camera.name}/colour", frame.time_s, image)
            written["colour"] += 1
        if frame.depth is not None:
            _depth(out, camera, frame)
            written["depth"] += 1
    return written


def _frustum(out: _Out, camera: Camera, frame: Frame) -> None:
    transform = FrameTransform(parent_frame_id="world", child_frame_id=camera.name)
    _stamp(transform, frame.time_s)
    _pose((transform.translation, transform.rotation), frame.position, frame.quaternion)
    out.message("/tf", frame.time_s, transform)
    # ROS and OpenCV count from the middle of the first pixel, the run from its corner
    cx, cy = camera.cx_px - 0.5, camera.cy_px - 0.5
    k = [camera.fx_px, camera.skew_px, cx, 0.0, camera.fy_px, cy, 0.0, 0.0, 1.0]
    calibration = CameraCalibration(
        frame_id=camera.name,
        width=camera.width_px,
        height=camera.height_px,
        distortion_model=MODELS[camera.distortion],
        D=camera.coefficients,
        K=k,
        R=np.eye(3).ravel().tolist(),
        P=[*k[:3], 0.0, *k[3:6], 0.0, *k[6:], 0.0],
    )
    _stamp(calibration, frame.time_s)
    out.message(f"/{camera.name}/calibration", frame.time_s, calibration)


def _depth(out: _Out, camera: Camera, frame: Frame) -> None:
    """Millimetres, as 16UC1 says them."""
    with Image.open(str(frame.depth)) as picture:
        pixels = np.asarray(picture).astype("<u2")
    image = RawImage(
        frame_id=camera.name,
        width=pixels.shape[1],
        height=pixels.shape[0],
        encoding="16UC1",
        step=2 * pixels.shape[1],
        data=pixels.tobytes(),
    )
    _stamp(image, frame.time_s)
    out.message(f"/{camera.name}/depth", frame.time_s, image)


def _plots(out: _Out, run: RecordedRun) -> int:
    for name, (times_s, values) in run.plots.items():
        for time_s, value in zip(times_s, values, strict=True):
            out.number(f"/plots/{name}", float(time_s), float(value))
    return len(run.plots)
