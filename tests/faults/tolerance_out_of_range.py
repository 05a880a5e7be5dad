"""A tolerance that nobody can reach."""

from __future__ import annotations

from arthur_acausal import UsageError, simulate
from tests.errors.decay import Decay

ERROR = UsageError
EXPECT = [r"rtol is 1e-20, not between"]


def run() -> object:
    return simulate(Decay(), 1.0, tolerance=1e-20)
