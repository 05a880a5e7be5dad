"""Linear blocks and controllers against scipy.signal and closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import signal

from arthur_acausal import (
    Component,
    DeclarationError,
    Equations,
    SolverOptions,
    connect,
    der,
    simulate,
    start,
    translate,
)
from arthur_acausal.components.blocks import (
    PI,
    SISO,
    CriticalDamping,
    Derivative,
    FirstOrder,
    LimIntegrator,
    LimPID,
    LowpassButterworth,
    Pulse,
    ResetIntegrator,
    Sine,
    Source,
    StateSpace,
    Step,
    TransferFunction,
)

PRECISE = SolverOptions(rtol=1e-9, intervals=500)


class Driven(Component):
    """A source and a block."""

    source: Source = Step()
    block: SISO = FirstOrder(T=1.0)

    def equations(self) -> Equations:
        yield connect(self.source.y, self.block.u)


B, A = (2.0, 3.0, 5.0), (1.0, 4.0, 6.0, 8.0)


def butterworth(n: int) -> Any:
    """SciPy's filter of order n with its corner at 0.5 Hz."""
    coefficients: Any = signal.butter(n, 2 * np.pi * 0.5, analog=True)
    return signal.lti(*coefficients)


POLE = 2 * np.pi * 0.5 / np.sqrt(2 ** (1 / 3) - 1)
SYSTEMS: list[tuple[SISO, Any]] = [
    (TransferFunction(b=B, a=A), signal.lti(B, A)),
    (TransferFunction(b=(1.0, 0.0, 2.0), a=(3.0, 1.0, 4.0)), signal.lti((1.0, 0.0, 2.0), (3.0, 1.0, 4.0))),
    (LowpassButterworth(n=5, f=0.5), butterworth(5)),
    (LowpassButterworth(n=4, f=0.5), butterworth(4)),
    (CriticalDamping(n=3, f=0.5), signal.lti([POLE**3], np.poly([-POLE] * 3))),
    (
        StateSpace(A=((0.0, 1.0), (-4.0, -0.5)), B=(0.0, 2.0), C=(1.0, 0.5), D=0.25),
        signal.lti([[0.0, 1.0], [-4.0, -0.5]], [[0.0], [2.0]], [[1.0, 0.5]], [[0.25]]),
    ),
    (PI(k=2.0, T=0.5), signal.lti((2.0 * 0.5, 2.0), (0.5, 0.0))),
]


@pytest.mark.parametrize(("block", "system"), SYSTEMS, ids=lambda value: type(value).__name__)
def test_step_responses(block: SISO, system: Any) -> None:
    solution = simulate(Driven(block=block), stop_time=8.0, options=PRECISE)
    t, rows = np.unique(solution.t, return_index=True)
    _, exact = signal.step(system, T=t)
    late = t > 1e-3
    assert solution["block.y"][rows][late] == pytest.approx(exact[late], abs=2e-6)


def test_a_butterworth_filter_at_its_corner() -> None:
    """The amplitude is k/sqrt(2) at f."""
    rig = Driven(source=Sine(f=2.0), block=LowpassButterworth(n=3, f=2.0, k=3.0))
    solution = simulate(rig, stop_time=10.0, options=SolverOptions(rtol=1e-8, intervals=10000))
    assert np.max(solution["block.y"][solution.t > 8.0]) == pytest.approx(3.0 / np.sqrt(2), rel=1e-4)


def test_a_derivative_starts_at_zero() -> None:
    """k s/(T s + 1) on sin(w t)."""
    rig = Driven(source=Sine(f=0.5, phase=np.pi / 2), block=Derivative(k=2.0, T=1e-3))
    solution = simulate(rig, stop_time=4.0, options=PRECISE)
    assert solution.initial("block.y") == pytest.approx(0.0, abs=1e-12)
    late, w = solution.t > 0.1, np.pi
    gain = 2.0 * w / np.hypot(1.0, 1e-3 * w)
    exact = -gain * np.sin(w * solution.t - np.arctan(1e-3 * w))
    assert solution["block.y"][late] == pytest.approx(exact[late], abs=1e-5)


def test_a_numerator_of_too_high_a_degree_is_refused() -> None:
    with pytest.raises(DeclarationError, match=r"TransferFunction with b = \(1\.0, 2\.0\), a = \(1\.0,\)"):
        TransferFunction(b=(1.0, 2.0), a=(1.0,))
    with pytest.raises(DeclarationError, match="2 rows in A"):
        StateSpace(A=((1.0, 0.0), (0.0,)), B=(1.0, 1.0), C=(1.0, 1.0))


class Two(Component):
    """Blocks of the same kind and different order in one model."""

    source = Step()
    low = LowpassButterworth(n=2, f=1.0)
    high = LowpassButterworth(n=6, f=1.0)
    third = LowpassButterworth.of("A", "1")(n=2, f=1.0)

    def equations(self) -> Equations:
        yield connect(self.source.y, self.low.u)
        yield connect(self.low.y, self.high.u)
        yield connect(self.high.y, self.third.u)


def test_orders_do_not_mix() -> None:
    assert isinstance(LowpassButterworth(n=3, f=1.0), LowpassButterworth)
    states = [v for v in translate(Two()).dae.y_paths if ".x_" in v]
    assert len(states) == 10


class Limited(Component):
    """An integrator between limits on a slow square wave."""

    source = Pulse(amplitude=4.0, offset=-2.0, period=4.0)
    block = LimIntegrator(y_max=1.5, y_start=0.5)

    def equations(self) -> Equations:
        yield connect(self.source.y, self.block.u)


def test_a_limited_integrator_waits_at_its_limits() -> None:
    """Up at 2/s from 0.5 to 1.5 at 0.5 s, down from 2 s on to -1.5 at 3.5 s, up again from 4 s."""
    solution = simulate(Limited(), stop_time=6.0, options=PRECISE)
    corners, values = (0.0, 0.5, 2.0, 3.5, 4.0, 5.5, 6.0), (0.5, 1.5, 1.5, -1.5, -1.5, 1.5, 1.5)
    assert solution["block.y"] == pytest.approx(np.interp(solution.t, corners, values), abs=1e-7)


class Reset(Component):
    """An integrator that a square wave resets."""

    source = Step(height=2.0, start_time=-1.0)
    trigger = Pulse(period=0.5, duty=0.5, start_time=0.25)
    block = ResetIntegrator()

    def equations(self) -> Equations:
        yield connect(self.source.y, self.block.u)
        yield connect(self.trigger.y, self.block.reset)


def test_an_integrator_is_reset() -> None:
    solution = simulate(Reset(), stop_time=1.9, options=PRECISE)
    for t in (0.1, 0.3, 0.7, 1.2, 1.9):
        since = 0.0 if t < 0.25 else 0.25 + 0.5 * np.floor((t - 0.25) / 0.5)
        assert solution.at(t, "block.y") == pytest.approx(2.0 * (t - since), abs=1e-8)


class Controlled(Component):
    """A first-order plant under a controller."""

    target: Source = Step(start_time=0.5)
    controller: LimPID = LimPID(y_max=1e6)
    plant = FirstOrder(T=1.0)

    def equations(self) -> Equations:
        yield connect(self.target.y, self.controller.u_s)
        yield connect(self.plant.y, self.controller.u_m)
        yield connect(self.controller.y, self.plant.u)


def test_a_pid_loop_without_limits_is_linear() -> None:
    """Closed loop k (1 + 1/(T_i s) + wd T_d s/(T_d s/N + 1)) over 1 + C P, by scipy.signal; wd = 1."""
    k, T_i, T_d, N = 3.0, 0.7, 0.2, 5.0
    controller = LimPID(k=k, T_i=T_i, T_d=T_d, Nd=N, wd=1.0, y_max=1e6)
    solution = simulate(Controlled(controller=controller), stop_time=4.0, options=PRECISE)
    number = k * np.polyadd(np.polymul([T_i, 1.0], [T_d / N, 1.0]), np.polymul([T_d, 0.0], [T_i, 0.0]))
    denominator = np.polymul([T_i, 0.0], [T_d / N, 1.0])
    loop = np.polymul(denominator, [1.0, 1.0])
    t, rows = np.unique(solution.t, return_index=True)
    _, exact = signal.step(signal.lti(number, np.polyadd(loop, number)), T=np.linspace(0.0, 3.5, 3501))
    expected = np.interp(np.maximum(t - 0.5, 0.0), np.linspace(0.0, 3.5, 3501), exact)
    assert solution["plant.y"][rows] == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize(
    ("kind", "offset"), [("P", 1 / (1 + 4.0)), ("PD", 1 / (1 + 4.0)), ("PI", 0.0), ("PID", 0.0)]
)
def test_only_an_integral_part_leaves_no_offset(kind: str, offset: float) -> None:
    solution = simulate(Controlled(controller=LimPID(controller=kind, k=4.0, y_max=1e6)), stop_time=20.0)
    assert 1.0 - solution.final("plant.y") == pytest.approx(offset, abs=1e-4)


def test_anti_windup_holds_the_integrator_back() -> None:
    """At its limit y_max = 1.2 the integral settles where (u_s - u_m) = (unlimited - y_max)/(k Ni)."""
    limited = LimPID(controller="PI", k=5.0, T_i=0.2, y_max=1.2, Ni=0.1)
    free = LimPID(controller="PI", k=5.0, T_i=0.2, y_max=1.2, Ni=1e6)
    overshoot = [
        np.max(simulate(Controlled(controller=c), stop_time=15.0)["plant.y"]) - 1 for c in (limited, free)
    ]
    assert overshoot[0] < 0.05 < overshoot[1]


class Steady(Controlled):
    """The same, at rest at the start: target 0.6, plant at 0.6."""

    target: Source = Step(offset=0.6, height=0.0)
    controller: LimPID = LimPID(controller="PI", k=2.0, y_max=10.0, I=start(0.0, fixed=False))

    def initial_equations(self) -> Equations:
        yield der(self.plant.x) == 0


def test_a_controller_starts_in_steady_state() -> None:
    """The integral part alone holds the plant: k I = 0.6."""
    solution = simulate(Steady(), stop_time=2.0, parameters={"plant.y_start": 0.6})
    assert solution["controller.I"] == pytest.approx(0.3, abs=1e-6)
    assert solution["plant.y"] == pytest.approx(0.6, abs=1e-6)
