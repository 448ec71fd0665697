"""Trains PPO (skrl, on JAX and the CPU) to choose among sampled views, beside a random agent.

    pip install 'gnbv[gym]' skrl jax flax optax matplotlib
    python train_ppo.py [STEPS [CURVE.png]]     # steps of all four environments, 12000 by default

The policy scores each candidate by the same small network, as a utility does.
"""

import os
import sys

os.environ.setdefault("JAX_PLATFORMS", "cpu")

import flax.linen as nn
import gymnasium
import jax.numpy as jnp
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from skrl import config
from skrl.agents.jax.ppo import PPO, PPO_CFG
from skrl.envs.wrappers.jax import wrap_env
from skrl.memories.jax import RandomMemory
from skrl.models.jax import CategoricalMixin, DeterministicMixin, Model
from skrl.trainers.jax import SequentialTrainer

import gnbv.gym  # noqa: F401  (registers)

ENVS = 4
FEATURES = 8  # of a candidate; all are 0 where it may not be taken


class Flat(gymnasium.vector.VectorObservationWrapper):
    """The candidates' features and the progress as one row; the returns of ended episodes."""

    def __init__(self, envs):
        super().__init__(envs)
        size = envs.single_action_space.n * FEATURES + 2
        self.single_observation_space = gymnasium.spaces.Box(-1.0, 1.0, (size,), np.float32)
        self.observation_space = gymnasium.vector.utils.batch_space(
            self.single_observation_space, envs.num_envs
        )
        self.steps, self.returns = 0, []  # (steps so far, return)
        self.sums = np.zeros(envs.num_envs)

    def observations(self, seen):
        rows = seen["candidates"].reshape(len(seen["progress"]), -1)
        return np.hstack([rows, seen["progress"]])

    def step(self, actions):
        seen, rewards, terminated, truncated, infos = super().step(actions)
        self.steps += self.num_envs
        self.sums += rewards
        for i in np.flatnonzero(terminated | truncated):
            self.returns.append((self.steps, self.sums[i]))
            self.sums[i] = 0.0
        return seen, rewards, terminated, truncated, infos


def parts_of(inputs):
    """Features (batch, candidates, 8 and the progress), and which may be taken."""
    rows = inputs["observations"]
    candidates = rows[:, :-2].reshape(rows.shape[0], -1, FEATURES)
    progress = jnp.broadcast_to(rows[:, None, -2:], (*candidates.shape[:2], 2))
    return jnp.concatenate([candidates, progress], axis=2), jnp.any(candidates != 0.0, axis=2)


class Policy(CategoricalMixin, Model):
    def __init__(self, observation_space, action_space, **more):
        Model.__init__(self, observation_space=observation_space, action_space=action_space, **more)
        CategoricalMixin.__init__(self, unnormalized_log_prob=True)

    @nn.compact
    def __call__(self, inputs, role):
        features, allowed = parts_of(inputs)
        scores = nn.Dense(1)(nn.tanh(nn.Dense(32)(features)))[:, :, 0]
        return jnp.where(allowed, scores, scores - 30.0), {}


class Value(DeterministicMixin, Model):
    def __init__(self, observation_space, action_space, **more):
        Model.__init__(self, observation_space=observation_space, action_space=action_space, **more)
        DeterministicMixin.__init__(self)

    @nn.compact
    def __call__(self, inputs, role):
        features, _ = parts_of(inputs)
        pooled = jnp.concatenate([features.mean(axis=1), features.max(axis=1)], axis=1)
        return nn.Dense(1)(nn.tanh(nn.Dense(32)(pooled))), {}


def make():
    return Flat(
        gymnasium.make_vec(
            "gnbv/Smoke-v0",
            num_envs=ENVS,
            action="candidate",
            goal=0.0,
            seeds=16,
            set={"planner.termination.max_iterations": 6},
        )
    )


def random_returns(steps):
    """Of an agent that takes any of the views that may be taken."""
    random = np.random.default_rng(0)
    envs = make()
    _, infos = envs.reset(seed=1)
    while envs.steps < steps:
        masks = infos["action_mask"]
        actions = [int(random.choice(np.flatnonzero(m))) if m.any() else 0 for m in masks]
        _, _, _, _, infos = envs.step(np.array(actions))
    envs.close()
    return np.array([each for _, each in envs.returns])


def train(steps):
    """The returns of a PPO as it learns: (steps so far, return)."""
    config.jax.key = 1
    flat = make()
    env = wrap_env(flat, wrapper="gymnasium")
    spaces = {"observation_space": env.observation_space, "action_space": env.action_space}
    models = {"policy": Policy(**spaces), "value": Value(**spaces)}
    for role, model in models.items():
        model.init_state_dict(role=role)
    cfg = PPO_CFG(rollouts=64, mini_batches=4, learning_rate=3e-3, discount_factor=0.95)
    cfg.experiment.write_interval = cfg.experiment.checkpoint_interval = 0
    memory = RandomMemory(memory_size=cfg.rollouts, num_envs=ENVS)
    agent = PPO(models=models, memory=memory, cfg=cfg, **spaces)
    quiet = {"timesteps": steps // ENVS, "disable_progressbar": True, "headless": True}
    SequentialTrainer(env=env, agents=agent, cfg=quiet).train()
    env.close()
    return np.array(flat.returns)


def main(steps=12000, curve="learning_curve.png"):
    by_chance = random_returns(min(steps, 2000))
    learnt = train(steps)
    last = learnt[-max(1, len(learnt) // 5) :, 1]
    print(f"random: {by_chance.mean():.3f} of the surface an episode")
    print(f"PPO, the last fifth of {steps} steps: {last.mean():.3f}")

    window = max(1, len(learnt) // 40)
    mean = np.convolve(learnt[:, 1], np.full(window, 1.0 / window), "valid")
    _, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
    axes.plot(learnt[:, 0], learnt[:, 1], ".", ms=2, alpha=0.3, label="episodes")
    axes.plot(learnt[window - 1 :, 0], mean, label=f"mean of {window}")
    axes.axhline(by_chance.mean(), color="0.4", ls="--", label="random agent")
    axes.set(xlabel="steps", ylabel="coverage gained in an episode", title="PPO on gnbv/Smoke-v0")
    axes.legend(loc="center right")
    plt.savefig(curve, dpi=120)


if __name__ == "__main__":
    main(*(kind(text) for kind, text in zip((int, str), sys.argv[1:3], strict=False)))
