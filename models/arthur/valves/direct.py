"""Servo valves that a drive moves directly, in the place of the ideal one: rotary, or a spool behind a lever."""

from __future__ import annotations

from math import pi
from typing import Literal

from casadi import SX, fabs, fmax, fmin, sqrt

from arthur_acausal import (
    Component,
    Equations,
    Real,
    connect,
    der,
    parameter,
    real_input,
    real_output,
    variable,
)
from arthur_acausal.components.hydraulic import Fluid, HydraulicPort, RotaryValve, ServoValve, SpoolValve
from arthur_acausal.components.rotational import Flange, IdealGearR2T

ValveKind = Literal["ideal", "rotary", "spool"]
"""``ideal``: `ServoValve`; else the valve of the report's case study on its drive."""


class ValveDrive(Component):
    """A drive that turns a valve's shaft as a current asks, whatever the load.

    I/I_rated, within +-1, is the share of the rated flow. The electronics know the port: at the ``opening`` [1] a
    sharp square orifice (3.32 to 3.41, C_d squared) passes that share; ``gain`` is the opening for the rated flow,
    were the port small. They jump over the ``overlap`` [rad], rounded below ``share_small``; ``width`` [rad] is the
    port's.

    The response is of second order, with ``f`` [Hz] and ``zeta``, as in a servo valve's data sheet, the speed within
    ``w_max``: what takes the case study's valve through its stroke in 3 ms (3.19). ``P`` [W] is the mechanical power
    that the valve takes, ``P_copper`` what the windings of a motor of the constant ``k_m`` need for the torque, even
    while they only hold it. The rotor's inertia is left out, as in 3.5. All values are assumed.
    """

    flange = Flange()
    I: Real = real_input("A", default=0.0, nominal=0.1)
    I_rated: Real = parameter("A", default=1.0, min=0.0)
    gain: Real = parameter("1", min=0.0)
    overlap: Real = parameter("rad", min=0.0)
    width: Real = parameter("rad", min=0.0)
    share_small: Real = parameter("1", default=0.01, min=0.0)
    f: Real = parameter("Hz", default=250.0, min=0.0, description="natural frequency")
    zeta: Real = parameter("1", default=0.7, min=0.0, description="damping ratio")
    w_max: Real = parameter("rad/s", default=140.0, min=0.0)
    k_m: Real = parameter("N*m/W^0.5", default=0.01, min=0.0, description="motor constant")
    opening: Real = variable("1", start=0.0, nominal=0.1, description="asked for, over the port's width")
    wanted: Real = variable("rad", nominal=0.1)
    phi: Real = variable("rad", start=0.0, fixed=True, nominal=0.1)
    w: Real = variable("rad/s", start=0.0, fixed=True, nominal=10.0)
    P: Real = variable("W", nominal=0.1, description="given to the valve")
    P_copper: Real = variable("W", nominal=0.1, description="of the windings")

    def equations(self) -> Equations:
        share = fmin(fmax(self.I / self.I_rated, -1), 1)
        wide = 2 * fabs(self.opening) / (1 + fabs(self.opening))
        yield "flow as asked", self.opening == share * self.gain * sqrt(1 - wide**4)
        jump = self.overlap * share / sqrt(share**2 + self.share_small**2)
        yield self.wanted == jump + self.width * self.opening
        yield self.phi == self.flange.phi
        yield self.w == der(self.phi)
        omega = 2 * pi * self.f
        speed = omega / (2 * self.zeta) * (self.wanted - self.phi)
        limited = fmin(fmax(speed, -self.w_max), self.w_max)
        yield "drive", der(self.w) == 2 * self.zeta * omega * (limited - self.w)
        yield self.P == -self.flange.tau * self.w
        yield self.P_copper == (self.flange.tau / self.k_m) ** 2


class DirectValve(Component):
    """What directly driven valves share: the ports, the input ``I`` [A] and the flow gain ``K_V`` of `ServoValve`.

    ``P_loss`` [W] is the fluid's; for what the drive takes see `ValveDrive`.
    """

    port_p = HydraulicPort()
    port_t = HydraulicPort()
    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    I: Real = real_input("A", default=0.0, nominal=0.1, description="positive extends (P to A)")
    I_rated: Real = parameter("A", default=1.0, min=0.0, description="assumed")
    q_rated: Real = parameter("m^3/s", default=2e-3 / 60, min=0.0, display="L/min", description="assumed")
    dp_rated: Real = parameter("Pa", default=70e5, min=0.0, display="bar", description="both ways; assumed")
    K_V: Real = parameter(
        "m^2/A",
        default=lambda self: self.q_rated / (self.I_rated * sqrt(self.dp_rated / self.fluid.rho)),
        description="valve gain of eq. 5.35",
    )
    P_loss: Real = real_output("W", description="power turned to heat in the ports and lines")

    def driven(self, valve: RotaryValve | SpoolValve, orifices: int, overlap: SX, arm: SX) -> ValveDrive:
        """Return the drive of a valve with so many orifices on each way; ``arm`` [m] at which it moves the port."""
        sharp = valve.area(SX(1)) * valve.C_d * sqrt(self.dp_rated / (orifices * self.fluid.rho))
        return ValveDrive(
            I_rated=self.I_rated, gain=self.q_rated / sharp, overlap=overlap, width=valve.d_p / arm
        )

    def between_ports(self, valve: RotaryValve | SpoolValve, drive: ValveDrive) -> Equations:
        """Yield the connections of a valve and its drive, but for the flange."""
        yield connect(self.port_p, valve.port_p)
        yield connect(self.port_t, valve.port_t)
        yield connect(self.port_a, valve.port_a)
        yield connect(self.port_b, valve.port_b)
        yield connect(self.P_loss, valve.P_loss)
        yield connect(self.I, drive.I)


class RotaryServoValve(DirectValve):
    """A `RotaryValve` on a `ValveDrive`: see `DirectValve`."""

    valve: RotaryValve = RotaryValve(w_small=0.1, u_small=4.0)

    def build(self) -> None:
        self.drive = self.driven(self.valve, 2, self.valve.overlap(), self.valve.r_c)

    def equations(self) -> Equations:
        yield from self.between_ports(self.valve, self.drive)
        yield connect(self.drive.flange, self.valve.flange)


class SpoolServoValve(DirectValve):
    """A `SpoolValve` on a `ValveDrive` by a ``lever`` [m], as long as the rotary one's radius: see `DirectValve`."""

    valve: SpoolValve = SpoolValve(u_small=4.0)
    lever: Real = parameter("m", default=3.81e-3, min=0.0, description="assumed")

    def build(self) -> None:
        self.drive = self.driven(self.valve, 1, self.valve.L_OL / self.lever, self.lever)
        self.rack = IdealGearR2T(ratio=1 / self.lever)

    def equations(self) -> Equations:
        yield from self.between_ports(self.valve, self.drive)
        yield connect(self.drive.flange, self.rack.flange_r)
        yield connect(self.rack.flange_t, self.valve.flange)


DIRECT = {"rotary": RotaryServoValve, "spool": SpoolServoValve}


def servo_valve(kind: ValveKind, ideal: ServoValve) -> ServoValve | DirectValve:
    """Return the valve of a kind: ``ideal`` where it is ideal."""
    return ideal if kind == "ideal" else DIRECT[kind]()
