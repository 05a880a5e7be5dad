"""A joint's actuator: servo valve, cylinder, linkage and the control of its force."""

from __future__ import annotations

from math import pi
from typing import Any, Literal

from arthur_acausal import Component, Equations, Real, connect, parameter, real_input, real_output
from arthur_acausal.components import rotational
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic import Cylinder, Fluid, HydraulicPort, PressureSensor, ServoValve
from arthur_acausal.components.hydraulic.servo_valve import Spool
from arthur_acausal.components.robotics import CylinderLinkage
from arthur_acausal.components.translational import ForceSensor, SpeedSensor
from arthur_acausal.models.arthur.force_control import LAG, BareControl, FeedForwardControl
from arthur_acausal.models.arthur.linkages import JointLinkage
from arthur_acausal.models.arthur.valves.direct import ValveKind, servo_valve

ForceLaw = Literal["feed-forward", "bare"]


class Actuator(Component):
    """A cylinder across a joint, its servo valve, and a controller that makes its force follow ``F_d`` [N].

    Ports: ``supply``, ``tank``; ``joint``, the flange that the cylinder turns. The piston's mass is not in it: it
    stands, reflected, in the joint's inertia. The pistons' stops are the limits of the joint.

    States: chamber pressures, spool position and velocity, and the controller's. It starts with a closed valve, the
    mean of the chambers' pressures being that of supply and return, and with the force that is asked for.

    Structural parameters: ``linkage_of``, the joint's linkage; ``direction``, +1 where extension increases the
    angle; ``law``, "feed-forward" or the report's "bare" PID (see FeedForwardControl, BareControl);
    ``valve_kind``: "ideal", or "rotary" or "spool", the valves of the report's case studies on their drives;
    ``start_at_demand``: False where something else decides about the force at the start, as the balance of a body.
    """

    linkage_of: JointLinkage
    direction: int = 1
    law: ForceLaw = "feed-forward"
    spool: Spool = "second order"
    valve_kind: ValveKind = "ideal"
    start_at_demand: bool = True
    supply = HydraulicPort()
    tank = HydraulicPort()
    joint = rotational.Flange()
    fluid: Fluid = Fluid()
    F_d: Real = real_input("N", default=0.0, nominal=100.0, description="force asked for, positive extends")
    q_supply: Real = real_output(
        "m^3/s", nominal=1e-5, display="L/min", description="flow asked of the supply"
    )
    P_valve: Real = real_output("W", description="power turned to heat in the valve")
    P_cylinder: Real = real_output("W", description="power turned to heat in the cylinder")
    P_work: Real = real_output("W", description="power given to the joint")
    q_rated: Real = parameter(
        "m^3/s", default=2e-3 / 60, min=0.0, display="L/min", description="of the valve"
    )
    c: Real = parameter("N*s/m", default=100.0, min=0.0, description="damping of the seals")
    G_leak: Real = parameter("m^3/(s*Pa)", default=0.0, min=0.0, description="leakage past the piston")

    def build(self) -> None:
        check_choice(self, "law", ForceLaw)
        check_choice(self, "valve_kind", ValveKind)
        size = self.linkage_of
        triangle = size.triangle(self.direction)
        self.linkage = CylinderLinkage(
            a=triangle.a, b=triangle.b, psi_0=triangle.psi_0, direction=triangle.direction, l_0=size.l_0
        )
        self.valve = servo_valve(self.valve_kind, ServoValve(spool=self.spool, q_rated=self.q_rated))
        self.cylinder = Cylinder(
            inertia=False,
            c=self.c,
            G_leak=self.G_leak,
            y_min=-size.stroke / 2,
            y_max=size.stroke / 2,
        )
        if self.law == "bare":
            self.control: BareControl | FeedForwardControl = BareControl(I_rated=self.valve.I_rated)
        else:
            self.control = FeedForwardControl(
                fluid=self.fluid,
                K_V=self.valve.K_V,
                A_A=self.cylinder.A_A,
                A_B=self.cylinder.A_B,
                I_rated=self.valve.I_rated,
                **self._lead(),
            )
        self.p_s, self.p_t = PressureSensor(), PressureSensor()
        self.p_A, self.p_B = PressureSensor(), PressureSensor()
        self.speed, self.load_cell = SpeedSensor(), ForceSensor()

    def _lead(self) -> dict[str, Any]:
        """Return the lead that makes good the spool's lag; the controller's own is that of a driven valve."""
        if not isinstance(self.valve, ServoValve):
            return {}
        lag = self.valve.zeta_spool / (pi * self.valve.f_spool)  # 2 zeta/omega
        return {"T_lead": lag if self.spool == "second order" else LAG}

    def equations(self) -> Equations:
        valve, cylinder, control = self.valve, self.cylinder, self.control
        yield connect(self.supply, valve.port_p)
        yield connect(self.tank, valve.port_t)
        yield connect(valve.port_a, cylinder.port_a)
        yield connect(valve.port_b, cylinder.port_b)
        yield connect(cylinder.flange, self.load_cell.flange_a)
        yield connect(self.load_cell.flange_b, self.linkage.rod)
        yield connect(self.linkage.joint, self.joint)
        yield connect(self.supply, self.p_s.port)
        yield connect(self.tank, self.p_t.port)
        yield connect(cylinder.port_a, self.p_A.port)
        yield connect(cylinder.port_b, self.p_B.port)
        yield connect(cylinder.flange, self.speed.flange)
        for sensor, signal in (
            (self.p_s.p, control.p_s),
            (self.p_t.p, control.p_t),
            (self.p_A.p, control.p_A),
            (self.p_B.p, control.p_B),
            (self.speed.v, control.v),
            (self.load_cell.f, control.F),
        ):
            yield connect(sensor, signal)
        yield connect(self.F_d, control.F_d)
        yield connect(control.I, valve.I)
        yield connect(control.q_supply, self.q_supply)
        yield connect(valve.P_loss, self.P_valve)
        yield connect(cylinder.P_loss, self.P_cylinder)
        yield self.P_work == self.load_cell.f * self.speed.v

    def initial_equations(self) -> Equations:
        cylinder = self.cylinder
        yield "mean pressure", cylinder.p_A + cylinder.p_B == self.supply.p + self.tank.p
        if isinstance(self.valve, ServoValve):  # a drive has its own start
            yield "valve closed", self.valve.x == 0
            yield "valve at rest", self.valve.v == 0
        yield "no integral", self.control.x == 0
        if self.start_at_demand:
            yield "force as asked", self.control.e == 0
