"""An agent that takes any candidate that may be taken.

usage: random_agent.py [ENVIRONMENT [SEED]]
"""

import sys

import gymnasium
import numpy as np

import gnbv.gym  # noqa: F401  (registers the environments)

if __name__ == "__main__":
    name = sys.argv[1] if len(sys.argv) > 1 else "gnbv/Smoke-v0"
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    env = gymnasium.make(name, action="candidate")
    random = np.random.default_rng(seed)
    _, info = env.reset(seed=seed)
    total, over = 0.0, False
    while not over and info["action_mask"].any():
        action = int(random.choice(np.flatnonzero(info["action_mask"])))
        _, reward, terminated, truncated, info = env.step(action)
        total += reward
        over = terminated or truncated
    env.close()
    print(f"reward {total:.3f}, coverage {info['coverage']:.3f}, {info['flown_m']:.1f} m flown")
