"""What `arthur check` tells of a model's structure."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from arthur_acausal.cli.alike import names
from arthur_acausal.cli.table import count, table, wrap
from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.request.settings import structural_parameters

if TYPE_CHECKING:
    from arthur_acausal.request.locate import Built
    from arthur_acausal.transform.structured import StructureReport

LISTED = 24  # names of a long list that are shown; --json has all
LARGEST = 5  # blocks


def only_structural(built: Built) -> None:
    """Refuse parameter values: they do not change the structure, and would be ignored."""
    for path in built.parameters:
        known = structural_parameters(type(built.model))
        raise UsageError(
            f"--set {path}: {path} is no structural parameter of {type(built.model).__name__}",
            remedy=nearest(path, known) or (f"it has {', '.join(known)}" if known else "it has none"),
        )


def as_object(report: StructureReport) -> dict[str, Any]:
    """The object that --json prints; blocks that need no tearing are counted in `n_blocks` only."""
    found = dataclasses.asdict(report)
    found["blocks"] = [{"equations": size, "torn": torn} for size, torn in report.blocks]
    return found


def as_text(report: StructureReport) -> str:
    """What people read."""
    torn = len(report.torn)
    rows = [
        ["equations", count(report.equations), f"for {count(report.unknowns, 'unknown')}"],
        ["aliases", count(report.aliases), "removed"],
        ["explicit", count(report.assigned), "computed directly from others"],
        [
            "left to IDA",
            count(len(report.states) + torn),
            f"{count(len(report.states), 'state')}, {torn} algebraic",
        ],
        ["index", str(report.index), "" if report.index < 2 else "reduced to 1 by differentiation"],
        ["relations", count(report.relations), "make events"],
        ["discrete", count(report.discretes), "variables that change at events only"],
        ["inputs", count(len(report.inputs)), "from outside"],
        ["parameters", count(report.parameters)],
    ]
    parts = [f"{report.model}: its equations determine its unknowns", table(rows, "lrw")]
    parts += [listing("states", names(report.states)), listing("algebraic unknowns", names(report.torn))]
    parts += [blocks(report)]
    parts += [listing("differentiated equations", report.differentiated, one_a_line=True)]
    parts += [listing("derivatives that became algebraic", names(report.dummies))]
    parts += [listing("inputs", names(report.inputs))]
    parts += [listing("notes", report.messages, one_a_line=True)]
    return "\n\n".join(part for part in parts if part)


def listing(title: str, names: Sequence[str], one_a_line: bool = False) -> str:
    """A titled list of names, cut where it is long."""
    if not names:
        return ""
    shown = list(names[:LISTED])
    rest = [f"and {len(names) - LISTED} more (--json lists all)"] if len(names) > LISTED else []
    lines = [*shown, *rest] if one_a_line else [", ".join([*shown, *rest])]
    return "\n".join([title, *(piece for line in lines for piece in wrap("  ", line))])


def blocks(report: StructureReport) -> str:
    """The largest systems of equations that must be solved together."""
    if not report.blocks:
        return ""
    largest = sorted(report.blocks, reverse=True)
    rows = [
        [count(size, "equation"), f"{torn} solved by IDA" if torn else "solved exactly in a row"]
        for size, torn in largest[:LARGEST]
    ]
    more = len(largest) - len(rows)
    rest = f"\n  and {more} smaller" if more > 0 else ""
    title = f"blocks: {count(report.n_blocks)}, of these {len(largest)} with more than one equation"
    return f"{title}\n{table(rows, 'rw')}{rest}"
