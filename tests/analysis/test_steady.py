"""States of rest against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import InitializationError, translate
from arthur_acausal.models.examples.accumulator_charge import AccumulatorCharge
from arthur_acausal.models.examples.jack import Jack
from tests.analysis.systems import Coupled, Oscillator, Rocket, Shaft, Tank


def test_oscillator_rests_where_spring_and_force_balance() -> None:
    rest = translate(Oscillator()).steady_state(inputs={"f": 20.0}, parameters={"k": 40.0})
    assert rest["x"] == pytest.approx(0.5, rel=1e-12)
    assert rest["v"] == pytest.approx(0.0, abs=1e-12)
    assert not rest.free and not rest.drifts and rest.method == "Newton"


def test_a_turning_shaft_is_at_rest_but_for_its_angle() -> None:
    rest = translate(Shaft()).steady_state()
    assert rest["w"] == pytest.approx(6.0, rel=1e-12)
    assert rest.free == ["phi"] and rest["phi"] == 0.25
    assert rest.drifts == pytest.approx({"phi": 6.0}, rel=1e-12)


def test_discs_turn_together() -> None:
    rest = translate(Coupled()).steady_state()
    assert rest["v"] == pytest.approx(2.0, rel=1e-9) and rest["w"] == pytest.approx(2.0, rel=1e-9)
    assert np.sin(rest["a"] - rest["b"]) == pytest.approx(0.2, rel=1e-9)
    assert rest.drifts == pytest.approx({"a": 2.0, "b": 2.0}, rel=1e-9)


def test_a_mass_without_force_keeps_its_speed() -> None:
    rest = translate(Rocket(f=0.0)).steady_state()
    assert rest["v"] == pytest.approx(2.0, rel=1e-6) and rest.drifts == pytest.approx({"x": 2.0}, rel=1e-6)
    assert rest.free == ["x", "v"]


def test_what_accelerates_for_ever_has_none() -> None:
    with pytest.raises(InitializationError, match=r"no steady state.*\"acceleration\" \(systems.py:\d+\)"):
        translate(Rocket()).steady_state()


def test_a_relation_changes_on_the_way() -> None:
    rest = translate(Tank()).steady_state()
    h = rest["h"]
    assert h > 0.5 and 2e-3 == pytest.approx(1e-3 * h**0.5 + 1e-2 * (h - 0.5), rel=1e-9)


def test_accumulator_is_charged_up_to_the_relief_valve() -> None:
    translation = translate(AccumulatorCharge())
    rest = translation.steady_state()
    run = translation.simulate(2000.0, tolerance=1e-9)
    assert rest.method == "pseudo-transient"  # at the start the accumulator takes all: it only seems free
    assert rest["accumulator.p"] == pytest.approx(run.final("accumulator.p"), rel=1e-6)


def test_jack_rises_steadily() -> None:
    translation = translate(Jack())
    rest = translation.steady_state()
    run = translation.simulate(0.5, tolerance=1e-9)
    assert rest.drifts == pytest.approx({"load.s": run.final("load.v")}, rel=1e-6)
    assert rest["ram.p"] == pytest.approx(4905.0 / 1e-3, rel=1e-9)


def test_a_run_begins_at_rest() -> None:
    solution = translate(Shaft()).simulate(2.0, steady=True)
    assert solution["w"] == pytest.approx(6.0, rel=1e-12)
    assert solution["phi"] == pytest.approx(0.25 + 6.0 * np.asarray(solution.t), rel=1e-9)
    told = solution.statistics.messages
    assert told == ["at rest, but these move on steadily: phi (by 6 a second)"]
