"""The commands `arthur study ...`: whole studies that end in tables, figures and findings."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

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
    debug: Debug = False,
) -> None:
    """Compare the rotary with the spool valve: sections 3 and 4 of the report."""
    from arthur_acausal.models.arthur.valve_study import write_study

    typer.echo(write_study(output))
