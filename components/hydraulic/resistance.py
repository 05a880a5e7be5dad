"""Resistances of pipes and passages, without storage."""

from __future__ import annotations

from math import pi

from casadi import fabs, fmax

from arthur_acausal import Equations, Real, parameter, variable
from arthur_acausal.components.hydraulic.two_port import TwoPort

RE_TURBULENT = (64 / 0.3164) ** (4 / 3)
"""Reynolds number, about 1187, at which Blasius' friction factor meets the laminar 64/Re."""


class LinearResistance(TwoPort):
    """A constant hydraulic resistance: dp = R q. ``R`` [Pa s/m^3]."""

    R: Real = parameter("Pa*s/m^3", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "linear resistance", self.dp == self.R * self.q


class LaminarPipe(TwoPort):
    """Laminar flow in a round pipe, dp = 128 mu L q/(pi d^4) (Hagen and Poiseuille; Merritt 1967, ch. 3).

    Parameters: length ``L`` [m], diameter ``d`` [m]. Valid for a Reynolds number below about 2300.
    """

    L: Real = parameter("m", min=0.0)
    d: Real = parameter("m", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Hagen-Poiseuille", self.dp == 128 * self.fluid.mu * self.L / (pi * self.d**4) * self.q


class Pipe(LaminarPipe):
    """Laminar or turbulent flow in a smooth round pipe (Darcy and Weisbach).

    The friction factor is the greater of 64/Re and Blasius' 0.3164 Re^(-1/4), which meet at Re = 1187:
    continuous and passive. Valid for a Reynolds number below about 1e5. ``Re`` [1] is signed like the flow.
    """

    Re: Real = variable("1", nominal=1e3, description="Reynolds number")

    def equations(self) -> Equations:
        yield from TwoPort.equations(self)
        yield self.Re == 4 * self.q / (pi * self.d * self.fluid.nu)
        laminar = 128 * self.fluid.mu * self.L / (pi * self.d**4) * self.q
        yield "Darcy-Weisbach", self.dp == laminar * fmax(1, fabs(self.Re) / RE_TURBULENT) ** 0.75
