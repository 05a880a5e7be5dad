"""Damped Newton on its own, dense and sparse."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from arthur_acausal.solve.diagnosis import listed, null_vectors, scaled_rows
from arthur_acausal.solve.newton import Matrix, Solved, as_sparse, factorise, newton
from arthur_acausal.solve.protocol import FloatArray

UNBOUNDED = np.inf


class System:
    """Equations by functions of w, with their derivative."""

    def __init__(
        self, f: Callable[[FloatArray], FloatArray], df: Callable[[FloatArray], FloatArray], sparse: bool
    ) -> None:
        self._f, self._df, self._sparse = f, df, sparse
        self._w = np.zeros(0)

    def residual(self, w: FloatArray) -> FloatArray:
        self._w = w.copy()
        return self._f(w)

    def matrix(self) -> Matrix:
        dense = self._df(self._w)
        return as_sparse(dense) if self._sparse else dense


def solve(
    f: Callable[[FloatArray], FloatArray],
    df: Callable[[FloatArray], FloatArray],
    start: list[float],
    *,
    sparse: bool = False,
    low: float = -np.inf,
    high: float = np.inf,
    scale: float = 1.0,
) -> Solved:
    w = np.array(start, dtype=float)
    bounds = np.full(w.size, low), np.full(w.size, high)
    return newton(System(f, df, sparse), w, np.full(w.size, scale), *bounds, tolerance=1e-10, most=100)


@pytest.mark.parametrize("sparse", [False, True])
def test_a_linear_system_takes_one_factorisation(sparse: bool) -> None:
    A = np.array([[2.0, 1.0], [0.0, 1e-8]])
    solved = solve(lambda w: A @ w - [4.0, 1e-8], lambda w: A, [0.0, 0.0], sparse=sparse)
    assert not solved.reason and solved.iterations == 1
    assert np.allclose(solved.w, [1.5, 1.0], rtol=1e-12)


@pytest.mark.parametrize("start", [1.5, 10.0, -20.0])
def test_damping_solves_where_full_steps_diverge(start: float) -> None:
    solved = solve(np.arctan, lambda w: np.diag(1.0 / (1.0 + w**2)), [start])
    assert not solved.reason
    assert abs(solved.w[0]) < 1e-10


def test_a_step_out_of_the_range_of_the_equations_is_shortened() -> None:
    solved = solve(lambda w: np.log(np.where(w > 0, w, np.nan)), lambda w: np.diag(1.0 / w), [20.0])
    assert not solved.reason
    assert solved.w[0] == pytest.approx(1.0, abs=1e-12)


def test_bounds_choose_the_root() -> None:
    def f(w: FloatArray) -> FloatArray:
        return w**2 - 4.0

    assert solve(f, lambda w: np.diag(2.0 * w), [-0.1]).w[0] == pytest.approx(-2.0)
    bounded = solve(f, lambda w: np.diag(2.0 * w), [0.1], low=0.0, high=5.0)
    assert bounded.w[0] == pytest.approx(2.0)


@pytest.mark.parametrize("sparse", [False, True])
def test_a_singular_system_is_called_singular(sparse: bool) -> None:
    A = np.array([[1.0, 1.0], [2.0, 2.0]])
    assert solve(lambda w: A @ w - [1.0, 2.0], lambda w: A, [0.0, 0.0], sparse=sparse).reason == "singular"


def test_a_system_without_solution_makes_no_progress() -> None:
    solved = solve(lambda w: w**2 + 1.0, lambda w: np.diag(2.0 * w), [1.0])
    assert solved.reason in ("no progress", "singular", "iterations")


def test_a_start_without_finite_residual_is_reported() -> None:
    assert solve(lambda w: w * np.nan, lambda w: np.eye(1), [1.0]).reason == "not finite"


entries = st.floats(-10.0, 10.0).filter(lambda x: abs(x) > 1e-3)


@given(rows=st.lists(st.lists(entries, min_size=4, max_size=4), min_size=4, max_size=4), scale=entries)
def test_scaling_of_equations_and_unknowns_does_not_matter(rows: list[list[float]], scale: float) -> None:
    A = np.array(rows) + np.diag([40.0, 50.0, 60.0, 70.0])
    b = np.arange(1.0, 5.0)
    factor = 10.0 ** np.array([9, -12, 0, 3]) * scale
    for dense in (True, False):
        matrix = A * factor[:, None]
        apply, singular = factorise(matrix if dense else as_sparse(matrix), np.ones(4))
        assert not singular
        assert np.allclose(apply(b * factor), np.linalg.solve(A, b), rtol=1e-8, atol=1e-12)


@pytest.mark.parametrize("sparse", [False, True])
def test_null_vectors_name_who_is_involved(sparse: bool) -> None:
    A = np.eye(5)
    A[1, 2] = A[2, 1] = 1.0  # rows 1 and 2 say the same: unknowns 1 and 2 in their sum only
    unknowns, rows = null_vectors(as_sparse(A) if sparse else A, np.ones(5))
    assert set(unknowns) == {1, 2}
    assert set(rows) == {1, 2}


def test_scaled_rows_compare_residuals_of_unlike_equations() -> None:
    A = np.array([[1e7, 0.0], [0.0, 1e-4]])
    assert scaled_rows(A, np.array([1e6, 1e-4]), np.ones(2)).tolist() == pytest.approx([0.1, 1.0])


def test_long_lists_are_cut() -> None:
    assert listed(["a", "b"]) == "a, b"
    assert listed([str(k) for k in range(9)], "; ") == "0; 1; 2; 3; 4; 5 and 3 more"


def test_corrections_that_are_rounding_errors_end_the_iteration() -> None:
    """A residual known to 1e-7 only: corrections above the tolerance that no longer shrink."""
    random = np.random.default_rng(1)
    solved = solve(
        lambda w: w**3 - 8.0 + 1e-7 * random.uniform(-1.0, 1.0, 1), lambda w: np.diag(3 * w**2), [3.0]
    )
    assert not solved.reason
    assert solved.iterations < 20
    assert solved.w == pytest.approx([2.0], abs=1e-7)
