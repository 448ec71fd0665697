"""Environments."""

import warnings

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
import gnbv.gym  # noqa: E402

BUDGET = {"planner.termination.max_iterations": 8}


def actions_of(env, info, count, seed):
    random = np.random.default_rng(seed)
    for _ in range(count):
        if "action_mask" in info:
            allowed = np.flatnonzero(info["action_mask"])
            yield int(random.choice(allowed)) if len(allowed) else 0
        else:
            yield random.uniform(-1, 1, env.action_space.shape).astype(np.float32)


def episode(env, seed, count=6):
    seen, info = env.reset(seed=seed)
    trace = [seen]
    for action in actions_of(env, info, count, seed):
        if "action_mask" in info:
            allowed = np.flatnonzero(info["action_mask"])
            action = int(allowed[action % len(allowed)])
        seen, reward, terminated, truncated, info = env.step(action)
        trace.append((seen, reward, terminated, truncated, info["coverage"]))
        if terminated or truncated:
            break
    return trace


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
        warnings.filterwarnings("ignore", message=".*render.*")
        check_env(env, skip_render_check=True)
    env.close()


@pytest.mark.parametrize("action", ["view", "candidate"])
def test_seeds_repeat_bit_by_bit(action):
    env = gymnasium.make("gnbv/Smoke-v0", action=action, set=BUDGET, disable_env_checker=True)
    first, again, other = episode(env, 5), episode(env, 5), episode(env, 6)
    assert same(first, again)
    assert not same(first, other)


def test_observations_are_finite_and_within_their_space():
    env = gymnasium.make("gnbv/Smoke-v0", action="candidate", set=BUDGET)
    for step in episode(env, 1)[1:]:
        assert env.observation_space.contains(step[0])
        assert all(np.isfinite(part).all() for part in step[0].values())


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


def test_all_scenarios_are_registered():
    for name, scenario in gnbv.gym.SCENARIOS.items():
        assert gymnasium.spec(f"gnbv/{name}-v0").kwargs["scenario"] == scenario
