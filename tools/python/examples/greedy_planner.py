"""A planner in thirty lines: the sampled view that sees the most unknown voxels a metre; where
none sees any, the thinly sampled surface.

usage: greedy_planner.py [SCENARIO [VIEWS]]
       gnbv compare SCENARIO --utilities proposed,greedy_planner.py:greedy
"""

import sys

import numpy as np

import gnbv


def greedy(belief: gnbv.Belief, history: gnbv.History, most_views: int = 30):
    if len(history) >= most_views:
        return None
    for candidates in (belief.sample(), belief.sample(scale=3.0), belief.sample_frontiers()):
        views = belief.valid(candidates)
        if not len(views):
            continue
        stats = belief.evaluate(views)
        gain = stats["unknown_voxels"] + 5.0 * stats["sparse_voxels"]
        score = gain * np.exp(-0.2 * stats["path_m"])
        if score.max() > 1.0:
            return views[score.argmax()]
    return None


if __name__ == "__main__":
    scenario = sys.argv[1] if len(sys.argv) > 1 else "smoke"
    most_views = int(sys.argv[2]) if len(sys.argv) > 2 else 30

    def planner(belief, history):
        return greedy(belief, history, most_views)

    print(gnbv.run(scenario, planner=planner))
