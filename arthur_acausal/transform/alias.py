"""Alias elimination on integers, before any substitution: equal, opposite and zero variables share one number."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from arthur_acausal.declare.scope import Atom
from arthur_acausal.errors import StructureError
from arthur_acausal.flatten.connections import Alias
from arthur_acausal.flatten.system import FlatEquation, FlatSystem
from arthur_acausal.graph import PRIORITIES, Outcome, SignedUnion
from arthur_acausal.transform.linear import LinearAnalysis

Definition = tuple[FlatEquation, Atom, Atom, int]
"""An equation ``w == sign der(x)``: itself, w, der(x), sign."""


@dataclass(frozen=True, slots=True)
class Aliases:
    """What elimination found; the recovery of every variable.

    ``root[i]``, ``sign[i]``: variable i is sign times variable root. ``zero``: roots that are identically zero.
    ``rate``: root -> the root that is its derivative, by an equation ``w == der(x)`` whose w is differentiated, too.
    ``kept``: the equations that say more than this. ``count``: how many equations went.
    """

    root: list[int]
    sign: list[int]
    zero: frozenset[int]
    rate: dict[int, int]
    kept: list[FlatEquation]
    count: int


def eliminate_aliases(flat: FlatSystem, linear: LinearAnalysis) -> Aliases:
    """Find all signed aliases; connections first, then equations ``x = y``, ``x = -y``, ``x = 0`` and ``y = der(x)``.

    Two variables that are the derivative of one are aliases, too: so rigidly joined inertias share one speed.
    """
    union = SignedUnion(len(flat.variables))
    zeros: list[tuple[int, FlatEquation]] = []
    for alias in flat.aliases:
        _connect(union, alias, flat)
    kept: list[FlatEquation] = []
    derivatives: list[Definition] = []
    for equation in flat.equations:
        shape = linear.shape(equation.equation.residual)
        if shape is None:
            kept.append(equation)
            continue
        atoms = equation.atoms()
        first = atoms[shape.i]
        if shape.j < 0:
            if first.kind == "variable":
                zeros.append((first.number, equation))
            else:
                kept.append(equation)
            continue
        second = atoms[shape.j]
        if first.kind == "variable" and second.kind == "variable":
            if union.union(first.number, second.number, shape.sign) is Outcome.KNOWN:
                kept.append(equation)  # it says nothing new: the matching tells what is then not determined
        elif first.kind != second.kind:
            w, x = (first, second) if second.kind == "der" else (second, first)
            derivatives.append((equation, w, x, shape.sign))
        else:
            kept.append(equation)
    definitions = _join_derivatives(union, derivatives)
    states = _differentiated(flat)
    union.prefer(_preference(flat, states))
    zero, twice = _zeros(union, zeros, flat)
    kept += twice
    rate, rest = _rates(union, definitions, {union.find(i)[0] for i in states}, zero | set(flat.inputs))
    pairs = [union.find(i) for i in range(len(union))]
    root = [p[0] for p in pairs]
    count = len(flat.aliases) + len(flat.equations) - len(kept) - len(rest)
    return Aliases(root, [p[1] for p in pairs], zero, rate, kept + rest, count)


def _rates(
    union: SignedUnion, definitions: list[Definition], states: set[int], known: frozenset[int] | set[int]
) -> tuple[dict[int, int], list[FlatEquation]]:
    """Return x -> w for definitions ``w == der(x)`` that make chains of derivatives, and the other equations."""
    rate: dict[int, int] = {}
    taken: set[int] = set()
    rest = []
    for equation, w, x, sign in definitions:
        root_w, sign_w = union.find(w.number)
        root_x, sign_x = union.find(x.number)
        end = root_w
        while end in rate:
            end = rate[end]
        chain = root_w in states and root_w not in taken and root_x not in rate and end != root_x
        if chain and sign * sign_w * sign_x > 0 and root_w not in known and root_x not in known:
            rate[root_x] = root_w
            taken.add(root_w)
        else:
            rest.append(equation)
    return rate, rest


def _zeros(
    union: SignedUnion, zeros: list[tuple[int, FlatEquation]], flat: FlatSystem
) -> tuple[frozenset[int], list[FlatEquation]]:
    """Return the roots that are zero, and the equations ``x = 0`` that say nothing new of the unknowns."""
    zero = {union.find(i)[0] for i in range(len(union)) if union.is_zero(i)}
    known = zero | {union.find(i)[0] for i in flat.inputs}
    twice = []
    for i, equation in zeros:
        root = union.find(i)[0]
        if root in known:
            twice.append(equation)
        else:
            known.add(root)
            zero.add(root)
    return frozenset(zero), twice


def _connect(union: SignedUnion, alias: Alias, flat: FlatSystem) -> None:
    if union.union(alias.i, alias.j) is Outcome.KNOWN:
        a, b = flat.variables[alias.i].path, flat.variables[alias.j].path
        raise StructureError(
            f"{a} and {b} are connected already",
            where=alias.where,
            cause="the connectors are joined within a component and again around it, so that the flow between "
            "them can take two ways and neither is determined",
            remedy="remove one of the connections",
        )


def _join_derivatives(union: SignedUnion, derivatives: list[Definition]) -> list[Definition]:
    """Join the variables that are derivatives of one variable; return the defining equations that remain."""
    waiting = derivatives
    while True:
        defined: dict[int, tuple[int, int]] = {}
        remain, joined = [], False
        for entry in waiting:
            _, w, x, sign = entry
            root, root_sign = union.find(x.number)
            if root not in defined:
                defined[root] = (w.number, sign * root_sign)
                remain.append(entry)
                continue
            other, other_sign = defined[root]
            if union.union(w.number, other, sign * root_sign * other_sign) is Outcome.KNOWN:
                remain.append(entry)  # stated twice: the matching will name it
            else:
                joined = True
        waiting = remain
        if not joined:
            return waiting


def _differentiated(flat: FlatSystem) -> set[int]:
    """Return the variables whose derivative stands in an equation."""
    has_rate = {e.equation: any(a.kind == "der" for a in e.equation.atoms) for e in flat.equations}
    return {a.number for e in flat.equations if has_rate[e.equation] for a in e.atoms() if a.kind == "der"}


def _preference(flat: FlatSystem, states: set[int]) -> Callable[[int], tuple[object, ...]]:
    """Return the key of the variable that stands for its set: wanted as a state, a state, a given start, the nearest.

    The set is a state as gladly as its keenest variable: that one's ``state_select`` counts for all.
    """
    inputs = set(flat.inputs)

    def key(i: int) -> tuple[object, ...]:
        declared = flat.variables[i]
        given = declared.start is not None
        inner = declared.quantity.kind in ("potential", "flow")
        wanted = PRIORITIES[declared.quantity.state_select]
        return (i not in inputs, -wanted, i not in states, not given, inner, declared.path.count("."), i)

    return key
