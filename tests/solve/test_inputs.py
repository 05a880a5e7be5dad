"""External inputs and tables."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from arthur_acausal.errors import UsageError
from arthur_acausal.solve.inputs import Inputs
from arthur_acausal.solve.simulate import simulate
from arthur_acausal.solve.table import Table
from tests.solve.handmade import Handmade, external, handmade, state


def integrator() -> Handmade:
    """x' = u from 0."""
    x, u = state("x", 0.0, fixed=True), external("u")
    return handmade([x, u], {"x": x.d - u.s})


def inputs(given: dict[str, Any], stop_time: float = 1.0, count: int = 3) -> tuple[Inputs, Any]:
    """Inputs u0, u1, ... of defaults 0, 1, ..., and their values."""
    u = np.zeros(count)
    paths = [f"u{i}" for i in range(count)]
    return Inputs(paths, np.arange(float(count)), given, u, 0.0, stop_time), u


points = st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=8)


@given(values=points, times=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=20))
def test_a_linear_table_is_what_numpy_interpolates(values: list[float], times: list[float]) -> None:
    knots = np.linspace(0.0, 1.0, len(values))
    ours, u = inputs({"u1": Table(knots, values)})
    exact = np.interp(times, knots, values)
    for t, value in zip(times, exact, strict=True):
        ours.refresh(t)
        assert u[1] == pytest.approx(value, rel=1e-9, abs=1e-9)
    assert u[0] == 0.0 and u[2] == 2.0
    sampled = ours.sample(np.array(times))
    assert sampled[:, 1] == pytest.approx(exact, rel=1e-9, abs=1e-9)
    assert (sampled[:, 2] == 2.0).all()


@given(values=points, times=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=20))
def test_pchip_passes_its_points_and_overshoots_nowhere(values: list[float], times: list[float]) -> None:
    knots = np.linspace(0.0, 1.0, len(values))
    ours, u = inputs({"u0": Table(knots, values, interpolation="pchip")})
    for t, value in zip(knots, values, strict=True):
        ours.refresh(float(t))
        assert u[0] == pytest.approx(value, rel=1e-9, abs=1e-9)
    sampled = ours.sample(np.array(times))[:, 0]
    for t, value in zip(times, sampled, strict=True):
        ours.refresh(t)
        assert u[0] == pytest.approx(value, rel=1e-9, abs=1e-9)
        left = min(int(np.searchsorted(knots, t, side="right")) - 1, len(values) - 2)
        low, high = sorted(values[left : left + 2])
        assert low - 1e-9 * (1 + abs(low)) <= value <= high + 1e-9 * (1 + abs(high))


def test_tables_on_one_grid_are_evaluated_together_wherever_their_inputs_stand() -> None:
    knots = [0.0, 0.5, 1.0]
    ours, u = inputs(
        {"u0": Table(knots, [0, 1, 0]), "u2": Table(knots, [5, 5, 7]), "u3": lambda t: 10.0 * t},
        count=4,
    )
    ours.refresh(0.75)
    assert u.tolist() == [0.5, 1.0, 6.0, 7.5]


def test_a_repeated_time_is_a_jump_seen_from_the_piece_one_is_in() -> None:
    table = Table([0.0, 0.5, 0.5, 1.0], [1.0, 1.0, 3.0, 4.0])
    ours, u = inputs({"u0": table})
    assert ours.jumps == [0.5]
    assert (ours.next_jump(0.0), ours.next_jump(0.5)) == (0.5, np.inf)
    ours.refresh(0.5)
    assert u[0] == 1.0
    ours.begin(0.5)
    assert u[0] == 3.0
    ours.refresh(0.75)
    assert u[0] == 3.5


def test_the_integral_over_jumps_is_exact_and_both_sides_are_recorded() -> None:
    table = Table([0.0, 0.3, 0.3, 0.7, 0.7, 1.0], [1.0, 1.0, -2.0, -2.0, 5.0, 5.0])
    result = simulate(integrator(), stop_time=1.0, inputs={"u": table})
    assert result.y[-1, 0] == pytest.approx(0.3 - 2.0 * 0.4 + 5.0 * 0.3, abs=1e-9)
    assert [(e.time, e.kind) for e in result.events] == [(0.3, "input"), (0.7, "input")]
    for t, before, after in ((0.3, 1.0, -2.0), (0.7, -2.0, 5.0)):
        rows = np.flatnonzero(result.t == t)
        assert result.u[rows, 0].tolist() == [before, after]
        assert result.yp[rows[1], 0] == pytest.approx(after)


def test_a_jump_at_either_end_of_the_run_is_none() -> None:
    table = Table([0.0, 0.0, 1.0, 1.0], [7.0, 1.0, 1.0, 9.0])
    result = simulate(integrator(), stop_time=1.0, inputs={"u": table})
    assert not result.events
    assert result.y[-1, 0] == pytest.approx(1.0, abs=1e-9)


def test_functions_and_constants_are_inputs() -> None:
    result = simulate(integrator(), stop_time=1.0, inputs={"u": lambda t: 3.0 * t**2})
    assert result.y[-1, 0] == pytest.approx(1.0, abs=1e-5)
    assert result.u[-1, 0] == pytest.approx(3.0)
    assert simulate(integrator(), stop_time=1.0, inputs={"u": 2}).y[-1, 0] == pytest.approx(2.0, abs=1e-9)


def test_held_ends_extend_a_table() -> None:
    table = Table([0.2, 0.4], [1.0, 3.0], extrapolation="hold")
    ours, u = inputs({"u0": table})
    for t, value in ((0.0, 1.0), (0.1, 1.0), (0.3, 2.0), (0.4, 3.0), (1.0, 3.0)):
        ours.refresh(t)
        assert u[0] == pytest.approx(value)
    ours, u = inputs({"u0": Table([0.5], [4.0], extrapolation="hold")})
    ours.refresh(0.9)
    assert u[0] == 4.0


@pytest.mark.parametrize(
    ("given_inputs", "told"),
    [
        ({"u9": 1.0}, "no input 'u9'"),
        ({"u1": "fast"}, "'fast'"),
        ({"u1": float("nan")}, "nan"),
        ({"u1": lambda t: "much"}, "returns 'much'"),
        ({"u1": Table([0.0, 0.5], [0.0, 1.0])}, "covers 0 s to 0.5 s, the run 0 s to 1 s"),
    ],
)
def test_what_is_no_input_is_refused(given_inputs: dict[str, Any], told: str) -> None:
    with pytest.raises(UsageError, match=r"u1|u9") as caught:
        inputs(given_inputs)
    assert told in str(caught.value)


@pytest.mark.parametrize(
    ("times", "values", "told"),
    [
        ([0.0, 1.0], [0.0], "times"),
        ([], [], "times"),
        ([0.0, 2.0, 1.0], [0, 0, 0], "1 s comes after 2 s"),
        ([0.0, 1.0, 1.0, 1.0], [0, 0, 0, 0], "stands three times"),
        ([0.0, np.nan], [0, 0], "not finite"),
    ],
)
def test_bad_points_are_refused(times: list[float], values: list[float], told: str) -> None:
    with pytest.raises(UsageError, match=told):
        Table(times, values)


def write(tmp_path: Path, text: str) -> Path:
    file = tmp_path / "trot.csv"
    file.write_text(text, encoding="utf-8")
    return file


def test_a_table_is_read_from_a_csv_file(tmp_path: Path) -> None:
    file = write(tmp_path, "time, I, F\n0,1.5,2\n\n0.5,2.5,3\n")
    table = Table.from_csv(file, "time", "I")
    assert table.times.tolist() == [0.0, 0.5] and table.values.tolist() == [1.5, 2.5]
    assert Table.from_csv(write(tmp_path, "t,x\n0,1\n1,2\n"), "t").values.tolist() == [1.0, 2.0]


@pytest.mark.parametrize(
    ("text", "column", "told"),
    [
        ("time,I\n0,1\n0.5,one\n", "I", "trot.csv, line 3, column 'I': 'one' is not a number"),
        ("time,I\n0,1\n0.5\n", "I", "trot.csv, line 3, column 'I': the line has only 1 fields"),
        ("time,current\n0,1\n", "curent", "did you mean current?"),
        ("time,a,b\n0,1,1\n", None, "there is no column to use, and several"),
        ("time,I\n", "I", "no rows below its header"),
        ("", "I", "there is no column 'time'"),
        ("time,I\n1,1\n0,1\n", "I", "trot.csv, column 'I': time 0 s comes after 1 s"),
    ],
)
def test_errors_of_a_csv_file_name_file_line_and_column(
    tmp_path: Path, text: str, column: str | None, told: str
) -> None:
    with pytest.raises(UsageError) as caught:
        Table.from_csv(write(tmp_path, text), "time", column)
    assert told in str(caught.value)


def test_a_csv_file_that_is_too_short_for_the_run_says_so(tmp_path: Path) -> None:
    table = Table.from_csv(write(tmp_path, "time,I\n0,1\n0.5,1\n"))
    with pytest.raises(UsageError) as caught:
        simulate(integrator(), stop_time=2.0, inputs={"u": table})
    assert "trot.csv, column 'I' covers 0 s to 0.5 s, the run 0 s to 2 s" in str(caught.value)
    assert 'extrapolation="hold"' in str(caught.value)


def test_a_missing_file_is_a_usage_error(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot be read"):
        Table.from_csv(tmp_path / "nowhere.csv")
