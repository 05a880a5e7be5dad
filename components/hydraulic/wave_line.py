"""Hydraulic line by the method of characteristics."""

from __future__ import annotations

from collections import deque
from collections.abc import Generator
from typing import Any

from casadi import SX, exp

from arthur_acausal import Component, Equations, Real, der, discrete, parameter, sampled, variable
from arthur_acausal.components.hydraulic.fluid import Fluid
from arthur_acausal.components.hydraulic.ports import HydraulicPort


class _Delay:
    """What has been put in at either end of the line and has not yet arrived at the other."""

    def __init__(self, n: int) -> None:
        self.n = n
        self.waves: deque[list[float]] = deque()

    def fresh(self) -> _Delay:
        return _Delay(self.n)

    def __call__(self, t: float, inputs: Any) -> list[float]:
        """Take the waves that have left since the last sample, and return those that arrive until the next one.

        What left from k - 1 to k arrives from n + k - 1 to n + k; until then, what arrives already goes on.
        """
        from_a, from_b, *arriving = (float(x) for x in inputs)
        if self.waves:
            self.waves.append([from_a, from_b])
        else:
            self.waves.extend(arriving for _ in range(self.n))
        return self.waves.popleft()


class WaveLine(Component):
    """A line in which plane waves travel, sampled ``n`` times a transit (Wylie and Streeter 1993, ch. 3).

    What leaves an end, p + Z_c q with q into the line, arrives at the other after ``T``: p_a = c_a + Z_c
    q_a with c_a(t) = p_b(t - T) + Z_c q_b(t - T), held from sample to sample. Fronts stay sharp; the line has
    no states without losses, and an event each T/n.

    Structural options:

    - ``friction``: adds the resistance ``R`` [Pa s/m^3] of the whole line as in Krus, Weddfelt and Palmberg
      (Fast pipeline models for simulation of hydraulic systems, J. Dyn. Sys., Meas., Control 116, 1994): waves
      lose the factor exp(-R/(2 Z_c)) a transit, and what they lose comes back within kappa T, kappa = 1.25, so
      that a steady flow meets exactly R.
    - ``wall``: losses in a viscoelastic wall, of the same shape, given as the resistance ``R_wall``, with the
      time constant 2 Z_c T/R_wall.

    Parameters: transit time ``T`` [s] = L sqrt(rho/beta); characteristic impedance ``Z_c`` [Pa s/m^3] = sqrt(rho
    beta)/area; ``p_start`` [Pa] and ``q_start`` [m^3/s, from a to b], the steady flow before the start. Valid for
    linear waves, R below about 2 Z_c; laminar friction.
    """

    n: int = 100
    friction: bool = False
    wall: bool = False
    port_a = HydraulicPort()
    port_b = HydraulicPort()
    fluid: Fluid = Fluid()
    T: Real = parameter("s", min=0.0, description="transit time")
    Z_c: Real = parameter("Pa*s/m^3", min=0.0, description="characteristic impedance")
    R: Real = parameter("Pa*s/m^3", default=0.0, min=0.0, description="resistance (friction)")
    R_wall: Real = parameter("Pa*s/m^3", default=0.0, min=0.0, description="losses of the wall (wall)")
    kappa: Real = parameter("1", default=1.25, min=0.0, description="time constant over T (friction)")
    p_start: Real = parameter("Pa", default=1e5, display="bar", description="before the start")
    q_start: Real = parameter("m^3/s", default=0.0, display="L/min", description="before the start")
    arrived_a: Real = discrete("Pa", start=lambda self: self.p_start - self.Z_c * self.q_start, display="bar")
    arrived_b: Real = discrete("Pa", start=lambda self: self.p_start + self.Z_c * self.q_start, display="bar")
    c_a: Real = variable("Pa", nominal=1e7, display="bar", description="wave that arrives at port_a")
    c_b: Real = variable("Pa", nominal=1e7, display="bar", description="wave that arrives at port_b")
    late_a: Real = variable(
        "Pa", nominal=1e7, display="bar", description="what friction lets through late, at a"
    )
    late_b: Real = variable(
        "Pa", nominal=1e7, display="bar", description="what friction lets through late, at b"
    )
    held_a: Real = variable(
        "Pa", nominal=1e7, display="bar", description="what the wall lets through late, at a"
    )
    held_b: Real = variable(
        "Pa", nominal=1e7, display="bar", description="what the wall lets through late, at b"
    )
    drop_a: Real = variable(
        "Pa", nominal=1e5, display="bar", description="steady drop by friction, of a's flow"
    )
    drop_b: Real = variable(
        "Pa", nominal=1e5, display="bar", description="steady drop by friction, of b's flow"
    )

    def equations(self) -> Equations:
        a, b = self.port_a, self.port_b
        yield (
            "transit",
            sampled(
                _Delay(self.n),
                period=self.T / self.n,
                inputs=[a.p + self.Z_c * a.q, b.p + self.Z_c * b.q, self.arrived_b, self.arrived_a],
                outputs=[self.arrived_b, self.arrived_a],
            ),
        )
        yield "characteristic at a", a.p == self.c_a + self.Z_c * a.q + self.drop_a
        yield "characteristic at b", b.p == self.c_b + self.Z_c * b.q + self.drop_b
        for c, arrived, late, held in (
            (self.c_a, self.arrived_a, self.late_a, self.held_a),
            (self.c_b, self.arrived_b, self.late_b, self.held_b),
        ):
            through = yield from self._loss(arrived, late, self.R, self.kappa * self.T, self.friction)
            tau = 2 * self.Z_c * self.T / self.R_wall
            through = yield from self._loss(through, held, self.R_wall, tau, self.wall)
            yield c == through
        for drop, q in ((self.drop_a, a.q), (self.drop_b, b.q)):
            if self.friction:
                yield "friction", self.kappa * self.T * der(drop) == self.R * q - drop
            else:
                yield drop == 0

    def _loss(self, wave: SX, late: SX, R: SX, tau: SX, active: bool) -> Generator[Any, None, SX]:
        """State how a wave passes a loss: the share exp(-R/(2 Z_c)) at once, the rest with the time constant."""
        if not active:
            yield late == wave
            return wave
        yield "loss", tau * der(late) == wave - late
        at_once = exp(-R / (2 * self.Z_c))
        return at_once * wave + (1 - at_once) * late

    def initial_equations(self) -> Equations:
        if self.friction:
            for late, arrived in ((self.late_a, self.arrived_a), (self.late_b, self.arrived_b)):
                yield late == arrived
            yield self.drop_a == self.R * self.q_start
            yield self.drop_b == -self.R * self.q_start
        if self.wall:
            for held, arrived in ((self.held_a, self.arrived_a), (self.held_b, self.arrived_b)):
                yield held == arrived
