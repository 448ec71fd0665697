"""The real MCAP reader opens what `gnbv export --format mcap` writes; its contents are counted
against the run's own files, depth pixel by pixel."""

import json
from collections import defaultdict

import numpy as np
import pytest
from conftest import rows
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory
from PIL import Image


@pytest.fixture(scope="module")
def topics(export):
    """Times (s), schemas and messages by topic."""
    found = defaultdict(list)
    with (export("mcap") / "run.mcap").open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        for schema, channel, message in reader.iter_messages():
            if channel.message_encoding == "json":
                content = json.loads(message.data)
            else:
                content = DecoderFactory().decoder_for("protobuf", schema)(message.data)
            found[channel.topic].append((message.log_time / 1e9, schema.name, content))
    print(*(f"{topic} {len(all_)} {all_[0][1]}" for topic, all_ in sorted(found.items())), sep="\n")
    return found


def test_every_schema_is_foxgloves_or_a_plot(topics):
    for topic, messages in topics.items():
        for _, schema, _ in messages:
            assert schema.startswith("foxglove.") or topic.startswith("/plots/")


def test_the_cloud_grows_as_the_mission_saw_it(run, topics):
    views = rows(run / "iterations.csv")
    clouds = topics["/cloud"]
    sizes = [len(cloud.data) // cloud.point_stride for _, _, cloud in clouds]
    assert np.cumsum(sizes)[1 : len(views) + 1].tolist() == [int(v["cloud_points"]) for v in views]
    assert [round(time_s, 6) for time_s, _, _ in clouds][1 : len(views) + 1] == [
        round(float(view["time_s"]), 6) for view in views]
    assert [field.name for field in clouds[0][2].fields] == ["x", "y", "z"]


def test_transforms_are_the_path_and_the_views(run, topics):
    path = np.loadtxt(run / "trajectory.tum")
    frames = rows(run / "frames/poses.csv")
    by_child = defaultdict(list)
    for _, _, transform in topics["/tf"]:
        assert transform.parent_frame_id == "world"
        place = transform.translation
        by_child[transform.child_frame_id].append((place.x, place.y, place.z))
    assert np.array_equal(by_child["body"], path[:, 1:4])
    assert sorted(by_child[frames[0]["camera"]]) == sorted(
        tuple(float(frame[k]) for k in ("x_m", "y_m", "z_m")) for frame in frames)


def test_frames_are_those_that_were_kept(run, topics):
    frames = rows(run / "frames/poses.csv")
    camera = frames[0]["camera"]
    colour, depth = topics[f"/{camera}/colour"], topics[f"/{camera}/depth"]
    assert len(colour) == len(depth) == len(topics[f"/{camera}/calibration"]) == len(frames)
    for frame, (_, _, picture), (_, _, raw) in zip(frames, colour, depth, strict=True):
        assert picture.data == (run / "frames" / frame["rgb"]).read_bytes()
        pixels = np.frombuffer(raw.data, "<u2").reshape(raw.height, raw.width)
        assert raw.encoding == "16UC1" and raw.step == 2 * raw.width
        assert np.array_equal(pixels, np.asarray(Image.open(run / "frames" / frame["depth"])))


def test_the_calibration_is_that_of_the_camera_as_ros_counts_pixels(run, topics):
    camera = json.loads((run / "frames/cameras.json").read_text())[0]
    calibration = topics[f"/{camera['name']}/calibration"][0][2]
    # ROS and OpenCV count from the middle of the first pixel, the run from its corner
    centre = camera["cx_px"] - 0.5, camera["cy_px"] - 0.5
    for row in calibration.K, [k for i, k in enumerate(calibration.P) if i % 4 < 3]:
        assert list(row) == [camera["fx_px"], 0, centre[0], 0, camera["fy_px"], centre[1], 0, 0, 1]


def test_the_structure_is_there_in_colour(topics):
    triangles = topics["/structure"][0][2].entities[0].triangles[0]
    assert len(triangles.points) == len(triangles.colors) > 300
    assert len(triangles.points) % 3 == 0


def test_plots_are_the_columns_of_the_run(run, topics):
    for name, file in (("entropy_nat", "iterations.csv"), ("coverage/0.05", "coverage.csv")):
        plot = [content["value"] for _, _, content in topics[f"/plots/{name}"]]
        assert plot == [float(row[name.replace("/", "_")]) for row in rows(run / file)]
    # row 0 is the profile's
    views = [float(row["time_s"]) for row in rows(run / "iterations.csv")]
    times = [time for time, _, _ in topics["/plots/coverage/0.05"]]
    assert times[1:] == pytest.approx(views, abs=1e-6) and times[0] < views[0]
