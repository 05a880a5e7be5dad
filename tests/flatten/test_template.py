"""A component class is run once for all instances of one structure; the result is that of running each."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

import arthur_acausal.flatten.flatten as flatten_module
from arthur_acausal import (
    Component,
    Equations,
    Real,
    connect,
    der,
    discrete,
    if_else,
    parameter,
    pre,
    reinit,
    start,
    translate,
    variable,
    when,
)
from arthur_acausal.flatten.flatten import flatten
from tests.circuit import Capacitor, Ground, Resistor, Voltage

RUNS: list[str] = []


class Cell(Component):
    """x' = -k x (k doubled below 0.5), which jumps back to one below ``low``; a structural order."""

    order: int = 1
    k: Real = parameter("1/s", default=1.0)
    low: Real = parameter("1", default=0.2)
    x: Real = variable("1", start=1.0, fixed=True)
    jumps: Real = discrete("1")

    def equations(self) -> Equations:
        RUNS.append(type(self).__name__)
        factor = if_else(self.x < 0.5, 2.0, 1.0)
        yield "decay", der(self.x) == -factor * self.k * self.x**self.order
        yield when(self.x < self.low, reinit(self.x, 1), self.jumps == pre(self.jumps) + 1)


class Cells(Component):
    orders: tuple[int, ...] = (1, 1, 2, 1, 2)

    def build(self) -> None:
        self.cells = [Cell(order=n, k=0.5 + 0.25 * i, low=0.2 + 0.02 * i) for i, n in enumerate(self.orders)]


@pytest.fixture(autouse=True)
def counted() -> Iterator[None]:
    RUNS.clear()
    yield


def test_one_run_for_each_structure() -> None:
    flatten(Cells())
    assert RUNS == ["Cell", "Cell"], "orders 1 and 2"
    RUNS.clear()
    flatten(Cells(orders=(1,) * 50))
    assert RUNS == ["Cell"]


def test_the_same_trajectories_as_when_each_instance_is_run(monkeypatch: pytest.MonkeyPatch) -> None:
    together = translate(Cells()).simulate(4.0)
    RUNS.clear()
    monkeypatch.setattr(flatten_module, "structure_key", lambda component: None)
    apart = translate(Cells()).simulate(4.0)
    assert len(RUNS) == 5
    assert together.t.tolist() == apart.t.tolist()
    for k in range(5):
        for name in ("x", "jumps", "k"):
            path = f"cells[{k}].{name}"
            np.testing.assert_array_equal(together[path], apart[path], err_msg=path)
    assert [(e.time, e.kind) for e in together.events] == [(e.time, e.kind) for e in apart.events]
    assert together.final("cells[4].jumps") > 0, "events happened"


def test_each_cell_follows_its_own_closed_form() -> None:
    solution = translate(Cells(orders=(1, 1))).simulate(1.0, tolerance=1e-8)
    for k, rate in enumerate((0.5, 0.75)):
        # x = exp(-k t) down to 0.5 at t = ln 2 / k, then twice as fast
        t = solution.t
        half = np.log(2) / rate
        exact = np.where(t < half, np.exp(-rate * t), 0.5 * np.exp(-2 * rate * (t - half)))
        np.testing.assert_allclose(solution[f"cells[{k}].x"], exact, rtol=1e-6)


def test_events_name_the_instance() -> None:
    solution = translate(Cells(orders=(1, 1, 1))).simulate(3.0)
    texts = [e.what for e in solution.events if e.kind == "state"]
    assert any("cells[2]" in text for text in texts)
    assert not any("cells[0]" in text and "cells[1]" in text for text in texts)
    assert {e.path for e in solution.events} == {f"cells[{k}]" for k in range(3)}


def test_what_depends_on_the_instance_is_not_shared() -> None:
    class Bent(Component):
        """Its shape is an object of its own, its law an expression of its own parameters."""

        k: Real = parameter("1/s", default=1.0)
        x: Real = variable("1", start=1.0, fixed=True)

        def build(self) -> None:
            self.rate = 2 * self.k

        def equations(self) -> Equations:
            RUNS.append("Bent")
            yield der(self.x) == -self.rate * self.x

    class Two(Component):
        def build(self) -> None:
            self.items = [Bent(k=1.0), Bent(k=3.0)]

    solution = translate(Two()).simulate(0.5, tolerance=1e-8)
    assert RUNS == ["Bent", "Bent"]
    assert solution.final("items[0].x") == pytest.approx(np.exp(-1.0), rel=1e-6)
    assert solution.final("items[1].x") == pytest.approx(np.exp(-3.0), rel=1e-6)


def test_a_list_as_structural_parameter_is_no_obstacle() -> None:
    class Polynomial(Component):
        coefficients: list[float] = [1.0]
        y: Real = variable("1")

        def equations(self) -> Equations:
            RUNS.append("Polynomial")
            yield self.y == sum(c * 2.0**i for i, c in enumerate(self.coefficients)) + 0 * self.y

    class Two(Component):
        a = Polynomial(coefficients=[1.0, 2.0])
        b = Polynomial(coefficients=[3.0])

    solution = translate(Two()).simulate(1.0)
    assert (solution.final("a.y"), solution.final("b.y")) == (5.0, 3.0)


def test_values_one_and_true_are_one_structure_only_where_they_read_the_same() -> None:
    class Told(Component):
        what: object = None
        y: Real = variable("1")

        def equations(self) -> Equations:
            yield self.y == (10.0 if self.what is True else 20.0) + 0 * self.y

    class Two(Component):
        a = Told(what=1)
        b = Told(what=True)

    solution = translate(Two()).simulate(1.0)
    assert (solution.final("a.y"), solution.final("b.y")) == (20.0, 10.0)


def test_a_ladder_is_flattened_from_few_blocks() -> None:
    class Ladder(Component):
        n: int = 40
        source = Voltage(V=1.0)
        ground = Ground()

        def build(self) -> None:
            self.r = [Resistor(R=1.0) for _ in range(self.n)]
            self.c = [Capacitor(C=1.0, v=start(0.0, fixed=True)) for _ in range(self.n)]

        def equations(self) -> Equations:
            yield connect(self.source.n, self.ground.p)
            before = self.source.p
            for r, c in zip(self.r, self.c, strict=True):
                yield connect(before, r.p)
                yield connect(r.n, c.p)
                yield connect(c.n, self.ground.p)
                before = r.n

    flat = flatten(Ladder())
    expressions = {id(e.equation.residual) for e in flat.equations if e.path.startswith(("r[", "c["))}
    of_components = {
        id(e.equation.residual)
        for e in flat.equations
        if e.indices is None and e.path.startswith(("r[", "c["))
    }
    assert len(of_components) == 8, "four equations each of resistor and capacitor"
    assert len(expressions) < 20
