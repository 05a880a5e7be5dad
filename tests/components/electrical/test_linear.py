"""Linear circuits against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, connect, simulate, start
from arthur_acausal.components import blocks
from arthur_acausal.components.electrical import (
    EMF,
    Capacitor,
    Conductor,
    ConstantCurrent,
    ConstantVoltage,
    CurrentSensor,
    Ground,
    Gyrator,
    IdealTransformer,
    Inductor,
    PotentialSensor,
    PowerSensor,
    PulseVoltage,
    RampCurrent,
    Resistor,
    SaturatingInductor,
    SignalVoltage,
    SineVoltage,
    StepVoltage,
    TableVoltage,
    Transformer,
    TwoPin,
    VoltageSensor,
)
from arthur_acausal.components.rotational import Damper, Fixed, Inertia

PRECISE = SolverOptions(rtol=1e-9)


class Loop(Component):
    """A source and some elements in series."""

    source: TwoPin = ConstantVoltage(V=1.0)
    first: TwoPin = Resistor(R=1.0)
    second: TwoPin = Resistor(R=1.0)
    third: TwoPin = Resistor(R=1e-9)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.first.pin_p)
        yield connect(self.first.pin_n, self.second.pin_p)
        yield connect(self.second.pin_n, self.third.pin_p)
        yield connect(self.third.pin_n, self.source.pin_n)
        yield connect(self.source.pin_n, self.ground.pin)


def test_a_capacitor_charges_through_a_resistor() -> None:
    """v = V (1 - exp(-t/RC)); the source gives C V^2, half of it is stored."""
    circuit = Loop(
        source=StepVoltage(V=5.0, start_time=0.5),
        first=Resistor(R=1e3),
        second=Capacitor(C=1e-3, v=start(0.0, fixed=True)),
    )
    solution = simulate(circuit, stop_time=10.0, options=PRECISE)
    t = solution.t
    expected = np.where(t > 0.5, 5.0 * (1 - np.exp(-(t - 0.5))), 0.0)
    assert solution["second.v"] == pytest.approx(expected, abs=5e-8)
    assert solution.final("second.E") == pytest.approx(0.5 * 1e-3 * solution.final("second.v") ** 2)
    assert [event.time for event in solution.events] == [0.5]


def test_a_series_resonant_circuit_rings() -> None:
    """i = V/(w L) exp(-a t) sin(w t), a = R/2L, w^2 = 1/LC - a^2."""
    R, L, C = 2.0, 1e-2, 1e-4
    circuit = Loop(
        first=Resistor(R=R),
        second=Inductor(L=L, i=start(0.0, fixed=True)),
        third=Capacitor(C=C, v=start(0.0, fixed=True)),
    )
    solution = simulate(circuit, stop_time=0.05, options=PRECISE)
    a = R / (2 * L)
    w = np.sqrt(1 / (L * C) - a**2)
    expected = np.exp(-a * solution.t) * np.sin(w * solution.t) / (w * L)
    assert solution["second.i"] == pytest.approx(expected, abs=1e-8)


def test_an_inductor_s_current_rises() -> None:
    """i = V/R (1 - exp(-R t/L))."""
    circuit = Loop(first=Conductor(G=0.5), second=Inductor(L=4.0, i=start(0.0, fixed=True)))
    solution = simulate(circuit, stop_time=10.0, options=PRECISE)
    assert solution["second.i"] == pytest.approx(0.5 * (1 - np.exp(-solution.t * 2.0 / 4.0)), abs=1e-8)


def test_resistance_depends_on_temperature() -> None:
    warm = Resistor(R=10.0, alpha=1 / 255, T_ref=293.15, T=343.15)
    solution = simulate(Loop(first=warm), stop_time=1.0)
    assert solution.final("first.v") / solution.final("first.i") == pytest.approx(10 * (1 + 50 / 255))
    assert solution.final("first.P_loss") == pytest.approx(
        solution.final("first.v") * solution.final("first.i")
    )


def test_the_flux_of_a_saturating_inductor() -> None:
    """The chord psi/i is L_nom at I_nom, L_zer at 0, and the slope L_inf far out; psi is the integral of v."""
    coil = SaturatingInductor(I_nom=2.0, L_nom=0.5, L_zer=1.3, L_inf=0.1, i=start(0.0, fixed=True))
    circuit = Loop(source=ConstantVoltage(V=1.0), first=Resistor(R=0.0), third=Resistor(R=0.0), second=coil)
    solution = simulate(circuit, stop_time=40.0, options=SolverOptions(rtol=1e-9, intervals=4000))
    i, psi = solution["second.i"], solution["second.psi"]
    assert psi == pytest.approx(solution.t, abs=1e-6)
    assert solution.at(0.5 * 2.0, "second.i") == pytest.approx(2.0, rel=1e-5)
    assert psi[1] / i[1] == pytest.approx(1.3, rel=0.01)
    assert solution.final("second.L_actual") == pytest.approx(0.1, rel=0.02)


class TwoCoils(Component):
    """A step on the primary coil of a transformer, a resistor at the secondary one."""

    source = ConstantVoltage(V=1.0)
    R1 = Resistor(R=1.0)
    coils = Transformer(L1=1.0, L2=2.0, M=1.0, i1=start(0.0, fixed=True), i2=start(0.0, fixed=True))
    R2 = Resistor(R=2.0)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.R1.pin_p)
        yield connect(self.R1.pin_n, self.coils.pin_p1)
        yield connect(self.coils.pin_p2, self.R2.pin_p)
        for pin in (self.source.pin_n, self.coils.pin_n1, self.coils.pin_n2, self.R2.pin_n):
            yield connect(pin, self.ground.pin)


def test_a_transformer_passes_a_step_and_then_nothing() -> None:
    """[L1 M; M L2] i' = [V - R1 i1, -R2 i2], by the matrix exponential."""
    from scipy.linalg import expm

    solution = simulate(TwoCoils(), stop_time=5.0, options=PRECISE)
    inverse = np.linalg.inv([[1.0, 1.0], [1.0, 2.0]])
    A = inverse @ np.diag([-1.0, -2.0])
    for t in (0.5, 2.0, 5.0):
        exact = np.linalg.solve(A, (expm(A * t) - np.eye(2)) @ inverse @ [1.0, 0.0])
        assert solution.at(t, "coils.i1") == pytest.approx(exact[0], abs=1e-7)
        assert solution.at(t, "coils.i2") == pytest.approx(exact[1], abs=1e-7)


class Matched(Component):
    """A load behind an element with two ports."""

    ideal: bool = True
    source = ConstantVoltage(V=10.0)
    R1 = Resistor(R=1.0)
    R2 = Resistor(R=2.0)
    meter = PowerSensor()
    ground = Ground()

    def build(self) -> None:
        self.between = IdealTransformer(n=3.0) if self.ideal else Gyrator(G1=0.1, G2=0.1)

    def equations(self) -> Equations:
        between, meter = self.between, self.meter
        yield connect(self.source.pin_p, self.R1.pin_p)
        yield connect(self.R1.pin_n, between.pin_p1)
        yield connect(between.pin_p2, meter.pin_p1)
        yield connect(meter.pin_n1, self.R2.pin_p)
        yield connect(meter.pin_p2, self.R2.pin_p)
        yield connect(meter.pin_n2, self.ground.pin)
        for pin in (self.source.pin_n, between.pin_n1, between.pin_n2, self.R2.pin_n):
            yield connect(pin, self.ground.pin)


@pytest.mark.parametrize(("ideal", "seen"), [(True, 9 * 2.0), (False, 1 / (0.1**2 * 2.0))])
def test_a_load_behind_two_ports(ideal: bool, seen: float) -> None:
    """n^2 R behind a transformer, 1/(G^2 R) behind a gyrator; no power is lost in either."""
    solution = simulate(Matched(ideal=ideal), stop_time=1.0)
    current = 10.0 / (1.0 + seen)
    assert solution.final("R1.i") == pytest.approx(current)
    assert solution.final("meter.P") == pytest.approx(current**2 * seen)
    assert solution.final("R2.P_loss") == pytest.approx(current**2 * seen)


class Motor(Component):
    """A direct-current motor on a constant voltage, its shaft braked by a damper."""

    source = ConstantVoltage(V=12.0)
    R = Resistor(R=0.5)
    ammeter = CurrentSensor()
    emf = EMF(k=0.1)
    rotor = Inertia(J=0.01, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    brake = Damper(d=0.02)
    housing = Fixed()
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.R.pin_p)
        yield connect(self.R.pin_n, self.ammeter.pin_p)
        yield connect(self.ammeter.pin_n, self.emf.pin_p)
        yield connect(self.emf.pin_n, self.source.pin_n)
        yield connect(self.source.pin_n, self.ground.pin)
        yield connect(self.emf.flange, self.rotor.flange_a)
        yield connect(self.rotor.flange_b, self.brake.flange_a)
        yield connect(self.brake.flange_b, self.housing.flange)


def test_a_motor_runs_up() -> None:
    """J w' = k (V - k w)/R - d w."""
    solution = simulate(Motor(), stop_time=2.0, options=PRECISE)
    rate = (0.1**2 / 0.5 + 0.02) / 0.01
    final = 0.1 * 12.0 / 0.5 / (0.1**2 / 0.5 + 0.02)
    assert solution["rotor.w"] == pytest.approx(final * (1 - np.exp(-rate * solution.t)), abs=1e-6)
    assert solution["ammeter.i"] == pytest.approx((12.0 - 0.1 * solution["rotor.w"]) / 0.5)


class Waves(Component):
    """Sources of many shapes, each on its own resistor, and meters."""

    sine = SineVoltage(V=2.0, f=0.5, phase=0.3, offset=1.0, start_time=0.25)
    pulse = PulseVoltage(V=3.0, period=0.4, duty=0.25, start_time=0.1)
    table = TableVoltage(times=(0.0, 1.0, 1.5), values=(0.0, 2.0, -1.0))
    ramp = RampCurrent(I=4.0, duration=0.5, start_time=0.5)
    given = SignalVoltage()
    signal = blocks.ExpSine.of("V")(amplitude=2.0, f=1.0, damping=0.5)
    level = ConstantCurrent(I=2.0)
    volts = VoltageSensor()
    potential = PotentialSensor()
    ground = Ground()

    def build(self) -> None:
        self.resistors = [Resistor(R=1.0) for _ in range(6)]

    def equations(self) -> Equations:
        sources: list[TwoPin] = [self.sine, self.pulse, self.table, self.ramp, self.given, self.level]
        for source, resistor in zip(sources, self.resistors, strict=True):
            yield connect(source.pin_p, resistor.pin_p)
            yield connect(source.pin_n, resistor.pin_n)
            yield connect(source.pin_n, self.ground.pin)
        yield connect(self.signal.y, self.given.V)
        yield connect(self.volts.pin_p, self.given.pin_p)
        yield connect(self.volts.pin_n, self.given.pin_n)
        yield connect(self.potential.pin, self.level.pin_p)


def test_sources_follow_their_shapes() -> None:
    solution = simulate(Waves(), stop_time=2.0, options=SolverOptions(intervals=400))
    t = solution.t + 0.0
    keep = np.ones(len(t), dtype=bool)
    keep[1:] &= np.diff(t) > 0  # at an event the row before and the row after
    keep[:-1] &= np.diff(t) > 0
    t = t[keep]
    sine = 1.0 + np.where(t < 0.25, 0.0, 2.0 * np.sin(2 * np.pi * 0.5 * (t - 0.25) + 0.3))
    assert solution["sine.v"][keep] == pytest.approx(sine)
    inside = np.mod(t - 0.1, 0.4) < 0.1
    assert solution["pulse.v"][keep] == pytest.approx(np.where((t >= 0.1) & inside, 3.0, 0.0))
    assert solution["table.v"][keep] == pytest.approx(np.interp(t, (0.0, 1.0, 1.5), (0.0, 2.0, -1.0)))
    assert solution["ramp.i"][keep] == pytest.approx(4.0 * np.clip((t - 0.5) / 0.5, 0.0, 1.0))
    assert solution["volts.v"][keep] == pytest.approx(
        2.0 * np.exp(-0.5 * t) * np.sin(2 * np.pi * t), abs=1e-12
    )
    assert solution["potential.phi"][keep] == pytest.approx(-2.0)  # the current comes out of pin_n
