"""Hydraulic circuits with closed forms (``hyd_*``), built from the library with the parameters of a case."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

from arthur_acausal import Component, Equations, Real, connect, parameter, start
from arthur_acausal.components.hydraulic import (
    Accumulator,
    Cylinder,
    FlowSource,
    Fluid,
    Line,
    Orifice,
    PressureSource,
    Ram,
    Tank,
    Volume,
    WaveLine,
)
from arthur_acausal.components.translational import Mass, SpeedSource

ROUNDING = 1e-5
"""Share of a circuit's pressure below which its orifices are laminar: smaller than any error that is looked at."""


class Divider(Component):
    """Two orifices in series between the pressures ``p1`` and ``p2`` [Pa]."""

    first: Orifice = Orifice(area=1e-6)
    second: Orifice = Orifice(area=1e-6)
    supply: PressureSource = PressureSource(p=200e5)
    sink: PressureSource = PressureSource(p=0.0)

    def equations(self) -> Equations:
        yield connect(self.supply.port, self.first.port_a)
        yield connect(self.first.port_b, self.second.port_a)
        yield connect(self.second.port_b, self.sink.port)


class BlowDown(Component):
    """A volume that empties through an orifice into a tank without pressure."""

    volume: Volume = Volume(V=1e-3)
    orifice: Orifice = Orifice(area=1e-6)
    tank = Tank(p=0.0)

    def equations(self) -> Equations:
        yield connect(self.volume.port, self.orifice.port_a)
        yield connect(self.orifice.port_b, self.tank.port)


class TrappedVolume(Component):
    """A closed ram whose rod is pushed in."""

    ram: Ram = Ram(area=1e-3, dead_volume=1e-3)
    push: SpeedSource = SpeedSource(v=-0.01)

    def equations(self) -> Equations:
        yield connect(self.ram.rod, self.push.flange)


class Charging(Component):
    """A constant flow into an accumulator."""

    source: FlowSource = FlowSource(q=1e-5)
    accumulator: Accumulator = Accumulator(V_0=1e-3, p_pre=50e5)

    def equations(self) -> Equations:
        yield connect(self.source.port, self.accumulator.port)


class LockedCylinder(Component):
    """A double-acting cylinder with closed ports, and a mass on its rod."""

    cylinder: Cylinder = Cylinder(inertia=False)
    mass: Mass = Mass(m=50.0)

    def equations(self) -> Equations:
        yield connect(self.cylinder.flange, self.mass.flange)


class ShutCells(Component):
    """A line of ``n`` cells from a constant pressure to a shut valve."""

    n: int = 20
    source: PressureSource = PressureSource(p=50e5)
    L: Real = parameter("m")
    d: Real = parameter("m")

    def build(self) -> None:
        self.line = Line(n=self.n, L=self.L, d=self.d, friction="none")

    def equations(self) -> Equations:
        yield connect(self.source.port, self.line.port_a)


class ShutLine(Component):
    """A line in which waves travel undistorted, from a constant pressure to a shut valve."""

    source: PressureSource = PressureSource(p=50e5)
    line: WaveLine = WaveLine(T=0.1, Z_c=1e9)

    def equations(self) -> Equations:
        yield connect(self.source.port, self.line.port_a)


def divider(given: Mapping[str, float]) -> Divider:
    """Return the two orifices of ``hyd_orifice_divider``."""
    dp_small = ROUNDING * abs(given["p1"] - given["p2"])
    first, second = (Orifice(area=given[a], C_d=given["Cd"], dp_small=dp_small) for a in ("A1", "A2"))
    supply = PressureSource(p=given["p1"], fluid=Fluid(rho=given["rho"]))
    return Divider(first=first, second=second, supply=supply, sink=PressureSource(p=given["p2"]))


def blow_down(given: Mapping[str, float]) -> BlowDown:
    """Return the volume and the orifice of ``hyd_orifice_blowdown``, whose fluid keeps its density."""
    fluid = Fluid(rho=given["rho"], beta=given["beta"], constant_density=True)
    return BlowDown(
        volume=Volume(V=given["V"], p=start(given["p0"], fixed=True), fluid=fluid),
        orifice=Orifice(area=given["A"], C_d=given["Cd"], dp_small=ROUNDING * given["p0"]),
    )


def trapped_volume(given: Mapping[str, float], V_end: float) -> TrappedVolume:
    """Return the ram of ``hyd_trapped_volume``, whose volume falls to ``V_end`` [m^3] within one second."""
    ram = Ram(
        area=given["V0"],  # so that the volume is V0 (1 m + s)/m
        dead_volume=given["V0"],
        p=start(given["p0"], fixed=True),
        fluid=Fluid(beta=given["beta"]),
    )
    return TrappedVolume(ram=ram, push=SpeedSource(v=V_end / given["V0"] - 1))


def charging(given: Mapping[str, float], n: float) -> Charging:
    """Return the accumulator of ``hyd_accumulator_polytropic``, filled with V0 a second from its precharge on.

    Its fluid hardly compresses, so that the gas gives way by what flows in.
    """
    accumulator = Accumulator(
        V_0=given["V0"],
        p_pre=given["p_precharge"],
        n=n,
        p=start(given["p_precharge"], fixed=True),
        fluid=Fluid(beta=1e8 * given["p_precharge"], constant_density=True),
    )
    return Charging(source=FlowSource(q=given["V0"]), accumulator=accumulator)


def locked_cylinder(given: Mapping[str, float]) -> LockedCylinder:
    """Return the cylinder of ``hyd_cylinder_natural_frequency``, let go at ``x0`` from where it would rest.

    The chambers have V1 and V2 there; the stops are half a chamber away.
    """
    A1, A2, V1, V2, x0 = (given[name] for name in ("A1", "A2", "V1", "V2", "x0"))
    stroke = min(V1 / A1, V2 / A2) / 2
    p_rest = 10 * given["beta"] * abs(x0) * (A1 / V1 + A2 / V2)
    cylinder = Cylinder(
        inertia=False,
        A_A=A1,
        A_B=A2,
        V_A0=V1 - A1 * stroke,
        V_B0=V2 - A2 * stroke,
        y_min=-stroke,
        y_max=stroke,
        c=0.0,
        eta=1.0,
        p_A=start(p_rest - given["beta"] * A1 * x0 / V1, fixed=True),
        p_B=start(p_rest * A1 / A2 + given["beta"] * A2 * x0 / V2, fixed=True),
        fluid=Fluid(beta=given["beta"]),
    )
    mass = Mass(m=given["m"], s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    return LockedCylinder(cylinder=cylinder, mass=mass)


def shut_cells(given: Mapping[str, float], n: int, d: float = 0.05) -> ShutCells:
    """Return the line of ``hyd_water_hammer`` as ``n`` cells, ``d`` [m] wide (which does not matter)."""
    return ShutCells(n=n, L=given["L"], d=d, source=_reservoir(given))


def shut_line(given: Mapping[str, float], d: float = 0.05) -> ShutLine:
    """Return the line of ``hyd_water_hammer`` by the method of characteristics, flowing until t = 0."""
    area = pi * d**2 / 4
    line = WaveLine(
        T=given["L"] / given["a"],
        Z_c=given["rho"] * given["a"] / area,
        p_start=given["p0"],
        q_start=given["v0"] * area,
    )
    return ShutLine(source=_reservoir(given), line=line)


def _reservoir(given: Mapping[str, float]) -> PressureSource:
    fluid = Fluid(rho=given["rho"], beta=given["rho"] * given["a"] ** 2, constant_density=True)
    return PressureSource(p=given["p0"], fluid=fluid)
