"""Linearisation against closed forms and scipy.signal."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from casadi import sin
from scipy import signal

from arthur_acausal import (
    Component,
    Equations,
    Real,
    StructureError,
    UsageError,
    der,
    parameter,
    translate,
    variable,
)
from arthur_acausal.analysis.bode import bode, frequencies
from arthur_acausal.analysis.linearize import linearize
from arthur_acausal.models.examples.rc_ladder import RCLadder
from arthur_acausal.solve.simulate import initial_point
from tests.analysis.systems import LowPass, Oscillator


def test_oscillator_in_closed_form() -> None:
    m, d, k = 2.0, 3.0, 50.0
    linear = translate(Oscillator()).linearize(outputs=["x", "a"])
    assert linear.states == ["x", "v"] and linear.inputs == ["f"]
    np.testing.assert_allclose(linear.A, [[0.0, 1.0], [-k / m, -d / m]], rtol=1e-14)
    np.testing.assert_allclose(linear.B, [[0.0], [1.0 / m]], rtol=1e-14)
    np.testing.assert_allclose(linear.C, [[1.0, 0.0], [-k / m, -d / m]], rtol=1e-14)
    np.testing.assert_allclose(linear.D, [[0.0], [1.0 / m]], rtol=1e-14)


def test_modes_of_the_oscillator() -> None:
    (mode,) = translate(Oscillator()).linearize().modes()
    omega, zeta = (50.0 / 2.0) ** 0.5, 3.0 / (2.0 * (50.0 * 2.0) ** 0.5)
    assert mode.frequency == pytest.approx(omega / (2.0 * np.pi), rel=1e-12)
    assert mode.damping == pytest.approx(zeta, rel=1e-12)
    assert mode.eigenvalue == pytest.approx(complex(-zeta * omega, omega * (1.0 - zeta**2) ** 0.5), rel=1e-12)
    assert mode.participation == pytest.approx({"x": 0.5, "v": 0.5}, rel=1e-9)


@pytest.mark.filterwarnings("ignore::scipy.signal.BadCoefficients")  # it goes by way of polynomials
def test_response_is_that_of_scipy() -> None:
    linear = translate(Oscillator()).linearize(outputs=["x", "a"])
    f = np.geomspace(1e-2, 1e2, 50)
    for row in range(2):
        _, expected = signal.freqresp(
            (linear.A, linear.B, linear.C[row : row + 1], linear.D[row]), 2 * np.pi * f
        )
        np.testing.assert_allclose(linear.response(f)[:, row, 0], expected, rtol=1e-10)


def test_low_pass_and_its_algebraic_current() -> None:
    linear = translate(LowPass()).linearize(outputs=["v", "i"])
    f = np.array([10.0, 159.0, 1e4])
    s = 2j * np.pi * f
    np.testing.assert_allclose(linear.response(f)[:, 0, 0], 1.0 / (1.0 + s * 1e-3), rtol=1e-12)
    np.testing.assert_allclose(linear.response(f)[:, 1, 0], 1e-6 * s / (1.0 + s * 1e-3), rtol=1e-10)


def test_ladder_has_the_eigenvalues_of_its_tridiagonal_matrix() -> None:
    translation = translate(RCLadder(n=8))
    p = {
        i.path: v
        for i, v in zip(translation.dae.parameters.infos, translation.dae.parameter_vector(), strict=False)
    }
    rc = p["R"] * p["C"] if "R" in p else p["resistors[0].R"] * p["capacitors[0].C"]
    linear = translation.linearize()
    # R C v_k' = v_(k-1) - 2 v_k + v_(k+1), the last one open: -4 sin^2((2 k - 1) pi / (2 (2 n + 1)))
    k = np.arange(1, 9)
    expected = -4.0 * np.sin((2 * k - 1) * np.pi / (2 * 17)) ** 2 / rc
    np.testing.assert_allclose(np.sort(linear.eigenvalues().real), np.sort(expected), rtol=1e-9)


def test_step_response_follows_the_linear_model() -> None:
    translation = translate(Oscillator())
    rest = translation.linearize(translation.steady_state())
    x_0 = rest.state_values[0]
    run = translation.simulate(2.0, tolerance=1e-9, start={"x": x_0 + 1e-3})
    system = signal.StateSpace(rest.A, rest.B, rest.C, rest.D)
    _, y, _ = signal.lsim(system, np.zeros_like(run.t), run.t, X0=[1e-3, 0.0])
    np.testing.assert_allclose(run["x"] - x_0, np.asarray(y)[:, 0], atol=1e-9)


def test_a_time_is_chosen() -> None:
    translation = translate(Pendulum())
    run = translation.simulate(1.0)
    linear = translation.linearize(run, at=0.5)
    angle = float(run.at(linear.t, "phi"))
    assert linear.t == pytest.approx(0.5, abs=2e-3)
    assert linear.A[1, 0] == pytest.approx(-np.cos(angle), rel=1e-9)
    with pytest.raises(UsageError, match=r"t = 3 s is outside of the run, 0 to 1 s"):
        translation.linearize(run, at=3.0)


def test_a_stored_solution_is_refused(tmp_path: Path) -> None:
    translation = translate(Oscillator())
    run = translation.simulate(0.1)
    run.save(tmp_path / "run.nc")
    with pytest.raises(UsageError, match="read from a file"):
        translation.linearize(type(run).load(tmp_path / "run.nc"))


def test_a_singular_point_is_refused() -> None:
    dae = translate(Root()).dae
    point = initial_point(dae, stop_time=1.0)
    with pytest.raises(StructureError, match="cannot be linearised at t = 0 s"):
        linearize(dae, replace(point, y=0.0 * point.y, yp=0.0 * point.yp))


def test_bode_plot_shows_every_mode() -> None:
    linear = translate(Oscillator()).linearize(outputs=["x"])
    f = frequencies(linear)
    resonance = linear.modes()[0].frequency
    assert f[0] < resonance / 10.0 and f[-1] > 10.0 * resonance
    gain, phase = bode(linear).axes
    curve = np.asarray(gain.lines[0].get_ydata())
    assert curve[0] == pytest.approx(20.0 * np.log10(1.0 / 50.0), abs=0.02)  # 1 / k
    assert np.asarray(phase.lines[0].get_ydata())[-1] == pytest.approx(-180.0, abs=2.0)
    with pytest.raises(UsageError, match="no external input"):
        bode(translate(RCLadder(n=2)).linearize())


class Pendulum(Component):
    """phi'' = -(g / l) sin(phi)."""

    g_l: Real = parameter("1/s^2", default=1.0)
    phi: Real = variable("1", start=1.0, fixed=True)
    w: Real = variable("1/s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.w == der(self.phi)
        yield der(self.w) == -self.g_l * sin(self.phi)


class Root(Component):
    """x' = z with z^2 = x: at x = 0, dz/dx is infinite."""

    x: Real = variable("1", start=1.0, fixed=True)
    z: Real = variable("1", start=1.0)
    rate: Real = parameter("1/s", default=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == self.rate * self.z
        yield self.z**2 == self.x
