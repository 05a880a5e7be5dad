"""Linear blocks of any order, named as in the Modelica Standard Library (Blocks.Continuous).

Their states ``x_0``, ``x_1``, ... have the unit of u and are 0 at the start.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import cos, pi
from typing import Any, ClassVar

from casadi import SX

from arthur_acausal import (
    DeclarationError,
    Equations,
    Real,
    der,
    parameter,
    variable,
)
from arthur_acausal.components.blocks.signal import SISO, SizedBlock


class LinearBlock(SizedBlock, SISO):
    """What linear blocks of any order share: one input ``u``, one output ``y``, states ``x_k``."""

    @classmethod
    def _order(cls, given: Mapping[str, Any]) -> int:
        """Return the number of states."""
        return int(given.get("n", getattr(cls, "n", 2)))

    @classmethod
    def _members(cls, given: Mapping[str, Any]) -> dict[str, Real]:
        order = cls._order(given)
        return {f"x_{i}": variable(cls.u.unit, start=0.0, fixed=True) for i in range(order)}

    def states(self) -> list[SX]:
        """Return the states."""
        names = [name for name in self._declarations.quantities if name.startswith("x_")]
        return [getattr(self, name) for name in names]


class TransferFunction(LinearBlock):
    """y = gain (b_0 s^m + ... + b_m)/(a_0 s^n + ... + a_n) u, m <= n: highest power first, s in 1/s.

    Structural: the tuples of numbers ``b`` and ``a``. ``gain`` [unit of y over that of u]. States in the
    controllable canonical form (Kailath, Linear Systems 1980, sec. 2.1): x_k is the k-th derivative [s^-k] of x_0.
    """

    b: tuple[float, ...] = (1.0,)
    a: tuple[float, ...] = (1.0, 1.0)
    _units: ClassVar[dict[str, str]] = {"u": "{u}", "y": "{y}", "gain": "({y})/({u})"}
    gain: Real = parameter("1", default=1.0)
    second: Real = parameter("s", default=1.0, description="what a time of 1 means")

    @classmethod
    def _order(cls, given: Mapping[str, Any]) -> int:
        b, a = given.get("b", cls.b), given.get("a", cls.a)
        if len(b) > len(a) or not a or a[0] == 0:
            raise DeclarationError(
                f"{cls.__name__} with b = {b}, a = {a}",
                cause="the numerator's degree is above the denominator's, or a begins with 0",
                remedy="give at most as many numbers in b as in a, the first of a not 0",
            )
        return len(a) - 1

    def equations(self) -> Equations:
        x, a = self.states(), [SX(value) for value in reversed(self.a)]
        b = [*reversed(self.b), *[0.0] * (len(self.a) - len(self.b))]
        for lower, upper in pairwise(x):
            yield self.second * der(lower) == upper
        highest = (self.u - sum((c * v for c, v in zip(a, x, strict=False)), SX(0.0))) / a[-1]
        if x:
            yield self.second * der(x[-1]) == highest
        rest = sum((c * v for c, v in zip(b, x, strict=False)), SX(0.0))
        yield self.y == self.gain * (rest + b[-1] * highest)


class StateSpace(LinearBlock):
    """der(x) = A x + B u, y = C x + D u, for one input and one output.

    Structural: ``A``, a tuple of rows; ``B``, ``C``, tuples of n numbers; ``D``, a number; time in s. ``gain`` [unit
    of y over that of u] multiplies y.
    """

    A: tuple[tuple[float, ...], ...] = ((-1.0,),)
    B: tuple[float, ...] = (1.0,)
    C: tuple[float, ...] = (1.0,)
    D: float = 0.0
    _units: ClassVar[dict[str, str]] = {"u": "{u}", "y": "{y}", "gain": "({y})/({u})"}
    gain: Real = parameter("1", default=1.0)
    second: Real = parameter("s", default=1.0, description="what a time of 1 means")

    @classmethod
    def _order(cls, given: Mapping[str, Any]) -> int:
        A, B, C = given.get("A", cls.A), given.get("B", cls.B), given.get("C", cls.C)
        if not all(len(part) == len(A) for part in (*A, B, C)):
            raise DeclarationError(
                f"{cls.__name__} with {len(A)} rows in A",
                cause="A is not square, or B or C does not fit it",
                remedy="give n rows of n numbers in A, and n numbers in B and in C",
            )
        return len(A)

    def equations(self) -> Equations:
        x = self.states()
        for state, row, b in zip(x, self.A, self.B, strict=True):
            yield self.second * der(state) == product(row, x) + b * self.u
        yield self.y == self.gain * (product(self.C, x) + self.D * self.u)


def product(row: Sequence[float], x: Sequence[SX]) -> SX:
    """Return the scalar product of numbers and expressions; nothing for a number 0."""
    return sum((c * v for c, v in zip(row, x, strict=True) if c), SX(0.0))


class LowpassButterworth(LinearBlock):
    """A Butterworth low-pass filter of order ``n`` with the cut-off frequency ``f`` [Hz], where y falls to k/sqrt(2).

    Sections of second order with the poles at angles of pi/n on a circle (Butterworth, Experimental Wireless 7
    (1930), 536), and one of first order where n is odd. ``k`` [unit of y over that of u]: gain.
    """

    n: int = 2
    _units: ClassVar[dict[str, str]] = {"u": "{u}", "y": "{y}", "k": "({y})/({u})"}
    f: Real = parameter("Hz", min=0.0)
    k: Real = parameter("1", default=1.0)

    def equations(self) -> Equations:
        x, w, signal = self.states(), 2 * pi * self.f, self.u
        odd = self.n % 2
        if odd:
            yield der(x[0]) == w * (signal - x[0])
            signal = x[0]
        for i in range(self.n // 2):
            value, rate = x[odd + 2 * i : odd + 2 * i + 2]
            damping = cos(pi * (2 * i + 1 + odd) / (2 * self.n))
            yield der(value) == w * rate
            yield der(rate) == w * (signal - value - 2 * damping * rate)
            signal = value
        yield self.y == self.k * signal


class CriticalDamping(LinearBlock):
    """A chain of ``n`` equal first-order filters: no overshoot. At ``f`` [Hz] y falls to k/sqrt(2).

    ``normalized`` (structural): False puts the corner of each single filter at f. ``k`` [unit of y over u]: gain.
    """

    n: int = 2
    normalized: bool = True
    _units: ClassVar[dict[str, str]] = {"u": "{u}", "y": "{y}", "k": "({y})/({u})"}
    f: Real = parameter("Hz", min=0.0)
    k: Real = parameter("1", default=1.0)

    def equations(self) -> Equations:
        narrow = (2 ** (1 / self.n) - 1) ** 0.5 if self.normalized else 1.0
        w, signal = 2 * pi * self.f / narrow, self.u
        for x in self.states():
            yield der(x) == w * (signal - x)
            signal = x
        yield self.y == self.k * signal
