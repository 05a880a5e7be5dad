"""An input function that returns no number in the course of the run."""

from __future__ import annotations

from arthur_acausal import SimulationError, simulate
from tests.errors.decay import Decay

ERROR = SimulationError
EXPECT = [r"failed at t = 1 s", r"no finite value", r"\"balance\""]


def run() -> object:
    return simulate(Decay(), 2.0, inputs={"u": lambda t: 1.0 if t < 1.0 else float("nan")})
