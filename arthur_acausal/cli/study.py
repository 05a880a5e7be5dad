"""The commands `arthur study ...`: whole studies that end in tables, figures and findings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from arthur_acausal.cli.app import Debug
from arthur_acausal.cli.failure import reported

study = typer.Typer(
    no_args_is_help=True, rich_markup_mode=None, help="Studies: tables, figures and findings."
)


@study.callback()
def studies() -> None:
    """Carry out a study of the ARTHuR quadruped: tables, figures and findings."""


@study.command()
@reported
def valves(
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Where the files go.")],
    designs: Annotated[
        int, typer.Option("--designs", metavar="N", min=0, help="Rotary valves to draw and try; 0: none.")
    ] = 0,
    debug: Debug = False,
) -> None:
    """Compare the rotary with the spool valve: sections 3 and 4 of the report."""
    from arthur_acausal.models.arthur.valve_study import write_study

    typer.echo(write_study(output, _sweeping(output, designs) if designs else None))


def _sweeping(folder: Path, samples: int) -> Callable[[str, Mapping[str, Any]], Any]:
    """Return what carries out the study's sweeps, each in a folder of its own that a second call goes on with."""
    from arthur_acausal.sweep import sweep

    model = "arthur_acausal.models.arthur.valves.strokes:RotaryStroke"

    def carry_out(name: str, specification: Mapping[str, Any]) -> Any:
        target = folder / f"{name}-{samples}"
        found = sweep(model, stop_time=1.0, samples=samples, folder=target, resume=True, **specification)
        return found.table.to_dict("list")

    return carry_out
