"""An RC ladder of N sections, built from components by `connect`, and its exact solution.

A step source, then N times a series resistor and a capacitor to ground. With every R and C alike the node
voltages obey R C v' = tridiag(1, -2, 1) v with a free end, whose eigenvectors are sines: a closed form.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import (
    Component,
    Connector,
    Equations,
    Real,
    connect,
    der,
    flow,
    if_else,
    parameter,
    potential,
    start,
    time,
    variable,
)

RESISTANCE = 1e3  # [Ohm]
CAPACITANCE = 1e-6  # [F]
STEP = 1.0  # [V]


class Pin(Connector):
    """Electrical pin: voltage v [V] and current i [A] into the component."""

    v: Real = potential("V")
    i: Real = flow("A", nominal=1e-3)


class TwoPin(Component):
    """Two pins: v [V] from pin_n to pin_p, i [A] from pin_p through the component to pin_n."""

    pin_p = Pin()
    pin_n = Pin()
    v: Real = variable("V")
    i: Real = variable("A", nominal=1e-3)

    def equations(self) -> Equations:
        yield self.v == self.pin_p.v - self.pin_n.v
        yield self.pin_p.i + self.pin_n.i == 0
        yield self.i == self.pin_p.i


class Resistor(TwoPin):
    """Ohm's law, v = R i."""

    R: Real = parameter("ohm", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "Ohm's law", self.v == self.R * self.i


class Capacitor(TwoPin):
    """C v' = i."""

    C: Real = parameter("F", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "charge", self.C * der(self.v) == self.i


class StepVoltage(TwoPin):
    """A voltage of 0 before `start_time` [s], `height` [V] from then on."""

    height: Real = parameter("V")
    start_time: Real = parameter("s", default=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield "step", self.v == if_else(time() < self.start_time, 0, self.height)


class Ground(Component):
    """Zero voltage."""

    pin = Pin()

    def equations(self) -> Equations:
        yield self.pin.v == 0


class Ladder(Component):
    """`n` sections behind a step source; the capacitors are empty at the start."""

    n: int = 10
    source = StepVoltage(height=STEP)
    ground = Ground()

    def build(self) -> None:
        self.resistors = [Resistor(R=RESISTANCE) for _ in range(self.n)]
        self.capacitors = [Capacitor(C=CAPACITANCE, v=start(0.0, fixed=True)) for _ in range(self.n)]

    def equations(self) -> Equations:
        yield connect(self.source.pin_n, self.ground.pin)
        node = self.source.pin_p
        for resistor, capacitor in zip(self.resistors, self.capacitors, strict=True):
            yield connect(node, resistor.pin_p)
            yield connect(resistor.pin_n, capacitor.pin_p)
            yield connect(capacitor.pin_n, self.ground.pin)
            node = resistor.pin_n


def exact_voltage(n: int, node: int, t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the voltage [V] of node 1..n at the times t [s] after the step.

    v_j = 1 - sum_k c_k sin(j theta_k) exp(-4 sin^2(theta_k/2) t/(R C)), theta_k = (2k - 1) pi / (2n + 1),
    c_k = 2 cot(theta_k/2) / (2n + 1). The sum cancels to the last digits where v_j is far below 1e-15.
    """
    theta = (2 * np.arange(1, n + 1) - 1) * np.pi / (2 * n + 1)
    amplitude = 2 / np.tan(theta / 2) / (2 * n + 1) * np.sin(node * theta)
    rate = 4 * np.sin(theta / 2) ** 2 / (RESISTANCE * CAPACITANCE)
    decay: NDArray[np.float64] = np.exp(-np.multiply.outer(t, rate)) @ amplitude
    return STEP * (1 - decay)
