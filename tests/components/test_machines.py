"""Relief valve, cylinder, reservoir: figures of the report, and where its laws would give energy."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from math import exp, pi
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import Component, Equations, SolverOptions, Translation, connect, start, translate
from arthur_acausal.components.hydraulic import (
    GPM,
    Cylinder,
    FlowSource,
    Fluid,
    GasReservoir,
    PressureSource,
    ReliefValve,
    Tank,
    Volume,
)
from arthur_acausal.components.hydraulic.reservoir import GasLaw
from arthur_acausal.components.translational import SpeedSource as Pusher


class Override(Component):
    """A flow through a relief valve, with the manifold's volume before it and 3 bar behind it."""

    source: FlowSource = FlowSource(q=GPM, fluid=Fluid(constant_density=True))
    manifold = Volume(V=4.83e-6, p=start(20.68e6, fixed=True))
    relief = ReliefValve()
    tank: Tank = Tank(p=3e5)

    def equations(self) -> Equations:
        yield connect(self.source.port, self.manifold.port)
        yield connect(self.manifold.port, self.relief.port_a)
        yield connect(self.relief.port_b, self.tank.port)


@cache
def override() -> Translation:
    """Translate the rig once."""
    return translate(Override())


@pytest.mark.parametrize(("gpm", "kilopascal"), [(1, 34.75), (3, 103.8)])
def test_relief_override(gpm: int, kilopascal: float) -> None:
    """Eq. 5.22 to 5.28 with p_R = 3 bar, the orifice at reference density."""
    solution = override().simulate(1e-3, parameters={"source.q": gpm * GPM})
    assert solution.final("manifold.p") - 20.68e6 == pytest.approx(kilopascal * 1e3, rel=5e-3)


def test_relief_and_manifold_make_a_time_constant_of_1_9_microseconds() -> None:
    """tau = V_m/(beta dq/dp): 4.83e-6/(1.4e9 x 1.816e-9)."""
    rest = override().simulate(1e-3).final("manifold.p")
    tau = 1.90e-6
    options = SolverOptions(rtol=1e-9, atol=1e-6)
    later = override().simulate(tau, start={"manifold.p": rest + 100.0}, options=options)
    assert (later.final("manifold.p") - rest) / 100.0 == pytest.approx(exp(-1), rel=0.02)


def test_the_poppet_stops_at_its_full_area() -> None:
    """A_max = pi d_p^2/4 at x_max = 1.648 mm (5.24, 5.25), 26.9 bar above cracking."""
    solution = override().simulate(1e-2, parameters={"source.q": 6e-3})
    assert solution.final("manifold.p") > 20.68e6 + 26.9e5
    assert solution.final("relief.x") == pytest.approx(1.648e-3, rel=1e-3)
    assert solution.final("relief.A_o") == pytest.approx(pi * 6.35e-3**2 / 4, rel=1e-9)


class Pushed(Component):
    """A cylinder between two constant pressures whose rod is moved."""

    cylinder: Cylinder = Cylinder(inertia=False)
    push = Pusher()
    a = PressureSource(p=100e5)
    b = PressureSource(p=50e5)

    def equations(self) -> Equations:
        yield connect(self.cylinder.flange, self.push.flange)
        yield connect(self.a.port, self.cylinder.port_a)
        yield connect(self.b.port, self.cylinder.port_b)


@cache
def pushed(**options: Any) -> Translation:
    """Translate the rig with some options of the cylinder."""
    return translate(Pushed(cylinder=Cylinder(inertia=False, **options)), compile="never")


@settings(max_examples=25)
@given(v=st.floats(-0.5, 0.5), p_a=st.floats(0, 2e7), p_b=st.floats(0, 2e7), stribeck=st.booleans())
def test_friction_takes_energy_in_either_direction(v: float, p_a: float, p_b: float, stribeck: bool) -> None:
    solution = pushed(stribeck=stribeck).simulate(
        1e-3, inputs={"push.v": v}, parameters={"a.p": p_a, "b.p": p_b}
    )
    assert solution.final("cylinder.P_loss") >= 0
    assert solution.final("cylinder.F_friction") * v >= 0


def test_the_printed_efficiency_gives_energy_when_driven_backwards() -> None:
    """eta F (5.38): 5 % of the energy appears."""
    solution = pushed(efficiency="printed").simulate(
        1e-3, inputs={"push.v": -0.1}, parameters={"cylinder.c": 0.0}
    )
    F = 100e5 * 7.13e-5 - 50e5 * 5.35e-5
    assert solution.final("cylinder.P_loss") == pytest.approx(-0.05 * F * 0.1, rel=1e-9)


def test_piston_leakage() -> None:
    solution = pushed().simulate(1e-3, parameters={"cylinder.G_leak": 1e-13})
    assert solution.final("cylinder.q_leak") == pytest.approx(1e-13 * 50e5, rel=1e-9)


class Free(Component):
    """A cylinder with air-tight ports that runs into its stop."""

    cylinder: Cylinder = Cylinder(
        y=start(0.034, fixed=True),
        v=start(0.5, fixed=True),
        p_A=start(0.0, fixed=True),
        p_B=start(0.0, fixed=True),
    )


@pytest.mark.parametrize("stop_events", [False, True])
def test_a_stop_throws_the_piston_back(stop_events: bool) -> None:
    """Half a period of m and k (oil left out by a soft fluid): deepest at v sqrt(m/k), back with the same speed."""
    cylinder = Cylinder(
        c=0.0,
        eta=1.0,
        stop_events=stop_events,
        fluid=Fluid(beta=1.0, constant_density=True),
        y=start(0.034, fixed=True),
        v=start(0.5, fixed=True),
        p_A=start(0.0, fixed=True),
        p_B=start(0.0, fixed=True),
    )
    solution = translate(Free(cylinder=cylinder)).simulate(5e-3, tolerance=1e-9)
    assert solution.final("cylinder.v") == pytest.approx(-0.5, rel=1e-4)
    assert max(solution["cylinder.y"]) == pytest.approx(0.035 + 0.5 * (0.05 / 1.436e6) ** 0.5, rel=1e-4)
    assert len([e for e in solution.events if e.kind == "state"]) == (2 if stop_events else 0)


class Breathing(Component):
    """A reservoir by itself."""

    reservoir: GasReservoir = GasReservoir()


@pytest.mark.parametrize("gas", ["algebraic", "integrated"])
def test_the_reservoir_rings_at_4_2_kilohertz(gas: GasLaw) -> None:
    """omega = A_R sqrt(beta/(V_f m_p)) = 2.6e4 rad/s, damping ratio 0.005 (Table 11)."""
    reservoir = GasReservoir(
        gas=gas, p=start(4e5, fixed=True), z=start(0.04, fixed=True), v=start(0.0, fixed=True)
    )
    solution = translate(Breathing(reservoir=reservoir)).simulate(
        20 / 4.2e3, options=SolverOptions(rtol=1e-8, intervals=4000)
    )
    v = solution["reservoir.v"]
    rising = np.flatnonzero((v[:-1] < 0) & (v[1:] >= 0))
    omega = 2 * pi * (len(rising) - 1) / (solution.t[rising[-1]] - solution.t[rising[0]])
    assert omega == pytest.approx(1.15e-3 * (1.4e9 / (6.9e-5 * 0.04)) ** 0.5, rel=0.01)
    turn = [max(v[i:j]) for i, j in pairwise(rising)]
    decay = np.log(turn[0] / turn[-1]) / (2 * pi * (len(turn) - 1))
    assert decay == pytest.approx(10 / (2 * 0.04 * omega), rel=0.02)


def test_the_two_gas_laws_agree() -> None:
    finals = []
    gas: GasLaw
    for gas in ("algebraic", "integrated"):
        reservoir = GasReservoir(gas=gas, p=start(4e5, fixed=True))
        finals.append(
            translate(Breathing(reservoir=reservoir)).simulate(1e-3, tolerance=1e-9).final("reservoir.p_g")
        )
    assert finals[0] == pytest.approx(finals[1], rel=1e-8)
