"""``CompiledDAE``: kernels and tables, all that a solver needs; ``Evaluator``: the kernels with their own buffers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np

from arthur_acausal.codegen.calls import Calls, Completion, ExternalCall, Need
from arthur_acausal.codegen.kernel import Kernel
from arthur_acausal.codegen.origins import Origins
from arthur_acausal.codegen.parameters import ParameterTable
from arthur_acausal.codegen.rates import RootsWithRates
from arthur_acausal.codegen.recovery import Recovery
from arthur_acausal.codegen.switching import RootsWithMargin
from arthur_acausal.codegen.tables import (
    Assignment,
    Attributes,
    BoolArray,
    FloatArray,
    Pattern,
    Relation,
    SampledBlock,
    StartEntry,
    WhenClause,
)
from arthur_acausal.errors import ParameterError, nearest_or_all
from arthur_acausal.transform.state_sets import StateSets
from arthur_acausal.units import to_si


@dataclass(frozen=True)
class CompiledDAE:
    """F(t, y, y', p, u, z, m) = 0: n rows for the unknowns y (states first, then torn algebraic variables).

    The vector p holds the parameters, then the start values of variables, then those of discrete variables.
    z are the discrete variables (zp: before the event), m the frozen truth values of the relations.
    ``ignored``: notes of start values that were given in vain.
    ``needs``: of "solving", what the derivatives by y' of states and by algebraic y take.
    ``starting``: the system that holds in place of this one while initial values are sought, where it is another. If
    it ``blends``, its p has one entry more: the part of homotopy's actual expressions.
    """

    name: str
    y_paths: list[str]
    differential: BoolArray
    row_labels: list[str]
    u_paths: list[str]
    u_default: FloatArray
    u_units: list[str]
    z_paths: list[str]
    relations: list[Relation]
    whens: list[WhenClause]
    assignments: list[Assignment]
    sparsity: Pattern
    init_sparsity: Pattern
    init_labels: list[str]
    nominal: FloatArray
    minimum: FloatArray
    maximum: FloatArray
    parameters: ParameterTable
    starts: list[StartEntry]
    start_aliases: dict[str, tuple[int, int]] = field(
        repr=False
    )  # variable path -> (number of the entry, sign)
    pivot_labels: list[str] = field(repr=False)
    functions: dict[str, ca.Function] = field(repr=False)
    calls: list[ExternalCall] = field(repr=False)
    needs: dict[str, Need] = field(repr=False)  # what functions take of the external ones, where they do
    recovery: Recovery = field(repr=False)
    origins: Origins = field(repr=False)
    samples: list[SampledBlock]
    relations_of_rates: bool
    sets: StateSets | None = field(repr=False)
    dummies: frozenset[int] = field(repr=False)
    blends: bool = False
    ignored: list[str] = field(default_factory=list, repr=False)
    starting: CompiledDAE | None = field(default=None, repr=False)

    @property
    def n(self) -> int:
        """The number of unknowns."""
        return len(self.y_paths)

    @property
    def n_init(self) -> int:
        """The number of conditions that hold at the start only."""
        return len(self.init_labels)

    @property
    def z_start(self) -> FloatArray:
        """Start values of the discrete variables for the default parameters."""
        return self.attributes(self.parameter_vector()).z_start

    def parameter_vector(
        self, overrides: Mapping[str, Any] | None = None, start: Mapping[str, Any] | None = None
    ) -> FloatArray:
        """Return p for given parameters and start values, by path: SI numbers, text with a unit, or quantities.

        Raises ParameterError for unknown paths, values out of bounds, and where a value makes the model singular.
        """
        p = self.parameters.vector(overrides)
        values = np.asarray(self.functions["starts"](p), dtype=float).reshape(-1)
        for path, value in (start or {}).items():
            number, sign = self._start_entry(path)
            values[number] = sign * to_si(value, self.starts[number].unit, path=path)
        full = np.concatenate([p, values, np.ones(int(self.blends))])
        pivots = np.asarray(self.functions["pivots"](full), dtype=float).reshape(-1)
        for value, label in zip(pivots.tolist(), self.pivot_labels, strict=True):
            if value == 0.0 or not np.isfinite(value):
                raise ParameterError(
                    f"{label}: its coefficient is {value:g} for these parameters",
                    cause="the equation was solved for this variable at translation",
                    remedy="use a small value instead of zero, or write the equation so that it does not vanish",
                )
        return full

    def ignored_starts(self, start: Mapping[str, Any] | None = None) -> list[str]:
        """Return notes of the start values that nothing uses: the model's, and a run's own."""
        given = [p for p in start or {} if self.starts[self._start_entry(p)[0]].index < 0]
        known = {note.partition(" ")[0] for note in self.ignored}
        return self.ignored + [f"{p}: it is computed from other unknowns" for p in given if p not in known]

    def _start_entry(self, path: str) -> tuple[int, int]:
        if path not in self.start_aliases:
            raise ParameterError(
                f"there is no start value of {path!r}",
                path=path,
                remedy=nearest_or_all(path, self.start_aliases),
            )
        return self.start_aliases[path]

    def attributes(self, p: FloatArray) -> Attributes:
        """Return start, fixed, nominal, min and max of y, and the start of z, for a vector from parameter_vector."""
        start = np.zeros(self.n)
        given = np.zeros(self.n, dtype=bool)
        fixed = np.zeros(self.n, dtype=bool)
        z_start = np.zeros(len(self.z_paths))
        origin = [" (no start value given)"] * self.n
        for entry in self.starts:
            if entry.sign == 0:
                z_start[entry.index] = p[entry.place]
            elif entry.index >= 0 and not np.isnan(p[entry.place]):
                start[entry.index] = entry.sign * p[entry.place]
                given[entry.index] = True
                own = entry.path == self.y_paths[entry.index]
                told = ", ".join(text for text in ("" if own else f"of {entry.path}", entry.where) if text)
                origin[entry.index] = f" ({told})" if told else ""
                fixed[entry.index] |= entry.fixed
        start = np.clip(start, self.minimum, self.maximum)
        return Attributes(start, fixed, given, self.nominal, self.minimum, self.maximum, z_start, origin)

    def completed(self, arguments: Sequence[FloatArray], name: str = "") -> list[FloatArray]:
        """Return the functions' arguments, a column a time, with what external functions give there.

        ``name``: of the function that they are for; default: of any, with all derivatives.
        """
        need = self.needs.get(name) if name else Need.all(self.calls, derivatives=True)
        return self.completion()(arguments, need)

    def completion(self, *, exact: bool = True) -> Completion:
        """Return what completes the functions' arguments at many points in several goes."""
        return Completion(self.calls, self.recovery.external_sizes, exact=exact)

    def evaluator(self) -> Evaluator:
        """Return the kernels with buffers of their own; one for each thread."""
        return Evaluator(self)


class Evaluator:
    """Kernels on pinned arrays: write the arguments, call, read the (always same) result array.

    t (1,), y, yp (n,), p, u, z, zp, m, cj (1,): see CompiledDAE.
    """

    def __init__(self, dae: CompiledDAE) -> None:
        self._dae = dae
        self._kernels: dict[str, Callable[[], FloatArray]] = {}
        size = {
            "t": 1,
            "y": dae.n,
            "yp": dae.n,
            "u": len(dae.u_paths),
            "z": len(dae.z_paths),
            "m": len(dae.relations),
        }
        self.t, self.y, self.yp, self.u, self.z, self.m = (np.zeros(k) for k in size.values())
        self.p = dae.parameter_vector()
        self.zp = np.zeros(len(dae.z_paths))
        self.cj = np.ones(1)
        self.u[:] = dae.u_default
        self._continuous = [self.t, self.y, self.yp, self.p, self.u, self.z, self.m]
        self.external: Calls | None = None
        if dae.calls:
            self._continuous += [np.zeros(size) for size in dae.recovery.external_sizes]
            self.external = Calls(dae.calls, dae.functions, self._continuous, *self._continuous[-2:])
        self.residual = self._kernel("residual")
        self.jacobian = self._kernel("jacobian", self.cj)
        self.roots = self._kernel("roots", self.zp)
        if dae.relations_of_rates:
            self.roots = RootsWithRates(dae, self, self.roots)
        if dae.sets is not None:
            entries = self._kernel("state_sets")
            self.roots = RootsWithMargin(self.roots, entries, dae.sets, dae.dummies, len(dae.relations))

    def _kernel(self, name: str, *further: FloatArray) -> Callable[[], FloatArray]:
        kernel = Kernel(self._dae.functions[name], [*self._continuous, *further])
        return kernel if self.external is None else self.external.before(kernel, self._dae.needs.get(name))

    def _lazy(self, name: str, *further: FloatArray) -> Callable[[], FloatArray]:
        """Return a kernel that not every run needs; made once."""
        if name not in self._kernels:
            self._kernels[name] = self._kernel(name, *further)
        return self._kernels[name]

    @property
    def jacobian_y(self) -> Callable[[], FloatArray]:
        """dF/dy, (nnz,) in the order of the DAE's sparsity."""
        return self._lazy("jacobian_y")

    @property
    def jacobian_yp(self) -> Callable[[], FloatArray]:
        """dF/dy', (nnz,) in the order of the DAE's sparsity."""
        return self._lazy("jacobian_yp")

    @property
    def conditions(self) -> Callable[[], FloatArray]:
        """The truth of each when's condition, (n_whens,)."""
        return self._lazy("conditions", self.zp)

    @property
    def when_values(self) -> Callable[[], FloatArray]:
        """The right-hand side of each assignment, (n_assignments,)."""
        return self._lazy("when_values", self.zp)

    @property
    def sample_inputs(self) -> Callable[[], FloatArray]:
        """The inputs of all sampled blocks, one after the other."""
        return self._lazy("sample_inputs")

    @property
    def sample_times(self) -> Callable[[], FloatArray]:
        """The periods of all sampled blocks [s], then their offsets [s]."""
        if "sample_times" not in self._kernels:
            self._kernels["sample_times"] = Kernel(self._dae.functions["sample_times"], [self.p])
        return self._kernels["sample_times"]

    def blamed(self, rows: Sequence[int]) -> list[str]:
        """Return the equations, as written, that make some rows of F not finite at the arguments as they are."""
        if "observed" not in self._kernels:
            self._kernels["observed"] = Kernel(self._dae.recovery.observed, self._continuous)
        return self._dae.origins.blamed(rows, self._kernels["observed"]())

    @property
    def initial(self) -> Callable[[], FloatArray]:
        """Residuals of the conditions at the start, (n_init,)."""
        return self._lazy("initial")

    @property
    def initial_jacobian(self) -> Callable[[], FloatArray]:
        """[dh/dy | dh/dy'] of the conditions at the start, in the order of the DAE's init_sparsity."""
        return self._lazy("initial_jacobian")


def pattern_of(matrix: ca.SX) -> Pattern:
    """Return the sparsity pattern of a CasADi matrix."""
    colind, row = matrix.sparsity().get_ccs()
    return Pattern(np.array(colind, dtype=np.int32), np.array(row, dtype=np.int32))


def as_bools(values: Sequence[bool]) -> BoolArray:
    """Return an array of truth values."""
    return np.array(values, dtype=bool)
