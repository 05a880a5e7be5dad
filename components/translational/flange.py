"""The connector of translational mechanics."""

from __future__ import annotations

from casadi import SX

from arthur_acausal import Connector, Real, der, flow, potential


class Flange(Connector):
    """A mechanical flange that moves along a line.

    ``s`` [m]: its position. ``f`` [N]: the force that acts on the component at this flange, positive in the
    direction of positive ``s``.
    """

    s: Real = potential("m")
    f: Real = flow("N")

    def power(self) -> SX:
        """Return the force times the velocity [W]."""
        return self.f * der(self.s)
