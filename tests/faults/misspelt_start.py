"""A start value for something that has none."""

from __future__ import annotations

from arthur_acausal import ParameterError, simulate
from tests.errors.decay import Decay

ERROR = ParameterError
EXPECT = [r"no start value of 'X'", r"did you mean x\?"]


def run() -> object:
    return simulate(Decay(), 1.0, start={"X": 2.0})
