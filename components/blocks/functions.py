"""Functions of one or two signals, named as in the Modelica Standard Library (Blocks.Math)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import casadi
from casadi import SX

from arthur_acausal import Equations, Real, if_else, parameter, real_input, real_output
from arthur_acausal.components.blocks.signal import SISO, Block, SizedBlock


class Add3(Block):
    """y = k1 u1 + k2 u2 + k3 u3."""

    _units = {"u1": "{y}", "u2": "{y}", "u3": "{y}", "y": "{y}"}
    u1: Real = real_input("1")
    u2: Real = real_input("1")
    u3: Real = real_input("1")
    y: Real = real_output("1")
    k1: Real = parameter("1", default=1.0)
    k2: Real = parameter("1", default=1.0)
    k3: Real = parameter("1", default=1.0)

    def equations(self) -> Equations:
        yield self.y == self.k1 * self.u1 + self.k2 * self.u2 + self.k3 * self.u3


class Sum(SizedBlock):
    """y = the sum of ``n`` signals ``u_0`` to ``u_(n-1)``, each times its gain in ``k``, by default 1.

    Structural: ``n``; ``k``, a tuple of n numbers. ``inputs()`` lists the signals.
    """

    n: int = 2
    k: tuple[float, ...] = ()
    _units = {"y": "{y}"}
    y: Real = real_output("1")

    @classmethod
    def _members(cls, given: Mapping[str, Any]) -> dict[str, Real]:
        return {f"u_{i}": real_input(cls.y.unit) for i in range(given.get("n", cls.n))}

    def inputs(self) -> list[SX]:
        """Return the input signals."""
        return [getattr(self, f"u_{i}") for i in range(self.n)]

    def equations(self) -> Equations:
        gains = self.k or (1.0,) * self.n
        yield self.y == sum((k * u for k, u in zip(gains, self.inputs(), strict=True)), SX(0.0))


class Division(Block):
    """y = u1/u2, where u1 has the unit of y and u2 none."""

    _units = {"u1": "{y}", "y": "{y}"}
    u1: Real = real_input("1")
    u2: Real = real_input("1")
    y: Real = real_output("1")

    def equations(self) -> Equations:
        yield self.y == self.u1 / self.u2


class Abs(SISO):
    """y = |u|. Continuous: no event."""

    _units = {"u": "{y}", "y": "{y}"}

    def equations(self) -> Equations:
        yield self.y == casadi.fabs(self.u)


class Sign(SISO):
    """y = -1, 0 or 1, the sign of u: events."""

    _units = {"u": "{u}"}

    def equations(self) -> Equations:
        yield self.y == if_else(self.u > 0, 1, if_else(self.u < 0, -1, 0))


class Sqrt(SISO):
    """y = sqrt(u), u >= 0; u has the unit of y squared."""

    _units = {"u": "({y})^2", "y": "{y}"}

    def equations(self) -> Equations:
        yield self.y == casadi.sqrt(self.u)


class Plain(SISO):
    """What functions of a plain number share: neither u nor y has a unit."""

    _units = {}

    def function(self, u: SX) -> SX:
        """Return y."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield self.y == self.function(self.u)


class Sin(Plain):
    """y = sin(u), u in radians."""

    def function(self, u: SX) -> SX:
        return casadi.sin(u)


class Cos(Plain):
    """y = cos(u), u in radians."""

    def function(self, u: SX) -> SX:
        return casadi.cos(u)


class Tan(Plain):
    """y = tan(u), u in radians."""

    def function(self, u: SX) -> SX:
        return casadi.tan(u)


class Asin(Plain):
    """y = asin(u) in radians, |u| <= 1."""

    def function(self, u: SX) -> SX:
        return casadi.asin(u)


class Acos(Plain):
    """y = acos(u) in radians, |u| <= 1."""

    def function(self, u: SX) -> SX:
        return casadi.acos(u)


class Atan(Plain):
    """y = atan(u) in radians."""

    def function(self, u: SX) -> SX:
        return casadi.atan(u)


class Exp(Plain):
    """y = exp(u)."""

    def function(self, u: SX) -> SX:
        return casadi.exp(u)


class Log(Plain):
    """y = ln(u), u > 0."""

    def function(self, u: SX) -> SX:
        return casadi.log(u)


class TwoInputs(Block):
    """What functions of two signals of one unit share: u1, u2, y."""

    _units = {"u1": "{y}", "u2": "{y}", "y": "{y}"}
    u1: Real = real_input("1")
    u2: Real = real_input("1")
    y: Real = real_output("1")


class Min(TwoInputs):
    """y = the smaller of u1 and u2. Continuous: no event."""

    def equations(self) -> Equations:
        yield self.y == casadi.fmin(self.u1, self.u2)


class Max(TwoInputs):
    """y = the larger of u1 and u2. Continuous: no event."""

    def equations(self) -> Equations:
        yield self.y == casadi.fmax(self.u1, self.u2)


class Atan2(TwoInputs):
    """y = atan2(u1, u2) in radians, -pi to pi."""

    _units = {"u1": "{u}", "u2": "{u}"}

    def equations(self) -> Equations:
        yield self.y == casadi.atan2(self.u1, self.u2)
