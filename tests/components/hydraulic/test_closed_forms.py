"""Machines, pistons, pilot valves and lines against closed forms."""

from __future__ import annotations

from math import exp, pi, sqrt

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, connect, start, translate
from arthur_acausal.components import hydraulic as h
from arthur_acausal.components.rotational import Inertia
from arthur_acausal.components.translational import ConstantForce, Mass

OIL = h.Fluid(constant_density=True, rho=870.0, beta=1e9)
PRECISE = SolverOptions(rtol=1e-9, intervals=200)


class Pumping(Component):
    """A pump from a closed volume into another, and back through a resistance."""

    pump: h.SpeedPump = h.SpeedPump(D=6e-5, G_leak=2e-12)
    low: h.Volume = h.Volume(V=1e-3, p=start(1e5, fixed=True), fluid=OIL)
    high: h.Volume = h.Volume(V=1e-3, p=start(1e5, fixed=True))
    back: h.LinearResistance = h.LinearResistance(R=1e9)

    def equations(self) -> Equations:
        yield connect(self.low.port, self.pump.port_a)
        yield connect(self.pump.port_b, self.high.port)
        yield connect(self.high.port, self.back.port_a)
        yield connect(self.back.port_b, self.low.port)


@pytest.mark.parametrize(("w", "setting"), [(10.0, 1.0), (-10.0, 1.0), (10.0, -0.5)])
def test_a_pump_raises_the_pressure_that_its_flow_needs(w: float, setting: float) -> None:
    """dp = D setting w/(2 pi)/(G + G_leak); what is in the two volumes stays the same."""
    solution = translate(Pumping()).simulate(
        1.0, inputs={"pump.w": w, "pump.setting": setting}, options=PRECISE
    )
    dp = 6e-5 * setting * w / (2 * pi) / (1e-9 + 2e-12)
    low, high = solution.final("low.p"), solution.final("high.p")
    assert high - low == pytest.approx(dp, rel=1e-6)
    assert high + low == pytest.approx(2e5, rel=1e-9)


def test_a_pump_that_is_not_fed_draws_no_vacuum() -> None:
    """The suction side is empty, and all the pressure on the other side: 2 bar, though the speed asks for 9.5 bar."""
    solution = translate(Pumping()).simulate(1.0, inputs={"pump.w": 100.0}, options=PRECISE)
    assert 0.0 <= min(solution["low.p"]) < 1e3
    assert solution.final("high.p") == pytest.approx(2e5, rel=5e-3)
    assert 0.0 < solution.final("pump.fill") < 0.3


class Running(Component):
    """A motor between two pressures, which runs up an inertia."""

    supply: h.PressureSource = h.PressureSource(p=2e7, fluid=OIL)
    tank: h.PressureSource = h.PressureSource(p=1e6)
    motor: h.HydraulicMotor = h.HydraulicMotor(D=6e-5, G_leak=1e-12, b=0.1)
    load: Inertia = Inertia(J=0.05, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.supply.port, self.motor.port_a)
        yield connect(self.motor.port_b, self.tank.port)
        yield connect(self.motor.flange, self.load.flange_a)


def test_a_motor_runs_up_and_its_power_balances() -> None:
    """w = tau/b (1 - exp(-b t/J)), tau = D dp/(2 pi); supply = shaft + losses at every moment."""
    solution = translate(Running()).simulate(1.0, options=PRECISE)
    tau = 6e-5 * 1.9e7 / (2 * pi)
    assert solution.final("load.w") == pytest.approx(tau / 0.1 * (1 - exp(-2.0)), rel=1e-6)
    hydraulic = 1.9e7 * solution["motor.q"]
    shaft = -solution["motor.flange.tau"] * solution["motor.w"]
    np.testing.assert_allclose(hydraulic, shaft + solution["motor.P_loss"], rtol=1e-9)


class Lifting(Component):
    """A piston between a pump's flow and a tank lifts a mass against a force."""

    feed: h.FlowSource = h.FlowSource(q=1e-4, fluid=OIL)
    tank: h.Tank = h.Tank(p=2e5)
    piston: h.Piston = h.Piston(A_a=2e-3, A_b=1e-3, G_leak=1e-12)
    mass: Mass = Mass(m=10.0, s=start(0.0, fixed=True))
    force: ConstantForce = ConstantForce(f_constant=-5e3)

    def equations(self) -> Equations:
        yield connect(self.feed.port, self.piston.port_a)
        yield connect(self.piston.port_b, self.tank.port)
        yield connect(self.piston.flange, self.mass.flange)
        yield connect(self.force.flange, self.mass.flange)


def test_a_piston_moves_as_its_flow_says_and_bears_its_load() -> None:
    """p_a A_a = F + p_b A_b at constant speed v = (q - G_leak dp)/A_a."""
    solution = translate(Lifting()).simulate(100.0, options=PRECISE)
    p_a = (5e3 + 2e5 * 1e-3) / 2e-3
    assert solution.final("piston.port_a.p") == pytest.approx(p_a, rel=1e-6)
    assert solution.final("mass.v") == pytest.approx((1e-4 - 1e-12 * (p_a - 2e5)) / 2e-3, rel=1e-6)
    assert solution.final("piston.port_b.q") == pytest.approx(
        -1e-3 * solution.final("mass.v") - 1e-12 * (p_a - 2e5)
    )


class Reduced(Component):
    """A pressure reducing valve that feeds a constant flow."""

    supply: h.PressureSource = h.PressureSource(p=2e7, fluid=OIL)
    valve: h.PressureReducingValve = h.PressureReducingValve(A_max=1e-5, p_set=5e6, dp_range=1e6)
    outlet: h.Volume = h.Volume(V=1e-4, p=start(0.0, fixed=True))
    draw: h.FlowSource = h.FlowSource(q=-2e-4)

    def equations(self) -> Equations:
        yield connect(self.supply.port, self.valve.port_a)
        yield connect(self.valve.port_b, self.outlet.port)
        yield connect(self.outlet.port, self.draw.port)


def test_a_reducing_valve_opens_as_far_as_its_flow_needs() -> None:
    """q = C_d A_max (p_set - p)/dp_range sqrt(2 (p_s - p)/rho), solved here by bisection."""
    low, high, p = 4e6, 5e6, 0.0
    for _ in range(60):
        p = (low + high) / 2
        q = 0.7 * 1e-5 * (5e6 - p) / 1e6 * sqrt(2 * (2e7 - p) / 870.0)
        low, high = (p, high) if q > 2e-4 else (low, p)
    solution = translate(Reduced()).simulate(1.0)
    assert solution.final("valve.port_b.p") == pytest.approx(p, rel=1e-6)


class Pipeline(Component):
    """A line with losses between a pressure and a flow that is drawn from it."""

    supply: h.PressureSource = h.PressureSource(p=1e7, fluid=OIL)
    line: h.WaveLine = h.WaveLine(
        n=20, T=0.01, Z_c=1e9, p_start=1e7, friction=True, R=3e8, wall=True, R_wall=1e8
    )
    draw: h.FlowSource = h.FlowSource(q=-1e-3)

    def equations(self) -> Equations:
        yield connect(self.supply.port, self.line.port_a)
        yield connect(self.line.port_b, self.draw.port)


def test_a_line_with_losses_settles_at_its_resistance() -> None:
    """The drop is at first Z_c q, in the end R q: the wall costs nothing then."""
    solution = translate(Pipeline()).simulate(3.0, options=PRECISE)
    p = solution["line.port_b.p"]
    assert p[0] == pytest.approx(1e7 - 1e9 * 1e-3, rel=1e-6)
    assert p[-1] == pytest.approx(1e7 - 3e8 * 1e-3, rel=1e-4)
    assert solution.final("supply.port.q") == pytest.approx(-1e-3, rel=1e-4)


def test_a_wave_loses_its_share_in_each_transit() -> None:
    """Behind the front that comes back from the source: p_0 + Z_c q (1 - 2 h^2), h = exp(-(R + R_wall)/(2 Z_c))."""
    source = {"line.kappa": 1e6, "line.R_wall": 1e-3}  # the lost part comes back much later
    solution = translate(Pipeline()).simulate(0.03, parameters=source, options=PRECISE)
    h_loss = exp(-3e8 / 2e9)
    expected = 1e7 - 1e9 * 1e-3 * (1 - 2 * h_loss**2)
    assert float(solution.at(0.0205, "line.port_b.p")) == pytest.approx(expected, rel=1e-4)
