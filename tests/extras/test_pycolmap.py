"""The real pycolmap reads the COLMAP export; test_opencv.py has where it projects its points."""

import numpy as np
import pycolmap
from conftest import rows


def test_reads_the_model_that_was_exported(run, export):
    folder = export("colmap")
    model = pycolmap.Reconstruction(str(folder / "sparse/0"))
    print(model.summary())
    poses = rows(run / "frames/poses.csv")
    assert model.num_images() == model.num_reg_images() == len(poses)
    assert model.num_cameras() == 1 and model.num_points3D() > 500
    for image in model.images.values():
        assert (folder / "images" / image.name).exists()
        assert image.num_points3D > 0
    centres = np.array(sorted(tuple(image.projection_center()) for image in model.images.values()))
    taken = np.array(sorted(tuple(float(row[k]) for k in ("x_m", "y_m", "z_m")) for row in poses))
    assert np.abs(centres - taken).max() < 1e-5
