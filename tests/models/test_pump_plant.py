"""The power unit fed with a recorded demand, by each of the pump's controllers."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from arthur_acausal import DeclarationError, Solution, SolverOptions, UsageError, translate
from arthur_acausal.components.hydraulic import GPM
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.power_unit import PowerUnit, PumpLaw
from arthur_acausal.models.arthur.predictive_control import Predictive
from arthur_acausal.models.arthur.pump_plant import PumpPlant, inputs_of
from benchmarks.prediction import timed

FloatArray = NDArray[np.float64]

LAWS: tuple[PumpLaw, ...] = (
    "constant speed",
    "pressure",
    "feed-forward",
    "foresight",
    "predictive",
    "predictive pressure",
    "clairvoyant",
)
HIGH, LOW = 0.7 * GPM, 0.2 * GPM


CONTROL = [
    *(0.01, 0.03, 0.3, 550.0, 135e5, 2e-9, 0.02, 0.2, 0.02, 15e5, 90e5),
    *(0.078, 0.0637, 0.165, 50.0, 1.2247, 1e-3, 3.17e-4, 1.77e-7, 1e12, 1.75e-7, 140e5, 44.4, 0.03, 3.8e-13),
]
"""Tuning and plant as the inputs of Predictive have them."""


def steps(t: FloatArray) -> FloatArray:
    """A flow that rises within 20 ms at 0.2 s, and falls at 0.5 s."""
    flow: FloatArray = np.interp(t, [0.0, 0.05, 0.2, 0.22, 0.5, 0.52], [0.0, LOW, LOW, HIGH, HIGH, LOW])
    return flow


@cache
def demand() -> Demand:
    """Steps of the flow, planned rightly; 60 bar are needed."""
    t, t_plan = np.arange(0.0, 0.7001, 0.002), np.arange(0.0, 0.7001, 0.01)
    plan = steps(t_plan[:, None] + 0.03 * np.arange(11.0))
    return Demand(t, steps(t), steps(t), t_plan, plan, np.full(plan.shape, 60e5))


@cache
def run(law: PumpLaw, horizon: float = 0.3) -> Solution:
    plant = translate(PumpPlant(demand=demand(), law=law))
    options = SolverOptions(rtol=1e-4, output_interval=0.002)
    return plant.simulate(0.7, inputs=inputs_of(demand()), parameters={"horizon": horizon}, options=options)


@pytest.mark.parametrize("law", LAWS)
def test_energy_and_limits(law: PumpLaw) -> None:
    """No energy is lost or made; current and voltage stay within what motor and battery can do; all flow is given."""
    solution = run(law)
    assert abs(solution.energy().closure) < 1e-3
    assert solution["unit.motor.I"].min() >= 0.0
    assert solution["unit.motor.I"].max() <= 50.0 + 1e-9
    assert (solution["unit.motor.V_t"] <= solution["unit.drive.V_bus"] + 1e-9).all()
    assert solution["load.missing"] == pytest.approx(np.zeros(solution.t.size), abs=1e-12)
    settled = solution.t > 0.1
    least = 70e5 if law == "predictive pressure" else 120e5
    assert solution["unit.manifold.p"][settled].min() > least


def test_a_load_without_pressure_gets_less() -> None:
    """It is not a source: at half of p_low half of the flow, at none nothing."""
    plant = translate(PumpPlant(demand=demand(), law="constant speed"))
    starved = plant.simulate(
        0.4, inputs=inputs_of(demand()), parameters={"Q_req": 0.25 * GPM}, options=SolverOptions(rtol=1e-4)
    )
    p = starved["load.port_a.p"] - starved["load.port_b.p"]
    low = p < 50e5
    assert low.any()
    assert p.min() > 0.0
    given = starved["load.port_a.q"][low] / starved["load.demand"][low]
    assert given == pytest.approx(p[low] / 50e5, rel=1e-6)


def test_a_demand_is_kept_in_a_file(tmp_path: Path) -> None:
    demand().save(tmp_path / "demand.npz")
    again = Demand.load(tmp_path / "demand.npz")
    assert again.q == pytest.approx(demand().q, rel=1e-6)
    assert again.plan_at(0.2)[0] == pytest.approx(steps(0.2 + 0.03 * np.arange(11.0)), rel=1e-6)
    begin = np.array([0.0, 0.3, 0.6])
    assert again.mean(begin, begin + 0.1) == pytest.approx([0.75 * LOW, HIGH, LOW], rel=1e-4)
    (tmp_path / "other.npz").write_bytes(b"PK something else")
    with pytest.raises(UsageError, match="holds no demand"):
        Demand.load(tmp_path / "other.npz")


def test_foresight_keeps_the_pressure() -> None:
    """A step of the flow that was seen to come costs less pressure than one that was not."""
    after = run("predictive").t > 0.15
    seen, unseen = (run("predictive", h)["unit.manifold.p"][after].min() for h in (0.3, 0.0))
    assert 135e5 - seen < 0.5 * (135e5 - unseen)


def test_a_pressure_that_is_not_needed_is_not_kept() -> None:
    """60 bar are needed, and a margin of 15: the floor of 90 bar decides; leakage and throttling go with it."""
    kept, free = run("predictive"), run("predictive pressure")
    late = free.t > 0.4
    assert free["unit.manifold.p"][late] == pytest.approx(np.full(late.sum(), 90e5), rel=0.1)
    ratio = {
        name: free.energy().losses_J[name] / kept.energy().losses_J[name] for name in ("load", "pump_leakage")
    }
    assert ratio["load"] < 0.85
    assert ratio["pump_leakage"] < 0.85


def test_a_law_travels_as_data() -> None:
    """What another process makes of its description computes the same voltages, to the last bit."""
    for free, known in ((True, None), (False, demand())):
        law = Predictive(30, free, known)
        again = Predictive.restore(json.loads(json.dumps(law.describe())))
        for k in range(3):
            given = np.array([300.0 + 10 * k, 130e5, 3e-5, *CONTROL, *[4e-5] * 11, *[80e5] * 11])
            assert law(0.01 * k, given) == again(0.01 * k, given)


def test_who_knows_is_given_what_it_knows() -> None:
    with pytest.raises(DeclarationError, match="given the demand that it knows"):
        translate(PowerUnit(law="clairvoyant"))
    with pytest.raises(DeclarationError, match="given the demand that it knows"):
        translate(PowerUnit(law="predictive", known=demand()))


def test_every_call_of_a_law_is_timed() -> None:
    call = Predictive.__call__
    with timed() as taken:
        run.__wrapped__("predictive")
    assert len(taken) == 71  # at 0, 10, ... 700 ms
    assert min(min(both) for both in taken) > 0.0
    assert Predictive.__call__ is call
