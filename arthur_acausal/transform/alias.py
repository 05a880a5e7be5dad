"""Alias elimination on integers: variables that are equal, opposite or zero share one number, before any substitution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from arthur_acausal.declare.scope import Atom
from arthur_acausal.errors import StructureError
from arthur_acausal.flatten.system import FlatEquation, FlatSystem
from arthur_acausal.graph import Outcome, SignedUnion
from arthur_acausal.transform.linear import LinearAnalysis


@dataclass(frozen=True, slots=True)
class Aliases:
    """What elimination found; the recovery of every variable.

    ``root[i]``, ``sign[i]``: variable i is sign times variable root. ``zero``: roots that are identically zero.
    ``kept``: the equations that say more than an alias. ``count``: how many variables and equations went.
    """

    root: list[int]
    sign: list[int]
    zero: frozenset[int]
    kept: list[FlatEquation]
    count: int


def eliminate_aliases(flat: FlatSystem, linear: LinearAnalysis) -> Aliases:
    """Find all signed aliases; connections first, then equations ``x = y``, ``x = -y``, ``x = 0`` and ``y = der(x)``.

    Two variables that are the derivative of one are aliases, too: so rigidly joined inertias share one speed.
    """
    union = SignedUnion(len(flat.variables))
    zeros: list[int] = []
    for alias in flat.aliases:
        _join(union, alias.i, alias.j, 1, f"connect ({alias.where})")
    kept: list[FlatEquation] = []
    derivatives: list[tuple[FlatEquation, Atom, Atom, int]] = []
    for equation in flat.equations:
        shape = linear.shape(equation.equation.residual)
        if shape is None:
            kept.append(equation)
            continue
        atoms = equation.atoms()
        first = atoms[shape.i]
        if shape.j < 0:
            if first.kind == "variable":
                zeros.append(first.index)
            else:
                kept.append(equation)
            continue
        second = atoms[shape.j]
        if first.kind == "variable" and second.kind == "variable":
            _join(union, first.index, second.index, shape.sign, equation.text)
        elif first.kind != second.kind:
            w, x = (first, second) if second.kind == "der" else (second, first)
            derivatives.append((equation, w, x, shape.sign))
        else:
            kept.append(equation)
    kept += _join_derivatives(union, derivatives)
    union.prefer(_preference(flat))
    zero = frozenset(union.find(i)[0] for i in zeros) | {
        union.find(i)[0] for i in range(len(union)) if union.is_zero(i)
    }
    pairs = [union.find(i) for i in range(len(union))]
    root = [p[0] for p in pairs]
    eliminated = sum(r != i for i, r in enumerate(root)) + len(zero)
    return Aliases(root, [p[1] for p in pairs], frozenset(zero), kept, eliminated)


def _join(union: SignedUnion, i: int, j: int, sign: int, text: str) -> None:
    if union.union(i, j, sign) is Outcome.KNOWN:
        raise StructureError(
            f"{text}: this equation follows from others",
            cause="the same equality is stated twice, directly or around a loop",
            remedy="remove it, or the one that it repeats; something else is then not determined",
        )


def _join_derivatives(
    union: SignedUnion, derivatives: list[tuple[FlatEquation, Atom, Atom, int]]
) -> list[FlatEquation]:
    """Join the variables that are derivatives of one variable; return the defining equations that remain."""
    waiting = derivatives
    while True:
        defined: dict[int, tuple[int, int]] = {}
        remain, joined = [], False
        for entry in waiting:
            _, w, x, sign = entry
            root, root_sign = union.find(x.index)
            if root not in defined:
                defined[root] = (w.index, sign * root_sign)
                remain.append(entry)
                continue
            other, other_sign = defined[root]
            if union.union(w.index, other, sign * root_sign * other_sign) is Outcome.KNOWN:
                remain.append(entry)  # stated twice: the matching will name it
            else:
                joined = True
        waiting = remain
        if not joined:
            return [entry[0] for entry in waiting]


def _preference(flat: FlatSystem) -> Callable[[int], tuple[object, ...]]:
    """Return the key of the variable that stands for its set: a state, then a given start, then the nearest path."""
    has_rate = {e.equation: any(a.kind == "der" for a in e.equation.atoms) for e in flat.equations}
    states = {a.index for e in flat.equations if has_rate[e.equation] for a in e.atoms() if a.kind == "der"}
    inputs = set(flat.inputs)

    def key(i: int) -> tuple[object, ...]:
        declared = flat.variables[i]
        given = declared.start is not None
        inner = declared.quantity.kind in ("potential", "flow")
        return (i not in inputs, i not in states, not given, inner, declared.path.count("."), i)

    return key
