"""An MJCF body as a component: its motion against closed forms, conservation laws and other integrators."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from arthur_acausal import (
    Component,
    DeclarationError,
    Equations,
    SimulationError,
    SolverOptions,
    Translation,
    UsageError,
    connect,
    start,
    translate,
)
from arthur_acausal.components.rotational import Fixed, Inertia, SpringDamper, TorqueSource
from arthur_acausal.mujoco import MujocoBody, Replay
from arthur_acausal.mujoco.function import BodyFunction
from arthur_acausal.mujoco.load import read
from arthur_acausal.mujoco.recipe import Recipe
from tests.mujoco.models import ARM, FEET, FREE_BODY, PENDULUM, QUADRUPED, SPHERE, joints

BENT = {"abd": 0.0, "hip": 0.5, "knee": -1.0}
JOINTS = [f"{n}_{k}" for n, *_ in FEET for k in BENT]
WEIGHT = (6 + 4 * 0.9) * 9.81


class Stand(Component):
    """The quadruped with a spring and a damper at each joint."""

    steady: bool = True
    height: float = 0.37

    def build(self) -> None:
        bent: dict[str, Any] = {f"{n}_{k}_phi": start(angle) for n, *_ in FEET for k, angle in BENT.items()}
        self.body = MujocoBody(
            mjcf=QUADRUPED,
            steady=self.steady,
            contacts=[f"{n}_foot" for n, *_ in FEET],
            observe=("energy", "power", "com"),
            wrenches=("back",),
            trunk_z=start(self.height),
            **bent,
        )
        self.springs = [SpringDamper(c=60.0, d=1.5, phi_rel0=angle) for _ in FEET for angle in BENT.values()]
        self.ground = Fixed()

    def equations(self) -> Equations:
        for spring, name in zip(self.springs, JOINTS, strict=True):
            yield connect(self.ground.flange, spring.flange_a)
            yield connect(spring.flange_b, getattr(self.body, name))


@cache
def standing(steady: bool) -> Translation:
    return translate(Stand(steady=steady, height=0.37 if steady else 0.42))


def test_a_free_body_turns_about_its_intermediate_axis() -> None:
    """Euler's equations for I = 1, 2, 3 kg m^2, integrated by DOP853 at 1e-13: the body turns over and back."""
    model = translate(MujocoBody(mjcf=FREE_BODY, body_w_x=0.01, body_w_y=1.0, body_w_z=0.01))
    solution = model.simulate(30.0, options=SolverOptions(rtol=1e-11, intervals=60))
    w = np.array([solution[f"body_w_{axis}"] for axis in "xyz"])
    euler = solve_ivp(
        lambda _, w: [-w[1] * w[2], w[0] * w[2], -w[0] * w[1] / 3],
        (0, 30),
        [0.01, 1.0, 0.01],
        method="DOP853",
        rtol=1e-13,
        atol=1e-15,
        t_eval=solution.t,
    )
    assert np.abs(w - euler.y).max() < 1e-8
    inertia = np.array([1.0, 2.0, 3.0])
    assert np.ptp(inertia @ w**2) < 1e-8
    quaternion = solution.values([f"body_q_{axis}" for axis in "wxyz"])
    assert np.abs(np.sum(quaternion**2, axis=1) - 1).max() < 1e-9


def test_the_angular_momentum_of_a_free_body_keeps_its_direction_in_the_world() -> None:
    """Shows that quaternion and angular velocity belong together: L = R(q) I w."""
    model = translate(MujocoBody(mjcf=FREE_BODY, body_w_x=0.3, body_w_y=1.0, body_w_z=-0.2))
    solution = model.simulate(10.0, options=SolverOptions(rtol=1e-9, intervals=50))
    w = solution.values([f"body_w_{axis}" for axis in "xyz"]) * [1.0, 2.0, 3.0]
    q = solution.values([f"body_q_{axis}" for axis in "wxyz"])
    scalar, vector = q[:, :1], q[:, 1:]
    turned = w + 2 * np.cross(vector, np.cross(vector, w) + scalar * w)
    assert np.abs(turned - turned[0]).max() < 1e-7


def test_an_arm_without_losses_keeps_its_energy() -> None:
    model = translate(MujocoBody(mjcf=ARM, observe=("energy",), j1_phi=1.2, j2_phi=0.4, j3_w=1.0))
    solution = model.simulate(10.0, options=SolverOptions(rtol=1e-9, intervals=100))
    energy = solution["E_kinetic"] + solution["E_potential"]
    assert np.abs(energy - energy[0]).max() < 1e-7 * np.ptp(solution["E_kinetic"])


def test_a_sphere_falls_onto_the_floor_and_comes_to_rest() -> None:
    model = translate(MujocoBody(mjcf=SPHERE, contacts=("ball",)))
    solution = model.simulate(1.0, options=SolverOptions(rtol=1e-9, intervals=100))
    function = BodyFunction(Recipe(read(SPHERE)))
    inputs, outputs = np.zeros(function.n_inputs), np.zeros(function.n_outputs)

    def falling(_: float, y: list[float]) -> list[float]:
        inputs[2], inputs[3], inputs[9] = y[0], 1.0, y[1]
        function.evaluate(inputs, outputs)
        return [y[1], outputs[2]]

    tight = solve_ivp(
        falling,
        (0, 1),
        [0.15, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
        t_eval=solution.t,
        max_step=2e-3,
    )
    assert np.abs(solution["ball_z"] - tight.y[0]).max() < 1e-7
    assert solution.final("ball_contact_n") == pytest.approx(9.81, rel=1e-6)
    assert solution.initial("ball_contact_n") == 0.0


def test_a_flange_is_acausal() -> None:
    """An inertia that turns with a joint adds to the joint's own; a torque on both accelerates their sum."""

    class Flywheel(Component):
        body = MujocoBody(mjcf=PENDULUM.replace("-9.81", "0"))
        wheel = Inertia(J=0.5)
        motor = TorqueSource(tau=0.7)

        def equations(self) -> Equations:
            yield connect(self.body.hinge, self.wheel.flange_a)
            yield connect(self.motor.flange, self.wheel.flange_b)

    solution = translate(Flywheel()).simulate(1.0, tolerance=1e-8)
    inertia = 2 / 5 * 2 * 0.05**2 + 2 * 0.25 + 0.5
    assert solution.final("body.hinge_w") == pytest.approx(0.7 / inertia, rel=1e-7)
    assert solution.final("body.hinge.tau") == pytest.approx(0.7 - 0.5 * 0.7 / inertia, rel=1e-7)


def test_a_robot_begins_standing_in_equilibrium() -> None:
    solution = standing(True).simulate(1.0, options=SolverOptions(intervals=20))
    forces = solution.values([f"body.{n}_foot_contact_n" for n, *_ in FEET])
    assert np.abs(forces.sum(axis=1) - WEIGHT).max() < 1e-6
    height = solution["body.trunk_z"]
    assert 0.34 < height[0] < 0.37
    assert np.ptp(height) < 1e-9
    assert abs(solution.initial("body.com_z") - height[0]) < 0.1


def test_a_robot_that_lands_balances_its_energy() -> None:
    """Energy and work: what flows into the body through flanges, contacts and dampers is what it gains."""
    solution = standing(False).simulate(0.3, options=SolverOptions(rtol=1e-7, intervals=500))
    power = sum(solution[f"body.P_{kind}"] for kind in ("external", "actuators", "constraints", "passive"))
    work = np.trapezoid(power, solution.t)
    energy = solution["body.E_kinetic"] + solution["body.E_potential"]
    lost = -np.trapezoid(solution["body.P_constraints"], solution.t)
    assert 0.5 < lost < 5.0  # J, of 9.6 kg that fell some centimetres
    assert energy[-1] - energy[0] == pytest.approx(work, abs=2e-3 * float(lost))
    torques = sum(solution[f"body.{name}.tau"] * solution[f"body.{name}_w"] for name in JOINTS)
    assert solution["body.P_external"] == pytest.approx(torques, rel=1e-9, abs=1e-9)


def test_a_push_moves_the_centre_of_mass() -> None:
    """In the air the momentum of a push is that of all masses: m v = F t."""
    model = translate(MujocoBody(mjcf=QUADRUPED, wrenches=("back",), observe=("com",), trunk_z=2.0))
    solution = model.simulate(0.2, options=SolverOptions(rtol=1e-9, intervals=10), inputs={"back_f_y": 50.0})
    assert solution.final("com_v_y") == pytest.approx(50.0 * 0.2 / (WEIGHT / 9.81), rel=1e-7)


def test_a_mujoco_actuator_is_an_input_and_its_lag_a_state() -> None:
    """A position servo with a first-order lag T = 0.1 s: the activation follows 1 - exp(-t / T)."""
    servo = '<position name="servo" joint="j" kp="3" timeconst="0.1"/>'
    model = translate(MujocoBody(mjcf=joints(actuator=servo)))
    solution = model.simulate(0.3, tolerance=1e-9, inputs={"servo_ctrl": 0.5})
    assert "servo_act" in model.report.states
    assert solution["servo_act"] == pytest.approx(0.5 * (1 - np.exp(-solution.t / 0.1)), abs=1e-8)


def test_sensors_are_variables() -> None:
    sensors = '<sensor><jointpos name="angle" joint="j"/><gyro name="gyro" site="s"/></sensor>'
    text = joints(extra=sensors).replace("<geom size='1'/>", "<geom size='1'/><site name='s'/>")
    solution = translate(MujocoBody(mjcf=text, j_phi=0.1, j_w=0.7)).simulate(0.1)
    assert solution["sensor_angle"] == pytest.approx(solution["j_phi"], abs=1e-15)
    assert solution.variable("sensor_angle").unit == "rad"
    assert solution["sensor_gyro_z"] == pytest.approx(solution["j_w"], abs=1e-12)


def test_a_replay_gives_jacobians_and_contacts() -> None:
    solution = standing(True).simulate(0.1, options=SolverOptions(intervals=2))
    body = MujocoBody(mjcf=QUADRUPED, wrenches=("back",))
    replay = Replay(solution, body, "body")
    jacobian = replay.jacobian("back")
    assert jacobian.dims == ("time", "motion", "dof")
    moving = jacobian.sel(dof="trunk_v_x").isel(time=0)
    assert moving.values == pytest.approx([1.0, 0, 0, 0, 0, 0])
    contacts = replay.contacts("fl_foot")
    assert len(contacts) == solution.t.size
    assert contacts[0].force[2] == pytest.approx(solution.initial("body.fl_foot_contact_z"), rel=1e-9)
    assert contacts[0].position[2] == pytest.approx(0.0, abs=1e-2)


def test_keyframes_and_start_values() -> None:
    key = '<keyframe><key name="up" qpos="0.4" qvel="2"/></keyframe>'
    model = translate(MujocoBody(mjcf=joints(extra=key), keyframe="up", j_w=1.0))
    solution = model.simulate(0.1)
    assert (solution.initial("j_phi"), solution.initial("j_w")) == (0.4, 1.0)


def test_mistakes_are_told() -> None:
    with pytest.raises(DeclarationError, match="needs mjcf"):
        translate(MujocoBody())
    with pytest.raises(UsageError, match="'heat' cannot be observed"):
        MujocoBody(mjcf=PENDULUM, observe=("heat",))
    with pytest.raises(UsageError, match="no geom or body 'hand'"):
        MujocoBody(mjcf=PENDULUM, contacts=("hand",))
    with pytest.raises(DeclarationError, match=r"has no 'hinge_p'"):
        MujocoBody(mjcf=PENDULUM, hinge_p=1.0)
    with pytest.raises(DeclarationError, match=r"a part with the name 'observe'"):
        MujocoBody(mjcf=PENDULUM.replace("hinge", "observe"))


def test_a_full_contact_buffer_ends_the_run_with_its_time_and_cause() -> None:
    """Two clusters of balls fall onto each other: when they meet, the model's memory does not suffice."""
    balls = "".join(
        f"<body pos='{0.01 * k} 0 {z}'><joint name='b{z}{k}' type='slide' axis='0 0 1' limited='false'/>"
        f"<geom size='.1' contype='{c}' conaffinity='{3 - c}'/></body>"
        for z, c in ((0, 1), (1, 2))
        for k in range(8)
    )
    text = f"<mujoco><size memory='22K'/><worldbody>{balls}</worldbody></mujoco>"
    falling: dict[str, Any] = {f"b0{k}_v": 3.0 for k in range(8)}
    model = translate(MujocoBody(mjcf=text, **falling))
    with pytest.raises(SimulationError, match=r"buffer is full|memory") as caught:
        model.simulate(1.0, options=SolverOptions(max_step=0.01))
    assert caught.value.solution.t[-1] == pytest.approx(0.8 / 3.0, abs=1e-3)
    assert "size memory" in str(caught.value)
