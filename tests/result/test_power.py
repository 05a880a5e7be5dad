"""Power through connectors: Tellegen's theorem over whole models, and the balances of single components."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Equations,
    ResultError,
    Solution,
    SolverOptions,
    connect,
    start,
    translate,
)
from arthur_acausal.components.electrical import Capacitor, ConstantVoltage, Ground, Resistor
from arthur_acausal.components.translational import Damper, Fixed, Mass, Spring
from arthur_acausal.models.arthur.demo import Demo

FINE = SolverOptions(rtol=1e-8, intervals=5000)  # for the trapezoidal rule


class Charging(Component):
    """10 V over 100 ohm onto 1 mF."""

    source = ConstantVoltage(V=10.0)
    resistor = Resistor(R=100.0)
    capacitor = Capacitor(C=1e-3, v=start(0.0, fixed=True))
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.resistor.pin_p)
        yield connect(self.resistor.pin_n, self.capacitor.pin_p)
        yield connect(self.capacitor.pin_n, self.source.pin_n)
        yield connect(self.source.pin_n, self.ground.pin)


class Swinging(Component):
    """A mass between a spring and a damper."""

    wall = Fixed()
    spring = Spring(c=100.0)
    damper = Damper(d=2.0)
    mass = Mass(m=1.0, s=start(0.1, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.spring.flange_a)
        yield connect(self.wall.flange, self.damper.flange_a)
        yield connect(self.spring.flange_b, self.mass.flange)
        yield connect(self.damper.flange_b, self.mass.flange)


def closes(solution: Solution, tolerance: float) -> None:
    """Assert that at every time what all components without parts take by their connectors adds up to nothing."""
    assert solution.powers is not None
    taken = [solution.power_balance(path).total for path in solution.powers.leaves()]
    assert np.max(np.abs(np.sum(taken, axis=0))) < tolerance * np.max(np.abs(taken))


def test_a_capacitor_charges() -> None:
    s = translate(Charging()).simulate(3.0, options=FINE)
    closes(s, 1e-12)
    capacitor = s.power_balance("capacitor")
    assert set(capacitor.powers) == {"capacitor.pin_p", "capacitor.pin_n"}
    assert capacitor.energy == pytest.approx(0.5 * 1e-3 * 10.0**2, rel=1e-4)
    assert s.power_balance("resistor").energy == pytest.approx(0.05, rel=1e-3)  # as much is lost as is stored
    assert s.power_balance("source").energy == pytest.approx(-0.1, rel=1e-3)


def test_a_spring_gives_what_the_damper_takes() -> None:
    s = translate(Swinging()).simulate(15.0, options=FINE)
    closes(s, 1e-9)
    assert np.allclose(s.power("mass.flange"), s["mass.v"] * s["mass.flange.f"], atol=1e-9)
    kinetic = 0.5 * s["mass.v"] ** 2
    power = s.power_balance("mass").total
    gained = np.concatenate([[0.0], np.cumsum(np.diff(s.t) * (power[1:] + power[:-1]) / 2.0)])
    assert np.max(np.abs(gained - kinetic)) < 2e-3 * kinetic.max()
    assert s.power_balance("damper").energy == pytest.approx(0.5 * 100.0 * 0.1**2, rel=1e-3)


def test_the_powertrain_closes() -> None:
    closes(translate(Demo()).simulate(0.2, tolerance=1e-6), 1e-6)


def test_a_solution_out_of_a_file_knows_powers_by_its_model(tmp_path: Path) -> None:
    model = translate(Swinging())
    simulated = model.simulate(1.0)
    simulated.save(tmp_path / "swinging.nc")
    stored = Solution.load(tmp_path / "swinging.nc")
    with pytest.raises(ResultError, match="read from a file") as caught:
        stored.power("mass.flange")
    assert "translate(model).adopt(solution)" in caught.value.remedy
    assert model.adopt(stored) is stored
    for connector in ("mass.flange", "damper.flange_a", "spring.flange_b"):
        assert np.array_equal(stored.power(connector), simulated.power(connector))
    with pytest.raises(ResultError, match="the solution of Swinging is not of this model, Charging"):
        translate(Charging()).adopt(stored)


def test_what_there_is_not() -> None:
    s = translate(Charging()).simulate(0.1)
    with pytest.raises(ResultError, match="there is no connector 'resistor"):
        s.power("resistor.pin")
    with pytest.raises(ResultError, match="there is no component 'resistors'"):
        s.power_balance("resistors")
    assert s.power_balance().energies == {}
