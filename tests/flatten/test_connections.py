"""Connection sets by Modelica's rules (specification 3.6, chapter 9), read off the flat system."""

from __future__ import annotations

from itertools import pairwise

import pytest

from arthur_acausal import (
    Component,
    Equations,
    Real,
    connect,
    parameter,
    simulate,
    start,
    variable,
)
from arthur_acausal.flatten.flatten import flatten
from arthur_acausal.flatten.system import FlatSystem
from arthur_acausal.graph import Union
from tests.circuit import Capacitor, Current, Ground, Pin, Resistor, TwoPin, Voltage


def sums(flat: FlatSystem) -> set[frozenset[tuple[str, int]]]:
    """Flow balances: the signed paths of each, the first (by name) positive."""
    found = set()
    for equation in flat.equations:
        if equation.indices is not None:
            slopes = {flat.variables[i].path: 1 for i in equation.indices}
            text = str(equation.equation.residual.value)
            for i, symbol in zip(equation.indices, equation.equation.symbols, strict=True):
                if f"-{symbol}" in text:
                    slopes[flat.variables[i].path] = -1
            turn = slopes[min(slopes)]
            found.add(frozenset((path, turn * sign) for path, sign in slopes.items()))
    return found


def equal(flat: FlatSystem) -> set[frozenset[str]]:
    """Sets of variables that connections make equal."""
    union = Union(len(flat.variables))
    for alias in flat.aliases:
        union.union(alias.i, alias.j)
    paths = [d.path for d in flat.variables]
    return {frozenset(paths[i] for i in members) for members in union.sets() if len(members) > 1}


def balance(**flows: int) -> frozenset[tuple[str, int]]:
    return frozenset((path.replace("_", "."), sign) for path, sign in flows.items())


class Star(Component):
    """Three resistors meet; the far ends of two are left open."""

    a = Resistor()
    b = Resistor()
    c = Resistor()
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.a.p, self.b.p)
        yield connect(self.b.p, self.c.p)
        yield connect(self.c.n, self.ground.p)


def test_flows_that_meet_sum_to_zero_and_open_ends_have_none() -> None:
    flat = flatten(Star())
    assert sums(flat) == {
        balance(a_p_i=1, b_p_i=1, c_p_i=1),
        balance(c_n_i=1, ground_p_i=1),
        balance(a_n_i=1),
        balance(b_n_i=1),
    }
    assert equal(flat) == {frozenset({"a.p.v", "b.p.v", "c.p.v"}), frozenset({"c.n.v", "ground.p.v"})}


def test_a_connection_around_a_loop_adds_no_equation() -> None:
    class Loop(Star):
        def equations(self) -> Equations:
            yield from super().equations()
            yield connect(self.c.p, self.a.p)
            yield connect(self.a.p, self.b.p)  # and once more

    assert sums(flatten(Loop())) == sums(flatten(Star()))
    assert len(flatten(Loop()).aliases) == len(flatten(Star()).aliases)


class Divider(Component):
    """Two resistors in series with a tap: hierarchical, with connectors of its own."""

    p = Pin()
    tap = Pin()
    n = Pin()
    R: Real = parameter("ohm", default=100.0)
    upper: Resistor = Resistor(R=lambda self: self.R)
    lower: Resistor = Resistor(R=lambda self: 3 * self.R)

    def equations(self) -> Equations:
        yield connect(self.p, self.upper.p)
        yield connect(self.upper.n, self.lower.p)
        yield connect(self.lower.p, self.tap)
        yield connect(self.lower.n, self.n)


class Bench(Component):
    source = Voltage(V=8.0)
    divider: Divider = Divider()
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.divider.p)
        yield connect(self.source.n, self.divider.n)
        yield connect(self.source.n, self.ground.p)


def test_a_connector_counts_outside_and_negatively_inside_its_component() -> None:
    flat = flatten(Bench())
    assert sums(flat) == {
        balance(source_p_i=1, divider_p_i=1),
        balance(divider_p_i=1, divider_upper_p_i=-1),
        balance(divider_lower_p_i=1, divider_tap_i=-1, divider_upper_n_i=1),
        balance(divider_lower_n_i=1, divider_n_i=-1),
        balance(divider_n_i=1, source_n_i=1, ground_p_i=1),
        balance(divider_tap_i=1),
    }


def test_what_flows_into_a_component_flows_into_its_parts() -> None:
    class Loaded(Bench):
        load = Resistor(R=300.0)

        def equations(self) -> Equations:
            yield from super().equations()
            yield connect(self.divider.tap, self.load.p)
            yield connect(self.load.n, self.ground.p)

    solution = simulate(Loaded(), 1.0)
    # 300 || 300 = 150 ohm below 100 ohm at 8 V: 32 mA, 4.8 V at the tap, half of the current through the load
    assert solution.final("divider.tap.v") == pytest.approx(4.8)
    assert solution.final("divider.p.i") == pytest.approx(0.032)
    assert solution.final("divider.upper.i") == pytest.approx(0.032)
    assert solution.final("divider.tap.i") == pytest.approx(-0.016), "positive into the component"
    assert solution.final("load.p.i") == pytest.approx(0.016)
    assert solution.final("source.i") == pytest.approx(-0.032)


def test_an_outer_connector_left_open_by_all_has_no_flow() -> None:
    solution = simulate(Bench(), 1.0)
    assert solution.final("divider.tap.i") == 0.0
    assert solution.final("divider.tap.v") == pytest.approx(6.0)


def test_a_connector_may_pass_through_a_component() -> None:
    class Through(Component):
        p = Pin()
        n = Pin()
        idle = Ground()

        def equations(self) -> Equations:
            yield connect(self.p, self.n)

    class Line(Component):
        source = Voltage(V=3.0)
        through = Through()
        load = Resistor(R=2.0)
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.through.p)
            yield connect(self.through.n, self.load.p)
            yield connect(self.load.n, self.source.n)
            yield connect(self.ground.p, self.source.n)

    assert simulate(Line(), 1.0).final("through.p.i") == pytest.approx(1.5)


def test_a_component_may_use_its_own_connector_in_equations_and_connections() -> None:
    class Guarded(Component):
        p = Pin()
        leak = Resistor(R=10.0)
        earth = Ground()
        power: Real = variable("W")

        def equations(self) -> Equations:
            yield connect(self.p, self.leak.p)
            yield connect(self.leak.n, self.earth.p)
            yield self.power == self.p.v * self.p.i

    class Rig(Component):
        source = Current(I=-2.0)
        guarded = Guarded()
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.guarded.p)
            yield connect(self.source.n, self.ground.p)

    assert simulate(Rig(), 1.0).final("guarded.power") == pytest.approx(40.0)


def test_a_list_of_parts_in_a_row_is_a_series_circuit() -> None:
    class Row(Component):
        n: int = 5
        source = Voltage(V=10.0)
        ground = Ground()

        def build(self) -> None:
            self.items = [Resistor(R=float(k + 1)) for k in range(self.n)]

        def equations(self) -> Equations:
            ends: list[TwoPin] = [self.source, *self.items]
            yield connect(self.source.p, ends[1].p)
            for a, b in pairwise(ends[1:]):
                yield connect(a.n, b.p)
            yield connect(ends[-1].n, self.source.n)
            yield connect(self.source.n, self.ground.p)

    assert simulate(Row(), 1.0).final("items[3].i") == pytest.approx(10 / 15)
    assert simulate(Row(n=1), 1.0).final("items[0].i") == pytest.approx(10.0)


def test_initial_currents_of_a_discharge_obey_kirchhoff() -> None:
    class Discharge(Component):
        store = Capacitor(C=1e-3, v=start(12.0, fixed=True))
        fast = Resistor(R=10.0)
        slow = Resistor(R=30.0)
        ground = Ground()

        def equations(self) -> Equations:
            for part in (self.fast, self.slow):
                yield connect(self.store.p, part.p)
                yield connect(self.store.n, part.n)
            yield connect(self.ground.p, self.store.n)

    solution = simulate(Discharge(), 0.0075, tolerance=1e-8)
    assert solution["store.i"] + solution["fast.i"] + solution["slow.i"] == pytest.approx(0.0, abs=1e-12)
    # R = 7.5 ohm: v = 12 exp(-t / 7.5 ms)
    assert solution.final("store.v") == pytest.approx(12 * 2.718281828459045**-1, rel=1e-7)
