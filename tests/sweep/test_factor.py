"""Factors: ranges, lists, distributions and columns, by hand-written expectations and SciPy's own quantiles."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from arthur_acausal.errors import UsageError
from arthur_acausal.sweep.factor import parse_factor

HERE = Path(".")


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("1:3:3", (1.0, 2.0, 3.0)),
        ("150bar:250bar:3", ("150.0 bar", "200.0 bar", "250.0 bar")),
        ("150:250bar:3", ("150.0 bar", "200.0 bar", "250.0 bar")),
        ("1:2/step=0.5", (1.0, 1.5, 2.0)),
        ("0:1/step=0.1", tuple(k * 0.1 for k in range(11))),
        ("100bar:200bar/step=50bar", ("100.0 bar", "150.0 bar", "200.0 bar")),
        ("2:1/step=-0.5", (2.0, 1.5, 1.0)),
        ("5:5:1", (5.0,)),
        ("1e-6:1e-4:3/log", (1e-6, 1e-5, 1e-4)),
        ("0.1,0.3, 0.5", (0.1, 0.3, 0.5)),
        ("1 m/s:2 m/s:2", ("1.0 m/s", "2.0 m/s")),
        ("trot, walk", ("trot", "walk")),
        ("a.csv,b.csv:x", ("a.csv", "b.csv:x")),
        ("7", (7.0,)),
        (7, (7.0,)),
        (True, ("true",)),
        ([1, "2 bar", "none"], (1.0, "2.0 bar", "none")),
    ],
)
def test_values(text: object, values: tuple[object, ...]) -> None:
    found = parse_factor("x", text, HERE).values
    assert [type(a) for a in found] == [type(b) for b in values]
    for a, b in zip(found, values, strict=True):
        assert a == (pytest.approx(b, rel=1e-14) if isinstance(b, float) else b)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1:2:x", "no whole number"),
        ("1:2:0", "the count is 0"),
        ("1:2:3:4", "low:high:count"),
        ("1bar:2Pa:3", "a range in bar and Pa"),
        ("1:2/step=-1", "no step of -1 leads from 1 to 2"),
        ("1:2/step=0", "no step of 0"),
        ("-1:1:3/log", "logarithmic"),
        ("a:b:3", "'a' is no number"),
        ("norml(1, 2)", "there is no norml"),
        ("normal(1)", "takes 2 numbers"),
        ("normal(1, -2)", "the standard deviation is -2"),
        ("uniform(2, 1)", "do not rise"),
        ("loguniform(0, 1)", "above zero"),
        ("uniform(1 bar, 2 Pa)", "in Pa and bar"),
        ("csv(missing.csv:x)", "cannot be read"),
        ("csv(../secret.csv:x)", "is not inside of"),
        ("", "is no value"),
        ({"low": 1}, "is no value"),
    ],
)
def test_mistakes_are_told(text: object, message: str) -> None:
    with pytest.raises(UsageError, match=message) as caught:
        parse_factor("pump.D", text, HERE)
    assert "pump.D = " in str(caught.value)
    assert caught.value.remedy


def test_a_column_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "f.csv").write_text("a,b\n1,x\n2 bar,y\n")
    assert parse_factor("p", "csv(f.csv:a)", tmp_path).values == (1.0, "2.0 bar")
    assert parse_factor("p", "csv(f.csv:b)", tmp_path).values == ("x", "y")
    with pytest.raises(UsageError, match="no column 'c'"):
        parse_factor("p", "csv(f.csv:c)", tmp_path)


@pytest.mark.parametrize(
    ("text", "law"),
    [
        ("uniform(2, 5)", stats.uniform(2, 3)),
        ("2:5", stats.uniform(2, 3)),
        ("loguniform(1e-3, 10)", stats.loguniform(1e-3, 10)),
        ("1e-3:10/log", stats.loguniform(1e-3, 10)),
        ("normal(3, 0.5)", stats.norm(3, 0.5)),
        ("triangular(1, 2, 4)", stats.triang(1 / 3, 1, 3)),
    ],
)
def test_distributions_have_the_quantiles_that_scipy_says(text: str, law: Any) -> None:
    u = np.linspace(0.01, 0.99, 25)
    np.testing.assert_allclose(np.array(parse_factor("x", text, HERE).at(u), float), law.ppf(u), rtol=1e-12)


@given(u=st.lists(st.floats(0.0, 1.0, exclude_max=True), min_size=1), count=st.integers(1, 9))
def test_a_sample_of_values_is_one_of_them(u: list[float], count: int) -> None:
    factor = parse_factor("x", f"0:{count}:{count + 1}", HERE)
    assert set(factor.at(np.array(u))) <= set(factor.values)
