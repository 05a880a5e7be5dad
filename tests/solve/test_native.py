"""The callbacks in C and those in Python give the same results to the last bit, and meet trouble alike."""

from __future__ import annotations

import casadi
import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SimulationError,
    Solution,
    SolverOptions,
    der,
    parameter,
    translate,
    variable,
)
from arthur_acausal.models.examples.bouncing_ball import BouncingBall
from arthur_acausal.models.examples.clutch_engagement import ClutchEngagement
from arthur_acausal.models.examples.dc_motor import DCMotor
from arthur_acausal.models.examples.jack import Jack
from arthur_acausal.models.examples.rc_ladder import RCLadder
from arthur_acausal.result.simulated import Interrupted
from arthur_acausal.solve import native

pytestmark = pytest.mark.skipif(native.extension() is None, reason="no C compiler, or no headers of Python")


class Root(Component):
    """T x' = -sqrt(x) - k: it has no value behind x = 0, into which trial states overstep."""

    T: Real = parameter("s", default=1.0)
    k: Real = parameter("1", default=1e-9)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -casadi.sqrt(self.x) * self.x - self.k


class Explosion(Component):
    """T x' = x^2."""

    T: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.x**2


def both(
    model: Component, stop_time: float, options: SolverOptions, monkeypatch: pytest.MonkeyPatch
) -> list[Solution | SimulationError]:
    translation = translate(model, compile="always")
    results: list[Solution | SimulationError] = []
    used: list[bool] = []
    real = native.Native.of

    def observed(*arguments: object) -> native.Native | None:
        found = real(*arguments)  # type: ignore[arg-type]
        used.append(found is not None)
        return found

    for of in (observed, lambda *_: None):
        with monkeypatch.context() as patch:
            patch.setattr(native.Native, "of", of)
            try:
                results.append(translation.simulate(stop_time, options=options))
            except SimulationError as error:
                results.append(error)
    assert all(used)
    assert used
    return results


@pytest.mark.parametrize(
    ("model", "stop_time", "options"),
    [
        (Jack(), 1.0, SolverOptions()),
        (DCMotor(), 1.0, SolverOptions(store_steps=True)),
        (BouncingBall(), 2.0, SolverOptions(rtol=1e-8)),
        (ClutchEngagement(), 2.0, SolverOptions()),
        (RCLadder(n=250), 1.0, SolverOptions()),  # the sparse solver
        (Root(), 30.0, SolverOptions(rtol=1e-3)),
    ],
)
def test_same_bits_and_counts(
    model: Component, stop_time: float, options: SolverOptions, monkeypatch: pytest.MonkeyPatch
) -> None:
    c, python = both(model, stop_time, options, monkeypatch)
    assert isinstance(c, Solution)
    assert isinstance(python, Solution)
    np.testing.assert_array_equal(c.t, python.t)
    np.testing.assert_array_equal(c.values(c.paths), python.values(c.paths))
    for name in (
        "steps",
        "rejected_steps",
        "residual_evaluations",
        "jacobian_evaluations",
        "root_evaluations",
    ):
        assert getattr(c.statistics, name) == getattr(python.statistics, name), name
    assert c.statistics.non_finite_residuals == python.statistics.non_finite_residuals


@pytest.mark.parametrize(
    ("model", "options"),
    [(Explosion(), SolverOptions()), (Jack(), SolverOptions(max_steps=20))],
)
def test_failures_are_told_alike(
    model: Component, options: SolverOptions, monkeypatch: pytest.MonkeyPatch
) -> None:
    c, python = both(model, 2.0, options, monkeypatch)
    assert isinstance(c, SimulationError)
    assert isinstance(python, SimulationError)
    assert str(c) == str(python)
    np.testing.assert_array_equal(c.solution.t, python.solution.t)


def test_interrupt_keeps_what_was_computed() -> None:
    def progress(t: float) -> None:
        raise KeyboardInterrupt

    translation = translate(Jack(), compile="always")
    with pytest.raises(Interrupted) as caught:
        translation.simulate(1e6, options=SolverOptions(max_step=1e-3, intervals=10**6), progress=progress)
    assert 0.0 < caught.value.solution.t[-1] < 1e6


def test_an_error_in_progress_passes() -> None:
    def progress(t: float) -> None:
        raise RuntimeError("mine")

    with pytest.raises(RuntimeError, match="mine"):
        translate(Jack(), compile="always").simulate(
            1e6, options=SolverOptions(max_step=1e-3, intervals=10**6), progress=progress
        )
