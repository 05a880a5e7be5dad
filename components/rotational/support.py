"""Elements whose housing may be mounted on something that turns."""

from __future__ import annotations

from casadi import SX

from arthur_acausal import Component
from arthur_acausal.components.rotational.flange import Flange


class Supported(Component):
    """An element with a housing: on the ground, or with ``use_support`` on its flange ``support``."""

    use_support: bool = False

    def build(self) -> None:
        if self.use_support:
            self.support = Flange()

    def phi_support(self) -> SX:
        """Return the angle of the housing [rad]."""
        return self.support.phi if self.use_support else SX(0.0)
