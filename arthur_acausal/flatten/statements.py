"""What a component yields, statement by statement, each with its label and source line; of vectors the elements."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from casadi import SX

from arthur_acausal.declare.authored import authored, defined_at, place
from arthur_acausal.declare.model import Component, title_of
from arthur_acausal.declare.scope import Scope
from arthur_acausal.declare.statement import Reinit
from arthur_acausal.declare.vector import elements
from arthur_acausal.errors import DeclarationError

_OVER = object()


def statements(component: Component, scope: Scope, method: str) -> Iterator[tuple[Any, str, str]]:
    """Yield (statement, label, file:line); a statement may be yielded alone or as (label, statement)."""
    title = title_of(component)
    line = defined_at(getattr(type(component), method))
    with authored(f"{method}()", title, line):
        generator = getattr(component, method)()
    if not hasattr(generator, "gi_frame"):
        raise bad(component, line, f"{method}() yields nothing", "write `yield lhs == rhs` for each equation")
    while True:
        made = len(scope.relations)
        with authored(f"{method}()", title, line):
            item = next(generator, _OVER)
        if item is _OVER:
            return
        where = _line(generator)
        for i in range(made, len(scope.relations)):
            scope.relations[i] = replace(scope.relations[i], where=where)
        label, statement = item if isinstance(item, tuple) and len(item) == 2 else ("", item)
        if not isinstance(statement, SX) or statement.numel() == 1:
            yield statement, label, where
            continue
        for k, element in enumerate(_rows(statement, component, where)):
            yield element, f"{label}[{k}]" if label else "", where


def _rows(statement: SX, component: Component, where: str) -> list[SX]:
    """Return the equations of a column, one each."""
    if statement.numel() and not statement.is_vector():
        raise bad(
            component,
            where,
            f"{statement.size1()} x {statement.size2()} equations at once",
            "yield them column by column: lhs[:, 0] == rhs[:, 0]",
        )
    return elements(statement)


def _line(generator: Any) -> str:
    while getattr(generator, "gi_yieldfrom", None) is not None and hasattr(
        generator.gi_yieldfrom, "gi_frame"
    ):
        generator = generator.gi_yieldfrom
    frame = generator.gi_frame
    return place(frame.f_code.co_filename, frame.f_lineno)


def bad(component: Component, where: str, message: str, remedy: str = "") -> DeclarationError:
    """Return the error of a statement that a component cannot yield."""
    return DeclarationError(message, path=title_of(component), where=where, remedy=remedy)


def each_of(statement: Any, where: str) -> list[Any]:
    """Return what a statement in ``when`` says of each element of a vector."""
    if isinstance(statement, SX):
        return elements(statement)
    if not isinstance(statement, Reinit) or statement.target.numel() == statement.value.numel() == 1:
        return [statement]
    targets, values = elements(statement.target), elements(statement.value)
    if len(values) not in (1, len(targets)):
        raise DeclarationError(
            f"reinit() of {len(targets)} states to {len(values)} values",
            where=where,
            remedy="give one value for all, or one for each",
        )
    return [
        Reinit(x, value) for x, value in zip(targets, values * (len(targets) // len(values)), strict=True)
    ]
