"""Environments that are kept: profiles between episodes, and the state for a search in trees."""

import copy
import pickle

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
from test_gym import same  # noqa: E402

import gnbv.gym  # noqa: E402

BUDGET = {"planner.termination.max_iterations": 6}
SAME_START = {**BUDGET, "start.jitter_m": [0, 0, 0]}  # nothing up to the first view reads the seed
WINDY = {**BUDGET, "wind.gust_w20_m_s": 4.0, "vehicle.estimate.model": "mocap"}
QUICK = {**WINDY, "planner.profiling.method": "none"}
NOISY = {**WINDY, "lidars": "[{name: lidar, beams: 181, rate_hz: 10, range_sigma_m: 0.02}]"}


def made(settings=BUDGET, **more):
    return gymnasium.make("gnbv/Smoke-v0", set=settings, goal=0.0, **more).unwrapped


def flown(env, random, count=99):
    """What so many steps bring, or those to the end, and the hash then."""
    trace = []
    for _ in range(count):
        if env.action_space.shape:
            action = random.uniform(-1, 1, 4).astype(np.float32)
        else:
            action = int(random.integers(env.action_space.n))  # masked ones, too
        trace.append(env.step(action))
        if trace[-1][2] or trace[-1][3]:
            break
    return [*trace, env.result_sha256]


@pytest.mark.parametrize("settings", [BUDGET, SAME_START, WINDY, NOISY])
def test_a_kept_profile_changes_nothing(settings):
    """Oracle: environments made anew, which have none. Episodes of three seeds, each twice."""

    def episode(env, seed):
        first = env.reset(seed=seed)
        return [first, *flown(env, np.random.default_rng(seed))]

    keeps = made(settings, seeds=3)
    hashes = set()
    for seed in (0, 1, 2, 0, 1, 2):
        alone = made(settings, seeds=3)
        expected = episode(alone, seed)
        assert same(episode(keeps, seed), expected)
        hashes.add(expected[-1])
        assert len(expected[-1]) == 64
        alone.close()
    assert len(hashes) > 1
    keeps.close()


def test_a_mission_of_the_environment_is_that_of_the_program():
    """With a kept profile, too, the same views give the hash that gnbv.run says."""
    env = made(seeds=1)
    for _ in range(2):
        env.reset(seed=5)
        said = flown(env, np.random.default_rng(5))[-1]
    views = [env._stage.view_of(action, {})[0] for action in env._episode.actions]

    told = iter(views)
    run = gnbv.run("smoke", planner=lambda belief, history: next(told), seed=0, set=BUDGET)
    assert run.termination == "max_iterations" and run.sha256 == said
    env.close()


@pytest.mark.parametrize("action", ["view", "candidate"])
@pytest.mark.parametrize("how", ["clone", "deepcopy", "pickle", "pickled_state"])
def test_from_a_restored_state_the_same_actions_bring_the_same(how, action):
    """Oracle: the environment that was never copied, in each of its steps, refused ones too."""
    env = made(QUICK, action=action)
    env.reset(seed=7)
    for step in range(5):
        state = env.clone_state()
        ahead = flown(env, np.random.default_rng(step))
        beyond = env.reset()[0]
        if how == "clone":
            other = env
            other.restore_state(state)
        elif how == "pickled_state":
            other = made(QUICK, action=action)
            other.restore_state(pickle.loads(pickle.dumps(state)))
        else:
            env.restore_state(state)
            other = copy.deepcopy(env) if how == "deepcopy" else pickle.loads(pickle.dumps(env))
            flown(env, np.random.default_rng(99), 1)  # what one does is nothing to the other
        assert same(flown(other, np.random.default_rng(step)), ahead)
        assert same(other.reset()[0], beyond), "its random numbers, too"
        if other is not env:
            other.close()
        env.restore_state(state)
        _, _, terminated, truncated, _ = env.step(env.action_space.sample())
        if terminated or truncated:
            break
    env.close()


def test_an_end_is_restored_as_one():
    env = made()
    env.reset(seed=1)
    flown(env, np.random.default_rng(0))
    state, said = env.clone_state(), env.result_sha256
    env.reset(seed=2)
    env.restore_state(state)
    assert env.result_sha256 == said and len(said) == 64
    with pytest.raises(RuntimeError, match="is over"):
        env.step(env.action_space.sample())
    env.close()


def test_what_has_no_state_says_so():
    env = made()
    with pytest.raises(RuntimeError, match="not reset"):
        env.clone_state()
    copy.deepcopy(env).reset(seed=1)
    env.reset(seed=1)
    state = env.clone_state()
    with pytest.raises(ValueError, match="restore_state"):
        made(SAME_START).restore_state(state)
    env.close()
    with pytest.raises(RuntimeError, match="closed"):
        env.clone_state()
    env.restore_state(state)
    env.step(env.action_space.sample())
    with pytest.raises(ValueError, match="seeds"):
        made(seeds=-1)
