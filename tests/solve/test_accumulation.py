"""Series of events that accumulate, and those that only look so."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import SimulationError, SolverOptions
from arthur_acausal.solve.accumulation import Accumulation


def watched(intervals: list[float]) -> None:
    """Note events with these intervals between them."""
    accumulation = Accumulation(1.0, SolverOptions())
    for t in np.cumsum([0.1, *intervals]).tolist():
        accumulation.add(t, "h < 0")


@pytest.mark.parametrize("share", [0.9, 0.5, 0.02])
def test_a_geometric_series_accumulates(share: float) -> None:
    with pytest.raises(SimulationError, match=r"accumulate at t = 0\..*Zeno.*h < 0"):
        watched((0.05 * share ** np.arange(300)).tolist())


def test_two_events_that_happen_to_be_near_do_not() -> None:
    watched([4e-4, 3e-4, 2e-4, 1e-4, 6e-5, 9e-13, 5e-4])
