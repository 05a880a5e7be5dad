"""Hydraulic circuits with solutions in closed form; each figure names its source."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, connect, start, translate
from arthur_acausal.components.hydraulic import (
    Accumulator,
    Cylinder,
    FlowSource,
    Fluid,
    Line,
    Orifice,
    PressureSource,
    Ram,
)
from arthur_acausal.components.translational import Fixed, SpeedSource
from tests.components.rigs import Discharge

PRECISE = SolverOptions(rtol=1e-10, intervals=1000)


class Divider(Component):
    """Two orifices in series between two pressures."""

    supply: PressureSource = PressureSource(p=200e5, fluid=Fluid(rho=870.0))
    first: Orifice = Orifice(area=2e-6)
    second: Orifice = Orifice(area=1e-6)
    sink: PressureSource = PressureSource(p=0.0)

    def equations(self) -> Equations:
        yield connect(self.supply.port, self.first.port_a)
        yield connect(self.first.port_b, self.second.port_a)
        yield connect(self.second.port_b, self.sink.port)


def test_two_orifices_in_series_divide_the_pressure() -> None:
    """p_mid = (A1^2 p1 + A2^2 p2)/(A1^2 + A2^2): 160 bar, q = C_d A1 sqrt(2 (p1 - p_mid)/rho)."""
    solution = translate(Divider()).simulate(1.0)
    assert solution.final("first.port_b.p") == pytest.approx(16e6, rel=1e-5)
    assert solution.final("first.q") == pytest.approx(0.00013424972441590754, rel=1e-5)


def test_a_stiff_volume_blows_down_through_an_orifice() -> None:
    """sqrt(p) = sqrt(p_0) - k t/(2 C): empty after 0.12562767579307543 s, a quarter of p_0 at half of that."""
    fluid = Fluid(rho=870.0, beta=1.5e9, constant_density=True)
    empty = 0.12562767579307543
    rig = translate(Discharge(fluid=fluid))
    solution = rig.simulate(empty, start={"volume.p": 1e7}, options=PRECISE)
    assert solution.at(empty / 2, "volume.p") == pytest.approx(2.5e6, rel=1e-4)
    assert solution.at(0.9 * empty, "volume.p") == pytest.approx(1e5, rel=1e-4)


class Trapped(Component):
    """A closed ram whose rod is pushed in."""

    ram: Ram = Ram(area=1e-3, dead_volume=1e-3, p=start(1e5, fixed=True), fluid=Fluid(beta=1.5e9))
    push = SpeedSource(v=-0.05)

    def equations(self) -> Equations:
        yield connect(self.ram.rod, self.push.flange)


@pytest.mark.parametrize(
    ("volume", "pressure"),
    [(0.99e-3, 15175503.78025226), (0.95e-3, 77039941.58132572), (0.999e-3, 1600750.500375433)],
)
def test_a_trapped_volume_is_compressed(volume: float, pressure: float) -> None:
    """p = p_0 + beta ln(V_0/V) where mass is conserved and the modulus is constant."""
    stop = (1e-3 - volume) / (1e-3 * 0.05)
    solution = translate(Trapped()).simulate(stop, options=PRECISE)
    assert solution.final("ram.p") == pytest.approx(pressure, rel=1e-7)


def period(t: np.ndarray, x: np.ndarray) -> float:
    """Mean period [s] between rising zero crossings, by linear interpolation."""
    rising = np.flatnonzero((x[:-1] < 0) & (x[1:] >= 0))
    times = [t[i] - x[i] * (t[i + 1] - t[i]) / (x[i + 1] - x[i]) for i in rising]
    return float((times[-1] - times[0]) / (len(times) - 1))


class Locked(Component):
    """A cylinder with closed ports; its piston oscillates on the oil."""

    cylinder: Cylinder = Cylinder()

    def equations(self) -> Equations:
        yield from ()


def test_a_locked_cylinder_oscillates_at_its_natural_frequency() -> None:
    """omega = sqrt(beta (A1^2/V1 + A2^2/V2)/m) = 509.378706530 rad/s, small amplitude (Merritt 1967, ch. 6)."""
    omega, amplitude = 509.37870653048174, 1e-5
    cylinder = Cylinder(
        A_A=1e-3,
        A_B=8e-4,
        y_min=-0.1,
        y_max=0.1,
        V_A0=1e-4,
        V_B0=0.7e-4,
        m=50.0,
        c=0.0,
        eta=1.0,
        y=start(0.0, fixed=True),
        v=start(amplitude * omega, fixed=True),
        p_A=start(8e5, fixed=True),
        p_B=start(10e5, fixed=True),
        fluid=Fluid(constant_density=True),
    )
    turns = 10
    options = SolverOptions(rtol=1e-9, intervals=100 * turns)
    solution = translate(Locked(cylinder=cylinder)).simulate(turns * 2 * np.pi / omega, options=options)
    measured = 2 * np.pi / period(solution.t, solution["cylinder.y"])
    assert measured == pytest.approx(omega, rel=1e-4)
    assert max(solution["cylinder.y"]) == pytest.approx(amplitude, rel=1e-3)


def test_the_report_s_actuator_rings_at_8775_rad_s_at_mid_stroke() -> None:
    """sqrt(beta (A_A^2/V_A + A_B^2/V_B)/m_p) with Table 10 and beta 1.4 GPa."""
    cylinder = Cylinder(
        c=0.0,
        eta=1.0,
        y=start(0.0, fixed=True),
        v=start(1e-3, fixed=True),
        p_A=start(3e5, fixed=True),
        p_B=start(3e5 * 7.13 / 5.35, fixed=True),
    )
    options = SolverOptions(rtol=1e-8, intervals=2000)
    solution = translate(Locked(cylinder=cylinder)).simulate(20 * 2 * np.pi / 8775, options=options)
    assert 2 * np.pi / period(solution.t, solution["cylinder.y"]) == pytest.approx(8775, rel=0.01)


class Charging(Component):
    """A small flow into an accumulator."""

    source = FlowSource(q=1e-5)
    accumulator: Accumulator = Accumulator(V_0=1e-3, p_pre=50e5)

    def equations(self) -> Equations:
        yield connect(self.source.port, self.accumulator.port)


@pytest.mark.parametrize(
    ("n", "dV", "pressure"),
    [
        (1.0, 1e-4, 5555555.555555556),
        (1.0, 3e-4, 7142857.142857142),
        (1.0, 5e-4, 1e7),
        (1.4, 1e-4, 5794693.786170182),
        (1.4, 3e-4, 8238207.912727521),
        (1.4, 5e-4, 13195079.107728941),
    ],
)
def test_an_accumulator_follows_its_polytrope(n: float, dV: float, pressure: float) -> None:
    """p = p_pre (V_0/(V_0 - dV))^n; isothermal work p_pre V_0 ln(V_0/(V_0 - dV))."""
    rig = translate(Charging())
    solution = rig.simulate(
        1e-6, parameters={"accumulator.n": n}, start={"accumulator.p": pressure}, options=PRECISE
    )
    assert 1e-3 - solution.initial("accumulator.V_g") == pytest.approx(dV, rel=1e-6)
    if n == 1.0:
        V_f = solution.initial("accumulator.V_f")
        x = pressure / 1.4e9
        in_fluid = 1.4e9 * (np.expm1(x) - x) * V_f
        work = solution.initial("accumulator.E_stored") - in_fluid
        assert work == pytest.approx(
            {1e-4: 526.8025782891317, 3e-4: 1783.374719693661, 5e-4: 3465.7359027997263}[dV], rel=1e-6
        )


def test_an_accumulator_takes_no_fluid_below_its_precharge_and_then_an_event() -> None:
    solution = translate(Charging()).simulate(60.0, start={"accumulator.p": 1e5}, options=PRECISE)
    p, V_g = solution["accumulator.p"], solution["accumulator.V_g"]
    assert np.all(V_g[p < 50e5] == 1e-3)
    events = [event for event in solution.events if event.kind == "state"]
    assert len(events) == 1
    # 1e-5 m^3/s fill V_dead = 1e-5 m^3 from 1 to 50 bar; m = rho_0 exp(p/beta) V_dead
    expected = 1e-5 * (np.exp(50e5 / 1.4e9) - np.exp(1e5 / 1.4e9)) / 1e-5
    assert events[0].time == pytest.approx(expected, rel=1e-6)
    assert p[-1] == pytest.approx(50e5 * (1e-3 / V_g[-1]) ** 1.4, rel=1e-9)


class Pipeline(Component):
    """A frictionless line from a constant pressure to a valve that is shut: port_b stays open-ended."""

    n: int = 100
    source: PressureSource = PressureSource(
        p=50e5, fluid=Fluid(rho=870.0, beta=870.0 * 1200.0**2, constant_density=True)
    )

    def build(self) -> None:
        self.line = Line(n=self.n, L=100.0, d=0.05, friction="none", volume_b=True)

    def equations(self) -> Equations:
        yield connect(self.source.port, self.line.port_a)


def test_the_first_mode_of_a_lumped_line() -> None:
    """2 (a/dx) sin(pi dx/(4 L)) with one end open (a chain of springs and masses; Wylie and Streeter 1993)."""
    n, a, L = 20, 1200.0, 100.0
    dx = L / (n - 0.5)
    theta = np.pi * dx / (2 * L)
    expected = 2 * a / dx * np.sin(theta / 2)
    rig = translate(Pipeline(n=n))
    begin = {f"line.cells[{i}].p": 50e5 + 1e4 * np.sin(theta * (i + 0.5)) for i in range(n)}
    begin |= {f"line.segments[{i}].q": 0.0 for i in range(n)}
    solution = rig.simulate(
        20 * 2 * np.pi / expected, start=begin, options=SolverOptions(rtol=1e-8, intervals=2000)
    )
    measured = 2 * np.pi / period(solution.t, solution[f"line.cells[{n - 1}].p"] - 50e5)
    assert measured == pytest.approx(expected, rel=1e-6)
    assert measured == pytest.approx(2 * np.pi * a / (4 * L), rel=1e-3)


def test_water_hammer() -> None:
    """Joukowsky (1898): rho a v_0 = 10.44 bar above for 2 L/a, then as much below; the period is 4 L/a."""
    n, v_0, dp, trip = 100, 1.0, 1044000.0, 2 * 100.0 / 1200.0
    q = v_0 * np.pi * 0.05**2 / 4
    begin = {f"line.cells[{i}].p": 50e5 for i in range(n)} | {f"line.segments[{i}].q": q for i in range(n)}
    solution = translate(Pipeline(n=n)).simulate(
        4 * trip, start=begin, options=SolverOptions(rtol=1e-6, intervals=4000)
    )
    t, p = solution.t, solution[f"line.cells[{n - 1}].p"]
    for k, sign in enumerate((1, -1, 1)):
        plateau = (t > (k + 0.2) * trip) & (t < (k + 0.8) * trip)
        assert np.mean(p[plateau]) == pytest.approx(50e5 + sign * dp, abs=0.01 * dp)
    falls = [s for s, e in pairwise(t) if np.interp(s, t, p) >= 50e5 > np.interp(e, t, p)]
    rises = [s for s, e in pairwise(t) if np.interp(s, t, p) < 50e5 <= np.interp(e, t, p)]
    assert falls[0] == pytest.approx(trip, rel=0.02)
    assert rises[0] - falls[0] == pytest.approx(trip, rel=0.02)


class Held(Component):
    """A cylinder without mass whose rod is fixed."""

    cylinder: Cylinder = Cylinder(
        inertia=False, eta=1.0, p_A=start(100e5, fixed=True), p_B=start(0.0, fixed=True)
    )
    wall = Fixed()

    def equations(self) -> Equations:
        yield connect(self.cylinder.flange, self.wall.flange)


def test_a_held_cylinder_pushes_with_pressure_times_area() -> None:
    solution = translate(Held()).simulate(1e-3)
    assert solution.initial("wall.flange.f") == pytest.approx(100e5 * 7.13e-5, rel=1e-9)
