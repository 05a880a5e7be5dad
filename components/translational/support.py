"""Elements whose housing may be mounted on something that slides."""

from __future__ import annotations

from casadi import SX

from arthur_acausal import Component
from arthur_acausal.components.translational.flange import Flange


class Supported(Component):
    """An element with a housing: on the ground, or with ``use_support`` on its flange ``support``."""

    use_support: bool = False

    def build(self) -> None:
        if self.use_support:
            self.support = Flange()

    def s_support(self) -> SX:
        """Return the position of the housing [m]."""
        return self.support.s if self.use_support else SX(0.0)
