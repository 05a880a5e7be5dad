"""Filters."""

from __future__ import annotations

from casadi import SX

from arthur_acausal import Equations, Real, parameter, real_input, variable
from arthur_acausal.components.hydraulic.two_port import TwoPort


class Filter(TwoPort):
    """A constant hydraulic resistance: p_d = p_s + q R_hf (ARTHuR report, eq. 6.1).

    The report does not give R_hf; 1e9 Pa s/m^3 (0.6 bar at 1 gpm) is assumed.
    """

    R_hf: Real = parameter("Pa*s/m^3", default=1e9, min=0.0, description="hydraulic resistance; assumed")
    p_s: Real = variable(
        "Pa", start=1e5, nominal=1e7, display="bar", description="pressure behind the filter"
    )

    def through(self) -> SX:
        """Return the flow [m^3/s] that makes the pressure drop."""
        return self.q

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p_s == self.port_b.p
        yield "linear resistance", self.dp == self.R_hf * self.through()


class SignalFilter(Filter):
    """A filter whose pressure drop follows the flow ``Q`` [m^3/s] of a signal.

    With the pump's flow it is the report's model, which leaves out that the relief valve branches off
    before the filter.
    """

    Q: Real = real_input("m^3/s", default=0.0)

    def through(self) -> SX:
        return self.Q
