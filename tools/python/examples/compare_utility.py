"""Is a utility of one's own better than the paper's? Flown over seeds, with paired statistics.

usage: compare_utility.py [SCENARIO [SEEDS]]
"""

import sys

import gnbv


def curious(views):
    seen = views["unknown_voxels"] + 5.0 * views["sparse_voxels"]
    return seen * np.exp(-0.2 * views["path_m"])  # noqa: F821  (np is always there)


if __name__ == "__main__":
    scenario = sys.argv[1] if len(sys.argv) > 1 else "smoke"
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 8
    for table in gnbv.compare(
        scenario, utilities=["proposed", curious], seeds=seeds, ceiling=False, jobs=2
    ):
        print(table, end="\n\n")
