"""Causalisation: matching, block triangular form, explicit assignments where an equation can be solved alone."""

from __future__ import annotations

from dataclasses import dataclass

from arthur_acausal.errors import StructureError
from arthur_acausal.graph import TearingResult, blt, conflicts, matching, tear
from arthur_acausal.transform.index import ReducedSystem, not_matching
from arthur_acausal.transform.linear import Coefficient
from arthur_acausal.transform.rows import Nodes, Row

LONGEST = 8  # assignments in a row within a torn block


@dataclass(frozen=True, slots=True)
class Assignment:
    """The row that is solved for a node, by its coefficient, in the order of the list that holds it."""

    row: int
    node: int
    coefficient: Coefficient


@dataclass(frozen=True, slots=True)
class CausalSystem:
    """What the integrator sees and what is computed from it.

    ``states``: nodes with a derivative. ``torn``: algebraic nodes that stay unknowns. ``assignments``: in order.
    ``residuals``: the rows that remain. ``chained``: states whose derivative is a state again. ``blocks``: sizes of
    the diagonal blocks with more than one equation, as (equations, torn).
    """

    states: list[int]
    torn: list[int]
    assignments: list[Assignment]
    residuals: list[int]
    chained: list[int]
    blocks: list[tuple[int, int]]
    n_blocks: int


def causalise(system: ReducedSystem, nodes: Nodes) -> CausalSystem:
    """Order the system: derivatives of states count as known to the integrator, algebraic unknowns are assigned."""
    states = [n for n, d in enumerate(nodes.derivative) if d >= 0 and d not in system.dummies]
    is_state = set(states)
    rates = {nodes.derivative[n] for n in states if nodes.derivative[n] not in is_state}
    unknown = [n for n in range(len(nodes.all)) if n not in is_state]
    place = {n: k for k, n in enumerate(unknown)}
    edges = [_ordered(e, place, rates) for e in system.edges]
    assigned = matching(edges, len(unknown))
    if min(assigned, default=0) < 0 or len(edges) != len(unknown):
        raise _unmatched(edges, assigned, unknown, system, nodes)
    solvable = [
        {place[n] for n, c in e.items() if c is not None and n in place and n not in rates}
        for e in system.edges
    ]
    needed = [
        _ordered(_with_inputs(row, e), place, rates) if row.expression.through is not None else own
        for row, e, own in zip(system.rows, system.edges, edges, strict=True)
    ]
    algebraic = [[v for v in row if unknown[v] not in rates] for row in needed]
    guessed = _guessed(nodes)
    preference = [int(n in guessed) for n in unknown]
    assignments: list[Assignment] = []
    torn: list[int] = []
    residuals: list[int] = []
    sizes: list[tuple[int, int]] = []
    blocks = blt(needed, assigned)
    for block in blocks:
        inside = [assigned[e] for e in block if unknown[assigned[e]] not in rates]
        result = _shortened(tear(block, inside, algebraic, solvable, preference), algebraic)
        for row, variable in result.sequence:
            node = unknown[variable]
            assignments.append(Assignment(row, node, system.edges[row][node]))
        torn += [unknown[v] for v in result.torn_variables]
        residuals += result.residual_equations
        if len(block) > 1:
            sizes.append((len(block), len(result.torn_variables)))
    chained = [n for n in states if nodes.derivative[n] in is_state]
    return CausalSystem(states, torn, assignments, sorted(residuals), chained, sizes, len(blocks))


def _with_inputs(row: Row, edges: dict[int, Coefficient]) -> dict[int, Coefficient]:
    """Return the unknowns of a row and of all inputs of its external function: a call gives all outputs at once."""
    return {r.number: None for r in row.refs if r.kind == "node"} | edges


def _guessed(nodes: Nodes) -> set[int]:
    """Return the nodes that somebody gave a start value: as torn unknowns they begin there."""
    refs = (nodes.of_variable(i) for i, declared in enumerate(nodes.flat.variables) if declared.guessed)
    return {ref.number for ref in refs if ref.kind == "node"}


def _shortened(result: TearingResult, edges: list[list[int]]) -> TearingResult:
    """Return the torn block with no chain of assignments longer than ``LONGEST``: what is one too far is torn.

    A long chain multiplies rounding errors: through a ladder of springs by 2.6 at each step.
    """
    depth = dict.fromkeys(result.torn_variables, 0)
    sequence: list[tuple[int, int]] = []
    torn, residuals = list(result.torn_variables), list(result.residual_equations)
    for row, variable in result.sequence:
        links = [depth[v] for v in edges[row] if v != variable and v in depth]
        depth[variable] = 1 + max(links) if links else 0
        if depth[variable] > LONGEST:
            depth[variable] = 0
            torn.append(variable)
            residuals.append(row)
        else:
            sequence.append((row, variable))
    return TearingResult(sequence, torn, residuals)


def _ordered(edges: dict[int, Coefficient], place: dict[int, int], rates: set[int]) -> list[int]:
    """Order a row's unknowns by how gladly it determines them: rates, constant and parameter coefficients, others."""

    def rank(node: int) -> int:
        if node in rates:
            return 0
        coefficient = edges[node]
        return 1 if isinstance(coefficient, float) else 2 if coefficient is not None else 3

    return [place[n] for n in sorted((n for n in edges if n in place), key=rank)]


def _unmatched(
    edges: list[list[int]], assigned: list[int], unknown: list[int], system: ReducedSystem, nodes: Nodes
) -> StructureError:
    too_many, too_few = conflicts(edges, len(unknown), assigned)
    return not_matching(too_many, too_few, lambda e: system.rows[e].text, lambda v: nodes.name(unknown[v]))
