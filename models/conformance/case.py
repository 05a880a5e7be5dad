"""What a reference case is: a model, and which of its variables the reference's signals are."""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Mapping
from dataclasses import dataclass, field

from arthur_acausal import Component, SolverOptions

WORDS = {
    "p": "pin_p",
    "n": "pin_n",
    "p1": "pin_p1",
    "n1": "pin_n1",
    "p2": "pin_p2",
    "n2": "pin_n2",
    "heatPort": "heat_port",
    "lossPower": "P_loss",
    "LossPower": "P_loss",
    "startForward": "start_forward",
    "startBackward": "start_backward",
    "off": "blocked",
    "TheatPort": "heat_port.T",
    "flangeR": "flange_r",
    "flangeT": "flange_t",
    "vbc": "v_BC",
    "vbe": "v_BE",
    "vcb": "v_BC",
    "veb": "v_BE",
    "vcs": "v_C",
}
"""Names of the Modelica Standard Library that are others here."""


@dataclass(frozen=True)
class Case:
    """A model to be compared with reference trajectories.

    Attributes
    ----------
    name : of the case.
    model : makes the model.
    signals : name in the reference -> path of the variable in the model, in the same unit; other signals have the
        same name here, or the one that ``WORDS`` and counting from 0 make of it.
    stop_time : end of the run, s, where no reference says otherwise.
    options : of the solver; by default as many outputs as the references have, so that transients are seen alike.
    note : reason for a known difference from the reference, if there is one.
    """

    name: str
    model: Callable[[], Component]
    signals: Mapping[str, str]
    stop_time: float
    options: SolverOptions = field(default_factory=lambda: SolverOptions(intervals=5000))
    note: str = ""

    def path(self, signal: str, known: Container[str]) -> str | None:
        """Return the path of the variable that is a signal of the reference; None if there is none."""
        words = signal.split(".")
        counted = ".".join(re.sub(r"\[(\d+)\]", lambda k: f"[{int(k[1]) - 1}]", word) for word in words)
        here = ".".join(WORDS.get(word, word) for word in counted.split("."))
        flat = re.sub(r"\[(\d+)\]", r"_\1", here)
        candidates = (self.signals.get(signal), signal, counted, here, flat)
        return next((path for path in candidates if path is not None and path in known), None)


def precise(intervals: int) -> SolverOptions:
    """Return options for a case whose reference has so many intervals: far more exact than the tube asks for."""
    return SolverOptions(rtol=1e-8, intervals=intervals)
