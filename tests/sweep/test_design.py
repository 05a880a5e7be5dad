"""The table of runs: combinations counted, samples repeatable, prefixes kept; expressions and files read safely."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import qmc

from arthur_acausal.errors import UsageError
from arthur_acausal.sweep.derived import compute
from arthur_acausal.sweep.design import runs, unit_samples
from arthur_acausal.sweep.specification import differences, from_mapping, from_toml

HERE = Path(".")


def values(**given: Any) -> list[dict[str, Any]]:
    return [dict(run.values) for run in runs(from_mapping({"model": "m", "stop_time": 1.0, **given}), HERE)]


def test_a_grid_has_every_combination_the_last_factor_fastest() -> None:
    found = values(vary={"a": "1,2", "b": "3,4,5"})
    assert [(v["a"], v["b"]) for v in found] == [(1, 3), (1, 4), (1, 5), (2, 3), (2, 4), (2, 5)]


def test_zip_takes_them_side_by_side() -> None:
    assert values(vary={"a": "1,2", "b": "3,4"}, method="zip") == [{"a": 1, "b": 3}, {"a": 2, "b": 4}]
    with pytest.raises(UsageError, match="a has 2, b has 3"):
        values(vary={"a": "1,2", "b": "3,4,5"}, method="zip")


def test_a_group_in_a_grid_is_one_axis() -> None:
    found = values(vary={"a": "1,2", "c": "7,8", "b": "3,4"}, zip=[["a", "b"]])
    assert found == [{"a": a, "c": c, "b": b} for a, b in ((1, 3), (2, 4)) for c in (7, 8)]


def test_replicates_get_seeds() -> None:
    found = values(vary={"a": "1,2"}, seed=5, replicates={"count": 2, "parameter": "noise.seed"})
    assert [(v["a"], v["noise.seed"]) for v in found] == [(1, 5), (1, 6), (2, 5), (2, 6)]


def test_without_factors_there_is_one_run() -> None:
    assert values() == [{}]


@pytest.mark.parametrize("method", ["random", "sobol"])
def test_further_samples_leave_the_earlier_ones(method: str) -> None:
    few, many = (
        values(vary={"a": "0:1", "b": "normal(0, 1)"}, method=method, samples=n, seed=3) for n in (5, 37)
    )
    assert many[:5] == few


@pytest.mark.parametrize("method", ["random", "lhs", "sobol"])
def test_samples_repeat_by_seed_and_fill_the_cube(method: str) -> None:
    a = unit_samples(method, 3, 64, 1)
    np.testing.assert_array_equal(a, unit_samples(method, 3, 64, 1))
    assert not np.array_equal(a, unit_samples(method, 3, 64, 2))
    assert np.all((a >= 0.0) & (a < 1.0))
    if method == "lhs":  # one in each of 64 slices of every axis
        assert all(len(set(np.floor(64 * a[:, k]).astype(int))) == 64 for k in range(3))
    if method == "sobol":
        assert qmc.discrepancy(a) < 0.5 * qmc.discrepancy(unit_samples("random", 3, 64, 1))


def test_a_distribution_in_a_grid_is_refused() -> None:
    with pytest.raises(UsageError, match="a is a distribution"):
        values(vary={"a": "uniform(1, 2)"})


TOML = """model = "examples.jack"
stop_time = "0.2 s"
method = "grid"

[vary]
"load.m" = "100:300:3"

[output]
interval = "20 ms"
reductions = ["max(ram.p)"]
"""


def test_toml_is_read(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(TOML)
    found = from_toml(tmp_path / "s.toml")
    assert (found.stop_time, found.output.interval, found.models) == (0.2, 0.02, ("examples.jack",))
    assert from_mapping(found.to_object()) == found


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ('method = "grid"', 'method = "gird"', 3, "method: Input should be 'grid'"),
        ('method = "grid"', 'methodd = "grid"', 3, "did you mean method"),
        ("interval =", "intervall =", 9, "output.intervall: there is no such key"),
        ('"0.2 s"', '"-1 s"', 2, "stop_time"),
        ('"0.2 s"', '"1 bar"', 0, "stop_time"),
        ('"100:300:3"', "{ low = 1 }", 6, "vary.load.m"),
        ('model = "examples.jack"\n', "", 0, "the key models is missing"),
        ('method = "grid"', 'method = "sobol"', 0, "needs samples"),
        ("[vary]", "[vary", 0, "not valid TOML"),
    ],
)
def test_a_mistake_in_toml_names_line_and_key(
    tmp_path: Path, old: str, new: str, line: int, message: str
) -> None:
    assert old in TOML
    (tmp_path / "s.toml").write_text(TOML.replace(old, new))
    with pytest.raises(Exception, match=message) as caught:
        from_toml(tmp_path / "s.toml")
    assert "s.toml" in str(caught.value) or "stop_time" in str(caught.value)
    if line:
        assert f"s.toml:{line}" in str(caught.value)


def test_differences_name_keys() -> None:
    assert differences({"a": 1, "b": {"c": 2}}, {"a": 1, "b": {"c": 3}, "d": 4}) == [
        "b.c: 2 there, 3 now",
        "d: None there, 4 now",
    ]


def test_derived_values_are_arithmetic() -> None:
    known = {"relief.x": 3.0, "valves[0].K": 2.0}
    assert compute("2*relief.x**2 + sqrt(valves[0].K) - pi", known) == pytest.approx(
        18 + 2**0.5 - np.pi, rel=1e-15
    )


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os').system('true')",
        "().__class__",
        "relief.x.__class__",
        "[1]",
        "lambda: 1",
        "relief.x if 1 else 2",
        "1/0",
        "10.0**1000",
        "(-1)**0.5",
        "log(-1)",
        "relief.y",
        "min()",
        "1 +",
        "True",
    ],
)
def test_anything_else_is_refused(text: str) -> None:
    with pytest.raises(UsageError):
        compute(text, {"relief.x": 3.0})
