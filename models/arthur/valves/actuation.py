"""A position loop on the rotary valve: a brushless motor that cogs, and one without steps (section 4.3)."""

from __future__ import annotations

from math import floor, pi
from typing import Literal

import numpy as np
from casadi import fmax, fmin, sin

from arthur_acausal import (
    Component,
    Equations,
    Real,
    Solution,
    connect,
    der,
    if_else,
    parameter,
    time,
    variable,
)
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic import Fluid, Orifice, PressureSource, RotaryValve
from arthur_acausal.components.rotational import Flange
from arthur_acausal.models.arthur.valves.strokes import PSI

Motor = Literal["brushless", "ultrasonic"]
DEG = pi / 180


class PositionDrive(Component):
    """Turns a valve to a set angle that rises by ``step`` [rad] every ``hold`` [s].

    "brushless": J w' = k_p e - k_d w - T_cog sin(n_cog phi) - load, the motor's torque limited to ``tau_max``. With 12
    slots and 14 poles it cogs 84 times a turn: where n_cog T_cog exceeds k_p the rotor comes to rest near the stable
    positions, 4.3 deg apart, so up to half of that from where it should be, the "approximately 2 deg" of figure 4-14.
    "ultrasonic": a friction drive without steps, which no load turns back: its speed follows k e, limited to
    ``w_max``, within ``lag`` [s]. All values are assumed: the report names neither motor.
    """

    motor: Motor = "brushless"
    steps: int = 6
    flange = Flange()
    step: Real = parameter("rad", default=2 * DEG)
    hold: Real = parameter("s", default=0.05, min=0.0)
    J: Real = parameter("kg*m^2", default=1e-6, min=0.0, description="rotor")
    k_p: Real = parameter("N*m/rad", default=0.8, min=0.0)
    k_d: Real = parameter("N*m*s/rad", default=2.5e-3, min=0.0)
    T_cog: Real = parameter("N*m", default=0.03, min=0.0, description="cogging torque")
    n_cog: Real = parameter("1", default=84.0, min=1.0, description="stable positions a turn")
    tau_max: Real = parameter("N*m", default=0.2, min=0.0)
    k: Real = parameter("1/s", default=200.0, min=0.0, description="gain of the ultrasonic motor's loop")
    w_max: Real = parameter("rad/s", default=30.0, min=0.0)
    lag: Real = parameter("s", default=1e-3, min=0.0)
    wanted: Real = variable("rad")
    phi: Real = variable("rad", start=0.0, fixed=True, nominal=0.1)
    w: Real = variable("rad/s", start=0.0, fixed=True, nominal=10.0)
    tau: Real = variable("N*m", nominal=1e-2, description="given to the valve")
    error: Real = variable("rad", nominal=0.01)

    def build(self) -> None:
        check_choice(self, "motor", Motor)

    def equations(self) -> Equations:
        rises = [if_else(time() >= n * self.hold, 1, 0) for n in range(1, self.steps + 1)]
        yield self.wanted == self.step * sum(rises)
        yield self.phi == self.flange.phi
        yield self.w == der(self.phi)
        yield self.error == self.wanted - self.phi
        yield self.flange.tau == -self.tau
        if self.motor == "brushless":
            pull = fmin(fmax(self.k_p * self.error - self.k_d * self.w, -self.tau_max), self.tau_max)
            cogging = self.T_cog * sin(self.n_cog * self.phi)
            yield "rotor", self.J * der(self.w) == pull - cogging - self.tau
        else:
            wanted = fmin(fmax(self.k * self.error, -self.w_max), self.w_max)
            yield "friction drive", self.lag * der(self.w) == wanted - self.w


class PositionLoop(Component):
    """The case study's rotary valve on its drive, between supply and return; an orifice is the load from A to B."""

    drive: PositionDrive = PositionDrive()
    supply: PressureSource = PressureSource(
        p=2900 * PSI, fluid=Fluid(rho=850.0, nu=22e-6, constant_density=True)
    )
    tank: PressureSource = PressureSource(p=14.5 * PSI)
    valve: RotaryValve = RotaryValve(w_small=0.1)
    load: Orifice = Orifice(area=1e-7)

    def equations(self) -> Equations:
        yield connect(self.drive.flange, self.valve.flange)
        yield connect(self.supply.port, self.valve.port_p)
        yield connect(self.tank.port, self.valve.port_t)
        yield connect(self.valve.port_a, self.load.port_a)
        yield connect(self.load.port_b, self.valve.port_b)


def settled_errors(run: Solution, hold: float = 0.05) -> list[float]:
    """Return the error [deg] at the end of each step of the set angle."""
    ends = np.arange(2, floor(run.t[-1] / hold + 1e-9) + 1) * hold - 1e-3
    return [float(np.interp(end, run.t, run["drive.error"])) / DEG for end in ends]
