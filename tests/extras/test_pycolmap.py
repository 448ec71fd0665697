"""The real pycolmap reads the COLMAP export, and finds its points where the images show them."""

import csv

import numpy as np
import pycolmap


def test_reads_the_model_that_was_exported(run, export):
    folder = export("colmap")
    model = pycolmap.Reconstruction(str(folder / "sparse/0"))
    print(model.summary())
    with (run / "frames/poses.csv").open() as file:
        poses = list(csv.DictReader(file))
    assert model.num_images() == model.num_reg_images() == len(poses)
    assert model.num_cameras() == 1 and model.num_points3D() > 500
    for image in model.images.values():
        assert (folder / "images" / image.name).exists()
        assert image.num_points3D > 0


def test_cameras_are_where_the_frames_were_taken(run, export):
    model = pycolmap.Reconstruction(str(export("colmap") / "sparse/0"))
    centres = np.array(sorted(tuple(image.projection_center()) for image in model.images.values()))
    with (run / "frames/poses.csv").open() as file:
        taken = np.array(sorted(tuple(float(row[k]) for k in ("x_m", "y_m", "z_m"))
                                for row in csv.DictReader(file)))
    assert np.abs(centres - taken).max() < 1e-5


def test_points_project_to_their_observations(export):
    model = pycolmap.Reconstruction(str(export("colmap") / "sparse/0"))
    off_px = []
    for image in model.images.values():
        camera = model.cameras[image.camera_id]
        for point in image.points2D:
            if not point.has_point3D():
                continue
            place = model.points3D[point.point3D_id].xyz
            off_px.append(np.linalg.norm(camera.img_from_cam(image.cam_from_world() * place)
                                         - point.xy))
    assert len(off_px) > 1000 and max(off_px) < 0.02
