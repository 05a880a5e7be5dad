"""`Solution`: values by path, interpolation, views."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from arthur_acausal.errors import ResultError
from arthur_acausal.result.solution import Solution
from tests.result.sample import bounce, bounce_run, bounce_values


def test_values_are_lazy_cached_and_read_only() -> None:
    values = bounce_values()
    solution = Solution(values, bounce_run())
    assert values.asked == []
    height = solution["ball.h"]
    assert height is solution["ball.h"]
    assert values.asked == ["ball.h"]
    with pytest.raises(ValueError, match="read-only"):
        height[0] = 7.0


def test_eliminated_variables_are_computed_together() -> None:
    values = bounce_values()
    values.variables = {
        p: replace(v, kind="eliminated") if ".I" in p else v for p, v in values.variables.items()
    }
    solution = Solution(values)
    _ = solution["valves[1].I"], solution["valves[0].I"]
    assert values.asked == ["valves[1].I", "valves[0].I"]
    np.testing.assert_array_equal(solution["valves[0].I"], bounce()["valves[0].I"])


def test_every_kind_of_variable_has_one_value_a_time() -> None:
    solution = bounce()
    for path in solution.paths:
        assert solution[path].shape == solution.t.shape
    assert solution["ball.g"].tolist() == [2.0] * 7


def test_several_columns_at_once_in_the_order_asked() -> None:
    solution = bounce()
    block = solution.values(["ball.v", "ball.h", "ball.v"])
    np.testing.assert_array_equal(block[:, 0], solution["ball.v"])
    np.testing.assert_array_equal(block[:, 1], solution["ball.h"])
    np.testing.assert_array_equal(block[:, 2], block[:, 0])
    assert solution.values([]).shape == (7, 0)


def test_a_misspelt_path_gets_the_nearest_ones() -> None:
    with pytest.raises(ResultError, match=r"no variable 'ball\.hh'[\s\S]*did you mean ball\.h"):
        _ = bounce()["ball.hh"]
    with pytest.raises(ResultError, match=r"valves\[1\]\.port_a\.p"):
        bounce().unit("valves[1].port_b.p")


def test_units_and_descriptions() -> None:
    solution = bounce()
    assert solution.unit("valves[0].port_a.p") == "Pa"
    assert solution.description("ball.h") == "height"
    assert "ball.h" in solution and "ball.x" not in solution


@given(st.floats(0.0, 2.0))
def test_states_are_interpolated_by_their_derivatives(time: float) -> None:
    """Cubic Hermite is exact for a parabola, linear is not; an alias is as good as its state."""
    solution = bounce()
    exact = 1.0 - time**2 if time < 1.0 else 2.0 * (time - 1.0) - (time - 1.0) ** 2
    assert float(solution.at(time, "ball.h")) == pytest.approx(exact, abs=1e-14)
    assert float(solution.at(time, "floor.gap")) == pytest.approx(-exact, abs=1e-14)


def test_an_event_has_a_value_before_and_one_after() -> None:
    solution = bounce()
    assert solution.at(1.0, "ball.v", side="left") == -2.0
    assert solution.at(1.0, "ball.v", side="right") == 2.0
    assert solution.at(1.0, "ball.v") == 2.0
    assert solution.at([0.999, 1.0, 1.001], "ball.bounces").tolist() == [0.0, 1.0, 1.0]
    assert solution.at([1.0, 2.0], "ball.bounces", side="left").tolist() == [0.0, 1.0]


def test_between_the_rows_others_are_linear_and_discrete_ones_hold() -> None:
    solution = bounce()
    assert float(solution.at(0.3, "valves[0].port_a.p")) == pytest.approx(1.3e5)
    assert float(solution.at(0.9, "ball.bounces")) == 0.0
    assert solution.at(np.zeros((2, 3)), "ball.g").shape == (2, 3)


@pytest.mark.parametrize("time", [-1e-9, 2.0000001, float("nan")])
def test_times_outside_are_refused(time: float) -> None:
    with pytest.raises(ResultError, match=r"lies outside the solution, which goes from 0 s to 2 s"):
        bounce().at(time, "ball.h")


def test_initial_and_final_values() -> None:
    solution = bounce()
    assert solution.initial("ball.h") == 1.0
    assert solution.final("ball.h") == 1.0
    final = solution.final_values("valves[*].port_a.p")
    assert final == {"valves[0].port_a.p": 3e5, "valves[1].port_a.p": 6e5}
    assert list(solution.final_values()) == solution.paths


@pytest.mark.parametrize(
    ("pattern", "expected"),
    [
        ("valves[*].I", ["valves[0].I", "valves[1].I"]),
        ("valves[?].port_?.p", ["valves[0].port_a.p", "valves[1].port_a.p"]),
        ("valves[0].**", ["valves[0].port_a.p", "valves[0].I"]),
        ("**.p", ["valves[0].port_a.p", "valves[1].port_a.p"]),
        ("ball.h", ["ball.h"]),
        (["ball.v", "ball.?"], ["ball.v", "ball.h", "ball.g"]),
    ],
)
def test_patterns_take_brackets_literally(pattern: str | list[str], expected: list[str]) -> None:
    assert bounce().select(pattern) == expected


@pytest.mark.parametrize("pattern", ["valves[*].p", "*", "valves[2].I"])
def test_a_pattern_that_chooses_nothing_is_an_error(pattern: str) -> None:
    with pytest.raises(ResultError, match="no variable"):
        bounce().select(pattern)


def test_repr_says_what_it_is() -> None:
    text = repr(bounce())
    assert "Bounce" in text and "0 to 2 s" in text and "10 variables" in text and "1 events" in text


def test_how_it_came_about() -> None:
    solution = bounce()
    assert solution.model == "Bounce"
    assert solution.statistics.steps == 42
    assert solution.events[0].time == 1.0
    assert {"python", "numpy", "casadi", "arthur"} <= set(solution.versions)


def test_xarray_has_units_and_scalars_for_parameters() -> None:
    dataset = bounce().to_xarray()
    assert dataset["valves[0].port_a.p"].attrs["units"] == "Pa"
    assert dataset["ball.h"].dims == ("time",)
    assert dataset["ball.g"].dims == () and float(dataset["ball.g"]) == 2.0
    np.testing.assert_array_equal(dataset["time"], bounce().t)


def test_pandas_has_what_varies_or_what_is_asked() -> None:
    solution = bounce()
    frame = solution.to_pandas()
    assert "ball.g" not in frame and list(frame)[:2] == ["ball.h", "ball.v"]
    assert frame.index.name == "time"
    chosen = solution.to_pandas(["valves[*].I", "ball.g"])
    assert list(chosen) == ["valves[0].I", "valves[1].I", "ball.g"]
    assert chosen.attrs["units"]["ball.g"] == "m/s^2"
