"""Batches of simulations: specified, run on one machine or a Dask cluster, kept whatever happens, and looked at.

``sweep(Model, vary={...}, stop_time=...)`` runs one from Python; ``open(DIR)`` gives the table and the trajectories.
"""

from arthur_acausal.sweep.call import sweep
from arthur_acausal.sweep.importance import Importance, importance
from arthur_acausal.sweep.opened import Sweep
from arthur_acausal.sweep.opened import open_sweep as open
from arthur_acausal.sweep.pictures import picture
from arthur_acausal.sweep.report import write_report
from arthur_acausal.sweep.specification import Output, Replicates, Specification

__all__ = [
    "Importance",
    "Output",
    "Replicates",
    "Specification",
    "Sweep",
    "importance",
    "open",
    "picture",
    "sweep",
    "write_report",
]
