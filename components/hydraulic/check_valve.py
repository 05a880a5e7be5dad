"""Check valve."""

from __future__ import annotations

from casadi import SX, sqrt

from arthur_acausal import Equations, Real, parameter, variable
from arthur_acausal.components.hydraulic.laws import clamp, turbulent_root
from arthur_acausal.components.hydraulic.two_port import TwoPort


class CheckValve(TwoPort):
    """Lets fluid pass from port_a to port_b only.

    The poppet's area grows linearly from ``A_leak`` at the cracking pressure ``dp_crack`` to ``A_max`` at
    ``dp_open`` (Merritt 1967, ch. 11, for a spring-loaded poppet without mass); the flow follows the
    orifice law. Continuous: no event. Parameters: ``dp_crack``, ``dp_open`` [Pa], ``A_max``, ``A_leak``
    [m^2], ``C_d`` [1], ``dp_small`` [Pa].
    """

    A_max: Real = parameter("m^2", min=0.0)
    A_leak: Real = parameter("m^2", default=0.0, min=0.0)
    dp_crack: Real = parameter("Pa", default=3e4, description="pressure drop at which it begins to open")
    dp_open: Real = parameter("Pa", default=1e5, description="pressure drop at which it is fully open")
    C_d: Real = parameter("1", default=0.7, min=0.0)
    dp_small: Real = parameter("Pa", default=1e3, min=0.0)
    opening: Real = variable("1", description="0 (closed) to 1 (fully open)")

    def lift(self) -> SX:
        """Return the pressure [Pa] that lifts the poppet."""
        return self.dp

    def area(self) -> SX:
        """Return the area [m^2] that is open."""
        return self.A_leak + (self.A_max - self.A_leak) * self.opening

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.opening == clamp((self.lift() - self.dp_crack) / (self.dp_open - self.dp_crack), 0, 1)
        root = turbulent_root(self.dp, self.dp_small)
        yield "orifice law", self.q == self.C_d * self.area() * sqrt(2 / self.fluid.rho) * root
