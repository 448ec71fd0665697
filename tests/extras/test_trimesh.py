"""The real trimesh reads our clouds and meshes: PLY, GLB and OBJ, textures among them."""

import numpy as np
import pytest
import trimesh
from conftest import gnbv, rows


def test_reads_the_cloud(run):
    cloud = trimesh.load(run / "cloud.ply")
    assert isinstance(cloud, trimesh.PointCloud)
    assert len(cloud.vertices) == int(rows(run / "iterations.csv")[-1]["cloud_points"])
    assert np.isfinite(cloud.vertices).all()


def test_reads_the_coloured_cloud_of_the_plain_export(export):
    cloud = trimesh.load(export("plain") / "cloud.ply")
    assert len(cloud.colors) == len(cloud.vertices) > 1000
    assert len(np.unique(cloud.colors, axis=0)) > 10


@pytest.mark.parametrize("kind", ["ply", "obj", "glb"])
def test_reads_a_structure_as_large_as_it_is(tmp_path, kind):
    """Oracle: the figures that `gnbv asset` prints of what it wrote."""
    file = tmp_path / f"smoke.{kind}"
    written = gnbv("asset", "smoke", "-o", file)
    mesh = trimesh.load(file, force="mesh")
    faces, area_m2 = (float(written.stdout.split(unit)[0].split()[-1])
                      for unit in (" faces", " m2"))
    assert len(mesh.faces) == faces
    assert abs(mesh.area - area_m2) < 0.5 + 1e-3 * area_m2
    # GLB's up is y, by its own definition; trimesh leaves it so
    up = 1 if kind == "glb" else 2
    assert 1.5 < np.ptp(mesh.vertices[:, up]) < 1.7


def test_reads_the_textured_surface(run, tmp_path):
    """The same surface three times: as many triangles, the same area, a picture on it."""
    gnbv("surface", run, "--quiet")
    meshes = {kind: trimesh.load(next((run / "surface").glob(f"*.{kind}")), force="mesh")
              for kind in ("glb", "obj", "ply")}
    faces = {kind: len(mesh.faces) for kind, mesh in meshes.items()}
    assert len(set(faces.values())) == 1 and faces["glb"] > 100, faces
    for kind in ("glb", "obj"):
        assert abs(meshes[kind].area / meshes["ply"].area - 1.0) < 1e-4
        assert meshes[kind].visual.kind == "texture"
        assert meshes[kind].visual.uv.shape == (len(meshes[kind].vertices), 2)
        material = meshes[kind].visual.material
        image = material.baseColorTexture if kind == "glb" else material.image
        assert image is not None and len(image.getcolors(1 << 24)) > 10
