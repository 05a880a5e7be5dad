"""Problems of the Test Set for IVP Solvers, written as components, with its reference values.

F. Mazzia and C. Magherini, Test Set for Initial Value Problem Solvers, release 2.4, University of Bari and INdAM
(2008), http://www.dm.uniba.it/~testset/ , first compiled at CWI, Amsterdam. The numbers are those of the test set, in
its own units (mol/L, min or s); the unit "1" stands for them, so that rates are in "1/s".
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from casadi import sqrt

from arthur_acausal import Component, Equations, Real, der, parameter, variable


@dataclass(frozen=True)
class Reference:
    """Values at ``t``, and the largest relative error that a solution may have there."""

    t: float
    values: Mapping[str, float]
    required: float

    def error(self, values: Mapping[str, float]) -> float:
        """The largest relative error of a component."""
        return max(abs(values[path] / value - 1.0) for path, value in self.values.items())


class Robertson(Component):
    """Robertson's chemical kinetics with the conservation of mass as an algebraic equation.

    y2 is 3.6e-5 at its largest; in the end y1 is 2e-8 and y2 8e-14: absolute tolerances have to be below these.
    """

    k1: Real = parameter("1/s", default=0.04)
    k2: Real = parameter("1/s", default=3e7)
    k3: Real = parameter("1/s", default=1e4)
    y1: Real = variable("1", start=1.0, fixed=True)
    y2: Real = variable("1", start=0.0, fixed=True, nominal=1e-5)
    y3: Real = variable("1", start=0.0)

    def equations(self) -> Equations:
        yield der(self.y1) == -self.k1 * self.y1 + self.k3 * self.y2 * self.y3
        yield der(self.y2) == self.k1 * self.y1 - self.k3 * self.y2 * self.y3 - self.k2 * self.y2**2
        yield "conservation", self.y1 + self.y2 + self.y3 == 1.0


ROBERTSON = Reference(
    1e11,
    {"y1": 2.083340149701255e-08, "y2": 8.333360770334713e-14, "y3": 0.999999979166505},
    1e-5,
)


class ChemicalAkzo(Component):
    """The reaction of FLB and ZHU of Akzo Nobel: six concentrations, one of them in equilibrium."""

    k1: Real = parameter("1/s", default=18.7)
    k2: Real = parameter("1/s", default=0.58)
    k3: Real = parameter("1/s", default=0.09)
    k4: Real = parameter("1/s", default=0.42)
    K: Real = parameter("1", default=34.4)
    klA: Real = parameter("1/s", default=3.3)
    K_s: Real = parameter("1", default=115.83)
    p_CO2: Real = parameter("1", default=0.9)
    H: Real = parameter("1", default=737.0)
    y1: Real = variable("1", start=0.444, fixed=True)
    y2: Real = variable("1", start=0.00123, fixed=True, nominal=1e-3)
    y3: Real = variable("1", start=0.0, fixed=True)
    y4: Real = variable("1", start=0.007, fixed=True, nominal=1e-3)
    y5: Real = variable("1", start=0.0, fixed=True, nominal=1e-2)
    y6: Real = variable("1", start=0.36, nominal=1e-2)

    def equations(self) -> Equations:
        r1 = self.k1 * self.y1**4 * sqrt(self.y2)
        r2 = self.k2 * self.y3 * self.y4
        r3 = self.k2 / self.K * self.y1 * self.y5
        r4 = self.k3 * self.y1 * self.y4**2
        r5 = self.k4 * self.y6**2 * sqrt(self.y2)
        F_in = self.klA * (self.p_CO2 / self.H - self.y2)
        yield der(self.y1) == -2 * r1 + r2 - r3 - r4
        yield der(self.y2) == -r1 / 2 - r4 - r5 / 2 + F_in
        yield der(self.y3) == r1 - r2 + r3
        yield der(self.y4) == -r2 + r3 - 2 * r4
        yield der(self.y5) == r2 - r3 + r5
        yield "equilibrium", self.K_s * self.y1 * self.y4 == self.y6


CHEMICAL_AKZO = Reference(
    180.0,
    {
        "y1": 0.1150794920661702,
        "y2": 0.001203831471567715,
        "y3": 0.1611562887407974,
        "y4": 0.0003656156421249283,
        "y5": 0.01708010885264404,
        "y6": 0.004873531310307455,
    },
    1e-8,
)


class Hires(Component):
    """High irradiance response of photomorphogenesis (Schaefer 1975): eight reactants, stiff."""

    k1: Real = parameter("1/s", default=1.71)
    k2: Real = parameter("1/s", default=0.43)
    k3: Real = parameter("1/s", default=8.32)
    k4: Real = parameter("1/s", default=0.69)
    k5: Real = parameter("1/s", default=0.035)
    k6: Real = parameter("1/s", default=8.32)
    k7: Real = parameter("1/s", default=280.0)
    k8: Real = parameter("1/s", default=0.69)
    k9: Real = parameter("1/s", default=0.69)
    o_ks: Real = parameter("1/s", default=0.0007)
    y1: Real = variable("1", start=1.0, fixed=True, nominal=1e-3)
    y2: Real = variable("1", start=0.0, fixed=True, nominal=1e-3)
    y3: Real = variable("1", start=0.0, fixed=True, nominal=1e-4)
    y4: Real = variable("1", start=0.0, fixed=True, nominal=1e-3)
    y5: Real = variable("1", start=0.0, fixed=True, nominal=1e-2)
    y6: Real = variable("1", start=0.0, fixed=True, nominal=1e-2)
    y7: Real = variable("1", start=0.0, fixed=True, nominal=1e-3)
    y8: Real = variable("1", start=0.0057, fixed=True, nominal=1e-3)

    def equations(self) -> Equations:
        y1, y2, y3, y4, y5, y6, y7, y8 = (getattr(self, f"y{k}") for k in range(1, 9))
        yield der(y1) == -self.k1 * y1 + self.k2 * y2 + self.k6 * y3 + self.o_ks
        yield der(y2) == self.k1 * y1 - (self.k2 + self.k3) * y2
        yield der(y3) == -(self.k6 + self.k1) * y3 + self.k2 * y4 + self.k5 * y5
        yield der(y4) == self.k3 * y2 + self.k1 * y3 - (self.k4 + self.k2) * y4
        yield der(y5) == -(self.k5 + self.k1) * y5 + self.k2 * (y6 + y7)
        yield der(y6) == -self.k7 * y6 * y8 + self.k8 * y4 + self.k1 * y5 - self.k2 * y6 + self.k8 * y7
        yield der(y7) == self.k7 * y6 * y8 - (self.k2 + self.k8 + self.k9) * y7
        yield der(y8) == -(self.k7 * y6 * y8 - (self.k2 + self.k8 + self.k9) * y7)


HIRES = Reference(
    321.8122,
    {
        "y1": 0.0007371312573325668,
        "y2": 0.0001442485726316185,
        "y3": 5.888729740967575e-05,
        "y4": 0.001175651343283149,
        "y5": 0.002386356198831331,
        "y6": 0.006238968252742796,
        "y7": 0.002849998395185769,
        "y8": 0.002850001604814231,
    },
    1e-7,
)
