"""End values of problems as text: the test set's problems, the measure that a case states, and what text may say."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from arthur_acausal import translate
from benchmarks.end_values import Measure, at_end, end_values, solve
from benchmarks.text_problem import problem, value_of
from tests.benchmarks.ivp_cases import (
    FLOORED,
    Case,
    case,
    medical_akzo,
    oregonator,
    pleiades,
    pollution,
    van_der_pol,
    water_tubes,
)

PROBLEMS = (van_der_pol, oregonator, pollution, pleiades, water_tubes)


@pytest.mark.parametrize("given", [make() for make in PROBLEMS], ids=lambda given: given["name"])
def test_problems_of_the_test_set_end_at_its_reference(given: Case) -> None:
    error, why = end_values(given, Path())
    assert error < given["required"]["value"], why


def test_water_tubes_sum_up_in_their_nodes() -> None:
    translation = translate(problem(water_tubes()), check_units=False)
    assert translation.report.index == 2
    solution = translation.simulate(17 * 3600.0)
    inflow, out = solution["q1_2"], solution["q2_3"] + solution["q2_6"]
    np.testing.assert_allclose(inflow, out, rtol=1e-12, atol=1e-15)
    # the flow that the test set prints as 0.2298848296477430e-2
    assert solution.final("q1_2") == pytest.approx(1.188984650746585e-3 + 1.109503645730845e-3, rel=1e-5)


def test_a_stiff_decay_over_eleven_decades_keeps_relative_accuracy() -> None:
    """Robertson: y1 ends at 2e-8 and y2 at 8e-14, by the test set's reference."""
    robertson = case(
        "rober",
        {"k1": 0.04, "k2": 3e7, "k3": 1e4},
        {"y1": 1.0, "y2": 0.0, "y3": 0.0},
        ["der(y1)-(-k1*y1+k3*y2*y3)", "der(y2)-(k1*y1-k3*y2*y3-k2*y2**2)", "y1+y2+y3-1"],
        {"y1": 2.083340149701255e-08, "y2": 8.333360770334713e-14, "y3": 0.999999979166505},
        t_end=1e11,
        required=1e-5,
    )
    assert end_values(robertson, Path())[0] < 2e-6


def test_a_supply_that_ends_makes_an_event() -> None:
    """Medical Akzo Nobel with 8 cells, against SciPy's Radau on both sides of the jump at 5 min."""
    cells = 8
    given = medical_akzo(cells)
    given["reference"]["values"] = {f"u{j}": 0.0 for j in range(1, cells + 1)}
    values, _ = solve(given, Measure.of(given), 1e-7)

    z = np.arange(1, cells + 1) / cells
    alpha, beta = 2 * (z - 1) ** 3 / 16, (z - 1) ** 4 / 16

    def rates(supply: float, y: np.ndarray) -> np.ndarray:
        u, v = y[:cells], y[cells:]
        left, right = np.concatenate([[supply], u[:-1]]), np.concatenate([u[1:], [0.0]])
        reaction = 100.0 * u * v
        change = beta * (left - 2 * u + right) * cells**2 + alpha * (right - left) * cells / 2 - reaction
        return np.concatenate([change[:-1], [-reaction[-1]], -reaction])

    y = np.concatenate([np.zeros(cells), np.ones(cells)])
    for begin, end, supply in ((0.0, 5.0, 2.0), (5.0, 20.0, 0.0)):
        run = solve_ivp(lambda t, y, s=supply: rates(s, y), (begin, end), y, "Radau", rtol=1e-9, atol=1e-14)
        y = run.y[:, -1]
    np.testing.assert_allclose(
        [values[f"u{j}"] for j in range(1, cells + 1)], y[:cells], rtol=1e-6, atol=1e-9
    )


MEASURES: list[tuple[str, dict[str, Any], Measure]] = [
    ("largest relative error of a component at t_end", {}, Measure(["a", "b", "lam"])),
    ("absolute error of each reference value", {}, Measure(["a", "b", "lam"], absolute=True)),
    ("largest error of the two positions, relative to max(|reference|, 1e-3)", {}, Measure(["a", "b"], 1e-3)),
    ("largest error of positions, relative to max(|reference|, 0.5)", {}, Measure(["a", "b"], 0.5)),
    (FLOORED, {"scored": ["b"]}, Measure(["b"], 1e-3, share=True)),
]


@pytest.mark.parametrize(("text", "more", "measure"), MEASURES)
def test_the_measure_is_read(text: str, more: Mapping[str, Any], measure: Measure) -> None:
    values = {"a": 1.0, "b": 0.0, "lam": 4.0}
    given = {"reference": {"values": values, **more}, "required": {"measure": text, "value": 1.0}}
    assert Measure.of(given) == measure


def test_errors_are_relative_to_what_the_measure_names() -> None:
    reference = {"a": 2.0, "b": 0.0, "c": 1e-9}
    values = {"a": 2.2, "b": 1e-4, "c": 2e-9}
    cases = [
        (Measure(["a", "b"]), 0.1, "a"),
        (Measure(["a", "b", "c"]), 1.0, "c"),
        (Measure(["b", "c"], 1e-3, share=True), 0.05, "b"),
        (Measure(["a", "c"], absolute=True), 0.2, "a"),
    ]
    for measure, error, worst in cases:
        found = measure.error(values, reference)
        assert found[0] == pytest.approx(error)
        assert found[1] == worst


def test_what_happens_right_at_the_end_is_not_scored() -> None:
    given = case(
        "jump",
        {},
        {"x": 0.0, "y": 0.0},
        ["der(x) = 1", "y = x if t < 1 else 7"],
        {},
        t_end=1.0,
        required=1e-6,
    )
    solution = translate(problem(given), check_units=False).simulate(1.0)
    assert at_end(solution, "y") == pytest.approx(1.0)


def test_names_that_are_none_in_python_and_definitions_in_any_order() -> None:
    given = case(
        "names",
        {"b": "2*a", "a": 0.5},
        {"lambda": 1.0, "x[1]": "lambda", "x_1": 0.0, "equations": 0.0},
        [
            "der(lambda) = -rate",
            "der(x[1]) = -2*x[1]",
            "x_1 = mod(t, 1) + sign(x[1])",
            "der(equations) = x[1]",
        ],
        {},
        t_end=0.75,
        required=1e-6,
        definitions=[("rate", "twice^2*b/4"), ("twice", "2*sqrt(lambda)")],
    )
    solution = translate(problem(given), check_units=False).simulate(0.75, tolerance=1e-9)
    assert solution.final("x_1") == pytest.approx(1.75)
    assert solution.final("v_lambda") == pytest.approx(math.exp(-0.75), rel=1e-7)
    assert solution.final("v_equations") == pytest.approx((1 - math.exp(-1.5)) / 2, rel=1e-7)


@pytest.mark.parametrize(
    ("text", "value"),
    [("-7 % 3", 2.0), ("mod(7, 3)", 1.0), ("sign(-2) + heaviside(3)", 0.0), ("2^3^2", 512.0)],
)
def test_functions_of_numbers(text: str, value: float) -> None:
    assert float(value_of(text, {})) == value
