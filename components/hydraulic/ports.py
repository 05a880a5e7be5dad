"""The connector of hydraulics."""

from __future__ import annotations

from casadi import SX

from arthur_acausal import Connector, Real, flow, potential
from arthur_acausal.components.hydraulic.fluid import Fluid


class HydraulicPort(Connector):
    """A port for fluid.

    ``p`` [Pa]: absolute pressure. ``q`` [m^3/s]: mass flow into the component over the fluid's reference
    density, so that the flows of a connection set sum to zero by mass. All ports of a connection set carry
    the same fluid.
    """

    medium = Fluid
    p: Real = potential("Pa", nominal=1e7, display="bar")
    q: Real = flow("m^3/s", nominal=1e-4, display="L/min")

    def power(self) -> SX:
        """Return p q [W], the work that the fluid does on the component where its density is the reference's."""
        return self.p * self.q
