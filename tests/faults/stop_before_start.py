"""A run that ends before it begins."""

from __future__ import annotations

from arthur_acausal import UsageError, simulate
from tests.errors.decay import Decay

ERROR = UsageError
EXPECT = [r"stop_time 1", r"start_time 2"]


def run() -> object:
    return simulate(Decay(), 1.0, start_time=2.0)
