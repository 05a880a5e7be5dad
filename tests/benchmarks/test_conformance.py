"""The conformance benchmark: text that is read and text that is refused, the tube, and chains of any size."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm

from arthur_acausal import SolverOptions, translate
from benchmarks.chains import Oscillator
from benchmarks.conformance import out_of_tube
from benchmarks.text_problem import TextError, problem, value_of


@pytest.mark.parametrize(
    ("text", "value"),
    [("2*x**2 - 1", 17.0), ("-sqrt(x + 1)/2", -1.0), ("1.5e-3", 0.0015), ("sin(pi/2) + abs(-x)", 4.0)],
)
def test_arithmetic_is_read(text: str, value: float) -> None:
    assert float(value_of(text, {"x": 3.0, "pi": math.pi})) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os')",
        "x.real",
        "(lambda: 1)()",
        "[1][0]",
        "y",
        "print(x)",
        "x if x else 1",
        "1 +",
        "sqrt(x, **{})",
    ],
)
def test_anything_else_is_refused(text: str) -> None:
    with pytest.raises(TextError):
        value_of(text, {"x": 3.0})


def test_the_tube_forgives_an_edge_but_not_an_offset() -> None:
    t = np.linspace(0.0, 1.0, 5001)
    step = (t > 0.5).astype(float)
    late = (t > 0.501).astype(float)
    assert out_of_tube(t, step, t, late) == 0.0
    assert out_of_tube(t, step, t, (t > 0.51).astype(float)) > 0.0
    assert out_of_tube(t, step, t, step + 2e-3) > 0.99


def test_a_long_network_of_springs_keeps_its_accuracy() -> None:
    n = 60
    solution = translate(Oscillator(N=n, network=True)).simulate(2.0, options=SolverOptions(rtol=1e-9))
    nodes = 3.0 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)  # of the massless nodes, over k
    stiffness = 10.0 * (np.eye(n) - np.linalg.inv(nodes))
    system = np.block([[np.zeros((n, n)), np.eye(n)], [-stiffness, np.zeros((n, n))]])
    start = np.zeros(2 * n)
    start[0] = n
    expected = expm(2.0 * system) @ start
    got = [solution.final(f"masses[{k}].s") for k in range(n)]
    np.testing.assert_allclose(got, expected[:n], rtol=0.0, atol=1e-6 * n)


def test_a_case_from_a_folder_and_one_without_a_model(tmp_path: Path) -> None:
    case = {
        "name": "ivp_decay",
        "format": "eqjson-1",
        "parameters": {"k": 2.0},
        "variables": ["x", "y"],
        "definitions": [["rate", "k*x"]],
        "equations": ["der(x) + rate", "y - x**2"],
        "y0": {"x": 1.0, "y": "1.0"},
        "t0": 0.0,
        "t_end": 1.0,
        "reference": {"values": {"x": math.exp(-2.0), "y": math.exp(-4.0)}},
        "required": {"measure": "largest relative error of a component at t_end", "value": 1e-8},
    }
    unknown = {"name": "unknown", "required": {"measure": "any", "value": 1.0}}
    for content in (case, unknown):
        folder = tmp_path / str(content["name"])
        folder.mkdir()
        (folder / "case.json").write_text(json.dumps(content))
    command = [sys.executable, "-m", "benchmarks.conformance", "--cases", str(tmp_path), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    assert (found["passed"], found["total"]) == (1, 2)
    assert found["cases"][0]["pass"] and found["cases"][0]["error"] < 1e-8
    assert found["cases"][1] == {
        "name": "unknown",
        "error": None,
        "required": 1.0,
        "pass": False,
        "why": "not built",
    }


def test_conditionals_and_extremes_of_numbers() -> None:
    names = {"x": 3.0, "t": 0.5}
    assert value_of("1 if x < 2 else 5", names) == 5.0
    assert value_of("where(0 < t <= 1 and not x < 2, x, 0)", names) == 3.0
    assert value_of("max(x, 1, 7) - min(x, t)", names) == 6.5
    for text in "x if x else 1", "max()", "sin(x, t)", "True", "x if __import__('os') < 1 else 2", "x == 3":
        with pytest.raises(TextError):
            value_of(text, names)


def test_a_problem_with_a_condition_on_time_and_starts_in_any_order() -> None:
    case = {
        "name": "pulse",
        "parameters": {"T": 0.5, "h": "2*T"},
        "variables": ["x", "y"],
        "definitions": [["u", "h if t < T else 0"], ["w", "x + y"]],
        "equations": ["der(x) = u", "y == 2*x + (1 if x >= 10 else 0)"],
        "y0": {"y": "2*x", "x": "h - 1"},
        "t0": 0.0,
    }
    solution = translate(problem(case), check_units=False).simulate(2.0)
    assert solution.final("x") == pytest.approx(0.5)
    assert solution.final("y") == pytest.approx(1.0)
