"""The commands of `arthur` and their options."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from arthur_acausal.cli.failure import quiet, reported

app = typer.Typer(
    name="arthur",
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode=None,  # plain help: importing rich costs more than all the rest
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)


def show_version(wanted: bool) -> None:
    """Print the version and end."""
    if wanted:
        from arthur_acausal import __version__

        typer.echo(f"arthur {__version__}")
        raise typer.Exit


Version = Annotated[
    bool, typer.Option("--version", callback=show_version, is_eager=True, help="Show the version and exit.")
]


@app.callback()
def arthur(version: Version = False) -> None:
    """Simulate acausal, equation-based models: hydraulics, mechanics, control."""


Model = Annotated[
    str, typer.Argument(metavar="MODEL", help="arthur.powertrain, package.module:Class or file.py:Class")
]
Set = Annotated[
    list[str] | None,
    typer.Option(
        "--set", metavar="PATH=VALUE", help="Set a parameter: SI, or with a unit (150bar). Repeatable."
    ),
]
Input = Annotated[
    list[str] | None,
    typer.Option("--input", metavar="PATH=VALUE", help="An input: a value or file.csv:column. Repeatable."),
]
Start = Annotated[
    list[str] | None, typer.Option("--start", metavar="PATH=VALUE", help="A start value. Repeatable.")
]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Debug = Annotated[bool, typer.Option("--debug", help="Show the traceback of an error.")]


@app.command("list")
@reported
def list_models(debug: Debug = False) -> None:
    """List the models that ship with the package."""
    from arthur_acausal.cli.table import table
    from arthur_acausal.models import DESCRIPTIONS, REGISTRY

    typer.echo(table([[name, DESCRIPTIONS.get(name, "")] for name in REGISTRY], "lw", indent=0))


@app.command()
@reported
def info(
    model: Model,
    settings: Set = None,
    diagram: Annotated[
        Path | None,
        typer.Option("--diagram", metavar="FILE.svg", help="Draw parts and connections (svg, png, pdf)."),
    ] = None,
    incidence: Annotated[
        Path | None,
        typer.Option("--incidence", metavar="FILE.png", help="Draw the ordered incidence matrix."),
    ] = None,
    debug: Debug = False,
) -> None:
    """Describe a model: its parts, parameters and inputs."""
    from arthur_acausal.cli.info import describe

    typer.echo(describe(model, settings or [], diagram, incidence))


@app.command()
@reported
def check(model: Model, settings: Set = None, as_json: Json = False, debug: Debug = False) -> None:
    """Check a model's structure, and how it is solved."""
    from arthur_acausal.api import translate
    from arthur_acausal.cli.structure import as_object, as_text, only_structural
    from arthur_acausal.request.locate import build_model

    with quiet(as_json):
        built = build_model(model, settings or [])
        only_structural(built)
        # All of the translation, so that whatever it refuses is told here, too.
        found = translate(built.model, name=built.name, compile="never").report
    typer.echo(json.dumps(as_object(found), ensure_ascii=False) if as_json else as_text(found))


@app.command()
@reported
def simulate(
    model: Model,
    stop: Annotated[
        str | None,
        typer.Option("-t", "--stop-time", metavar="TIME", help="s, or with a unit (200ms); default 1 s."),
    ] = None,
    settings: Set = None,
    inputs: Input = None,
    starts: Start = None,
    rtol: Annotated[
        float | None, typer.Option(metavar="TOL", help="Relative tolerance of a step; default 1e-6.")
    ] = None,
    points: Annotated[
        int | None, typer.Option(metavar="N", help="Number of output intervals; default 500.")
    ] = None,
    interval: Annotated[
        str | None, typer.Option(metavar="TIME", help="Length of an output interval.")
    ] = None,
    max_step: Annotated[str | None, typer.Option(metavar="TIME", help="Longest step of the solver.")] = None,
    steady: Annotated[bool, typer.Option("--steady", help="Begin at rest, sought from the start.")] = False,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE.nc", help="Write all variables (NetCDF).")
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option("--plot", metavar="FILE.png", help="Draw the model's picture (png, pdf, svg)."),
    ] = None,
    verify: Annotated[
        bool, typer.Option("--verify", help="Check the result against every raw equation.")
    ] = False,
    power: Annotated[
        bool, typer.Option("--power", help="Add the energy that enters each part by its connectors.")
    ] = False,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Simulate a model; print statistics, energies and final states."""
    from arthur_acausal.cli.simulate import Request
    from arthur_acausal.cli.simulate import simulate as carry_out

    text = carry_out(
        Request(
            model=model,
            stop=stop,
            settings=settings or (),
            inputs=inputs or (),
            starts=starts or (),
            rtol=rtol,
            points=points,
            interval=interval,
            max_step=max_step,
            output=output,
            picture=picture,
            verify=verify,
            power=power,
            steady=steady,
            as_json=as_json,
        )
    )
    typer.echo(text)


@app.command()
@reported
def linearize(
    model: Model,
    at: Annotated[
        str | None, typer.Option("--at", metavar="TIME", help="Simulate up to here; default: the start.")
    ] = None,
    steady: Annotated[bool, typer.Option("--steady", help="About the state of rest.")] = False,
    settings: Set = None,
    inputs: Input = None,
    starts: Start = None,
    outputs: Annotated[
        list[str] | None,
        typer.Option("--output", metavar="PATH", help="An output; default: all states. Repeatable."),
    ] = None,
    bode: Annotated[
        Path | None, typer.Option("--bode", metavar="FILE.png", help="Draw gain and phase (png, pdf, svg).")
    ] = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Linearise a model: matrices, eigenvalues, Bode plots."""
    from arthur_acausal.cli.linearize import Request
    from arthur_acausal.cli.linearize import linearize as carry_out

    text = carry_out(
        Request(
            model=model,
            at=at,
            steady=steady,
            settings=settings or (),
            inputs=inputs or (),
            starts=starts or (),
            outputs=outputs or (),
            bode=bode,
            as_json=as_json,
        )
    )
    typer.echo(text)


@app.command()
@reported
def export(
    model: Model,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE.mo", help="Default: standard output.")
    ] = None,
    form: Annotated[str, typer.Option("--format", metavar="FORMAT", help="modelica.")] = "modelica",
    settings: Set = None,
    debug: Debug = False,
) -> None:
    """Write a model for other tools: one flat Modelica model."""
    from arthur_acausal.cli.export import export as carry_out

    typer.echo(carry_out(model, form, settings or [], output))


@app.command()
@reported
def plot(
    file: Annotated[Path, typer.Argument(metavar="FILE.nc", help="A result of `arthur simulate -o`.")],
    variables: Annotated[
        list[str], typer.Argument(metavar="VAR...", help="Paths or patterns: 'valves[*].I'.")
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE.png", help="Default: FILE with .png.")
    ] = None,
    debug: Debug = False,
) -> None:
    """Draw variables of a result over time, one panel for each unit."""
    from arthur_acausal.result.stored import load

    target = output or file.with_suffix(".png")
    load(file).plot(variables, target)
    typer.echo(f"wrote {target}")


@app.command()
@reported
def render(
    file: Annotated[Path, typer.Argument(metavar="FILE.nc", help="A result of `arthur simulate -o`.")],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FILE", help="A film (mp4, gif) or a film strip (png).")
    ],
    shown: Annotated[
        list[str] | None,
        typer.Option("--show", metavar="VAR", help="Draw this beside it: a path or pattern. Repeatable."),
    ] = None,
    body: Annotated[str, typer.Option(metavar="PATH", help="The MuJoCo body, where there are several.")] = "",
    camera: Annotated[str, typer.Option(metavar="NAME", help="Of the MJCF; default: one that follows.")] = "",
    size: Annotated[str, typer.Option(metavar="WxH", help="Of the body's picture, pixels.")] = "640x480",
    fps: Annotated[float, typer.Option(metavar="N", help="Frames a second.")] = 25.0,
    speed: Annotated[
        float, typer.Option(metavar="N", help="Simulated over shown time: 0.2 is slow motion.")
    ] = 1.0,
    frames: Annotated[int, typer.Option(metavar="N", help="Pictures of a film strip.")] = 8,
    debug: Debug = False,
) -> None:
    """Draw a film of a run's rigid bodies, with curves beside them."""
    from arthur_acausal.cli.render import render as carry_out

    typer.echo(
        carry_out(
            file,
            output,
            body=body,
            camera=camera,
            size=size,
            fps=fps,
            speed=speed,
            frames=frames,
            shown=shown,
        )
    )
