"""The real COLMAP, from frames alone: features, matches and poses of a structure that nothing but
its picture tells apart. Oracle: the poses at which the frames were taken."""

import itertools
import math
import os
import shutil
import subprocess

import numpy as np
import pycolmap
import pytest
from conftest import gnbv
from PIL import Image

if shutil.which("colmap") is None:
    pytest.skip("no colmap here: apt-get install colmap", allow_module_level=True)

TEXEL_M = 0.005
CELL = 512  # pixels of the picture that one side of the structure has for itself


def random_picture(width: int, height: int) -> np.ndarray:
    """Random squares of 1 to 32 pixels, over each other."""
    random = np.random.default_rng(46)
    sides = [2**i for i in range(6)]
    layers = [np.kron(random.random((height // side, width // side, 3)) - 0.5,
                      np.ones((side, side, 1))) * math.sqrt(side) for side in sides]
    total = sum(layers)
    return np.clip(128 + 60 * total / total.std(), 0, 255).astype(np.uint8)


def write_structure(folder) -> str:
    """A box with a tower, each side with its own part of the picture."""
    picture = random_picture(4 * CELL, 4 * CELL)
    Image.fromarray(picture).save(folder / "random.png")
    (folder / "structure.mtl").write_text("newmtl random\nKd 1 1 1\nmap_Kd random.png\n")
    vertices, uvs, faces = [], [], []
    for (x, y, z), (w, d, h) in [((-1, -0.75, 0), (2, 1.5, 1)), ((-0.25, -0.25, 1), (0.5, 0.5, 0.6))]:
        for corner, right, up in [((x, y, z), (w, 0, 0), (0, 0, h)),
                                  ((x + w, y, z), (0, d, 0), (0, 0, h)),
                                  ((x + w, y + d, z), (-w, 0, 0), (0, 0, h)),
                                  ((x, y + d, z), (0, -d, 0), (0, 0, h)),
                                  ((x, y, z + h), (w, 0, 0), (0, d, 0))]:
            corner, right, up = map(np.array, (corner, right, up))
            row, column = divmod(len(faces), 4)
            for u, v in [(0, 0), (1, 0), (1, 1), (0, 1)]:
                vertices.append(corner + u * right + v * up)
                at_px = CELL * np.array([column, row]) + np.array(
                    [u * np.linalg.norm(right), v * np.linalg.norm(up)]) / TEXEL_M
                uvs.append(at_px / (4 * CELL))
            faces.append(range(len(vertices) - 3, len(vertices) + 1))
    lines = ["mtllib structure.mtl", "usemtl random"]
    lines += [f"v {x} {y} {z}" for x, y, z in vertices] + [f"vt {u} {v}" for u, v in uvs]
    lines += ["f " + " ".join(f"{i}/{i}" for i in face) for face in faces]
    (folder / "structure.obj").write_text("\n".join(lines) + "\n")
    return str(folder / "structure.obj")


def colmap(command: str, **options) -> None:
    words = [word for key, value in options.items()
             for word in (f"--{key.replace('__', '.')}", str(value))]
    done = subprocess.run(["colmap", command, *words], capture_output=True, text=True,
                          env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
    assert done.returncode == 0, f"{command}: {done.stdout[-2000:]}{done.stderr[-2000:]}"


def poses(model) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Of each image R_camera_world and the camera's centre in the world."""
    return {image.name: (image.cam_from_world().rotation.matrix(), image.projection_center())
            for image in model.images.values()}


def similarity(a: np.ndarray, b: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """s, R, t that bring points a (n, 3) nearest to b (Umeyama 1991)."""
    ma, mb = a.mean(0), b.mean(0)
    U, D, Vt = np.linalg.svd((b - mb).T @ (a - ma) / len(a))
    S = np.diag([1, 1, np.sign(np.linalg.det(U @ Vt))])
    R = U @ S @ Vt
    s = np.trace(np.diag(D) @ S) / (a - ma).var(0).sum()
    return s, R, mb - s * R @ ma


def overlap(run, camera: list[float], truth: list) -> list[float]:
    """Of each frame to the next: what share of its depth pixels lies in the next one's picture."""
    fx, fy, cx, cy = camera
    depths = [np.array(Image.open(file)) / 1000.0
              for file in sorted((run / "frames").rglob("*depth*.png"))]
    assert len(depths) == len(truth)
    shares = []
    for depth, (R, c), (R_next, c_next) in zip(depths, truth, truth[1:]):
        v, u = np.nonzero(depth)
        z = depth[v, u]
        p_camera = np.stack([(u + 0.5 - cx) / fx * z, (v + 0.5 - cy) / fy * z, z])
        q = R_next @ (R.T @ p_camera + c[:, None] - c_next[:, None])
        height, width = depth.shape
        px, py = fx * q[0] / q[2] + cx, fy * q[1] / q[2] + cy
        inside = (q[2] > 0) & (px >= 0) & (px < width) & (py >= 0) & (py < height)
        shares.append(inside.mean())
    return shares


def test_finds_the_poses_of_the_frames_within_a_centimetre(tmp_path):
    mesh = write_structure(tmp_path)
    with (tmp_path / "views.csv").open("w") as file:
        file.write("x,y,z,yaw_deg\n")
        for z_m in (1.3, 2.2):
            for bearing in range(0, 360, 15):
                angle = math.radians(bearing - 90)
                file.write(f"{3 * math.cos(angle)},{3 * math.sin(angle)},{z_m},{(bearing + 90) % 360}\n")
    run = tmp_path / "run"
    gnbv("run", "smoke", "--mesh", mesh, "--utility", "route", "--views", tmp_path / "views.csv",
         "--quiet", "--frames", "--out", run,
         *(word for key in ("cameras.0.width_px=640", "cameras.0.height_px=480",
                            "cameras.0.pitch_deg=15", "cameras.0.range_max_m=8",
                            "planner.termination.max_iterations=60") for word in ("--set", key)))
    folder = tmp_path.__class__(gnbv("export", run, "--format", "colmap").stdout.strip())
    ours = pycolmap.Reconstruction(str(folder / "sparse/0"))
    truth = poses(ours)
    (camera,) = [list(its.params) for its in ours.cameras.values()]
    shares = overlap(run, camera, [truth[name] for name in sorted(truth)])
    print(f"{len(truth)} frames, overlap of neighbours: median {np.median(shares):.2f}")
    assert len(truth) >= 45 and np.median(shares) > 0.8

    database, sparse = tmp_path / "database.db", tmp_path / "sparse"
    sparse.mkdir()
    colmap("feature_extractor", database_path=database, image_path=folder / "images",
           ImageReader__single_camera=1, ImageReader__camera_model="PINHOLE",
           ImageReader__camera_params=",".join(map(str, camera)), SiftExtraction__use_gpu=0,
           SiftExtraction__max_num_features=2048)
    near = [f"{a} {b}" for a, b in itertools.combinations(sorted(truth), 2)
            if truth[a][0][2] @ truth[b][0][2] > math.cos(math.radians(50))]
    (tmp_path / "pairs.txt").write_text("\n".join(near))  # of frames that look the same way
    colmap("matches_importer", database_path=database, match_list_path=tmp_path / "pairs.txt",
           match_type="pairs", SiftMatching__use_gpu=0)
    colmap("mapper", database_path=database, image_path=folder / "images", output_path=sparse,
           Mapper__ba_refine_focal_length=0, Mapper__ba_refine_extra_params=0)
    found = poses(pycolmap.Reconstruction(str(sparse / "0")))
    names = sorted(found)
    theirs = np.array([found[name][1] for name in names])
    ours = np.array([truth[name][1] for name in names])
    s, R, t = similarity(theirs, ours)
    off_mm = 1000 * np.linalg.norm(s * theirs @ R.T + t - ours, axis=1)
    turned = [found[n][0] @ R.T @ truth[n][0].T for n in names]
    off_deg = [math.degrees(math.acos(min(1, (np.trace(T) - 1) / 2))) for T in turned]
    print(f"{len(names)} of {len(truth)} frames; centres off by {np.median(off_mm):.2f} mm in the "
          f"median, {off_mm.max():.2f} mm at most; turned by {max(off_deg):.3f} degrees at most")
    assert len(names) == len(truth)
    assert off_mm.max() < 10.0
    assert max(off_deg) < 0.3
