"""Components of Hopsan's default library, and what of our library stands for each.

Names, parameters and defaults are facts of Hopsan (Linkoping University, Apache-2.0).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from arthur_acausal.components import blocks, rotational, translational
from arthur_acausal.components.hydraulic import (
    ControlledFlowSource,
    FlowSource,
    LinearResistance,
    LoadSensingValve,
    OpenCentreValve,
    PressureSensor,
    Valve22,
    Valve33,
    Valve43,
)
from arthur_acausal.components.translational import LoadForce
from arthur_acausal.models.conformance import hopsan_makers as make
from arthur_acausal.models.conformance import hopsan_valves as valves
from arthur_acausal.models.conformance.hopsan_given import Given
from arthur_acausal.models.conformance.hopsan_parts import (
    LoadTorque,
    RodOfCylinder,
)


@dataclass(frozen=True)
class Counterpart:
    """What stands for a type.

    Attributes
    ----------
    make : makes it.
    ports : its ports -> our connectors.
    signals : its input and output variables -> our inputs and outputs.
    stores : whether it is of Hopsan's C type, which takes in what the node's flow says (Q types give it).
    """

    make: valves.Make
    ports: Mapping[str, str] = field(default_factory=dict)
    signals: Mapping[str, str] = field(default_factory=dict)
    stores: bool = False


TWO = {"P1": "port_a", "P2": "port_b"}
SOURCE = {"out": "y", "y": "y"}
SISO = {"in": "u", "out": "y"}
TWO_IN = {"in1": "u1", "in2": "u2", "out": "y"}


SPOOL = {"in": "command", "xv": "x"}
P_A = {"PP": "port_p", "PA": "port_a"}
P_A_T = P_A | {"PT": "port_t"}
P_A_B_T = P_A_T | {"PB": "port_b"}
CENTRE = P_A_B_T | {"PC1": "port_c1", "PC2": "port_c2"}

SCALES: dict[str, Callable[[Given], float]] = {
    kind: lambda g: 1 / g("x_vmax", 0.01)
    for kind in (
        "Hydraulic22Valve",
        "Hydraulic33Valve",
        "Hydraulic43Valve",
        "Hydraulic43LoadSensingValve",
        "HydraulicOpenCenterValve",
    )
}
"""Types whose input ``in`` is a position [m], ours a share of the stroke: the factor between them."""

_HYDRAULIC: dict[str, Counterpart] = {
    "HydraulicVolume": Counterpart(make.line_volume, TWO, stores=True),
    "HydraulicVolumeMultiPort": Counterpart(make.volume, {"P1": "port"}, stores=True),
    "HydraulicTLMlossless": Counterpart(make.lossless_line, TWO, stores=True),
    "HydraulicHose": Counterpart(make.hose, TWO, stores=True),
    "HydraulicPressureSourceC": Counterpart(
        make.pressure_source,
        {"P1": "port"},
        {"p": "p"},
        stores=True,
    ),
    "HydraulicPressureSourceQ": Counterpart(make.pressure_source, {"P1": "port"}, {"p": "p"}),
    "HydraulicTankC": Counterpart(
        make.pressure_source,
        {"P1": "port"},
        {"p": "p"},
        stores=True,
    ),
    "HydraulicFlowSourceQ": Counterpart(
        lambda g: ControlledFlowSource(q=g("q", 1e-3), fluid=g.fluid), {"P1": "port"}, {"q": "q"}
    ),
    "HydraulicPlugQ": Counterpart(lambda g: FlowSource(q=0.0, fluid=g.fluid), {"P1": "port"}),
    "HydraulicLaminarOrifice": Counterpart(
        lambda g: LinearResistance(R=1 / g("Kc", 1e-11), fluid=g.fluid), TWO
    ),
    "HydraulicTurbulentOrifice": Counterpart(make.orifice, TWO, {"A": "opening"}),
    "HydraulicCheckValve": Counterpart(valves.check_valve, TWO),
    "HydraulicCheckValvePreLoaded": Counterpart(valves.check_valve, TWO),
    "HydraulicPilotControlledCheckValve": Counterpart(valves.pilot_check_valve, TWO | {"P_PILOT": "port_x"}),
    "Hydraulic22DirectionalCheckValve": Counterpart(valves.switched_check_valve, TWO, {"in": "hold"}),
    "HydraulicFixedDisplacementPump": Counterpart(
        make.pump("n_p", 250.0, "C_lp"), TWO, {"n_p": "w", "eps": "setting"}
    ),
    "HydraulicVariableDisplacementPump": Counterpart(
        make.pump("omega_p", 50.0, "K_cp"), TWO, {"omega_p": "w", "eps": "setting"}
    ),
    "HydraulicFixedDisplacementMotorQ": Counterpart(make.motor, TWO | {"P3": "flange"}),
    "HydraulicVariableDisplacementMotorQ": Counterpart(
        make.motor, TWO | {"P3": "flange"}, {"eps": "setting"}
    ),
    "HydraulicMachineC": Counterpart(make.machine, TWO | {"P3": "flange"}, {"eps": "setting"}, stores=True),
    "HydraulicAckumulator": Counterpart(make.accumulator, {"P1": "port"}, {"Va": "V_g", "pa": "p"}),
    "HydraulicCylinderC": Counterpart(
        lambda g: RodOfCylinder(cylinder=make.chambers(g, 1, 2), fluid=g.fluid),
        TWO | {"P3": "flange"},
        stores=True,
    ),
    "HydraulicFourChamberPiston": Counterpart(
        make.four_chambers, TWO | {"P3": "port_c", "P4": "port_d", "P5": "flange"}, stores=True
    ),
    "HydraulicCylinderQ": Counterpart(make.loaded_piston, TWO | {"P3": "flange"}),
    "HydraulicPistonMload": Counterpart(make.loaded_piston, TWO | {"Pmp": "flange"}),
    "Hydraulic22Valve": Counterpart(valves.valve(Valve22, one_sided=True), P_A, SPOOL),
    "Hydraulic22DirectionalValve": Counterpart(
        valves.valve(Valve22, switched=True), {"P1": "port_p", "P2": "port_a"}, SPOOL
    ),
    "Hydraulic32DirectionalValve": Counterpart(valves.valve(Valve33, switched=True), P_A_T, SPOOL),
    "Hydraulic33Valve": Counterpart(valves.valve(Valve33), P_A_T, SPOOL),
    "Hydraulic42DirectionalValve": Counterpart(valves.valve(Valve43, switched=True), P_A_B_T, SPOOL),
    "Hydraulic43Valve": Counterpart(valves.valve(Valve43), P_A_B_T, SPOOL),
    "Hydraulic43LoadSensingValve": Counterpart(
        valves.valve(LoadSensingValve), P_A_B_T | {"PL": "port_l"}, SPOOL
    ),
    "HydraulicOpenCenterValve": Counterpart(valves.valve(OpenCentreValve), CENTRE, SPOOL),
    "HydraulicPressureSensor": Counterpart(
        lambda g: PressureSensor(fluid=g.fluid), {"P1": "port"}, {"out": "p"}
    ),
}
_HYDRAULIC["HydraulicMultiTankC"] = _HYDRAULIC["HydraulicTankC"]
_HYDRAULIC["HydraulicMultiPressureSourceC"] = _HYDRAULIC["HydraulicPressureSourceC"]

_MECHANIC: dict[str, Counterpart] = {
    "MechanicTranslationalMass": Counterpart(make.mass, {"P1": "back", "P2": "flange"}),
    "MechanicTranslationalSpring": Counterpart(
        make.spring, {"P1": "flange_a", "P2": "flange_b"}, stores=True
    ),
    "MechanicForceTransformer": Counterpart(
        lambda g: LoadForce(F=g("F", 0.0)), {"P1": "flange"}, {"F": "F"}, stores=True
    ),
    "MechanicFixedPosition": Counterpart(
        lambda g: translational.Fixed(s0=g.start("Pm1", "Position")), {"Pm1": "flange"}
    ),
    "MechanicVelocityTransformer": Counterpart(
        lambda g: translational.SpeedSource(v=g("v", 0.0)), {"Pm1": "flange"}, {"v": "v"}
    ),
    "MechanicPositionSensor": Counterpart(
        lambda g: translational.PositionSensor(), {"P1": "flange"}, {"out": "s"}
    ),
    "MechanicSpeedSensor": Counterpart(lambda g: translational.SpeedSensor(), {"P1": "flange"}, {"out": "v"}),
    "MechanicRotationalInertia": Counterpart(make.inertia, {"P1": "back", "P2": "flange"}),
    "MechanicTorqueTransformer": Counterpart(
        lambda g: LoadTorque(T=g("T", 0.0)), {"P1": "flange"}, {"T": "T"}, stores=True
    ),
    "MechanicAngleSensor": Counterpart(lambda g: rotational.AngleSensor(), {"P1": "flange"}, {"out": "phi"}),
    "MechanicAngularVelocitySensor": Counterpart(
        lambda g: rotational.SpeedSensor(), {"P1": "flange"}, {"out": "w"}
    ),
    "MechanicAngularVelocityTransformer": Counterpart(
        lambda g: rotational.SpeedSource(w=g("omega", 0.0)), {"out": "flange"}, {"omega": "w"}
    ),
}

_SIGNAL: dict[str, Counterpart] = {
    "SignalConstant": Counterpart(lambda g: blocks.Constant(k=g("y", 1.0)), signals=SOURCE),
    "SignalStep": Counterpart(
        lambda g: blocks.Step(offset=g("y_0", 0.0), height=g("y_A", 1.0), start_time=g("t_step", 1.0)),
        signals=SOURCE,
    ),
    "SignalRamp": Counterpart(make.ramp, signals=SOURCE),
    "SignalPulse": Counterpart(make.pulse, signals=SOURCE),
    "SignalPulseWave": Counterpart(
        lambda g: blocks.Pulse(
            offset=g("y_0", 0.0),
            amplitude=g("y_A", 1.0),
            start_time=g("t_start", 0.0),
            period=g("dT", 1.0),
            duty=g("D", 0.5),
        ),
        signals=SOURCE,
    ),
    "SignalSquareWave": Counterpart(
        lambda g: blocks.Pulse(  # from the base down before the start as well: an edge at most
            offset=g("y_0", 0.0) - g("y_A", 1.0),
            amplitude=2 * g("y_A", 1.0),
            start_time=g("t_start", 0.0),
            period=1 / g("f", 1.0),
        ),
        signals=SOURCE,
    ),
    "SignalSoftStep": Counterpart(make.soft_step, signals=SOURCE),
    "SignalSineWave": Counterpart(make.sine, signals=SOURCE),
    "SignalGain": Counterpart(lambda g: blocks.Gain(k=g("k", 1.0), u=g("in", 0.0)), signals=SISO),
    "SignalAdd": Counterpart(lambda g: blocks.Add(u1=g("in1", 0.0), u2=g("in2", 0.0)), signals=TWO_IN),
    "SignalSubtract": Counterpart(
        lambda g: blocks.Feedback(u1=g("in1", 0.0), u2=g("in2", 0.0)), signals=TWO_IN
    ),
    "SignalMultiply": Counterpart(
        lambda g: blocks.Product(u1=g("in1", 0.0), u2=g("in2", 0.0)), signals=TWO_IN
    ),
    "SignalIntegrator2": Counterpart(
        lambda g: blocks.Integrator(u=g("in", 0.0), y_start=g("out", 0.0)), signals=SISO
    ),
    "SignalSaturation": Counterpart(
        lambda g: blocks.Limiter(u=g("in", 0.0), y_min=g("y_lower", -1.0), y_max=g("y_upper", 1.0)),
        signals=SISO,
    ),
    "SignalAbsoluteValue": Counterpart(lambda g: blocks.Abs(u=g("in", 0.0)), signals=SISO),
}

TABLE: dict[str, Counterpart] = _HYDRAULIC | _MECHANIC | _SIGNAL
FLOW_SENSOR = "HydraulicFlowSensor"
"""Stands in series with what it is connected to, so that the reader of a case places it."""
NOTES = {
    "HydraulicVolume": "volumes between two ports have the inertance of Hopsan's one-step line",
    "HydraulicHose": "transit of hoses in whole steps, as in Hopsan",
    "HydraulicPistonMload": "no dry friction: Hopsan's equations of the piston hold none",
}
"""What of Hopsan's discretisation, or of its omissions, our counterparts follow."""
SINKS = ("SignalSink", "SignalScope")
"""Types that only show signals."""
