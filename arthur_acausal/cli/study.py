"""The commands `arthur study ...`: whole studies that end in tables, figures and findings."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import typer

from arthur_acausal.cli.app import Debug
from arthur_acausal.cli.failure import reported

PRINTS = 60
"""How often the best design is printed again, at most."""

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
    ] = 200,
    debug: Debug = False,
) -> None:
    """Compare the rotary with the spool valve: sections 3 and 4 of the report."""
    from arthur_acausal.models.arthur.valve_study import write_study
    from arthur_acausal.models.arthur.valves.trot import trots

    typer.echo(write_study(output, _sweeping(output, designs) if designs else None, trots()))


@study.command()
@reported
def powertrain(
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Where the files go.")],
    quick: Annotated[bool, typer.Option("--quick", help="Few tasks, seeds and set points.")] = False,
    workers: Annotated[
        int | None,
        typer.Option("-j", "--workers", metavar="N", min=1, help="Processes; default: one a core."),
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Go on with what DIR holds.")] = False,
    seeds: Annotated[
        int | None,
        typer.Option("--seeds", metavar="N", min=1, help="Of the core tasks; default 10, quick 3."),
    ] = None,
    few: Annotated[
        int | None, typer.Option("--few", metavar="N", min=1, help="Seeds of all else; default 10, quick 2.")
    ] = None,
    scheme: Annotated[
        list[str] | None, typer.Option("--scheme", metavar="NAME", help="Only these; may be given again.")
    ] = None,
    debug: Debug = False,
) -> None:
    """Compare ways of driving the pump: how much power foresight of the legs' need saves."""
    from arthur_acausal.models.arthur.powertrain_study import write_study
    from arthur_acausal.models.arthur.study.design import QUICK, Size
    from arthur_acausal.models.arthur.study.schemes import SCHEMES, scheme_named

    size = QUICK if quick else Size()
    size = replace(size, seeds=seeds or size.seeds, few=few or size.few)
    chosen = [scheme_named(name) for name in scheme] if scheme else SCHEMES
    typer.echo(write_study(output, _trials(output / "runs", workers, resume), size, chosen))


def _trials(folder: Path, workers: int | None, resume: bool) -> Callable[[str, Mapping[str, Any]], Any]:
    """Return what carries out the sweeps of the powertrain's study, each in a folder of its own."""
    from arthur_acausal.sweep import sweep

    model = "arthur_acausal.models.arthur.study.trial:Trial"

    def carry_out(name: str, specification: Mapping[str, Any]) -> Any:
        bar = sys.stderr.isatty()
        found = sweep(
            model, folder=folder / name, workers=workers, resume=resume, progress=bar, **specification
        )
        typer.echo(f"{name}: {len(found.table)} runs", err=True)
        return found.table.to_dict("list")

    return carry_out


def _sweeping(folder: Path, samples: int) -> Callable[[str, Mapping[str, Any]], Any]:
    """Return what carries out the study's sweeps, each in a folder of its own that a second call goes on with."""
    from arthur_acausal.sweep import sweep

    model = "arthur_acausal.models.arthur.valves.strokes:RotaryStroke"

    def carry_out(name: str, specification: Mapping[str, Any]) -> Any:
        target = folder / f"{name}-{samples}"
        found = sweep(
            model,
            stop_time=1.0,
            samples=samples if name == "designs" else min(samples, PRINTS),
            folder=target,
            resume=True,
            progress=sys.stdout.isatty(),
            **specification,
        )
        return found.table.to_dict("list")

    return carry_out
