"""A direct-current motor under speed control: blocks, electrical and rotational parts in one model."""

from __future__ import annotations

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components.blocks import LimPID, LowpassButterworth, SlewRateLimiter, Step
from arthur_acausal.components.electrical import EMF, Ground, Inductor, Resistor, SignalVoltage
from arthur_acausal.components.rotational import Damper, Fixed, Inertia, SpeedSensor, TorqueSource


class MotorControl(Component):
    """A PI controller with a limited voltage runs a motor up to 100 rad/s and holds it against a load.

    The set point rises at 200 rad/s^2; the measured speed passes a filter of 100 Hz. The load ``load.tau`` [N m] is an
    external input. While the voltage is at its limit of 24 V, the anti-windup holds the integrator back.
    """

    set_point = Step.of("rad/s")(height=100.0, start_time=0.1)
    slope = SlewRateLimiter.of("rad/s")(rising=200.0)
    controller: LimPID = LimPID.of("V", "rad/s")(controller="PI", k=0.5, T_i=0.1, y_max=24.0)
    amplifier = SignalVoltage()
    R = Resistor(R=0.5)
    L = Inductor(L=1e-3, i=start(0.0, fixed=True))
    emf = EMF(k=0.1)
    rotor: Inertia = Inertia(J=2e-3, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    bearing = Damper(d=1e-3)
    housing = Fixed()
    load = TorqueSource()
    speed = SpeedSensor()
    filter = LowpassButterworth.of("rad/s")(n=2, f=100.0)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.set_point.y, self.slope.u)
        yield connect(self.slope.y, self.controller.u_s)
        yield connect(self.filter.y, self.controller.u_m)
        yield connect(self.controller.y, self.amplifier.V)
        yield connect(self.amplifier.pin_p, self.R.pin_p)
        yield connect(self.R.pin_n, self.L.pin_p)
        yield connect(self.L.pin_n, self.emf.pin_p)
        yield connect(self.emf.pin_n, self.amplifier.pin_n)
        yield connect(self.amplifier.pin_n, self.ground.pin)
        yield connect(self.emf.flange, self.rotor.flange_a)
        yield connect(self.rotor.flange_b, self.bearing.flange_a)
        yield connect(self.bearing.flange_b, self.housing.flange)
        yield connect(self.rotor.flange_b, self.load.flange)
        yield connect(self.rotor.flange_b, self.speed.flange)
        yield connect(self.speed.w, self.filter.u)
