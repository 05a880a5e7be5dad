"""Planar mechanics against Lagrange's equations by hand, quadratures, and conservation of energy and momentum."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, pi, sin, sqrt

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from arthur_acausal import (
    Component,
    Equations,
    Real,
    Solution,
    SolverOptions,
    connect,
    parameter,
    simulate,
    start,
    translate,
)
from arthur_acausal.components import rotational as rot
from arthur_acausal.components import translational as lin
from arthur_acausal.components.planar import (
    Body,
    Damper,
    Fixed,
    FixedRotation,
    FixedTranslation,
    Gravity,
    PointMass,
    Prismatic,
    Revolute,
    Spring,
    SpringDamper,
    WorldForce,
)
from arthur_acausal.models.examples.double_pendulum import DoublePendulum
from arthur_acausal.models.examples.four_bar import FourBar
from arthur_acausal.models.examples.slider_crank import SliderCrank

PRECISE = SolverOptions(rtol=1e-9)
G = 9.81


def energy(solution: Solution, *bodies: str) -> NDArray[np.float64]:
    """Kinetic and potential energy of bodies, by path, J."""
    return np.asarray(
        sum(solution[f"{body}.E_{kind}"] for body in bodies for kind in ("kinetic", "potential"))
    )


class Pendulum(Component):
    """A rod of 2 kg and 1.2 m on a pin, let go from ``phi_0`` over the x-axis."""

    phi_0: Real = parameter("rad", default=-pi / 4)
    ground = Fixed()
    pin = Revolute(phi=start(lambda self: self.phi_0, fixed=True), w=start(0.0, fixed=True))
    half = FixedTranslation(r_x=0.6)
    rod = Body(m=2.0, J=2.0 * 1.2**2 / 12)

    def equations(self) -> Equations:
        yield connect(self.ground.frame, self.pin.frame_a)
        yield connect(self.pin.frame_b, self.half.frame_a)
        yield connect(self.half.frame_b, self.rod.frame)


@pytest.mark.parametrize("angle", [0.3, 1.5, 3.0])
def test_the_period_of_a_rod_is_an_elliptic_integral(angle: float) -> None:
    """T = 4 K(sin^2(angle/2)) sqrt(J/(m g L/2)), with J = m L^2/3 about the pin."""
    period = 4.0 * float(ellipk(sin(angle / 2.0) ** 2)) * sqrt(2.0 * 1.2 / (3.0 * G))
    solution = translate(Pendulum()).simulate(
        2.0 * period, options=PRECISE, parameters={"phi_0": angle - pi / 2}
    )
    assert solution.final("pin.phi") == pytest.approx(angle - pi / 2, abs=1e-6)
    assert np.ptp(energy(solution, "rod")) < 1e-6
    length = np.hypot(solution["rod.x"], solution["rod.y"])
    assert np.abs(length - 0.6).max() < 1e-14


def rods(t: float, y: NDArray[np.float64]) -> list[float]:
    """Lagrange's equations of two uniform rods (1 kg, 1 m): absolute angles a, b from the x-axis, and their rates."""
    a, b, u, v = y
    coupling = 0.5 * cos(a - b)
    mass = np.array([[4.0 / 3.0, coupling], [coupling, 1.0 / 3.0]])
    twist = 0.5 * sin(a - b)
    force = np.array([-twist * v**2 - 1.5 * G * cos(a), twist * u**2 - 0.5 * G * cos(b)])
    return [u, v, *np.linalg.solve(mass, force)]


def test_a_double_pendulum_follows_lagranges_equations() -> None:
    solution = simulate(DoublePendulum(), 1.5, options=PRECISE)
    expected = solve_ivp(rods, (0.0, 1.5), [0.0, pi / 2, 0.0, 0.0], method="DOP853", rtol=1e-12, atol=1e-12)
    a, b, u, v = expected.y[:, -1]
    found = [solution.final(p) for p in ("rods[0].phi", "rods[1].phi", "rods[0].w", "rods[1].w")]
    assert found == pytest.approx([a, b, u, v], abs=3e-6)
    assert np.ptp(energy(solution, "rods[0]", "rods[1]")) < 3e-7


def test_the_angles_of_the_joints_are_the_states() -> None:
    """They are preferred over the rods' places; in a loop the driving pin's is."""
    assert translate(DoublePendulum()).report.states == ["upper.phi", "upper.w", "lower.phi", "lower.w"]
    assert translate(FourBar()).report.states == ["crank_pin.phi", "crank_pin.w"]
    assert translate(SliderCrank()).report.states == ["crank_pin.phi", "crank_pin.w"]


def crossing(angle: float, energy_0: float, shape: Callable[[float], tuple[float, float]]) -> float:
    """Time in which a mechanism of one freedom turns from 0 to ``angle``: shape(q) gives its inertia and potential."""

    def slowness(q: float) -> float:
        inertia, potential = shape(q)
        return sqrt(inertia / (2.0 * (energy_0 - potential)))

    panels = np.linspace(0.0, angle, 41)
    nodes, weights = np.polynomial.legendre.leggauss(12)
    half = np.diff(panels) / 2.0
    places = (panels[:-1] + half)[:, None] + half[:, None] * nodes
    return float(np.sum(np.vectorize(slowness)(places) * weights * half[:, None]))


def bar(m: float, L: float, ends: Callable[[float], NDArray[np.float64]], q: float) -> tuple[float, float]:
    """Inertia about the mechanism's coordinate and potential energy of a uniform bar between two points (4,)."""
    h = 1e-6
    rate = (ends(q - 2 * h) - 8 * ends(q - h) + 8 * ends(q + h) - ends(q + 2 * h)) / (12 * h)
    x_a, y_a, x_b, y_b = rate
    ends_energy = x_a**2 + y_a**2 + x_b**2 + y_b**2 + x_a * x_b + y_a * y_b
    place = ends(q)
    return m / 3.0 * ends_energy, m * G * (place[1] + place[3]) / 2.0


def four_bar(q: float) -> tuple[float, float]:
    """The four-bar of the example: the rocker's end is where circles about crank's end and right pivot meet."""

    def joint(q: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        a = 0.5 * np.array([cos(q), sin(q)])
        d = np.array([2.0, 0.0]) - a
        along = (d @ d + 2.0**2 - 1.5**2) / (2.0 * sqrt(d @ d))
        across = sqrt(2.0**2 - along**2)
        e = d / sqrt(d @ d)
        return a, a + along * e + across * np.array([-e[1], e[0]])

    bars = (
        (1.0, 0.5, lambda q: np.concatenate([[0.0, 0.0], joint(q)[0]])),
        (2.0, 2.0, lambda q: np.concatenate(joint(q))),
        (1.5, 1.5, lambda q: np.concatenate([[2.0, 0.0], joint(q)[1]])),
    )
    parts = [bar(m, L, ends, q) for m, L, ends in bars]
    return sum(p[0] for p in parts), sum(p[1] for p in parts)


def slider_crank(q: float) -> tuple[float, float]:
    """The slider crank of the example."""

    def pin(q: float) -> NDArray[np.float64]:
        return 0.1 * np.array([cos(q), sin(q)])

    def piston(q: float) -> NDArray[np.float64]:
        return np.array([0.1 * cos(q) + sqrt(0.3**2 - (0.1 * sin(q)) ** 2), 0.0])

    crank = bar(0.2, 0.1, lambda q: np.concatenate([[0.0, 0.0], pin(q)]), q)
    rod = bar(0.3, 0.3, lambda q: np.concatenate([pin(q), piston(q)]), q)
    v = -0.1 * sin(q) - 0.01 * sin(q) * cos(q) / sqrt(0.09 - 0.01 * sin(q) ** 2)
    return 0.05 + crank[0] + rod[0] + 0.5 * v**2, crank[1] + rod[1]


@pytest.mark.parametrize(
    ("model", "shape", "w_0", "bodies"),
    [
        (FourBar(), four_bar, 8.0, ("crank.body", "coupler.body", "rocker.body")),
        (SliderCrank(), slider_crank, 20.0, ("crank.body", "rod.body", "piston")),
    ],
    ids=["four-bar", "slider crank"],
)
def test_a_kinematic_loop_turns_in_the_time_of_its_energy_integral(
    model: Component, shape: Callable[[float], tuple[float, float]], w_0: float, bodies: tuple[str, ...]
) -> None:
    inertia, potential = shape(0.0)
    energy_0 = inertia * w_0**2 / 2.0 + potential
    turned = 2 * pi * 1.37
    t = crossing(turned, energy_0, shape)
    solution = simulate(model, t, options=PRECISE)
    assert solution.final("crank_pin.phi") == pytest.approx(turned, abs=3e-6)
    total = energy(solution, *bodies)
    if isinstance(model, SliderCrank):
        total = total + solution["flywheel.E_kinetic"]
    assert total[0] == pytest.approx(energy_0, rel=1e-8)
    assert np.ptp(total) < 1e-6 * energy_0


def test_a_loop_that_works_against_a_damper_loses_what_the_damper_takes() -> None:
    solution = translate(SliderCrank()).simulate(0.3, options=PRECISE, parameters={"d": 5.0})
    total = energy(solution, "crank.body", "rod.body", "piston") + solution["flywheel.E_kinetic"]
    lost = np.trapezoid(solution["damper.P_loss"], solution.t)
    assert total[0] - total[-1] == pytest.approx(lost, rel=2e-3)
    assert lost > 1.0


def test_a_slide_on_an_incline() -> None:
    """Down a slope of 30 degrees with g/2, from rest; a force of 3 N along the axis takes 1.5 m/s^2 off 2 kg."""

    class Incline(Component):
        push: Real = parameter("N", default=0.0)
        ground = Fixed()
        slide: Prismatic = Prismatic(
            use_flange=True, alpha=-pi / 6, s=start(0.0, fixed=True), v=start(0.0, fixed=True)
        )
        turn = FixedRotation(alpha=0.7)
        block = Body(m=2.0, J=0.1)
        force = lin.ConstantForce(f_constant=lambda self: self.push)

        def equations(self) -> Equations:
            yield connect(self.ground.frame, self.slide.frame_a)
            yield connect(self.slide.frame_b, self.turn.frame_a)
            yield connect(self.turn.frame_b, self.block.frame)
            yield connect(self.force.flange, self.slide.flange)

    incline = translate(Incline())
    solution = incline.simulate(2.0, options=PRECISE)
    assert solution.final("slide.s") == pytest.approx(G / 2 * 2.0, rel=1e-8)
    assert solution.final("block.phi") == pytest.approx(0.7)
    assert solution.final("ground.frame.fy") == pytest.approx(-2.0 * G * 0.75, rel=1e-8)
    braked = incline.simulate(2.0, options=PRECISE, parameters={"push": -3.0})
    assert braked.final("slide.v") == pytest.approx((G / 2 - 1.5) * 2.0, rel=1e-8)


def test_a_motor_turns_an_arm_about_its_pin() -> None:
    """J + m r^2 = 0.1 + 2 * 0.25 feel 3 N m in the plane without gravity."""

    class Arm(Component):
        weightless: Gravity = Gravity(g_y=0.0)
        ground = Fixed()
        pin = Revolute(use_flange=True, phi=start(0.2, fixed=True), w=start(0.0, fixed=True))
        link = FixedTranslation(r_x=0.3, r_y=0.4)
        motor = rot.ConstantTorque(tau_constant=3.0)

        def build(self) -> None:
            self.body = Body(m=2.0, J=0.1, gravity=self.weightless)

        def equations(self) -> Equations:
            yield connect(self.ground.frame, self.pin.frame_a)
            yield connect(self.pin.frame_b, self.link.frame_a)
            yield connect(self.link.frame_b, self.body.frame)
            yield connect(self.motor.flange, self.pin.flange)

    solution = simulate(Arm(), 1.0, options=PRECISE)
    assert solution.final("pin.w") == pytest.approx(5.0, rel=1e-8)
    assert solution.final("ground.frame.tau") == pytest.approx(-3.0, rel=1e-8)
    assert solution.final("body.x") == pytest.approx(0.5 * cos(0.2 + 2.5 + atan2(0.4, 0.3)), rel=1e-7)


def test_a_mass_on_a_spring_keeps_its_angular_momentum() -> None:
    class Orbit(Component):
        weightless: Gravity = Gravity(g_y=0.0)
        ground = Fixed()
        spring = Spring(c=10.0, s_0=0.5)

        def build(self) -> None:
            initial = {"x": 1.0, "y": 0.0, "v_x": 0.5, "v_y": 2.0}
            given = {name: start(value, fixed=True) for name, value in initial.items()}
            self.mass = PointMass(alone=True, m=0.4, gravity=self.weightless, **given)

        def equations(self) -> Equations:
            yield connect(self.ground.frame, self.spring.frame_a)
            yield connect(self.spring.frame_b, self.mass.frame)

    solution = simulate(Orbit(), 5.0, options=PRECISE)
    momentum = solution["mass.x"] * solution["mass.v_y"] - solution["mass.y"] * solution["mass.v_x"]
    assert np.abs(momentum - 2.0).max() < 1e-6
    total = solution["mass.E_kinetic"] + solution["spring.E_elastic"]
    assert np.ptp(total) < 1e-6


def test_springs_and_dampers_bring_a_plate_to_rest() -> None:
    """A body that hangs on two springs ends where they carry its weight; what it loses is in the dampers."""

    class Hung(Component):
        left, right = Fixed(x0=-1.0), Fixed(x0=1.0)
        first = SpringDamper(c=200.0, d=10.0, s_0=0.5)
        second = SpringDamper(c=200.0, d=10.0, s_0=0.5)
        side = Damper(d=5.0)
        arm_a, arm_b = FixedTranslation(r_x=-1.0), FixedTranslation(r_x=1.0)
        plate = Body(m=4.0, J=1.0, y=start(-1.0, fixed=True), phi=start(0.1, fixed=True))
        push = WorldForce(f_x=0.0)

        def equations(self) -> Equations:
            yield connect(self.left.frame, self.first.frame_a)
            yield connect(self.first.frame_b, self.arm_a.frame_b)
            yield connect(self.arm_a.frame_a, self.plate.frame)
            yield connect(self.arm_b.frame_a, self.plate.frame)
            yield connect(self.right.frame, self.second.frame_a)
            yield connect(self.second.frame_b, self.arm_b.frame_b)
            yield connect(self.push.frame, self.plate.frame)
            yield connect(self.side.frame_a, self.left.frame)
            yield connect(self.side.frame_b, self.plate.frame)

    solution = simulate(Hung(), 40.0, tolerance=1e-8)
    assert solution.final("plate.y") == pytest.approx(-0.5 - 4.0 * G / 400.0, abs=1e-5)
    assert solution.final("plate.phi") == pytest.approx(0.0, abs=1e-5)
    assert solution.final("plate.x") == pytest.approx(0.0, abs=1e-4)
