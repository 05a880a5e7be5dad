"""Power through connectors, and the balance of each component: what enters by its connectors stays or becomes heat."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise

import casadi as ca
import numpy as np

from arthur_acausal.declare.model import Component, Connector
from arthur_acausal.declare.scope import Atom, using
from arthur_acausal.errors import ResultError, nearest_or_all
from arthur_acausal.flatten.balance import connectors_of, parts_of
from arthur_acausal.flatten.block import make_expression
from arthur_acausal.flatten.connections import path_of
from arthur_acausal.flatten.system import FlatSystem
from arthur_acausal.result.interpolate import FloatArray
from arthur_acausal.transform.structured import StructuredDAE

Fetch = Callable[[str], FloatArray]


@dataclass(frozen=True, slots=True)
class PowerBalance:
    """The powers that enter a component by its connectors.

    ``powers``: path of a connector -> power (nt,) [W] into the component over the times ``t`` [s]. Connectors that
    carry no power, or whose class does not say, are left out.
    """

    t: FloatArray
    powers: Mapping[str, FloatArray]

    @property
    def total(self) -> FloatArray:
        """The sum (nt,) [W]: what the component stores or turns to heat at each time."""
        return np.asarray(np.sum([np.zeros(len(self.t)), *self.powers.values()], axis=0), dtype=np.float64)

    @property
    def energies(self) -> dict[str, float]:
        """The energy [J] that enters by each connector over the run, by the trapezoidal rule on the stored times."""
        return {path: float(np.trapezoid(power, self.t)) for path, power in self.powers.items()}

    @property
    def energy(self) -> float:
        """The energy [J] that enters by all connectors together."""
        return sum(self.energies.values())


class Powers:
    """The powers of all connectors of a model, computed from a solution's values when they are asked for."""

    def __init__(self, flat: FlatSystem, structured: StructuredDAE) -> None:
        self._flat, self._structured = flat, structured
        self._components = {path_of(c): c for c in flat.components}

    def power(self, path: str, t: FloatArray, fetch: Fetch) -> FloatArray:
        """Return the power (nt,) [W] into the component that a connector belongs to."""
        found = self._connectors()
        if path not in found:
            raise ResultError(f"there is no connector {path!r}", remedy=nearest_or_all(path, found))
        value = self._value(found[path], t, fetch)
        if value is None:
            raise ResultError(
                f"{path}: {type(found[path]).__name__} does not say what its power is",
                remedy="give the connector's class a method power(self) that returns it",
            )
        return value

    def balance(self, path: str, t: FloatArray, fetch: Fetch) -> PowerBalance:
        """Return the powers into a component, "" for the whole model."""
        if path not in self._components:
            remedy = nearest_or_all(path, [p for p in self._components if p])
            raise ResultError(f"there is no component {path!r}", remedy=remedy)
        values = {
            path_of(c): value
            for c in connectors_of(self._components[path])
            if (value := self._value(c, t, fetch)) is not None
        }
        return PowerBalance(t, values)

    def parts(self) -> list[str]:
        """Return the paths of the whole model's own parts."""
        return [path_of(part) for part in parts_of(self._flat.components[0])]

    def leaves(self) -> list[str]:
        """Return the paths of the components without parts: together they exchange all power that there is."""
        return [path for path, c in self._components.items() if not parts_of(c)]

    def _connectors(self) -> dict[str, Connector]:
        every: list[Component] = list(self._components.values())
        return {path_of(connector): connector for c in every for connector in connectors_of(c)}

    def _value(self, connector: Connector, t: FloatArray, fetch: Fetch) -> FloatArray | None:
        scope = self._flat.scope
        with using(scope):
            power = connector.power()
        if power is None:
            return None
        expression = make_expression(ca.SX(power), connector._where, scope)
        columns = np.array([self._atom(atom, t, fetch) for atom in expression.atoms])
        formula = ca.Function("power", [ca.vertcat(*expression.symbols)], [expression.value])
        return np.asarray(formula.map(len(t))(columns), dtype=np.float64).reshape(-1)

    def _atom(self, atom: Atom, t: FloatArray, fetch: Fetch) -> FloatArray:
        """Return the values (nt,) of a variable, a parameter, or a derivative."""
        scope = self._flat.scope
        if atom.kind == "parameter":
            return fetch(scope.parameter[self._flat.parameter(atom.number)].path)
        path = scope.variable[atom.number].path
        if atom.kind != "der":
            return fetch(path)
        nodes = self._structured.nodes
        ref = nodes.of_variable(atom.number)
        if ref.kind == "zero":
            return np.zeros(len(t))
        if ref.kind == "node" and nodes.derivative[ref.number] >= 0:
            return ref.sign * fetch(nodes.name(nodes.derivative[ref.number]))
        return _differences(t, fetch(path))


def _differences(t: FloatArray, values: FloatArray) -> FloatArray:
    """Return the rate of a variable whose derivative is in no equation, stretch by stretch between events."""
    rate = np.zeros(len(t))
    ends = [0, *(np.flatnonzero(np.diff(t) == 0.0) + 1).tolist(), len(t)]
    for first, last in pairwise(ends):
        if last - first > 1:
            rate[first:last] = np.gradient(values[first:last], t[first:last])
    return rate
