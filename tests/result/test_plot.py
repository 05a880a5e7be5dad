"""Pictures: what is in which panel, in which unit, and what is written."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from arthur_acausal.errors import ResultError, UnitError
from arthur_acausal.result.display import display_unit, labelled, pretty_unit
from arthur_acausal.result.panel import MOST_LINES
from arthur_acausal.result.run import Run
from arthur_acausal.result.solution import Solution
from arthur_acausal.result.variable import Variable
from tests.result.sample import Table, bounce


def labels(figure: Figure) -> list[str]:
    return [ax.get_ylabel() for ax in figure.axes]


def test_one_panel_for_each_unit_as_people_read_it() -> None:
    figure = bounce().plot(["ball.?", "valves[*].port_a.p", "größe.ω"])
    assert labels(figure) == [
        "height [m]",
        "velocity [km/h]",
        "gravity [m/s²]",
        "pressure at port a [bar]",
        "ω [rpm]",
    ]
    pressure = figure.axes[3].lines[1]
    np.testing.assert_allclose(np.asarray(pressure.get_ydata()), bounce()["valves[1].port_a.p"] / 1e5)
    assert pressure.get_label() == "valves[1].port_a.p"


def test_different_variables_of_one_unit_are_named_by_the_quantity() -> None:
    assert labels(bounce().plot(["ball.h", "floor.gap"])) == ["length [m]"]


def test_lines_differ_in_colour_and_in_style() -> None:
    t = np.array([0.0, 1.0])
    paths = [f"x[{i}]" for i in range(MOST_LINES)]
    solution = Solution(Table(t, {p: t for p in paths}, {p: Variable(p) for p in paths}))
    lines = solution.plot("x[*]").axes[0].lines
    assert len({(line.get_color(), line.get_linestyle()) for line in lines}) == MOST_LINES
    assert all(
        a.get_color() != b.get_color() and a.get_linestyle() != b.get_linestyle() for a, b in pairwise(lines)
    )


def test_too_many_lines_are_refused() -> None:
    t = np.array([0.0, 1.0])
    paths = [f"x[{i}]" for i in range(MOST_LINES + 1)]
    solution = Solution(Table(t, {p: t for p in paths}, {p: Variable(p) for p in paths}))
    with pytest.raises(ResultError, match="too many for one picture"):
        solution.plot("x[*]")


@pytest.mark.parametrize(("name", "start"), [("x.png", b"\x89PNG"), ("x.PDF", b"%PDF"), ("x.svg", b"<?xml")])
def test_the_format_follows_from_the_name(tmp_path: Path, name: str, start: bytes) -> None:
    bounce().plot("ball.h", tmp_path / name)
    assert (tmp_path / name).read_bytes().startswith(start)


@pytest.mark.parametrize("name", ["x", "x.txt", "x.nc"])
def test_other_formats_are_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ResultError, match=r"end the name in \.png, \.pdf, \.svg"):
        bounce().plot("ball.h", tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_panels_that_are_asked_for() -> None:
    figure = bounce().plot(
        {
            "supply [MPa]": {"first": "valves[0].port_a.p"},
            "currents [mA]": "valves[*].I",
            "own drawing [W]": (),
            "count": ["ball.bounces"],
        }
    )
    assert labels(figure) == ["supply [MPa]", "currents [mA]", "own drawing [W]", "count"]
    supply, currents, own, _ = figure.axes
    np.testing.assert_allclose(np.asarray(supply.lines[0].get_ydata()), bounce()["valves[0].port_a.p"] / 1e6)
    assert [text.get_text() for text in supply.get_legend().get_texts()] == ["first"]  # type: ignore[union-attr]
    assert len(currents.lines) == 3, "two currents and the event"
    assert own.get_legend() is None


def test_a_panel_of_another_dimension_is_refused() -> None:
    with pytest.raises(UnitError, match=r"ball\.h is .*length.* and cannot be shown in bar"):
        bounce().plot({"pressure [bar]": "ball.h"})
    with pytest.raises(ResultError, match="nothing to draw"):
        bounce().plot([])


def test_values_that_are_not_finite_are_left_out(tmp_path: Path) -> None:
    t = np.array([0.0, 1.0, 2.0])
    values = np.array([1.0, np.nan, np.inf])
    Solution(Table(t, {"x": values}, {"x": Variable("x", "m")}), Run(model="M")).plot("x", tmp_path / "x.png")


def test_one_time_only(tmp_path: Path) -> None:
    t = np.array([0.0])
    Solution(Table(t, {"x": t}, {"x": Variable("x", "m")})).plot("x", tmp_path / "x.png")


@pytest.mark.parametrize(
    ("unit", "display", "magnitude", "expected"),
    [
        ("Pa", "", 2e7, "bar"),
        ("Pa", "MPa", 2e7, "MPa"),
        ("m^3/s", "", 1e-4, "L/min"),
        ("rad/s", "rpm", 500.0, "rpm"),
        ("rad/s", "", 500.0, "rad/s"),
        ("m", "", 0.05, "mm"),
        ("m", "", 0.0, "m"),
        ("N", "", 2500.0, "kN"),
        ("N", "", 25.0, "N"),
        ("m", "", 1e-9, "um"),
        ("kg/m^3", "", 850.0, "kg/m^3"),
    ],
)
def test_units_that_people_read(unit: str, display: str, magnitude: float, expected: str) -> None:
    assert display_unit(unit, display, magnitude).text == expected


def test_units_look_like_in_print() -> None:
    assert pretty_unit("m^3/s") == "m³/s"
    assert pretty_unit("kg*m^-2") == "kg·m⁻²"
    assert pretty_unit("um") == "µm"
    assert (pretty_unit("degC"), pretty_unit("W/degC"), pretty_unit("delta_degC")) == (
        "°C",
        "W/°C",
        "delta_degC",
    )
    assert labelled("count", "1") == "count"
