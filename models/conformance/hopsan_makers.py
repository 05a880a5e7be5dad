"""What stands for components of Hopsan's default library: each function makes one from what a case says of it."""

from __future__ import annotations

from math import cos, pi, sqrt

from arthur_acausal import Component, start
from arthur_acausal.components import blocks, rotational
from arthur_acausal.components.hydraulic import (
    Accumulator,
    ControlledPressureSource,
    Cylinder,
    HydraulicMotor,
    LinearResistance,
    LineSegment,
    Piston,
    PressureSource,
    SpeedPump,
    VariableOrifice,
    Volume,
    WaveLine,
)
from arthur_acausal.components.translational import Damper, Rod, Spring, StoppedMass
from arthur_acausal.models.conformance.hopsan_given import BETA, RHO, Given
from arthur_acausal.models.conformance.hopsan_parts import (
    FourChambers,
    GasAccumulator,
    LineVolume,
    Load,
    LoadedMotor,
    LoadedPiston,
    MachineWithVolumes,
    SlidingLoad,
    TwoEndedInertia,
    TwoEndedSpring,
)
from arthur_acausal.models.conformance.hopsan_valves import SMALL, Make


def volume(g: Given) -> Volume:
    V = g.volume(g("V", 1e-3), g("Beta_e", 1e9))
    return Volume(V=V, p=start(g.start("P1", "Pressure", 1e5), fixed=False), fluid=g.fluid)


def line_volume(g: Given) -> LineVolume:
    V = g.volume(g("V", 1e-3), g("Beta_e", 1e9))
    Z_c = BETA / V * g.step / (1 - g("alpha", 0.1))
    length = sqrt(Z_c * g.step * V / RHO)  # of a line of this volume with the inertance Z_c step
    halves = {
        f"half_{side}": Volume(V=V / 2, p=start(g.start(port, "Pressure", 1e5), fixed=False))
        for side, port in (("a", "P1"), ("b", "P2"))
    }
    return LineVolume(
        segment=LineSegment(L=length, d=sqrt(4 * V / length / pi), friction="none"),
        bypass=LinearResistance(R=2 * Z_c),  # damping ratio 0.5
        fluid=g.fluid,
        **halves,
    )


def pressure_source(g: Given) -> Component:
    """Return a source: of a parameter where no signal is connected, so that its pressure is known to be constant."""
    source = ControlledPressureSource if "p" in g.driven else PressureSource
    return source(p=g("p", 1e5), fluid=g.fluid)


def orifice(g: Given) -> VariableOrifice:
    C_d = g.discharge(g("C_q", 0.67), g("rho", 890.0))
    return VariableOrifice(area=1.0, opening=abs(g("A", 1e-5)), C_d=C_d, dp_small=SMALL, fluid=g.fluid)


def hose(g: Given) -> WaveLine:
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


def lossless_line(g: Given) -> WaveLine:
    T = max(g("deltat", 0.1), g.step)
    return WaveLine(
        n=max(round(T / g.step), 1),
        T=T,
        Z_c=g("Z_c", 1e9),
        p_start=g.start("P1", "Pressure", 1e5),
        q_start=g.start("P1", "Flow"),
        fluid=g.fluid,
    )


def accumulator(g: Given) -> GasAccumulator:
    gas = Accumulator(V_0=g("V0", 1e-3), p_pre=g("p0", 1e7), n=g("kappa", 1.2), V_dead=1e-4 * g("V0", 1e-3))
    return GasAccumulator(inlet=LinearResistance(R=1 / g("Kca", 1e-8)), accumulator=gas, fluid=g.fluid)


def pump(speed: str, rpm: float, leakage: str) -> Make:
    def make(g: Given) -> SpeedPump:
        return SpeedPump(
            D=g("D_p", 5e-5), G_leak=g(leakage, 0.0), w=g(speed, rpm), setting=g("eps", 1.0), fluid=g.fluid
        )

    return make


def motor(g: Given) -> LoadedMotor:
    motor = HydraulicMotor(D=g("D_m", 5e-5), G_leak=g("C_lm", g("C_im", 1e-12)), b=g("B_m", 0.0))
    inertia = rotational.Inertia(
        J=g("J_m", 0.1),
        phi=start(g.start("P3", "Angle"), fixed=True),
        w=start(g.start("P3", "AngularVelocity"), fixed=True),
    )
    return LoadedMotor(motor=motor, inertia=inertia, setting=g("eps", 1.0), fluid=g.fluid)


def machine(g: Given) -> MachineWithVolumes:
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


def mass(g: Given) -> SlidingLoad:
    return SlidingLoad(
        mass=_stopped(g, g("m", 100.0), "P2", g("x_min", 0.0), g("x_max", 1.0)),
        damper=Damper(d=g("B", 10.0)),
        spring=Spring(c=g("k", 0.0)),
        rod=Rod(L=g.start("P1", "Position") + g.start("P2", "Position")),
    )


def loaded_piston(g: Given) -> LoadedPiston:
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


def chambers(g: Given, a: int, b: int) -> Cylinder:
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


def four_chambers(g: Given) -> FourChambers:
    pairs = {(0, 1): 1e-11, (0, 2): 0.0, (0, 3): 1e-11, (1, 2): 0.0, (1, 3): 0.0, (2, 3): 1e-11}
    leaks = ((i, j, g(f"c_leak{i + 1}{j + 1}", default)) for (i, j), default in pairs.items())
    return FourChambers(
        cylinder=chambers(g, 1, 2),
        second=chambers(g, 3, 4),
        leaks=tuple(leak for leak in leaks if leak[2] > 0),
        fluid=g.fluid,
    )


def spring(g: Given) -> Component:
    return TwoEndedSpring(spring=Spring(c=g("k", 100.0)))


def inertia(g: Given) -> TwoEndedInertia:
    inertia = rotational.Inertia(
        J=g("J", 0.1),
        phi=start(g.start("P2", "Angle"), fixed=True),
        w=start(g.start("P2", "AngularVelocity"), fixed=True),
    )
    return TwoEndedInertia(inertia=inertia, damper=rotational.Damper(d=g("B", 10.0)))


def pulse(g: Given) -> blocks.TimeTable:
    low, high, begin, end = g("y_0", 0.0), g("y_0", 0.0) + g("y_A", 1.0), g("t_start", 1.0), g("t_end", 2.0)
    edge = 1e-6 * (end - begin)
    times = (begin - edge, begin, end, end + edge)
    return blocks.TimeTable(times=times, values=(low, high, high, low), events=True)


def ramp(g: Given) -> blocks.Ramp:
    begin, end = g("t_start", 1.0), g("t_end", 2.0)
    return blocks.Ramp(offset=g("y_0", 0.0), height=g("y_A", 1.0), start_time=begin, duration=end - begin)


def sine(g: Given) -> blocks.Sine:
    """Return a sine; what Hopsan names an offset is a time."""
    f = g("f", 1.0)
    return blocks.Sine(
        f=f, amplitude=g("y_A", 1.0), phase=-2 * pi * f * g("y_offset", 0.0), start_time=g("t_start", 0.0)
    )


def soft_step(g: Given) -> blocks.TimeTable:
    """Return half a cosine from one level to the other, in 100 straight pieces."""
    begin, end, low, height = g("t_start", 1.0), g("t_end", 2.0), g("y_0", 0.0), g("y_A", 1.0)
    shares = [k / 100 for k in range(101)]
    return blocks.TimeTable(
        times=tuple(begin + share * (end - begin) for share in shares),
        values=tuple(low + height * (1 - cos(pi * share)) / 2 for share in shares),
    )
