"""Check valves that are opened from outside, and valves that pressures steer, without mass."""

from __future__ import annotations

from casadi import SX, fmax, sqrt

from arthur_acausal import Component, Equations, Real, if_else, parameter, real_input, real_output, variable
from arthur_acausal.components.hydraulic.check_valve import CheckValve
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.laws import clamp, turbulent_root
from arthur_acausal.components.hydraulic.ports import HydraulicPort
from arthur_acausal.components.hydraulic.two_port import TwoPort


class PilotCheckValve(CheckValve):
    """A check valve that the pressure at ``port_x`` opens against its spring and its load.

    It opens by the greater of dp = p_a - p_b and p_x - p_b - dp/``ratio`` (the pilot's lead over port_b less the load
    over the pilot's area ratio, as in the default library of Hopsan), from ``dp_crack`` to ``dp_open`` [Pa]; open, it
    passes either way. The pilot takes no flow.
    """

    port_x = HydraulicPort()
    ratio: Real = parameter("1", default=3.5, min=0.0, description="pilot area over seat area")

    def lift(self) -> SX:
        return fmax(self.dp, self.port_x.p - self.port_b.p - self.dp / self.ratio)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port_x.q == 0


class SwitchedCheckValve(CheckValve):
    """A check valve that is an open passage of the area ``A_held`` [m^2] while the signal ``hold`` is above 0.5."""

    hold: Real = real_input("1", default=0.0)
    A_held: Real = parameter("m^2", min=0.0, description="area while held open")

    def area(self) -> SX:
        return if_else(self.hold > 0.5, self.A_held, super().area())


class PressureSteered(TwoPort):
    """An orifice from port_a to port_b of the area ``A_max`` [m^2], opened from 0 to 1 by a pressure.

    ``p_set`` [Pa] and the range ``dp_range`` [Pa] of the spring; ``C_d`` [1]; linear below about ``dp_small`` [Pa].
    """

    A_max: Real = parameter("m^2", min=0.0)
    p_set: Real = parameter("Pa", display="bar")
    dp_range: Real = parameter("Pa", default=5e5, min=1.0, display="bar", description="from closed to open")
    C_d: Real = parameter("1", default=0.7, min=0.0)
    dp_small: Real = parameter("Pa", default=1e3, min=0.0)
    opening: Real = variable("1", description="0 (closed) to 1 (fully open)")

    def excess(self) -> SX:
        """Return the pressure [Pa] that opens the valve, less the set pressure."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.opening == clamp(self.excess() / self.dp_range, 0, 1)
        gain = self.C_d * self.A_max * self.opening * sqrt(2 / self.fluid.rho)
        yield "orifice law", self.q == gain * turbulent_root(self.dp, self.dp_small)


class PressureReducingValve(PressureSteered):
    """Closes as the pressure at port_b rises to ``p_set`` [Pa]; fully open ``dp_range`` below (Merritt 1967, ch. 9)."""

    def excess(self) -> SX:
        return self.p_set - self.port_b.p


class SequenceValve(PressureSteered):
    """Opens as the pressure at port_a passes ``p_set`` [Pa]; fully open ``dp_range`` above (Merritt 1967, ch. 9)."""

    def excess(self) -> SX:
        return self.port_a.p - self.p_set


class CounterbalanceValve(PressureSteered):
    """Lets a load down: opens as p_a + ``ratio`` p_x - (1 + ratio) p_b passes ``p_set`` [Pa] (over-centre valve).

    port_a is the load's side, port_b the return, ``port_x`` the pilot that lowers the load, which takes no flow. For
    free flow to the load put a ``CheckValve`` beside it. ``vented`` (structural): the spring chamber is at zero
    pressure, so that the back pressure p_b does not count.
    """

    vented: bool = False
    port_x = HydraulicPort()
    ratio: Real = parameter("1", default=4.0, min=0.0, description="pilot area over relief area")

    def excess(self) -> SX:
        back = 0 if self.vented else (1 + self.ratio) * self.port_b.p
        return self.port_a.p + self.ratio * self.port_x.p - back - self.p_set

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port_x.q == 0


class ShuttleValve(Component):
    """Joins ``port_c`` to the one of ``port_a`` and ``port_b`` that has the higher pressure.

    The ball's seats share the area ``A_max`` [m^2] and change over within +-``dp_switch`` [Pa]; the flow through either
    follows the orifice law (C_d [1], linear below about dp_small [Pa]).
    """

    port_a = HydraulicPort()
    port_b = HydraulicPort()
    port_c = HydraulicPort()
    fluid: Fluid = Fluid()
    A_max: Real = parameter("m^2", min=0.0)
    dp_switch: Real = parameter("Pa", default=1e4, min=1.0)
    C_d: Real = parameter("1", default=0.7, min=0.0)
    dp_small: Real = parameter("Pa", default=1e3, min=0.0)
    share: Real = variable("1", description="1 where port_a is open, 0 where port_b is")
    P_loss: Real = real_output("W", description="power turned to heat")

    def equations(self) -> Equations:
        a, b, c = self.port_a, self.port_b, self.port_c
        yield self.share == clamp(0.5 + (a.p - b.p) / (2 * self.dp_switch), 0, 1)
        gain = self.C_d * self.A_max * sqrt(2 / self.fluid.rho)
        yield "seat a", a.q == gain * self.share * turbulent_root(a.p - c.p, self.dp_small)
        yield "seat b", b.q == gain * (1 - self.share) * turbulent_root(b.p - c.p, self.dp_small)
        yield "mass balance", a.q + b.q + c.q == 0
        loss = self.fluid.throttling_loss
        yield self.P_loss == loss(a.q, a.p, c.p) + loss(b.q, b.p, c.p)
