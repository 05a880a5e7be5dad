"""Control of the pump's motor: exchangeable blocks between what is measured or planned and the motor's voltage."""

from __future__ import annotations

from casadi import SX, Function, fmax, fmin

from arthur_acausal import (
    Component,
    Equations,
    Real,
    der,
    discrete,
    parameter,
    real_input,
    real_output,
    sampled,
    smooth_if_else,
    variable,
)
from arthur_acausal.models.arthur.supply_model import SupplyModel


class Planned(Component):
    """What is planned for a moment ahead; whoever plans sets it at events, until then it is 0.

    ``q`` [m^3/s] flow that the actuators will take, ``p`` [Pa] supply pressure that their forces will need.
    """

    q: Real = discrete("m^3/s")
    p: Real = discrete("Pa")


class PumpControl(Component):
    """What all controllers of the pump share: their interface.

    Inputs: ``w`` [rad/s] speed of the motor, ``p`` [Pa] supply pressure, ``q_command`` [m^3/s] flow that the
    actuators' controllers ask for now, ``plan[k].q`` and ``plan[k].p`` what is planned for k times ``step`` [s] ahead,
    from now on to ``steps``. A controller with foresight uses as much of the plan as lies within its ``horizon`` [s],
    the others none. Output: ``V`` [V], the voltage asked of the drive. ``believed`` is what it takes for the data of
    motor, pump and supply, ``P_des`` [Pa] the pressure that it shall keep.
    """

    steps: int = 10
    believed: SupplyModel = SupplyModel()
    w: Real = real_input("rad/s", nominal=500.0, display="rpm", description="speed of the motor")
    p: Real = real_input("Pa", nominal=1e7, display="bar", description="supply pressure")
    q_command: Real = real_input("m^3/s", default=0.0, nominal=1e-4, description="flow that is asked for")
    V: Real = real_output("V", nominal=40.0, description="voltage asked of the drive")
    P_des: Real = parameter("Pa", default=135e5, min=0.0, display="bar", description="pressure to keep")
    step: Real = parameter("s", default=0.03, min=0.0, description="of the plan")
    horizon: Real = parameter("s", default=0.3, min=0.0, description="how far the plan is used")
    w_max: Real = parameter("rad/s", default=550.0, min=0.0, display="rpm", description="greatest speed")

    def build(self) -> None:
        self.plan = [Planned() for _ in range(self.steps + 1)]


class SpeedControl(PumpControl):
    """A controller that asks for a speed ``w_d`` [rad/s], within ``w_min`` to ``w_max``, and its loop.

    V = K_e w_d + R_LL c_L p/K_T + k_w (w_d - w): back-emf and load ahead, so that the speed follows. A subclass
    says what ``w_d`` is.
    """

    k_w: Real = parameter("V*s/rad", default=0.3, min=0.0, description="gain of the speed loop; assumed")
    w_min: Real = parameter("rad/s", default=50.0, min=0.0, display="rpm", description="least speed")
    w_d: Real = variable("rad/s", nominal=500.0, display="rpm", description="speed asked for")

    def equations(self) -> Equations:
        model = self.believed
        ahead = model.K_e * self.w_d + model.R_LL * model.c_L * self.p / model.K_T
        yield "speed loop", self.V == ahead + self.k_w * (self.w_d - self.w)


class ConstantSpeed(SpeedControl):
    """The motor turns at ``w_0`` [rad/s], whatever is needed; the relief valve keeps the pressure."""

    w_0: Real = parameter("rad/s", default=523.6, min=0.0, display="rpm", description="speed: 5000 rpm")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w_d == self.w_0


class GivenSpeed(SpeedControl):
    """The speed is asked for from outside: ``command`` [rad/s], within its limits."""

    command: Real = real_input("rad/s", default=100.0, nominal=500.0, display="rpm")

    def equations(self) -> Equations:
        yield from super().equations()
        yield "limits", self.w_d == fmin(fmax(self.command, self.w_min), self.w_max)


class GivenVoltage(PumpControl):
    """The voltage is asked for from outside: ``command`` [V]."""

    command: Real = real_input("V", default=10.0, nominal=40.0)

    def equations(self) -> Equations:
        yield self.V == self.command


class PressureControl(SpeedControl):
    """PI regulation of the supply pressure to ``P_des`` [Pa]: w_d = k_p e + x, x' = k_p e/T_i, limited.

    The gain follows from the supply's capacitance C: a pump of c_L = D/(2 pi) that turns faster by one rad/s raises the
    pressure by c_L/C a second, so k_p = omega_c C/c_L crosses at ``omega_c``. State: ``x`` [rad/s].

    Parameters: ``omega_c`` [rad/s], ``T_i`` [s]: assumed.
    """

    omega_c: Real = parameter("rad/s", default=60.0, min=0.0, description="crossing frequency")
    T_i: Real = parameter("s", default=0.1, min=0.0, description="integral time")
    k_aw: Real = parameter("1/s", default=50.0, min=0.0, description="anti-windup")
    e: Real = variable("Pa", nominal=1e6, display="bar", description="error of the pressure")
    w_ask: Real = variable("rad/s", nominal=500.0, display="rpm", description="speed before its limits")
    x: Real = variable("rad/s", start=100.0, nominal=500.0, display="rpm", description="integral part")

    def equations(self) -> Equations:
        yield from super().equations()
        model = self.believed
        k_p = self.omega_c * model.capacitance(self.P_des) / model.c_L
        yield self.e == self.P_des - self.p
        yield "PI", self.w_ask == k_p * self.e + self.x + self.feed_forward()
        yield "limits", self.w_d == fmin(fmax(self.w_ask, self.w_min), self.w_max)
        yield "integral", der(self.x) == k_p * self.e / self.T_i - self.k_aw * (self.w_ask - self.w_d)

    def feed_forward(self) -> SX:
        """Return what is added to the speed [rad/s]."""
        return SX(0.0)


class FlowFeedForward(PressureControl):
    """PI regulation of the pressure with feed-forward of the flow that the actuators ask for, k_q q_command/c_L."""

    k_q: Real = parameter("1", default=1.0, min=0.0, description="share of the flow that is fed forward")

    def feed_forward(self) -> SX:
        return self.k_q * self.q_command / self.believed.c_L


class ForesightFeedForward(PressureControl):
    """PI regulation of the pressure with feed-forward of the flow that is planned.

    What is fed forward begins ``lead`` [s] ahead, as rotor and current limit take time to follow, and is the mean
    over ``span`` [s], as the accumulator bridges what is shorter. ``peak`` [1] is the share of the greatest flow
    within the horizon that takes its place, for a supply that cannot store what a peak needs. The window ends at the
    ``horizon``; the plan is linear between its points. It is looked at each ``period`` [s], and held to first order.
    """

    k_q: Real = parameter("1", default=1.0, min=0.0, description="share of the flow that is fed forward")
    lead: Real = parameter("s", default=0.01, min=0.0, description="beginning of the window")
    span: Real = parameter("s", default=0.02, min=0.0, description="length of the window")
    span_min: Real = parameter("s", default=1e-3, min=0.0, description="least length of the window")
    peak: Real = parameter("1", default=0.0, min=0.0, max=1.0, description="share of the greatest flow ahead")
    period: Real = parameter("s", default=0.004, min=0.0, description="between two looks at the plan")
    q_ahead: Real = variable("m^3/s", start=0.0, nominal=1e-4, description="flow that is fed forward")

    def equations(self) -> Equations:
        yield from super().equations()
        window = (self.step, self.horizon, self.lead, self.span, self.span_min, self.peak)
        inputs = [*window, *(ahead.q for ahead in self.plan)]
        yield sampled(
            ahead_of(self.steps), period=self.period, inputs=inputs, outputs=[self.q_ahead], hold="first"
        )

    def feed_forward(self) -> SX:
        return self.k_q * self.q_ahead / self.believed.c_L


def ahead_of(steps: int) -> Function:
    """Return the function of (t, inputs) of ForesightFeedForward: the flow that is fed forward."""
    t, inputs = SX.sym("t"), SX.sym("inputs", 6 + steps + 1)
    step, horizon, lead, span, span_min, peak = (inputs[i] for i in range(6))
    begin = fmin(lead, horizon)
    width = fmax(fmin(span, horizon - begin), span_min)
    mean, greatest = SX(0.0), inputs[6]
    for k in range(steps + 1):
        q = inputs[6 + k]
        share = hat_integral((begin + width) / step - k) - hat_integral(begin / step - k)
        mean += share * step / width * q
        greatest = fmax(greatest, smooth_if_else(k * step <= horizon, q, 0))
    return Function("ahead", [t, inputs], [mean + peak * (greatest - mean)])


def hat_integral(x: SX) -> SX:
    """Return the integral up to ``x`` of the hat function 1 - |x| on [-1, 1]."""
    x = fmin(fmax(x, -1), 1)
    return smooth_if_else(x < 0, (1 + x) ** 2 / 2, 1 - (1 - x) ** 2 / 2)
