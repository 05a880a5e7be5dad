"""The search by which the pump's controllers are tuned, and what it has found."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from arthur_acausal.components.hydraulic import GPM
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.power_unit import PumpLaw
from arthur_acausal.models.arthur.pump_tuning import (
    PRICE,
    RANGES,
    Outcome,
    Range,
    Trial,
    best_of,
    search,
    tuned,
)


def bowl(parameters: dict[str, float]) -> Outcome:
    """Least, 10 W, at x = 0.3 and y = 20."""
    x, y = parameters["x"] - 0.3, math.log(parameters["y"] / 20.0)
    return Outcome(parameters, 10.0 + 100.0 * (x**2 + y**2), 0.0)


BEGIN = {"x": -0.5, "y": 900.0}
AXES = {"x": Range(-1.0, 1.0), "y": Range(1.0, 1e3, log=True)}


def test_the_search_finds_the_least_within_its_budget() -> None:
    outcomes = search(bowl, AXES, BEGIN, runs=60, seed=3)
    assert len(outcomes) == 60
    assert outcomes[0].parameters == pytest.approx(BEGIN)
    first = best_of(outcomes[:21])
    best = best_of(outcomes)
    assert best.cost < 0.5 * (first.cost - 10.0) + 10.0
    assert best.cost < 11.0
    for name, axis in AXES.items():
        values = np.array([o.parameters[name] for o in outcomes])
        assert values.min() >= axis.low
        assert values.max() <= axis.high
    again = search(bowl, AXES, BEGIN, runs=60, seed=3)
    assert [o.parameters for o in again] == [o.parameters for o in outcomes]


def test_the_first_third_is_a_latin_hypercube() -> None:
    places = [(o.parameters["x"] + 1.0) / 2.0 for o in search(bowl, AXES, BEGIN, runs=30)[1:11]]
    assert sorted(int(10 * place) for place in places) == list(range(10))


@cache
def demand() -> Demand:
    """0.3 s of a steady flow."""
    t = np.arange(0.0, 0.301, 0.002)
    t_plan = np.arange(0.0, 0.301, 0.01)
    plan = np.full((t_plan.size, 11), 0.5 * GPM)
    flow = np.full(t.size, 0.5 * GPM)
    return Demand(t, flow, flow, t_plan, plan, 1e5 * plan)


def test_a_constant_speed_costs_power_or_pressure() -> None:
    """Too slow, the pressure falls, at a price; too fast, the relief valve wastes."""
    trial = Trial("constant speed", demand())
    slow, right, fast = (trial({"w_0": w}) for w in (150.0, 290.0, 520.0))
    assert slow.power < right.power < fast.power
    assert slow.shortfall > 5e5 > right.shortfall >= fast.shortfall == 0.0
    assert slow.cost == slow.power + PRICE * slow.shortfall / 1e5
    assert right.cost < min(slow.cost, fast.cost)


def test_what_was_found_lies_within_the_ranges() -> None:
    """Of each controller that was tuned all parameters are there; the others keep their defaults."""
    found: dict[PumpLaw, dict[str, float]] = {law: tuned(law) for law in RANGES}
    assert found["foresight"] and found["pressure"]
    for law, values in found.items():
        assert not values or values.keys() == RANGES[law].keys()
        for name, value in values.items():
            assert RANGES[law][name].low * 0.999 <= value <= RANGES[law][name].high * 1.001
