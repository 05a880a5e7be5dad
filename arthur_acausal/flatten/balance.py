"""The balance of one component by itself: as many equations as unknowns, counted as Modelica 3.6, section 4.8 does."""

from __future__ import annotations

from typing import NamedTuple

from arthur_acausal.declare.authored import defined_at
from arthur_acausal.declare.model import Component, Connector, Model, title_of
from arthur_acausal.errors import StructureError
from arthur_acausal.flatten.block import Block, Equation
from arthur_acausal.graph import Union, dulmage_mendelsohn, matching

LISTED = 8  # unknowns of one group in a message


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


def check_balance(component: Component, block: Block, connections: list[list[int]]) -> None:
    """Raise StructureError unless the component, with its flows and inputs given from outside, determines itself.

    ``connections``: the variables of each equation that its own ``connect`` statements make: potential equalities,
    flow sums (of connected and of unconnected part connectors), signal equalities, and defaults of its parts' inputs.
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
        + len(connections)
    )
    if equations != unknowns:
        raise _unbalanced(component, block, connections, equations, unknowns)


def _unbalanced(
    component: Component, block: Block, connections: list[list[int]], equations: int, unknowns: int
) -> StructureError:
    over, missing = _culprits(component, block, connections)
    where = defined_at(type(component).equations)
    culprits = []
    if missing:
        culprits.append(f"not determined: {'; '.join(_among(*m) for m in missing)}")
    if over:
        culprits.append(f"surplus: {'; '.join(f'{e.name} ({e.where})' for e in over)}")
    if equations > unknowns:
        remedy = "remove what is surplus, or an equation that says the same"
        where = over[0].where if over else where
        culprits.reverse()
    else:
        remedy = "add an equation"
        if missing:
            number, names = missing[0]
            remedy += f" that determines {names[0] if number == len(names) else 'one of them'}"
    number = abs(equations - unknowns)
    few = "too many" if equations > unknowns else "too few"
    return StructureError(
        f"{type(component).__name__} does not balance by itself: {equations} equations for {unknowns} unknowns"
        + "".join(f"; {text}" for text in culprits),
        path=title_of(component),
        where=where,
        cause=f"{number} equation{'s' if number > 1 else ''} {few}, with flows and inputs given from outside",
        remedy=remedy,
    )


def _among(number: int, names: list[str]) -> str:
    """Return the text for some unknowns of which a number are not determined."""
    told = ", ".join(names[:LISTED]) + (f" and {len(names) - LISTED} more" if len(names) > LISTED else "")
    return told if number == len(names) else f"{number} of {told}"


def _culprits(
    component: Component, block: Block, connections: list[list[int]]
) -> tuple[list[Equation], list[tuple[int, list[str]]]]:
    """Return the component's own equations that are surplus, and the unknowns that are not determined.

    The latter in groups that share no equation, those of a single unknown first, each with the number of equations
    that it lacks. A part and the world outside can determine as many of the variables where they meet the component
    as the count says; which ones is not known here, so that each such equation stands for all of them.
    """
    names, inside = _unknowns(component)
    numbers = list(names)
    column = {number: k for k, number in enumerate(numbers)}
    rows = [[column[n]] for n in _numbers(component, ("input",))]
    outer = [column[n] for c in connectors_of(component) for n in _numbers(c)]
    rows += [outer] * sum(count([c]).flow for c in connectors_of(component))
    for part in parts_of(component):
        meeting = [column[n] for n in inside[id(part)]]
        rows += [meeting] * (count([*connectors_of(part)]).potential + count([part]).outputs)
    within = {n: inside[id(part)] for part in parts_of(component) for n in _all_numbers(part)}

    def columns_of(found: list[int]) -> list[int]:
        """Return the columns of variables; for what lies deeper within a part stands where that part is met."""
        return sorted({column[m] for n in found for m in ([n] if n in column else within.get(n, []))})

    rows += [columns_of(row) for row in connections]
    own = len(rows)
    for equation in block.equations:
        rows.append(columns_of([a.number for a in equation.atoms if a.kind in ("variable", "der")]))
    assigned = matching(rows, len(numbers), matching(rows[:own], len(numbers)))  # what is given comes first
    over = [e for e, v in zip(block.equations, assigned[own:], strict=True) if v < 0]
    groups = _underdetermined(rows, len(numbers), assigned)
    return over, [(lacking, [names[numbers[k]] for k in columns]) for lacking, columns in groups]


def _underdetermined(rows: list[list[int]], width: int, assigned: list[int]) -> list[tuple[int, list[int]]]:
    """Return the columns of the underdetermined part, joined by its rows, with how many rows each group lacks."""
    part = dulmage_mendelsohn(rows, width, assigned)
    joined = Union(width)
    for row in part.under_equations:
        for column in rows[row]:
            joined.union(rows[row][0], column)
    groups: dict[int, list[int]] = {}
    for column in part.under_variables:
        groups.setdefault(joined.find(column), []).append(column)
    matched = set(assigned)
    found = [(sum(k not in matched for k in columns), columns) for columns in groups.values()]
    return sorted(found, key=lambda group: len(group[1]))


def _unknowns(component: Component) -> tuple[dict[int, str], dict[int, list[int]]]:
    """Return number -> name of what the component determines, its own first; and what each part (id) meets it with."""
    binding = component._binding
    assert binding is not None
    variable = binding.scope.variable
    inside = {
        id(part): [
            *(n for c in connectors_of(part) for n in _numbers(c)),
            *_numbers(part, ("input", "output")),
        ]
        for part in parts_of(component)
    }
    numbers = [
        *_numbers(component),
        *(n for c in connectors_of(component) for n in _numbers(c)),
        *(n for meeting in inside.values() for n in meeting),
    ]
    prefix = f"{binding.path}." if binding.path else ""
    return {n: variable[n].path.removeprefix(prefix) for n in numbers}, inside


def _numbers(
    model: Model, kinds: tuple[str, ...] = ("potential", "flow", "input", "output", "variable")
) -> list[int]:
    """Return the numbers of a model's own variables of some kinds."""
    assert model._binding is not None
    first, declared = model._binding.first["variable"], model._declarations
    return [first + declared.slot[name] for name, q in declared.quantities.items() if q.kind in kinds]


def _all_numbers(model: Model) -> list[int]:
    """Return the numbers of all variables of a model and of everything below it."""
    assert model._binding is not None
    return _numbers(model) + [n for child in model._binding.children for n in _all_numbers(child)]
