"""Blocks of arithmetic, named as in the Modelica Standard Library (Blocks.Math, Blocks.Nonlinear)."""

from __future__ import annotations

from casadi import fmax, fmin

from arthur_acausal import Equations, Real, parameter, real_input, real_output
from arthur_acausal.components.blocks.signal import SISO, Block


class Gain(SISO):
    """y = k u."""

    _units = {"u": "{u}", "y": "{y}", "k": "({y})/({u})"}
    k: Real = parameter("1", default=1.0)

    def equations(self) -> Equations:
        yield self.y == self.k * self.u


class Add(Block):
    """y = k1 u1 + k2 u2."""

    _units = {"u1": "{u}", "u2": "{u}", "y": "{y}", "k1": "({y})/({u})", "k2": "({y})/({u})"}
    u1: Real = real_input("1")
    u2: Real = real_input("1")
    y: Real = real_output("1")
    k1: Real = parameter("1", default=1.0)
    k2: Real = parameter("1", default=1.0)

    def equations(self) -> Equations:
        yield self.y == self.k1 * self.u1 + self.k2 * self.u2


class Feedback(Block):
    """y = u1 - u2."""

    _units = {"u1": "{y}", "u2": "{y}", "y": "{y}"}
    u1: Real = real_input("1", description="set point")
    u2: Real = real_input("1", description="measurement")
    y: Real = real_output("1")

    def equations(self) -> Equations:
        yield self.y == self.u1 - self.u2


class Product(Block):
    """y = u1 u2, where u1 has the unit of y and u2 none."""

    _units = {"u1": "{y}", "y": "{y}"}
    u1: Real = real_input("1")
    u2: Real = real_input("1")
    y: Real = real_output("1")

    def equations(self) -> Equations:
        yield self.y == self.u1 * self.u2


class Limiter(SISO):
    """y = u limited to y_min..y_max. Continuous: no event."""

    _units = {"u": "{y}", "y": "{y}", "y_min": "{y}", "y_max": "{y}"}
    y_max: Real = parameter("1")
    y_min: Real = parameter("1", default=lambda self: -self.y_max)

    def equations(self) -> Equations:
        yield self.y == fmin(fmax(self.u, self.y_min), self.y_max)
