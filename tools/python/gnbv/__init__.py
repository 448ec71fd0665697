"""Next-best-view 3D reconstruction with a UAV: simulate, measure, compare.

    run = gnbv.run("aircraft", utility="bircher", seed=1)   # one mission -> Run
    run = gnbv.load("runs/first")                           # one that was flown
    print(gnbv.compare("smoke", utilities=["proposed", mine], seeds=8))

Positions are in metres in the world's frame (ENU, z up), yaw in radians, 0 = east, 90 degrees =
north. A utility of your own is a function from NumPy's structured array of the candidates'
ViewStats to a score each; a planner of your own a function from Belief and History to a View.
`gnbv.gym` has environments for Gymnasium.
"""

from gnbv._errors import BadInput, BrokenInvariant, Failed, Fault, Interrupted, UtilityFailed
from gnbv._frames import Frame
from gnbv._loaded import __version__
from gnbv._mission import run
from gnbv._planner import Belief, History, View
from gnbv._run import Run, load
from gnbv._tables import Table, compare, table
from gnbv._utility import utilities

__all__ = [
    "BadInput",
    "Belief",
    "BrokenInvariant",
    "Failed",
    "Fault",
    "Frame",
    "History",
    "Interrupted",
    "Run",
    "Table",
    "UtilityFailed",
    "View",
    "__version__",
    "compare",
    "load",
    "run",
    "table",
    "utilities",
]
