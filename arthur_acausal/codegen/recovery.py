"""Recovery: every variable of the model from what the integrator kept, aliases and eliminated ones included."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from arthur_acausal.codegen.calls import Completion, ExternalCall, Need
from arthur_acausal.errors import ResultError, nearest

FloatArray = NDArray[np.float64]

CHUNK = 200_000  # values of the observed function computed at once: bounds the memory


@dataclass(frozen=True, slots=True)
class Source:
    """Where a variable's value comes from: sign times column ``index`` of y, yp, u, z, p or the observed values."""

    kind: str  # "y", "yp", "u", "z", "p", "observed", "zero"
    index: int
    sign: int


@dataclass(frozen=True)
class Recovery:
    """``observe`` gives any variable or parameter of the model by its path.

    ``observed``: CasADi function of (t, y, yp, p, u, z, m) with the eliminated variables as one column;
    ``interpolated``: which of them depend on y' or on algebraic unknowns, which the integrator only interpolates;
    ``n_states``: y from here on is algebraic; ``calls``: the external functions, ``external``: which eliminated
    variables depend on these.
    """

    paths: list[str]
    sources: list[Source]
    units: list[str]
    displays: list[str | None]
    descriptions: list[str]
    observed: ca.Function = field(repr=False)
    interpolated: NDArray[np.bool_] = field(repr=False)
    n_states: int
    calls: list[ExternalCall] = field(repr=False)
    external: NDArray[np.bool_] = field(repr=False)

    @cached_property
    def external_sizes(self) -> tuple[int, int]:
        """How many outputs and derivatives external functions have."""
        return (self.observed.size1_in(7), self.observed.size1_in(8)) if self.calls else (0, 0)

    @cached_property
    def _completion(self) -> Completion:
        return Completion(self.calls, self.external_sizes)

    @cached_property
    def number(self) -> dict[str, int]:
        """Path -> number."""
        return {path: i for i, path in enumerate(self.paths)}

    def find(self, path: str) -> int:
        """Return the number of a path; ResultError with the nearest ones where there is none."""
        if path not in self.number:
            raise ResultError(f"there is no variable {path!r}", remedy=nearest(path, self.paths))
        return self.number[path]

    def needs_refinement(self, paths: Sequence[str]) -> bool:
        """Tell whether a variable is more than a function of states, inputs, discretes and parameters."""
        for path in paths:
            source = self.sources[self.find(path)]
            if source.kind == "yp" or (source.kind == "y" and source.index >= self.n_states):
                return True
            if source.kind == "observed" and self.interpolated[source.index]:
                return True
        return False

    def observe(
        self,
        paths: Sequence[str],
        t: FloatArray,
        y: FloatArray,
        yp: FloatArray,
        p: FloatArray,
        u: FloatArray,
        z: FloatArray,
        m: FloatArray,
    ) -> FloatArray:
        """Return the values (nt, len(paths)) of the named variables; rows of the arguments are times."""
        sources = [self.sources[self.find(path)] for path in paths]
        wanted = sorted({s.index for s in sources if s.kind == "observed"})
        observed = self.evaluate(wanted, t, y, yp, p, u, z, m)
        column = {index: k for k, index in enumerate(wanted)}
        tables = {"y": y, "yp": yp, "u": u, "z": z}
        result = np.zeros((len(t), len(paths)))
        for k, source in enumerate(sources):
            kind, index, sign = source.kind, source.index, source.sign
            if kind == "observed":
                result[:, k] = sign * observed[:, column[index]]
            elif kind == "p":
                result[:, k] = sign * p[index]
            elif kind != "zero":
                result[:, k] = sign * tables[kind][:, index]
        return result

    def evaluate(
        self,
        wanted: list[int],
        t: FloatArray,
        y: FloatArray,
        yp: FloatArray,
        p: FloatArray,
        u: FloatArray,
        z: FloatArray,
        m: FloatArray,
    ) -> FloatArray:
        """Return the eliminated variables (nt, len(wanted)) of the given numbers."""
        out = np.zeros((len(t), len(wanted)))
        if not wanted or not len(t):
            return out
        step = max(1, CHUNK // max(1, self.observed.size1_out(0)))
        for first in range(0, len(t), step):
            part = slice(first, first + step)
            count = len(t[part])
            same = np.repeat(p.reshape(-1, 1), count, axis=1)
            arguments = (t[part].reshape(1, -1), y[part].T, yp[part].T, same, u[part].T, z[part].T, m[part].T)
            need = Need.all(self.calls) if self.external[wanted].any() else None
            complete = self._completion(arguments, need)
            values = np.asarray(self.observed.map(count)(*complete), dtype=float)
            out[part] = values[wanted].T
        return out
