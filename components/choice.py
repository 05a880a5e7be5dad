"""Structural options that are one of a few words."""

from __future__ import annotations

from typing import get_args

from arthur_acausal import Component, DeclarationError


def check_choice(component: Component, name: str, choices: object) -> None:
    """Raise DeclarationError unless the structural option ``name`` is one of a ``Literal``'s words."""
    known, given = get_args(choices), getattr(component, name)
    if given not in known:
        raise DeclarationError(
            f"{type(component).__name__} has no {name} {given!r}",
            remedy=f"choose one of {', '.join(map(repr, known))}",
        )
