"""The smallest drive: a battery, a direct-current motor, an inertia."""

from __future__ import annotations

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components.electrical import EMF, ConstantVoltage, Ground, Inductor, Resistor
from arthur_acausal.components.rotational import Damper, Fixed, Inertia


class DCMotor(Component):
    """A motor that is switched on and runs up against the friction of its bearing.

    With a negligible inductance its speed is k V / (k^2 + R d) (1 - exp(-t / T)), T = J R / (k^2 + R d).
    """

    battery: ConstantVoltage = ConstantVoltage(V=24.0)
    R: Resistor = Resistor(R=0.5)
    L: Inductor = Inductor(L=1e-3, i=start(0.0, fixed=True))
    emf: EMF = EMF(k=0.1)
    rotor: Inertia = Inertia(J=2e-3, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    bearing: Damper = Damper(d=1e-3)
    housing = Fixed()
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.battery.pin_p, self.R.pin_p)
        yield connect(self.R.pin_n, self.L.pin_p)
        yield connect(self.L.pin_n, self.emf.pin_p)
        yield connect(self.emf.pin_n, self.battery.pin_n)
        yield connect(self.battery.pin_n, self.ground.pin)
        yield connect(self.emf.flange, self.rotor.flange_a)
        yield connect(self.rotor.flange_b, self.bearing.flange_a)
        yield connect(self.bearing.flange_b, self.housing.flange)
