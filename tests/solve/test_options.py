"""Options are checked where they are given."""

from __future__ import annotations

import dataclasses
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from arthur_acausal.errors import UsageError
from arthur_acausal.solve.options import SolverOptions


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"rtol": 0.0}, "rtol is 0.0"),
        ({"rtol": 1.0}, "rtol is 1.0"),
        ({"rtol": "small"}, "rtol is 'small'"),
        ({"rtol": float("nan")}, "rtol is nan"),
        ({"atol": -1.0}, "atol is -1.0"),
        ({"atol": {"a.x": 0.0}}, "atol of a.x is 0.0"),
        ({"intervals": 0}, "intervals is 0"),
        ({"intervals": 2.5}, "intervals is 2.5"),
        ({"output_interval": -0.1}, "output_interval is -0.1"),
        ({"first_step": 0.0}, "first_step is 0.0"),
        ({"max_step": float("inf")}, "max_step is inf"),
        ({"max_order": 6}, "max_order is 6"),
        ({"max_steps": 0}, "max_steps is 0"),
        ({"linear_solver": "banded"}, "'banded'"),
    ],
)
def test_values_out_of_range_are_refused(options: dict[str, Any], told: str) -> None:
    with pytest.raises(UsageError) as caught:
        SolverOptions(**options)
    assert told in str(caught.value)


def test_replace_names_the_nearest_option() -> None:
    assert SolverOptions().replace(rtol=1e-8).rtol == 1e-8
    with pytest.raises(UsageError, match="did you mean max_step, max_steps"):
        SolverOptions().replace(max_step_=1)


def test_absolute_tolerances_follow_the_nominal_values() -> None:
    paths, nominal = ["p", "q"], np.array([1e7, -1e-4])
    assert np.allclose(SolverOptions(rtol=1e-6).absolute_tolerances(paths, nominal), [1e-1, 1e-12])
    assert SolverOptions(atol=1e-3).absolute_tolerances(paths, nominal).tolist() == [1e-3, 1e-3]
    mixed = SolverOptions(rtol=1e-6, atol={"q": 1e-9}).absolute_tolerances(paths, nominal)
    assert np.allclose(mixed, [1e-1, 1e-9])
    with pytest.raises(UsageError, match="did you mean"):
        SolverOptions(atol={"pp": 1.0}).absolute_tolerances(["p1", "p"], np.ones(2))


def test_a_step_is_held_to_more_than_a_tight_tolerance_of_the_run() -> None:
    assert SolverOptions(rtol=1e-4).step_rtol == 1e-4
    steps = [SolverOptions(rtol=10.0**-k).step_rtol for k in range(6, 15)]
    assert all(later < earlier or later == 1e-13 for earlier, later in pairwise(steps))
    assert steps[4] == pytest.approx(10**-10.8)  # (1e-4)^(6/5) of 1e-6
    assert steps[-1] == 1e-14  # what the user asks for is never made wider
    paths, nominal = ["p", "q"], np.array([1e7, 1e-4])
    mixed = SolverOptions(rtol=1e-10, atol={"q": 1e-12}).absolute_tolerances(paths, nominal)
    assert mixed == pytest.approx(10**-0.8 * np.array([1e-5, 1e-12]))


def test_options_are_frozen_and_become_plain_data() -> None:
    options = SolverOptions(atol={"p": 1.0})
    with pytest.raises(dataclasses.FrozenInstanceError):
        options.rtol = 1.0  # type: ignore[misc]
    assert options.as_dict()["atol"] == {"p": 1.0}
