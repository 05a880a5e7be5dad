"""Functions, nonlinear, logical and sampled blocks, tables, sources against their formulas."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from arthur_acausal import Component, DeclarationError, Equations, SolverOptions, connect, simulate
from arthur_acausal.components import blocks
from arthur_acausal.components.blocks import (
    SISO,
    Add3,
    And,
    Backlash,
    Block,
    Clock,
    Constant,
    Cosine,
    DeadZone,
    ExpSine,
    GreaterThreshold,
    Hysteresis,
    KinematicPTP,
    LessThreshold,
    Not,
    OnDelay,
    OnOffController,
    Or,
    Pulse,
    Ramp,
    RSFlipFlop,
    Sampler,
    Sine,
    SlewRateLimiter,
    Source,
    Sum,
    Switch,
    Table1D,
    Table2D,
    Timer,
    TimeTable,
    TriggeredSampler,
    UnitDelay,
    VariableLimiter,
    Xor,
    ZeroOrderHold,
)

OPTIONS = SolverOptions(rtol=1e-8, intervals=400)


class Driven(Component):
    """A source and a block of one input."""

    source: Source = Sine(f=1.0, amplitude=2.0)
    block: SISO = blocks.Abs()

    def equations(self) -> Equations:
        yield connect(self.source.y, self.block.u)


def away(t: np.ndarray, *corners: float) -> np.ndarray:
    """Where no corner is near: at a corner the two rows of an event differ."""
    return np.asarray(np.all([np.abs(t - c) > 1e-6 for c in corners], axis=0))


@pytest.mark.parametrize(
    ("block", "formula"),
    [
        (blocks.Abs(), np.abs),
        (blocks.Sin(), np.sin),
        (blocks.Cos(), np.cos),
        (blocks.Tan(), lambda u: np.tan(u)),
        (blocks.Atan(), np.arctan),
        (blocks.Exp(), np.exp),
        (DeadZone(u_max=0.5, u_min=-1.0), lambda u: u - np.clip(u, -1.0, 0.5)),
        (
            Table1D(us=(-1.0, 0.0, 2.0), ys=(3.0, 0.0, 1.0)),
            lambda u: np.interp(u, (-1.0, 0.0, 2.0), (3.0, 0.0, 1.0)),
        ),
    ],
    ids=lambda value: type(value).__name__,
)
def test_functions_of_one_signal(block: SISO, formula: Any) -> None:
    source = Sine(f=1.0, amplitude=1.4)
    solution = simulate(Driven(source=source, block=block), stop_time=1.0)
    assert solution["block.y"] == pytest.approx(formula(solution["source.y"]), abs=1e-9)


@pytest.mark.parametrize(
    ("block", "formula"),
    [
        (blocks.Sqrt(), np.sqrt),
        (blocks.Log(), np.log),
        (blocks.Asin(), np.arcsin),
        (blocks.Acos(), np.arccos),
        (blocks.Sign(), np.sign),
    ],
    ids=lambda value: type(value).__name__,
)
def test_functions_of_a_positive_signal(block: SISO, formula: Any) -> None:
    solution = simulate(Driven(source=Ramp(offset=0.1, height=0.8), block=block), stop_time=1.0)
    assert solution["block.y"] == pytest.approx(formula(solution["source.y"]))


def test_the_sign_changes_at_events() -> None:
    solution = simulate(Driven(block=blocks.Sign()), stop_time=1.2)
    keep = away(solution.t, 0.0, 0.5, 1.0)
    assert solution["block.y"][keep] == pytest.approx(np.sign(np.sin(2 * np.pi * solution.t))[keep])
    times = sorted({round(e.time, 6) for e in solution.events if e.time > 1e-6})
    assert times == pytest.approx([0.5, 1.0])


class Binary(Component):
    """A block of two inputs on a sine and a ramp."""

    first = Sine(f=1.0, amplitude=2.0)
    second = Ramp(offset=0.5)
    block: Any = None

    def build(self) -> None:
        self.part = self.block()

    def equations(self) -> Equations:
        yield connect(self.first.y, self.part.u1)
        yield connect(self.second.y, self.part.u2)


@pytest.mark.parametrize(
    ("block", "formula"),
    [
        (blocks.Min, np.minimum),
        (blocks.Max, np.maximum),
        (blocks.Division, np.divide),
        (blocks.Atan2, np.arctan2),
        (blocks.Greater, lambda a, b: a > b),
        (blocks.Less, lambda a, b: a < b),
        (blocks.GreaterEqual, lambda a, b: a >= b),
        (blocks.LessEqual, lambda a, b: a <= b),
    ],
)
def test_functions_of_two_signals(block: type[Block], formula: Any) -> None:
    solution = simulate(Binary(block=block), stop_time=1.0)
    keep = away(solution.t, *[e.time for e in solution.events])
    expected = formula(solution["first.y"], solution["second.y"])
    assert solution["part.y"][keep] == pytest.approx(expected[keep].astype(float))


class Sums(Component):
    """Blocks of several inputs."""

    a = Constant(k=1.0)
    b = Constant(k=10.0)
    c = Constant(k=100.0)
    add = Add3(k1=2.0, k2=3.0, k3=-1.0)
    sum = Sum(n=3, k=(1.0, -1.0, 2.0))
    limit = VariableLimiter()

    def equations(self) -> Equations:
        for source, k, u in zip((self.a, self.b, self.c), range(3), ("u1", "u2", "u3"), strict=True):
            yield connect(source.y, getattr(self.add, u))
            yield connect(source.y, self.sum.inputs()[k])
        yield connect(self.a.y, self.limit.limit_low)
        yield connect(self.b.y, self.limit.limit_high)
        yield connect(self.c.y, self.limit.u)


def test_blocks_of_several_inputs() -> None:
    solution = simulate(Sums(), stop_time=1.0)
    assert solution.final("add.y") == 2.0 + 30.0 - 100.0
    assert solution.final("sum.y") == 1.0 - 10.0 + 200.0
    assert solution.final("limit.y") == 10.0


def test_a_slew_rate_limiter_follows_at_its_rate() -> None:
    """A jump by 1 at 0.25 s, back at 0.75 s: up at 4/s, down at 8/s."""
    source = Pulse(period=1.0, duty=0.5, start_time=0.25)
    block = SlewRateLimiter(rising=4.0, falling=-8.0, T_d=1e-4)
    solution = simulate(Driven(source=source, block=block), stop_time=1.2, options=OPTIONS)
    exact = np.interp(solution.t, (0.25, 0.5, 0.75, 0.875), (0.0, 1.0, 1.0, 0.0))
    assert solution["block.y"] == pytest.approx(exact, abs=1e-3)


def test_backlash_follows_half_a_gap_behind() -> None:
    """Prandtl's play: y = u - b/2 on the way up, u + b/2 on the way down, and still at each turn."""
    block = Backlash(b=1.0, T=1e-4)
    solution = simulate(Driven(block=block), stop_time=2.0, options=OPTIONS)
    t, u, y = solution.t, 2 * np.sin(2 * np.pi * solution.t), np.zeros(len(solution.t))
    for k in range(1, len(t)):
        y[k] = min(max(y[k - 1], u[k] - 0.5), u[k] + 0.5)
    assert solution["block.y"] == pytest.approx(y, abs=5e-3)


class Logic(Component):
    """Logical blocks on two square waves: a true from 0 to 0.5 of each second, b from 0.25 to 0.75."""

    a = Pulse(period=1.0, duty=0.5)
    b = Pulse(period=1.0, duty=0.5, start_time=0.25)
    opposite = Not()
    both = And()
    either = Or()
    one = Xor()
    flip = RSFlipFlop()
    timer = Timer()
    delayed = OnDelay(delay=0.2)
    choice = Switch()
    sampler = TriggeredSampler.of("s")()
    clock = Clock()

    def equations(self) -> Equations:
        yield connect(self.a.y, self.opposite.u)
        for block in (self.both, self.either, self.one):
            yield connect(self.a.y, block.u1)
            yield connect(self.b.y, block.u2)
        yield connect(self.both.y, self.flip.set)
        yield connect(self.opposite.y, self.flip.reset)
        yield connect(self.a.y, self.timer.u)
        yield connect(self.a.y, self.delayed.u)
        yield connect(self.a.y, self.choice.u1)
        yield connect(self.b.y, self.choice.u2)
        yield connect(self.opposite.y, self.choice.u3)
        yield connect(self.b.y, self.sampler.trigger)
        yield connect(self.timer.y, self.sampler.u)


def test_logical_blocks() -> None:
    solution = simulate(Logic(), stop_time=2.9, options=SolverOptions(intervals=290))
    t = solution.t
    keep = away(np.mod(t, 0.25), 0.0, 0.25) & away(np.mod(t, 1.0), 0.2)
    t, phase = t[keep], np.mod(t[keep], 1.0)
    a, b = phase < 0.5, (phase > 0.25) & (phase < 0.75)
    expected = {
        "opposite.y": ~a,
        "both.y": a & b,
        "either.y": a | b,
        "one.y": a ^ b,
        "flip.y": a & (phase > 0.25),
        "timer.y": np.where(a, phase, 0.0),
        "delayed.y": a & (phase > 0.2),
        "choice.y": np.where(b, a, ~a),
        "sampler.y": np.where(t > 0.25, 0.25, 0.0),
    }
    for path, value in expected.items():
        assert solution[path][keep] == pytest.approx(value.astype(float), abs=1e-9), path


class Levels(Component):
    """A sine of amplitude 2 through blocks that switch at levels."""

    source = Sine(f=1.0, amplitude=2.0)
    zero = Constant(k=0.0)
    high = GreaterThreshold(threshold=1.0)
    low = LessThreshold(threshold=-1.0)
    hysteresis = Hysteresis(u_low=-1.0, u_high=1.0)
    controller = OnOffController(bandwidth=2.0)

    def equations(self) -> Equations:
        for block in (self.high, self.low, self.hysteresis, self.controller):
            yield connect(self.source.y, block.u)
        yield connect(self.zero.y, self.controller.reference)


def test_blocks_that_switch_at_levels() -> None:
    """sin = 1/2 at 1/12 of a turn, and so on."""
    solution = simulate(Levels(), stop_time=2.0, options=SolverOptions(intervals=500))
    corners = [(k + d) / 12 for k in (0, 12) for d in (1, 5, 7, 11)]
    keep = away(solution.t, *corners)
    t = solution.t[keep]
    u = np.sin(2 * np.pi * t)
    assert solution["high.y"][keep] == pytest.approx((u > 0.5).astype(float))
    assert solution["low.y"][keep] == pytest.approx((u < -0.5).astype(float))
    up = ((t > 1 / 12) & (t < 7 / 12)) | ((t > 13 / 12) & (t < 19 / 12))
    assert solution["hysteresis.y"][keep] == pytest.approx(up.astype(float))
    on = ((t > 7 / 12) & (t < 13 / 12)) | (t > 19 / 12)
    assert solution["controller.y"][keep] == pytest.approx(on.astype(float))
    assert sorted({round(e.time, 6) for e in solution.events if e.kind == "state"}) == pytest.approx(
        sorted(corners), abs=1e-6
    )


@pytest.mark.parametrize(
    ("block", "delay", "first"),
    [
        (Sampler(period=0.1), 0, 0.0),
        (ZeroOrderHold(period=0.1), 0, 0.0),
        (UnitDelay(period=0.1), 1, 0.0),
        (Sampler(period=0.1, start_time=0.35), 0, 0.35),
    ],
    ids=["Sampler", "ZeroOrderHold", "UnitDelay", "later"],
)
def test_sampled_blocks(block: SISO, delay: int, first: float) -> None:
    solution = simulate(Driven(source=Sine(f=0.7, phase=0.4), block=block), stop_time=1.98)
    keep = away(np.mod(solution.t - first, 0.1), 0.0, 0.1)
    t = solution.t[keep]
    number = np.floor((t - first) / 0.1) - delay
    exact = np.where(number >= 0, np.sin(2 * np.pi * 0.7 * (first + 0.1 * number) + 0.4), 0.0)
    assert solution["block.y"][keep] == pytest.approx(exact, abs=1e-9)
    assert solution.final("block.k") == np.floor((1.98 - first) / 0.1) + 1


@pytest.mark.parametrize(
    ("source", "formula"),
    [
        (Cosine(f=1.0, amplitude=2.0, offset=1.0), lambda t: 1.0 + 2.0 * np.cos(2 * np.pi * t)),
        (
            ExpSine(f=1.0, damping=2.0, phase=0.5),
            lambda t: np.exp(-2.0 * t) * np.sin(2 * np.pi * t + 0.5),
        ),
        (blocks.SawTooth(period=0.4, amplitude=2.0), lambda t: 2.0 * np.mod(t, 0.4) / 0.4),
        (Pulse(period=0.4, duty=0.25, offset=1.0), lambda t: 1.0 + (np.mod(t, 0.4) < 0.1)),
    ],
    ids=lambda value: type(value).__name__,
)
def test_sources(source: Source, formula: Any) -> None:
    solution = simulate(Driven(source=source), stop_time=1.9, options=SolverOptions(intervals=190))
    keep = away(np.mod(solution.t, 0.4), 0.0, 0.1, 0.4)
    assert solution["source.y"][keep] == pytest.approx(formula(solution.t[keep]), abs=1e-9)


class Motion(Component):
    """A planned motion, integrated twice."""

    plan: KinematicPTP = KinematicPTP(distance=3.0, speed_max=1.5, acceleration_max=1.0, start_time=0.5)
    speed = blocks.Integrator()
    way = blocks.Integrator()

    def equations(self) -> Equations:
        yield connect(self.plan.y, self.speed.u)
        yield connect(self.speed.y, self.way.u)


@pytest.mark.parametrize(
    ("distance", "top", "end"),
    [(3.0, 1.5, 3.5), (-3.0, -1.5, 3.5), (1.0, 1.0, 2.0)],
    ids=["full", "back", "short"],
)
def test_a_planned_motion_arrives_at_rest(distance: float, top: float, end: float) -> None:
    """Duration: way/speed + speed/acceleration, or 2 sqrt(way/acceleration) where that speed is not reached."""
    parameters = {"plan.distance": distance}
    solution = simulate(Motion(), stop_time=5.0, parameters=parameters, options=OPTIONS)
    assert solution.final("way.y") == pytest.approx(distance, abs=1e-6)
    assert solution.final("speed.y") == pytest.approx(0.0, abs=1e-7)
    speed = solution["speed.y"]
    assert speed[np.argmax(np.abs(speed))] == pytest.approx(top, rel=1e-6)
    assert max(e.time for e in solution.events) == pytest.approx(0.5 + end)


def test_tables_extrapolate_as_declared() -> None:
    us, ys = (0.0, 1.0, 3.0), (0.0, 2.0, 1.0)
    ramp = Ramp(offset=-2.0, height=7.0)
    linear = Table1D(us=us, ys=ys, extrapolation="linear")
    solution = simulate(Driven(source=ramp, block=linear), stop_time=1.0)
    u = solution["source.y"]
    exact = np.where(u < 0, 2.0 * u, np.where(u > 3, 1.0 - 0.5 * (u - 3.0), np.interp(u, us, ys)))
    assert solution["block.y"] == pytest.approx(exact)


@pytest.mark.parametrize("extrapolation", ["hold", "linear"])
def test_a_monotone_table_has_no_overshoot(extrapolation: str) -> None:
    from scipy.interpolate import PchipInterpolator

    us, ys = (0.0, 1.0, 1.5, 3.0, 4.0), (0.0, 0.0, 2.0, 2.0, 1.0)
    table = Table1D(us=us, ys=ys, smoothness="monotone", extrapolation=extrapolation)
    solution = simulate(Driven(source=Ramp(offset=-0.5, height=5.0), block=table), stop_time=1.0)
    u, y = solution["source.y"], solution["block.y"]
    curve = PchipInterpolator(us, ys)
    inside = (u >= 0) & (u <= 4)
    assert y[inside] == pytest.approx(curve(u[inside]), abs=1e-12)
    edge = curve.derivative()(4.0) if extrapolation == "linear" else 0.0
    assert y[u > 4] == pytest.approx(1.0 + edge * (u[u > 4] - 4.0), abs=1e-12)
    assert np.max(y) <= 2.0 + 1e-12


class Surface(Component):
    """A table over two signals."""

    extrapolation: str = "hold"
    first = Sine(f=1.0, amplitude=3.0)
    second = Ramp(offset=-1.0, height=5.0)

    def build(self) -> None:
        ys = ((0.0, 1.0), (2.0, 5.0), (3.0, -1.0))
        self.table = Table2D(u1s=(-1.0, 0.5, 2.0), u2s=(0.0, 3.0), ys=ys, extrapolation=self.extrapolation)

    def equations(self) -> Equations:
        yield connect(self.first.y, self.table.u1)
        yield connect(self.second.y, self.table.u2)


@pytest.mark.parametrize("extrapolation", ["hold", "linear"])
def test_a_table_of_two_signals(extrapolation: str) -> None:
    from scipy.interpolate import RegularGridInterpolator

    solution = simulate(Surface(extrapolation=extrapolation), stop_time=1.0)
    u = np.column_stack([solution["first.y"], solution["second.y"]])
    grid = ((-1.0, 0.5, 2.0), (0.0, 3.0))
    beyond: Any = None  # extrapolates
    values = np.array([[0.0, 1.0], [2.0, 5.0], [3.0, -1.0]])
    exact = RegularGridInterpolator(grid, values, bounds_error=False, fill_value=beyond)
    if extrapolation == "hold":
        u = np.clip(u, [-1.0, 0.0], [2.0, 3.0])
    assert solution["table.y"] == pytest.approx(exact(u), abs=1e-9)


def test_a_table_that_does_not_increase_is_refused() -> None:
    with pytest.raises(DeclarationError, match="us must increase"):
        simulate(Driven(block=Table1D(us=(0.0, 0.0), ys=(1.0, 2.0))), stop_time=1.0)


def test_tables_from_a_file(tmp_path: Path) -> None:
    file = tmp_path / "curve.csv"
    file.write_text("t,value,gain\n0,1,5\n1,3,6\n2,4,8\n", encoding="utf-8")
    source = TimeTable.from_csv(file, time="t")
    solution = simulate(
        Driven(source=source, block=Table1D.from_csv(file, u="value", y="gain")), stop_time=0.9
    )
    assert solution["source.y"] == pytest.approx(1.0 + 2.0 * solution.t)
    assert solution["block.y"] == pytest.approx(5.0 + solution.t)
