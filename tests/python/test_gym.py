"""Environments."""

import multiprocessing
import os
import signal
import threading
import time
import warnings

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
import gnbv.gym  # noqa: E402

BUDGET = {"planner.termination.max_iterations": 8}


def same(a, b):
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if isinstance(a, (tuple, list)):
        return len(a) == len(b) and all(map(same, a, b))
    return np.array_equal(a, b)


@pytest.mark.parametrize("action", ["view", "candidate"])
def test_check_env(action):
    from gymnasium.utils.env_checker import check_env

    env = gymnasium.make("gnbv/Smoke-v0", action=action, set=BUDGET).unwrapped
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env, skip_render_check=True)
    env.close()


def test_rewards_add_up_to_the_coverage_gained():
    env = gymnasium.make("gnbv/Smoke-v0", action="candidate", set=BUDGET).unwrapped
    _, info = env.reset(seed=3)
    first, total = info["coverage"], 0.0
    over = False
    while not over:
        action = int(np.flatnonzero(info["action_mask"])[-1])
        _, reward, terminated, truncated, info = env.step(action)
        total += reward
        over = terminated or truncated
    assert total * env._stage.about["ceiling"] == pytest.approx(info["coverage"] - first)
    with pytest.raises(RuntimeError, match="reset"):
        env.step(action)


def test_the_goal_terminates_and_the_budget_truncates():
    for goal in (0.05, 0.6):  # the first is reached by the profile
        env = gymnasium.make("gnbv/Smoke-v0", action="candidate", goal=goal)
        seen, info = env.reset(seed=1)
        terminated = truncated = False
        while not terminated:
            assert not truncated
            unknown, sparse = seen["candidates"][:, 1], seen["candidates"][:, 4]
            action = int((unknown + 3 * sparse).argmax())
            seen, _, terminated, truncated, info = env.step(action)
        assert info["termination"] == "coverage_reached"
    for is_refused in (False, True):
        env = gymnasium.make("gnbv/Smoke-v0", action="candidate", goal=0.0, set=BUDGET)
        _, info = env.reset(seed=1)
        for step in range(1, 8):  # the start's view is the first of eight
            action = int(np.flatnonzero(info["action_mask"] == (0 if is_refused else 1))[0])
            seen, _, terminated, truncated, info = env.step(action)
            assert (info["refused"] != "") == is_refused
            assert (terminated, truncated) == (False, step == 7)
        assert seen["progress"][1] == 1.0


def test_what_may_not_be_taken_costs_a_step_and_moves_nothing():
    env = gymnasium.make("gnbv/Smoke-v0", action="candidate", set=BUDGET)
    seen, info = env.reset(seed=1)
    masked = np.flatnonzero(info["action_mask"] == 0)
    assert len(masked)
    after, reward, _, _, info = env.step(int(masked[0]))
    assert info["refused"] == "masked" and reward == 0.0
    assert seen.pop("progress")[1] == pytest.approx(1 / 8)
    assert after.pop("progress")[1] == pytest.approx(2 / 8)
    assert same(seen, after)


@pytest.mark.parametrize("threads", [1, 2, 4])
def test_a_vector_does_what_single_ones_do_at_any_number_of_threads(threads):
    envs = gymnasium.make_vec("gnbv/Smoke-v0", num_envs=3, set=BUDGET, threads=threads)
    batch, _ = envs.reset(seed=10)
    singles = [gymnasium.make("gnbv/Smoke-v0", set=BUDGET) for _ in range(3)]
    for i, single in enumerate(singles):
        seen, _ = single.reset(seed=10 + i)
        assert same(seen, {key: batch[key][i] for key in batch})
    random = np.random.default_rng(0)
    over = np.zeros(3, bool)
    for _ in range(10):
        actions = random.uniform(-1, 1, (3, 4)).astype(np.float32)
        batch, rewards, ended, cut, _ = envs.step(actions)
        for i, single in enumerate(singles):
            if over[i]:
                seen, _ = single.reset()
                assert rewards[i] == 0.0
            else:
                seen, reward, terminated, truncated, _ = single.step(actions[i])
                assert (reward, terminated, truncated) == (rewards[i], ended[i], cut[i])
            assert same(seen, {key: batch[key][i] for key in batch})
        over = ended | cut
    envs.close()


def of_kind(kind, **more):
    """An environment, or a vector of two; both are stepped alike."""
    if kind == "single":
        return gymnasium.make("gnbv/Smoke-v0", set=BUDGET, goal=0.0, **more).unwrapped
    return gymnasium.make_vec("gnbv/Smoke-v0", num_envs=2, set=BUDGET, goal=0.0, **more)


KINDS = pytest.mark.parametrize("kind", ["single", "vector"])


@KINDS
def test_a_closed_environment_says_so_and_can_be_reset(kind):
    env = of_kind(kind)
    env.reset(seed=1)
    action = env.action_space.sample()
    (env.close if kind == "single" else env.close_extras)()
    with pytest.raises(RuntimeError, match=r"closed; call reset\(\)"):
        env.step(action)
    env.reset(seed=1)
    env.step(action)


@KINDS
@pytest.mark.parametrize("does", ["step", "reset", "close"])
def test_in_a_forked_child_nothing_waits(kind, does):
    env = of_kind(kind)
    env.reset(seed=1)
    said, saying = multiprocessing.Pipe(duplex=False)

    def child():
        try:
            if does == "step":
                env.step(env.action_space.sample())
            else:
                getattr(env, does)()
            saying.send("")
        except BaseException as error:
            saying.send(f"{type(error).__name__}: {error}")

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # Python warns of forks with threads
        process = multiprocessing.get_context("fork").Process(target=child)
        process.start()
    process.join(20)
    hangs = process.is_alive()
    process.kill()
    assert not hangs and said.poll()
    message = said.recv()
    if does == "close":  # also what the child's end does
        assert message == ""
    else:
        assert message.startswith("RuntimeError: ") and "forked" in message, message
    env.step(env.action_space.sample())  # the parent's flies on


def test_ctrl_c_ends_a_wait_and_what_is_left_says_so():
    env = gymnasium.make("gnbv/Aircraft-v0", goal=0.0).unwrapped  # its profile takes seconds
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        env.reset(seed=1)
    assert time.monotonic() - begin < 2.0
    with pytest.raises(RuntimeError, match=r"interrupted.*reset"):
        env.step(env.action_space.sample())
    env.close()


NAN, ZEROS = [np.nan] * 4, [0] * 4
BAD = {
    "single": [np.zeros(3), np.zeros((1, 4)), np.full(4, np.nan), [0, 0, np.inf, 0], None, "up"],
    "vector": [np.zeros((1, 4)), np.zeros((3, 4)), np.zeros(4), [ZEROS, NAN], [ZEROS, [0] * 3]],
}


@pytest.mark.parametrize("kind, bad", BAD.items())
def test_an_action_that_is_none_moves_nothing(kind, bad):
    """Oracle: the same actions without the bad ones among them."""
    batch = () if kind == "single" else (2,)
    random = np.random.default_rng(1)
    good = [random.uniform(-1, 1, (*batch, 4)).astype(np.float32) for _ in range(3)]

    def flown(between):
        env = of_kind(kind)
        env.reset(seed=2)
        trace = []
        for action in good:
            for none in between:
                with pytest.raises(ValueError):
                    env.step(none)
            trace.append(env.step(action)[:4])
        env.close()
        return trace

    assert same(flown([]), flown(bad))


def test_candidates_and_seeds_are_checked_likewise():
    env = gymnasium.make("gnbv/Smoke-v0", action="candidate", set=BUDGET, goal=0.0).unwrapped
    env.reset(seed=1)
    for none in (-1, env.action_space.n, 0.5, True, [0], np.nan):
        with pytest.raises(ValueError):
            env.step(none)
    assert env._episode.steps == 0
    envs = of_kind("vector")
    envs.reset(seed=1)
    before = [episode.mission for episode in envs._episodes]
    for seeds in ([1], [1, 2, 3]):
        with pytest.raises(ValueError, match="seeds"):
            envs.reset(seed=seeds)
    assert before == [episode.mission for episode in envs._episodes]
    envs.step(envs.action_space.sample())
    poses = []
    for _ in range(2):  # None goes on, as with a single environment
        envs.reset(seed=[1, 2])
        poses.append(envs.reset(seed=[None, None])[0]["pose"])
    assert same(*poses) and not same(poses[0], envs.reset(seed=[1, 2])[0]["pose"])


@pytest.mark.parametrize(
    ("name", "value"),
    [("goal", 95), ("goal", -1.0), ("goal", np.nan), ("crop", 2.5), ("seeds", 1.5)]
    + [("num_envs", 0)],
)
def test_arguments_that_mean_nothing_are_refused_by_name(name, value):
    with pytest.raises(gnbv.BadInput, match=f"{name}: value"):
        gnbv.gym.NbvVectorEnv(**{"num_envs": 1, name: value})


def test_masks_and_beliefs_need_an_episode():
    env = of_kind("single", action="candidate")
    with pytest.raises(RuntimeError, match="action_masks: the episode was not reset"):
        env.action_masks()


@KINDS
def test_a_picture_shows_the_map_and_the_way(kind):
    env = of_kind(kind, render_mode="rgb_array")
    assert env.metadata["render_modes"] == ["rgb_array"] and env.metadata["render_fps"] > 0
    env.reset(seed=1)

    def pictures():
        drawn = env.render()
        return [drawn] if kind == "single" else list(drawn)

    first = pictures()
    for _ in range(3):
        env.step(env.action_space.sample())
    for before, after in zip(first, pictures(), strict=True):
        assert before.dtype == np.uint8 and before.shape == after.shape and before.shape[2] == 3
        way = (after == (200, 30, 60)).all(axis=2).sum()
        assert way > 20 and (before == (200, 30, 60)).all(axis=2).sum() == 0
        assert (after[:, :, 0] > 200).sum() > 100, "what is known is bright"
    assert of_kind(kind).render() is None
    with pytest.raises(ValueError, match="render_mode"):
        of_kind(kind, render_mode="human_eye")
    env.close()


def test_all_scenarios_are_registered():
    for name, scenario in gnbv.gym.SCENARIOS.items():
        assert gymnasium.spec(f"gnbv/{name}-v0").kwargs["scenario"] == scenario
