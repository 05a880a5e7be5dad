"""Writes docs/components.md and docs/components/ from the components: ``python docs/build_reference.py``."""

from __future__ import annotations

import ast
import importlib
import inspect
import math
import pkgutil
import re
import sys
import textwrap
from collections.abc import Iterable, Sequence
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any

import arthur_acausal.components
from arthur_acausal import Component, Connector, Real, Record
from arthur_acausal.result.display import display_unit, pretty_unit

HEAD = """\
# Component reference

Made from the docstrings and declarations of the components by `python docs/build_reference.py`: change them there.
Import a component from its library: `from arthur_acausal.components.hydraulic import Orifice`.

Numbers are SI. A parameter without a default must be given. Every variable can be read from a solution by its path.
Signs: a flow is positive into the component; see [sign conventions](sign-conventions.md). Sources in short:
Merritt, *Hydraulic Control Systems* (1967); "report" is NRL's closeout report on ARTHuR by Williams, Hays and
Tabatabai (2022), see [the powertrain](powertrain.md).
"""

SIGNALS = {"input": "in", "output": "out"}


def render() -> dict[str, str]:
    """All pages by their path below docs/."""
    libraries = [
        importlib.import_module(f"{arthur_acausal.components.__name__}.{module.name}")
        for module in pkgutil.iter_modules(arthur_acausal.components.__path__)
        if module.ispkg
    ]
    pages = {f"components/{short(library)}.md": section(library) for library in libraries}
    pages["components.md"] = "\n".join([HEAD, *(overview(library) for library in libraries)]).rstrip() + "\n"
    return pages


def overview(library: ModuleType) -> str:
    """A library's part of the first page: each class with the first line of its docstring."""
    page = f"components/{short(library)}.md"
    rows = [[f"[{name}]({page}#{name.lower()})", first_line(kind)] for name, kind in classes(library)]
    listed = table(["component", "what it is"], rows)
    return f"## {short(library)}\n\n[{inspect.getdoc(library)}]({page})\n\n{listed}\n"


def first_line(kind: type[Any]) -> str:
    """The first line of a docstring."""
    return docstring(kind).partition("\n")[0]


def short(library: ModuleType) -> str:
    """Name of a library without the package."""
    return library.__name__.rpartition(".")[2]


def classes(library: ModuleType) -> list[tuple[str, type[Any]]]:
    """Public components, connectors and records of a library, connectors first, then by name."""
    found = [(name, getattr(library, name)) for name in library.__all__]
    models = [
        (n, c) for n, c in found if inspect.isclass(c) and issubclass(c, Component | Connector | Record)
    ]
    return sorted(models, key=lambda item: (issubclass(item[1], Component), item[0]))


def section(library: ModuleType) -> str:
    """One library: its docstring, its classes, its functions and constants."""
    parts = [f"# {short(library)}", f"`{library.__name__}`: {inspect.getdoc(library)}"]
    parts += ["Made by `python docs/build_reference.py`. [All libraries](../components.md)"]
    parts += [entry(name, kind) for name, kind in classes(library)]
    others = [(n, getattr(library, n)) for n in library.__all__ if n not in dict(classes(library))]
    parts += [function(name, value) for name, value in others if inspect.isfunction(value)]
    parts += [constant(library, name, value) for name, value in others if isinstance(value, float)]
    return "\n\n".join(parts) + "\n"


def entry(name: str, kind: type[Any]) -> str:
    """One class: docstring, ports, structural parameters, parameters, signals, variables."""
    what = (
        "component"
        if issubclass(kind, Component)
        else "connector"
        if issubclass(kind, Connector)
        else "record"
    )
    bases = [b.__name__ for b in kind.__bases__ if b not in (Component, Connector, Record)]
    declared = kind._declarations
    quantities = declared.written.values()
    extends = f", extends `{bases[0]}`" if bases else ""
    parts = [f"## {name}", f"{what}{extends}, {source(kind)}", docstring(kind)]
    parts += [ports(declared.parts), structural(kind, declared.structural)]
    parts += [parameters(kind, [q for q in quantities if q.kind == "parameter"])]
    parts += [signals([q for q in quantities if q.kind in SIGNALS])]
    rest = [q for q in quantities if q.kind not in SIGNALS and q.kind != "parameter"]
    parts += [variables(rest, connector=what == "connector")]
    return "\n\n".join(part for part in parts if part)


def source(kind: type[Any]) -> str:
    """A link to the file that defines a class."""
    module = kind.__module__.removeprefix("arthur_acausal.").replace(".", "/")
    return f"[{module}.py](../../{module}.py)"


def docstring(kind: Any) -> str:
    """The docstring; text beneath a heading of dashes is left as it is."""
    return (inspect.getdoc(kind) or "").strip()


def ports(parts: dict[str, Any]) -> str:
    """Connectors, records and parts."""
    rows = [f"`{name}` ({type(part).__name__})" for name, part in parts.items()]
    return f"Ports and parts: {', '.join(rows)}." if rows else ""


def structural(kind: type[Any], values: dict[str, Any]) -> str:
    """Structural parameters; a value that was never given shows no default."""
    notes = {n: t for base in reversed(kind.__mro__) for n, t in getattr(base, "__annotations__", {}).items()}
    rows = [
        [f"`{name}`", str(getattr(notes.get(name), "__name__", notes.get(name))), plain_default(value)]
        for name, value in values.items()
    ]
    return table(["structural parameter", "type", "default"], rows)


def plain_default(value: Any) -> str:
    """A structural parameter's default as Python writes it."""
    return f"`{value!r}`" if isinstance(value, str | int | float | bool | tuple | None) else "required"


def parameters(kind: type[Any], quantities: Sequence[Real]) -> str:
    """Parameters with unit, default, bounds and description."""
    rows = [[f"`{q.name}`", code(q.unit), default(kind, q), bounds(q), q.description] for q in quantities]
    return table(["parameter", "unit", "default", "bounds", ""], rows)


def signals(quantities: Sequence[Real]) -> str:
    """Inputs and outputs."""
    rows = [
        [f"`{q.name}`", SIGNALS[q.kind], code(q.unit), number(q.default), bounds(q), q.description]
        for q in quantities
    ]
    return table(["signal", "", "unit", "default", "bounds", ""], rows)


def variables(quantities: Sequence[Real], connector: bool) -> str:
    """All other quantities."""
    rows = [
        [f"`{q.name}`", code(q.unit), q.kind if connector or q.kind == "discrete" else "", q.description]
        for q in quantities
    ]
    return table(["variable", "unit", "", ""], rows)


def default(kind: type[Any], quantity: Real) -> str:
    """A parameter's default: a number, in people's unit too, or the expression that gives it."""
    if quantity.default is None:
        return "required"
    if callable(quantity.default):
        return expression(kind, quantity.name)
    text = number(quantity.default)
    if quantity.display and isinstance(quantity.default, int | float):
        unit = display_unit(quantity.unit, quantity.display, abs(quantity.default))
        text += f" ({unit.from_si(quantity.default):.4g} {pretty_unit(unit.text)})"
    return text


def expression(kind: type[Any], name: str) -> str:
    """The body of a default that is a function of the component, from the source."""
    owner = next(base for base in kind.__mro__ if name in base.__dict__)
    tree = ast.parse(textwrap.dedent(inspect.getsource(owner)))
    for node in ast.walk(tree):
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.target.id == name:
            assert isinstance(node.value, ast.Call)
            given = next(word.value for word in node.value.keywords if word.arg == "default")
            if isinstance(given, ast.Lambda):
                return code(ast.unparse(given.body).replace("self.", ""))
            return code(ast.unparse(given))  # the name of a function
    raise LookupError(name)


def bounds(quantity: Real) -> str:
    """min and max, as people write them."""
    low, high = quantity.min, quantity.max
    if low is not None and high is not None:
        return f"{low:g} to {high:g}"
    return f"at least {low:g}" if low is not None else f"at most {high:g}" if high is not None else ""


def number(value: Any) -> str:
    """A number, not longer than it need be; nothing for none."""
    if value is None:
        return ""
    if not isinstance(value, int | float):
        return code(str(value))
    return f"{value:.6g}" if math.isfinite(value) else str(value)


def code(text: str) -> str:
    """Text as code."""
    return f"`{text}`"


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table; columns without any content are left out, and the table where there is no row."""
    listed = [[cell.replace("|", "\\|") for cell in row] for row in rows]
    used = [k for k, title in enumerate(head) if k == 0 or any(row[k] for row in listed)]
    if not listed:
        return ""
    lines = [[head[k] for k in used], ["---"] * len(used), *([row[k] for k in used] for row in listed)]
    return "\n".join(re.sub(r" +\|$", " |", f"| {' | '.join(line)} |") for line in lines)


def function(name: str, value: Any) -> str:
    """A function: signature and docstring."""
    signature = str(inspect.signature(value)).replace("'", "")
    return f"## {name}\n\n```python norun\n{name}{signature}\n```\n\n{docstring(value)}"


def constant(library: ModuleType, name: str, value: float) -> str:
    """A constant, with the text that stands below it in its module."""
    modules = [module for key, module in sys.modules.items() if key.startswith(f"{library.__name__}.")]
    for body in (ast.parse(inspect.getsource(module)).body for module in modules):
        for node, following in pairwise(body):
            named = isinstance(node, ast.Assign) and any(getattr(t, "id", "") == name for t in node.targets)
            if named and isinstance(following, ast.Expr) and isinstance(following.value, ast.Constant):
                return f"## {name}\n\n{value:.12g}. {following.value.value}"
    return f"## {name}\n\n{value:.12g}"


if __name__ == "__main__":
    folder = Path(__file__).parent
    pages = render()
    (folder / "components").mkdir(exist_ok=True)
    for name, text in pages.items():
        (folder / name).write_text(text, encoding="utf-8")
    for page in (folder / "components").glob("*.md"):
        if f"components/{page.name}" not in pages:
            page.unlink()  # of a library that is no more
