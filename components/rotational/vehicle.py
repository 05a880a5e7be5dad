"""A ground vehicle in one dimension, driven at its wheels."""

from __future__ import annotations

from casadi import atan, cos, fabs, fmax, fmin, sin

from arthur_acausal import Component, Equations, Real, der, parameter, real_input, variable
from arthur_acausal.components.rotational.flange import Flange
from arthur_acausal.components.translational import Flange as SlidingFlange


class Vehicle(Component):
    """A mass on wheels that roll, against the air, the rolling resistance and the slope.

    m v' + J w'/R = tau/R + f - F_air - F_roll - F_slope, v = R w; F_air = C_d A rho |v_r| v_r/2, v_r = v - v_wind;
    F_roll = C_r m g cos(alpha) against the motion, linear in the speed below ``v_reg`` [m/s]; F_slope = m g
    sin(alpha); the signal ``inclination`` [1] = tan(alpha) is positive uphill. tau [N m] acts at ``flange_r``, f [N] at
    ``flange_t``. States: ``s`` [m], ``v`` [m/s]. Mitschke and Wallentowitz, Dynamik der Kraftfahrzeuge (2004), ch. 2;
    parameters as in the Modelica Standard Library 4.1, Mechanics.Translational.Components.Vehicle.
    """

    flange_r = Flange()
    flange_t = SlidingFlange()
    inclination: Real = real_input("1", default=0.0, description="slope, positive uphill")
    v_wind: Real = real_input("m/s", default=0.0, description="speed of the wind, positive along v")
    m: Real = parameter("kg", min=0.0, description="total mass")
    J: Real = parameter("kg*m^2", default=0.0, min=0.0, description="inertia of wheels and drive train")
    R: Real = parameter("m", min=0.0, description="radius of the wheels")
    A: Real = parameter("m^2", default=1.0, min=0.0, description="cross section")
    C_d: Real = parameter("1", default=0.5, min=0.0, description="drag coefficient")
    rho: Real = parameter("kg/m^3", default=1.2, min=0.0, description="density of the air")
    C_r: Real = parameter("1", default=0.015, min=0.0, description="rolling resistance coefficient")
    v_reg: Real = parameter("m/s", default=1e-3, min=0.0, description="end of the linear rolling resistance")
    g: Real = parameter("m/s^2", default=9.80665)
    s: Real = variable("m", start=0.0, description="position")
    v: Real = variable("m/s", start=0.0, description="velocity")
    w: Real = variable("rad/s", description="speed of the wheels")
    f_drive: Real = variable("N", description="force of the wheels on the vehicle")
    f_air: Real = variable("N", description="against positive v")
    f_roll: Real = variable("N", description="against positive v")
    f_slope: Real = variable("N", description="against positive v")

    def equations(self) -> Equations:
        yield self.s == self.flange_t.s
        yield self.s == self.R * self.flange_r.phi
        yield self.v == der(self.s)
        yield self.w == der(self.flange_r.phi)
        yield "wheels", self.J * der(self.w) == self.flange_r.tau - self.R * self.f_drive
        resistance = self.f_air + self.f_roll + self.f_slope
        yield "Newton's second law", self.m * der(self.v) == self.f_drive + self.flange_t.f - resistance
        apparent, alpha = self.v - self.v_wind, atan(self.inclination)
        yield "air", self.f_air == self.C_d * self.A * self.rho * fabs(apparent) * apparent / 2
        direction = fmin(fmax(self.v / self.v_reg, -1), 1)
        yield "rolling", self.f_roll == self.C_r * self.m * self.g * cos(alpha) * direction
        yield "slope", self.f_slope == self.m * self.g * sin(alpha)
