"""The triangle of two sides of a joint and the cylinder between their ends."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi
import numpy as np


@dataclass(frozen=True, slots=True)
class Triangle:
    """A joint's angle and the length of the cylinder opposite to it, by the law of cosines.

    The sides ``a`` and ``b`` [m] start at the joint's axis and enclose the angle psi = psi_0 + direction phi. All
    quantities may be floats, NumPy arrays or CasADi expressions. Valid for psi strictly between 0 and pi: where the
    sides are in line the cylinder has no arm.

    Attributes
    ----------
    a, b : the sides [m]. psi_0 : angle between them at phi = 0 [rad].
    direction : +1 where a longer cylinder means a larger angle phi, else -1.
    """

    a: Any
    b: Any
    psi_0: Any
    direction: Any

    def length(self, phi: Any) -> Any:
        """Return the cylinder's length [m], from pin to pin, at the joint angle ``phi`` [rad]."""
        m = _functions(phi)
        return m.sqrt(self.a**2 + self.b**2 - 2 * self.a * self.b * m.cos(self._psi(phi)))

    def arm(self, phi: Any) -> Any:
        """Return dl/dphi [m]: torque over force, velocity over speed; negative where ``direction`` is."""
        sine = _functions(phi).sin(self._psi(phi))
        return self.direction * self.a * self.b * sine / self.length(phi)

    def angle(self, length: Any) -> Any:
        """Return the joint angle [rad] at which the cylinder has this length [m]."""
        cosine = (self.a**2 + self.b**2 - length**2) / (2 * self.a * self.b)
        return self.direction * (_functions(length).arccos(cosine) - self.psi_0)

    def _psi(self, phi: Any) -> Any:
        return self.psi_0 + self.direction * phi


def _functions(x: Any) -> Any:
    """Return the library whose functions take ``x``."""
    return casadi if isinstance(x, casadi.SX | casadi.MX) else np
