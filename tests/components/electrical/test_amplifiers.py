"""Operational amplifiers and a transistor against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, connect, simulate, start
from arthur_acausal.components.blocks import Constant
from arthur_acausal.components.electrical import (
    NPN,
    Capacitor,
    ConstantCurrent,
    ConstantVoltage,
    CurrentControlledCurrentSource,
    CurrentControlledVoltageSource,
    Ground,
    IdealOpAmp,
    IdealOpAmpLimited,
    OpAmp,
    Resistor,
    SineVoltage,
    TwoPin,
    VariableResistor,
    VoltageControlledCurrentSource,
    VoltageControlledVoltageSource,
)
from arthur_acausal.components.electrical.pin import FourPin

PRECISE = SolverOptions(rtol=1e-8)


class Inverting(Component):
    """An inverting amplifier: R1 to the inverting input, ``back`` from the output to it."""

    source: TwoPin = SineVoltage(V=1.0, f=1.0)
    R1 = Resistor(R=1e3)
    back: TwoPin = Resistor(R=1e4)
    amplifier = IdealOpAmp()
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.R1.pin_p)
        yield connect(self.R1.pin_n, self.amplifier.in_n)
        yield connect(self.back.pin_p, self.amplifier.in_n)
        yield connect(self.back.pin_n, self.amplifier.out)
        yield connect(self.amplifier.in_p, self.ground.pin)
        yield connect(self.source.pin_n, self.ground.pin)


def test_an_inverting_amplifier() -> None:
    solution = simulate(Inverting(), stop_time=1.0)
    assert solution["amplifier.out.v"] == pytest.approx(-10 * np.sin(2 * np.pi * solution.t), abs=1e-9)


def test_an_integrating_amplifier() -> None:
    """out = -integral(v)/RC."""
    back = Capacitor(C=1e-4, v=start(0.0, fixed=True))
    solution = simulate(Inverting(back=back), stop_time=1.0, options=PRECISE)
    exact = -(1 - np.cos(2 * np.pi * solution.t)) / (2 * np.pi * 0.1)
    assert solution["amplifier.out.v"] == pytest.approx(exact, abs=1e-6)


class Railed(Component):
    """A non-inverting amplifier of gain 11 between rails of +-5 V."""

    smooth: bool = False
    source = SineVoltage(V=1.0, f=1.0)
    R1 = Resistor(R=1e3)
    R2 = Resistor(R=1e4)
    high = ConstantVoltage(V=5.0)
    low = ConstantVoltage(V=-5.0)
    ground = Ground()

    def build(self) -> None:
        self.amplifier = OpAmp(a=1e6) if self.smooth else IdealOpAmpLimited()

    def equations(self) -> Equations:
        amplifier = self.amplifier
        yield connect(self.source.pin_p, amplifier.in_p)
        yield connect(self.R1.pin_p, amplifier.in_n)
        yield connect(self.R2.pin_p, amplifier.in_n)
        yield connect(self.R2.pin_n, amplifier.out)
        yield connect(self.high.pin_p, amplifier.v_max)
        yield connect(self.low.pin_p, amplifier.v_min)
        for pin in (self.source.pin_n, self.R1.pin_n, self.high.pin_n, self.low.pin_n):
            yield connect(pin, self.ground.pin)


@pytest.mark.parametrize(("smooth", "error"), [(False, 1e-6), (True, 5e-3)])
def test_an_amplifier_stays_between_its_rails(smooth: bool, error: float) -> None:
    solution = simulate(Railed(smooth=smooth), stop_time=1.0, options=PRECISE)
    exact = np.clip(11 * np.sin(2 * np.pi * solution.t), -5.0, 5.0)
    assert solution["amplifier.out.v"] == pytest.approx(exact, abs=error)
    assert len([e for e in solution.events if e.kind == "state"]) == (0 if smooth else 4)


class Emitter(Component):
    """A transistor with a base current and a collector resistor."""

    base_current = ConstantCurrent(I=1e-5)
    supply = ConstantVoltage(V=5.0)
    R_C = Resistor(R=1e3)
    npn = NPN(V_A=1e9)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.base_current.pin_n, self.npn.base)
        yield connect(self.supply.pin_p, self.R_C.pin_p)
        yield connect(self.R_C.pin_n, self.npn.collector)
        for pin in (self.base_current.pin_p, self.supply.pin_n, self.npn.emitter):
            yield connect(pin, self.ground.pin)


def test_a_transistor_amplifies_until_it_saturates() -> None:
    """i_C = beta i_B and v_BE = Vt ln(i_C/Is); saturated, the collector is a few tenths of a volt up."""
    solution = simulate(Emitter(), stop_time=1.0)
    assert solution.final("npn.collector.i") == pytest.approx(50 * 1e-5, rel=1e-6)
    assert solution.final("npn.v_BE") == pytest.approx(0.02585 * np.log(5e-4 / 1e-16), rel=1e-6)
    saturated = simulate(Emitter(), stop_time=1.0, parameters={"base_current.I": 1e-3})
    assert 0.0 < saturated.final("npn.collector.v") < 0.4


class TwoPort(Component):
    """1 V behind 1 ohm on port 1, 2 ohm on port 2."""

    source = ConstantVoltage(V=1.0)
    R1 = Resistor(R=1.0)
    part: FourPin = VoltageControlledVoltageSource(gain=3.0)
    R2 = VariableResistor()
    ohms = Constant.of("ohm")(k=2.0)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.R1.pin_p)
        yield connect(self.R1.pin_n, self.part.pin_p1)
        yield connect(self.part.pin_p2, self.R2.pin_p)
        yield connect(self.ohms.y, self.R2.R)
        for pin in (self.source.pin_n, self.part.pin_n1, self.part.pin_n2, self.R2.pin_n):
            yield connect(pin, self.ground.pin)


@pytest.mark.parametrize(
    ("part", "v2"),
    [
        (VoltageControlledVoltageSource(gain=3.0), 3.0),
        (VoltageControlledCurrentSource(g=3.0), -6.0),
        (CurrentControlledVoltageSource(r=3.0), 3.0),
        (CurrentControlledCurrentSource(gain=3.0), -6.0),
    ],
    ids=lambda value: type(value).__name__,
)
def test_controlled_sources(part: FourPin, v2: float) -> None:
    solution = simulate(TwoPort(part=part), stop_time=1.0)
    assert solution.final("part.v2") == pytest.approx(v2)
