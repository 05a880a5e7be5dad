"""Massless rigid links between two frames."""

from __future__ import annotations

from casadi import cos, sin

from arthur_acausal import Component, Equations, Real, parameter
from arthur_acausal.components.planar.frame import Frame


class FixedTranslation(Component):
    """A rigid link from frame_a by ``r_x``, ``r_y`` [m], in the directions of frame_a, to frame_b."""

    frame_a = Frame()
    frame_b = Frame()
    r_x: Real = parameter("m", default=0.0)
    r_y: Real = parameter("m", default=0.0)

    def equations(self) -> Equations:
        a, b = self.frame_a, self.frame_b
        x = cos(a.phi) * self.r_x - sin(a.phi) * self.r_y
        y = sin(a.phi) * self.r_x + cos(a.phi) * self.r_y
        yield b.x == a.x + x
        yield b.y == a.y + y
        yield b.phi == a.phi
        yield "force balance, x", a.fx + b.fx == 0
        yield "force balance, y", a.fy + b.fy == 0
        yield "torque balance about frame_a", a.tau + b.tau + x * b.fy - y * b.fx == 0


class FixedRotation(Component):
    """Two frames at one point, frame_b turned by ``alpha`` [rad] from frame_a."""

    frame_a = Frame()
    frame_b = Frame()
    alpha: Real = parameter("rad")

    def equations(self) -> Equations:
        a, b = self.frame_a, self.frame_b
        yield b.x == a.x
        yield b.y == a.y
        yield b.phi == a.phi + self.alpha
        yield a.fx + b.fx == 0
        yield a.fy + b.fy == 0
        yield a.tau + b.tau == 0
