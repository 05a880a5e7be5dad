"""A joint driven by its cylinder: the force follows the demand, the work goes where it should."""

from __future__ import annotations

from functools import cache
from math import pi

import numpy as np
import pytest
from casadi import sin

from arthur_acausal import (
    Component,
    Equations,
    Real,
    Solution,
    Translation,
    connect,
    der,
    parameter,
    real_output,
    start,
    time,
    translate,
    variable,
)
from arthur_acausal.components import rotational as rot
from arthur_acausal.components.hydraulic import PressureSource, Tank
from arthur_acausal.models.arthur.actuator import Actuator, ForceLaw
from arthur_acausal.models.arthur.force_control import LAG
from arthur_acausal.models.arthur.linkages import LINKAGES
from arthur_acausal.models.arthur.valves.direct import ValveKind


class Swinging(Component):
    """Asks for the force of a PD law that lets a knee swing by +-0.5 rad twice a second: pistons reach 0.16 m/s."""

    flange = rot.Flange()
    F: Real = real_output("N")
    f: Real = parameter("Hz", default=2.0)
    middle: Real = parameter("rad", default=-pi / 2)
    amplitude: Real = parameter("rad", default=0.5)
    k: Real = parameter("N*m/rad", default=60.0)
    d: Real = parameter("N*m*s/rad", default=1.5)
    arm: Real = parameter("m", default=0.0256)
    phi: Real = variable("rad", description="angle asked for")

    def equations(self) -> Equations:
        yield self.flange.tau == 0
        yield self.phi == self.middle + self.amplitude * sin(2 * pi * self.f * time())
        e, e_rate = self.phi - self.flange.phi, der(self.phi) - der(self.flange.phi)
        yield self.arm * self.F == self.k * e + self.d * e_rate


class Stance(Component):
    """A load that comes and goes twice a second: 0 to 4 N m against extension."""

    flange = rot.Flange()
    f: Real = parameter("Hz", default=2.0)
    tau: Real = parameter("N*m", default=2.0)

    def equations(self) -> Equations:
        yield self.flange.tau == self.tau * (1 + sin(2 * pi * self.f * time()))


class Leg(Component):
    """One joint between a pressure source and a tank."""

    law: ForceLaw = "feed-forward"
    valve: ValveKind = "ideal"
    supply: PressureSource = PressureSource(p=138e5)
    tank: Tank = Tank(p=3e5)
    inertia: rot.Inertia = rot.Inertia(J=0.012, phi=start(-pi / 2, fixed=True), w=start(0.0, fixed=True))
    demand: Swinging = Swinging()
    load: Stance = Stance()

    def build(self) -> None:
        self.act = Actuator(linkage_of=LINKAGES["knee"], law=self.law, valve_kind=self.valve)

    def equations(self) -> Equations:
        yield connect(self.supply.port, self.act.supply)
        yield connect(self.tank.port, self.act.tank)
        yield connect(self.act.joint, self.inertia.flange_a)
        yield connect(self.inertia.flange_b, self.load.flange)
        yield connect(self.act.joint, self.demand.flange)
        yield connect(self.demand.F, self.act.F_d)


@cache
def leg(law: ForceLaw = "feed-forward", valve: ValveKind = "ideal") -> Translation:
    return translate(Leg(law=law, valve=valve))


def tracking(solution: Solution) -> float:
    """Return rms of the error over rms of the demand, after the start."""
    after = solution.t > 0.25
    error, demand = solution["act.control.e"][after], solution["act.F_d"][after]
    return float(np.sqrt(np.mean(error**2) / np.mean(demand**2)))


@pytest.mark.parametrize("J", [0.006, 0.012, 0.05])
def test_force_follows_the_demand_within_a_tenth(J: float) -> None:
    """8 to 80 kg at the piston, as the links of a leg reflect."""
    run = leg().simulate(1.0, tolerance=1e-5, parameters={"inertia.J": J})
    assert np.abs(run["act.cylinder.v"]).max() > 0.15
    assert tracking(run) < 0.06
    assert run["act.cylinder.p_A"].min() > 0 < run["act.cylinder.p_B"].min()


def test_force_control_alone_does_not_follow() -> None:
    """The chambers' stiffness times the piston's velocity is a disturbance that the bare PID cannot keep up with."""
    assert tracking(leg("bare").simulate(1.0, tolerance=1e-5)) > 0.5


@pytest.mark.parametrize("valve", ["rotary", "spool"])
def test_force_follows_with_a_driven_valve(valve: ValveKind) -> None:
    """Within a tenth, as the overlap costs; the drive's energy is the work on the valve's loads."""
    run, ideal = leg(valve=valve).simulate(1.0, tolerance=1e-4), leg().simulate(1.0, tolerance=1e-4)
    assert np.abs(run["act.cylinder.v"]).max() > 0.15
    assert tracking(ideal) < tracking(run) < 0.1
    assert np.interp(ideal.t, run.t, run["inertia.phi"]) == pytest.approx(ideal["inertia.phi"], abs=5e-3)
    torque, w = -run["act.valve.drive.flange.tau"], run["act.valve.drive.w"]
    assert run["act.valve.drive.P"] == pytest.approx(torque * w, abs=1e-12)
    assert 1e-5 < run["act.valve.drive.P"].mean() < 1e-2
    assert np.abs(torque).max() < 1e-2


def test_states_of_one_actuator() -> None:
    """Pressures, spool, integral and lead: the piston's motion is the joint's."""
    states = {path for path in leg().report.states if path.startswith("act.")}
    expected = {"valve.x", "valve.v", "cylinder.p_A", "cylinder.p_B", "control.x", "control.u_lag"}
    assert states == {f"act.{name}" for name in expected}
    assert leg().report.torn == []


def test_work_of_the_cylinder_is_work_of_the_joint() -> None:
    run = leg().simulate(0.5, tolerance=1e-6)
    at_piston = run["act.load_cell.f"] * run["act.cylinder.v"]
    at_joint = run["act.linkage.tau"] * run["inertia.w"]
    assert at_piston == pytest.approx(at_joint, abs=1e-8 * np.abs(at_piston).max())


def test_the_inverse_valve_law_keeps_the_force() -> None:
    """With u_lead = v the chambers, of equal ratios of volume and area, feel no change of force: by the flows.

    Each chamber stiffens with A^2/V, so F' is in proportion to (Q_A/A_A - v) A_A + (Q_B/A_B - v) A_B.
    """
    control, valve, cylinder = "act.control.", "act.valve.", "act.cylinder."
    run = leg().simulate(0.4, tolerance=1e-6)
    rho, K_V = run.final("act.fluid.rho"), run.final(valve + "K_V")
    A_A, A_B = run.final(cylinder + "A_A"), run.final(cylinder + "A_B")
    p = {name: run[control + f"p_{name}"] for name in "stAB"}
    u, I = run[control + "u_lead"], run[control + "I"]
    extends = u > 0
    root_A = np.sqrt(np.where(extends, p["s"] - p["A"], p["A"] - p["t"]))
    root_B = np.sqrt(np.where(extends, p["B"] - p["t"], p["s"] - p["B"]))
    flow = K_V * I * np.sqrt(2 / rho)
    change = (flow * root_A / A_A - u) * A_A + (flow * root_B / A_B - u) * A_B
    assert np.abs(change).max() < 0.01 * (A_A + A_B) * np.abs(u).max()


def test_the_lead_makes_the_force_loop_faster_and_better_damped() -> None:
    """The loop's oscillation, by the eigenvalues of the linearised joint: from 210 Hz to above 300 Hz."""

    def oscillation(**parameters: float) -> complex:
        run = leg().simulate(0.15, tolerance=1e-5, parameters=parameters)
        values = np.linalg.eigvals(leg().linearize(run).A)
        return complex(max(values[values.imag > 0], key=abs))

    plain, ahead = oscillation(**{"act.control.T_lead": LAG}), oscillation()
    assert abs(ahead) > 1.3 * abs(plain)
    assert -ahead.real / abs(ahead) > 0.25 > 0.2 > -plain.real / abs(plain)
