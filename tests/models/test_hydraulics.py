"""The power unit and twelve actuators, each with an inertia in place of the robot."""

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
    UsageError,
    connect,
    parameter,
    real_output,
    start,
    time,
    translate,
)
from arthur_acausal.components.rotational import Fixed as FixedShaft
from arthur_acausal.components.rotational import Inertia, SpringDamper
from arthur_acausal.models.arthur.dimensions import Dimensions
from arthur_acausal.models.arthur.hydraulics import Hydraulics
from arthur_acausal.models.arthur.quadruped_options import QuadrupedOptions, options_of


class Wave(Component):
    """A force that swings 1.6 times a second, from rest."""

    y: Real = real_output("N")
    F: Real = parameter("N")
    f: Real = parameter("Hz", default=1.6)

    def equations(self) -> Equations:
        yield self.y == self.F * (1 - cos(2 * pi * self.f * time()))


class Sprung(Hydraulics):
    """Each joint turns an inertia that a spring holds where the robot stands."""

    def build(self) -> None:
        super().build()
        pose = Dimensions().stand * 4
        self.inertias = [Inertia(J=0.012, phi=start(a, fixed=True), w=start(0.0, fixed=True)) for a in pose]
        self.springs = [SpringDamper(c=30.0, d=0.3) for _ in pose]
        self.grounds = [FixedShaft(phi0=a) for a in pose]
        self.waves = [Wave(F=100.0 if i // 3 in (0, 3) else -50.0) for i in range(len(pose))]

    def equations(self) -> Equations:
        yield from super().equations()
        parts = zip(self.actuators, self.inertias, self.springs, self.grounds, self.waves, strict=True)
        for actuator, inertia, spring, ground, wave in parts:
            yield connect(actuator.joint, inertia.flange_a)
            yield connect(inertia.flange_b, spring.flange_b)
            yield connect(spring.flange_a, ground.flange)
            yield connect(wave.y, actuator.F_d)


@cache
def sprung() -> Solution:
    return translate(Sprung()).simulate(1.0, tolerance=1e-5)


def signals(solution: Solution, name: str) -> np.ndarray:
    """Return a signal of the twelve actuators, (12, nt)."""
    return np.array([solution[f"actuators[{i}].{name}"] for i in range(12)])


def test_unknowns() -> None:
    """Six of an actuator and two of its joint; seven of the unit; current and filter are implicit."""
    assert sprung().statistics.unknowns == 12 * 8 + 7 + 2


def test_all_forces_follow() -> None:
    error, demand = signals(sprung(), "control.e"), signals(sprung(), "F_d")
    assert np.sqrt(np.mean(error**2) / np.mean(demand**2)) < 0.1
    assert signals(sprung(), "cylinder.p_A").min() > 0 < signals(sprung(), "cylinder.p_B").min()


def test_the_unit_follows_the_flow() -> None:
    run = sprung()
    assert np.abs(run["unit.manifold.p"] / 1e5 - 135).max() < 6
    taken = sum(run[f"actuators[{i}].valve.port_p.q"] for i in range(12))
    assert run["unit.filter.q"] == pytest.approx(taken, abs=1e-9)


def test_mass_of_the_fluid_is_conserved() -> None:
    """What leaves the reservoir is in the manifold and the chambers."""
    run = sprung()
    mass = (
        run["unit.manifold.m_fluid"] + run["unit.reservoir.m_fluid"] + signals(run, "cylinder.m_fluid").sum(0)
    )
    assert np.ptp(mass) < 1e-5 * mass[0]
    assert np.ptp(run["unit.reservoir.m_fluid"]) > 1e-3 * mass[0]


@pytest.mark.parametrize("variant", ["default", "no accumulator"])
def test_energy_is_conserved(variant: str) -> None:
    """From the battery's chemistry to the joints, each loss by its own law."""
    run = translate(Sprung(audit=True, options=options_of(variant))).simulate(0.5, tolerance=1e-5)
    energy = run.energy()
    assert energy.input_J > 100.0
    assert abs(energy.closure) < 3e-4
    assert energy.losses_J["valves"] > 30.0


def test_an_unknown_variant_is_refused() -> None:
    assert options_of("report").p_relief == 20.68e6
    assert options_of("default") == QuadrupedOptions()
    with pytest.raises(UsageError, match="no variant 'fast'"):
        options_of("fast")
