"""A solver option that does not exist."""

from __future__ import annotations

from arthur_acausal import SolverOptions, UsageError

ERROR = UsageError
EXPECT = [r"no solver option 'rtoll'", r"did you mean rtol"]


def run() -> object:
    return SolverOptions().replace(rtoll=1e-3)
