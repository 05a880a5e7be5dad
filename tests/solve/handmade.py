"""A compiled model made by hand from CasADi expressions: the solver's tests need nothing else of the pipeline.

x, v = state("x", start=1.0, fixed=True), state("v")
dae = handmade([x, v], equations={"kinematics": der(x) - v, "spring": der(v) + x})
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import casadi
import numpy as np

from arthur_acausal.solve.protocol import BoolArray, FloatArray, IntArray

TIME = casadi.SX.sym("time")


@dataclass(eq=False)
class Variable:
    """A state, algebraic variable, discrete variable, input or parameter."""

    path: str
    kind: str
    start: float = 0.0
    fixed: bool = False
    given: bool = False
    nominal: float = 1.0
    min: float = -np.inf
    max: float = np.inf
    s: Any = None
    d: Any = None

    def __post_init__(self) -> None:
        self.s = casadi.SX.sym(self.path)
        self.d = casadi.SX.sym(("der(" if self.kind == "state" else "pre(") + self.path + ")")


def state(path: str, start: float | None = None, **attributes: Any) -> Variable:
    return Variable(path, "state", start or 0.0, given=start is not None, **attributes)


def algebraic(path: str, start: float | None = None, **attributes: Any) -> Variable:
    return Variable(path, "algebraic", start or 0.0, given=start is not None, **attributes)


def discrete(path: str, start: float = 0.0) -> Variable:
    return Variable(path, "discrete", start)


def external(path: str, default: float = 0.0) -> Variable:
    return Variable(path, "input", default)


@dataclass(eq=False)
class Relation:
    """g > 0, or g >= 0 if inclusive; `s` stands for its truth value in the equations."""

    label: str
    g: Any
    inclusive: bool = False
    time_only: bool = False
    where: str = "test.py:1"
    path: str = "part"
    s: Any = None

    def __post_init__(self) -> None:
        self.s = casadi.SX.sym(f"m({self.label})")


@dataclass(eq=False)
class Assignment:
    kind: str
    index: int
    when: int
    message: str = ""
    value: Any = 0.0


@dataclass(eq=False)
class When:
    """A condition and what it does: `reinit(x, value)`, `assign(z, value)` or `terminate(message)`."""

    label: str
    condition: Any
    actions: Sequence[tuple[str, Variable | None, Any]]
    where: str = "test.py:2"
    earlier: int = 0
    initial: bool = False
    path: str = "part"


def reinit(x: Variable, value: Any) -> tuple[str, Variable | None, Any]:
    return "state", x, value


def assign(z: Variable, value: Any) -> tuple[str, Variable | None, Any]:
    return "discrete", z, value


def terminate(message: str) -> tuple[str, Variable | None, Any]:
    return "terminate", None, message


@dataclass
class Attributes:
    start: FloatArray
    fixed: BoolArray
    start_given: BoolArray
    nominal: FloatArray
    min: FloatArray
    max: FloatArray
    z_start: FloatArray
    origin: Sequence[str]


@dataclass
class Pattern:
    colind: IntArray
    row: IntArray

    @classmethod
    def of(cls, matrix: Any) -> Pattern:
        sparsity = matrix.sparsity()
        return cls(np.array(sparsity.colind(), np.int32), np.array(sparsity.row(), np.int32))


class Kernel:
    """A CasADi function with pinned argument and result arrays."""

    def __init__(self, name: str, arguments: Sequence[tuple[Any, FloatArray]], result: Any) -> None:
        result = casadi.SX(result)
        self._function = casadi.Function(name, [casadi.densify(a) for a, _ in arguments], [result])
        self.out = np.zeros(max(result.nnz(), 0))
        self._arguments = [array for _, array in arguments]
        self._buffer: Any
        self._buffer, self._trigger = self._function.buffer()
        for k, array in enumerate(self._arguments):
            self._buffer.set_arg(k, array.data)
        self._buffer.set_res(0, self.out.data)

    def __call__(self) -> FloatArray:
        if self.out.size:
            self._trigger()
        return self.out


@dataclass
class Handmade:
    """See `arthur_acausal.solve.protocol.DAE`."""

    variables: Sequence[Variable]
    equations: Mapping[str, Any]
    initial: Mapping[str, Any] = field(default_factory=dict)
    relations: Sequence[Relation] = ()
    whens: Sequence[When] = ()
    always: Sequence[tuple[Variable, Any]] = ()
    samples: Sequence[Any] = ()
    parameters: Mapping[str, tuple[Any, float]] = field(default_factory=dict)
    name: str = "handmade"
    starting: Handmade | None = None
    blends: bool = False

    def __post_init__(self) -> None:
        self.ys = [v for v in self.variables if v.kind in ("state", "algebraic")]
        self.us = [v for v in self.variables if v.kind == "input"]
        self.zs = [v for v in self.variables if v.kind == "discrete"]
        self.n = len(self.ys)
        self.y_paths = [v.path for v in self.ys]
        self.differential: BoolArray = np.array([v.kind == "state" for v in self.ys], dtype=bool)
        self.row_labels = list(self.equations)
        self.u_paths, self.u_default = [v.path for v in self.us], np.array([v.start for v in self.us])
        self.z_paths = [v.path for v in self.zs]
        self._starts = {v.path: casadi.SX.sym(f"start({v.path})") for v in [*self.ys, *self.zs]}
        fixed = [(f"fixed start of {v.path}", v.s - self._starts[v.path]) for v in self.ys if v.fixed]
        self.h = [*self.initial.values(), *(value for _, value in fixed)]
        self.init_labels = [*self.initial, *(label for label, _ in fixed)]
        self.n_init = len(self.h)
        self.assignments = self._assignments()
        self._y, self._yp = _column(v.s for v in self.ys), _column(v.d for v in self.ys)
        F = _column(self.equations.values())
        cj = casadi.SX.sym("cj")
        self._cj, self._F = cj, F
        self._J_y, self._J_yp = casadi.jacobian(F, self._y), casadi.jacobian(F, self._yp)
        self._J = self._J_y + cj * self._J_yp
        self.sparsity = Pattern.of(self._J)
        self._J_init = casadi.jacobian(_column(self.h), casadi.vertcat(self._y, self._yp))
        self.init_sparsity = Pattern.of(self._J_init)

    def _assignments(self) -> list[Assignment]:
        found = []
        for number, when in enumerate(self.whens):
            for kind, target, value in when.actions:
                if target is None:
                    found.append(Assignment(kind, -1, number, str(value)))
                else:
                    place = (self.ys if kind == "state" else self.zs).index(target)
                    found.append(Assignment(kind, place, number, value=value))
        return found + [Assignment("discrete", self.zs.index(z), -1, value=value) for z, value in self.always]

    def parameter_vector(
        self, overrides: Mapping[str, Any] | None = None, start: Mapping[str, Any] | None = None
    ) -> FloatArray:
        """The parameters, then the start values of y and z."""
        overrides, start = overrides or {}, start or {}
        values = [float(overrides.get(name, value)) for name, (_, value) in self.parameters.items()]
        starts = [float(start.get(v.path, v.start)) for v in [*self.ys, *self.zs]]
        return np.array(values + starts)

    def p_symbols(self) -> list[Any]:
        """The symbols behind `parameter_vector`."""
        return [*(symbol for symbol, _ in self.parameters.values()), *self._starts.values()]

    def ignored_starts(self, start: Mapping[str, Any] | None = None) -> list[str]:
        return []

    def attributes(self, p: FloatArray) -> Attributes:
        ys, starts = self.ys, p[len(self.parameters) :]
        return Attributes(
            starts[: self.n].copy(),
            np.array([v.fixed for v in ys], dtype=bool),
            np.array([v.given for v in ys], dtype=bool),
            np.array([v.nominal for v in ys]),
            np.array([v.min for v in ys]),
            np.array([v.max for v in ys]),
            starts[self.n :].copy(),
            [""] * self.n,
        )

    def evaluator(self) -> HandmadeEvaluator:
        return HandmadeEvaluator(self)


class HandmadeEvaluator:
    """See `arthur_acausal.solve.protocol.Evaluator`."""

    def __init__(self, dae: Handmade) -> None:
        n, nz = dae.n, len(dae.zs)
        self.t, self.cj = np.zeros(1), np.zeros(1)
        self.y, self.yp = np.zeros(n), np.zeros(n)
        self.p, self.u = dae.parameter_vector(), np.zeros(len(dae.us))
        self.z, self.zp, self.m = np.zeros(nz), np.zeros(nz), np.zeros(len(dae.relations))
        arguments = [
            (TIME, self.t),
            (dae._y, self.y),
            (dae._yp, self.yp),
            (_column(dae.p_symbols()), self.p),
            (_column(v.s for v in dae.us), self.u),
            (_column(v.s for v in dae.zs), self.z),
            (_column(v.d for v in dae.zs), self.zp),
            (_column(r.s for r in dae.relations), self.m),
            (dae._cj, self.cj),
        ]
        full = casadi.Sparsity(dae._J.sparsity())
        self.residual = Kernel("residual", arguments, casadi.densify(dae._F))
        self.jacobian = Kernel("jacobian", arguments, dae._J)
        self.jacobian_y = Kernel("jacobian_y", arguments, casadi.project(dae._J_y, full))
        self.jacobian_yp = Kernel("jacobian_yp", arguments, casadi.project(dae._J_yp, full))
        self.roots = Kernel("roots", arguments, casadi.densify(_column(r.g for r in dae.relations)))
        conditions = [when.condition for when in dae.whens]
        self.conditions = Kernel("conditions", arguments, casadi.densify(_column(conditions)))
        values = [a.value for a in dae.assignments]
        self.when_values = Kernel("when_values", arguments, casadi.densify(_column(values)))
        self.sample_inputs = Kernel("sample_inputs", arguments, casadi.densify(_column([])))
        self.external = None
        self.sample_times = Kernel("sample_times", arguments, casadi.densify(_column([])))
        self.initial = Kernel("initial", arguments, casadi.densify(_column(dae.h)))
        self.initial_jacobian = Kernel("initial_jacobian", arguments, dae._J_init)
        self._labels = dae.row_labels

    def blamed(self, rows: Sequence[int]) -> list[str]:
        return [self._labels[i] for i in rows]


def _column(values: Any) -> Any:
    items = [casadi.SX(value) for value in values]
    return casadi.vertcat(*items) if items else casadi.SX.zeros(0, 1)


def handmade(variables: Sequence[Variable], equations: Mapping[str, Any], **rest: Any) -> Handmade:
    """The model: all variables, and the residuals by label."""
    return Handmade(variables, equations, **rest)
