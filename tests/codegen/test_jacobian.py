"""Kernels against finite differences and against equations that stand here by hand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from arthur_acausal import Component, Translation, translate
from arthur_acausal.codegen.compiled import Evaluator
from arthur_acausal.models.arthur.powertrain import Powertrain
from tests.codegen.models import Everything, Filter, Rod

FloatArray = NDArray[np.float64]

MODELS: dict[str, Callable[[], Component]] = {
    "everything": Everything,
    "filter": Filter,
    "rod": Rod,
    "powertrain": lambda: Powertrain(n=2),
}


@pytest.fixture(scope="module", params=MODELS)
def translation(request: pytest.FixtureRequest) -> Translation:
    return translate(MODELS[request.param](), compile="never")


def dense(entries: FloatArray, translation: Translation) -> FloatArray:
    """A Jacobian as a matrix, from its entries by columns."""
    pattern, n = translation.dae.sparsity, translation.dae.n
    matrix = np.zeros((n, n))
    matrix[pattern.row, np.repeat(np.arange(n), np.diff(pattern.colind))] = entries
    return matrix


def somewhere(translation: Translation, seed: int) -> Evaluator:
    """An evaluator at a random point near the start values, in units of the nominals."""
    dae = translation.dae
    random = np.random.default_rng(seed)
    evaluator = dae.evaluator()
    attributes = dae.attributes(dae.parameter_vector())
    evaluator.y[:] = attributes.start + 0.1 * attributes.nominal * random.uniform(-1, 1, dae.n)
    evaluator.yp[:] = attributes.nominal * random.uniform(-1, 1, dae.n) * dae.differential
    evaluator.t[0] = 0.7
    evaluator.cj[0] = random.uniform(1, 50)
    evaluator.m[:] = random.integers(0, 2, evaluator.m.size)
    evaluator.z[:] = random.uniform(-1, 1, evaluator.z.size)
    return evaluator


def difference(f: Callable[[], FloatArray], x: FloatArray, direction: FloatArray, h: float) -> FloatArray:
    """Central difference of f along a direction of its argument, which it reads in place."""
    here = x.copy()
    x[:] = here + h * direction
    above = f().copy()
    x[:] = here - h * direction
    below = f().copy()
    x[:] = here
    return (above - below) / (2 * h)


@pytest.mark.parametrize("seed", range(3))
def test_the_jacobian_is_the_derivative_of_the_residual(translation: Translation, seed: int) -> None:
    evaluator = somewhere(translation, seed)
    dae = translation.dae
    dy, dyp = (dense(j().copy(), translation) for j in (evaluator.jacobian_y, evaluator.jacobian_yp))
    whole = dense(evaluator.jacobian().copy(), translation)
    np.testing.assert_allclose(whole, dy + evaluator.cj[0] * dyp, rtol=1e-13, atol=1e-300)
    assert not dyp[:, ~dae.differential].any(), "algebraic unknowns have no derivative"
    for k in range(dae.n):
        unit = np.zeros(dae.n)
        unit[k] = dae.nominal[k]
        for matrix, x in ((dy, evaluator.y), (dyp, evaluator.yp)):
            found = difference(evaluator.residual, x, unit, 1e-6)
            expected = matrix @ unit
            scale = np.abs(evaluator.residual()) + np.abs(expected) + np.abs(found)
            assert np.all(np.abs(found - expected) <= 1e-5 * scale + 1e-4 * np.abs(expected).max() + 1e-9)


def test_the_pattern_holds_all_entries_and_no_column_is_empty(translation: Translation) -> None:
    pattern, n = translation.dae.sparsity, translation.dae.n
    assert len(pattern.colind) == n + 1
    assert pattern.colind[-1] == len(pattern.row)
    assert (np.diff(pattern.colind) > 0).all()
    assert len(set(pattern.row.tolist())) == n


def test_the_initial_jacobian_is_the_derivative_of_the_initial_conditions() -> None:
    translation = translate(Everything(), compile="never")
    dae = translation.dae
    evaluator = somewhere(translation, 5)
    pattern = dae.init_sparsity
    matrix = np.zeros((dae.n_init, 2 * dae.n))
    column = np.repeat(np.arange(2 * dae.n), np.diff(pattern.colind))
    matrix[pattern.row, column] = evaluator.initial_jacobian()
    for k in range(2 * dae.n):
        x = evaluator.y if k < dae.n else evaluator.yp
        unit = np.zeros(dae.n)
        unit[k % dae.n] = 1.0
        np.testing.assert_allclose(difference(evaluator.initial, x, unit, 1e-6), matrix[:, k], atol=1e-8)


def test_the_residual_vanishes_where_the_hand_written_equations_hold() -> None:
    """The filter's equations by hand: L i' = V - v1, C1 v1' = i - (v1 - v2)/R, C2 v2' = (v1 - v2)/R - v2/R_L."""
    translation = translate(Filter(), compile="never")
    dae = translation.dae
    assert sorted(dae.y_paths) == ["coil.i", "left.v", "right.v"]
    evaluator = dae.evaluator()
    random = np.random.default_rng(1)
    for _ in range(20):
        i, v1, v2 = random.uniform(-10, 10, 3)
        rates = {
            "coil.i": (10.0 - v1) / 0.5,
            "left.v": (i - (v1 - v2) / 2.0) / 0.2,
            "right.v": ((v1 - v2) / 2.0 - v2 / 5.0) / 0.1,
        }
        values = {"coil.i": i, "left.v": v1, "right.v": v2}
        evaluator.y[:] = [values[path] for path in dae.y_paths]
        evaluator.yp[:] = [rates[path] for path in dae.y_paths]
        np.testing.assert_allclose(evaluator.residual(), 0.0, atol=1e-12)
        evaluator.yp[0] += 1.0
        assert np.abs(evaluator.residual()).max() > 0.05


def test_kernels_write_into_one_array_and_see_their_arguments_in_place() -> None:
    evaluator = translate(Filter(), compile="never").dae.evaluator()
    first = evaluator.residual()
    before = first.copy()
    evaluator.y[:] += 1.0
    assert evaluator.residual() is first
    assert not np.array_equal(first, before)


def test_compiled_and_interpreted_kernels_agree(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    pair = [translate(Everything(), compile=mode) for mode in ("never", "always")]
    points = [somewhere(t, 3) for t in pair]
    for name in ("residual", "jacobian", "roots"):
        a, b = (getattr(p, name)().copy() for p in points)
        np.testing.assert_allclose(a, b, rtol=1e-14, atol=1e-15)
