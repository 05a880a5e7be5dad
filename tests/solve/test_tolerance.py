"""Tolerances of algebraic unknowns that amplify the errors of the states."""

from __future__ import annotations

import numpy as np
import pytest
from casadi import cos, tanh

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SimulationError,
    SolverOptions,
    der,
    discrete,
    parameter,
    pre,
    time,
    translate,
    variable,
    when,
)
from arthur_acausal.solve.tolerance import Tolerances


class Oscillator(Component):
    """x = cos t."""

    T: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=1.0, fixed=True)
    v: Real = variable("1", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.v
        yield self.T * der(self.v) == -self.x


class WithDifference(Oscillator):
    """And ``a``: K times the difference of x and its exact value; and ``b``, a function of it."""

    K: Real = parameter("1", default=1e3)
    a: Real = variable("1")
    b: Real = variable("1")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.a == self.K * (self.x**2 - cos(time() / self.T) ** 2)
        yield self.b + tanh(self.b) == self.a


@pytest.mark.parametrize("rtol", [1e-6, 1e-9])
def test_a_difference_of_large_terms_costs_no_steps(rtol: float) -> None:
    plain = translate(Oscillator()).simulate(10.0, tolerance=rtol)
    amplified = translate(WithDifference(K=1e-3 / rtol)).simulate(10.0, tolerance=rtol)
    error = np.abs(amplified["x"] - np.cos(amplified.t)).max()
    assert error < 200 * rtol
    assert amplified.statistics.steps < 2 * plain.statistics.steps
    np.testing.assert_allclose(amplified["b"] + np.tanh(amplified["b"]), amplified["a"], rtol=1e-9, atol=1e-9)


def test_tolerances_that_are_given_stay() -> None:
    options = SolverOptions(rtol=1e-6, atol={"b": 1e-8}, max_steps=5000)
    with pytest.raises(SimulationError, match="the error of b dominates"):
        translate(WithDifference(K=1e6)).simulate(0.5, options=options)


class Ticking(Oscillator):
    """And an algebraic unknown, and ticks that change no equation: IDA goes on over them, a step or so a tick."""

    b: Real = variable("1")
    period: Real = parameter("s", default=0.01)
    next: Real = discrete("s", start=0.01)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.b + tanh(self.b) == self.x
        yield when(time() >= pre(self.next), self.next == pre(self.next) + self.period)


def test_new_tolerances_in_between_leave_the_states_as_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """A run that stops to take new ones goes on from its last good values, not from those that a step has tried."""
    stops = []

    def widen(_: Tolerances) -> bool:
        stops.append(1)
        return True

    monkeypatch.setattr(Tolerances, "widen", widen)
    solution = translate(Ticking()).simulate(10.0, tolerance=1e-6)
    assert len(stops) > 5
    assert np.abs(solution["x"] - np.cos(solution.t)).max() < 1e-4
