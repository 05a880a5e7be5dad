"""A pressure is given for a time constant when the run is started."""

from __future__ import annotations

from arthur_acausal import UnitError, simulate
from tests.errors.decay import Decay

ERROR = UnitError
EXPECT = [r"^T\b", r"3 bar", r"pressure", r"time, s", r"give a value in s"]


def run() -> object:
    return simulate(Decay(), 1.0, parameters={"T": "3 bar"})
