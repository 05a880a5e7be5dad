"""The quadruped's hydraulic supply: battery, drive, motor, pump, manifold, accumulator, relief valve, filter, tank."""

from __future__ import annotations

from math import pi
from typing import Any, Literal

from arthur_acausal import (
    Component,
    DeclarationError,
    Equations,
    Real,
    connect,
    der,
    parameter,
    real_input,
    start,
)
from arthur_acausal.components.blocks import EnergyMeter
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic import (
    GPM,
    Accumulator,
    BatteryDrive,
    BrushlessMotor,
    Filter,
    Fluid,
    GasReservoir,
    GearPump,
    HydraulicPort,
    PressureSensor,
    ReliefValve,
    Volume,
    pump_scaling,
)
from arthur_acausal.components.hydraulic.motor import LINE_TO_LINE
from arthur_acausal.components.rotational import SpeedSensor
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.predictive_control import PredictiveControl
from arthur_acausal.models.arthur.pump_control import (
    ConstantSpeed,
    FlowFeedForward,
    ForesightFeedForward,
    GivenSpeed,
    GivenVoltage,
    PressureControl,
    PumpControl,
)
from arthur_acausal.models.arthur.supply_model import SupplyModel

POWERS = {
    "input": ("drive", "P_battery"),
    "drive": ("drive", "P_loss"),
    "copper": ("motor", "P_copper"),
    "motor_friction": ("motor", "P_friction"),
    "pump_friction": ("pump", "P_friction"),
    "pump_leakage": ("pump", "P_leakage"),
    "pump_compression": ("pump", "P_compression"),
    "relief": ("relief", "P_loss"),
    "filter": ("filter", "P_loss"),
    "reservoir": ("reservoir", "P_loss"),
}
"""Term of the energy audit -> (part, signal [W]): each loss by its own law, none a difference."""

STORED = ("motor.E_stored", "pump.E_stored", "manifold.E_stored", "reservoir.E_stored")

PumpLaw = Literal[
    "constant speed",
    "pressure",
    "feed-forward",
    "foresight",
    "predictive",
    "predictive pressure",
    "clairvoyant",
    "given speed",
    "given voltage",
]

CONTROLS: dict[str, type[PumpControl]] = {
    "pressure": PressureControl,
    "feed-forward": FlowFeedForward,
    "foresight": ForesightFeedForward,
    "given speed": GivenSpeed,
    "given voltage": GivenVoltage,
}
"""Controllers that need nothing but the data of the unit."""


class PowerUnit(Component):
    """Makes the pressure at ``supply`` from a battery; ``tank`` is the return, a gas-loaded reservoir.

    Parts and laws are those of the powertrain (report, sections 5 and 6). The accumulator is one with the
    manifold, before the filter. It starts in balance: speed, pressure and the controller's integral do not change, the
    reservoir has ``p_tank``. Its piston's seal takes 0.1 bar at 1 cm/s (``b_tank``); with the 10 N s/m of Table 11 it
    would ring at 4.2 kHz.

    Structural parameters: ``law`` of the pump's control, see ConstantSpeed, PressureControl, FlowFeedForward,
    ForesightFeedForward and PredictiveControl; "predictive pressure" decides about the pressure, too, "clairvoyant" has
    the demand ``known`` from another run in place of a plan; "given speed" and "given voltage" come from outside,
    ``w_command`` [rad/s] and ``V_command`` [V], and begin at ``P_des``. ``accumulator``: False leaves it out;
    ``audit``: ``energy_*.E`` [J] integrate the powers of POWERS. ``model_error`` [1]: see SupplyModel.
    """

    law: PumpLaw = "feed-forward"
    accumulator: bool = True
    audit: bool = False
    known: Demand | None = None
    supply = HydraulicPort()
    tank = HydraulicPort()
    fluid: Fluid = Fluid()
    q_command: Real = real_input("m^3/s", default=0.0, nominal=1e-4, description="flow that is asked for")
    w_command: Real = real_input("rad/s", default=100.0, nominal=500.0, display="rpm")
    V_command: Real = real_input("V", default=10.0, nominal=40.0)
    Q_req: Real = parameter("m^3/s", default=1.25 * GPM, min=0.0, display="gpm", description="pump sizing")
    N_0: Real = parameter("rad/s", default=5000 * 2 * pi / 60, min=0.0, display="rpm", description="assumed")
    eta_v: Real = parameter("1", default=0.85, min=0.0, max=1.0, description="Table 6")
    rho_gear: Real = parameter("kg/m^3", default=7750.0, min=0.0, description="of the pump's gears: steel")
    p_relief: Real = parameter("Pa", default=140e5, min=0.0, display="bar", description="cracking pressure")
    P_des: Real = parameter("Pa", default=135e5, min=0.0, display="bar", description="pressure to keep")
    V_gas: Real = parameter("m^3", default=10e-6, min=0.0, description="accumulator: gas at precharge")
    p_pre: Real = parameter("Pa", default=84e5, min=0.0, display="bar", description="accumulator: precharge")
    V_manifold: Real = parameter("m^3", default=4.83e-6, min=0.0, description="Table 9")
    b_tank: Real = parameter(
        "N*s/m", default=1e3, min=0.0, description="damping of the reservoir's piston; assumed"
    )
    p_tank: Real = parameter("Pa", default=3e5, min=0.0, display="bar", description="reservoir at the start")

    horizon: Real = parameter("s", default=0.3, min=0.0, description="how far the plan is used")
    model_error: Real = parameter(
        "1",
        default=0.0,
        min=-0.9,
        description="by which the controller takes the pump to be larger than it is",
    )

    def build(self) -> None:
        check_choice(self, "law", PumpLaw)
        size = pump_scaling(self.Q_req, self.N_0, eta_v=self.eta_v, rho_gear=self.rho_gear)
        self.drive = BatteryDrive()
        w = self.N_0 if self.law == "constant speed" else 0.2 * self.N_0  # standing takes no more than leaks
        self.motor = BrushlessMotor(phi=start(0.0, fixed=True), w=start(w), I=start(30.0))
        self.pump = GearPump(D=size.D, J=size.J)
        self.manifold = self._manifold()
        self.relief = ReliefValve(p_c=self.p_relief)
        self.filter = Filter(p_s=start(self.P_des))
        self.reservoir = GasReservoir(
            b=self.b_tank, v=start(0.0, fixed=True), p=start(self.p_tank, fixed=True)
        )
        self.control = self._control()
        self.pressure, self.speed = PressureSensor(), SpeedSensor()
        if self.audit:
            for name in POWERS:
                setattr(self, f"energy_{name}", EnergyMeter.of(1)())

    def _manifold(self) -> Volume | Accumulator:
        p = start(self.P_des)
        if not self.accumulator:
            return Volume(fluid=self.fluid, V=self.V_manifold, p=p)
        return Accumulator(fluid=self.fluid, V_0=self.V_gas, p_pre=self.p_pre, V_dead=self.V_manifold, p=p)

    def _model(self) -> SupplyModel:
        """Return what the controller believes: the true data but for the pump's size, which ``model_error`` adds to."""
        motor, pump, manifold, drive = self.motor, self.pump, self.manifold, self.drive
        gas = isinstance(manifold, Accumulator)
        return SupplyModel(
            K_T=motor.K_T,
            K_e=motor.K_e,
            R_LL=motor.R_LL,
            I_max=motor.I_max,
            k_P=1 / LINE_TO_LINE,
            b=motor.b_m + pump.b_p,
            J=motor.J + pump.J,
            c_L=(1 + self.model_error) * pump.c_L,
            R_G=pump.R_G,
            RR_G=pump.RR_G,
            V_manifold=self.V_manifold,
            beta=self.fluid.beta,
            V_gas=self.V_gas if gas else 0.0,
            p_pre=self.p_pre,
            n=manifold.n if isinstance(manifold, Accumulator) else 1.4,
            p_relief=self.p_relief,
            V_oc=drive.V_oc,
            R_i=drive.R_i,
        )

    def _control(self) -> PumpControl:
        believed = self._model()
        given: dict[str, Any] = {"believed": believed, "P_des": self.P_des, "horizon": self.horizon}
        if self.law == "constant speed":
            return ConstantSpeed(w_0=self.N_0, **given)
        if self.law in CONTROLS:
            return CONTROLS[self.law](**given)
        if (self.law == "clairvoyant") != (self.known is not None):
            raise DeclarationError(
                "the clairvoyant control of the pump, and no other, is given the demand that it knows",
                remedy="record one by Demand.of(solution), and give it as `known`",
            )
        return PredictiveControl(free_pressure=self.law == "predictive pressure", known=self.known, **given)

    def equations(self) -> Equations:
        tank, control = self.reservoir.port, self.control
        yield connect(self.motor.flange, self.pump.flange)
        yield connect(self.motor.flange, self.speed.flange)
        yield connect(tank, self.pump.port_a)
        yield connect(self.pump.port_b, self.manifold.port)
        yield connect(self.manifold.port, self.relief.port_a)
        yield connect(self.relief.port_b, tank)
        yield connect(self.manifold.port, self.filter.port_a)
        yield connect(self.manifold.port, self.pressure.port)
        yield connect(self.filter.port_b, self.supply)
        yield connect(tank, self.tank)
        yield connect(self.speed.w, control.w)
        yield connect(self.pressure.p, control.p)
        yield connect(self.q_command, control.q_command)
        if isinstance(control, GivenSpeed):
            yield connect(self.w_command, control.command)
        if isinstance(control, GivenVoltage):
            yield connect(self.V_command, control.command)
        yield connect(control.V, self.drive.V_command)
        yield connect(self.drive.V, self.motor.V)
        yield connect(self.motor.P_el, self.drive.P_el)
        if self.audit:
            for name, (part, signal) in POWERS.items():
                meter = getattr(self, f"energy_{name}")
                yield connect(getattr(getattr(self, part), signal), meter.inputs()[0])

    def initial_equations(self) -> Equations:
        yield der(self.motor.w) == 0
        if isinstance(self.control, GivenSpeed | GivenVoltage):  # that need not be in balance with the load
            yield self.manifold.p == self.P_des
        else:
            yield der(self.manifold.p) == 0
        yield der(self.reservoir.v) == 0
        if isinstance(self.control, PressureControl):
            yield der(self.control.x) == 0
