"""The real evo reads trajectory.tum, and measures an estimate's error as we know it to be."""

import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from conftest import gnbv, rows
from evo.tools import file_interface


def test_reads_the_path_of_a_run(run):
    path = file_interface.read_tum_trajectory_file(run / "trajectory.tum")
    rows = np.loadtxt(run / "trajectory.tum")
    assert path.num_poses == len(rows) and path.check()[0]
    flown_m = np.linalg.norm(np.diff(rows[:, 1:4], axis=0), axis=1).sum()
    assert abs(path.path_length - flown_m) < 1e-6


def test_the_path_leads_through_the_views(run):
    """The vehicle hovers at a view, and heads where the view wanted."""
    path = file_interface.read_tum_trajectory_file(run / "trajectory.tum")
    for view in rows(run / "iterations.csv"):
        pose = path.poses_se3[np.abs(path.timestamps - float(view["time_s"])).argmin()]
        wanted = [float(view[axis]) for axis in "xyz"]
        assert np.linalg.norm(pose[:3, 3] - wanted) < 0.1
        yaw_rad = math.atan2(pose[1, 0], pose[0, 0])
        assert abs(math.remainder(yaw_rad - float(view["yaw"]), math.tau)) < 0.05


def test_prints_the_error_of_a_noisy_estimate_against_the_truth(tmp_path):
    """The same figure from poses read here: RMS over the frames that evo_ape has associated."""
    gnbv("run", "smoke", "--quiet", "--frames", "--out", tmp_path / "run", "--set",
         "vehicle.estimate.model=vio")
    exported = gnbv("export", tmp_path / "run", "--quiet", "--format", "tum")
    camera = next(Path(exported.stdout.strip()).glob("*/groundtruth.txt")).parent
    program = shutil.which("evo_ape", path=str(Path(sys.executable).parent))
    said = subprocess.run(
        [program, "tum", camera / "groundtruth.txt", camera / "estimate.txt",
         "--t_max_diff", "0.001"],
        capture_output=True, text=True, env={**os.environ, "HOME": str(tmp_path)})
    assert said.returncode == 0, said.stderr
    print(said.stdout)
    true = {row[0]: row[1:4] for row in np.loadtxt(camera / "groundtruth.txt")}
    believed = np.loadtxt(camera / "estimate.txt")
    off_m = [np.linalg.norm(row[1:4] - true[row[0]]) for row in believed if row[0] in true]
    assert len(off_m) > 5
    rmse_m = float(re.search(r"rmse\s+([0-9.]+)", said.stdout)[1])
    assert 0.001 < rmse_m, "an estimate of images drifts"
    assert abs(rmse_m - np.sqrt(np.mean(np.square(off_m)))) < 1e-5
