"""Ways to the initial values: initial(), homotopy, rest; with the values that are known in closed form."""

from __future__ import annotations

import math

import casadi as ca
import pytest

from arthur_acausal import (
    Component,
    Equations,
    InitializationError,
    Real,
    der,
    discrete,
    homotopy,
    if_else,
    initial,
    parameter,
    reinit,
    terminate,
    translate,
    variable,
    when,
)
from arthur_acausal.codegen.portable import from_bytes
from arthur_acausal.solve.simulate import simulate

# The real root of x^3 - 2 x + 2 by Cardano's formula. From x = 1 Newton's method is caught at the minimum beside it.
ROOT = -math.cbrt(1 + math.sqrt(19 / 27)) - math.cbrt(1 - math.sqrt(19 / 27))


def cubic(x: ca.SX) -> ca.SX:
    return x**3 - 2 * x + 2


class Algebraic(Component):
    """x in an algebraic equation; ``blended``: by way of a line."""

    blended: bool = True
    x: Real = variable("1", start=1.0)
    s: Real = variable("1", start=0.5, fixed=True)
    k: Real = parameter("1/s", default=1.0)

    def equations(self) -> Equations:
        yield "cubic", (homotopy(cubic(self.x), self.x + 3) if self.blended else cubic(self.x)) == 0
        yield der(self.s) == self.k * (self.x - self.s)


def test_newton_alone_fails_and_names_the_equation_with_its_residual() -> None:
    with pytest.raises(InitializationError, match=r'"cubic" \(test_start.py:\d+\): .* \(scaled '):
        translate(Algebraic(blended=False)).simulate(1.0)


def test_homotopy_leads_to_the_root() -> None:
    model = translate(Algebraic())
    solution = model.simulate(1.0)
    assert solution.initial("x") == pytest.approx(ROOT, rel=1e-12)
    assert solution.statistics.initial_method == "homotopy"
    assert any("homotopy" in message for message in solution.statistics.messages)
    assert model.verify(solution).largest < 1e-10


def test_homotopy_is_left_out_where_newton_gets_there() -> None:
    solution = translate(Algebraic()).simulate(1.0, start={"x": -2.0})
    assert solution.initial("x") == pytest.approx(ROOT, rel=1e-12)
    assert solution.statistics.initial_method == "Newton"
    assert solution.statistics.messages == []


def test_the_run_has_the_actual_expression_only() -> None:
    model = translate(Algebraic())
    assert "homotopy" not in str(
        model.dae.functions["residual"].expand().call(model.dae.functions["residual"].sx_in())
    )
    assert model.dae.starting is not None
    assert model.dae.starting.parameter_vector().size == model.dae.parameter_vector().size + 1


def test_a_system_from_bytes_starts_likewise() -> None:
    dae = from_bytes(translate(Algebraic()).to_bytes())
    found = simulate(dae, stop_time=1.0)
    assert found.y[0, dae.y_paths.index("x")] == pytest.approx(ROOT, rel=1e-12)


class NoWay(Algebraic):
    def equations(self) -> Equations:
        yield "no root", homotopy(self.x**2 + 1, self.x) == 0
        yield der(self.s) == self.k * (self.x - self.s)


def test_a_homotopy_that_ends_on_the_way_says_where() -> None:
    # a (x^2 + 1) + (1 - a) x has real roots up to a = 1/3
    with pytest.raises(InitializationError, match=r'"no root".*; homotopy: stopped at 0.333 of the way'):
        translate(NoWay()).simulate(1.0)


class Resting(Component):
    """x moves down the slope of a cubic; it begins at rest."""

    tau: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=1.0)

    def equations(self) -> Equations:
        yield "slope", self.tau * der(self.x) == -cubic(self.x)

    def initial_equations(self) -> Equations:
        yield der(self.x) == 0


def test_a_rest_that_newton_misses_is_reached_in_time() -> None:
    solution = translate(Resting()).simulate(1.0)
    assert solution.initial("x") == pytest.approx(ROOT, rel=1e-10)
    assert solution.final("x") == pytest.approx(ROOT, rel=1e-6)
    assert solution.statistics.initial_method == "pseudo-transient"


class Switched(Component):
    """What stands in initial() holds at the start only."""

    T: Real = parameter("s", default=2.0)
    x: Real = variable("1")
    u: Real = variable("1")
    kept: Real = discrete("1")
    begun: Real = discrete("1")

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.u - self.x
        yield self.u == if_else(initial(), 5.0, 1.0)
        yield when(initial(), self.kept == 3 * self.x)
        yield when(ca.logic_not(initial()), self.begun == 1.0)

    def initial_equations(self) -> Equations:
        yield der(self.x) == 0


def test_initial_is_true_while_initial_values_are_sought() -> None:
    model = translate(Switched())
    solution = model.simulate(1.0)
    assert solution.initial("x") == pytest.approx(5.0)
    assert solution.initial("u") == pytest.approx(1.0)  # the run has begun
    assert solution.final("kept") == pytest.approx(15.0)
    assert solution.final("x") == pytest.approx(1 + 4 * math.exp(-0.5), rel=1e-5)
    assert model.verify(solution).largest < 1e-9


class Restarted(Component):
    x: Real = variable("1", start=1.0, fixed=True)
    T: Real = parameter("s", default=1.0)
    ends: bool = False

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -self.x
        yield when(ca.logic_or(initial(), self.x < 0.5), reinit(self.x, 2 * self.x + 2))
        if self.ends:
            yield when(initial(), terminate("at once"))


def test_a_when_with_initial_acts_at_the_start_and_later() -> None:
    solution = translate(Restarted()).simulate(3.0)
    assert solution.initial("x") == pytest.approx(4.0)
    assert [e.time for e in solution.events if e.kind == "when"] == pytest.approx([math.log(8.0)], rel=1e-5)
    assert solution.final("x") == pytest.approx(3.0 * math.exp(math.log(8.0) - 3.0), rel=1e-5)


def test_terminate_at_the_start() -> None:
    solution = translate(Restarted(ends=True)).simulate(3.0)
    assert (solution.run.status, solution.run.message) == ("terminated", "at once")
    assert solution.t.tolist() == [0.0]


def test_a_model_without_these_has_no_system_of_its_own_for_the_start() -> None:
    assert translate(Resting()).dae.starting is None


class Pair(Component):
    """Two unknowns of one block; either can be torn. a (a + 2) = 3: a = 1 or -3, b = a + 1."""

    a: Real = variable("1")
    b: Real = variable("1")
    s: Real = variable("1", start=0.0, fixed=True)
    k: Real = parameter("1/s", default=1.0)

    def equations(self) -> Equations:
        yield self.a == self.b - 1
        yield self.b == 3 / (self.a + 2) + 1
        yield der(self.s) == self.k * self.a


class Outer(Component):
    pair: Pair = Pair()
    twin: Pair = Pair()

    def equations(self) -> Equations:
        yield from ()


@pytest.mark.parametrize(
    ("guess", "root"), [({"a": 1.5}, 1.0), ({"a": -5.0}, -3.0), ({"b": 3.0}, 1.0), ({"b": -4.0}, -3.0)]
)
def test_a_variable_with_a_given_start_is_torn_and_begins_there(guess: dict[str, float], root: float) -> None:
    solution = translate(Outer(pair=Pair(**guess))).simulate(1.0)
    assert solution.initial("pair.a") == pytest.approx(root)
    assert not any("nothing uses" in message for message in solution.statistics.messages)


def test_a_start_value_that_nothing_uses_is_told_of() -> None:
    model = translate(Outer(pair=Pair(a=1.5, b=3.0)))
    torn = next(path for path in ("pair.a", "pair.b") if path in model.report.torn)
    other = ({"pair.a", "pair.b"} - {torn}).pop()
    told = model.simulate(1.0).statistics.messages
    assert any(m.startswith("start values that nothing uses") and other in m and torn not in m for m in told)


def test_a_run_may_give_a_guess_to_any_unknown() -> None:
    model = translate(Outer())
    torn = model.report.torn[0]
    offset = 0.0 if torn.endswith("a") else 1.0
    for guess, root in ((3.0, 1.0), (-6.0, -3.0)):
        solution = model.simulate(1.0, start={torn: guess})
        assert solution.initial("pair.a") == pytest.approx(root)
        assert solution.initial(torn) == pytest.approx(root + offset)


class Sum(Component):
    """x + y + z = 10, so that two of the three keep their start: the small ones, which move more in their own units."""

    x: Real = variable("1", start=1.0, nominal=100.0)
    y: Real = variable("1", start=2.0, nominal=0.1)
    z: Real = variable("1", start=0.5, nominal=0.01)
    w: Real = variable("1")
    T: Real = parameter("s", default=1.0)

    def equations(self) -> Equations:
        for state in (self.x, self.y, self.z, self.w):
            yield self.T * der(state) == -state

    def initial_equations(self) -> Equations:
        yield self.x + self.y + self.z == 10


def test_states_to_hold_are_chosen_by_their_nominals_and_told_with_their_origin() -> None:
    solution = translate(Sum()).simulate(1.0)
    assert [solution.initial(p) for p in "xyzw"] == pytest.approx([7.5, 2.0, 0.5, 0.0])
    (told,) = solution.statistics.messages
    assert told.startswith("no initial condition, start value taken: y = 2 (test_start.py:")
    assert told.endswith("w = 0 (no start value given)")
