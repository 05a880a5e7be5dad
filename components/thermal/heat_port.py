"""The connector of heat transfer."""

from __future__ import annotations

from casadi import SX

from arthur_acausal import Connector, Real, flow, potential


class HeatPort(Connector):
    """Where heat passes: ``T`` [K], the absolute temperature; ``Q_flow`` [W], heat into the component."""

    T: Real = potential("K", start=293.15, nominal=300.0, min=0.0, display="degC")
    Q_flow: Real = flow("W")

    def power(self) -> SX:
        """Return the heat flow [W]."""
        return self.Q_flow
