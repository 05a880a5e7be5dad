"""The balance of one component by itself: as many equations as unknowns, counted as Modelica 3.6, section 4.8 does."""

from __future__ import annotations

from typing import NamedTuple

from arthur_acausal.declare.model import Component, Connector, Model
from arthur_acausal.errors import StructureError
from arthur_acausal.flatten.block import Block
from arthur_acausal.graph import matching


class Count(NamedTuple):
    """How many quantities of each kind some models declare."""

    potential: int = 0
    flow: int = 0
    inputs: int = 0
    outputs: int = 0
    other: int = 0

    @property
    def total(self) -> int:
        """All unknowns."""
        return sum(self)


def count(models: list[Model]) -> Count:
    """Count the continuous quantities that the models themselves declare."""
    kinds = [q.kind for m in models for q in m._declarations.quantities.values()]
    return Count(
        kinds.count("potential"),
        kinds.count("flow"),
        kinds.count("input"),
        kinds.count("output"),
        kinds.count("variable"),
    )


def connectors_of(component: Component) -> list[Connector]:
    """Return the component's own connectors."""
    assert component._binding is not None
    return [c for c in component._binding.children if isinstance(c, Connector)]


def parts_of(component: Component) -> list[Component]:
    """Return the component's parts."""
    assert component._binding is not None
    return [c for c in component._binding.children if isinstance(c, Component)]


def check_balance(component: Component, block: Block, connection_equations: int) -> None:
    """Raise StructureError unless the component, with its flows and inputs given from outside, determines itself.

    ``connection_equations``: potential equalities, flow sums (of connected and of unconnected part connectors) and
    signal equalities that its own ``connect`` statements make.
    """
    own, outer = count([component]), count(list(connectors_of(component)))
    parts = parts_of(component)
    meeting = count([c for p in parts for c in connectors_of(p)])
    signals = count(list(parts))
    unknowns = own.total + outer.total + meeting.total + signals.inputs + signals.outputs
    equations = (
        len(block.equations)
        + own.inputs
        + outer.flow
        + meeting.potential
        + signals.outputs
        + connection_equations
    )
    if equations == unknowns:
        return
    what = f"{equations} equations for {unknowns} unknowns"
    assert component._binding is not None
    path = component._binding.path or type(component).__name__
    surplus = equations > unknowns
    raise StructureError(
        f"{type(component).__name__} does not balance: {what}{_culprits(component, block, surplus)}",
        path=path,
        where=_place(block, component),
        cause="one equation too many"
        if equations == unknowns + 1
        else ("too many equations" if surplus else "too few equations"),
        remedy="remove one of the equations named"
        if surplus
        else "add an equation for what is not determined",
    )


def _place(block: Block, component: Component) -> str:
    return block.equations[-1].where if block.equations else component._where


def _culprits(component: Component, block: Block, surplus: bool) -> str:
    """Name what a matching leaves over, with each flow and input taken as given; empty for hierarchical components."""
    if parts_of(component):
        return ""
    binding = component._binding
    assert binding is not None
    first = binding.first["variable"]
    given: list[list[int]] = []
    names: list[str] = []
    for model in [component, *connectors_of(component)]:
        prefix = "" if model is component else f"{model._binding.path.rpartition('.')[2]}."  # type: ignore[union-attr]
        for q in model._declarations.quantities.values():
            if q.space == "variable":
                if q.kind in ("flow", "input"):
                    given.append([len(names)])
                names.append(prefix + q.name)
    edges = [
        sorted({a.number - first for a in e.atoms if a.kind in ("variable", "der")}) for e in block.equations
    ]
    edges = [[v for v in row if 0 <= v < len(names)] for row in edges]
    assigned = matching(given + edges, len(names))
    if surplus:
        over = [e for e, v in zip(block.equations, assigned[len(given) :], strict=True) if v < 0]
        listed = ", ".join(
            f'"{e.label}" ({e.where})' if e.label else f"{e.lhs} == {e.rhs} ({e.where})" for e in over
        )
        return f"; surplus: {listed}" if listed else ""
    missing = [n for i, n in enumerate(names) if i not in set(assigned)]
    return f"; not determined: {', '.join(missing)}" if missing else ""
