"""A negative time constant for one run."""

from __future__ import annotations

from arthur_acausal import ParameterError, simulate
from tests.errors.decay import Decay

ERROR = ParameterError
EXPECT = [r"^T\b", r"-3 s", r"outside of \[0, inf\]", r"time constant, positive"]


def run() -> object:
    return simulate(Decay(), 1.0, parameters={"T": -3.0})
