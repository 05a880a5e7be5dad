"""Parts that a model does not have: under which condition ``build`` would have made them, and what to do."""

from __future__ import annotations

import ast
import inspect
import linecache
import re
import textwrap
from collections.abc import Iterator, Sequence
from types import FrameType
from typing import Any


def condition_of(cls: type, name: str) -> str:
    """Return the condition on which a class's ``build`` makes a part; empty where it makes none, or always."""
    for base in cls.__mro__:
        try:
            source = inspect.getsource(base.__dict__["build"])
        except (KeyError, OSError, TypeError):  # no build() of its own, or no file that it stands in
            continue
        conditions = next(_conditions(ast.parse(textwrap.dedent(source)).body, name, ()), ())
        if conditions:
            return " and ".join(conditions)
    return ""


def _conditions(body: Sequence[ast.stmt], name: str, above: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """Yield the conditions around each assignment to ``self.name``."""
    for statement in body:
        if isinstance(statement, ast.If):
            test = ast.unparse(statement.test)
            yield from _conditions(statement.body, name, (*above, test))
            yield from _conditions(statement.orelse, name, (*above, f"not ({test})"))
            continue
        targets = (
            statement.targets if isinstance(statement, ast.Assign) else [getattr(statement, "target", None)]
        )
        if any(isinstance(target, ast.Attribute) and target.attr == name for target in targets):
            yield above
        yield from _conditions(getattr(statement, "body", ()), name, above)


def none_in(frame: FrameType, line: int, attribute: str) -> tuple[str, str]:
    """Return what is None in an author's line that asks it for ``attribute``, as written; and when it is not.

    Empty texts where they cannot be told.
    """
    text = linecache.getline(frame.f_code.co_filename, line)
    names = re.findall(rf"([A-Za-z_][\w.]*)\.{re.escape(attribute)}\b", text)
    for written in names:
        first, *between = written.split(".")
        owner: Any = frame.f_locals.get(first)
        for name in between[:-1]:
            owner = getattr(owner, name, None)
        if owner is not None and between and getattr(owner, between[-1], 0) is None:
            return written, condition_of(type(owner), between[-1])
    return "", ""
