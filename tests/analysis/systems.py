"""Small systems whose linear behaviour, rest and sensitivities are known in closed form."""

from __future__ import annotations

import casadi

from arthur_acausal import (
    Component,
    Equations,
    Real,
    der,
    discrete,
    if_else,
    parameter,
    pre,
    real_input,
    reinit,
    time,
    variable,
    when,
)


class Oscillator(Component):
    """m x'' + d x' + k x = f."""

    m: Real = parameter("kg", default=2.0)
    d: Real = parameter("N*s/m", default=3.0)
    k: Real = parameter("N/m", default=50.0)
    f: Real = real_input("N", default=10.0)
    x: Real = variable("m", start=0.1, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)
    a: Real = variable("m/s^2")

    def equations(self) -> Equations:
        yield self.v == der(self.x)
        yield self.a == der(self.v)
        yield "Newton's second law", self.m * self.a == self.f - self.d * self.v - self.k * self.x


class LowPass(Component):
    """An RC low pass: R C v' = u - v; the current i through R is algebraic, of a nonlinear resistor for n > 0."""

    R: Real = parameter("ohm", default=1e3)
    C: Real = parameter("F", default=1e-6)
    tau: Real = parameter("s", default=lambda self: self.R * self.C)
    u: Real = real_input("V", default=1.0)
    v: Real = variable("V", start=0.0, fixed=True)
    i: Real = variable("A", nominal=1e-3)

    def equations(self) -> Equations:
        yield self.R * self.i == self.u - self.v
        yield self.R * self.i == self.tau * der(self.v)


class Shaft(Component):
    """J w' = T - b w, turning for ever: its angle has no value of rest."""

    J: Real = parameter("kg*m^2", default=2.0)
    b: Real = parameter("N*m*s", default=0.5)
    T: Real = real_input("N*m", default=3.0)
    phi: Real = variable("rad", start=0.25)
    w: Real = variable("rad/s", start=0.0)

    def equations(self) -> Equations:
        yield self.w == der(self.phi)
        yield "balance of torques", self.J * der(self.w) == self.T - self.b * self.w


class Coupled(Component):
    """Two discs on a spring c, driven at one and braked at the other: they turn together, twisted by T / c."""

    T: Real = parameter("1/s^2", default=1.0)
    c: Real = parameter("1/s^2", default=5.0)
    a: Real = variable("1", start=0.3)
    b: Real = variable("1", start=0.2)
    v: Real = variable("1/s", start=0.0)
    w: Real = variable("1/s", start=0.0)
    brake: Real = parameter("1/s", default=0.5)

    def equations(self) -> Equations:
        yield self.v == der(self.a)
        yield self.w == der(self.b)
        yield der(self.v) == self.T - self.c * casadi.sin(self.a - self.b)
        yield der(self.w) == self.c * casadi.sin(self.a - self.b) - self.brake * self.w


class Rocket(Component):
    """A mass under constant force has no state of rest."""

    f: Real = parameter("m/s^2", default=1.0)
    x: Real = variable("m", start=0.0)
    v: Real = variable("m/s", start=2.0)

    def equations(self) -> Equations:
        yield self.v == der(self.x)
        yield "acceleration", der(self.v) == self.f


class Tank(Component):
    """V' = q_in - c sqrt(h), filled until the overflow at h = 0.5 m opens."""

    c: Real = parameter("m^2.5/s", default=1e-3)
    q: Real = parameter("m^3/s", default=2e-3)
    area: Real = parameter("m^2", default=0.1)
    top: Real = parameter("m", default=0.5)
    weir: Real = parameter("m^2/s", default=1e-2)
    h: Real = variable("m", start=0.01, min=0.0)

    def equations(self) -> Equations:
        over = if_else(self.h > self.top, self.weir * (self.h - self.top), 0.0)
        yield self.area * der(self.h) == self.q - self.c * casadi.sqrt(self.h) - over


class Ball(Component):
    """Falls from h_0, bounces with restitution e, counts."""

    g: Real = parameter("m/s^2", default=9.81)
    e: Real = parameter("1", default=0.7)
    h_0: Real = parameter("m", default=1.0)
    h: Real = variable("m", start=lambda self: self.h_0, fixed=True)
    v: Real = variable("m/s", start=0.0, fixed=True)
    bounces: Real = discrete("1")

    def equations(self) -> Equations:
        yield der(self.h) == self.v
        yield der(self.v) == -self.g
        yield when(self.h < 0, reinit(self.v, -self.e * pre(self.v)), self.bounces == pre(self.bounces) + 1)


class Switched(Component):
    """x decays at rate k down to c, then linearly; from T on a nonlinear algebraic z joins; n keeps what x was then."""

    k: Real = parameter("1/s", default=3.0)
    c: Real = parameter("1", default=0.7)
    T: Real = parameter("s", default=0.4)
    rate: Real = parameter("1/s", default=1.0)
    x: Real = variable("1", start=1.0, fixed=True)
    z: Real = variable("1", start=0.5)
    n: Real = discrete("1")

    def equations(self) -> Equations:
        own = if_else(self.x > self.c, -self.k * self.x, -4.0 * self.rate)
        more = if_else(time() > self.T, 2.0 * self.rate * self.z, 0.0)
        yield der(self.x) == own + more + self.rate * self.n
        yield self.z + self.z**3 == 2.0 * self.x
        yield when(time() > self.T, self.n == pre(self.n) + self.c * self.x)
