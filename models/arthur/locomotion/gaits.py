"""Gait patterns (7.2.5): the phase lags of the legs, and the times that belong to them."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Gait:
    """A gait pattern.

    Attributes
    ----------
    lag : the legs' lead within the stride, Delta S_i in 0..1, for FL, FR, RL, RR. A stride begins with the stance.
    swing_time : T_sw [s].
    duty : share of stance in the stride; None: the stance time follows from step length and speed (7.6.3).
    inward : how far the feet tread inward of the hips [m].
    """

    lag: tuple[float, float, float, float]
    swing_time: float = 0.25
    duty: float | None = None
    inward: float = 0.0


GAITS = {
    "stand": Gait((0.0, 0.0, 0.0, 0.0)),
    "trot": Gait((0.0, 0.5, 0.5, 0.0)),
    "walk": Gait((0.5, 0.0, 0.75, 0.25), duty=0.75),
    "pace": Gait((0.0, 0.5, 0.0, 0.5), swing_time=0.15, duty=0.6, inward=0.08),
    "bound": Gait((0.0, 0.0, 0.5, 0.5), swing_time=0.15, duty=0.6),
}
"""Diagonal pairs, single feet (lateral sequence RL, FL, RR, FR), lateral pairs, front and rear pair.

The report names gaits without numbers. Assumed: a pace over the hips slips, since its support line is 0.11 m aside.
"""
