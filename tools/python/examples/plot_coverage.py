"""Coverage over metres of some runs beside each other, by matplotlib.

usage: plot_coverage.py OUT.png RUN...
"""

import sys

import matplotlib

import gnbv.plots

matplotlib.use("Agg")
import matplotlib.pyplot as plt

if __name__ == "__main__":
    out, *runs = sys.argv[1:]
    figure, (left, right) = plt.subplots(1, 2, figsize=(7, 3), layout="constrained")
    gnbv.plots.coverage(runs, effort="metres", ax=left)
    gnbv.plots.coverage(runs, effort="views", ax=right)
    left.legend(loc="lower right", fontsize=7)
    right.get_legend().remove()
    right.set_ylabel("")
    figure.savefig(out, dpi=150)
    print(out)
