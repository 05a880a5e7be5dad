"""The author's own code: which line of it is being run, and what went wrong in it."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType, TracebackType
from typing import Any

import casadi as ca

from arthur_acausal.declare.absent import condition_of, none_in
from arthur_acausal.errors import ArthurError, DeclarationError, nearest_or_all

# Code between the author's line and what it asks for: this package's stages (not components and models), CasADi.
_PACKAGE = Path(__file__).parents[1]
_BETWEEN = (
    *(str(_PACKAGE / name) for name in ("declare", "flatten", "transform", "codegen", "api.py")),
    str(Path(ca.__file__).parent),
    "<string>",  # the __init__ that a dataclass makes
)

_SHAPES = re.compile(r"[Dd]imension.*?(\d+x\d+).*?(\d+x\d+)", re.DOTALL)
SYMBOL_AS_TRUTH = "truth value"  # what CasADi's message for bool(symbol) contains


def calling_line() -> str:
    """Return file:line of the author's code that is being run; empty where the command line makes a model."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None and frame.f_code.co_filename.startswith(_BETWEEN):
        frame = frame.f_back
    if frame is None or frame.f_code.co_filename.startswith(str(_PACKAGE / "cli")):
        return ""
    return place(frame.f_code.co_filename, frame.f_lineno)


def place(filename: str, line: int) -> str:
    """Return file:line as messages show it."""
    return f"{Path(filename).name}:{line}"


def defined_at(function: Any) -> str:
    """Return file:line of a function of the author's."""
    code = getattr(function, "__code__", None)
    return place(code.co_filename, code.co_firstlineno) if code is not None else ""


def traced(error: BaseException) -> str:
    """Return file:line of the innermost line of the author's code that an error came through."""
    found = _innermost(error)
    return place(found.tb_frame.f_code.co_filename, found.tb_lineno) if found is not None else ""


def _innermost(error: BaseException) -> TracebackType | None:
    found, trace = None, error.__traceback__
    while trace is not None:
        if not trace.tb_frame.f_code.co_filename.startswith(_BETWEEN):
            found = trace
        trace = trace.tb_next
    return found


@contextmanager
def authored(what: str, path: str, where: str = "") -> Iterator[None]:
    """Raise as an ArthurError with ``path`` and file:line what the author's code raises in it.

    ``what``: "build()", for instance; ``where`` stands in where the error did not come through the author's code.
    """
    try:
        yield
    except ArthurError as error:
        error.path = error.path or path
        error.where = error.where or traced(error) or where
        raise
    except Exception as error:
        raise _explained(error, what, path, traced(error) or where) from error


def _explained(error: Exception, what: str, path: str, where: str) -> DeclarationError:
    if SYMBOL_AS_TRUTH in str(error):
        return _truth(what, path, where)
    if (shapes := _SHAPES.search(str(error))) is not None:
        return _mismatch(shapes, what, path, where)
    if isinstance(error, AttributeError) and error.name and hasattr(error.obj, "_declarations"):
        return _attribute(error.obj, error.name, path, where)
    if isinstance(error, AttributeError) and error.name and error.obj is None:
        return _none(error, error.name, path, where)
    return DeclarationError(
        f"{what} failed: {error}",
        path=path,
        where=where,
        cause=f"Python raised {type(error).__name__}",
        remedy="correct the line, or what it is given",
    )


def _mismatch(shapes: re.Match[str], what: str, path: str, where: str) -> DeclarationError:
    return DeclarationError(
        f"the shapes {shapes[1]} and {shapes[2]} do not fit in one expression",
        path=path,
        where=where,
        cause=f"met in {what}; a vector is a column",
        remedy="take vectors of one length, or a scalar with a vector; casadi.mtimes (@) multiplies by a matrix",
    )


def _truth(what: str, path: str, where: str) -> DeclarationError:
    remedy = "use if_else(condition, a, b), casadi.logic_and / logic_or, casadi.fmax / fmin"
    if what == "build()":
        remedy = "decide by a structural parameter, a plain Python attribute such as `closed: bool = False`"
    return DeclarationError(
        "a Python `if` (or `and`, `or`, `not`, max, min) on a symbol, whose value is not known here",
        path=path,
        where=where,
        cause="the code runs once, before there are any values",
        remedy=remedy,
    )


def _none(error: AttributeError, name: str, path: str, where: str) -> DeclarationError:
    found = _innermost(error)
    written, condition = none_in(found.tb_frame, found.tb_lineno, name) if found is not None else ("", "")
    guard = condition or f"{written or 'the part'} is not None"
    return DeclarationError(
        f"{written or 'a part'} is absent: it is None, and has no {name!r}",
        path=path,
        where=where,
        cause=f"build() makes it only if {condition}" if condition else "it was not given",
        remedy=f"write `if {guard}:` around what uses it, or give it",
    )


def _attribute(model: Any, name: str, path: str, where: str) -> DeclarationError:
    if condition := condition_of(type(model), name):
        return DeclarationError(
            f"{type(model).__name__} has no {name!r} here",
            path=path,
            where=where,
            cause=f"build() makes it only if {condition}",
            remedy=f"write `if {condition}:` around what uses it, or make the component so that it is there",
        )
    known = model._declarations.names
    known += [n for n in model.__dict__ if not n.startswith("_") and n not in known]
    return DeclarationError(
        f"{type(model).__name__} has no {name!r}",
        path=path,
        where=where,
        remedy=nearest_or_all(name, known),
    )
