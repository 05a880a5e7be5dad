"""Examples of the Modelica Standard Library 4.1.0, Blocks, built from the library.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from math import pi

from arthur_acausal import Component, Equations, Real, connect, der, parameter, start
from arthur_acausal.components.blocks import Constant, Integrator, KinematicPTP, LimPID
from arthur_acausal.components.rotational import Inertia, SpeedSensor, SpringDamper, TorqueSource
from arthur_acausal.models.conformance.case import Case


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


_SIGNALS = {
    "PI.I.y": "PI.I",
    "inertia1.phi": "inertia1.phi",
    "inertia1.w": "inertia1.w",
    "integrator.y": "integrator.y",
    "spring.phi_rel": "spring.phi_rel",
    "spring.w_rel": "spring.w_rel",
}
CASES: dict[str, Case] = {
    "msl_Blocks_PID_Controller": Case("msl_Blocks_PID_Controller", PIDController, _SIGNALS, 4.0)
}
