"""The real OpenCV and COLMAP see through our lenses what we do: a calibration that OpenCV wrote,
the rays of a frame's depth, the camera of the COLMAP export."""

import json
from pathlib import Path

import cv2
import numpy as np
import pycolmap
import pytest
from conftest import gnbv, rows

SIZE = 160, 120
K = np.array([[118.0, 0.0, 81.3], [0.0, 117.0, 57.9], [0.0, 0.0, 1.0]])
LENSES = {  # OpenCV's order
    "OPENCV": [-0.28, 0.07, 2e-4, -1e-4, 0.0],
    "FULL_OPENCV": [0.3, 0.2, 1e-3, -5e-4, 0.05, 0.25, 0.1, 0.02],
    "OPENCV_FISHEYE": [-0.01, 0.04, -0.04, 0.008],
}


@pytest.fixture(scope="session", params=LENSES)
def flown(request, tmp_path_factory):
    """The name of COLMAP's model, the distortion, and a run through it."""
    folder = tmp_path_factory.mktemp(request.param)
    fisheye = request.param == "OPENCV_FISHEYE"
    suffix = ".xml" if fisheye else ".yaml"
    storage = cv2.FileStorage(str(folder / f"calibration{suffix}"), cv2.FILE_STORAGE_WRITE)
    storage.write("image_width", SIZE[0])
    storage.write("image_height", SIZE[1])
    storage.write("fisheye_model", int(fisheye))
    storage.write("camera_matrix", K)
    storage.write("distortion_coefficients", np.array([LENSES[request.param]]).T)
    storage.release()
    gnbv("run", "smoke", "--quiet", "--frames", "--set",
         f"cameras.0.calibration={folder / f'calibration{suffix}'}", "--set",
         "planner.termination.max_iterations=4", "--out", folder / "run")
    return request.param, np.array(LENSES[request.param]), folder / "run"


def project(name: str, distortion: np.ndarray, points: np.ndarray) -> np.ndarray:
    """By OpenCV, whose first pixel's middle is (0, 0)."""
    zero = np.zeros(3)
    if name == "OPENCV_FISHEYE":
        px, _ = cv2.fisheye.projectPoints(points.reshape(-1, 1, 3), zero, zero, K, distortion)
    else:
        px, _ = cv2.projectPoints(points, zero, zero, K, distortion)
    return px.reshape(-1, 2)


def test_the_clouds_points_project_to_pixels_of_their_depth(flown):
    """Each point that COLMAP's model says an image shows: OpenCV finds it there, and the depth
    image its distance along the axis."""
    name, distortion, run = flown
    folder = Path(gnbv("export", run, "--format", "colmap").stdout.strip())
    model = pycolmap.Reconstruction(str(folder / "sparse/0"))
    (camera,) = model.cameras.values()
    assert camera.model.name == name
    assert model.num_images() == model.num_reg_images() == len(rows(run / "frames/poses.csv"))
    shown = 0
    for image in model.images.values():
        assert (folder / "images" / image.name).exists()
        stem = f"{int(image.name.split('_')[-1][:-4]):04d}_rgbd"
        depth = cv2.imread(str(run / f"frames/{stem}.depth.png"), cv2.IMREAD_UNCHANGED)
        seen = [p for p in image.points2D if p.has_point3D()]
        world = np.array([model.points3D[p.point3D_id].xyz for p in seen])
        points = np.array([image.cam_from_world() * p for p in world])
        found = project(name, distortion, points) + 0.5
        by_colmap = np.array([camera.img_from_cam(p) for p in points])
        assert np.abs(found - by_colmap).max() < 1e-6  # COLMAP's camera is OpenCV's
        assert np.abs(found - np.array([p.xy for p in seen])).max() < 0.02  # and ours
        u, v = np.floor(found).astype(int).T
        off_m = np.abs(depth[v, u] / 1000.0 - points[:, 2])
        assert np.median(off_m) < 0.03
        shown += len(seen)
    assert shown > 500


def test_depth_images_are_of_the_ground_where_opencv_says(flown):
    """Pixels that show the plane z = 0: by OpenCV's inverse, their rays meet it at that depth."""
    name, distortion, run = flown
    poses = np.genfromtxt(run / "frames/poses.csv", delimiter=",", skip_header=1, dtype=None,
                          encoding=None)
    v, u = np.mgrid[0:SIZE[1], 0:SIZE[0]]
    px = np.stack([u, v], -1).reshape(-1, 1, 2).astype(float)
    undistort = cv2.fisheye.undistortPoints if name == "OPENCV_FISHEYE" else cv2.undistortPoints
    xy = undistort(px, K, distortion).reshape(-1, 2)
    ground, structure = 0, 0
    for row in np.atleast_1d(poses):
        depth = cv2.imread(str(run / f"frames/{row[11]}"), cv2.IMREAD_UNCHANGED).ravel() / 1000.0
        x, y, z, w = row[6], row[7], row[8], row[9]
        R = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        height = row[5] + depth * (np.c_[xy, np.ones(len(xy))] @ R.T)[:, 2]
        is_measured = (depth > 0) & np.isfinite(xy).all(1) & (np.abs(xy).max(1) < 4.0)
        assert height[is_measured].min() > -0.01 * depth.max() - 2e-3  # nothing is below it
        ground += (np.abs(height[is_measured]) < 4e-3).sum()
        structure += (height[is_measured] > 0.1).sum()
    assert ground > 500 and structure > 500


def test_the_plain_export_says_the_same(flown):
    name, distortion, run = flown
    folder = Path(gnbv("export", run, "--format", "plain").stdout.strip())
    (camera,) = json.loads((folder / "intrinsics.json").read_text())["cameras"]
    assert (camera["fx_px"], camera["cx_px"]) == (K[0, 0], K[0, 2] + 0.5)
    names = ["k1", "k2", "k3", "k4"] if name == "OPENCV_FISHEYE" else [
        "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"]
    assert [camera[n] for n in names][:len(distortion)] == list(distortion)
