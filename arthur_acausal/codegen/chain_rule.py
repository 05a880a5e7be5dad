"""Derivatives through external functions: dF/dx + dF/de D di/dx, as expressions with the numbers D as arguments."""

from __future__ import annotations

import casadi as ca
import numpy as np
from casadi import SX

from arthur_acausal.codegen.assemble import Assembly, lookup
from arthur_acausal.codegen.calls import ExternalCall, Need
from arthur_acausal.flatten.system import UNSHIFTED
from arthur_acausal.graph.blt import strongly_connected
from arthur_acausal.transform.structured import StructuredDAE


class ChainRule:
    """Total derivatives of expressions of a system, with all that its external calls pass on.

    ``inputs``: of each call, as expressions; ``order``: the calls, each behind those that it needs.
    """

    def __init__(self, dae: StructuredDAE, assembly: Assembly) -> None:
        self._calls, self._a = dae.flat.calls, assembly.arguments
        look = lookup(dae, assembly, before=False)
        self.inputs = [
            ca.vertcat(
                *[dae.evaluator(dae.nodes.expression(x, UNSHIFTED, c.text), look) for x in c.call.inputs],
                SX(0, 1),
            )
            for c in self._calls
        ]
        self.first = [c.call.first for c in self._calls]
        self.slope = np.cumsum([0, *(c.call.sparsity.size for c in self._calls)]).tolist()
        self.order = self._sorted()

    def _sorted(self) -> list[int]:
        needs = [[j for j in range(len(self._calls)) if self._takes(x, j)] for x in self.inputs]
        return [k for component in strongly_connected(needs) for k in component]

    def _takes(self, value: SX, k: int) -> bool:
        """Tell whether a value depends on an output of a call, or on a derivative of it."""
        first, last = self.first[k], self.first[k] + len(self._calls[k].call.sparsity)
        own = ca.vertcat(self._a.e[first:last], self._a.d[self.slope[k] : self.slope[k + 1]])
        return bool(own.numel() and ca.depends_on(value, own))

    def __call__(self, value: SX, x: SX, rates: SX | None = None, cj: SX | None = None) -> SX:
        """Return d value / d x, plus cj d value / d rates where these are given."""
        direct = self._direct(value, x, rates, cj)
        if not self._calls:
            return direct
        through = self._outputs(x, rates, cj)
        return direct + ca.jacobian(value, self._a.e) @ through

    def reaches(self, value: SX, x: SX) -> bool:
        """Tell whether a value depends on any of x, directly or through calls."""
        return bool(x.numel() and self(value, x).nnz())

    def need(self, value: SX) -> Need | None:
        """Return what of the external functions a value is computed from."""
        wanted: set[int] = set()
        for place in reversed(range(len(self.order))):
            k = self.order[place]
            if self._takes(value, k) or any(self._takes(self.inputs[self.order[p]], k) for p in wanted):
                wanted.add(place)
        derivatives = bool(wanted) and ca.depends_on(value, self._a.d)
        return Need(tuple(sorted(wanted)), derivatives) if wanted else None

    def calls(self) -> list[ExternalCall]:
        """Return the calls, in order."""
        made = []
        for k in self.order:
            flat = self._calls[k]
            function = ca.Function(f"call_{k}", self._a.continuous(), [ca.densify(self.inputs[k])])
            made.append(
                ExternalCall(
                    f"call_{k}",
                    flat.text,
                    flat.path,
                    flat.call.where,
                    flat.call.function,
                    function,
                    self.first[k],
                    self.slope[k],
                )
            )
        return made

    def _direct(self, value: SX, x: SX, rates: SX | None, cj: SX | None) -> SX:
        direct = ca.jacobian(value, x)
        return direct if rates is None or cj is None else direct + cj * ca.jacobian(value, rates)

    def _outputs(self, x: SX, rates: SX | None, cj: SX | None) -> SX:
        """Return the total derivative of all calls' outputs."""
        total = SX(self._a.e.numel(), x.numel())
        for k in self.order:
            inputs = self.inputs[k]
            slope = self._direct(inputs, x, rates, cj) + ca.jacobian(inputs, self._a.e) @ total
            pattern = self._calls[k].call.sparsity
            n, m = pattern.shape
            rows, columns = np.nonzero(pattern)
            by_rows = ca.reshape(self._a.d[self.slope[k] : self.slope[k + 1]], m, n).T
            own = ca.project(by_rows, ca.Sparsity.triplet(n, m, rows.tolist(), columns.tolist()))
            total[self.first[k] : self.first[k] + n, :] = own @ slope
        return total
