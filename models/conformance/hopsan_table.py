"""Components of Hopsan's default library, and what of our library stands for each.

Names, parameters and defaults are facts of Hopsan (Linkoping University, Apache-2.0).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import pi, sqrt

from arthur_acausal import Component, start
from arthur_acausal.components import blocks, rotational, translational
from arthur_acausal.components.hydraulic import (
    Accumulator,
    CentreEdge,
    CheckValve,
    ControlledFlowSource,
    ControlledPressureSource,
    Cylinder,
    FlowSource,
    HydraulicMotor,
    LinearResistance,
    MeteringEdge,
    OpenCentreValve,
    PilotCheckValve,
    Piston,
    PressureSensor,
    PressureSource,
    SpeedPump,
    Spool,
    SwitchedCheckValve,
    Valve22,
    Valve33,
    Valve43,
    VariableOrifice,
    Volume,
    WaveLine,
)
from arthur_acausal.components.translational import Damper, LoadForce, Rod, Spring, StoppedMass
from arthur_acausal.models.conformance.hopsan_given import RHO, Given
from arthur_acausal.models.conformance.hopsan_parts import (
    FourChambers,
    GasAccumulator,
    Load,
    LoadedMotor,
    LoadTorque,
    LoadedPiston,
    MachineWithVolumes,
    RodOfCylinder,
    SlidingLoad,
    TwoEndedInertia,
    TwoEndedSpring,
)

Make = Callable[[Given], Component]
SMALL = 1.0
"""Pressure drop [Pa] below which orifices are laminar: in Hopsan they are turbulent throughout."""


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

    make: Make
    ports: Mapping[str, str] = field(default_factory=dict)
    signals: Mapping[str, str] = field(default_factory=dict)
    stores: bool = False


TWO = {"P1": "port_a", "P2": "port_b"}
SOURCE = {"out": "y", "y": "y"}
SISO = {"in": "u", "out": "y"}
TWO_IN = {"in1": "u1", "in2": "u2", "out": "y"}


def _volume(g: Given) -> Volume:
    V = g.volume(g("V", 1e-3), g("Beta_e", 1e9))
    return Volume(V=V, p=start(g.start("P1", "Pressure", 1e5), fixed=False), fluid=g.fluid)


def _pressure_source(g: Given) -> Component:
    """Return a source: of a parameter where no signal is connected, so that its pressure is known to be constant."""
    source = ControlledPressureSource if "p" in g.driven else PressureSource
    return source(p=g("p", 1e5), fluid=g.fluid)


def _orifice(g: Given) -> VariableOrifice:
    C_d = g.discharge(g("C_q", 0.67), g("rho", 890.0))
    return VariableOrifice(area=1.0, opening=abs(g("A", 1e-5)), C_d=C_d, dp_small=SMALL, fluid=g.fluid)


def _area(gain: float) -> float:
    """Return the area [m^2] that has the flow coefficient ``gain`` [m^3/(s Pa^0.5)] with C_d = 1."""
    return gain / sqrt(2 / RHO)


def _check_valve(g: Given) -> CheckValve:
    crack = g("p_f", g("F_s", 0.0))
    return CheckValve(
        A_max=_area(g("K_s", 5e-7)),
        C_d=1.0,
        dp_crack=crack,
        dp_open=crack + SMALL,
        dp_small=SMALL,
        fluid=g.fluid,
    )


def _pilot_check_valve(g: Given) -> PilotCheckValve:
    crack = g("p_f", 1e5)
    return PilotCheckValve(
        A_max=_area(g("K_s", 5e-7)),
        C_d=1.0,
        dp_crack=crack,
        dp_open=crack + SMALL,
        ratio=g("phi", 3.5),
        dp_small=SMALL,
        fluid=g.fluid,
    )


def _switched_check_valve(g: Given) -> SwitchedCheckValve:
    crack = g("F_s", 0.0)
    return SwitchedCheckValve(
        A_max=_area(g("Kv_check", 5e-7)),
        A_held=_area(g("Kv_open", 5e-7)),
        C_d=1.0,
        dp_crack=crack,
        dp_open=crack + SMALL,
        dp_small=SMALL,
        hold=g("in", 0.0),
        fluid=g.fluid,
    )


def _hose(g: Given) -> WaveLine:
    """Return a line whose transit takes whole steps, and whose impedance is Hopsan's for a transit of half one more."""
    L, d, rho = g("l", 1.0), g("d", 0.03), g("rho", 870.0)
    a = sqrt(g("beta_e", 1e9) / rho)
    steps = L / a / g.step + 0.5
    per_viscosity = 128 * L / (pi * d**4)
    return WaveLine(
        n=max(int(steps), 1),
        T=max(int(steps), 1) * g.step,
        Z_c=rho * a / (pi * d**2 / 4) * steps * g.step / (L / a),
        friction=True,
        R=g("eta", 0.03) * per_viscosity,
        wall=g("eta_w", 0.03) > 0,
        R_wall=g("eta_w", 0.03) * per_viscosity,
        p_start=g.start("P1", "Pressure"),
        q_start=g.start("P1", "Flow"),
        fluid=g.fluid,
    )


def _lossless_line(g: Given) -> WaveLine:
    T = max(g("deltat", 0.1), g.step)
    return WaveLine(
        n=max(round(T / g.step), 1),
        T=T,
        Z_c=g("Z_c", 1e9),
        p_start=g.start("P1", "Pressure", 1e5),
        q_start=g.start("P1", "Flow"),
        fluid=g.fluid,
    )


def _accumulator(g: Given) -> GasAccumulator:
    gas = Accumulator(V_0=g("V0", 1e-3), p_pre=g("p0", 1e7), n=g("kappa", 1.2), V_dead=1e-4 * g("V0", 1e-3))
    return GasAccumulator(inlet=LinearResistance(R=1 / g("Kca", 1e-8)), accumulator=gas, fluid=g.fluid)


def _pump(speed: str, rpm: float, leakage: str) -> Make:
    def make(g: Given) -> SpeedPump:
        return SpeedPump(
            D=g("D_p", 5e-5), G_leak=g(leakage, 0.0), w=g(speed, rpm), setting=g("eps", 1.0), fluid=g.fluid
        )

    return make


def _motor(g: Given) -> LoadedMotor:
    motor = HydraulicMotor(D=g("D_m", 5e-5), G_leak=g("C_lm", g("C_im", 1e-12)), b=g("B_m", 0.0))
    inertia = rotational.Inertia(
        J=g("J_m", 0.1),
        phi=start(g.start("P3", "Angle"), fixed=True),
        w=start(g.start("P3", "AngularVelocity"), fixed=True),
    )
    return LoadedMotor(motor=motor, inertia=inertia, setting=g("eps", 1.0), fluid=g.fluid)


def _machine(g: Given) -> MachineWithVolumes:
    V_a, V_b = (
        Volume(V=g.volume(g(f"V_{k}", 5e-3), g("Beta_e", 1e9)), p=g.start(f"P{k}", "Pressure", 1e5))
        for k in (1, 2)
    )
    motor = HydraulicMotor(D=g("D_m", 5e-5), G_leak=g("C_lm", 1e-12), b=g("B_m", 0.0))
    return MachineWithVolumes(motor=motor, volume_a=V_a, volume_b=V_b, setting=g("eps", 1.0), fluid=g.fluid)


def _stopped(g: Given, m: float, port: str, low: float, high: float) -> StoppedMass:
    return StoppedMass(
        m=m,
        s_min=low,
        s_max=high,
        s=start(g.start(port, "Position"), fixed=True),
        v=start(g.start(port, "Velocity"), fixed=True),
    )


def _mass(g: Given) -> SlidingLoad:
    return SlidingLoad(
        mass=_stopped(g, g("m", 100.0), "P2", g("x_min", 0.0), g("x_max", 1.0)),
        damper=Damper(d=g("B", 10.0)),
        spring=Spring(c=g("k", 0.0)),
        rod=Rod(L=g.start("P1", "Position") + g.start("P2", "Position")),
    )


def _loaded_piston(g: Given) -> LoadedPiston:
    """Return the piston with its load; Hopsan's equations hold no dry friction, though there is a parameter."""
    own = g.type == "HydraulicPistonMload"
    port = "Pmp" if own else "P3"
    low, high = (g("xmin", 0.0), g("xmax", 0.5)) if own else (0.0, g("s_l", 0.01))
    default = 1e-3 if own else 1e-4
    load = Load(
        mass=_stopped(g, g("mL", 1000.0) if own else g("m_l", 0.05), port, low, high),
        damper=Damper(d=g("bp", 0.0) + g("bL", 0.0) if own else g("B_p", 0.0) + g("B_l", 0.0)),
        spring=Spring(c=0.0 if own else g("k_l", 100.0)),
    )
    piston = Piston(A_a=g("A1", g("A_1", default)), A_b=g("A2", g("A_2", default)), G_leak=g("Cip", 0.0))
    return LoadedPiston(piston=piston, load=load, fluid=g.fluid)


def _chambers(g: Given, a: int, b: int) -> Cylinder:
    scale = g.volume(1.0, g("Beta_e", 1e9))
    return Cylinder(
        inertia=False,
        A_A=g(f"A_{a}", 1e-3),
        A_B=g(f"A_{b}", 1e-3),
        V_A0=g(f"V_{a}", 3e-4) * scale,
        V_B0=g(f"V_{b}", 3e-4) * scale,
        y_min=0.0,
        y_max=g("s_l", 1.0),
        c=g("B_p", 1000.0) if a == 1 else 0.0,
        eta=1.0,
        G_leak=g("c_leak", 1e-11) if g.type == "HydraulicCylinderC" else 0.0,
        p_A=g.start(f"P{a}", "Pressure", 1e5),
        p_B=g.start(f"P{b}", "Pressure", 1e5),
    )


def _four_chambers(g: Given) -> FourChambers:
    pairs = {(0, 1): 1e-11, (0, 2): 0.0, (0, 3): 1e-11, (1, 2): 0.0, (1, 3): 0.0, (2, 3): 1e-11}
    leaks = ((i, j, g(f"c_leak{i + 1}{j + 1}", default)) for (i, j), default in pairs.items())
    return FourChambers(
        cylinder=_chambers(g, 1, 2),
        second=_chambers(g, 3, 4),
        leaks=tuple(leak for leak in leaks if leak[2] > 0),
        fluid=g.fluid,
    )


def _spool(g: Given, *, one_sided: bool = False, switched: bool = False) -> Spool:
    x_max = g("x_vmax", 0.01)
    return Spool(
        switched=switched,
        x_max=x_max,
        x_min=0.0 if one_sided or switched else -x_max,
        omega=g("omega_h", 100.0),
        zeta=g("delta_h", 1.0),
        position=start(min(max(g("xv", 0.0), -x_max), x_max), fixed=True),
    )


def _edge(g: Given, which: str, overlap: float | None = None) -> dict[str, float]:
    """Return the parameters of a metering edge; without ``overlap`` that of the case."""
    return {
        "width": g(f"f_{which}", g("f", 1.0)) * pi * g("d", 0.01),
        "overlap": g(f"x_{which}", -1e-6) if overlap is None else overlap,
        "C_d": g.discharge(g("C_q", 0.67), g("rho", 890.0)),
        "dp_small": SMALL,
    }


def _valve(kind: type[Valve22], *, one_sided: bool = False, switched: bool = False) -> Make:
    """Return what makes a spool valve: an on-off valve's second position is the other end of the stroke."""

    def make(g: Given) -> Valve22:
        x_max = g("x_vmax", 0.01)
        opens = 0.0 if one_sided or switched else None
        closes = -x_max if switched else None
        parts: dict[str, Component] = {"edge_pa": MeteringEdge(**_edge(g, "pa", opens))}
        if issubclass(kind, Valve33):
            parts["edge_at"] = MeteringEdge(**_edge(g, "at", closes))
        if issubclass(kind, Valve43):
            parts["edge_pb"] = MeteringEdge(**_edge(g, "pb", closes))
            parts["edge_bt"] = MeteringEdge(**_edge(g, "bt", opens))
        if issubclass(kind, OpenCentreValve):
            parts["edge_cc"] = CentreEdge(x_max=x_max, **_edge(g, "cc"))
        command = g("in", 0.0) if switched else g("in", 0.0) / x_max
        spool = _spool(g, one_sided=one_sided, switched=switched)
        return kind(spool=spool, command=command, fluid=g.fluid, **parts)

    return make


def _spring(g: Given) -> Component:
    return TwoEndedSpring(spring=Spring(c=g("k", 100.0)))


def _inertia(g: Given) -> TwoEndedInertia:
    inertia = rotational.Inertia(
        J=g("J", 0.1),
        phi=start(g.start("P2", "Angle"), fixed=True),
        w=start(g.start("P2", "AngularVelocity"), fixed=True),
    )
    return TwoEndedInertia(inertia=inertia, damper=rotational.Damper(d=g("B", 10.0)))


def _pulse(g: Given) -> blocks.TimeTable:
    low, high, begin, end = g("y_0", 0.0), g("y_0", 0.0) + g("y_A", 1.0), g("t_start", 1.0), g("t_end", 2.0)
    edge = 1e-6 * (end - begin)
    times = (begin - edge, begin, end, end + edge)
    return blocks.TimeTable(times=times, values=(low, high, high, low), events=True)


def _ramp(g: Given) -> blocks.Ramp:
    begin, end = g("t_start", 1.0), g("t_end", 2.0)
    return blocks.Ramp(offset=g("y_0", 0.0), height=g("y_A", 1.0), start_time=begin, duration=end - begin)


def _sine(g: Given) -> blocks.Sine:
    offset, amplitude = g("y_offset", g("y_0", 0.0)), g("y_A", 1.0)
    return blocks.Sine(f=g("f", 1.0), amplitude=amplitude, offset=offset, start_time=g("t_start", 0.0))


SPOOL = {"in": "command", "xv": "x"}
P_A = {"PP": "port_p", "PA": "port_a"}
P_A_T = P_A | {"PT": "port_t"}
P_A_B_T = P_A_T | {"PB": "port_b"}
CENTRE = P_A_B_T | {"PC1": "port_c1", "PC2": "port_c2"}

SCALES: dict[str, Callable[[Given], float]] = {
    kind: lambda g: 1 / g("x_vmax", 0.01)
    for kind in ("Hydraulic22Valve", "Hydraulic33Valve", "Hydraulic43Valve", "HydraulicOpenCenterValve")
}
"""Types whose input ``in`` is a position [m], ours a share of the stroke: the factor between them."""

_HYDRAULIC: dict[str, Counterpart] = {
    "HydraulicVolume": Counterpart(_volume, {"P1": "port", "P2": "port"}, stores=True),
    "HydraulicVolumeMultiPort": Counterpart(_volume, {"P1": "port"}, stores=True),
    "HydraulicTLMlossless": Counterpart(_lossless_line, TWO, stores=True),
    "HydraulicHose": Counterpart(_hose, TWO, stores=True),
    "HydraulicPressureSourceC": Counterpart(
        _pressure_source,
        {"P1": "port"},
        {"p": "p"},
        stores=True,
    ),
    "HydraulicPressureSourceQ": Counterpart(_pressure_source, {"P1": "port"}, {"p": "p"}),
    "HydraulicTankC": Counterpart(
        _pressure_source,
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
    "HydraulicTurbulentOrifice": Counterpart(_orifice, TWO, {"A": "opening"}),
    "HydraulicCheckValve": Counterpart(_check_valve, TWO),
    "HydraulicCheckValvePreLoaded": Counterpart(_check_valve, TWO),
    "HydraulicPilotControlledCheckValve": Counterpart(_pilot_check_valve, TWO | {"P_PILOT": "port_x"}),
    "Hydraulic22DirectionalCheckValve": Counterpart(_switched_check_valve, TWO, {"in": "hold"}),
    "HydraulicFixedDisplacementPump": Counterpart(
        _pump("n_p", 250.0, "C_lp"), TWO, {"n_p": "w", "eps": "setting"}
    ),
    "HydraulicVariableDisplacementPump": Counterpart(
        _pump("omega_p", 50.0, "K_cp"), TWO, {"omega_p": "w", "eps": "setting"}
    ),
    "HydraulicFixedDisplacementMotorQ": Counterpart(_motor, TWO | {"P3": "flange"}),
    "HydraulicVariableDisplacementMotorQ": Counterpart(_motor, TWO | {"P3": "flange"}, {"eps": "setting"}),
    "HydraulicMachineC": Counterpart(_machine, TWO | {"P3": "flange"}, {"eps": "setting"}, stores=True),
    "HydraulicAckumulator": Counterpart(_accumulator, {"P1": "port"}, {"Va": "V_g", "pa": "p"}),
    "HydraulicCylinderC": Counterpart(
        lambda g: RodOfCylinder(cylinder=_chambers(g, 1, 2), fluid=g.fluid),
        TWO | {"P3": "flange"},
        stores=True,
    ),
    "HydraulicFourChamberPiston": Counterpart(
        _four_chambers, TWO | {"P3": "port_c", "P4": "port_d", "P5": "flange"}, stores=True
    ),
    "HydraulicCylinderQ": Counterpart(_loaded_piston, TWO | {"P3": "flange"}),
    "HydraulicPistonMload": Counterpart(_loaded_piston, TWO | {"Pmp": "flange"}),
    "Hydraulic22Valve": Counterpart(_valve(Valve22, one_sided=True), P_A, SPOOL),
    "Hydraulic22DirectionalValve": Counterpart(
        _valve(Valve22, switched=True), {"P1": "port_p", "P2": "port_a"}, SPOOL
    ),
    "Hydraulic32DirectionalValve": Counterpart(_valve(Valve33, switched=True), P_A_T, SPOOL),
    "Hydraulic33Valve": Counterpart(_valve(Valve33), P_A_T, SPOOL),
    "Hydraulic42DirectionalValve": Counterpart(_valve(Valve43, switched=True), P_A_B_T, SPOOL),
    "Hydraulic43Valve": Counterpart(_valve(Valve43), P_A_B_T, SPOOL),
    "HydraulicOpenCenterValve": Counterpart(_valve(OpenCentreValve), CENTRE, SPOOL),
    "HydraulicPressureSensor": Counterpart(
        lambda g: PressureSensor(fluid=g.fluid), {"P1": "port"}, {"out": "p"}
    ),
}
_HYDRAULIC["HydraulicMultiTankC"] = _HYDRAULIC["HydraulicTankC"]
_HYDRAULIC["HydraulicMultiPressureSourceC"] = _HYDRAULIC["HydraulicPressureSourceC"]

_MECHANIC: dict[str, Counterpart] = {
    "MechanicTranslationalMass": Counterpart(_mass, {"P1": "back", "P2": "flange"}),
    "MechanicTranslationalSpring": Counterpart(_spring, {"P1": "flange_a", "P2": "flange_b"}, stores=True),
    "MechanicForceTransformer": Counterpart(
        lambda g: LoadForce(F=g("F", 0.0)), {"P1": "flange"}, {"F": "F"}, stores=True
    ),
    "MechanicFixedPosition": Counterpart(
        lambda g: translational.Fixed(s0=g.start("P1", "Position")), {"P1": "flange"}
    ),
    "MechanicPositionSensor": Counterpart(
        lambda g: translational.PositionSensor(), {"P1": "flange"}, {"out": "s"}
    ),
    "MechanicSpeedSensor": Counterpart(lambda g: translational.SpeedSensor(), {"P1": "flange"}, {"out": "v"}),
    "MechanicRotationalInertia": Counterpart(_inertia, {"P1": "back", "P2": "flange"}),
    "MechanicTorqueTransformer": Counterpart(
        lambda g: LoadTorque(T=g("T", 0.0)), {"P1": "flange"}, {"T": "T"}, stores=True
    ),
    "MechanicAngleSensor": Counterpart(lambda g: rotational.AngleSensor(), {"P1": "flange"}, {"out": "phi"}),
    "MechanicAngularVelocitySensor": Counterpart(
        lambda g: rotational.SpeedSensor(), {"P1": "flange"}, {"out": "w"}
    ),
    "MechanicAngularVelocityTransformer": Counterpart(
        lambda g: rotational.SpeedSource(w=g("omega", 0.0)), {"P1": "flange"}, {"omega": "w"}
    ),
}

_SIGNAL: dict[str, Counterpart] = {
    "SignalConstant": Counterpart(lambda g: blocks.Constant(k=g("y", 1.0)), signals=SOURCE),
    "SignalStep": Counterpart(
        lambda g: blocks.Step(offset=g("y_0", 0.0), height=g("y_A", 1.0), start_time=g("t_step", 1.0)),
        signals=SOURCE,
    ),
    "SignalRamp": Counterpart(_ramp, signals=SOURCE),
    "SignalPulse": Counterpart(_pulse, signals=SOURCE),
    "SignalSineWave": Counterpart(_sine, signals=SOURCE),
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
        lambda g: blocks.Limiter(u=g("in", 0.0), y_min=g("y_limlow", -1.0), y_max=g("y_limup", 1.0)),
        signals=SISO,
    ),
    "SignalAbsoluteValue": Counterpart(lambda g: blocks.Abs(u=g("in", 0.0)), signals=SISO),
}

TABLE: dict[str, Counterpart] = _HYDRAULIC | _MECHANIC | _SIGNAL
FLOW_SENSOR = "HydraulicFlowSensor"
"""Stands in series with what it is connected to, so that the reader of a case places it."""
SINKS = ("SignalSink", "SignalScope")
"""Types that only show signals."""
