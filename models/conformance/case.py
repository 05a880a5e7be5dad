"""What a reference case is: a model, and which of its variables the reference's signals are."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from arthur_acausal import Component, SolverOptions


@dataclass(frozen=True)
class Case:
    """A model to be compared with reference trajectories.

    Attributes
    ----------
    name : of the case.
    model : makes the model.
    signals : name in the reference -> path of the variable in the model, in the same unit.
    stop_time : end of the run, s.
    options : of the solver; by default as many outputs as the references have, so that transients are seen alike.
    note : reason for a known difference from the reference, if there is one.
    """

    name: str
    model: Callable[[], Component]
    signals: Mapping[str, str]
    stop_time: float
    options: SolverOptions = field(default_factory=lambda: SolverOptions(intervals=5000))
    note: str = ""
