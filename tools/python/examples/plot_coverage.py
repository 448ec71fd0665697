"""Coverage over metres of some runs, by matplotlib.

usage: plot_coverage.py OUT.png RUN...
"""

import sys

import matplotlib

import gnbv

matplotlib.use("Agg")
import matplotlib.pyplot as plt

if __name__ == "__main__":
    figure, axes = plt.subplots(figsize=(6, 4))
    for folder in sys.argv[2:]:
        run = gnbv.load(folder)
        axes.plot(
            run.coverage["metres"],
            100 * run.coverage["coverage_0.05"],
            label=f"{run.summary['utility']}, seed {run.summary['seed']}",
        )
    axes.set(xlabel="flown straight (m)", ylabel="coverage at 0.05 m (%)")
    axes.legend()
    figure.savefig(sys.argv[1], dpi=150, bbox_inches="tight")
    print(sys.argv[1])
