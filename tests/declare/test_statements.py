"""der, pre, time, if_else and when: what they make, and where they may stand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np
import pytest
from casadi import SX

from arthur_acausal import (
    Component,
    DeclarationError,
    Equations,
    Real,
    connect,
    der,
    discrete,
    if_else,
    parameter,
    pre,
    reinit,
    simulate,
    smooth_if_else,
    terminate,
    time,
    translate,
    variable,
    when,
)
from arthur_acausal.declare.bind import bind_root
from arthur_acausal.declare.scope import Scope, using


class Point(Component):
    a: Real = parameter("1", default=2.0)
    x: Real = variable("1")
    y: Real = variable("1")
    n: Real = discrete("1")


@pytest.fixture
def point() -> Any:
    """A bound component whose scope is the current one."""
    scope = Scope()
    root = bind_root(Point(), scope)
    with using(scope):
        yield root


def number(expression: SX, **values: float) -> float:
    """An expression evaluated at values by the names of its symbols."""
    symbols = ca.symvar(expression)
    if not symbols:
        return float(expression)
    return float(ca.Function("f", symbols, [expression])(*(values[str(s)] for s in symbols)))


# d/dt f at x = 0.5, y = 3, x' = 7, y' = -1, a = 2, t = 0.25, by hand
DERIVATIVES: list[tuple[str, Callable[[Any], SX], float]] = [
    ("variable", lambda s: s.x, 7.0),
    ("product", lambda s: s.x * s.y, 7.0 * 3 + 0.5 * -1),
    ("power", lambda s: s.y**3, 3 * 9 * -1),
    ("parameter", lambda s: s.a * s.x, 14.0),
    ("quotient", lambda s: s.x / s.y, 7 / 3 + 0.5 / 9),
    ("sine", lambda s: ca.sin(s.a * s.x), float(np.cos(1.0)) * 14.0),
    ("with time", lambda s: time() * s.x, 0.5 + 0.25 * 7),
    ("of time", lambda s: time() ** 2, 0.5),
    ("of a discrete", lambda s: s.n * s.x, 11.0 * 7),
    ("twice the same", lambda s: s.x + s.x, 14.0),
    ("constant", lambda s: s.a + 0 * s.x, 0.0),
]


@pytest.mark.parametrize(("f", "expected"), [d[1:] for d in DERIVATIVES], ids=[d[0] for d in DERIVATIVES])
def test_der_is_the_chain_rule(point: Point, f: Callable[[Any], SX], expected: float) -> None:
    at = {"x": 0.5, "y": 3.0, "der(x)": 7.0, "der(y)": -1.0, "a": 2.0, "time": 0.25, "n": 11.0}
    assert number(der(f(point)), **at) == pytest.approx(expected, rel=1e-14)


def test_der_of_a_variable_is_one_symbol(point: Point) -> None:
    assert der(point.x).element_hash() == der(point.x).element_hash()
    assert str(der(point.x)) == "der(x)"


@pytest.mark.parametrize("wrong", [3.0, "x", None])
def test_der_takes_expressions(point: Point, wrong: Any) -> None:
    with pytest.raises(DeclarationError, match="der\\(\\) takes"):
        der(wrong)


def test_pre_takes_a_variable(point: Point) -> None:
    assert str(pre(point.n)) == "pre(n)"
    with pytest.raises(DeclarationError, match="pre\\(\\) takes a variable"):
        pre(point.x + 1)


def test_if_else_makes_one_relation_for_each_comparison(point: Point) -> None:
    scope: Scope = point._binding.scope  # type: ignore[union-attr]
    condition = ca.logic_or(ca.logic_and(point.x > 0, point.y <= 2), ca.logic_not(point.x >= point.y))
    chosen = if_else(condition, 10.0, 20.0)
    # casadi turns a > b round to b < a: g > 0 is what holds
    found = [(r.inclusive, number(r.g, x=5.0, y=3.0)) for r in scope.relations]
    assert found == [(False, 5.0), (True, -1.0), (True, 2.0)]
    modes = {f"relation[{k}]": 0.0 for k in range(3)}
    assert number(chosen, **modes) == 10.0, "not x >= y"
    assert number(chosen, **(modes | {"relation[2]": 1.0})) == 20.0
    assert number(chosen, **dict.fromkeys(modes, 1.0)) == 10.0


def test_smooth_if_else_makes_none_and_a_truth_value_decides_at_once(point: Point) -> None:
    scope: Scope = point._binding.scope  # type: ignore[union-attr]
    assert number(smooth_if_else(point.x > 0, point.x, -point.x), x=-3.0) == 3.0
    assert float(if_else(True, 1.0, 2.0)) == 1.0
    assert float(if_else(False, 1.0, 2.0)) == 2.0
    assert scope.relations == []


@pytest.mark.parametrize("condition", [lambda s: s.x + 1, lambda s: ca.sin(s.x), lambda s: s.x == s.y])
def test_what_is_no_condition(point: Point, condition: Callable[[Any], SX]) -> None:
    with pytest.raises(DeclarationError, match="is no condition"):
        if_else(condition(point), 1.0, 2.0)


def test_connect_takes_connectors_or_signals(point: Point) -> None:
    with pytest.raises(DeclarationError, match="takes connectors or signals"):
        connect(point, point)
    with pytest.raises(DeclarationError, match=r"not 3\.0"):
        connect(3.0, point.x)


@pytest.mark.parametrize("call", [time, lambda: der(SX.sym("x")), lambda: if_else(SX.sym("x") > 0, 1, 2)])
def test_statements_stand_in_equations_only(call: Callable[[], Any]) -> None:
    with pytest.raises(DeclarationError, match="outside of equations"):
        call()


def test_symbols_exist_within_a_model_only() -> None:
    loose = Point()
    with pytest.raises(DeclarationError, match=r"Point\.x has no symbol here"):
        _ = loose.x
    assert float(loose.a) == 2.0, "a plain number is known before"


class Clock(Component):
    """Counts the seconds by discrete variables, and ends after the fourth."""

    second: Real = parameter("s", default=1.0)
    stop: Real = parameter("1", default=4.0)
    k: Real = variable("1", start=0.0, fixed=True)
    s: Real = variable("s", start=0.0, fixed=True)
    ticks: Real = discrete("1", start=10.0)
    before: Real = discrete("1")
    double: Real = discrete("1")

    def equations(self) -> Equations:
        yield der(self.k) == 1 / self.second
        yield der(self.s) == 1.0
        yield (
            "tick",
            when(
                self.s >= self.second,
                reinit(self.s, 0),
                self.ticks == pre(self.ticks) + 1,
                self.before == pre(self.ticks),
            ),
        )
        yield self.double == 2 * self.ticks
        yield when(self.k > self.stop - 0.5, terminate("enough"))


def test_discrete_variables_change_at_events_and_keep_in_between() -> None:
    solution = simulate(Clock(), 10.0)
    assert solution.t[-1] == pytest.approx(3.5, abs=1e-6)
    assert solution.run.status == "terminated"
    assert solution.run.message == "enough"
    for t, ticks in [(0.5, 10.0), (1.5, 11.0), (2.5, 12.0), (3.25, 13.0)]:
        k = int(np.searchsorted(solution.t, t))
        assert solution["ticks"][k] == ticks
        assert solution["double"][k] == 2 * ticks, "an equation of a discrete holds at every event"
        assert solution["before"][k] == (ticks - 1 if ticks > 10 else 0)
        assert solution["s"][k] == pytest.approx(solution.t[k] - (ticks - 10), abs=1e-6)


def test_relations_of_parameter_values_make_no_events() -> None:
    class Sized(Component):
        a: Real = parameter("1", default=3.0)
        b: Real = parameter("1", default=lambda self: if_else(self.a > 2, 10.0, 20.0))

    translation = translate(Sized())
    assert translation.dae.relations == []
    assert translation.dae.parameters.vector().tolist() == [3.0, 10.0]
    assert translation.dae.parameters.vector({"a": 1.0}).tolist() == [1.0, 20.0]
