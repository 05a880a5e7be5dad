"""What the derivative of MuJoCo's accelerations costs and is worth: ``python -m benchmarks.mujoco_block [--json]``.

A quadruped of 18 degrees of freedom falls 5 cm onto its feet. Its derivative in Newton's matrix is computed at each
call (fresh), kept until contacts change or it is old (stale), or left out (none).
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from time import process_time
from typing import Any
from unittest.mock import patch

from arthur_acausal import Component, Equations, SimulationError, SolverOptions, connect, start, translate
from arthur_acausal.components.rotational import Fixed, SpringDamper
from arthur_acausal.mujoco import MujocoBody
from arthur_acausal.mujoco.dynamics import FloatArray
from arthur_acausal.mujoco.function import BodyFunction
from tests.mujoco.models import FEET, QUADRUPED

BENT = {"abd": 0.0, "hip": 0.5, "knee": -1.0}
Derivative = Callable[[BodyFunction, FloatArray, FloatArray], None]


class Falling(Component):
    """The quadruped on springs and dampers, above the floor."""

    def build(self) -> None:
        bent: dict[str, Any] = {f"{n}_{k}_phi": start(a) for n, *_ in FEET for k, a in BENT.items()}
        self.body = MujocoBody(mjcf=QUADRUPED, trunk_z=start(0.42), **bent)
        self.springs = [SpringDamper(c=60.0, d=1.5, phi_rel0=a) for _ in FEET for a in BENT.values()]
        self.ground = Fixed()

    def equations(self) -> Equations:
        names = [f"{n}_{k}" for n, *_ in FEET for k in BENT]
        for spring, name in zip(self.springs, names, strict=True):
            yield connect(self.ground.flange, spring.flange_a)
            yield connect(spring.flange_b, getattr(self.body, name))


def fresh(function: BodyFunction, inputs: FloatArray, jacobian: FloatArray) -> None:
    """Compute the derivative at each call."""
    function.restart()
    BLOCKS["stale"](function, inputs, jacobian)


def none(function: BodyFunction, inputs: FloatArray, jacobian: FloatArray) -> None:
    """Leave the derivative out."""
    jacobian.fill(0.0)


BLOCKS: dict[str, Derivative] = {"fresh": fresh, "stale": BodyFunction.derivative, "none": none}


def measure(rtol: float) -> list[dict[str, Any]]:
    """Run one second with each block."""
    model, found = translate(Falling()), []
    for name, derivative in BLOCKS.items():
        begun = process_time()
        row: dict[str, Any] = {"block": name, "rtol": rtol, "failed": False}
        try:
            with patch.object(BodyFunction, "derivative", derivative):
                solution = model.simulate(
                    1.0, options=SolverOptions(rtol=rtol, intervals=10, max_steps=20_000)
                )
        except SimulationError as error:
            solution, row["failed"] = error.solution, True
        run = solution.statistics
        row |= {
            "steps": run.steps,
            "rejected": run.rejected_steps,
            "residuals": run.residual_evaluations,
            "jacobians": run.jacobian_evaluations,
            "cpu_s": round(process_time() - begun, 3),
        }
        found.append(row)
    return found


def main() -> None:
    """Print a table, or one JSON object."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.mujoco_block", description=__doc__)
    parser.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    given = parser.parse_args()
    rows = [row for rtol in (1e-4, 1e-6) for row in measure(rtol)]
    if given.json:
        print(json.dumps({"runs": rows}))
    else:
        for row in rows:
            print("  ".join(f"{key} {value}" for key, value in row.items()))


if __name__ == "__main__":
    main()
