"""Start values and other attributes of the unknowns, merged over all variables that one of them stands for."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import Component, Equations, ParameterError, Real, der, parameter, translate, variable
from tests.codegen.models import Everything


class Merged(Component):
    """x, its opposite and its equal, with attributes on each."""

    T: Real = parameter("s", default=1.0)
    x: Real = variable("m", start=2.0, fixed=True, nominal=3.0, max=10.0)
    minus: Real = variable("m", min=-7.0, max=4.0)
    same: Real = variable("m", nominal=5.0, min=-20.0)
    y: Real = variable("m", start=1.0)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -self.x
        yield self.minus == -self.x
        yield self.same == self.x
        yield self.T * der(self.y) == self.x


def attribute(model: Component, name: str, path: str) -> float:
    dae = translate(model).dae
    return float(getattr(dae.attributes(dae.parameter_vector()), name)[dae.y_paths.index(path)])


def test_bounds_are_the_narrowest_and_turn_with_the_sign() -> None:
    assert attribute(Merged(), "min", "x") == -4.0, "minus <= 4"
    assert attribute(Merged(), "max", "x") == 7.0, "minus >= -7"
    assert attribute(Merged(), "min", "y") == -np.inf


def test_the_largest_declared_nominal_counts() -> None:
    assert attribute(Merged(), "nominal", "x") == 5.0
    assert attribute(Merged(), "nominal", "y") == 1.0


def test_a_guess_outside_of_the_bounds_is_brought_inside() -> None:
    class High(Merged):
        x: Real = variable("m", start=50.0, max=10.0)

    assert attribute(High(), "start", "x") == 7.0


def test_a_start_may_be_given_by_any_of_the_paths() -> None:
    translation = translate(Merged())
    for path, value, x in (
        ("x", 3.0, 3.0),
        ("same", 3.0, 3.0),
        ("minus", 3.0, -3.0),
        ("minus", "-50 cm", 0.5),
    ):
        solution = translation.simulate(0.1, start={path: value})
        assert solution["x"][0] == pytest.approx(x)
        assert solution["minus"][0] == pytest.approx(-x)


def test_a_guess_is_taken_where_nothing_is_fixed_and_is_told() -> None:
    solution = translate(Merged()).simulate(0.1)
    assert solution["y"][0] == 1.0
    assert any("y = 1" in message for message in solution.statistics.messages)


def test_discrete_variables_start_from_parameters_or_what_is_given() -> None:
    translation = translate(Everything())
    first = translation.simulate(0.01)
    assert (first["level"][0], first["x"][0]) == (0.5, 1.0)
    second = translation.simulate(0.01, parameters={"k": 0.7})
    assert (second["level"][0], second["x"][0]) == (0.7, 1.4)
    third = translation.simulate(0.01, parameters={"k": 0.7}, start={"level": 9.0, "x": 1.1})
    assert (third["level"][0], third["x"][0], third["c"][0]) == (9.0, 1.1, 1.4)


def test_runs_of_one_translation_do_not_see_each_other() -> None:
    translation = translate(Everything())
    before = translation.simulate(1.0)
    translation.simulate(1.0, parameters={"k": 0.9}, start={"x": 2.0}, inputs={"u": 5.0})
    after = translation.simulate(1.0)
    for path in before.paths:
        np.testing.assert_array_equal(before[path], after[path], err_msg=path)


def test_a_start_of_what_has_none_is_refused() -> None:
    with pytest.raises(ParameterError, match="no start value of 'T'"):
        translate(Merged()).simulate(0.1, start={"T": 2.0})


def test_initial_equations_replace_start_values() -> None:
    class Related(Merged):
        x: Real = variable("m", start=2.0)
        total: Real = parameter("m", default=6.0)

        def initial_equations(self) -> Equations:
            yield self.x + self.y == self.total
            yield self.T * der(self.y) == 2 * self.y

    translation = translate(Related())
    solution = translation.simulate(0.1)  # x = 2 y, x + y = 6
    assert (solution["x"][0], solution["y"][0]) == (pytest.approx(4.0), pytest.approx(2.0))
    solution = translation.simulate(0.1, parameters={"total": 9.0})
    assert solution["y"][0] == pytest.approx(3.0)
