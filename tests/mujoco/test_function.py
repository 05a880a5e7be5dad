"""Accelerations are a pure function of state and forces, and their derivative is right."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal.mujoco.derivative import MAX_AGE, turning
from arthur_acausal.mujoco.dynamics import FloatArray
from arthur_acausal.mujoco.engine import mujoco
from arthur_acausal.mujoco.function import BodyFunction
from arthur_acausal.mujoco.load import read
from arthur_acausal.mujoco.recipe import Recipe
from tests.mujoco.models import PENDULUM, QUADRUPED, SPHERE, joints


def function_of(text: str, wrenches: tuple[str, ...] = (), max_age: int = MAX_AGE) -> BodyFunction:
    return BodyFunction(Recipe(read(text), wrenches=wrenches), max_age=max_age)


def state_of(function: BodyFunction, seed: int) -> FloatArray:
    """A state of the quadruped near the floor, legs bent at random, pushed and moving."""
    random = np.random.default_rng(seed)
    slots = function.dynamics.slots
    inputs = random.standard_normal(function.n_inputs)
    q = inputs[slots.qpos]
    q[:3] = 0.0, 0.0, random.uniform(0.39, 0.43)
    q[3:7] = random.uniform(0.5, 2.0) * np.array([1.0, *random.uniform(-0.05, 0.05, 3)])
    q[7:] = 0.05 * random.standard_normal(q.size - 7)
    return inputs


def value(function: BodyFunction, inputs: FloatArray) -> FloatArray:
    outputs = np.empty(function.n_outputs)
    function.evaluate(inputs, outputs)
    return outputs


@pytest.mark.parametrize("jacobian", ["dense", "sparse"])
def test_accelerations_have_the_same_bits_after_a_thousand_other_calls(jacobian: str) -> None:
    option = f'<option jacobian="{jacobian}"/></mujoco>'
    function = function_of(QUADRUPED.replace("</mujoco>", option), ("back",))
    states = [state_of(function, seed) for seed in range(10)]
    first = [value(function, s) for s in states]
    assert function.dynamics.data.ncon >= 0
    touching = 0
    for seed in range(1000):
        value(function, state_of(function, 100 + seed))
        touching += function.dynamics.data.ncon > 0
    assert 100 < touching < 1000  # with contacts and without
    for state, before in zip(states, first, strict=True):
        assert value(function, state).tobytes() == before.tobytes()


def test_accelerations_do_not_depend_on_the_time_step() -> None:
    step = '<option timestep="{}"/></mujoco>'
    texts = [QUADRUPED.replace("</mujoco>", step.format(h)) for h in (1e-5, 2e-3, 5e-2)]
    functions = [function_of(text, ("back",)) for text in texts]
    assert [f.dynamics.model.opt.timestep for f in functions] == [1e-5, 2e-3, 5e-2]
    for seed in range(20):
        state = state_of(functions[0], seed)
        a, b, c = (value(f, state) for f in functions)
        assert a.tobytes() == b.tobytes() == c.tobytes()


def test_a_fresh_function_is_independent() -> None:
    function = function_of(QUADRUPED)
    other = function.fresh()
    one, two = state_of(function, 1), state_of(function, 2)
    a = value(function, one)
    value(other, two)
    assert function.dynamics.data is not other.dynamics.data
    assert value(other, one).tobytes() == a.tobytes()


def test_a_pendulum_accelerates_as_the_textbook_says() -> None:
    function = function_of(PENDULUM)
    radius, length, mass, torque, angle = 0.05, 0.5, 2.0, 0.7, 0.3
    inertia = 2 / 5 * mass * radius**2 + mass * length**2
    expected = (torque - mass * 9.81 * length * np.sin(angle)) / inertia
    assert value(function, np.array([angle, 0.2, torque]))[0] == pytest.approx(expected, rel=1e-14)


def test_a_wrench_acts_in_world_directions_at_its_site() -> None:
    function = function_of(QUADRUPED, ("back",))
    slots, model = function.dynamics.slots, function.dynamics.model
    inputs = np.zeros(function.n_inputs)
    inputs[slots.qpos] = model.qpos0
    inputs[2] = 1.0  # in the air
    before = value(function, inputs)
    force = np.array([3.0, -1.0, 2.0])
    inputs[slots.wrench][:3] = force
    delta = value(function, inputs) - before
    momentum = np.zeros(3)  # of all bodies: the sum of m a of their centres of mass
    jacobian = np.zeros((3, model.nv))
    for body in range(1, model.nbody):
        mujoco().mj_jacBodyCom(model, function.dynamics.data, jacobian, None, body)
        momentum += model.body_mass[body] * (jacobian @ delta)
    assert momentum == pytest.approx(force, rel=1e-10, abs=1e-10)


@pytest.mark.parametrize("seed", range(6))
def test_derivatives_agree_with_differences_of_every_input(seed: int) -> None:
    function = function_of(QUADRUPED, ("back",))
    inputs = state_of(function, seed)
    exact, fresh = np.empty((2, function.n_outputs, function.n_inputs))
    function.exact_derivative(inputs, exact)
    function.derivative(inputs, fresh)
    h = 1e-5
    central = np.array(
        [
            (value(function, inputs + h * e) - value(function, inputs - h * e)) / (2 * h)
            for e in np.eye(function.n_inputs)
        ]
    ).T
    for of in (function.dynamics.slots.qpos, function.dynamics.slots.qvel, function.dynamics.slots.tau):
        scale = np.abs(central[:, of]).max()
        assert np.abs(exact - central)[:, of].max() < 2e-5 * scale
        assert np.abs(fresh - central)[:, of].max() < 2e-3 * scale  # forward differences


def test_the_exact_derivative_of_a_pendulum() -> None:
    function = function_of(PENDULUM)
    jacobian = np.empty((1, 3))
    function.exact_derivative(np.array([0.3, 0.2, 0.7]), jacobian)
    inertia = 2 / 5 * 2.0 * 0.05**2 + 2.0 * 0.25
    expected = np.array([-2.0 * 9.81 * 0.5 * np.cos(0.3), 0.0, 1.0]) / inertia
    assert jacobian[0] == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_turning_a_quaternion() -> None:
    """A turn by a small angle about each axis of the body, from any quaternion of any length."""
    q = np.array([0.3, -1.2, 0.7, 0.9])
    for k, axis in enumerate(np.eye(3)):
        moved = q.copy() / np.linalg.norm(q)
        mujoco().mju_quatIntegrate(moved, axis, 1e-7)
        step = moved * np.linalg.norm(q) - q
        assert turning(q) @ step == pytest.approx(1e-7 * axis, abs=1e-13), k


def test_a_kept_derivative_is_renewed_by_contacts_age_and_restarts() -> None:
    function = function_of(SPHERE, max_age=3)
    jacobian = np.empty((function.n_outputs, function.n_inputs))
    above = np.zeros(function.n_inputs)
    above[:4] = 0.0, 0.0, 0.15, 1.0
    below = above.copy()
    below[2] = 0.095
    for state, renewals in ((above, 1), (above, 1), (above, 1), (above, 2), (below, 3), (below, 3)):
        function.derivative(state, jacobian)
        assert function.renewals == renewals
    function.restart()
    function.derivative(below, jacobian)
    assert function.renewals == 4
    assert jacobian[2, 2] < -100.0  # the floor pushes back


def test_no_result_is_not_a_number_and_says_why() -> None:
    function = function_of(PENDULUM)
    assert np.isnan(value(function, np.array([np.inf, 0.0, 0.0]))).all()
    assert "not finite" in function.failure
    balls = "".join(f"<body pos='0 0 {0.01 * k}'><freejoint/><geom size='.1'/></body>" for k in range(20))
    crowd = function_of(f"<mujoco><size memory='60K'/><worldbody>{balls}</worldbody></mujoco>")
    inputs = np.zeros(crowd.n_inputs)
    inputs[crowd.dynamics.slots.qpos] = crowd.dynamics.model.qpos0
    assert np.isnan(value(crowd, inputs)).all()
    assert "memory" in crowd.failure
    inputs[2 : crowd.dynamics.slots.qpos.stop : 7] += np.arange(20.0)
    assert np.isfinite(value(crowd, inputs)).all()  # apart again


def test_states_of_actuators_are_ours() -> None:
    """An actuator with a first-order lag: its rate is (u - act) / T."""
    function = function_of(joints(actuator='<position joint="j" kp="3" timeconst="0.1"/>'))
    slots = function.dynamics.slots
    inputs = np.zeros(function.n_inputs)
    inputs[slots.act], inputs[slots.ctrl] = 0.2, 0.7
    outputs = value(function, inputs)
    assert outputs[1] == pytest.approx((0.7 - 0.2) / 0.1, rel=1e-12)
    free = inputs.copy()
    free[slots.act] = 0.0
    inertia = function.dynamics.model.dof_M0[0]
    assert outputs[0] - value(function, free)[0] == pytest.approx(3 * 0.2 / inertia, rel=1e-12)
