"""``flatten``: one pass over the tree of components, from the root down."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import casadi as ca
from casadi import SX

from arthur_acausal.declare.bind import bind_root
from arthur_acausal.declare.model import Component, title_of
from arthur_acausal.declare.scope import Atom, Relation, Scope
from arthur_acausal.errors import ConnectError, DeclarationError
from arthur_acausal.flatten.balance import check_balance, connectors_of, parts_of
from arthur_acausal.flatten.block import Block, Equation, Expression, run_block
from arthur_acausal.flatten.connections import Connections, Node, first_variable, flow_sums, join, path_of
from arthur_acausal.flatten.dimensions import check_block as check_dimensions
from arthur_acausal.flatten.dimensions import check_values
from arthur_acausal.flatten.media import unify_media
from arthur_acausal.flatten.system import (
    FlatCall,
    FlatClause,
    FlatEquation,
    FlatRelation,
    FlatSampling,
    FlatSystem,
    Shift,
)
from arthur_acausal.flatten.template import rebased, structure_key


def flatten(
    model: Component,
    *,
    name: str = "",
    check_units: bool = True,
    structural: Mapping[str, Any] | None = None,
) -> FlatSystem:
    """Return the flat system of a model; ``structural``: values of structural parameters, of parts too, by path.

    Raises the errors of errors.py for whatever is wrong with a declaration, a connection, a unit or a balance.
    """
    if not isinstance(model, Component):
        given = model.__name__ if isinstance(model, type) else repr(model)
        raise DeclarationError(
            f"{given} is no component"
            if not isinstance(model, type)
            else f"{given} is a class, not an instance",
            remedy=f"give an instance: {given}()"
            if isinstance(model, type)
            else "give an instance of a Component",
        )
    scope = Scope(structural=dict(structural or {}))
    root = bind_root(model, scope)
    assert isinstance(root, Component)
    if check_units:
        check_values(scope)
    components = _walk(root)
    work = _Work(scope, check_units)
    for component in components:
        if parts_of(component):
            _add_whole(component, work)
    same = unify_media(components, work.found, scope.shared)
    for component in components:
        if not parts_of(component):
            _add_leaf(component, work)
    return _finish(root, components, name or type(model).__name__, same, work)


@dataclass(slots=True)
class _Work:
    """What is collected on the way."""

    scope: Scope
    check_units: bool
    found: Connections = field(default_factory=Connections)
    equations: list[FlatEquation] = field(default_factory=list)
    initial: list[FlatEquation] = field(default_factory=list)
    relations: list[FlatRelation] = field(default_factory=list)
    clauses: list[FlatClause] = field(default_factory=list)
    samplings: list[FlatSampling] = field(default_factory=list)
    calls: list[FlatCall] = field(default_factory=list)
    blocks: dict[Hashable, Block] = field(default_factory=dict)


def _walk(root: Component) -> list[Component]:
    """Return all components, owners before their parts."""
    found, stack = [], [root]
    while stack:
        component = stack.pop()
        found.append(component)
        stack.extend(reversed(parts_of(component)))
    return found


def _add_whole(component: Component, work: _Work) -> None:
    """Run a component's statements on the model's own symbols: for hierarchical ones, which are used once."""
    block = run_block(component, work.scope)
    made = len(work.found.aliases)
    for connection, where in block.connections:
        join(connection.a, connection.b, component, work.scope, where, work.found)
    connections = [[a.i, a.j] for a in work.found.aliases[made:]]
    _check_block(component, block, work, work.scope, connections + _closing_rows(component, work))
    _place(component, block, Shift(), work)


def _closing_rows(component: Component, work: _Work) -> list[list[int]]:
    """Return the variables of each flow sum and of each default input that the component's connections leave."""
    found = work.found
    inner = [c for part in parts_of(component) for c in connectors_of(part)]
    nodes = [Node(first_variable(c), False) for c in inner]
    own = connectors_of(component)
    nodes += [node for c in own if (node := Node(first_variable(c), True)) in found.parent]
    sets: dict[Node, list[list[int]]] = {}
    for node, connector in zip(
        nodes, [*inner, *(c for c in own if Node(first_variable(c), True) in found.parent)], strict=True
    ):
        flows = [
            node.connector + connector._declarations.slot[n]
            for n, q in connector._declarations.quantities.items()
            if q.kind == "flow"
        ]
        rows = sets.setdefault(found.find(node), [[] for _ in flows])
        for row, number in zip(rows, flows, strict=True):
            row.append(number)
    return [row for rows in sets.values() for row in rows] + _default_inputs(component, work)


def _default_inputs(component: Component, work: _Work) -> list[list[int]]:
    """Return the inputs of the component's parts that nothing drives."""
    found = []
    for part in parts_of(component):
        assert part._binding is not None
        for name, quantity in part._declarations.quantities.items():
            number = part._binding.first["variable"] + part._declarations.slot[name]
            if quantity.kind == "input" and number not in work.found.driver:
                found.append([number])
    return found


def _add_leaf(component: Component, work: _Work) -> None:
    """Place the block of the component's class; run it where it is met for the first time."""
    binding = component._binding
    assert binding is not None
    key = structure_key(component)
    if key is None:
        _add_whole(component, work)
        return
    block = work.blocks.get(key)
    if block is None:
        copy, scope = rebased(component)
        block = run_block(copy, scope)
        if block.connections:
            raise ConnectError("connect() joins parts; this component has none", path=path_of(component))
        _check_block(copy, block, work, scope, [])
        if block.samplings or block.calls:  # their functions may be methods of the instance
            _place(component, run_block(component, work.scope), Shift(), work)
            return
        work.blocks[key] = block
    shift = Shift(
        binding.first["variable"],
        binding.first["parameter"],
        binding.first["discrete"],
        len(work.scope.relations),
    )
    work.scope.relations.extend(Relation(r.g.value, r.inclusive, r.where, r.text) for r in block.relations)
    _place(component, block, shift, work)


def _check_block(
    component: Component, block: Block, work: _Work, scope: Scope, connections: list[list[int]]
) -> None:
    check_balance(component, block, connections)
    if work.check_units:
        check_dimensions(block, scope, title_of(component))


def _place(component: Component, block: Block, shift: Shift, work: _Work) -> None:
    path = path_of(component)
    work.equations.extend(FlatEquation(e, path, shift) for e in block.equations)
    work.initial.extend(FlatEquation(e, path, shift) for e in block.initial)
    work.relations.extend(FlatRelation(r, path, shift) for r in block.relations)
    work.clauses.extend(FlatClause(c, path, shift) for c in block.clauses)
    work.samplings.extend(FlatSampling(s, path, shift) for s in block.samplings)
    work.calls.extend(FlatCall(c, path) for c in block.calls)


def _in_order(samplings: list[FlatSampling], components: list[Component]) -> list[FlatSampling]:
    """Return the samplings in the order of their components: owners before their parts, as declared."""
    number = {path_of(component): k for k, component in enumerate(components)}
    return sorted(samplings, key=lambda s: number[s.path])


def _finish(
    root: Component, components: list[Component], name: str, same: dict[int, int], work: _Work
) -> FlatSystem:
    connectors = [c for component in components for c in connectors_of(component)]
    for total in flow_sums(connectors, work.found, work.scope):
        work.equations.append(
            FlatEquation(_sum_equation(total.signs, total.where), total.path, indices=total.indices)
        )
    inputs = [
        i
        for i, d in enumerate(work.scope.variable)
        if d.quantity.kind == "input" and i not in work.found.driver
    ]
    for i in inputs:
        declared = work.scope.variable[i]
        if declared.value is None and "." in declared.path:
            raise ConnectError(
                "the input is not connected and has no default",
                path=declared.path,
                remedy="connect it to an output, or declare real_input(..., default=...)",
            )
    return FlatSystem(
        name,
        work.scope,
        work.equations,
        work.initial,
        work.found.aliases,
        work.relations,
        work.clauses,
        _in_order(work.samplings, components),
        work.calls,
        inputs,
        same,
        components,
    )


@cache
def _sum_of(signs: tuple[int, ...]) -> Expression:
    symbols = [SX.sym(f"flow_{i}") for i in range(len(signs))]
    total = ca.sum1(ca.vertcat(*[s * x for s, x in zip(signs, symbols, strict=True)]))
    return Expression(total, symbols, [Atom("variable", i) for i in range(len(signs))])


@cache
def _sum_equation(signs: tuple[int, ...], where: str) -> Equation:
    total = _sum_of(signs)
    return Equation(total.value, SX(0.0), total, "flow balance", where, '"flow balance"')
