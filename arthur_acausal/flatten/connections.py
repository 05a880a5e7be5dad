"""Connection sets with Modelica's semantics (specification 3.6, chapter 9): potentials equal, flows sum to zero."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from casadi import SX

from arthur_acausal.declare.model import Component, Connector, Model, title_of
from arthur_acausal.declare.quantity import Quantity
from arthur_acausal.declare.scope import Scope
from arthur_acausal.declare.vector import elements
from arthur_acausal.errors import ConnectError, UnitError
from arthur_acausal.units import format_dimension, parse_unit


class Node(NamedTuple):
    """A connector as seen from one side: from the inside of its component (``outer``), or from around it."""

    connector: int  # number of its first variable
    outer: bool


class Alias(NamedTuple):
    """Two variables that a connection makes equal."""

    i: int
    j: int
    where: str


class FlowSum(NamedTuple):
    """Variables whose signed sum is zero."""

    indices: tuple[int, ...]
    signs: tuple[int, ...]
    where: str
    path: str


@dataclass(slots=True)
class Connections:
    """All connections of a model while they are being collected."""

    parent: dict[Node, Node] = field(default_factory=dict)
    connectors: dict[int, Connector] = field(default_factory=dict)
    where: dict[Node, str] = field(default_factory=dict)
    aliases: list[Alias] = field(default_factory=list)
    driver: dict[int, str] = field(default_factory=dict)  # input or own output -> where it got its source
    media: list[tuple[Connector, Connector, str]] = field(default_factory=list)

    def find(self, node: Node) -> Node:
        """Return the representative of a node's connection set."""
        root = node
        while self.parent.setdefault(root, root) != root:
            root = self.parent[root]
        while self.parent[node] != root:
            self.parent[node], node = root, self.parent[node]
        return root


def path_of(model: Model) -> str:
    """Return the path of a bound instance."""
    assert model._binding is not None
    return model._binding.path


def first_variable(connector: Connector) -> int:
    """Return the number of the connector's first variable."""
    assert connector._binding is not None
    return connector._binding.first["variable"]


def join(a: object, b: object, owner: Component, scope: Scope, where: str, found: Connections) -> None:
    """Take one ``connect(a, b)`` of ``owner`` into the collection."""
    if isinstance(a, Connector) and isinstance(b, Connector):
        _join_connectors(a, b, owner, where, found)
    elif isinstance(a, SX) and isinstance(b, SX):
        if a.shape != b.shape:
            raise ConnectError(
                f"{a} has {a.numel()} elements, but {b} {b.numel()}",
                path=title_of(owner),
                where=where,
                remedy="connect signals of one shape, or elements: connect(self.a.y[0], self.b.u)",
            )
        for each in zip(elements(a), elements(b), strict=True):
            _join_signals(*each, owner, scope, where, found)
    else:
        raise ConnectError(
            f"{_told(a)} and {_told(b)}: a connector and a signal cannot be connected",
            path=title_of(owner),
            where=where,
            remedy="connect connectors with connectors, an output with an input",
        )


def _join_connectors(a: Connector, b: Connector, owner: Component, where: str, found: Connections) -> None:
    for side in (a, b):
        binding = side._binding
        if binding is None or not (binding.owner is owner or _is_part(binding.owner, owner)):
            raise ConnectError(
                f"{_told(side)} is neither a connector of this component nor of one of its parts",
                path=title_of(owner),
                where=where,
                remedy="connect through the connectors of the part that holds it",
            )
    if a is b:
        raise ConnectError(
            f"{path_of(a)} is connected to itself",
            path=title_of(owner),
            where=where,
            remedy="name the other connector",
        )
    _check_match(a, b, owner, where)
    nodes = [Node(first_variable(c), _owner(c) is owner) for c in (a, b)]
    for node, connector in zip(nodes, (a, b), strict=True):
        found.connectors[node.connector] = connector
        found.where.setdefault(node, where)
    root_a, root_b = found.find(nodes[0]), found.find(nodes[1])
    if root_a != root_b:
        found.parent[root_b] = root_a
        for quantity_a, quantity_b in _pairs(a, b):
            if quantity_a.kind == "potential":
                i = first_variable(a) + a._declarations.slot[quantity_a.name]
                j = first_variable(b) + b._declarations.slot[quantity_b.name]
                found.aliases.append(Alias(i, j, where))
    if a.medium is not None:
        found.media.append((a, b, where))


def _owner(connector: Connector) -> Model | None:
    assert connector._binding is not None
    return connector._binding.owner


def _is_part(candidate: Model | None, owner: Component) -> bool:
    return candidate is not None and candidate._binding is not None and candidate._binding.owner is owner


def _pairs(a: Connector, b: Connector) -> list[tuple[Quantity, Quantity]]:
    return [(q, b._declarations.quantities[name]) for name, q in a._declarations.quantities.items()]


def _check_match(a: Connector, b: Connector, owner: Component, where: str) -> None:
    qa, qb = a._declarations.quantities, b._declarations.quantities
    same = qa.keys() == qb.keys() and all(qa[n].kind == qb[n].kind for n in qa)
    if not same or a.medium is not b.medium:
        raise ConnectError(
            f"{path_of(a)} ({_describe(a)}) does not fit {path_of(b)} ({_describe(b)})",
            path=title_of(owner),
            where=where,
            remedy="only connectors with the same potentials and flows can meet",
        )
    for name in qa:
        dimensions = [parse_unit(q[name].unit).dimension for q in (qa, qb)]
        if dimensions[0] != dimensions[1]:
            mine, its = (format_dimension(d) for d in dimensions)
            raise UnitError(
                f"{path_of(a)}.{name} is {mine}, but {path_of(b)}.{name} {its}",
                path=title_of(owner),
                where=where,
                remedy="connect connectors of one kind, or put a component between them that converts",
            )


def _told(side: object) -> str:
    return title_of(side) if isinstance(side, Connector) else str(side)


def _describe(connector: Connector) -> str:
    listed = ", ".join(f"{n} [{q.unit}]" for n, q in connector._declarations.quantities.items())
    return f"{type(connector).__name__}: {listed}"


def _join_signals(a: SX, b: SX, owner: Component, scope: Scope, where: str, found: Connections) -> None:
    atoms = [scope.atom(side) for side in (a, b)]
    declared = [scope.variable[x.number] if x is not None and x.kind == "variable" else None for x in atoms]
    if (
        declared[0] is None
        or declared[1] is None
        or any(d.quantity.kind not in ("input", "output") for d in declared if d)
    ):
        names = " and ".join(str(side) for side in (a, b))
        raise ConnectError(
            f"{names} are not both signals",
            path=title_of(owner),
            where=where,
            remedy="declare real_input / real_output, or write ==",
        )
    dims = [parse_unit(d.quantity.unit).dimension for d in declared if d is not None]
    if dims[0] != dims[1]:
        raise UnitError(
            f"{declared[0].path} is {format_dimension(dims[0])}, but {declared[1].path} {format_dimension(dims[1])}",
            path=title_of(owner),
            where=where,
            remedy="put a block between them that converts, or declare both signals in one unit",
        )
    own = path_of(owner)
    sinks = [
        x.number
        for x, d in zip(atoms, declared, strict=True)
        if x and d and _is_sink(d.path, d.quantity, own)
    ]
    if len(sinks) != 1:
        cause = "neither gives a value" if len(sinks) == 2 else "both give a value"
        raise ConnectError(
            f"{declared[0].path} and {declared[1].path}: {cause}",
            path=title_of(owner),
            where=where,
            remedy="connect an output with an input; a component's own input gives a value within it",
        )
    if sinks[0] in found.driver:
        raise ConnectError(
            f"{scope.variable[sinks[0]].path} already has a source ({found.driver[sinks[0]]})",
            path=title_of(owner),
            where=where,
            remedy="remove one of the two connections, or add the signals in a block",
        )
    found.driver[sinks[0]] = where
    assert atoms[0] is not None and atoms[1] is not None
    found.aliases.append(Alias(atoms[0].number, atoms[1].number, where))


def _is_sink(path: str, quantity: Quantity, owner: str) -> bool:
    """A part's input takes a value, and so does the owner's own output."""
    own = path.rpartition(".")[0] == owner
    return (quantity.kind == "input") != own


def flow_sums(connectors: list[Connector], found: Connections, scope: Scope) -> list[FlowSum]:
    """Return the flow balance of every connection set; a connector that nothing meets has zero flow."""
    sets: dict[Node, list[Node]] = {}
    for node in list(found.parent):
        sets.setdefault(found.find(node), []).append(node)
    for connector in connectors:
        node = Node(first_variable(connector), False)
        found.connectors[node.connector] = connector
        if node not in found.parent:
            sets[node] = [node]
    sums = []
    for nodes in sets.values():
        head = found.connectors[nodes[0].connector]
        for name, quantity in head._declarations.quantities.items():
            if quantity.kind != "flow":
                continue
            slots = [n.connector + found.connectors[n.connector]._declarations.slot[name] for n in nodes]
            signs = tuple(-1 if n.outer else 1 for n in nodes)
            where = found.where.get(nodes[0], head._where)
            sums.append(FlowSum(tuple(slots), signs, where, path_of(head)))
    return sums
