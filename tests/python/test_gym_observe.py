"""What environments show beside the coarse map."""

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
import gnbv.gym  # noqa: E402

SET = {"planner.termination.max_iterations": 5, "planner.profiling.method": "none"}
ALL = ("depth", "rgb", "crop", "poses")


def made(**more):
    return gymnasium.make("gnbv/Smoke-v0", set=SET, goal=0.0, **more).unwrapped


@pytest.fixture
def stepped():
    env = made(action="candidate", observe=ALL, crop=15)
    _, info = env.reset(seed=2)
    yield env, env.step(int(np.flatnonzero(info["action_mask"])[3]))
    env.close()


def test_all_of_it_is_in_its_space(stepped):
    env, (seen, *_) = stepped
    assert env.observation_space.contains(seen)
    assert seen["depth_rgbd"].shape == (120, 160) and seen["rgb_rgbd"].shape == (120, 160, 3)
    assert seen["crop"].shape == (2, 15, 15, 15)
    envs = gymnasium.make_vec(
        "gnbv/Smoke-v0", num_envs=2, set=SET, goal=0.0, observe=("depth", "crop")
    )
    batch, _ = envs.reset(seed=2)
    assert envs.observation_space.contains(batch)
    envs.close()


def test_images_are_those_of_the_beliefs_frames(stepped):
    env, (seen, *_, info) = stepped
    (frame,) = env.belief.frames
    assert np.array_equal(seen["rgb_rgbd"], frame.rgb) and len(np.unique(frame.rgb)) > 10
    hit = np.isfinite(frame.depth_m)
    assert hit.any() and np.array_equal(seen["depth_rgbd"][hit], frame.depth_m[hit])
    assert (seen["depth_rgbd"][np.isposinf(frame.depth_m)] == 5.0).all()
    kept = {key: array.copy() for key, array in seen.items() if key.endswith("rgbd")}
    for array in (seen["rgb_rgbd"], frame.rgb, frame.depth_m):  # whose they are
        array[...] = 7
    again = env.step(int(np.flatnonzero(info["action_mask"] == 0)[0]))[0]  # moves nothing
    assert all(np.array_equal(again[key], array) for key, array in kept.items())
    with pytest.raises(gnbv.BadInput, match="environment made with observe"):
        plain = made()
        plain.reset()
        plain.belief.frames  # noqa: B018


def test_the_crop_is_the_map_around_the_vehicle(stepped):
    """Oracle: the whole map of env.belief, voxel by voxel."""
    env, (seen, *_) = stepped
    belief = env.belief
    where, density = belief.density
    dense = np.zeros(belief.log_odds.size)
    dense[where] = np.minimum(density / belief.density_max, 1.0)
    dense = dense.reshape(belief.log_odds.shape)
    at = np.floor((np.array(belief.current[:3]) - belief.origin_m) / belief.resolution_m)
    inside = 0
    for place in np.ndindex(15, 15, 15):
        voxel = tuple(int(v) for v in at[::-1].astype(int) + place - 7)  # z, y, x
        is_in = all(0 <= v < n for v, n in zip(voxel, dense.shape, strict=True))
        odds = belief.log_odds[voxel] if is_in else 0.0
        inside += is_in
        assert seen["crop"][0][place] == pytest.approx(1.0 / (1.0 + np.exp(-odds)), abs=1e-6)
        assert seen["crop"][1][place] == pytest.approx(dense[voxel] if is_in else 0.0, abs=1e-6)
    assert 0 < inside < 15**3 and (seen["crop"][0] != 0.5).any()


def test_candidates_poses_are_those_that_are_flown_to(stepped):
    env, (seen, _, _, _, info) = stepped
    index = int(np.flatnonzero(info["action_mask"])[0])
    x, y, z, sine, cosine, pitch = seen["candidate_poses"][index]
    after, *_ = env.step(index)
    assert np.allclose(after["pose"], [x, y, z, sine, cosine], atol=1e-5) and pitch == 0.0


def test_the_belief_is_a_copy_that_stays(stepped):
    env, _ = stepped
    belief = env.belief
    odds, cloud = belief.log_odds, belief.cloud
    kept, points = odds.copy(), len(cloud)
    stats = belief.evaluate(belief.valid(belief.sample()))
    for _ in range(2):
        env.step(env.action_space.sample())
    env.reset(seed=3)
    del belief
    env.close()
    assert np.array_equal(odds, kept) and len(cloud) == points and len(stats)
    with pytest.raises(RuntimeError, match="closed"):
        env.belief  # noqa: B018


def test_wishes_that_mean_nothing_are_refused():
    for wrong in (
        {"observe": "depth"},
        {"observe": ("sound",)},
        {"observe": ("poses",)},
        {"crop": 0},
    ):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            made(**wrong)
