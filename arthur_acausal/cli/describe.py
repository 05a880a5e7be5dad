"""What `arthur info` tells of a model."""

from __future__ import annotations

import inspect
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from arthur_acausal.cli.alike import alike
from arthur_acausal.cli.table import WIDTH, count, number, table
from arthur_acausal.request.settings import annotation, structural_parameters
from arthur_acausal.result.display import display_unit, pretty_unit

if TYPE_CHECKING:
    from arthur_acausal.api import Translation


def as_text(translation: Translation, given: Mapping[str, float | str]) -> str:
    """Docstring, parts, structural parameters, parameters (some of them given) and inputs of a model."""
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
        f"{flat.name}: {counts}\n\n{filled(unquoted(inspect.getdoc(type(model)) or ''))}",
        titled("parts", parts(translation)),
        titled("structural parameters", structural(type(model), model)),
        titled("parameters", parameters(translation, given)),
        titled("inputs", inputs(translation)),
    ]
    return "\n\n".join(section for section in sections if section)


def titled(title: str, text: str) -> str:
    """A section, or nothing where it would be empty."""
    return f"{title}\n{text}" if text else ""


def parts(translation: Translation) -> str:
    """The tree of parts; equal members of an array stand together."""
    found = [
        (c._binding.path, type(c)) for c in translation.flat.components if c._binding and c._binding.path
    ]
    rows = [
        [f"{'  ' * path.count('.')}{path.rpartition('.')[2]}", kinds[0].__name__, summary(kinds[0])]
        for path, kinds in alike(found)
    ]
    room = WIDTH - sum(max((len(row[k]) for row in rows), default=0) for k in (0, 1)) - 6
    return table([[name, kind, shortened(text, room)] for name, kind, text in rows], "lll")


def summary(kind: type[Any]) -> str:
    """The first line of a class's docstring, or of the class that it specialises."""
    from arthur_acausal.declare.model import Component

    text = inspect.getdoc(kind) or ""
    return "" if text == inspect.getdoc(Component) else text.partition("\n")[0]


def shortened(text: str, room: int) -> str:
    """A text of one line; what does not fit is cut at a word."""
    text = unquoted(text)
    if len(text) <= room:
        return text
    return text[: room - 1].rpartition(" ")[0] + "…" if room > 10 else ""


def unquoted(text: str) -> str:
    """A docstring as people read it: code without its quotes."""
    return re.sub(r"``(.+?)``", r"\1", text)


def filled(text: str, width: int = WIDTH) -> str:
    """A docstring with its paragraphs filled to a line's width; what is indented stays as it is."""
    import textwrap

    paragraphs = [
        part if "\n " in part else textwrap.fill(part, width, break_long_words=False, break_on_hyphens=False)
        for part in text.split("\n\n")
    ]
    return "\n\n".join(paragraphs)


def structural(kind: type[Any], model: object) -> str:
    """Structural parameters, their values and types."""
    rows = []
    for name in structural_parameters(kind):
        wanted = annotation(kind, name)
        text = wanted.__name__ if inspect.isclass(wanted) else str(wanted).replace("typing.", "")
        rows.append([name, repr(getattr(model, name, None)), text])
    return table(rows, "llw")


def parameters(translation: Translation, given: Mapping[str, float | str]) -> str:
    """Parameters with their values and units; equal ones of an array's members stand together."""
    table_of = translation.dae.parameters
    pairs = zip(table_of.infos, table_of.vector(given).tolist(), strict=True)
    rows = []
    for name, members in alike((info.path, (info, value)) for info, value in pairs):
        equal = len({value for _, value in members}) == 1
        for info, value in members[:1] if equal else members:
            unit = display_unit(info.unit, info.display or "", abs(value))
            text = number(unit.from_si(value), 6)
            rows.append([name if equal else info.path, text, pretty_unit(unit.text), info.description])
    return table(rows, "lrlw")


def inputs(translation: Translation) -> str:
    """Inputs from outside with their defaults and units; those of an array's members stand together."""
    dae = translation.dae
    triples = zip(dae.u_paths, dae.u_default.tolist(), dae.u_units, strict=True)
    rows = [
        [name, number(members[0][0]), pretty_unit(members[0][1])]
        for name, members in alike((path, (value, unit)) for path, value, unit in triples)
    ]
    return table(rows, "lrl")
