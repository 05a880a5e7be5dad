"""The callbacks in C and those in Python give the same results to the last bit, and meet trouble alike."""

from __future__ import annotations

import ctypes
import gc
import weakref
from pathlib import Path
from typing import Any

import casadi
import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SimulationError,
    Solution,
    SolverOptions,
    Table,
    compile_c,
    der,
    if_else,
    parameter,
    real_input,
    translate,
    variable,
)
from arthur_acausal.models.examples.bouncing_ball import BouncingBall
from arthur_acausal.models.examples.clutch_engagement import ClutchEngagement
from arthur_acausal.models.examples.dc_motor import DCMotor
from arthur_acausal.models.examples.jack import Jack
from arthur_acausal.models.examples.rc_ladder import RCLadder
from arthur_acausal.result.simulated import Interrupted
from arthur_acausal.solve import native
from tests.codegen.external_functions import FloatArray, Numeric
from tests.solve.test_external import Bouncing, Duffing, duffing

pytestmark = pytest.mark.skipif(native.extension() is None, reason="no C compiler, or no headers of Python")


class Root(Component):
    """T x' = -sqrt(x) - k: it has no value behind x = 0, into which trial states overstep."""

    T: Real = parameter("s", default=1.0)
    k: Real = parameter("1", default=1e-9)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -casadi.sqrt(self.x) * self.x - self.k


class Explosion(Component):
    """T x' = x^2."""

    T: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.x**2


def both(
    model: Component,
    stop_time: float,
    options: SolverOptions,
    monkeypatch: pytest.MonkeyPatch,
    inputs: dict[str, Any] | None = None,
) -> list[Solution | SimulationError]:
    translation = translate(model, compile="always")
    results: list[Solution | SimulationError] = []
    used: list[bool] = []
    real = native.Native.of

    def observed(*arguments: object) -> native.Native | None:
        found = real(*arguments)  # type: ignore[arg-type]
        used.append(found is not None)
        return found

    for of in (observed, lambda *_: None):
        with monkeypatch.context() as patch:
            patch.setattr(native.Native, "of", of)
            try:
                results.append(translation.simulate(stop_time, options=options, inputs=inputs))
            except SimulationError as error:
                results.append(error)
    assert all(used)
    assert used
    return results


@pytest.mark.parametrize(
    ("model", "stop_time", "options"),
    [
        (Jack(), 1.0, SolverOptions()),
        (DCMotor(), 1.0, SolverOptions(store_steps=True)),
        (BouncingBall(), 2.0, SolverOptions(rtol=1e-8)),
        (ClutchEngagement(), 2.0, SolverOptions()),
        (RCLadder(n=250), 1.0, SolverOptions()),  # the sparse solver
        (Root(), 30.0, SolverOptions(rtol=1e-3)),
    ],
)
def test_same_bits_and_counts(
    model: Component, stop_time: float, options: SolverOptions, monkeypatch: pytest.MonkeyPatch
) -> None:
    c, python = both(model, stop_time, options, monkeypatch)
    assert isinstance(c, Solution)
    assert isinstance(python, Solution)
    np.testing.assert_array_equal(c.t, python.t)
    np.testing.assert_array_equal(c.values(c.paths), python.values(c.paths))
    for name in (
        "steps",
        "rejected_steps",
        "residual_evaluations",
        "jacobian_evaluations",
        "root_evaluations",
    ):
        assert getattr(c.statistics, name) == getattr(python.statistics, name), name
    assert c.statistics.non_finite_residuals == python.statistics.non_finite_residuals


class Driven(Component):
    """T x' = u v - x, with an event where x passes the half."""

    T: Real = parameter("s", default=0.3)
    u: Real = real_input("1")
    v: Real = real_input("1")
    x: Real = variable("1", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.u * self.v - if_else(self.x > 0.5, 0.5, 1.0) * self.x


def test_inputs_that_vary(monkeypatch: pytest.MonkeyPatch) -> None:
    jump = Table([0.0, 0.7, 0.7, 2.0], [0.0, 1.0, 3.0, 2.0])
    inputs = {"u": jump, "v": lambda t: 1.0 + 0.2 * np.sin(9.0 * t)}
    c, python = both(Driven(), 2.0, SolverOptions(), monkeypatch, inputs)
    assert isinstance(c, Solution)
    assert isinstance(python, Solution)
    assert c.statistics.state_events > 0
    assert c.statistics.residual_evaluations == python.statistics.residual_evaluations
    np.testing.assert_array_equal(c.values(c.paths), python.values(python.paths))


@pytest.mark.parametrize(
    ("model", "options"),
    [(Explosion(), SolverOptions()), (Jack(), SolverOptions(max_steps=20))],
)
def test_failures_are_told_alike(
    model: Component, options: SolverOptions, monkeypatch: pytest.MonkeyPatch
) -> None:
    c, python = both(model, 2.0, options, monkeypatch)
    assert isinstance(c, SimulationError)
    assert isinstance(python, SimulationError)
    assert str(c) == str(python)
    np.testing.assert_array_equal(c.solution.t, python.solution.t)


def test_interrupt_keeps_what_was_computed() -> None:
    def progress(t: float) -> None:
        if t > 2.0:  # on a busy machine the first report comes with the first step
            raise KeyboardInterrupt

    translation = translate(Jack(), compile="always")
    with pytest.raises(Interrupted) as caught:
        translation.simulate(1e6, options=SolverOptions(max_step=1e-3, intervals=10**6), progress=progress)
    assert 0.0 < caught.value.solution.t[-1] < 1e6


def test_an_error_in_progress_passes() -> None:
    def progress(t: float) -> None:
        raise RuntimeError("mine")

    with pytest.raises(RuntimeError, match="mine"):
        translate(Jack(), compile="always").simulate(
            1e6, options=SolverOptions(max_step=1e-3, intervals=10**6), progress=progress
        )


def test_ida_calls_the_functions_directly_where_it_can(monkeypatch: pytest.MonkeyPatch) -> None:
    translation = translate(ClutchEngagement(), compile="always")
    attached: list[object] = []
    attach = native.Native.attach

    def observed(self: native.Native, engine: Any) -> None:
        attach(self, engine)
        attached.append(getattr(engine, "functions", None))

    monkeypatch.setattr(native.Native, "attach", observed)
    direct = translation.simulate(2.0)
    assert attached
    assert None not in attached
    monkeypatch.setattr(native, "_sundials", lambda: None)  # another version of the binding
    attached.clear()
    by_arrays = translation.simulate(2.0)
    assert not any(attached)
    np.testing.assert_array_equal(direct.values(direct.paths), by_arrays.values(by_arrays.paths))


SPRING = """
int evaluate(void *self, const double *in, double *out) {
  double *range = self;
  range[1] += 1.0;
  if (in[0] > range[0]) return 1;
  out[0] = in[0] - in[0] * in[0] * in[0] - 0.1 * in[1];
  return 0;
}
int derivative(void *self, const double *in, double *out) {
  out[0] = 1.0 - 3.0 * in[0] * in[0];
  out[1] = -0.1;
  return 0;
}
"""


class Spring:
    """The law of `Duffing` in C for s up to ``range``, beyond in Python; ``calls``: of it."""

    name, n_inputs, n_outputs = "spring", 2, 1

    def __init__(self, library: ctypes.CDLL, range: float) -> None:
        self._library, self.calls, self.copies = library, 0, list[Spring]()
        self.memory = np.array([range, 0.0])
        code = [ctypes.cast(f, ctypes.c_void_p).value or 0 for f in (library.evaluate, library.derivative)]
        self.native = (self.memory.ctypes.data, *code)

    def fresh(self) -> Spring:
        self.copies.append(Spring(self._library, float(self.memory[0])))
        return self.copies[-1]

    def evaluate(self, inputs: FloatArray, outputs: FloatArray) -> None:
        self.calls += 1
        s, v = inputs.tolist()
        outputs[0] = s - s * s * s - 0.1 * v

    def derivative(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        jacobian[0] = 1.0 - 3.0 * inputs[0] * inputs[0], -0.1


def test_external_functions_in_c_and_in_python(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = tmp_path / "spring.c"
    source.write_text(SPRING)
    library = compile_c(source)
    assert library is not None
    loaded = ctypes.CDLL(str(library))
    solutions, calls = [], []
    for law in (Spring(loaded, np.inf), Spring(loaded, 1.0), Numeric(duffing, 2, 1)):
        c, python = both(Duffing(function=law), 20.0, SolverOptions(rtol=1e-8), monkeypatch)
        assert isinstance(c, Solution)
        assert isinstance(python, Solution)
        np.testing.assert_array_equal(c.values(c.paths), python.values(python.paths))
        assert c.statistics.external_calls == python.statistics.external_calls > 100
        solutions.append(c)
        calls.append(law.copies[0].calls if isinstance(law, Spring) else 0)
        if isinstance(law, Spring):
            assert law.copies[0].memory[1] > 100
    assert 0 <= calls[0] < 10 < calls[1] < solutions[1].statistics.external_calls
    np.testing.assert_array_equal(solutions[0]["s"], solutions[1]["s"])
    assert np.max(np.abs(solutions[2]["s"] - solutions[0]["s"])) < 1e-6


def test_external_functions_and_events(monkeypatch: pytest.MonkeyPatch) -> None:
    law = Numeric(lambda x: -9.81 * (1.0 + 1e-3 * x[0]), 1, 1)
    c, python = both(Bouncing(function=law), 4.0, SolverOptions(rtol=1e-8), monkeypatch)
    assert isinstance(c, Solution)
    assert isinstance(python, Solution)
    assert c.statistics.state_events == python.statistics.state_events > 2
    np.testing.assert_array_equal(c.values(c.paths), python.values(python.paths))


def test_external_functions_meet_trouble_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    def raising(x: FloatArray) -> float:
        if x[0] > 0.5:
            raise ValueError("beyond the table")
        return 1.0

    for law in (raising, lambda x: np.sqrt(0.5 - x[0]) if x[0] < 0.5 else np.nan):
        c, python = both(Duffing(function=Numeric(law, 2, 1)), 10.0, SolverOptions(), monkeypatch)
        assert isinstance(c, SimulationError)
        assert isinstance(python, SimulationError)
        assert str(c) == str(python)
        np.testing.assert_array_equal(c.solution.t, python.solution.t)


def test_an_interrupt_within_an_external_function_keeps_what_was_computed() -> None:
    def law(x: FloatArray) -> float:
        if x[0] > 0.5:
            raise KeyboardInterrupt
        return 1.0

    translation = translate(Duffing(function=Numeric(law, 2, 1)), compile="always")
    with pytest.raises(Interrupted) as caught:
        translation.simulate(10.0)
    assert 0.0 < caught.value.solution["s"][-1] < 0.51


@pytest.mark.parametrize("model", [DCMotor(), BouncingBall()])
def test_a_run_leaves_nothing_behind(model: Component, monkeypatch: pytest.MonkeyPatch) -> None:
    translation = translate(model, compile="always")
    made: list[weakref.ref[native.Native]] = []
    real = native.Native.of

    def observed(*arguments: object) -> native.Native | None:
        found = real(*arguments)  # type: ignore[arg-type]
        assert found is not None
        made.append(weakref.ref(found))
        return found

    monkeypatch.setattr(native.Native, "of", observed)
    for _ in range(2):
        translation.simulate(0.1)
    gc.collect()
    assert [run() for run in made] == [None, None]
