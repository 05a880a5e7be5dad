"""Runs over several sets of states: the Cartesian pendulum against the elliptic closed form and its invariants."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ellipj, ellipk

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SolverOptions,
    Translation,
    der,
    parameter,
    translate,
    variable,
)

G = 9.81


class Pendulum(Component):
    """A point mass on a massless rod, in Cartesian coordinates: index 3."""

    L: Real = parameter("m", default=1.0)
    g: Real = parameter("m/s^2", default=G)
    x: Real = variable("m", start=0.0)
    y: Real = variable("m", start=-1.0)
    vx: Real = variable("m/s", start=0.0, fixed=True)
    vy: Real = variable("m/s")
    pull: Real = variable("1/s^2", description="Force of the rod over mass and length.")

    def equations(self) -> Equations:
        yield der(self.x) == self.vx
        yield der(self.y) == self.vy
        yield der(self.vx) == -self.pull * self.x
        yield der(self.vy) == -self.pull * self.y - self.g
        yield "rod", self.x**2 + self.y**2 == self.L**2


@pytest.fixture(scope="module")
def pendulum() -> Translation:
    return translate(Pendulum())


def angle(t: float, theta_0: float) -> float:
    """The pendulum's angle [rad] after ``t`` [s] from rest: 2 asin(k sn(K + w t, k)), k = sin(theta_0/2)."""
    k = np.sin(theta_0 / 2)
    sn = ellipj(ellipk(k**2) + np.sqrt(G) * t, k**2)[0]
    return float(2 * np.arcsin(k * sn))


@pytest.mark.parametrize("degrees", [7.5, 82.5, 127.5, 172.5, 352.5])
def test_pendulum_keeps_length_and_energy_from_any_angle(pendulum: Translation, degrees: float) -> None:
    theta = np.radians(degrees)
    solution = pendulum.simulate(
        10.0,
        options=SolverOptions(rtol=1e-10),
        start={"x": np.sin(theta), "y": -np.cos(theta)},
    )
    x, y, vx, vy = (solution[p] for p in ("x", "y", "vx", "vy"))
    assert np.max(np.abs(np.hypot(x, y) - 1.0)) <= 1e-12
    energy = 0.5 * (vx**2 + vy**2) + G * y
    assert np.max(np.abs(energy - energy[0])) <= 3e-7 * (G + abs(energy[0]))
    start = theta if theta <= np.pi else theta - 2 * np.pi
    assert np.arctan2(x[-1], -y[-1]) == pytest.approx(angle(10.0, start), abs=1e-6)
    assert pendulum.verify(solution).largest < 1e-9


def test_rotations_change_the_set_of_states_and_tell_so(pendulum: Translation) -> None:
    solution = pendulum.simulate(
        3.0, options=SolverOptions(rtol=1e-8), start={"x": 0.0, "y": -1.0, "vx": 8.0}
    )
    turned = np.unwrap(np.arctan2(solution["x"], -solution["y"]))
    assert turned[-1] > 2 * np.pi
    assert any("changes of the set of states" in m for m in solution.statistics.messages)
    assert solution.t[-1] == 3.0
    assert not solution.events  # a change of states is no event of the model
    assert np.all(np.diff(solution.t) >= 0.0)


def test_a_run_begins_at_rest_below(pendulum: Translation) -> None:
    solution = pendulum.simulate(1.0, start={"x": 0.3, "y": -0.95}, steady=True)
    assert np.max(np.abs(solution["x"])) < 1e-9
    assert solution["y"] == pytest.approx(-1.0, rel=1e-12)
    assert solution["pull"] == pytest.approx(G, rel=1e-9)
