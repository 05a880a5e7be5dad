"""Signals: one source each, through any number of levels."""

from __future__ import annotations

import pytest

from arthur_acausal import (
    Component,
    ConnectError,
    Equations,
    Real,
    connect,
    parameter,
    real_input,
    real_output,
    simulate,
    translate,
)
from arthur_acausal.flatten.flatten import flatten
from tests.flatten.test_connections import equal


class Gain(Component):
    k: Real = parameter("1", default=2.0)
    u: Real = real_input("V")
    y: Real = real_output("V")

    def equations(self) -> Equations:
        yield self.y == self.k * self.u


class Twice(Component):
    """Signals through two levels: own input to a part, part to part, part to own output."""

    u: Real = real_input("V")
    y: Real = real_output("V")
    first = Gain(k=2.0)
    second = Gain(k=5.0)

    def equations(self) -> Equations:
        yield connect(self.u, self.first.u)
        yield connect(self.second.u, self.first.y)  # the order does not matter
        yield connect(self.y, self.second.y)


class Chain(Component):
    u: Real = real_input("V", default=1.5)
    inner = Twice()
    last = Gain(k=-1.0)
    y: Real = real_output("V")

    def equations(self) -> Equations:
        yield connect(self.u, self.inner.u)
        yield connect(self.inner.y, self.last.u)
        yield connect(self.last.y, self.y)


def test_signals_pass_through_the_hierarchy() -> None:
    translation = translate(Chain())
    assert translation.dae.u_paths == ["u"]
    assert translation.simulate(1.0).final("y") == -15.0
    solution = translation.simulate(1.0, inputs={"u": lambda t: 2 * t})
    assert solution.final("y") == pytest.approx(-20.0)
    assert solution.final("inner.first.u") == pytest.approx(2.0)


def test_one_output_may_drive_many_inputs() -> None:
    class Fan(Component):
        source = Gain(k=3.0)
        left = Gain()
        right = Gain(k=7.0)
        u: Real = real_input("V", default=1.0)

        def equations(self) -> Equations:
            yield connect(self.u, self.source.u)
            yield connect(self.source.y, self.left.u)
            yield connect(self.source.y, self.right.u)

    solution = simulate(Fan(), 1.0)
    assert (solution.final("left.y"), solution.final("right.y")) == (6.0, 21.0)


def test_an_input_of_a_part_with_a_default_is_an_input_of_the_model() -> None:
    class Idle(Component):
        k: Real = parameter("1", default=4.0)
        u: Real = real_input("V", default=0.5)
        y: Real = real_output("V")

        def equations(self) -> Equations:
            yield self.y == self.k * self.u

    class Plant(Component):
        idle = Idle()

    translation = translate(Plant())
    assert translation.dae.u_paths == ["idle.u"]
    assert translation.simulate(1.0).final("idle.y") == 2.0
    assert translation.simulate(1.0, inputs={"idle.u": 3.0}).final("idle.y") == 12.0


def signals(kind: str) -> Component:
    class Wrong(Component):
        u: Real = real_input("V", default=0.0)
        w: Real = real_input("V", default=0.0)
        first = Gain()
        second = Gain()

        def equations(self) -> Equations:
            if kind == "two own inputs":
                yield connect(self.u, self.w)
            elif kind == "two inputs of parts":
                yield connect(self.first.u, self.second.u)
            elif kind == "two outputs of parts":
                yield connect(self.first.y, self.second.y)
            elif kind == "own input to an output":
                yield connect(self.u, self.first.y)
            elif kind == "twice":
                yield connect(self.u, self.first.u)
                yield connect(self.w, self.first.u)

    return Wrong()


@pytest.mark.parametrize(
    "kind",
    ["two own inputs", "two inputs of parts", "two outputs of parts", "own input to an output", "twice"],
)
def test_signals_have_one_source(kind: str) -> None:
    with pytest.raises(ConnectError) as caught:
        flatten(signals(kind))
    assert caught.value.where.startswith("test_signals.py:")
    assert caught.value.remedy


def test_units_that_mean_the_same_fit() -> None:
    class Torque(Component):
        y: Real = real_output("N*m")

        def equations(self) -> Equations:
            yield self.y == self.y / 2

    class Meter(Component):
        u: Real = real_input("J")

    class Rig(Component):
        torque = Torque()
        meter = Meter()

        def equations(self) -> Equations:
            yield connect(self.torque.y, self.meter.u)

    assert equal(flatten(Rig())) == {frozenset({"torque.y", "meter.u"})}
