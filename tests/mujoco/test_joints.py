"""Ball joints and slides, tendons and equality constraints: against closed forms and MuJoCo's own steps."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from arthur_acausal import Component, Equations, SolverOptions, connect, translate
from arthur_acausal.components.translational import Fixed, ForceSource, Spring
from arthur_acausal.mujoco import MujocoBody
from arthur_acausal.mujoco.engine import mujoco

BALL = """
<mujoco>
  <worldbody>
    <body><joint name="ball" type="ball"/><geom type="sphere" size=".05" pos="0 0 -.4" mass="1.5"/></body>
  </worldbody>
</mujoco>"""

POINT = '<inertial mass="1" pos="0 0 -1" diaginertia="1e-15 1e-15 1e-15"/>'
DOUBLE_PENDULUM = f"""
<mujoco>
  <option gravity="0 0 -9.81"/>
  <worldbody>
    <body><joint name="upper" axis="0 -1 0"/>{POINT}
      <body pos="0 0 -1"><joint name="lower" axis="0 -1 0"/>{POINT}</body>
    </body>
  </worldbody>
</mujoco>"""

SLIDES = """
<mujoco>
  <option gravity="0 0 0"><flag refsafe="disable"/></option>
  <worldbody>
    <body><joint name="a" type="slide" axis="1 0 0"/><geom size=".1" mass="2"/></body>
    <body pos="1 0 0"><joint name="b" type="slide" axis="1 0 0"/><geom size=".1" mass="2"/></body>
  </worldbody>
  {extra}
</mujoco>"""
TENDON = """<tendon>
  <fixed name="t" stiffness="50"><joint joint="a" coef="1"/><joint joint="b" coef="-1"/></fixed>
</tendon>"""
EQUALITY = '<equality><joint joint1="b" joint2="a" polycoef="0 2 0 0 0" solref=".02 1"/></equality>'


class Pushed(Component):
    """Two slides, and a force on the first."""

    extra: str = ""
    force: float = 3.0

    def build(self) -> None:
        self.body = MujocoBody(mjcf=SLIDES.format(extra=self.extra))
        self.push = ForceSource(f=self.force)

    def equations(self) -> Equations:
        yield connect(self.push.flange, self.body.a)


def test_a_ball_joint_precesses_as_euler_says() -> None:
    """A conical pendulum, turned as a whole about the vertical: W^2 = g / (l cos(tilt)), for a sphere on its rod."""
    tilt, W = 0.7, np.sqrt(9.81 / (0.4 * np.cos(0.7)))
    half = tilt / 2
    model = translate(
        MujocoBody(
            mjcf=BALL,
            ball_q_w=np.cos(half),
            ball_q_y=np.sin(half),
            ball_w_x=-W * np.sin(tilt),
            ball_w_z=W * np.cos(tilt),
        )
    )
    run = model.simulate(2.0, options=SolverOptions(rtol=1e-9, intervals=40))
    c, s = np.cos(W * run.t / 2), np.sin(W * run.t / 2)
    expected = np.array([c * np.cos(half), -s * np.sin(half), c * np.sin(half), s * np.cos(half)]).T
    found = run.values([f"ball_q_{axis}" for axis in "wxyz"])
    assert np.abs(found - expected).max() < 1e-6


def test_a_slide_is_a_flange() -> None:
    """A spring of the library on one slide: s = s_0 cos(sqrt(c/m) t); the other stays."""

    class Sprung(Component):
        body = MujocoBody(mjcf=SLIDES.format(extra=""), a_s=0.2)
        spring = Spring(c=80.0)
        wall = Fixed()

        def equations(self) -> Equations:
            yield connect(self.wall.flange, self.spring.flange_a)
            yield connect(self.spring.flange_b, self.body.a)

    run = translate(Sprung()).simulate(2.0, tolerance=1e-8)
    assert run["body.a_s"] == pytest.approx(0.2 * np.cos(np.sqrt(80.0 / 2) * run.t), abs=1e-6)
    assert run["body.a.f"] == pytest.approx(-80.0 * run["body.a_s"], rel=1e-9, abs=1e-9)
    assert np.abs(run["body.b_s"]).max() == 0.0


def test_a_tendon_pulls_as_mujoco_computes_it() -> None:
    """Two masses and a spring between them, pushed: x_a - x_b = F/(2 c) (1 - cos(sqrt(2 c/m) t))."""
    run = translate(Pushed(extra=TENDON)).simulate(1.0, tolerance=1e-8)
    apart = run["body.a_s"] - run["body.b_s"]
    w = np.sqrt(2 * 50.0 / 2)
    assert apart == pytest.approx(3.0 / (2 * w**2) * (1 - np.cos(w * run.t)), abs=1e-7)
    assert (run["body.a_s"] + run["body.b_s"]) == pytest.approx(3.0 / 2 * run.t**2 / 2, abs=1e-7)


def test_an_equality_constraint_holds_as_in_mujoco_s_own_steps() -> None:
    """MuJoCo in steps of 1e-5 s, first order: its error is of the size of a step."""
    run = translate(Pushed(extra=EQUALITY)).simulate(0.3, options=SolverOptions(rtol=1e-8, intervals=30))
    model = mujoco().MjModel.from_xml_string(SLIDES.format(extra=EQUALITY))
    model.opt.timestep = h = 1e-5
    data = mujoco().MjData(model)
    data.qfrc_applied[0] = 3.0
    steps = np.round(np.diff(run.t) / h).astype(int)
    found = [data.qpos.copy()]
    for n in steps.tolist():
        mujoco().mj_step(model, data, n)
        found.append(data.qpos.copy())
    ours = run.values(["body.a_s", "body.b_s"])
    assert np.abs(ours - np.array(found)).max() < 3e-6
    assert ours[-1, 1] == pytest.approx(2 * ours[-1, 0], abs=2e-3)
    assert ours[-1, 0] == pytest.approx(3.0 / (2 + 4 * 2) * 0.3**2 / 2, rel=0.05)


def lagrange(_: float, y: list[float]) -> list[float]:
    """Two points of 1 kg on massless rods of 1 m: rates of both angles from the vertical, and of both speeds."""
    a, b, u, v = y
    mass = np.array([[2.0, cos(a - b)], [cos(a - b), 1.0]])
    force = [-sin(a - b) * v**2 - 2 * 9.81 * sin(a), sin(a - b) * u**2 - 9.81 * sin(b)]
    return [u, v, *np.linalg.solve(mass, force)]


@pytest.mark.parametrize("rtol", [0.7e-10, 1e-10, 1.4e-10])
def test_a_double_pendulum_from_the_horizontal_is_exact_to_a_hundred_times_the_tolerance(rtol: float) -> None:
    model = translate(MujocoBody(mjcf=DOUBLE_PENDULUM, upper_phi=pi / 2))
    solution = model.simulate(2.0, options=SolverOptions(rtol=rtol, intervals=2))
    upper, lower, u, w = (solution[f"{n}_{x}"] for x in ("phi", "w") for n in ("upper", "lower"))
    exact = solve_ivp(lagrange, (0, 2), [pi / 2, pi / 2, 0, 0], "DOP853", [1.0, 2.0], rtol=1e-13, atol=1e-14)
    assert np.abs(np.array([upper, upper + lower, u, u + w])[:, 1:] - exact.y).max() < 1e-8
