"""An input that is called otherwise."""

from __future__ import annotations

from arthur_acausal import UsageError, simulate
from tests.errors.decay import Decay

ERROR = UsageError
EXPECT = [r"no input 'level'", r"it has u\b"]


def run() -> object:
    return simulate(Decay(), 1.0, inputs={"level": 2.0})
