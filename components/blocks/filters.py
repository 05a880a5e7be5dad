"""Low-pass filters by their poles, named as in the Modelica Standard Library (Blocks.Continuous.Filter)."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from typing import Any, ClassVar, Literal

from arthur_acausal import Equations, Real, der, parameter, variable
from arthur_acausal.components.blocks.linear import LinearBlock
from arthur_acausal.components.choice import check_choice

Characteristic = Literal["critical damping", "Bessel", "Butterworth", "Chebyshev I"]
CUT = 10 ** (-3 / 20)
"""Amplitude at the cut-off frequency: -3 dB."""


def low_pass_poles(
    kind: str, order: int, ripple: float, normalized: bool
) -> tuple[list[float], list[complex]]:
    """Return the real poles and one of each complex pair, for a cut-off at 1 rad/s.

    ``ripple`` [dB]: of Chebyshev's filter in the pass band. ``normalized``: scaled for an amplitude of
    -3 dB there.
    """
    from scipy.optimize import brentq
    from scipy.signal import besselap, buttap, cheb1ap

    if kind == "critical damping":
        poles = [-1 + 0j] * order
    elif kind == "Bessel":
        poles = [complex(p) for p in besselap(order, norm="delay")[1]]
    elif kind == "Butterworth":
        poles = [complex(p) for p in buttap(order)[1]]
    else:
        poles = [complex(p) for p in cheb1ap(order, ripple)[1]]

    def amplitude(w: float) -> float:
        product = 1.0
        for p in poles:
            product *= abs(p) / abs(1j * w - p)
        return product

    at = 1.0
    if normalized:
        root: Any = brentq(lambda w: amplitude(w) - CUT, 0.1, 100.0 * order)
        at = float(root)
    small = 1e-9
    real = [p.real / at for p in poles if abs(p.imag) < small]
    upper = sorted((p / at for p in poles if p.imag >= small), key=lambda p: (p.imag, p.real))
    return real, upper


class Filter(LinearBlock):
    """A low-pass filter of order ``n`` with the cut-off frequency ``f_cut`` [Hz], in steady state at the start.

    ``characteristic`` (structural): "critical damping" (equal real poles), "Bessel" (flat delay), "Butterworth" (flat
    amplitude), "Chebyshev I" (steep, with ``ripple`` [dB] in the pass band). ``normalized``: y falls to -3 dB at
    f_cut. One state x' = r (x - u) for each real pole r, two for each pair a +- b j: x_1' = a x_1 - b x_2 +
    (a^2 + b^2)/b u, x_2' = b x_1 + a x_2, whose output is x_2. ``k`` [unit of y over that of u]: gain. Tietze and
    Schenk, Halbleiter-Schaltungstechnik (2002), ch. 13; states as in the Modelica Standard Library 4.1.
    """

    n: int = 2
    characteristic: Characteristic = "critical damping"
    normalized: bool = True
    ripple: float = 0.5
    _units: ClassVar[dict[str, str]] = {"u": "{u}", "y": "{y}", "k": "({y})/({u})"}
    f_cut: Real = parameter("Hz", min=0.0)
    k: Real = parameter("1", default=1.0)

    @classmethod
    def _members(cls, given: Mapping[str, Any]) -> dict[str, Real]:
        return {f"x_{i}": variable(cls.u.unit) for i in range(cls._order(given))}

    def build(self) -> None:
        check_choice(self, "characteristic", Characteristic)

    def equations(self) -> Equations:
        real, pairs = low_pass_poles(self.characteristic, self.n, self.ripple, self.normalized)
        x, w, signal = self.states(), 2 * pi * self.f_cut, self.u
        for state, r in zip(x, real, strict=False):
            yield der(state) == w * r * (state - signal)
            signal = state
        for i, pole in enumerate(pairs):
            first, second = x[len(real) + 2 * i : len(real) + 2 * i + 2]
            a, b = pole.real, pole.imag
            yield der(first) == w * (a * first - b * second + (a**2 + b**2) / b * signal)
            yield der(second) == w * (b * first + a * second)
            signal = second
        yield self.y == self.k * signal

    def initial_equations(self) -> Equations:
        for state in self.states():
            yield der(state) == 0
