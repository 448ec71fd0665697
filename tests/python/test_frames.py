"""What cameras saw, in a planner and in a run."""

import pickle

import numpy as np
import pytest

import gnbv

SET = {"planner.termination.max_iterations": 3}


def points_of(frame):
    """The points that its pixels saw, in the world, by the docstring's formula."""
    v, u = np.nonzero(np.isfinite(frame.depth_m))
    rays = np.linalg.inv(frame.K) @ np.stack([u + 0.5, v + 0.5, np.ones(len(u))])
    points = frame.depth_m[v, u] * rays
    return (frame.T_world_camera @ np.vstack([points, np.ones(len(u))]))[:3].T


def test_a_planner_sees_what_its_cameras_saw_and_the_run_keeps_it():
    """Oracle: the cloud. What a frame saw lies in leaves that the cloud has points in, once that
    view is believed; half a pixel of error would move points out of them."""
    kept = []

    def plan(belief, history):
        (frame,) = belief.frames
        kept.append(frame)
        assert frame.iteration == len(history) - 1 and frame.camera == "rgbd"
        assert frame.depth_m.shape == (120, 160) and frame.rgb.shape == (120, 160, 3)
        points = points_of(frame)
        points = points[points[:, 2] > 0.3]  # below is the floor
        leaves = {tuple(leaf) for leaf in np.floor(belief.cloud / np.float32(0.05)).astype(int)}
        seen = {tuple(leaf) for leaf in np.floor(points / 0.05).astype(int)}
        assert len(seen) > 20
        assert len(seen - leaves) < 0.02 * len(seen)  # of rounding at their borders
        views = belief.valid(belief.sample())
        return views[belief.evaluate(views)["occupied_voxels"].argmax()]

    run = gnbv.run("smoke", planner=plan, seed=1, set=SET, frames=True)
    assert len(kept) == 2 and len(run.frames) == 3  # after the last view nobody is asked
    for ours, read in zip(kept, run.frames[:2], strict=True):
        assert (ours.camera, ours.iteration) == (read.camera, read.iteration)
        assert np.array_equal(ours.rgb, read.rgb) and np.array_equal(ours.K, read.K)
        assert np.allclose(ours.T_world_camera, read.T_world_camera, atol=1e-9)
        finite = np.isfinite(ours.depth_m)
        assert finite.any() and np.array_equal(finite, np.isfinite(read.depth_m))
        assert np.allclose(ours.depth_m[finite], read.depth_m[finite], atol=0.00051)
    assert run.frames[-1].iteration == pickle.loads(pickle.dumps(run)).frames[-1].iteration == 2
    with pytest.raises(IndexError):
        run.frames[3]


def test_without_frames_there_is_depth_and_no_colour(smoke, tmp_path):
    seen = []

    def plan(belief, history):
        seen.extend(belief.frames)
        return None

    gnbv.run("smoke", planner=plan, seed=1, set=SET)
    assert len(seen) == 1 and seen[0].rgb is None and seen[0].depth_m.dtype == np.float32
    with pytest.raises(gnbv.BadInput, match="no frames"):
        smoke.frames  # noqa: B018
    (tmp_path / "p.py").write_text("def p(belief, history):\n    return belief.frames\n")
    with pytest.raises(gnbv.UtilityFailed, match=r"belief\.frames: only"):
        gnbv.run("smoke", utility=f"{tmp_path / 'p.py'}:p", seed=1, set=SET)
