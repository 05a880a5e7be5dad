"""A body's functions in C give the same bits as those in Python, and leave to them what has no result."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import SolverOptions, translate
from arthur_acausal.mujoco import MujocoBody, native
from arthur_acausal.mujoco.function import BodyFunction
from arthur_acausal.mujoco.load import read
from arthur_acausal.mujoco.recipe import Recipe
from arthur_acausal.solve import native as callbacks
from tests.mujoco.models import PENDULUM, QUADRUPED, SPHERE, joints
from tests.mujoco.test_function import state_of

pytestmark = pytest.mark.skipif(native.library() is None, reason="no C compiler, or no headers of MuJoCo")

BALL = """
<mujoco><worldbody>
  <body>
    <joint name="ball" type="ball"/><geom size=".1" pos="0 0 -.5"/>
    <body pos="0 0 -1"><joint name="slide" type="slide" axis="0 0 1"/><geom size=".1"/></body>
  </body>
</worldbody></mujoco>"""


def pair(monkeypatch: pytest.MonkeyPatch, text: str, wrenches: tuple[str, ...] = ()) -> list[BodyFunction]:
    """The function in C, and the one in Python."""
    recipe = Recipe(read(text), wrenches=wrenches)
    c = BodyFunction(recipe, max_age=3)
    with monkeypatch.context() as patch:
        patch.setattr("arthur_acausal.mujoco.function.library", lambda: None)
        python = BodyFunction(recipe, max_age=3)
    assert c.native is not None
    assert python.native is None
    return [c, python]


@pytest.mark.parametrize(
    ("text", "wrenches"),
    [
        (QUADRUPED, ()),
        (QUADRUPED, ("back",)),
        (BALL, ()),
        (joints(actuator='<position joint="j" kp="3" timeconst="0.1"/>'), ()),
    ],
)
def test_same_bits(text: str, wrenches: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    functions = pair(monkeypatch, text, wrenches)
    random = np.random.default_rng(1)
    for seed in range(12):
        size = functions[0].n_inputs
        inputs = state_of(functions[0], seed // 2) if text is QUADRUPED else random.standard_normal(size)
        if seed == 6:
            inputs[-1] = np.nan
        shapes = ((functions[0].n_outputs,), *[(functions[0].n_outputs, size)] * 2)
        found = []
        for f in functions:
            out = [np.empty(shape) for shape in shapes]
            f.evaluate(inputs, out[0])
            f.derivative(inputs, out[1])
            if seed % 3 == 0:
                f.exact_derivative(inputs, out[2])
            if seed == 8:
                f.restart()
            found.append([o.tobytes() for o in out[: 2 + (seed % 3 == 0)]])
        assert found[0] == found[1]
        assert functions[0].failure == functions[1].failure
    assert functions[0].renewals == functions[1].renewals > 3


def test_errors_of_mujoco_are_told_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    balls = "".join(f"<body pos='0 0 {0.01 * k}'><freejoint/><geom size='.1'/></body>" for k in range(20))
    functions = pair(monkeypatch, f"<mujoco><size memory='60K'/><worldbody>{balls}</worldbody></mujoco>")
    inputs = np.zeros(functions[0].n_inputs)
    inputs[functions[0].dynamics.slots.qpos] = functions[0].dynamics.model.qpos0
    for lift in (0.0, np.arange(20.0)):
        inputs[2 : functions[0].dynamics.slots.qpos.stop : 7] += lift
        values = [np.empty(f.n_outputs) for f in functions]
        for f, value in zip(functions, values, strict=True):
            f.evaluate(inputs, value)
        assert values[0].tobytes() == values[1].tobytes()
        assert np.isnan(values[0]).all() == (np.ndim(lift) == 0)
    assert functions[0].failure == functions[1].failure != ""


@pytest.mark.parametrize(("text", "stop_time"), [(PENDULUM, 2.0), (SPHERE, 0.3)])
def test_a_run_has_the_same_bits(text: str, stop_time: float, monkeypatch: pytest.MonkeyPatch) -> None:
    solutions = []
    for c in (True, False):
        with monkeypatch.context() as patch:
            if not c:
                patch.setattr("arthur_acausal.mujoco.function.library", lambda: None)
                patch.setattr(callbacks.Native, "of", lambda *_: None)
            model = translate(MujocoBody(mjcf=text, observe=["energy"]), compile="always")
            solutions.append(model.simulate(stop_time, options=SolverOptions(rtol=1e-6, intervals=20)))
    one, two = solutions
    np.testing.assert_array_equal(one.values(one.paths), two.values(two.paths))
    for count in ("steps", "residual_evaluations", "jacobian_evaluations", "external_calls"):
        assert getattr(one.statistics, count) == getattr(two.statistics, count), count
