"""One medium (fluid) a connection set: components inherit it from the one that was given explicitly."""

from __future__ import annotations

from arthur_acausal.declare.model import Component, Connector, Record
from arthur_acausal.errors import ConnectError
from arthur_acausal.flatten.connections import Connections, path_of


class _Union:
    def __init__(self) -> None:
        self.parent: dict[int, int] = {}

    def find(self, i: int) -> int:
        while self.parent.setdefault(i, i) != i:
            self.parent[i] = self.parent[self.parent[i]]
            i = self.parent[i]
        return i

    def join(self, i: int, j: int) -> None:
        self.parent[self.find(j)] = self.find(i)


def _own_media(component: Component) -> list[tuple[str, Record, list[Connector]]]:
    """Return (slot name, record, connectors) for each record of the component that is the medium of its connectors."""
    binding = component._binding
    assert binding is not None
    connectors = [c for c in binding.children if isinstance(c, Connector) and c.medium is not None]
    found = []
    for name in component._declarations.parts:
        record = component.__dict__[name]
        if isinstance(record, Record):
            meeting = [c for c in connectors if c.medium is not None and isinstance(record, c.medium)]
            if meeting:
                found.append((name, record, meeting))
    return found


def unify_media(
    components: list[Component], found: Connections, shared: list[tuple[Record, Record]]
) -> dict[int, int]:
    """Give every component the medium of its connection set; return parameter number -> the one that it stands for.

    ``shared`` lists records that were given as another one, already with its place.
    Raises ConnectError where two different media were given explicitly in one set.
    """
    union = _Union()
    source = {id(record): original for record, original in shared}
    slots: list[tuple[Component, str, Record]] = []
    for component in components:
        for name, record, connectors in _own_media(component):
            slots.append((component, name, record))
            for connector in connectors:
                union.join(id(record), id(connector))
    for a, b, _ in found.media:
        union.join(id(a), id(b))
    groups: dict[int, list[tuple[Component, str, Record]]] = {}
    for slot in slots:
        groups.setdefault(union.find(id(slot[2])), []).append(slot)
    same: dict[int, int] = {}
    for record, original in shared:
        same.update(parameters_like(record, original))
    for group in groups.values():
        master = _master(group, source)
        for component, name, record in group:
            if record is not master:
                same.update(parameters_like(record, master))
                if _alike(record, master):
                    record.__dict__.update({n: master.__dict__[n] for n in master._declarations.structural})
                else:
                    component.__dict__[name] = master
    return same


def _master(group: list[tuple[Component, str, Record]], source: dict[int, Record]) -> Record:
    explicit = []
    inherited = {id(r) for c, name, r in group if c._binding is not None and name not in c._binding.explicit}
    for component, name, record in group:
        assert component._binding is not None
        if name in component._binding.explicit:
            while id(record) in source:
                record = source[id(record)]
            if id(record) not in inherited:  # a part's, given by an owner that inherits it itself
                explicit.append((component, name, record))
    if not explicit:
        return group[0][2]
    first = explicit[0]
    for other in explicit[1:]:
        if first[2] is not other[2] and not _equal(first[2], other[2]):
            raise ConnectError(
                f"two different media meet: {path_of(first[0])}.{first[1]} and {path_of(other[0])}.{other[1]}",
                path=path_of(other[0]),
                where=other[2]._where,
                remedy="give one of them only, or the same record to both; what a connection joins has one medium",
            )
    return first[2]


def _equal(a: Record, b: Record) -> bool:
    if type(a) is not type(b):
        return False
    mine, its = a._modifications, b._modifications
    return mine.keys() == its.keys() and all(mine[k] is its[k] or _same(mine[k], its[k]) for k in mine)


def _same(x: object, y: object) -> bool:
    if isinstance(x, Record) and isinstance(y, Record):
        return _equal(x, y)
    return isinstance(x, int | float | str) and isinstance(y, int | float | str) and x == y


def _nested(record: Record, master: Record) -> list[tuple[Record, Record]]:
    """Return the records that both hold under one name."""
    pairs = [(own, master.__dict__.get(name)) for name, own in record.__dict__.items()]
    return [(own, its) for own, its in pairs if isinstance(own, Record) and isinstance(its, Record)]


def _alike(record: Record, master: Record) -> bool:
    """Tell whether equations read both in the same way: they are of one class, and so is what they hold."""
    return type(record) is type(master) and all(_alike(*pair) for pair in _nested(record, master))


def parameters_like(record: Record, master: Record) -> dict[int, int]:
    """Return parameter number of ``record``, and of the records that it holds -> that of ``master``."""
    mine, its = record._binding, master._binding
    assert mine is not None and its is not None
    same = {
        mine.first["parameter"] + slot: its.first["parameter"] + master._declarations.slot[name]
        for name, slot in record._declarations.slot.items()
        if name in master._declarations.slot
    }
    for pair in _nested(record, master):
        same |= parameters_like(*pair)
    return same
