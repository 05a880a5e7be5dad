"""Values that callers give: numbers, quantities, expressions, functions, start(); which one counts."""

from __future__ import annotations

from typing import Any

import pint
import pytest

from arthur_acausal import (
    Component,
    Equations,
    ParameterError,
    Real,
    Translation,
    UnitError,
    connect,
    der,
    parameter,
    start,
    translate,
    variable,
)
from arthur_acausal.declare.quantity import Start
from tests.circuit import Capacitor, Ground, Resistor, Voltage


class Tank(Component):
    """x' = -x / T from x = x_0, with a chain of parameters behind T and x_0."""

    R: Real = parameter("s/m^2", default=2.0)
    A: Real = parameter("m^2", default=3.0)
    T: Real = parameter("s", default=lambda self: self.R * self.A)
    x_0: Real = parameter("m", default=lambda self: self.A**0.5)
    x: Real = variable("m", start=lambda self: self.x_0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -self.x


def values(translation: Translation, **parameters: Any) -> dict[str, float]:
    """All parameters of a model for given ones."""
    table = translation.dae.parameters
    vector = table.vector({path.replace("__", "."): value for path, value in parameters.items()})
    return {info.path: value for info, value in zip(table.infos, vector.tolist(), strict=True)}


def starts(translation: Translation, path: str, **parameters: Any) -> tuple[float, bool]:
    """The start value of an unknown and whether it is fixed."""
    dae = translation.dae
    attributes = dae.attributes(dae.parameter_vector(parameters))
    k = dae.y_paths.index(path)
    return float(attributes.start[k]), bool(attributes.fixed[k])


def test_dependent_defaults_follow_in_any_order_of_declaration() -> None:
    class Backwards(Component):
        volume: Real = parameter("m^3", default=lambda self: self.area * self.length)
        area: Real = parameter("m^2", default=lambda self: self.width**2)
        length: Real = parameter("m", default=2.0)
        width: Real = parameter("m", default=lambda self: self.length / 4)

    translation = translate(Backwards())
    assert values(translation) == {"volume": 0.5, "area": 0.25, "length": 2.0, "width": 0.5}
    assert values(translation, length=4.0)["volume"] == 4.0
    assert values(translation, width=3.0) == {"volume": 18.0, "area": 9.0, "length": 2.0, "width": 3.0}
    assert values(translation, area=1.0, length=8.0)["volume"] == 8.0, "a given value cuts its chain"


def test_dependent_values_are_computed_anew_for_every_run() -> None:
    translation = translate(Tank())
    for A in (3.0, 0.75):
        solution = translation.simulate(1.0, parameters={"A": A})
        assert solution["x"][0] == pytest.approx(A**0.5, rel=1e-12)
        # x(t) = sqrt(A) exp(-t / (R A))
        assert solution.final("x") == pytest.approx(A**0.5 * 2.718281828459045 ** (-1 / (2 * A)), rel=1e-5)


def test_quantities_and_texts_are_brought_to_si() -> None:
    class Plant(Component):
        tank = Tank(A=pint.Quantity(500, "cm**2"), T="2 min")

    assert values(translate(Plant())) == {
        "tank.R": 2.0,
        "tank.A": pytest.approx(0.05),
        "tank.T": 120.0,
        "tank.x_0": pytest.approx(0.05**0.5),
    }


def test_expressions_and_functions_of_the_owner() -> None:
    class Pair(Component):
        A: Real = parameter("m^2", default=4.0)
        left: Tank = Tank(A=lambda self: 2 * self.A)

        def build(self) -> None:
            self.right = Tank(A=self.A / 4)

    translation = translate(Pair())
    assert values(translation)["left.A"] == 8.0
    assert values(translation)["right.A"] == 1.0
    assert values(translation, A=100.0)["left.T"] == 400.0
    assert values(translation, A=100.0)["right.T"] == 50.0


def test_a_function_may_use_the_parts_of_its_component() -> None:
    class Sized(Component):
        total: Real = parameter("m^2", default=lambda self: self.tank.A + sum(t.A for t in self.tanks))
        tank: Tank = Tank(A=5.0)

        def build(self) -> None:
            self.tanks = [Tank(A=self.tank.A * (i + 1)) for i in range(2)]

    assert values(translate(Sized()))["total"] == 5.0 + 5.0 + 10.0
    assert values(translate(Sized(tank=Tank(A=1.0))))["total"] == 4.0


def test_the_modification_of_the_caller_beats_the_default_of_the_part() -> None:
    class Inner(Component):
        tank: Tank = Tank(A=7.0)

    class Outer(Component):
        inner: Inner = Inner(tank=Tank(A=9.0))

    assert values(translate(Inner()))["tank.A"] == 7.0
    assert values(translate(Outer()))["inner.tank.A"] == 9.0


class Chained(Component):
    """The variable of the part equals one of the whole: both may have a start value."""

    part: Tank = Tank()
    level: Real = variable("m", start=8.0)

    def equations(self) -> Equations:
        yield self.level == self.part.x


class Plain(Component):
    """As above, without a start value of the whole's own."""

    part: Tank = Tank()
    level: Real = variable("m")

    def equations(self) -> Equations:
        yield self.level == self.part.x


class Free(Tank):
    x: Real = variable("m", start=5.0)


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        (Chained(), (3.0**0.5, True)),  # fixed beats a guess, wherever it stands
        (Chained(part=Free()), (8.0, False)),  # the owner's own declaration beats the part's
        (Plain(part=Free()), (5.0, False)),
        (Plain(part=Free(x=start(6.0))), (6.0, False)),
        (Plain(part=Free(x=start("60 cm"))), (0.6, False)),
        (Plain(part=Free(x=4.0)), (4.0, False)),  # a plain value stands for start(value)
        (Chained(part=Free(x=start(fixed=True))), (5.0, True)),
        (Chained(part=Free(), level=start(9.0)), (9.0, False)),
        (Chained(part=Free(x=start(6.0)), level=start(9.0)), (9.0, False)),
        (Chained(part=Free(x=start(6.0, fixed=True)), level=start(9.0)), (6.0, True)),
    ],
)
def test_which_start_value_counts(model: Component, expected: tuple[float, bool]) -> None:
    translation = translate(model)
    (path,) = (p for p in translation.dae.y_paths if p in ("part.x", "level"))
    found = starts(translation, path)
    assert found[0] == pytest.approx(expected[0])
    assert found[1] is expected[1]


def test_start_values_may_depend_on_parameters_and_be_given_for_a_run() -> None:
    translation = translate(Tank())
    assert starts(translation, "x", A=25.0) == (5.0, True)
    solution = translation.simulate(1.0, parameters={"A": 25.0}, start={"x": "30 cm"})
    assert solution["x"][0] == pytest.approx(0.3)


def test_two_equal_fixed_start_values_of_one_unknown_are_no_conflict() -> None:
    class Circuit(Component):
        first = Capacitor(C=1.0, v=start(2.0, fixed=True))
        second = Capacitor(C=3.0, v=start(2.0, fixed=True))
        load = Resistor(R=1.0)
        ground = Ground()

        def equations(self) -> Equations:
            for part in (self.second, self.load):
                yield connect(self.first.p, part.p)
                yield connect(self.first.n, part.n)
            yield connect(self.first.n, self.ground.p)

    solution = translate(Circuit()).simulate(4.0)
    # both discharge as one capacitor of 4 F: v = 2 exp(-t / 4)
    assert solution.final("second.v") == pytest.approx(2 * 2.718281828459045**-1, rel=1e-5)
    assert solution.final("first.i") / solution.final("second.i") == pytest.approx(1 / 3, rel=1e-9)


def test_the_nominal_of_a_modification_beats_the_declared_one() -> None:
    class Plant(Component):
        tank = Tank(x=start(nominal=50.0))

    assert translate(Plant()).dae.nominal.tolist() == [50.0]
    assert translate(Tank()).dae.nominal.tolist() == [1.0]


def test_start_without_a_value_keeps_the_declared_one() -> None:
    assert start(fixed=True) == Start(None, True, None)
    assert starts(translate(Free(x=start(fixed=True))), "x") == (5.0, True)


def test_bounds_are_checked_for_literals_and_for_dependent_values() -> None:
    class Bounded(Component):
        a: Real = parameter("1", default=0.5, min=0.0, max=1.0)
        b: Real = parameter("1", default=lambda self: 2 * self.a, max=1.5)

    translation = translate(Bounded())
    assert values(translation, a=0.75) == {"a": 0.75, "b": 1.5}
    with pytest.raises(ParameterError, match=r"b: 1\.6 1 is outside of \[-inf, 1\.5\]"):
        values(translation, a=0.8)
    with pytest.raises(ParameterError, match=r"a: -0\.1 1 is outside of \[0, 1\]"):
        values(translation, a=-0.1)
    with pytest.raises(ParameterError, match="outside of"):
        translate(Bounded(a=2.0))


@pytest.mark.parametrize("value", ["1 m", pint.Quantity(1, "kg"), "many", float("nan"), None, [1.0]])
def test_what_is_no_value_of_the_unit_is_refused(value: Any) -> None:
    class Plant(Component):
        source = Voltage(V=value)

    with pytest.raises(UnitError) as caught:
        translate(Plant())
    assert caught.value.path == "source.V"
    assert caught.value.where.startswith("test_modifications.py:")
