"""Runs wholly in C: against closed forms and the default engine, independent of each other, refused where unfit."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from arthur_acausal import Component, Equations, Real, SolverOptions, der, parameter, translate, variable
from arthur_acausal.codegen.kernel import compiler
from arthur_acausal.models.examples.bouncing_ball import BouncingBall
from arthur_acausal.models.examples.dc_motor import DCMotor
from arthur_acausal.solve.straight import Straight, fits

pytestmark = pytest.mark.skipif(compiler() is None, reason="no C compiler")


class Oscillator(Component):
    """x'' + w^2 x = 0, written implicitly, from x = 1."""

    w: Real = parameter("rad/s", default=2.0)
    x: Real = variable("1", start=1.0, fixed=True)
    v: Real = variable("1/s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield (2 + self.x**2) * der(self.v) + (2 + self.x**2) * self.w**2 * self.x == 0 * self.w**2


class Explosion(Component):
    """T x' = x^2: infinite at t = T."""

    T: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.x**2


def engine(model: Component, rtol: float = 1e-8) -> tuple[Any, Straight]:
    dae = translate(model, compile="always").dae
    found = Straight.of(dae, np.zeros(0), SolverOptions(rtol=rtol))
    assert found is not None
    return dae, found


def test_an_oscillator_is_its_closed_form() -> None:
    dae, straight = engine(Oscillator())
    w, t = np.array([1.0, 2.0, 5.0]), np.linspace(0.1, 3.0, 30)
    p = np.array([dae.parameter_vector({"w": value}) for value in w.tolist()])
    done = straight.run(p, 0.0, t, np.tile([1.0, 0.0], (3, 1)))
    assert not done.failed.any()
    np.testing.assert_allclose(done.y[:, :, 0], np.cos(np.outer(w, t)), atol=2e-6)
    np.testing.assert_allclose(done.y[:, :, 1], -w[:, None] * np.sin(np.outer(w, t)), atol=1e-5)
    np.testing.assert_allclose(done.yp0, np.column_stack([np.zeros(3), -(w**2)]), rtol=1e-12)


def test_each_run_is_independent_of_the_others() -> None:
    dae, straight = engine(DCMotor(), 1e-6)
    p = np.array([dae.parameter_vector({"rotor.J": value}) for value in (1e-3, 2e-3, 5e-3)])
    y, t = np.zeros((3, dae.n)), np.array([1.0, 5.0])
    together = straight.run(p, 0.0, t, y)
    for k in (2, 0, 1):
        alone = straight.run(p[[k]], 0.0, t, y[[k]])
        np.testing.assert_array_equal(alone.y[0], together.y[k])
        np.testing.assert_array_equal(alone.counts[0], together.counts[k])


def test_what_fails_is_told_and_ends_nothing() -> None:
    dae, straight = engine(Explosion())
    p = np.array([dae.parameter_vector({"T": value}) for value in (0.5, 4.0)])
    done = straight.run(p, 0.0, np.array([1.0]), np.ones((2, 1)))
    assert done.failed.tolist() == [True, False]
    assert done.y[1, 0, 0] == pytest.approx(1 / (1 - 0.25), rel=1e-6)


def test_what_has_events_does_not_fit() -> None:
    dae = translate(BouncingBall(), compile="always").dae
    assert not fits(dae)
    assert Straight.of(dae, np.zeros(0), SolverOptions()) is None


def test_without_machine_code_there_is_none() -> None:
    dae = translate(Oscillator(), compile="never").dae
    assert fits(dae)
    assert Straight.of(dae, np.zeros(0), SolverOptions()) is None
