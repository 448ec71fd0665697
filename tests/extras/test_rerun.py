"""The real Rerun opens what `gnbv export --format rerun` writes; its contents are counted against
the run's own files."""

import shutil

import numpy as np
import pytest
from conftest import gnbv, rows, without_packages

chunk = pytest.importorskip("rerun.chunk", reason="needs a rerun-sdk that reads its files")


@pytest.fixture(scope="module")
def entities(export):
    """By entity and column, the cells of all its rows."""
    file = export("rerun") / "run.rrd"
    found = {}
    for part in chunk.RrdReader(file).stream():
        batch = part.to_record_batch()
        for name in batch.schema.names:
            cells = found.setdefault(part.entity_path, {}).setdefault(name, [])
            cells.extend(batch.column(name).to_pylist())
    print(*sorted(found), sep="\n")
    return found


def test_the_cloud_grows_as_the_mission_saw_it(run, entities):
    views = rows(run / "iterations.csv")
    profile = entities["/world/cloud/profile"]["Points3D:positions"][0]
    total = len(profile)
    for view in views:
        grown = entities[f"/world/cloud/view_{int(view['iteration']):04d}"]
        total += len(grown["Points3D:positions"][0])
        assert total == int(view["cloud_points"])
        assert abs(grown["mission"][0].total_seconds() - float(view["time_s"])) < 1e-6
        assert grown["view"] == [int(view["iteration"])]


def test_poses_are_those_of_the_path(run, entities):
    path = np.loadtxt(run / "trajectory.tum")
    body = entities["/world/body"]
    places = np.array([cell[0] for _, cell in sorted(
        zip(body["mission"], body["Transform3D:translation"], strict=True))])
    assert len(places) == len(path)
    assert np.abs(places - path[:, 1:4]).max() < 1e-5  # float32
    assert len(entities["/world/path"]["LineStrips3D:strips"][0][0]) == len(path)


def test_every_frame_has_its_frustum_colour_and_depth(run, entities):
    frames = rows(run / "frames/poses.csv")
    camera = f"/world/cameras/{frames[0]['camera']}"
    poses = [cell[0] for cell in entities[camera]["Transform3D:translation"] if cell]
    taken = [[float(frame[k]) for k in ("x_m", "y_m", "z_m")] for frame in frames]
    assert np.abs(np.array(sorted(poses)) - np.array(sorted(taken))).max() < 1e-5
    assert entities[camera]["Pinhole:resolution"][0][0] == [160.0, 120.0]
    for kind, column in (("colour", "EncodedImage:blob"), ("depth", "EncodedDepthImage:blob")):
        name = {"colour": "rgb", "depth": "depth"}[kind]
        blobs = {bytes(cell[0]) for cell in entities[f"{camera}/{kind}"][column]}
        assert blobs == {(run / "frames" / frame[name]).read_bytes() for frame in frames}


def test_the_structure_has_its_triangles(tmp_path, entities):
    written = gnbv("asset", "smoke", "-o", tmp_path / "smoke.ply")
    faces = int(written.stdout.split(" faces")[0].split()[-1])
    mesh = entities["/world/structure"]
    assert len(mesh["Mesh3D:triangle_indices"][0]) == faces
    assert len(mesh["Mesh3D:vertex_positions"][0]) == 3 * faces


def test_plots_are_the_columns_of_the_run(run, entities):
    for name, file in (("entropy_nat", "iterations.csv"), ("coverage/0.05", "coverage.csv")):
        plot = entities[f"/plots/{name}"]["Scalars:scalars"]
        column = [float(row[name.replace("/", "_")]) for row in rows(run / file)]
        assert sorted(cell[0] for cell in plot) == sorted(column)


def test_without_frames_the_frusta_are_there_all_the_same(tmp_path):
    folder = tmp_path / "blind"
    gnbv("run", "smoke", "--quiet", "--out", folder)
    done = gnbv("export", folder, "--format", "rerun")
    assert f"{len(rows(folder / 'iterations.csv'))} frusta, 0 colour, 0 depth" in done.stderr


def test_a_run_that_goes_on_is_its_journal_and_not_its_earlier_end(run, tmp_path):
    folder = shutil.copytree(run, tmp_path / "goes_on")
    views = (folder / "iterations.csv").read_text().splitlines(keepends=True)
    (folder / "iterations.csv.part").write_text("".join(views))
    (folder / "iterations.csv").write_text("".join(views[:-1]))
    done = gnbv("export", folder, "--format", "rerun")
    assert " 0 poses, 0 points, 5 plots, " in done.stderr, done.stderr


def test_a_python_without_the_package_is_one_clear_line(run, tmp_path):
    for kind, package in (("rerun", "rerun-sdk"), ("mcap", "foxglove-schemas-protobuf")):
        refused = gnbv("export", run, "--quiet", "--format", kind, "-o", tmp_path / kind, code=2,
                       **without_packages(tmp_path))
        assert refused.stderr.count("\n") == 1 and package in refused.stderr, refused.stderr
        assert not (tmp_path / kind).exists()
