"""A result file that is not there."""

from __future__ import annotations

from arthur_acausal import ResultError, Solution

ERROR = ResultError
EXPECT = [r"nowhere\.nc", r"No such file"]


def run() -> object:
    return Solution.load("nowhere.nc")
