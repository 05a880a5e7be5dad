"""Circuits with ideal diodes, thyristors and switches against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, connect, simulate, start
from arthur_acausal.components.blocks import Pulse, Step
from arthur_acausal.components.electrical import (
    Capacitor,
    ConstantVoltage,
    Diode,
    Ground,
    HeatingDiode,
    IdealClosingSwitch,
    IdealDiode,
    IdealGTOThyristor,
    IdealOpeningSwitch,
    IdealThyristor,
    IdealZener,
    Inductor,
    Resistor,
    SineVoltage,
    TwoPin,
    ZenerDiode,
)

PRECISE = SolverOptions(rtol=1e-8, intervals=2000)


class Series(Component):
    """A sine of 10 V and 1 Hz on an element and 1 ohm."""

    source: TwoPin = SineVoltage(V=10.0, f=1.0)
    element: TwoPin = IdealDiode(Ron=0.0, Goff=0.0)
    load = Resistor(R=1.0)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.element.pin_p)
        yield connect(self.element.pin_n, self.load.pin_p)
        yield connect(self.load.pin_n, self.source.pin_n)
        yield connect(self.source.pin_n, self.ground.pin)


def test_an_ideal_diode_cuts_the_negative_half() -> None:
    """The mean over a period is V/pi; the changes are at multiples of half a period."""
    solution = simulate(Series(), stop_time=2.0, options=PRECISE)
    i = solution["load.i"]
    assert i == pytest.approx(np.maximum(10 * np.sin(2 * np.pi * solution.t), 0.0), abs=1e-6)
    assert np.trapezoid(i, solution.t) / 2.0 == pytest.approx(10 / np.pi, rel=1e-5)
    assert [e.time for e in solution.events if e.kind == "state"] == pytest.approx([0.5, 1.0, 1.5], abs=1e-9)


def test_a_zener_limits_both_ways() -> None:
    zener = IdealZener(V_z=4.0, Vknee=1.0, Ron=0.0, Goff=0.0)
    solution = simulate(Series(element=zener), stop_time=1.0, options=PRECISE)
    v = 10 * np.sin(2 * np.pi * solution.t)
    assert solution["element.v"] == pytest.approx(np.clip(v, -4.0, 1.0), abs=1e-6)
    assert solution["load.i"] == pytest.approx(v - np.clip(v, -4.0, 1.0), abs=1e-6)


class Bridge(Component):
    """Four diodes, a sine of 10 V and 50 Hz, a load of 10 ohm, and beside it perhaps a capacitor."""

    smoothed: bool = False
    Ron: float = 1e-5
    source = SineVoltage(V=10.0, f=50.0)
    load = Resistor(R=10.0)
    ground = Ground()

    def build(self) -> None:
        self.diodes = [IdealDiode(Ron=self.Ron, Goff=1e-6) for _ in range(4)]
        if self.smoothed:
            self.capacitor = Capacitor(C=5e-3, v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        source, load = self.source, self.load
        upper_p, upper_n, lower_p, lower_n = self.diodes
        for upper, lower, pin in ((upper_p, lower_p, source.pin_p), (upper_n, lower_n, source.pin_n)):
            yield connect(upper.pin_p, pin)
            yield connect(lower.pin_n, pin)
            yield connect(upper.pin_n, load.pin_p)
            yield connect(lower.pin_p, load.pin_n)
        yield connect(load.pin_n, self.ground.pin)
        if self.smoothed:
            yield connect(self.capacitor.pin_p, load.pin_p)
            yield connect(self.capacitor.pin_n, load.pin_n)


def test_a_bridge_rectifies() -> None:
    """The mean is 2 V/pi, two diodes change at each zero of the source."""
    solution = simulate(Bridge(), stop_time=0.1, options=PRECISE)
    v = solution["load.v"]
    assert v == pytest.approx(np.abs(10 * np.sin(100 * np.pi * solution.t)), abs=1e-3)
    assert np.trapezoid(v, solution.t) / 0.1 == pytest.approx(2 * 10 / np.pi, rel=1e-4)
    within = [e.time for e in solution.events if e.kind == "state" and 1e-6 < e.time < 0.095]
    assert sorted({round(t, 7) for t in within}) == pytest.approx(np.arange(0.01, 0.095, 0.01), abs=1e-6)


def test_a_smoothed_bridge_settles() -> None:
    """Between the peaks the capacitor feeds the load: v = v_off exp(-(t - t_off)/RC), from tan(w t_off) = -w R C on."""
    solution = simulate(Bridge(smoothed=True, Ron=1e-3), stop_time=0.2, options=PRECISE)
    w, RC = 100 * np.pi, 10.0 * 5e-3
    theta = np.pi - np.arctan(w * RC)  # where the decay is as steep as the sine: after the peak
    t_off = 0.18 + theta / w
    v_off = 10 * np.sin(theta)
    for t in (0.187, 0.188):
        expected = v_off * np.exp(-(t - t_off) / RC)
        assert solution.at(t, "load.v") == pytest.approx(expected, rel=2e-3)
    assert all(diode_off < 0 for diode_off in (solution.at(0.187, f"diodes[{k}].s") for k in range(4)))


def test_an_inductive_load_keeps_the_diode_on() -> None:
    """A half-wave rectifier on R and L: i = V/Z (sin(wt - phi) + sin(phi) exp(-wt/tan(phi))) up to its zero."""

    class Half(Series):
        coil = Inductor(L=1.0 / (2 * np.pi), i=start(0.0, fixed=True))

        def equations(self) -> Equations:
            yield connect(self.source.pin_p, self.element.pin_p)
            yield connect(self.element.pin_n, self.load.pin_p)
            yield connect(self.load.pin_n, self.coil.pin_p)
            yield connect(self.coil.pin_n, self.source.pin_n)
            yield connect(self.source.pin_n, self.ground.pin)

    diode = IdealDiode(Ron=1e-6, Goff=1e-6)
    solution = simulate(Half(element=diode), stop_time=0.99, options=PRECISE)
    angle, phi = 2 * np.pi * solution.t, np.pi / 4
    free = 10 / np.sqrt(2) * (np.sin(angle - phi) + np.sin(phi) * np.exp(-angle))
    off = next(e.time for e in solution.events if e.kind == "state" and e.time > 0.3)
    assert np.sin(2 * np.pi * off - phi) + np.sin(phi) * np.exp(-2 * np.pi * off) == pytest.approx(
        0, abs=1e-5
    )
    assert solution["coil.i"] == pytest.approx(np.where(solution.t < off, free, 0.0), abs=1e-4)


class Controlled(Component):
    """A switch or thyristor between a source and 1 ohm, with a logical signal."""

    source: TwoPin = SineVoltage(V=10.0, f=1.0)
    gate = Pulse(period=0.5, duty=0.1, start_time=0.125)
    load = Resistor(R=1.0)
    ground = Ground()
    gto: bool = False

    def build(self) -> None:
        kind = IdealGTOThyristor if self.gto else IdealThyristor
        self.thyristor = kind(Ron=0.0, Goff=0.0)

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.thyristor.pin_p)
        yield connect(self.thyristor.pin_n, self.load.pin_p)
        yield connect(self.load.pin_n, self.source.pin_n)
        yield connect(self.source.pin_n, self.ground.pin)
        yield connect(self.gate.y, self.thyristor.fire)


@pytest.mark.parametrize(("gto", "until"), [(False, 0.5), (True, 0.175)])
def test_a_thyristor_fires_and_blocks(gto: bool, until: float) -> None:
    """Fired at 45 degrees it conducts to the end of the half wave, a GTO to the end of the pulse."""
    solution = simulate(Controlled(gto=gto), stop_time=0.95, options=PRECISE)
    t = solution.t
    on = (t > 0.125) & (t < until)
    clear = np.abs(t - 0.125) + np.abs(t - until) > 1e-9
    away = (np.abs(t - 0.125) > 1e-9) & (np.abs(t - until) > 1e-9) & clear
    expected = np.where(on, 10 * np.sin(2 * np.pi * t), 0.0)
    assert solution["load.i"][away] == pytest.approx(expected[away], abs=1e-6)


class Chopper(Component):
    """A step-down converter: a switch chops 12 V, a diode takes the coil's current over."""

    source = ConstantVoltage(V=12.0)
    switch = IdealClosingSwitch(Ron=1e-4, Goff=1e-6)
    diode = IdealDiode(Ron=1e-4, Goff=1e-6)
    coil = Inductor(L=1e-3, i=start(2.0, fixed=True))
    capacitor = Capacitor(C=1e-3, v=start(3.0, fixed=True))
    load = Resistor(R=1.5)
    gate = Pulse(period=1e-4, duty=0.25)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.switch.pin_p)
        yield connect(self.switch.pin_n, self.diode.pin_n)
        yield connect(self.switch.pin_n, self.coil.pin_p)
        yield connect(self.coil.pin_n, self.capacitor.pin_p)
        yield connect(self.coil.pin_n, self.load.pin_p)
        yield connect(self.gate.y, self.switch.control)
        for pin in (self.source.pin_n, self.diode.pin_p, self.capacitor.pin_n, self.load.pin_n):
            yield connect(pin, self.ground.pin)


def test_a_step_down_converter() -> None:
    """In continuous conduction v = duty V, the coil's ripple is V (1 - d) d T/L, and the power is kept."""
    solution = simulate(Chopper(), stop_time=0.02, options=SolverOptions(rtol=1e-6, intervals=4000))
    late = solution.t > 0.015
    t, v, i = solution.t[late], solution["load.v"][late], solution["coil.i"][late]
    assert np.trapezoid(v, t) / np.ptp(t) == pytest.approx(3.0, rel=2e-3)
    assert np.ptp(i) == pytest.approx(12.0 * 0.75 * 0.25 * 1e-4 / 1e-3, rel=5e-3)


class Switched(Component):
    """Two switches of one signal, one closing, one opening, on two resistors."""

    source = ConstantVoltage(V=1.0)
    signal = Step(start_time=0.5)
    closing = IdealClosingSwitch(Ron=0.0, Goff=0.0)
    opening = IdealOpeningSwitch(Ron=0.0, Goff=0.0)
    R1 = Resistor(R=2.0)
    R2 = Resistor(R=4.0)
    ground = Ground()

    def equations(self) -> Equations:
        for switch, resistor in ((self.closing, self.R1), (self.opening, self.R2)):
            yield connect(self.signal.y, switch.control)
            yield connect(self.source.pin_p, switch.pin_p)
            yield connect(switch.pin_n, resistor.pin_p)
            yield connect(resistor.pin_n, self.ground.pin)
        yield connect(self.source.pin_n, self.ground.pin)


def test_switches_open_and_close() -> None:
    solution = simulate(Switched(), stop_time=1.0)
    assert solution.at(0.4, "R1.i") == 0.0
    assert solution.at(0.6, "R1.i") == pytest.approx(0.5)
    assert solution.at(0.4, "R2.i") == pytest.approx(0.25)
    assert solution.at(0.6, "R2.i") == 0.0


@pytest.mark.parametrize(
    "diode", [Diode(), HeatingDiode(use_heat_port=False, T=300.15)], ids=["Diode", "Heating"]
)
def test_a_diode_follows_shockley(diode: TwoPin) -> None:
    """i = Ids (exp(v/Vt) - 1) + v/R below the tangent."""
    solution = simulate(Series(element=diode), stop_time=1.0)
    v, i = solution["element.v"], solution["element.i"]
    Vt = 0.04 if isinstance(diode, Diode) else 1.380649e-23 * 300.15 / 1.602176634e-19
    exponent = v / Vt
    exact = 1e-6 * (
        np.where(exponent < 15, np.exp(np.minimum(exponent, 15)), np.exp(15) * (exponent - 14)) - 1
    )
    assert i == pytest.approx(exact + v / 1e8, rel=1e-6, abs=1e-12)


def test_a_zener_diode_breaks_down() -> None:
    solution = simulate(Series(element=ZenerDiode()), stop_time=1.0)
    low = np.min(solution["element.v"])
    i = np.min(solution["element.i"])
    assert -0.7 * np.exp(-(low + 5.1) / (0.74 * 0.04)) + low / 1e8 - 1e-6 == pytest.approx(i, rel=1e-6)
    assert low == pytest.approx(-5.1 - 0.0296 * np.log(-i / 0.7), rel=1e-4)


class SixPulse(Component):
    """A three-phase bridge on an inductive load, perhaps with inductors in the supply's lines."""

    line_L: float = 0.0
    coil = Inductor(L=1e-2, i=start(0.0, fixed=True))
    load = Resistor(R=1.0)
    ground = Ground()

    def build(self) -> None:
        self.sources = [SineVoltage(V=100.0, f=50.0, phase=-2 * np.pi * k / 3) for k in range(3)]
        self.upper, self.lower = [IdealDiode() for _ in range(3)], [IdealDiode() for _ in range(3)]
        if self.line_L:
            self.lines = [Inductor(L=self.line_L, i=start(0.0, fixed=k < 2)) for k in range(3)]

    def equations(self) -> Equations:
        for k, source in enumerate(self.sources):
            if k:
                yield connect(source.pin_n, self.sources[0].pin_n)
            node = source.pin_p
            if self.line_L:
                yield connect(node, self.lines[k].pin_p)
                node = self.lines[k].pin_n
            yield connect(node, self.upper[k].pin_p)
            yield connect(node, self.lower[k].pin_n)
            yield connect(self.upper[k].pin_n, self.coil.pin_p)
            yield connect(self.lower[k].pin_p, self.load.pin_n)
        yield connect(self.coil.pin_n, self.load.pin_p)
        yield connect(self.load.pin_n, self.ground.pin)


@pytest.mark.parametrize("line_L", [0.0, 1e-4])
def test_a_three_phase_bridge(line_L: float) -> None:
    """Mean voltage 3 sqrt(3) V/pi less 3 w L I/pi for the overlap (Mohan, Power Electronics 2003, eqs. 5-68, 5-81)."""
    solution = simulate(SixPulse(line_L=line_L), stop_time=0.12, options=SolverOptions(intervals=3000))
    late = solution.t >= 0.1
    t, i = solution.t[late], solution["load.i"][late]
    mean = np.trapezoid(i, t) / np.ptp(t)
    assert mean == pytest.approx(3 * np.sqrt(3) * 100 / np.pi / (1 + 3 * 100 * line_L), rel=1e-3)
    on = [
        sum(solution.at(x, f"{side}[{k}].s") > 0 for k in range(3))
        for x in (0.1012, 0.1045)
        for side in ("upper", "lower")
    ]
    assert all(1 <= number <= 2 for number in on)
