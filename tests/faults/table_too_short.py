"""A table that ends before the run does."""

from __future__ import annotations

from arthur_acausal import Table, UsageError, simulate
from tests.errors.decay import Decay

ERROR = UsageError
EXPECT = [r"input 'u'", r"covers 0 s to 1 s, the run 0 s to 2 s", r"extrapolation=\"hold\""]


def run() -> object:
    return simulate(Decay(), 2.0, inputs={"u": Table([0.0, 1.0], [0.0, 1.0])})
