"""Control of the pump's motor: exchangeable blocks between what is measured or planned and the motor's voltage."""

from __future__ import annotations

from casadi import SX, fmax, fmin

from arthur_acausal import (
    Component,
    Equations,
    Real,
    der,
    discrete,
    parameter,
    real_input,
    real_output,
    variable,
)


class Planned(Component):
    """A flow ``q`` [m^3/s] planned for a moment ahead; whoever plans sets it at events, until then it is 0."""

    q: Real = discrete("m^3/s")


class PumpControl(Component):
    """What all controllers of the pump share: their interface, and the loop of the speed.

    Inputs: ``w`` [rad/s] speed of the motor, ``p`` [Pa] supply pressure, ``q_command`` [m^3/s] flow that the
    actuators' controllers ask for now, ``plan[k].q`` the flow planned for k steps of the locomotion controller ahead,
    from now on to its ``horizon`` (a controller that predicts uses it, the others do not). Output: ``V`` [V],
    the voltage asked of the drive: V = K_e w_d + R_p p + k_w (w_d - w), back-emf and load ahead, so that the speed
    follows ``w_d`` [rad/s].

    A subclass says what ``w_d`` is, within ``w_min`` to ``w_max``.
    """

    horizon: int = 10
    w: Real = real_input("rad/s", nominal=500.0, display="rpm", description="speed of the motor")
    p: Real = real_input("Pa", nominal=1e7, display="bar", description="supply pressure")
    q_command: Real = real_input("m^3/s", default=0.0, nominal=1e-4, description="flow that is asked for")
    V: Real = real_output("V", nominal=40.0, description="voltage asked of the drive")
    K_e: Real = parameter("V*s/rad", min=0.0, description="back-emf constant of the motor")
    R_p: Real = parameter("V/Pa", min=0.0, description="voltage for the pump's torque: R_LL c_L/K_T")
    k_w: Real = parameter("V*s/rad", default=0.3, min=0.0, description="gain of the speed loop; assumed")
    w_min: Real = parameter("rad/s", default=50.0, min=0.0, display="rpm", description="least speed")
    w_max: Real = parameter("rad/s", default=550.0, min=0.0, display="rpm", description="greatest speed")
    w_d: Real = variable("rad/s", nominal=500.0, display="rpm", description="speed asked for")

    def build(self) -> None:
        self.plan = [Planned() for _ in range(self.horizon + 1)]

    def equations(self) -> Equations:
        ahead = self.K_e * self.w_d + self.R_p * self.p
        yield "speed loop", self.V == ahead + self.k_w * (self.w_d - self.w)


class ConstantSpeed(PumpControl):
    """The motor turns at ``w_0`` [rad/s], whatever is needed; the relief valve keeps the pressure."""

    w_0: Real = parameter("rad/s", default=523.6, min=0.0, display="rpm", description="speed: 5000 rpm")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_d == self.w_0


class PressureControl(PumpControl):
    """PI regulation of the supply pressure to ``P_des`` [Pa]: w_d = k_p e + x, x' = k_p e/T_i, limited.

    The gain follows from the supply's capacitance: a pump of c_L = D/(2 pi) that turns faster by one rad/s raises the
    pressure by c_L/C a second, so k_p = omega_c C/c_L crosses at ``omega_c``. State: ``x`` [rad/s].

    Parameters: ``C`` [m^3/Pa] of accumulator and manifold, ``omega_c`` [rad/s], ``T_i`` [s]: assumed.
    """

    P_des: Real = parameter("Pa", default=135e5, min=0.0, display="bar", description="pressure to keep")
    c_L: Real = parameter("m^3", min=0.0, description="torque constant of the pump, D/(2 pi)")
    C: Real = parameter("m^3/Pa", min=0.0, description="capacitance of the supply")
    omega_c: Real = parameter("rad/s", default=60.0, min=0.0, description="crossing frequency")
    T_i: Real = parameter("s", default=0.1, min=0.0, description="integral time")
    k_aw: Real = parameter("1/s", default=50.0, min=0.0, description="anti-windup")
    e: Real = variable("Pa", nominal=1e6, display="bar", description="error of the pressure")
    w_ask: Real = variable("rad/s", nominal=500.0, display="rpm", description="speed before its limits")
    x: Real = variable("rad/s", start=100.0, nominal=500.0, display="rpm", description="integral part")

    def equations(self) -> Equations:
        yield from super().equations()
        k_p = self.omega_c * self.C / self.c_L
        yield self.e == self.P_des - self.p
        yield "PI", self.w_ask == k_p * self.e + self.x + self.feed_forward()
        yield "limits", self.w_d == fmin(fmax(self.w_ask, self.w_min), self.w_max)
        yield "integral", der(self.x) == k_p * self.e / self.T_i - self.k_aw * (self.w_ask - self.w_d)

    def feed_forward(self) -> SX:
        """Return what is added to the speed [rad/s]."""
        return SX(0.0)


class FlowFeedForward(PressureControl):
    """PI regulation of the pressure with feed-forward of the flow that the actuators ask for, ``q_command``/c_L."""

    def feed_forward(self) -> SX:
        return self.q_command / self.c_L
