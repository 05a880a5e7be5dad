"""From a structured system to the CasADi expressions of its kernels."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import casadi as ca
from casadi import SX

from arthur_acausal.errors import StructureError
from arthur_acausal.transform.rows import Ref
from arthur_acausal.transform.structured import StructuredDAE


@dataclass(frozen=True, slots=True)
class Arguments:
    """The symbols of all kernels; z are the discrete variables now, zp before the event, m the frozen relations.

    ``starting``: whether they are those of the start. ``blend``: the part of homotopy's actual expressions; at the
    start it is the last entry of p where there are such, else 1.
    e are the outputs of external functions, d the derivatives of these by the functions' inputs.
    """

    t: SX
    y: SX
    yp: SX
    parameters: SX
    starts: SX
    u: SX
    z: SX
    zp: SX
    m: SX
    blend: SX
    starting: bool
    e: SX
    d: SX

    @property
    def p(self) -> SX:
        """Parameters, and the start values behind them."""
        return ca.vertcat(self.parameters, self.starts, *([] if self.blend.is_constant() else [self.blend]))

    def continuous(self) -> list[SX]:
        """Return the arguments of kernels that are evaluated between events."""
        external = [self.e, self.d] if self.e.numel() else []
        return [self.t, self.y, self.yp, self.p, self.u, self.z, self.m, *external]

    def event(self) -> list[SX]:
        """Return the arguments of kernels that are evaluated at events."""
        return [*self.continuous(), self.zp]


@dataclass(frozen=True, slots=True)
class StartSlot:
    """A start value of a node: ``value`` is a number or an expression of parameters; ``path`` declared it."""

    node: int
    sign: int
    value: float | SX
    fixed: bool
    path: str
    where: str = ""


@dataclass(slots=True)
class Assembly:
    """Everything as expressions of ``arguments``; ``node_values`` is the value of every unknown."""

    arguments: Arguments
    parameters: list[SX]
    parameter_place: dict[int, int]
    y_nodes: list[int]
    node_values: list[SX]
    residual: list[SX] = field(default_factory=list)
    row_labels: list[str] = field(default_factory=list)
    pivots: list[tuple[SX, str]] = field(default_factory=list)


def assemble(dae: StructuredDAE, n_starts: int, *, starting: bool = False) -> Assembly:
    """Substitute assignments in order and return residuals and the values of all unknowns.

    ``starting``: while initial values are sought, else of the run.
    """
    flat, causal, nodes = dae.flat, dae.causal, dae.nodes
    y_nodes = causal.states + causal.torn
    place = _parameter_places(dae)
    arguments = Arguments(
        SX.sym("t"),
        SX.sym("y", len(y_nodes)),
        SX.sym("yp", len(y_nodes)),
        SX.sym("p", len(place)),
        SX.sym("start", n_starts),
        SX.sym("u", len(flat.inputs)),
        SX.sym("z", len(flat.scope.discrete)),
        SX.sym("zp", len(flat.scope.discrete)),
        SX.sym("m", len(flat.relations) + (dae.reduced.sets is not None)),
        SX.sym("homotopy") if starting and "homotopy" in nodes.start_only else SX(1.0),
        starting,
        SX.sym("e", len(flat.scope.external)),
        SX.sym("d", sum(c.call.sparsity.size for c in flat.calls)),
    )
    values: list[SX] = [SX(0.0)] * len(nodes.all)
    y, yp = elements(arguments.y), elements(arguments.yp)
    for k, node in enumerate(y_nodes):
        values[node] = y[k]
    rate = {nodes.derivative[n]: yp[k] for k, n in enumerate(causal.states)}
    in_y = {node: k for k, node in enumerate(y_nodes)}
    for node, symbol in rate.items():
        if node not in in_y:
            values[node] = symbol
    assembly = Assembly(arguments, elements(arguments.parameters), place, y_nodes, values)
    look = lookup(dae, assembly, before=False)
    for assignment in causal.assignments:
        row = dae.reduced.rows[assignment.row]
        values[assignment.node] = SX(0.0)
        rest = dae.evaluator(row, look)
        coefficient = assignment.coefficient
        if not isinstance(coefficient, SX):
            assert coefficient is not None
            values[assignment.node] = (
                -rest if coefficient == 1.0 else rest if coefficient == -1.0 else -rest / coefficient
            )
        else:
            pivot = dae.evaluator(row, look, coefficient)
            assembly.pivots.append((pivot, f"{row.text}: solved for {nodes.name(assignment.node)}"))
            values[assignment.node] = -rest / pivot
    for r in causal.residuals:
        assembly.residual.append(dae.evaluator(dae.reduced.rows[r], look))
        assembly.row_labels.append(dae.reduced.rows[r].text)
    for node in causal.chained:
        derivative = nodes.derivative[node]
        assembly.residual.append(yp[in_y[node]] - values[derivative])
        assembly.row_labels.append(f"der({nodes.name(node)}) == {nodes.name(derivative)}")
    return assembly


def _parameter_places(dae: StructuredDAE) -> dict[int, int]:
    """Return parameter number -> place in p; a shared parameter has the place of the one that it stands for."""
    same = dae.flat.parameter_aliases
    place: dict[int, int] = {}
    for i in range(len(dae.flat.scope.parameter)):
        if i not in same:
            place[i] = len(place)
    return place


def elements(vector: SX) -> list[SX]:
    """Return the elements of a column vector."""
    return ca.vertsplit(vector) if vector.numel() else []


def lookup(dae: StructuredDAE, assembly: Assembly, *, before: bool) -> Callable[[Ref], SX]:
    """Return what gives the value behind a ref; ``before``: pre(z) is its own argument, else it equals z."""
    arguments = assembly.arguments
    p, u, m = assembly.parameters, elements(arguments.u), elements(arguments.m)
    z = elements(arguments.z)
    zp = elements(arguments.zp) if before else z
    e = elements(arguments.e)
    values, place = assembly.node_values, assembly.parameter_place
    zero = SX(0.0)

    def look(ref: Ref) -> SX:
        match ref.kind:
            case "node":
                if ref.number >= len(values):
                    add_derivatives(dae, assembly)
                return values[ref.number]
            case "parameter":
                return p[place[ref.number]]
            case "input":
                return u[ref.number]
            case "discrete":
                return z[ref.number]
            case "pre":
                return zp[ref.number]
            case "mode":
                return m[ref.number]
            case "time":
                return arguments.t
            case "initial":
                return SX(float(arguments.starting))
            case "homotopy":
                return arguments.blend
            case "external":
                return e[ref.number]
        return zero

    return look


def add_derivatives(dae: StructuredDAE, assembly: Assembly) -> None:
    """Give a value to derivatives that no equation of the dynamics holds: the chain rule over states and time.

    They stand in initial equations, relations or ``when`` clauses only.

    Raises StructureError where a variable is no function of states and time alone.
    """
    a, nodes, values = assembly.arguments, dae.nodes, assembly.node_values
    n_states = len(dae.causal.states)
    before = {derivative: node for node, derivative in enumerate(nodes.derivative)}
    for node in range(len(values), len(nodes.all)):
        value = values[before[node]]
        loose = ca.vertcat(a.yp, a.y[n_states:], a.u, a.e)
        if loose.numel() and ca.depends_on(value, loose):
            raise StructureError(
                f"{nodes.name(node)} stands in no equation of the dynamics, and is not known",
                cause="the variable depends on algebraic unknowns, inputs or external functions, "
                "not on states and time alone",
                remedy="write it with variables of the model's own equations",
            )
        states, rates = a.y[:n_states], a.yp[:n_states]
        values.append(ca.jtimes(value, states, rates) + ca.jacobian(value, a.t))


def reinit_target(dae: StructuredDAE, variable: int, y_place: dict[int, int], text: str) -> tuple[int, int]:
    """Return (place in y, sign) of the state that a reinit changes. Raises StructureError if it is no state."""
    ref = dae.nodes.of_variable(variable)
    if ref.kind != "node" or ref.number not in y_place or ref.number not in set(dae.causal.states):
        raise StructureError(
            f"{text}: reinit({dae.flat.variables[variable].path}), but it is no state of the system",
            remedy='reinitialise a state that it depends on, or declare it with state_select="always"',
        )
    return y_place[ref.number], ref.sign
