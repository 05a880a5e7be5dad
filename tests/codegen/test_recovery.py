"""Every variable comes back; what comes back fulfils the equations as they were written."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
import pytest

from arthur_acausal import Component, Solution, Translation, translate
from arthur_acausal.declare.scope import Atom
from arthur_acausal.flatten.system import FlatEquation
from arthur_acausal.models.arthur.powertrain import Powertrain
from tests.codegen.models import Everything, Filter, Rod
from tests.codegen.test_jacobian import MODELS


@pytest.fixture(scope="module", params=[m for m in MODELS if m != "powertrain"])
def run(request: pytest.FixtureRequest) -> tuple[Translation, Solution]:
    translation = translate(MODELS[request.param]())
    return translation, translation.simulate(1.0, tolerance=1e-7)


def test_every_declared_path_has_a_value_and_a_unit(run: tuple[Translation, Solution]) -> None:
    translation, solution = run
    scope = translation.flat.scope
    declared = [*scope.variable, *scope.parameter, *scope.discrete]
    assert {d.path for d in declared} <= set(solution.paths)
    for d in declared:
        assert solution[d.path].shape == solution.t.shape
        assert np.isfinite(solution[d.path]).all()
        assert solution.unit(d.path) == d.quantity.unit


def evaluate(equation: FlatEquation, translation: Translation, solution: Solution) -> tuple[Any, Any]:
    """Both sides of a raw equation at all times, each symbol looked up by path; derivatives by differences."""
    scope = translation.flat.scope
    values = []
    for atom in equation.atoms():
        values.append(_value(atom, scope, translation, solution))
    function = ca.Function("sides", equation.equation.symbols, [equation.equation.lhs, equation.equation.rhs])
    if not values:
        return np.zeros(len(solution.t)), np.zeros(len(solution.t))
    sides = function.map(len(solution.t))(*[np.asarray(v).reshape(1, -1) for v in values])
    left, right = (np.asarray(side, dtype=float).reshape(-1) for side in sides)
    return left, right


def _value(atom: Atom, scope: Any, translation: Translation, solution: Solution) -> Any:
    match atom.kind:
        case "time":
            return solution.t
        case "mode":
            return solution.modes[:, atom.number]
        case "der":
            # of the interpolated values between the outputs, in the middle of smooth stretches
            return np.gradient(solution[scope.variable[atom.number].path], solution.t, edge_order=2)
        case "parameter":
            path = scope.parameter[atom.number].path
        case "discrete" | "pre":
            path = scope.discrete[atom.number].path
        case _:
            path = scope.variable[atom.number].path
    return solution[path]


@pytest.mark.parametrize(("model", "stop"), [(Filter(), 0.5), (Rod(), 0.1)])
def test_what_comes_back_fulfils_every_raw_equation(model: Component, stop: float) -> None:
    translation = translate(model)
    solution = translation.simulate(stop, tolerance=1e-9)
    assert len(np.unique(solution.t)) == len(solution.t), "no event: differences make sense"
    for equation in translation.flat.equations:
        left, right = evaluate(equation, translation, solution)
        differentiated = any(a.kind == "der" for a in equation.atoms())
        scale = np.abs(left).max() + np.abs(right).max() + 1.0
        bound = 2e-4 if differentiated else 1e-9
        assert np.abs(left - right)[3:-3].max() <= bound * scale, equation.text
    for alias in translation.flat.aliases:
        a, b = (solution[translation.flat.variables[k].path] for k in (alias.i, alias.j))
        np.testing.assert_array_equal(a, b)


def test_aliases_have_their_sign_and_zero_is_zero() -> None:
    solution = translate(Everything()).simulate(1.0)
    np.testing.assert_array_equal(solution["same"], solution["x"])
    np.testing.assert_array_equal(solution["opposite"], -solution["z"])
    assert not solution["nothing"].any()
    np.testing.assert_allclose(solution["rate"], solution["der(x)"], rtol=1e-14)
    # the implicit equation, by itself
    x, loop = solution["x"], solution["loop"]
    np.testing.assert_allclose(loop + 0.5 * np.exp(loop), x**2 + 1, rtol=1e-8)
    np.testing.assert_allclose(solution["y"], solution["level"] * x + solution["z"], rtol=1e-12)


class Tampered:
    """A solution with one variable changed."""

    def __init__(self, solution: Solution, path: str, change: float) -> None:
        self._solution, self._path, self._change = solution, path, change
        self.t = solution.t

    def __getattr__(self, name: str) -> Any:
        return getattr(self._solution, name)

    def __getitem__(self, path: str) -> Any:
        values = self._solution[path]
        return values * (1.0 + self._change) if path == self._path else values


@pytest.mark.parametrize("name", list(MODELS))
def test_verification_passes_what_is_right(name: str) -> None:
    translation = translate(MODELS[name]())
    solution = translation.simulate(0.05 if name == "powertrain" else 1.0)
    verification = translation.verify(solution)
    assert verification.equations == len(translation.flat.equations) + len(translation.flat.aliases)
    assert verification.largest < 1e-6, verification.worst[0]


@pytest.mark.parametrize(
    ("model", "path", "equation"),
    [
        (Filter(), "middle.i", "middle"),
        (Filter(), "load.p.v", "load"),
        (Filter(), "right.C", "right"),
        (Everything(), "loop", "implicit"),
        (Everything(), "chosen", "switch|second"),
        (Rod(), "F", "der"),
    ],
)
def test_verification_finds_a_value_that_is_wrong(model: Component, path: str, equation: str) -> None:
    translation = translate(model)
    solution = translation.simulate(1.0)
    wrong: Any = Tampered(solution, path, 1e-3)
    verification = translation.verify(wrong)
    assert 1e-5 < verification.largest < 1e-2
    assert any(name in verification.worst[0].equation for name in equation.split("|"))


def test_a_unit_of_a_derivative_is_that_of_its_variable_by_seconds() -> None:
    solution = translate(Filter()).simulate(0.1)
    assert solution.unit("der(left.v)").replace("**", "^") in ("V/s", "V/s^1")


def test_a_parameter_given_for_a_run_is_what_comes_back() -> None:
    translation = translate(Powertrain(n=1))
    solution = translation.simulate(0.001, parameters={"manifold.V": 7e-6})
    assert (solution["manifold.V"] == 7e-6).all()
