"""Values between the stored times."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.errors import ResultError

FloatArray = NDArray[np.float64]
Side = Literal["left", "right"]


def interpolate(
    t: FloatArray,
    x: FloatArray,
    tau: FloatArray,
    *,
    slope: FloatArray | None = None,
    held: bool = False,
    side: Side = "right",
) -> FloatArray:
    """Interpolate samples at the times ``tau``, never across an event.

    Parameters
    ----------
    t, x : times (nt,), ascending, and values (nt,); a time that stands twice is an event, with the values
        before and after it.
    tau : times wanted, any shape, within [t[0], t[-1]].
    slope : dx/dt (nt,): cubic Hermite interpolation; without it linear.
    held : keep the value of the last stored time, as a discrete variable does.
    side : which value an event itself gives, the one before ("left") or after it ("right").

    Raises
    ------
    ResultError
        Where a time lies outside or is not finite.
    """
    check_times(t, tau)
    start = t.searchsorted(tau, side="right") - 1
    if side == "left":
        start = np.where(np.isin(tau, t), t.searchsorted(tau, side="left"), start)
    stop = np.minimum(start + 1, t.size - 1)
    on_sample = t[start] == tau
    if held:
        return x[start]
    with np.errstate(invalid="ignore", divide="ignore"):
        # an infinite sample makes its neighbours' interval not a number, and only that
        step = np.where(on_sample, 1.0, t[stop] - t[start])
        s = np.where(on_sample, 0.0, (tau - t[start]) / step)
        if slope is None:
            between = x[start] + s * (x[stop] - x[start])
        else:
            between = hermite(s, step, x[start], x[stop], slope[start], slope[stop])
    return np.where(on_sample, x[start], between)


def hermite(
    s: FloatArray, step: FloatArray, x0: FloatArray, x1: FloatArray, d0: FloatArray, d1: FloatArray
) -> FloatArray:
    """Cubic on one interval from both ends' values and slopes; ``s`` in [0, 1]."""
    r = 1.0 - s
    return x0 * (1.0 + 2.0 * s) * r**2 + x1 * s**2 * (3.0 - 2.0 * s) + step * s * r * (d0 * r - d1 * s)


def check_times(t: FloatArray, tau: FloatArray) -> None:
    """Refuse times outside the stored ones."""
    inside = (tau >= t[0]) & (tau <= t[-1])
    if not np.all(inside):
        worst = np.asarray(tau)[~inside].flat[0]
        raise ResultError(
            f"time {worst:g} s lies outside the solution, which goes from {t[0]:g} s to {t[-1]:g} s",
            remedy="ask for a time within, or simulate longer",
        )
