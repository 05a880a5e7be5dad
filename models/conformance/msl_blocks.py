"""Examples of the Modelica Standard Library 4.1.0, Blocks, built from the library.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from math import pi

from arthur_acausal import Component, Equations, Real, connect, der, parameter, start
from arthur_acausal.components.blocks import (
    And,
    Constant,
    CosineVariableFrequencyAndAmplitude,
    Der,
    ExpSine,
    Filter,
    Integrator,
    KinematicPTP,
    LimPID,
    Not,
    Or,
    Pre,
    Pulse,
    Sinc,
    Sine,
    SineVariableFrequencyAndAmplitude,
    SlewRateLimiter,
    Step,
)
from arthur_acausal.components.rotational import Inertia, SpeedSensor, SpringDamper, TorqueSource
from arthur_acausal.models.conformance.case import Case, precise


class PIDController(Component):
    """A PI controller drives two inertias with a compliant shaft along a planned speed (PID_Controller).

    It starts in steady state: the shaft carries the load torque, the integrator holds it.
    """

    drive_angle: Real = parameter("rad", default=pi / 2)
    kinematicPTP = KinematicPTP.of("rad/s^2")(
        distance=lambda self: self.drive_angle, speed_max=1.0, acceleration_max=1.0, start_time=0.5
    )
    integrator = Integrator.of("rad/s", "rad/s^2")()
    PI = LimPID.of("N*m", "rad/s")(
        controller="PI", k=100.0, T_i=0.1, y_max=12.0, Ni=0.1, I=start(0.0, fixed=False)
    )
    torque = TorqueSource()
    inertia1 = Inertia(J=1.0, phi=start(0.0, fixed=True))
    spring = SpringDamper(c=1e4, d=100.0, w_rel=start(0.0, fixed=True))
    inertia2 = Inertia(J=2.0)
    speed_sensor = SpeedSensor()
    load = Constant.of("N*m")(k=10.0)
    load_torque = TorqueSource()

    def equations(self) -> Equations:
        yield connect(self.kinematicPTP.y, self.integrator.u)
        yield connect(self.integrator.y, self.PI.u_s)
        yield connect(self.speed_sensor.w, self.PI.u_m)
        yield connect(self.PI.y, self.torque.tau)
        yield connect(self.torque.flange, self.inertia1.flange_a)
        yield connect(self.inertia1.flange_b, self.spring.flange_a)
        yield connect(self.inertia1.flange_b, self.speed_sensor.flange)
        yield connect(self.spring.flange_b, self.inertia2.flange_a)
        yield connect(self.load.y, self.load_torque.tau)
        yield connect(self.load_torque.flange, self.inertia2.flange_b)

    def initial_equations(self) -> Equations:
        yield der(self.inertia1.w) == 0
        yield der(self.inertia2.w) == 0  # with the line above: der(spring.w_rel) == 0
        yield der(self.PI.I) == 0


class Filters(Component):
    """Four filters of third order behind a step (Filter)."""

    step = Step(offset=0.1, start_time=0.1)

    def build(self) -> None:
        self.CriticalDamping = Filter(n=3, f_cut=2.0)
        self.Bessel = Filter(n=3, f_cut=2.0, characteristic="Bessel")
        self.Butterworth = Filter(n=3, f_cut=2.0, characteristic="Butterworth")
        self.ChebyshevI = Filter(n=3, f_cut=2.0, characteristic="Chebyshev I")

    def equations(self) -> Equations:
        for block in (self.CriticalDamping, self.Bessel, self.Butterworth, self.ChebyshevI):
            yield connect(self.step.y, block.u)


class FilterWithDifferentiation(Component):
    """A filter of third order and three derivatives of its output (FilterWithDifferentiation)."""

    step = Step(offset=0.1, start_time=0.1)
    der1: Der = Der.of("1/s", "1")()
    der2: Der = Der.of("1/s^2", "1/s")()
    der3: Der = Der.of("1/s^3", "1/s^2")()

    def build(self) -> None:
        self.Bessel = Filter(n=3, f_cut=2.0, characteristic="Bessel")

    def equations(self) -> Equations:
        yield connect(self.step.y, self.Bessel.u)
        yield connect(self.Bessel.y, self.der1.u)
        yield connect(self.der1.y, self.der2.u)
        yield connect(self.der2.y, self.der3.u)


class FilterWithRiseTime(Component):
    """Three filters of second order whose cut-off frequencies follow from a rise time (FilterWithRiseTime)."""

    step = Step(start_time=1.0)

    def build(self) -> None:
        self.filter_fac3, self.filter_fac4, self.filter_fac5 = [
            Filter(n=2, f_cut=factor / (2 * pi * 2.0)) for factor in (3, 4, 5)
        ]

    def equations(self) -> Equations:
        for block in (self.filter_fac3, self.filter_fac4, self.filter_fac5):
            yield connect(self.step.y, block.u)


class SlewRates(Component):
    """A step of position, limited in speed and in acceleration (SlewRateLimiter)."""

    positionStep: Step = Step.of("m")(start_time=0.1)
    limit_v: SlewRateLimiter = SlewRateLimiter.of("m")(rising=2.0, T_d=1e-4)
    v: Der = Der.of("m/s", "m")()
    limit_a: SlewRateLimiter = SlewRateLimiter.of("m/s")(rising=20.0, T_d=1e-4)
    positionSmoothed: Integrator = Integrator.of("m", "m/s")()
    a: Der = Der.of("m/s^2", "m/s")()

    def equations(self) -> Equations:
        yield connect(self.positionStep.y, self.limit_v.u)
        yield connect(self.limit_v.y, self.v.u)
        yield connect(self.v.y, self.limit_a.u)
        yield connect(self.limit_a.y, self.positionSmoothed.u)
        yield connect(self.limit_a.y, self.a.u)


class CompareSincExpSine(Component):
    """A sinc and two decaying sines (CompareSincExpSine)."""

    sinc = Sinc(f=5.0)
    expSine1 = ExpSine(f=5.0, damping=5.0)
    expSine2 = ExpSine(f=5.0, phase=pi / 2, damping=5.0)


class Modulation(Component):
    """Waves modulated in amplitude and in frequency (Modulation)."""

    sine = SineVariableFrequencyAndAmplitude(f=100.0)
    amplitude = Sine(amplitude=0.5, f=2.0, offset=1.0)
    frequency: Sine = Sine.of("Hz")(amplitude=50.0, f=2.0, offset=100.0)
    sinAM = SineVariableFrequencyAndAmplitude(f=100.0)
    cosAM = CosineVariableFrequencyAndAmplitude(f=100.0)
    sinFM = SineVariableFrequencyAndAmplitude()
    cosFM = CosineVariableFrequencyAndAmplitude()

    def equations(self) -> Equations:
        yield connect(self.amplitude.y, self.sinAM.amplitude)
        yield connect(self.amplitude.y, self.cosAM.amplitude)
        yield connect(self.frequency.y, self.sinFM.f)
        yield connect(self.frequency.y, self.cosFM.f)


class LogicalNetwork1(Component):
    """Logical blocks in a loop that is broken by the value before (LogicalNetwork1)."""

    table1 = Pulse(period=4.0, start_time=2.0)
    table2 = Pulse(period=4.0, start_time=1.0)
    Not1 = Not()
    And1 = And()
    Or1 = Or()
    Pre1 = Pre()

    def equations(self) -> Equations:
        yield connect(self.table2.y, self.Not1.u)
        yield connect(self.Not1.y, self.And1.u1)
        yield connect(self.Pre1.y, self.And1.u2)
        yield connect(self.table1.y, self.Or1.u1)
        yield connect(self.And1.y, self.Or1.u2)
        yield connect(self.Or1.y, self.Pre1.u)


_SIGNALS = {
    "PI.I.y": "PI.I",
    "inertia1.phi": "inertia1.phi",
    "inertia1.w": "inertia1.w",
    "integrator.y": "integrator.y",
    "spring.phi_rel": "spring.phi_rel",
    "spring.w_rel": "spring.w_rel",
}


_B = "msl_Blocks_"
_CASES = (
    Case(f"{_B}PID_Controller", PIDController, _SIGNALS, 4.0),
    Case(f"{_B}Filter", Filters, {}, 0.9, precise(2000)),
    Case(f"{_B}FilterWithDifferentiation", FilterWithDifferentiation, {}, 0.9, precise(2000)),
    Case(f"{_B}FilterWithRiseTime", FilterWithRiseTime, {}, 4.0, precise(2000)),
    Case(f"{_B}SlewRateLimiter", SlewRates, {}, 1.0, precise(5000)),
    Case(f"{_B}CompareSincExpSine", CompareSincExpSine, {}, 1.0, precise(10000)),
    Case(f"{_B}Modulation", Modulation, {}, 1.0, precise(20000)),
    Case(f"{_B}LogicalNetwork1", LogicalNetwork1, {}, 10.0, precise(2000)),
)
CASES: dict[str, Case] = {case.name: case for case in _CASES}
