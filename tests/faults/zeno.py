"""A ball whose bounces close up to a point in time."""

from __future__ import annotations

from arthur_acausal import SimulationError, simulate
from arthur_acausal.models.examples.bouncing_ball import BouncingBall

ERROR = SimulationError
EXPECT = [r"t = 2\.55", r"h\b", r"remedy"]


def run() -> object:
    return simulate(BouncingBall(e=0.7), 3.0)
