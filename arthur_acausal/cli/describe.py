"""What `arthur info` tells of a model."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from arthur_acausal.cli.settings import structural_parameters
from arthur_acausal.cli.table import count, number, table
from arthur_acausal.result.display import display_unit, pretty_unit

if TYPE_CHECKING:
    from arthur_acausal.api import Translation
    from arthur_acausal.codegen.parameters import ParameterInfo

INDEX = re.compile(r"\[(\d+)\]")


class Part(NamedTuple):
    """A part of a model: its path, its class, and how many alike stand in the same array."""

    path: str
    kind: str
    number: int


def as_text(translation: Translation) -> str:
    """Docstring, parts, structural parameters, parameters and inputs of a model."""
    model, flat = translation.model, translation.flat
    counts = ", ".join(
        [
            count(len(flat.components) - 1, "part"),
            count(len(flat.scope.variable), "variable"),
            count(len(flat.scope.parameter), "parameter"),
            count(len(translation.report.states), "state"),
        ]
    )
    sections = [
        f"{flat.name}: {counts}\n\n{inspect.getdoc(type(model)) or '(no description)'}",
        titled("parts", parts(translation)),
        titled("structural parameters", structural(type(model), model)),
        titled("parameters", parameters(translation)),
        titled("inputs", inputs(translation)),
    ]
    return "\n\n".join(section for section in sections if section)


def titled(title: str, text: str) -> str:
    """A section, or nothing where it would be empty."""
    return f"{title}\n{text}" if text else ""


def parts(translation: Translation) -> str:
    """The tree of parts; equal members of an array stand together."""
    found = [
        (component._binding.path, type(component))
        for component in translation.flat.components
        if component._binding
    ]
    rows = [
        [f"{'  ' * depth(part.path)}{last(part.path)}", part.kind, summary(kind)]
        for part, kind in together(found)
        if part.path
    ]
    return table(rows, "llw")


def together(found: Iterable[tuple[str, type[Any]]]) -> list[tuple[Part, type[Any]]]:
    """Parts with each array's members of one class joined to one."""
    groups: dict[tuple[str, type[Any]], list[str]] = {}
    for path, kind in found:
        groups.setdefault((INDEX.sub("[*]", path), kind), []).append(path)
    return [
        (Part(general if len(paths) > 1 else paths[0], kind.__name__, len(paths)), kind)
        for (general, kind), paths in groups.items()
    ]


def depth(path: str) -> int:
    """How deep a part stands below the model."""
    return path.count(".")


def last(path: str) -> str:
    """The last name of a path."""
    return path.rpartition(".")[2]


def summary(kind: type[Any]) -> str:
    """The first sentence of a class's docstring."""
    line = (kind.__doc__ or "").strip().partition("\n")[0]
    return line


def structural(kind: type[Any], model: object) -> str:
    """Structural parameters, their values and types."""
    hints = kind.__annotations__
    rows = []
    for name in structural_parameters(kind):
        annotation = hints.get(name, "")
        rows.append(
            [name, repr(getattr(model, name, None)), str(getattr(annotation, "__name__", annotation))]
        )
    return table(rows, "llw")


def parameters(translation: Translation) -> str:
    """Parameters with their defaults and units; equal ones of an array's members stand together."""
    infos, values = translation.dae.parameters.infos, translation.dae.parameters.vector()
    groups: dict[tuple[str, float], list[ParameterInfo]] = {}
    for info, value in zip(infos, values.tolist(), strict=True):
        groups.setdefault((INDEX.sub("[*]", info.path), value), []).append(info)
    whole: dict[str, int] = {}
    for (general, _), members in groups.items():
        whole[general] = whole.get(general, 0) + len(members)
    rows = []
    for (general, value), members in groups.items():
        alike = len(members) == whole[general] and len(members) > 1
        for info in members[:1] if alike else members:
            rows.append([general if alike else info.path, *shown(value, info), info.description])
    return table(rows, "lrlw")


def shown(value: float, info: ParameterInfo) -> Sequence[str]:
    """A parameter's default in the unit that people read, and this unit."""
    unit = display_unit(info.unit, info.display or "", abs(value))
    return number(unit.from_si(value), 6), pretty_unit(unit.text)


def inputs(translation: Translation) -> str:
    """Inputs from outside with their defaults and units."""
    dae = translation.dae
    groups: dict[tuple[str, float, str], list[str]] = {}
    for path, value, unit in zip(dae.u_paths, dae.u_default.tolist(), dae.u_units, strict=True):
        groups.setdefault((INDEX.sub("[*]", path), value, unit), []).append(path)
    rows = []
    for (general, value, unit), paths in groups.items():
        which = general if len(paths) > 1 else paths[0]
        rows.append(
            [which, number(value), pretty_unit(unit), f"{len(paths)} inputs" if len(paths) > 1 else ""]
        )
    return table(rows, "lrlw")
