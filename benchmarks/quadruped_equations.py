"""The robot's equations as explicit rates, generated as C from our own model, with MuJoCo's accelerations as inputs.

    forces(t, x, z, a, w) -> MuJoCo's inputs: qpos, qvel, tau
    rates(t, x, z, a, w) -> w: x' and the algebraic unknowns, by one step of Newton's iteration from the given w
    slopes(t, x, z, a, w) -> d x' / d x (by rows), d tau / d x (by rows)

x are the states, z the discrete variables, a MuJoCo's accelerations. Parameters and modes are numbers: in the trot that
is compared no relation changes that the equations depend on. The w of the stage before is near enough for one step of
Newton's iteration to be exact to second order in the length of the time step.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import casadi as ca
import numpy as np

from benchmarks.quadruped_problem import Problem


@dataclass(frozen=True, slots=True)
class Explicit:
    """The three functions."""

    forces: ca.Function
    rates: ca.Function
    slopes: ca.Function


def explicit(trot: Problem) -> Explicit:
    """Return the rates of the trot's system with its parameters and the modes of its checkpoint."""
    dae, begin = trot.translation._plain, trot.begin
    mujoco = dae.calls[0]
    body = mujoco.function
    n, n_v, n_e = int(np.sum(dae.differential)), body.n_outputs, dae.recovery.external_sizes[0]
    sizes = (1, n, len(dae.z_paths), n_v, dae.n)
    t, x, z, a, guess = (ca.SX.sym(*named) for named in zip("txzaw", sizes, strict=True))
    w = ca.SX.sym("w", dae.n)
    e = ca.vertcat(a, ca.SX(n_e - n_v, 1))
    rest = (ca.SX(begin.p), ca.SX(0, 1), z, ca.SX(begin.m[-1]), e, ca.SX(dae.recovery.external_sizes[1], 1))
    yp, y = ca.vertcat(w[:n], ca.SX(dae.n - n, 1)), ca.vertcat(x, w[n:])
    residual = dae.functions["residual"](t, y, yp, *rest)
    forces = ca.substitute(dae.functions[mujoco.name](t, y, ca.SX(dae.n, 1), *rest), w, guess)
    matrix, value = (ca.substitute(f, w, guess) for f in (ca.jacobian(residual, w), residual))
    found = guess - solved(matrix, value)
    slots = body.dynamics.slots
    slopes = [ca.densify(ca.jacobian(f, x)).T for f in (found[:n], forces[slots.tau])]
    given = [t, x, z, a, guess]
    return Explicit(
        ca.Function("forces", given, [ca.densify(forces)]),
        ca.Function("rates", given, [ca.densify(found)]),
        ca.Function("slopes", given, slopes),
    )


def solved(matrix: ca.SX, value: ca.SX) -> ca.SX:
    """Return x with ``matrix`` x = ``value``, block by block of the matrix in block triangular form."""
    _, rows, columns, row_block, column_block, _, _ = matrix.sparsity().btf()
    ends = list(zip(pairwise(row_block), pairwise(column_block), strict=True))
    x = ca.SX(matrix.size2(), 1)
    # CasADi's form is lower triangular: the first block depends on none but itself
    for (r_0, r_1), (c_0, c_1) in ends:
        r, c = rows[r_0:r_1], columns[c_0:c_1]
        block = matrix[r, c]
        right = value[r] - matrix[r, :] @ x
        x[c] = right / block if len(r) == 1 else ca.solve(ca.densify(block), right)
    return x
