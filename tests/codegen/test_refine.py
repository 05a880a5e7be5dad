"""What refinement asks of external functions, and that the outputs fulfil the equations to rounding."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from arthur_acausal import Component, Equations, Real, SolverOptions, der, external, translate, variable
from arthur_acausal.codegen.refine import Rows, refine


class Cubic:
    """x^3 + x, and a count of what is asked of it. Its derivative is of the point before until it is renewed."""

    name, n_inputs, n_outputs = "Cubic", 1, 1

    def __init__(self, asked: dict[str, int]) -> None:
        self.asked, self._slope = asked, 0.0

    def fresh(self) -> Cubic:
        return Cubic(self.asked)

    def restart(self) -> None:
        self._slope = 0.0

    def evaluate(self, inputs: Any, outputs: Any) -> None:
        outputs[:] = inputs**3 + inputs

    def derivative(self, inputs: Any, jacobian: Any) -> None:
        self.asked["derivative"] += 1
        self._slope = self._slope or 3.0 * float(inputs[0]) ** 2 + 1.0
        jacobian[:] = self._slope

    def exact_derivative(self, inputs: Any, jacobian: Any) -> None:
        self.asked["exact"] += 1
        jacobian[:] = 3.0 * inputs**2 + 1.0


class Loop(Component):
    """x' = -F where F == f(x - F / 2), an algebraic loop through the function; or F == f(x), none."""

    asked: Any
    looped: bool
    x: Real = variable("1", start=3.0, fixed=True)
    F: Real = variable("1")

    def equations(self) -> Equations:
        argument = self.x - self.F / 2 if self.looped else self.x
        yield external(Cubic(self.asked), inputs=[argument], outputs=[self.F])
        yield der(self.x) == -self.F


@pytest.mark.parametrize("looped", [True, False])
def test_a_function_is_differentiated_once_a_stored_point_where_a_loop_goes_through_it(looped: bool) -> None:
    asked = {"derivative": 0, "exact": 0}
    model = translate(Loop(asked=asked, looped=looped), check_units=False)
    solution = model.simulate(1.0, options=SolverOptions(intervals=40))
    x = solution.pieces[0].trajectory
    asked.update(derivative=0, exact=0)
    spoilt = x.y.copy()
    spoilt[:, ~model.dae.differential] *= 1.0 + 1e-3
    y, _ = refine(model.dae, Rows(x.t, spoilt, x.yp * (1.0 + 1e-3), x.p, x.u, x.z, x.m))
    assert asked == {"derivative": len(x.t) if looped else 0, "exact": 0}
    if not looped:
        return
    force = solution["F"]
    argument = solution["x"] - force / 2
    assert np.abs(force - argument**3 - argument).max() < 1e-13 * np.abs(force).max()
    kept = model.dae.y_paths.index(next(p for p in model.dae.y_paths if p != "x"))
    assert y[:, kept] == pytest.approx(solution[model.dae.y_paths[kept]], rel=1e-13)
