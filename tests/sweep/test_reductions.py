"""Reductions of trajectories against closed forms."""

from __future__ import annotations

import math

import casadi
import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Equations,
    Real,
    Solution,
    SolverOptions,
    der,
    parameter,
    simulate,
    time,
    variable,
)
from arthur_acausal.errors import UsageError
from arthur_acausal.sweep.reductions import parse


class Wave(Component):
    """x = sin t."""

    omega: Real = parameter("rad/s", default=1.0)
    x: Real = variable("1")
    y: Real = variable("s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.x == casadi.sin(self.omega * time())
        yield der(self.y) == self.x


@pytest.fixture(scope="module")
def wave() -> Solution:
    return simulate(Wave(), 2 * math.pi, options=SolverOptions(rtol=1e-9, intervals=20000))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("final(y)", 0.0),
        ("initial(y)", 0.0),
        ("max(y)", 2.0),
        ("min(x)", -1.0),
        ("mean(y)", 1.0),
        ("rms(x)", math.sqrt(0.5)),
        ("integral(y)", 2 * math.pi),
        ("quantile(x, 0.5)", 0.0),
        ("quantile(x, 0.75)", math.sin(math.pi / 4)),
        ("first(x > 0.5)", math.pi / 6),
        ("first(x<-0.5)", 7 * math.pi / 6),
        ("first(y >= 5)", math.nan),
        ("tests.sweep.test_reductions:peak_to_peak", 2.0),
    ],
)
def test_known_values(wave: Solution, text: str, value: float) -> None:
    (reduction,) = parse([text], [], wave.paths)
    (found,) = reduction.of(wave).values()
    assert found == pytest.approx(value, abs=2e-6, nan_ok=True)


def peak_to_peak(solution: Solution) -> float:
    return float(np.ptp(solution["x"]))


def several(solution: Solution) -> dict[str, float]:
    return {"a": 1.0, "b": 2.0}


def test_a_function_may_give_several_columns(wave: Solution) -> None:
    (reduction,) = parse([f"{__name__}:several"], [], wave.paths)
    assert reduction.of(wave) == {"several.a": 1.0, "several.b": 2.0}


def test_default_reductions() -> None:
    names = [r.name for r in parse(None, ["a", "b"], ["a", "b"])]
    assert names[:5] == ["final(a)", "min(a)", "max(a)", "mean(a)", "rms(a)"]
    assert len(names) == 10


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("maxi(x)", "did you mean max"),
        ("max(z)", "there is no variable 'z'"),
        ("quantile(x, 2)", "between 0 and 1"),
        ("quantile(x, a)", "'a' is no number"),
        ("first(x)", "has no relation"),
        ("x", "is no reduction"),
        ("tests.nothing:f", "cannot be imported"),
        ("tests.sweep.test_reductions:missing", "is no function"),
    ],
)
def test_mistakes_are_told(text: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        parse([text], [], ["x", "y"])
