"""A word for a time constant."""

from __future__ import annotations

from arthur_acausal import UnitError, simulate
from tests.errors.decay import Decay

ERROR = UnitError
EXPECT = [r"^T\b", r"'slow' does not begin with a number"]


def run() -> object:
    return simulate(Decay(), 1.0, parameters={"T": "slow"})
