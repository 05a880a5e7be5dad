"""The sensitivity equations of a smooth stretch of a run, beside the model's own, as a system for the solver.

F(t, y, y', p, u, z, m) = 0 and, for each parameter theta, F_y s + F_y' s' + F_p dp/dtheta + F_z dz/dtheta = 0 for
s = dy/dtheta; relations and discrete variables are held. Unknowns: y, then s of each parameter.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from casadi import SX

from arthur_acausal.codegen.compiled import CompiledDAE, pattern_of
from arthur_acausal.codegen.kernel import Kernel
from arthur_acausal.codegen.tables import Attributes, BoolArray, FloatArray, IntArray, Pattern


@dataclass(frozen=True, slots=True)
class Augmentation:
    """The compiled sensitivity equations of a model for k parameters; ``dae`` is not compiled to machine code.

    The functions take (t, y, y', p, u, z, m, dp, dz): dp (n_p, k) and dz (n_z, k) are the derivatives of parameters
    and discrete variables by the chosen parameters.
    """

    dae: CompiledDAE
    k: int
    residual: ca.Function
    jacobian: ca.Function
    jacobian_y: ca.Function
    jacobian_yp: ca.Function
    sparsity: Pattern
    n_p: int

    @classmethod
    def of(cls, dae: CompiledDAE, k: int) -> Augmentation:
        """Differentiate the model's equations."""
        n, f = dae.n, dae.functions["residual"]
        sizes = [f.size1_in(i) for i in range(f.n_in())]
        names = ("t", "y", "yp", "p", "u", "z", "m")
        t, y, yp, p, u, z, m = own = [SX.sym(name, size) for name, size in zip(names, sizes, strict=True)]
        s, sp = SX.sym("s", n, k), SX.sym("sp", n, k)
        dp, dz = SX.sym("dp", len(dae.parameters.infos), k), SX.sym("dz", sizes[5], k)
        value = f(*own)
        parameters = p[: len(dae.parameters.infos)]
        rows = [value]
        for j in range(k):
            along = ca.vertcat(y, yp, parameters, z)
            direction = ca.vertcat(s[:, j], sp[:, j], dp[:, j], dz[:, j])
            rows.append(ca.jtimes(value, along, direction))
        whole = ca.cse(ca.vertcat(*rows))
        y_all, yp_all = ca.vertcat(y, ca.vec(s)), ca.vertcat(yp, ca.vec(sp))
        dy, dyp = ca.jacobian(whole, y_all), ca.jacobian(whole, yp_all)
        cj = SX.sym("cj")
        both = ca.cse(dy + cj * dyp)
        arguments = [t, y_all, yp_all, p, u, z, m, ca.vec(dp), ca.vec(dz)]
        make = ca.Function
        return cls(
            dae,
            k,
            make("residual", arguments, [whole]),
            make("jacobian", [*arguments, cj], [both]),
            make("jacobian_y", arguments, [ca.project(dy, both.sparsity())]),
            make("jacobian_yp", arguments, [ca.project(dyp, both.sparsity())]),
            pattern_of(both),
            len(dae.parameters.infos),
        )


class StretchEvaluator:
    """Kernels of a stretch; discrete variables and relations are held, so the solver sees none."""

    def __init__(self, stretch: Stretch) -> None:
        a, point = stretch.augmentation, stretch.point
        n = stretch.n
        self.t, self.y, self.yp, self.u, self.cj = (
            np.zeros(size) for size in (1, n, n, len(stretch.u_paths), 1)
        )
        self.cj[0] = 1.0
        self.p = point.p.copy()
        self.z = self.zp = self.m = np.zeros(0)
        held = (point.z.copy(), point.m.copy(), _column(stretch.dp), _column(stretch.dz))
        arguments = [self.t, self.y, self.yp, self.p, self.u, *held]
        self.residual = Kernel(a.residual, arguments)
        self.jacobian = Kernel(a.jacobian, [*arguments, self.cj])
        self.jacobian_y = Kernel(a.jacobian_y, arguments)
        self.jacobian_yp = Kernel(a.jacobian_yp, arguments)
        self.initial_jacobian = self.initial = self.nothing
        self.roots = self.conditions = self.when_values = self.nothing
        self.sample_inputs = self.sample_times = self.nothing
        self.external = None
        self._labels = stretch.row_labels

    def blamed(self, rows: Sequence[int]) -> list[str]:
        """Return the names of rows."""
        return [self._labels[i] for i in rows]

    def nothing(self) -> FloatArray:
        """No relations, clauses, samples or initial conditions: every state is given."""
        return self.z


def _column(matrix: FloatArray) -> FloatArray:
    return np.ascontiguousarray(matrix.reshape(-1, order="F"))


@dataclass(frozen=True, slots=True)
class Point:
    """Parameters, discrete variables and relations that are held over a stretch."""

    p: FloatArray
    z: FloatArray
    m: FloatArray


class Stretch:
    """A smooth stretch of a run as the solver wants a model: from given y and s; see solve.protocol."""

    def __init__(
        self,
        augmentation: Augmentation,
        point: Point,
        dp: FloatArray,
        dz: FloatArray,
        start: FloatArray,
        nominal: FloatArray,
    ) -> None:
        dae, k = augmentation.dae, augmentation.k
        self.augmentation, self.point, self.dp, self.dz = augmentation, point, dp, dz
        self.name = dae.name
        self.n = dae.n * (k + 1)
        self.y_paths: Sequence[str] = [*dae.y_paths, *(f"d{j}({p})" for j in range(k) for p in dae.y_paths)]
        self.row_labels = [
            *dae.row_labels,
            *(f"sensitivity of {r}" for _ in range(k) for r in dae.row_labels),
        ]
        self.differential: BoolArray = np.tile(dae.differential, k + 1)
        self.u_paths, self.u_default = dae.u_paths, dae.u_default
        self.z_paths: list[str] = []
        self.blends, self.starting = False, None
        self.relations: list[Any] = []
        self.whens: list[Any] = []
        self.assignments: list[Any] = []
        self.samples: list[Any] = []
        self.sparsity = augmentation.sparsity
        self.init_sparsity = Pattern(np.zeros(2 * self.n + 1, dtype=np.int32), np.zeros(0, dtype=np.int32))
        self.n_init = 0
        self.init_labels: list[str] = []
        self._start, self._nominal = start, nominal

    def parameter_vector(
        self, overrides: Mapping[str, Any] | None = None, start: Mapping[str, Any] | None = None
    ) -> FloatArray:
        """Return the parameters of the run; they are given already."""
        return self.point.p

    def ignored_starts(self, start: Mapping[str, Any] | None = None) -> list[str]:
        """Return none: all of them count."""
        return []

    def attributes(self, p: FloatArray) -> Attributes:
        """Return attributes: all states start where the stretch begins."""
        n = self.n
        none, all_of = np.full(n, -np.inf), np.ones(n, dtype=bool)
        fixed: BoolArray = self.differential
        return Attributes(self._start, fixed, all_of, self._nominal, none, -none, np.zeros(0), [""] * n)

    def evaluator(self) -> StretchEvaluator:
        """Return kernels with buffers of their own."""
        return StretchEvaluator(self)


def places(pattern: Pattern) -> tuple[IntArray, IntArray]:
    """Return rows and columns of a pattern's entries."""
    columns = np.repeat(np.arange(len(pattern.colind) - 1, dtype=np.int32), np.diff(pattern.colind))
    return pattern.row, columns
