"""Orifices."""

from __future__ import annotations

from casadi import SX, sqrt

from arthur_acausal import Equations, Real, parameter, real_input
from arthur_acausal.components.hydraulic.laws import turbulent_root
from arthur_acausal.components.hydraulic.two_port import TwoPort


class Orifice(TwoPort):
    """A sharp-edged orifice: q = C_d area sqrt(2 dp/rho), with a laminar transition below about ``dp_small``.

    Merritt (1967), ch. 3; ARTHuR report, eq. 5.29. The density is the reference density. Parameters:
    ``area`` [m^2], ``C_d`` [1], ``dp_small`` [Pa]. Either direction. Valid for turbulent flow, Re above
    about 1e3.
    """

    area: Real = parameter("m^2", min=0.0)
    C_d: Real = parameter("1", default=0.7, min=0.0)
    dp_small: Real = parameter("Pa", default=1e3, min=0.0)

    def open_area(self) -> SX:
        """Return the area [m^2] that is open."""
        return self.area

    def equations(self) -> Equations:
        yield from super().equations()
        gain = self.C_d * self.open_area() * sqrt(2 / self.fluid.rho)
        yield "orifice law", self.q == gain * turbulent_root(self.dp, self.dp_small)


class VariableOrifice(Orifice):
    """An orifice whose open area is the signal ``opening``, 0 (closed) to 1 (open), times ``area``."""

    opening: Real = real_input("1", default=1.0, min=0.0, max=1.0)

    def open_area(self) -> SX:
        return self.opening * self.area
