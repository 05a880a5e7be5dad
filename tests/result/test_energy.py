"""The energy audit, on terms that are known in closed form."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from arthur_acausal.errors import ResultError
from arthur_acausal.result.run import Run
from arthur_acausal.result.solution import Solution
from arthur_acausal.result.variable import Variable
from tests.result.sample import Table

TERMS = {
    "input": ["source.E"],
    "losses": {"copper": ["motor.P_copper"], "valves": ["valves[*].E"]},
    "work": ["-load.E"],
    "stored": ["spring.E"],
}


def solution(audit: Mapping[str, Any]) -> Solution:
    """10 J go in: 3 J copper, 2 valves of 1 J, 4 J to the load (counted as negative there), 1 J stays."""
    t = np.linspace(0.0, 2.0, 201)
    columns = {
        "source.E": 5.0 + 5.0 * t,
        "motor.P_copper": 1.5 * t,
        "valves[0].E": 0.5 * t,
        "valves[1].E": t - 0.5 * t,
        "load.E": -2.0 * t,
        "spring.E": 7.0 + 0.25 * t**2,
        "load.f": t,
    }
    units = {path: "W" if "P_" in path else "N" if path == "load.f" else "J" for path in columns}
    return Solution(Table(t, columns, {p: Variable(p, u) for p, u in units.items()}), Run(audit=audit))


def test_terms_and_closure() -> None:
    energy = solution(TERMS).energy()
    assert energy.input_J == pytest.approx(10.0)
    assert energy.losses_J == {"copper": pytest.approx(3.0), "valves": pytest.approx(2.0)}
    assert energy.work_J == pytest.approx(4.0)
    assert energy.stored_J == pytest.approx(1.0)
    assert energy.closure == pytest.approx(0.0, abs=1e-12)


def test_a_term_left_out_shows_in_the_closure() -> None:
    energy = solution(TERMS | {"stored": []}).energy()
    assert energy.closure == pytest.approx(0.1)


def test_without_input_the_closure_is_relative_to_all_terms() -> None:
    energy = solution({"losses": {"valves": ["valves[0].E"]}, "stored": ["spring.E"]}).energy()
    assert energy.closure == pytest.approx(-1.0)
    assert solution({"input": []}).energy().closure == 0.0


def test_a_model_without_audit() -> None:
    with pytest.raises(ResultError, match="has no energy audit"):
        solution({}).energy()


def test_terms_must_be_energies_or_powers() -> None:
    with pytest.raises(ResultError, match=r"load\.f in the energy audit is in N"):
        solution({"input": ["load.f"]}).energy()


def test_json_has_the_agreed_keys() -> None:
    assert list(solution(TERMS).energy().as_dict()) == [
        "input_J",
        "losses_J",
        "work_J",
        "stored_J",
        "closure",
    ]
