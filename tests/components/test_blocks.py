"""Signal blocks against their formulas."""

from __future__ import annotations

from math import exp, pi, sin, sqrt
from typing import Any

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, connect, simulate
from arthur_acausal.components.blocks import (
    PID,
    Add,
    Block,
    Clock,
    Constant,
    EnergyMeter,
    Feedback,
    FirstOrder,
    Gain,
    Integrator,
    Limiter,
    Product,
    Ramp,
    SecondOrder,
    Sine,
    Step,
    TimeTable,
    Trapezoid,
)

PRECISE = SolverOptions(rtol=1e-9, intervals=1000)


class Alone(Component):
    """One block; its inputs are those of the run."""

    block: Block = Constant()


class Driven(Component):
    """A block behind a source."""

    source: Block = Constant()
    block: Block = Gain()

    def equations(self) -> Equations:
        yield connect(self.source.y, self.block.u)  # type: ignore[attr-defined]


SOURCES: list[tuple[Block, Any]] = [
    (Constant(k=3.0), lambda t: 3.0 + 0 * t),
    (Clock(start_time=0.5), lambda t: np.maximum(t - 0.5, 0)),
    (Step(height=2.0, offset=1.0, start_time=0.3), lambda t: np.where(t < 0.3, 1.0, 3.0)),
    (
        Ramp(height=2.0, offset=1.0, start_time=0.3, duration=0.6),
        lambda t: 1 + 2 * np.clip((t - 0.3) / 0.6, 0, 1),
    ),
    (
        Sine(amplitude=2.0, f=1.5, phase=0.2, offset=1.0, start_time=0.3),
        lambda t: 1 + np.where(t < 0.3, 0, 2 * np.sin(2 * pi * 1.5 * (t - 0.3) + 0.2)),
    ),
    (
        Trapezoid(amplitude=2.0, rising=0.1, width=0.2, falling=0.1, period=0.7, offset=1.0),
        lambda t: 1 + 2 * np.interp(t % 0.7, [0, 0.1, 0.3, 0.4, 0.7], [0, 1, 1, 0, 0]),
    ),
    (
        TimeTable(times=(0.2, 0.5, 1.5), values=(1.0, -1.0, 4.0)),
        lambda t: np.interp(t, [0.2, 0.5, 1.5], [1, -1, 4]),
    ),
    (
        TimeTable(times=(0.2, 0.5, 1.5), values=(1.0, -1.0, 4.0), events=True),
        lambda t: np.interp(t, [0.2, 0.5, 1.5], [1, -1, 4]),
    ),
]


@pytest.mark.parametrize(("source", "formula"), SOURCES, ids=lambda x: type(x).__name__)
def test_a_source_follows_its_formula(source: Block, formula: Any) -> None:
    solution = simulate(Alone(block=source), 2.0, options=SolverOptions(intervals=2000))
    t, y = solution.t, solution["block.y"]
    jumps = np.array([event.time for event in solution.events])
    smooth = np.array([not np.any(np.abs(jumps - x) < 1e-9) for x in t])
    assert np.max(np.abs(y - formula(t))[smooth]) < 1e-9


def test_corners_of_sources_are_events() -> None:
    solution = simulate(Alone(block=Trapezoid(rising=0.1, width=0.2, falling=0.1, period=0.7)), 1.5)
    times = sorted({round(event.time, 9) for event in solution.events})
    assert times == pytest.approx([0.1, 0.3, 0.4, 0.7, 0.8, 1.0, 1.1, 1.4, 1.5][: len(times)])
    assert len(times) >= 8


def test_an_integrator_integrates() -> None:
    solution = simulate(
        Driven(source=Ramp(duration=2.0, height=2.0), block=Integrator(k=3.0, y_start=1.0)),
        2.0,
        options=PRECISE,
    )
    assert solution.final("block.y") == pytest.approx(1 + 3 * 2.0**2 / 2, rel=1e-8)


def test_a_first_order_lag() -> None:
    solution = simulate(Driven(source=Constant(k=1.0), block=FirstOrder(k=2.0, T=0.5)), 1.0, options=PRECISE)
    assert solution.final("block.y") == pytest.approx(2 * (1 - exp(-2)), rel=1e-7)


def test_a_second_order_lag() -> None:
    w, D, t = 10.0, 0.2, 0.37
    solution = simulate(
        Driven(source=Constant(k=1.0), block=SecondOrder(k=2.0, w=w, D=D)), t, options=PRECISE
    )
    damped = w * sqrt(1 - D**2)
    step = 1 - exp(-D * w * t) * (np.cos(damped * t) + D * w / damped * sin(damped * t))
    assert solution.final("block.y") == pytest.approx(2 * step, rel=1e-7)


class Binary(Component):
    """A block of two inputs behind two constants."""

    a: Constant = Constant(k=3.0)
    b: Constant = Constant(k=4.0)
    block: Block = Add()

    def equations(self) -> Equations:
        yield connect(self.a.y, self.block.u1)  # type: ignore[attr-defined]
        yield connect(self.b.y, self.block.u2)  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("block", "result"), [(Add(k1=2.0, k2=-1.0), 2.0), (Feedback(), -1.0), (Product(), 12.0)]
)
def test_blocks_of_two_inputs(block: Block, result: float) -> None:
    assert simulate(Binary(block=block), 1.0).final("block.y") == result


@pytest.mark.parametrize(
    ("block", "u", "result"),
    [(Gain(k=3.0), 2.0, 6.0), (Limiter(y_max=2.0), 5.0, 2.0), (Limiter(y_max=2.0), -5.0, -2.0)],
)
def test_blocks_of_one_input(block: Block, u: float, result: float) -> None:
    assert simulate(Driven(source=Constant(k=u), block=block), 1.0).final("block.y") == result


class Loop(Component):
    """A PID controller on a first-order plant."""

    pid: PID = PID(k=5.0, T_i=0.5, T_d=0.01)
    plant: FirstOrder = FirstOrder(k=2.0, T=1.0)
    target: Step = Step(height=1.0)

    def equations(self) -> Equations:
        yield connect(self.target.y, self.pid.u_s)
        yield connect(self.plant.y, self.pid.u_m)
        yield connect(self.pid.y, self.plant.u)


def test_a_pid_controller_reaches_its_target() -> None:
    assert simulate(Loop(), 10.0).final("plant.y") == pytest.approx(1.0, rel=1e-4)


def test_a_limited_pid_controller_does_not_wind_up() -> None:
    """Limited to just more than the plant needs, it comes back from the limit with little overshoot."""
    solution = simulate(Loop(pid=PID(k=5.0, T_i=0.5, T_d=0.01, T_t=0.1, y_max=0.6, y_min=0.0)), 20.0)
    assert max(solution["plant.y"]) < 1.05
    assert solution.final("plant.y") == pytest.approx(1.0, rel=1e-3)


class Metered(Component):
    """Two powers into one meter."""

    a: Block = Constant.of("W")(k=3.0)
    b: Block = Constant.of("W")(k=4.0)

    def build(self) -> None:
        self.meter = EnergyMeter.of(2)()

    def equations(self) -> Equations:
        for block, into in zip((self.a, self.b), self.meter.inputs(), strict=True):
            yield connect(block.y, into)  # type: ignore[attr-defined]


def test_an_energy_meter_adds_up_its_powers() -> None:
    assert simulate(Metered(), 2.0).final("meter.E") == pytest.approx(14.0, rel=1e-9)
