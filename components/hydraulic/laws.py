"""Laws that several hydraulic components use."""

from __future__ import annotations

from casadi import SX, fabs, fmax, fmin, log, sign, sqrt

from arthur_acausal import if_else, smooth_if_else


def turbulent_root(dp: SX, dp_small: SX) -> SX:
    """Return sign(dp) sqrt|dp| [Pa^0.5], made linear within about ``dp_small`` [Pa] of zero.

    There the flow of an orifice is laminar (Merritt 1967, ch. 3). Odd in dp and increasing, so an
    orifice that follows it is passive; the relative difference to the root is (dp_small/dp)^2/4 where dp is
    large.
    """
    return dp / sqrt(sqrt(dp**2 + dp_small**2))


def exact_root(dp: SX, dp_slope: SX) -> SX:
    """Return sign(dp) sqrt|dp| [Pa^0.5] exactly.

    Its slope at dp = 0 is infinite; there the derivative is that of the chord from 0 to ``dp_slope`` [Pa].
    """
    return smooth_if_else(fabs(dp) > 0, sign(dp) * sqrt(fabs(dp)), dp / sqrt(dp_slope))


def clamp(x: SX, lower: SX | float, upper: SX | float) -> SX:
    """Return ``x`` limited to ``lower`` and ``upper``."""
    return fmin(fmax(x, lower), upper)


def stop_force(x: SX, lower: SX | float, upper: SX | float, k: SX, events: bool) -> SX:
    """Return the force [N] of two elastic stops ``k`` [N/m] on a body at ``x`` [m] (report, eq. 5.49, 5.69).

    F = -k (x - limit) beyond a limit, at both ends (the report's code; its eq. 5.49 has the sign of one
    wrong). Continuous, so without ``events`` the integrator's error control finds the kink.
    """
    if events:
        return if_else(x < lower, -k * (x - lower), if_else(x > upper, -k * (x - upper), 0))
    return -k * (fmin(x - lower, 0) + fmax(x - upper, 0))


def stop_energy(x: SX, lower: SX | float, upper: SX | float, k: SX) -> SX:
    """Return the elastic energy [J] in the two stops of ``stop_force``."""
    return k * (fmin(x - lower, 0) ** 2 + fmax(x - upper, 0) ** 2) / 2


def gas_energy(p_0: SX, V_0: SX, V: SX, n: SX) -> SX:
    """Return the work [J] done on a gas from ``V_0`` at ``p_0`` to ``V`` [m^3], along p V^n = const.

    For n = 1 (isothermal) this is the work that it can give back, its heat being exchanged with the
    surroundings.
    """
    ratio = V_0 / V
    isothermal = log(ratio)
    polytropic = (ratio ** (n - 1) - 1) / (n - 1)
    return p_0 * V_0 * smooth_if_else(fabs(n - 1) < 1e-9, isothermal, polytropic)
