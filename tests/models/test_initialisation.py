"""Initial values of the powertrain from a part of the benchmark's seeded start states, and what they must fulfil."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import Translation, translate
from arthur_acausal.models.arthur.powertrain import Powertrain
from arthur_acausal.solve.simulate import initial_point
from benchmarks.initialisation import RANGES, SEED, STATES, drawn, run, start_states

COUNTS = {"given": 13, "free pressures": 6, "steady": 6}


@pytest.fixture(scope="module")
def given() -> Translation:
    return translate(Powertrain(audit=False))


@pytest.fixture(scope="module")
def balanced() -> Translation:
    return translate(Powertrain(audit=False, balanced=True))


@pytest.mark.parametrize("kind", STATES)
def test_start_states_are_initialised(kind: str, given: Translation, balanced: Translation) -> None:
    outcome = run(kind, balanced if kind == "free pressures" else given, COUNTS[kind])
    assert outcome.failures == [] and outcome.found == COUNTS[kind]


def test_start_states_are_the_same_every_time_and_within_their_ranges(given: Translation) -> None:
    states = [s for s, _ in start_states(given, 5, np.random.default_rng(SEED))]
    again = [s for s, _ in start_states(given, 5, np.random.default_rng(SEED))]
    assert states == again and states[0] != states[1]
    assert set(given.report.states) - set(states[0]) == {"motor.phi"}
    low, high = RANGES[".p_A"]
    assert all(low <= s["cylinders[3].p_A"] <= high for s in states)


def test_free_pressures_bring_the_pistons_into_balance(balanced: Translation) -> None:
    """The chambers' forces, by the areas of the report, carry the load; one chamber keeps its start value."""
    random = np.random.default_rng(3)
    (start, inputs) = next(start_states(balanced, 1, random))
    start |= drawn(["cylinders[0].v"], {".v": (0.0, 0.0)}, random)
    point = initial_point(balanced.dae, stop_time=1.0, start=start, inputs=inputs)
    y = dict(zip(balanced.dae.y_paths, point.y[0].tolist(), strict=True))
    force = y["cylinders[0].p_A"] * 7.13e-5 - y["cylinders[0].p_B"] * 5.35e-5
    assert force == pytest.approx(inputs["loads[0].F"], rel=1e-9)  # a load is positive against the piston
    kept = [k for k in ("p_A", "p_B") if y[f"cylinders[0].{k}"] == start[f"cylinders[0].{k}"]]
    assert len(kept) == 1
    assert any(f"cylinders[0].{kept[0]}" in m or "more" in m for m in point.statistics.messages)


def test_a_run_that_begins_in_the_steady_state_stays_there(given: Translation) -> None:
    start, inputs = next(start_states(given, 1, np.random.default_rng(5)))
    solution = given.simulate(0.2, start=start, inputs=inputs, steady=True)
    assert solution.statistics.initial_method == "rest by pseudo-transient"
    for path in ("motor.w", "manifold.p", "reservoir.p", "cylinders[4].p_A", "cylinders[4].y"):
        values = solution[path]
        assert np.ptp(values) <= 1e-4 * np.max(np.abs(values)), path
    assert any("move on steadily: motor.phi" in m for m in solution.statistics.messages)
