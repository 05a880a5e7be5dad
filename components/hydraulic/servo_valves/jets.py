"""Jets at the partly open ports of a valve: their angle, speed and momentum (ARTHuR report, 3.2.1, 3.4, 3.6.2)."""

from __future__ import annotations

from math import pi
from typing import Literal

from casadi import SX, cos, log, sin, sqrt, tan

from arthur_acausal import Equations, smooth_if_else

JetAngle = Literal["printed", "continuous"]

WIDE = 0.5 * (1 + 1e-9)
"""Share of the opening from which 3.7 holds; 0.5 itself still belongs to 3.6."""

PRINTED_LIMIT = 1.2
"""The angle [rad] at which 3.7 as printed begins; the report calls it 69 deg, it is 68.755."""


def von_mises(phi: SX, ratio: SX) -> tuple[SX, SX]:
    """Return both sides of 3.6, numerator = ratio times denominator, for the jet angle ``phi`` [rad].

    ``ratio`` = x/delta, opening over clearance, not negative. phi goes from 21.131 deg at 0 by 45 deg at 1 to 68.869
    deg at infinity. Von Mises (1917); symmetric about 45 deg.
    """
    numerator = 1 + pi / 2 * sin(phi) - log(tan((pi - phi) / 2)) * cos(phi)
    denominator = 1 + pi / 2 * cos(phi) + log(tan((pi / 2 - phi) / 2)) * sin(phi)
    return numerator, ratio * denominator


def jet_angle(s: SX, phi: SX, phi_half: SX) -> SX:
    """Return the angle [rad]: ``phi`` of 3.6 up to half the opening ``s`` [1], then 3.7, linear to 90 deg at s = 1.

    3.7 as printed begins at ``phi_half`` = 1.2 rad, so that cos(phi) jumps by up to -3.6 % (no event); with phi(1/2)
    it does not.
    """
    return smooth_if_else(s > WIDE, phi_half + (pi - 2 * phi_half) * (s - 0.5), phi)


def half_angle(kind: JetAngle, phi_half: SX, ratio: SX) -> Equations:
    """Yield where 3.7 begins: as printed, or "continuous", where 3.6 ends at half of ``ratio`` = width/clearance."""
    if kind == "printed":
        yield phi_half == PRINTED_LIMIT
    else:
        yield "von Mises at half the opening", equal(*von_mises(phi_half, ratio / 2))


def equal(left: SX, right: SX) -> SX:
    """Return the equation of both sides."""
    return left == right


def drop_factor(s: SX, rho: SX, C_d: SX) -> SX:
    """Return kappa [kg/m^3] of an orifice's drop, kappa u^2 with u = Q/A_o: K_Q A_o^2 of 3.41 with C_d squared.

    Zero at s = 1, where 3.32's hydraulic diameter of the opening is that of the passage.
    """
    return rho / (2 * C_d**2) * (1 - (2 * s / (1 + s)) ** 4)


def jet_force(rho: SX, area: SX, u: SX, phi: SX, C_c: SX) -> SX:
    """Return the force [N] of a jet along the closing edge, rho Q^2/(C_c A_o) cos(phi), 3.8, with Q = A_o u."""
    return rho * area * u**2 / C_c * cos(phi)


def with_sign(u: SX, u_small: SX) -> SX:
    """Return u |u|, of finite slope below about ``u_small``."""
    return u * sqrt(u**2 + u_small**2)
