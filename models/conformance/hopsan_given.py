"""What a case says of a component of Hopsan: numbers by name, never evaluated."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import sqrt
from typing import Any

from arthur_acausal import UsageError
from arthur_acausal.components.hydraulic import Fluid

RHO, BETA = 870.0, 1e9
"""Density [kg/m^3] and bulk modulus [Pa] of the one fluid that stands for those of each of Hopsan's components."""


def fluid() -> Fluid:
    """Return the fluid of a model: of constant density, as in Hopsan."""
    return Fluid(rho=RHO, beta=BETA, constant_density=True)


def number(text: object, what: str) -> float:
    """Return the number that a text says; anything else is refused."""
    try:
        return float(str(text))
    except ValueError:
        raise UsageError(f"{what} is not a number: {text!r}") from None


@dataclass(frozen=True)
class Given:
    """A component of a case.

    Attributes
    ----------
    name, type : in the case.
    values : its parameters, as ``name`` or ``name#Value``, and start values of its ports, as ``port#quantity``.
    starts : start values of the nodes at its ports, which any member of a node may say.
    driven : its variables that signals are connected to.
    fluid : of the whole model.
    step : time step of the reference, s.
    """

    name: str
    type: str
    values: Mapping[str, Any]
    starts: Mapping[str, float]
    driven: frozenset[str]
    fluid: Fluid
    step: float

    def __call__(self, name: str, default: float) -> float:
        """Return a parameter."""
        return number(self.values.get(f"{name}#Value", self.values.get(name, default)), f"{self.name}.{name}")

    def start(self, port: str, quantity: str, default: float = 0.0) -> float:
        """Return a start value: the component's own, else that of the node."""
        key = f"{port}#{quantity}"
        return number(self.values.get(key, self.starts.get(key, default)), f"{self.name}.{key}")

    def volume(self, V: float, beta: float) -> float:
        """Return the volume [m^3] of the model's fluid that is as compliant as ``V`` with the modulus ``beta`` [Pa]."""
        return V * BETA / beta

    def discharge(self, C_q: float, rho: float) -> float:
        """Return the discharge coefficient that gives the flow of ``C_q`` with the density ``rho`` [kg/m^3]."""
        return C_q * sqrt(RHO / rho)
