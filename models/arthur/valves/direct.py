"""The rotary valve with its drive in the place of the ideal servo valve of the powertrain."""

from __future__ import annotations

from casadi import fmax, fmin, sign

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
from arthur_acausal.components.hydraulic import Fluid, HydraulicPort, RotaryValve
from arthur_acausal.components.rotational import Flange
from arthur_acausal.models.arthur.powertrain import Powertrain


class StepFreeDrive(Component):
    """A friction drive (ultrasonic motor) that turns its flange as its current asks: speed k e within w_max and lag.

    I/I_rated, within +-1, is the share of ``stroke`` [rad] beyond ``overlap`` [rad]. ``P`` [W]: the mechanical power
    that it gives. No load turns it back. All values are assumed.
    """

    flange = Flange()
    I: Real = real_input("A", default=0.0, nominal=0.1)
    I_rated: Real = parameter("A", default=1.0, min=0.0)
    overlap: Real = parameter("rad", min=0.0)
    stroke: Real = parameter("rad", min=0.0)
    k: Real = parameter("1/s", default=500.0, min=0.0)
    w_max: Real = parameter("rad/s", default=100.0, min=0.0)
    lag: Real = parameter("s", default=5e-4, min=0.0)
    phi: Real = variable("rad", start=0.0, fixed=True, nominal=0.1)
    w: Real = variable("rad/s", start=0.0, fixed=True, nominal=10.0)
    wanted: Real = variable("rad", nominal=0.1)
    P: Real = variable("W", nominal=0.1, description="given to the valve")

    def equations(self) -> Equations:
        yield self.phi == self.flange.phi
        yield self.w == der(self.phi)
        share = fmin(fmax(self.I / self.I_rated, -1), 1)
        yield self.wanted == sign(share) * self.overlap + share * self.stroke
        speed = fmin(fmax(self.k * (self.wanted - self.phi), -self.w_max), self.w_max)
        yield "friction drive", self.lag * der(self.w) == speed - self.w
        yield self.P == -self.flange.tau * self.w


class RotaryServoValve(Component):
    """A `RotaryValve` on a `StepFreeDrive`, with the ports and the input ``I`` [A] of `ServoValve`.

    ``P_loss`` [W] is the fluid's.
    """

    port_p = HydraulicPort()
    port_t = HydraulicPort()
    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    valve: RotaryValve = RotaryValve(w_small=0.1)
    I: Real = real_input("A", default=0.0, nominal=0.1, description="positive extends (P to A)")
    P_loss: Real = real_output("W", description="power turned to heat in the ports and lines")

    def build(self) -> None:
        valve = self.valve
        self.drive = StepFreeDrive(overlap=valve.overlap(), stroke=valve.d_p / valve.r_c)

    def equations(self) -> Equations:
        valve = self.valve
        yield connect(self.port_p, valve.port_p)
        yield connect(self.port_t, valve.port_t)
        yield connect(self.port_a, valve.port_a)
        yield connect(self.port_b, valve.port_b)
        yield connect(self.drive.flange, valve.flange)
        yield connect(self.P_loss, valve.P_loss)
        yield connect(self.I, self.drive.I)


class DirectPowertrain(Powertrain):
    """The powertrain with rotary valves of the case study in the place of the ideal ones: `RotaryServoValve`."""

    def make_valve(self) -> Component:
        """Return one of the valves."""
        return RotaryServoValve()
