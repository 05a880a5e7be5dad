"""The quadruped's supply: its figures at 5000 rpm, its balance at the start, and the pump's controllers."""

from __future__ import annotations

from functools import cache
from math import pi

import numpy as np
import pytest
from casadi import cos

from arthur_acausal import (
    Component,
    Equations,
    Real,
    Solution,
    connect,
    parameter,
    real_output,
    time,
    translate,
)
from arthur_acausal.components.hydraulic import GPM, HydraulicPort
from arthur_acausal.models.arthur.power_unit import PowerUnit, PumpLaw

RPM = 2 * pi / 60


class Consumer(Component):
    """Takes a flow that swings between 0 and ``q`` [m^3/s] 3.2 times a second, as a trot does."""

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    y: Real = real_output("m^3/s")
    q: Real = parameter("m^3/s", default=0.77 * GPM)
    f: Real = parameter("Hz", default=3.2)

    def equations(self) -> Equations:
        yield self.y == self.q * (1 - cos(2 * pi * self.f * time())) / 2
        yield self.port_a.q == self.y
        yield self.port_a.q + self.port_b.q == 0


class Supplied(Component):
    """The unit and a consumer."""

    law: PumpLaw = "pressure"
    accumulator: bool = True
    consumer: Consumer = Consumer()

    def build(self) -> None:
        self.unit = PowerUnit(law=self.law, accumulator=self.accumulator)

    def equations(self) -> Equations:
        yield connect(self.unit.supply, self.consumer.port_a)
        yield connect(self.unit.tank, self.consumer.port_b)
        yield connect(self.consumer.y, self.unit.q_command)


@cache
def run(law: PumpLaw, accumulator: bool = True) -> Solution:
    return translate(Supplied(law=law, accumulator=accumulator)).simulate(1.0, tolerance=1e-5)


def test_figures_at_5000_rpm() -> None:
    """1.24 gpm delivered with 0.22 gpm of leakage, 2.95 N m, 37.9 A, 39.6 V, 1.84 kW at 140 bar."""
    unit = {name: run("constant speed").initial(f"unit.{name}") for name in ("motor.w", "manifold.p")}
    assert unit["motor.w"] / RPM == pytest.approx(5000, rel=0.01)
    assert unit["manifold.p"] == pytest.approx(140e5, rel=0.005)
    expected = {"pump.q": 1.24 * GPM, "pump.q_leak": 0.22 * GPM, "motor.tau": 2.95, "motor.I": 37.9}
    for name, value in (expected | {"motor.V_t": 39.6, "motor.P_el": 1840.0}).items():
        assert run("constant speed").initial(f"unit.{name}") == pytest.approx(
            value, rel=0.06 if name == "pump.q_leak" else 0.02
        ), name


@pytest.mark.parametrize(
    "law",
    ["constant speed", "pressure", "feed-forward", "foresight", "predictive", "predictive pressure"],
)
def test_it_starts_in_balance(law: PumpLaw) -> None:
    solution = run(law)
    first = solution.t < 2e-3
    for name in ("motor.w", "manifold.p", "reservoir.p"):
        values = solution[f"unit.{name}"][first]
        assert values == pytest.approx(np.full(values.size, values[0]), rel=1e-3), name
    assert solution.initial("unit.reservoir.z") == pytest.approx(0.04, rel=1e-3)


def test_pressure_control_wastes_little_over_the_relief_valve() -> None:
    """It takes less than half of the power; the accumulator bridges its lag."""
    constant, regulated = run("constant speed"), run("pressure")
    assert np.abs(regulated["unit.manifold.p"] / 1e5 - 135).max() < 15
    assert regulated["unit.relief.q"].mean() < 0.1 * constant["unit.relief.q"].mean()
    assert regulated["unit.motor.P_el"].mean() < 0.5 * constant["unit.motor.P_el"].mean()


def test_feed_forward_keeps_the_pressure_nearer() -> None:
    """The flow that is asked for turns the pump before the pressure has fallen."""
    plain, ahead = (np.std(run(law)["unit.manifold.p"]) for law in ("pressure", "feed-forward"))
    assert ahead < 0.4 * plain


def test_without_accumulator_the_supply_sags() -> None:
    """The manifold alone holds 3.5e-15 m^3/Pa: the pump's lag then costs tens of bars."""
    sag = [
        135 - run("feed-forward", accumulator)["unit.manifold.p"].min() / 1e5 for accumulator in (True, False)
    ]
    assert sag[1] > 4 * sag[0]


def test_the_drive_gives_no_more_than_the_bus_has() -> None:
    solution = run("constant speed")
    assert (solution["unit.motor.V_t"] <= solution["unit.drive.V_bus"] + 1e-9).all()
    assert 0 < solution["unit.motor.I"].min() <= solution["unit.motor.I"].max() <= 50
