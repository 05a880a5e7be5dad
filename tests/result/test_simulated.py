"""Solutions of real models: every variable is there, by its kind, and a stored one is worth as much."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from casadi import sqrt

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SimulationError,
    Solution,
    Table,
    connect,
    der,
    discrete,
    parameter,
    pre,
    real_input,
    real_output,
    reinit,
    simulate,
    translate,
    variable,
    when,
)
from arthur_acausal.models.arthur.powertrain import Powertrain
from arthur_acausal.result.simulated import Interrupted


class Gain(Component):
    """y = -u."""

    u: Real = real_input("m")
    y: Real = real_output("m")

    def equations(self) -> Equations:
        yield self.y == -self.u


class Ball(Component):
    """A ball that bounces on a floor."""

    g: Real = parameter("m/s^2", default=2.0, description="gravity")
    weight: Real = parameter("m/s^2", default=lambda self: 2 * self.g)
    h: Real = variable("m", start=1.0, fixed=True, description="height")
    v: Real = variable("m/s", start=0.0, fixed=True, display="km/h")
    energy: Real = variable("m^2/s^2", description="a mass")
    seen: Real = real_output("m")
    wind: Real = real_input("m/s^2", default=0.0)
    bounces: Real = discrete("1", start=0.0)

    def equations(self) -> Equations:
        yield der(self.h) == self.v
        yield der(self.v) == self.wind - self.g
        yield self.energy == self.g * self.h + self.v**2 / 2
        yield self.seen == self.h
        yield when(self.h <= 0, reinit(self.v, -pre(self.v)), self.bounces == pre(self.bounces) + 1)


class Watched(Component):
    """A ball that bounces, watched by something that turns signs.

    Only the first line of this is kept with a result.
    """

    ball = Ball()
    first = Gain()
    second = Gain()

    def equations(self) -> Equations:
        yield connect(self.ball.seen, self.first.u)
        yield connect(self.first.y, self.second.u)


class Collapse(Component):
    """x = (1 - 1.5 t)^(2/3), which ends at t = 2/3 s with an infinite slope."""

    rate: Real = parameter("1/s", default=1.0)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == -self.rate / sqrt(self.x)


@pytest.fixture(scope="module")
def ball() -> Solution:
    """One bounce, elastic, at t = 1 s."""
    return simulate(Watched(), 1.5, tolerance=1e-9)


def test_kinds_units_and_descriptions(ball: Solution) -> None:
    kinds = {path: variable.kind for path, variable in ball.variables.items()}
    assert kinds["ball.h"] == kinds["ball.v"] == "state"
    assert kinds["first.u"] == kinds["first.y"] == kinds["second.y"] == "alias"
    assert kinds["ball.energy"] == "eliminated"
    assert kinds["ball.bounces"] == "discrete" and kinds["ball.wind"] == "input"
    assert kinds["ball.g"] == kinds["ball.weight"] == "parameter"
    assert ball.unit("ball.energy") == "m^2/s^2" and ball.description("ball.h") == "height"
    assert ball.variable("ball.v").display == "km/h"


def test_every_variable_has_its_value(ball: Solution) -> None:
    np.testing.assert_allclose(ball["ball.energy"], 2.0, rtol=1e-7)
    np.testing.assert_array_equal(ball["first.y"], -ball["ball.h"])
    np.testing.assert_array_equal(ball["second.y"], ball["ball.h"])
    assert ball["ball.weight"].tolist() == [4.0] * ball.t.size
    assert ball.final("ball.bounces") == 1.0


def test_between_output_times_states_and_their_aliases_are_exact(ball: Solution) -> None:
    t = np.array([0.12345, 0.777, 1.2345])
    exact = np.where(t < 1.0, 1.0 - t**2, 2.0 * (t - 1.0) - (t - 1.0) ** 2)
    np.testing.assert_allclose(ball.at(t, "ball.h"), exact, atol=1e-7)
    np.testing.assert_array_equal(ball.at(t, "first.y"), -ball.at(t, "ball.h"))


def test_both_sides_of_the_event(ball: Solution) -> None:
    time = ball.events[0].time
    assert time == pytest.approx(1.0, abs=1e-7)
    assert float(ball.at(time, "ball.v", side="left")) == pytest.approx(-2.0, abs=1e-6)
    assert float(ball.at(time, "ball.v", side="right")) == pytest.approx(2.0, abs=1e-6)
    assert ball.modes.shape == (ball.t.size, 1)


def test_how_it_came_about(ball: Solution) -> None:
    table = Table([0.0, 1.0], [0.0, 1.0], source="gusts.csv")
    run = simulate(
        Watched(), 0.5, parameters={"ball.g": "200 cm/s^2"}, inputs={"ball.wind": table}, start={"ball.h": 3}
    ).run
    assert run.model == "Watched"
    assert run.description == "A ball that bounces, watched by something that turns signs."
    assert (run.parameters, run.inputs, run.start) == (
        {"ball.g": 2.0},
        {"ball.wind": "gusts.csv"},
        {"ball.h": 3},
    )
    assert (run.start_time, run.stop_time, run.status) == (0.0, 0.5, "finished")
    assert ball.statistics.steps > 0 and ball.options.rtol == 1e-9


def test_a_stored_solution_is_worth_as_much(ball: Solution, tmp_path: Path) -> None:
    ball.save(tmp_path / "ball.nc")
    loaded = Solution.load(tmp_path / "ball.nc")
    assert dict(loaded.variables) == dict(ball.variables)
    np.testing.assert_array_equal(loaded.values(ball.paths), ball.values(ball.paths))
    np.testing.assert_array_equal(loaded.modes, ball.modes)
    t = np.linspace(0.0, 1.5, 77)
    for path in ball.paths:
        np.testing.assert_array_equal(loaded.at(t, path), ball.at(t, path))
    assert loaded.statistics.steps == ball.statistics.steps
    assert loaded.events == ball.events


def test_verification_of_a_stored_solution(ball: Solution, tmp_path: Path) -> None:
    ball.save(tmp_path / "ball.nc")
    assert translate(Watched()).verify(Solution.load(tmp_path / "ball.nc")).largest < 1e-12


def test_a_failure_holds_what_was_computed() -> None:
    with pytest.raises(SimulationError) as caught:
        simulate(Collapse(), 1.0)
    solution = caught.value.solution
    assert solution.run.status == "failed" and solution.run.message
    assert 0.6 < solution.t[-1] < 2.0 / 3.0
    np.testing.assert_allclose(solution["x"][:200], (1.0 - 1.5 * solution.t[:200]) ** (2.0 / 3.0), rtol=1e-4)


def test_ctrl_c_holds_what_was_computed() -> None:
    def interrupt(t: float) -> float:
        if t > 0.5:
            raise KeyboardInterrupt
        return 0.0

    with pytest.raises(Interrupted) as caught:
        simulate(Watched(), 1.0, inputs={"ball.wind": interrupt})
    solution = caught.value.solution
    assert solution.run.status == "interrupted"
    assert 0.0 < solution.t[-1] <= 0.5
    np.testing.assert_allclose(solution["ball.h"], 1.0 - solution.t**2, atol=1e-6)


def test_the_energy_audit_of_a_stored_powertrain(tmp_path: Path) -> None:
    solution = simulate(Powertrain(n=1), 0.01, inputs={"motor.V": 20.0})
    solution.save(tmp_path / "x.nc")
    energy = solution.energy()
    assert energy.input_J > 1.0 and abs(energy.closure) < 1e-4
    assert Solution.load(tmp_path / "x.nc").energy() == energy


@pytest.mark.parametrize("audit", [True, False])
@pytest.mark.parametrize("n", [1, 4])
def test_the_powertrains_picture(n: int, audit: bool, tmp_path: Path) -> None:
    model = Powertrain(n=n, audit=audit)
    solution = simulate(model, 0.01, inputs={"motor.V": 20.0})
    figure = model.figure(solution)
    assert [axes.get_ylabel() for axes in figure.axes] == [
        "motor speed [rpm]",
        "pressure [bar]",
        "flow [L/min]",
        "chambers [bar]",
        "power [W]",
    ]
    figure.savefig(tmp_path / "x.png")
