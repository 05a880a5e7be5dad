"""The commands of `arthur` that concern many runs, and their options."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from arthur_acausal.cli.app import Debug, Input, Json, Model, Set, Start, app
from arthur_acausal.cli.failure import reported
from arthur_acausal.cli.study import study

__all__ = ["app"]

Many = list[str] | None


@app.command()
@reported
def sweep(
    model: Annotated[
        str, typer.Argument(metavar="MODEL|FILE.toml", help="A model, or a file that specifies the sweep.")
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Where the results are kept.")
    ] = None,
    vary: Annotated[
        Many,
        typer.Option(
            "--vary",
            metavar="PATH=VALUES",
            help="1bar:2bar:5, 1:2/step=0.1, a,b,c, uniform(1, 2), csv(f.csv:col). Repeatable.",
        ),
    ] = None,
    zipped: Annotated[
        Many,
        typer.Option("--zip", metavar="PATH,PATH", help="Factors of a grid that vary together. Repeatable."),
    ] = None,
    derive: Annotated[
        Many,
        typer.Option(
            "--derive", metavar="PATH=EXPRESSION", help="A parameter from others, in SI. Repeatable."
        ),
    ] = None,
    method: Annotated[
        str | None, typer.Option(metavar="METHOD", help="grid (default), zip, random, lhs or sobol.")
    ] = None,
    samples: Annotated[
        int | None, typer.Option(metavar="N", help="How many, for random, lhs and sobol.")
    ] = None,
    seed: Annotated[int | None, typer.Option(metavar="N", help="Of the samples and replicates.")] = None,
    replicates: Annotated[
        int | None, typer.Option(metavar="N", help="Repetitions of each run with seed, seed + 1, ...")
    ] = None,
    seed_parameter: Annotated[
        str | None, typer.Option(metavar="PATH", help="The parameter that is given the seed.")
    ] = None,
    stop: Annotated[
        str | None, typer.Option("-t", "--stop-time", metavar="TIME", help="s, or with a unit (200ms).")
    ] = None,
    settings: Set = None,
    inputs: Input = None,
    starts: Start = None,
    engine: Annotated[
        str | None,
        typer.Option(
            metavar="auto|ida", help="ida: no run without events by the engine in C. [default: auto]"
        ),
    ] = None,
    rtol: Annotated[
        float | None, typer.Option(metavar="TOL", help="Relative tolerance; default 1e-6.")
    ] = None,
    keep: Annotated[
        Many, typer.Option("--keep", metavar="PATH", help="A variable or pattern to keep. Repeatable.")
    ] = None,
    reduce: Annotated[
        Many,
        typer.Option(
            "--reduce",
            metavar="REDUCTION",
            help="max(x), quantile(x, 0.95), first(x > 1), module:function. Repeatable.",
        ),
    ] = None,
    interval: Annotated[
        str | None, typer.Option(metavar="TIME", help="Of the trajectories; default 10 ms.")
    ] = None,
    trajectories: Annotated[
        bool, typer.Option("--trajectories/--no-trajectories", help="Keep trajectories, or reductions only.")
    ] = True,
    workers: Annotated[
        int | None, typer.Option("-j", "--jobs", metavar="N", help="Processes; default: one a core.")
    ] = None,
    scheduler: Annotated[
        str,
        typer.Option(metavar="ADDRESS", help="A Dask scheduler (tcp://HOST:PORT), or local-dask."),
    ] = "",
    resume: Annotated[bool, typer.Option("--resume", help="Go on with what is in the directory.")] = False,
    timeout: Annotated[
        float | None, typer.Option(metavar="S", help="Wall time that a run may take, s.")
    ] = None,
    retry: Annotated[int, typer.Option(metavar="N", help="Further attempts where a worker dies.")] = 2,
    shard: Annotated[
        str | None, typer.Option(metavar="I/N", help="Only every N-th run, from the I-th on.")
    ] = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Show the runs and what they will take; run one.")
    ] = False,
    yes: Annotated[bool, typer.Option("--yes", help="Confirm more than 10 GB.")] = False,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Run many variants of a model, on all cores or a cluster."""
    from arthur_acausal.cli.sweep import Request
    from arthur_acausal.cli.sweep import sweep as carry_out

    scalars = {
        "method": method,
        "samples": samples,
        "seed": seed,
        "stop-time": stop,
        "rtol": rtol,
        "engine": engine,
    }
    text, any_ok = carry_out(
        Request(
            model=model,
            output=output,
            vary=vary or (),
            zip=zipped or (),
            derive=derive or (),
            settings=settings or (),
            inputs=inputs or (),
            starts=starts or (),
            keep=keep or (),
            reduce=reduce or (),
            scalars=scalars,
            interval=interval,
            trajectories=trajectories,
            replicates=replicates,
            seed_parameter=seed_parameter,
            workers=workers,
            scheduler=scheduler,
            resume=resume,
            timeout=timeout,
            retry=retry,
            shard=shard,
            dry_run=dry_run,
            yes=yes,
            as_json=as_json,
        )
    )
    typer.echo(text)
    if not any_ok:
        raise typer.Exit(1)


@app.command()
@reported
def merge(
    folders: Annotated[list[Path], typer.Argument(metavar="DIR...", help="Shards of one sweep.")],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Where all runs go.")],
    debug: Debug = False,
) -> None:
    """Put the shards of a sweep together."""
    from arthur_acausal.cli.sweep import merge as carry_out

    typer.echo(carry_out(folders, output))


Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A sweep's directory.")]


@app.command("sweep-plot")
@reported
def sweep_plot(
    folder: Folder,
    kind: Annotated[
        str, typer.Option("--kind", metavar="KIND", help="curves, heat, parallel, matrix or fan.")
    ] = "curves",
    x: Annotated[str | None, typer.Option("--x", metavar="COLUMN", help="Default: the first factor.")] = None,
    y: Annotated[
        str | None, typer.Option("--y", metavar="COLUMN", help="Default: the first reduction.")
    ] = None,
    by: Annotated[
        str | None, typer.Option("--by", metavar="COLUMN", help="Default: the second factor.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE.png", help="Default: DIR with .png.")
    ] = None,
    debug: Debug = False,
) -> None:
    """Draw a sweep: curves, heat map, parallel, matrix, fan."""
    from arthur_acausal.cli.looking import plot

    typer.echo(plot(folder, kind, x, y, by, output or Path(f"{folder}.png")))


@app.command()
@reported
def report(
    folder: Folder,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE.html", help="Default: DIR with .html.")
    ] = None,
    debug: Debug = False,
) -> None:
    """Write one interactive page about a sweep."""
    from arthur_acausal.cli.looking import report as carry_out

    typer.echo(carry_out(folder, output or Path(f"{folder}.html")))


@app.command()
@reported
def compare(first: Folder, second: Folder, as_json: Json = False, debug: Debug = False) -> None:
    """Compare two sweeps run by run."""
    from arthur_acausal.cli.looking import compare as carry_out

    typer.echo(carry_out(first, second, as_json))


@app.command()
@reported
def importance(
    folder: Folder,
    of: Annotated[
        str | None, typer.Option("--of", metavar="REDUCTION", help="Default: the first one.")
    ] = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Say which factor causes how much variance (Sobol)."""
    from arthur_acausal.cli.looking import importance as carry_out

    typer.echo(carry_out(folder, of, as_json))


Ranges = Annotated[
    list[str],
    typer.Option("--vary", metavar="PATH=LOW:HIGH", help="What is searched, and where. Repeatable."),
]
Results = Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Where every run is kept.")]
Stop = Annotated[
    str | None, typer.Option("-t", "--stop-time", metavar="TIME", help="s, or with a unit (200ms).")
]
Workers = Annotated[
    int | None, typer.Option("-j", "--jobs", metavar="N", help="Processes; default: one a core.")
]
Tolerance = Annotated[
    float | None, typer.Option("--rtol", metavar="TOL", help="Relative tolerance; default 1e-6.")
]


@app.command()
@reported
def fit(
    model: Model,
    measured: Annotated[Path, typer.Argument(metavar="FILE.csv", help="Columns: time [s], and SI values.")],
    vary: Ranges,
    match: Annotated[
        list[str], typer.Option("--match", metavar="VARIABLE=COLUMN", help="What is compared. Repeatable.")
    ],
    output: Results,
    stop: Stop = None,
    settings: Set = None,
    inputs: Input = None,
    starts: Start = None,
    rtol: Tolerance = None,
    workers: Workers = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Fit parameters to measurements by least squares."""
    from arthur_acausal.cli.searching import fit as carry_out
    from arthur_acausal.cli.searching import request_of

    scalars = {"stop-time": stop, "rtol": rtol}
    request = request_of(model, vary, settings, inputs, starts, scalars, workers)
    typer.echo(carry_out(request, measured, match, output, as_json))


@app.command()
@reported
def optimize(
    model: Model,
    vary: Ranges,
    output: Results,
    minimize: Annotated[
        str | None, typer.Option("--minimize", metavar="REDUCTION", help="Such as max(ram.p).")
    ] = None,
    maximize: Annotated[str | None, typer.Option("--maximize", metavar="REDUCTION", help="Likewise.")] = None,
    limits: Annotated[
        Many, typer.Option("--limit", metavar="LIMIT", help="Such as 'max(ram.p) < 2e7', in SI. Repeatable.")
    ] = None,
    population: Annotated[
        int, typer.Option("--population", metavar="N", help="Points of a generation for each unknown.")
    ] = 10,
    generations: Annotated[int, typer.Option("--generations", metavar="N", help="At most.")] = 30,
    stop: Stop = None,
    settings: Set = None,
    inputs: Input = None,
    starts: Start = None,
    rtol: Tolerance = None,
    seed: Annotated[int | None, typer.Option("--seed", metavar="N", help="Of the search.")] = None,
    workers: Workers = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Find the parameters of the least or greatest reduction."""
    from arthur_acausal.cli.searching import optimize as carry_out
    from arthur_acausal.cli.searching import request_of

    scalars = {"stop-time": stop, "rtol": rtol, "seed": seed}
    request = request_of(model, vary, settings, inputs, starts, scalars, workers)
    typer.echo(carry_out(request, minimize, maximize, limits or (), output, population, generations, as_json))


app.add_typer(study, name="study")
