"""What a picture of a model shows: its parts as boxes, what connects them as lines, arrays of parts as one box."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field

from arthur_acausal.declare.model import Component, Connector
from arthur_acausal.flatten.balance import connectors_of, parts_of
from arthur_acausal.flatten.connections import path_of
from arthur_acausal.flatten.system import FlatSystem

GROUPED_FROM = 4  # members of an array from which on they share a box
SIGNAL = "signal"
_INDEX = re.compile(r"\[(\d+)\]")
_DOMAIN = re.compile(r"\.components\.(\w+)")


@dataclass(frozen=True, slots=True)
class Box:
    """A part, or ``count`` parts of an array; ``inputs``: its signals that come from outside of the model."""

    name: str
    kind: str
    count: int = 1
    inputs: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Line:
    """``count`` connections of one domain between two boxes; a signal goes from ``a`` to ``b``."""

    a: int
    b: int
    domain: str
    count: int = 1


@dataclass(frozen=True, slots=True)
class Diagram:
    """A picture's contents: ``title``, ``about`` in one line, boxes and lines."""

    title: str
    about: str
    boxes: list[Box] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)


def diagram_of(flat: FlatSystem) -> Diagram:
    """Return the diagram of the model's own parts and of what connects them."""
    root = flat.components[0]
    parts = parts_of(root) or [root]
    groups = _groups(parts)
    place = {path_of(part): k for k, members in enumerate(groups) for part in members}
    domain, owner = _owners(flat, root, place)
    inputs: dict[int, list[str]] = {}
    for i in flat.inputs:
        if i in owner:
            inputs.setdefault(owner[i], []).append(flat.variables[i].path.rpartition(".")[2])
    boxes = [
        Box(
            _common([path_of(part) for part in members]) or flat.name,
            type(members[0]).__name__,
            len(members),
            tuple(dict.fromkeys(inputs.get(k, ()))),
        )
        for k, members in enumerate(groups)
    ]
    about = (type(root).__doc__ or "").strip().split("\n")[0].replace("``", "")
    return Diagram(flat.name, about, boxes, _lines(flat, owner, domain))


def _groups(parts: list[Component]) -> list[list[Component]]:
    """Return the parts, the members of long arrays together."""
    found: dict[tuple[str, str], list[Component]] = {}
    for part in parts:
        found.setdefault((_INDEX.sub("[*]", path_of(part)), type(part).__qualname__), []).append(part)
    groups = []
    for (name, _), members in found.items():
        whole = "[*]" in name and len(members) >= GROUPED_FROM
        groups += [members] if whole else [[part] for part in members]
    return groups


def _common(paths: list[str]) -> str:
    if len(paths) == 1:
        return paths[0]
    indices = [int(found[-1]) for path in paths if (found := _INDEX.findall(path))]
    return _INDEX.sub(f"[{min(indices)}-{max(indices)}]", paths[0])


def _owners(
    flat: FlatSystem, root: Component, place: dict[str, int]
) -> tuple[dict[int, str], dict[int, int]]:
    """Return, by the number of a variable that can be connected, its domain and the box that it belongs to."""
    domain: dict[int, str] = {}
    owner: dict[int, int] = {}
    for component in flat.components:
        box = place.get(_top(path_of(component)), 0 if component is root and len(place) == 1 else -1)
        if box < 0:
            continue
        for connector in connectors_of(component):
            assert connector._binding is not None
            first = connector._binding.first["variable"]
            slots = connector._declarations.slot
            for name, quantity in connector._declarations.quantities.items():
                if quantity.kind in ("potential", "flow"):
                    domain[first + slots[name]] = _domain(connector)
                    owner[first + slots[name]] = box
        assert component._binding is not None
        for name, quantity in component._declarations.quantities.items():
            if quantity.kind in ("input", "output"):
                i = component._binding.first["variable"] + component._declarations.slot[name]
                domain[i], owner[i] = SIGNAL, box
    return domain, owner


def _top(path: str) -> str:
    return path.partition(".")[0]


def _domain(connector: Connector) -> str:
    found = _DOMAIN.search(type(connector).__module__)
    return found[1] if found else type(connector).__name__


def _lines(flat: FlatSystem, owner: dict[int, int], domain: dict[int, str]) -> list[Line]:
    """Return the connections between boxes; a pair of connectors counts once, however many potentials it has."""
    pairs: dict[tuple[int, int, str], set[tuple[str, str]]] = {}
    for i, j, _ in flat.aliases:
        if i not in owner or j not in owner or _top(flat.variables[i].path) == _top(flat.variables[j].path):
            continue  # within one part
        source, target = (i, j)
        signal = domain[i] == SIGNAL
        if flat.variables[j].quantity.kind == "output" if signal else owner[j] < owner[i]:
            source, target = (j, i)
        ends = tuple(flat.variables[k].path for k in (source, target))
        if not signal:
            ends = tuple(path.rpartition(".")[0] for path in ends)
        key = (owner[source], owner[target], domain[i])
        pairs.setdefault(key, set()).add((ends[0], ends[1]))
    count = Counter({key: len(members) for key, members in pairs.items()})
    return [Line(a, b, kind, n) for (a, b, kind), n in count.items()]
