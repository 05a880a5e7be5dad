"""`arthur simulate`: translate, run, and leave behind what was asked for."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from arthur_acausal.cli import outcome, progress
from arthur_acausal.cli.failure import note, quiet
from arthur_acausal.errors import ArthurError, SimulationError, UsageError
from arthur_acausal.request.locate import build_model
from arthur_acausal.request.settings import assignments, quantity, read_inputs

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from arthur_acausal.api import Translation
    from arthur_acausal.result.solution import Solution
    from arthur_acausal.solve.options import SolverOptions

STOP_TIME = 1.0  # s, where neither the command nor the model says


@dataclass(frozen=True, slots=True)
class Request:
    """What the command line asks for; times as text, since they may have units."""

    model: str
    stop: str | None = None
    settings: Sequence[str] = ()
    inputs: Sequence[str] = ()
    starts: Sequence[str] = ()
    rtol: float | None = None
    points: int | None = None
    interval: str | None = None
    max_step: str | None = None
    output: Path | None = None
    picture: Path | None = None
    verify: bool = False
    power: bool = False
    steady: bool = False
    as_json: bool = False


def simulate(request: Request) -> str:
    """Carry out ``arthur simulate``; return what is to be printed.

    Raises ArthurError or KeyboardInterrupt after what was computed up to there has been written.
    """
    with quiet(request.as_json):
        check_files(request)
        translation, solution = compute(request)
        try:
            written = keep(request, translation, solution)
        except ArthurError:
            if not request.as_json:
                typer.echo(told(request, translation, solution, []))  # a full disk should not cost the run
            raise
        return told(request, translation, solution, written)


def check_files(request: Request) -> None:
    """See before the run, not after it, that the files asked for can be written."""
    from arthur_acausal.result.atomic import check_place
    from arthur_acausal.result.plot import check_format

    if request.picture is not None:
        check_format(request.picture)
    for file in (request.output, request.picture):
        if file is not None:
            check_place(file)


def compute(request: Request) -> tuple[Translation, Solution]:
    """Translate and run; where the run stops early, write what was computed and raise what stopped it."""
    from arthur_acausal.api import translate
    from arthur_acausal.result.simulated import Interrupted

    built = build_model(request.model, request.settings)
    translation = translate(built.model, name=built.name)
    try:
        return translation, run(request, translation, built.parameters)
    except (SimulationError, Interrupted) as stopped:
        if stopped.solution is not None:
            keep_part(request, translation, stopped.solution)
        raise


def run(request: Request, translation: Translation, parameters: dict[str, float | str]) -> Solution:
    """Simulate with a progress bar on a terminal."""
    dae = translation.dae
    inputs = read_inputs(request.inputs, dict(zip(dae.u_paths, dae.u_units, strict=True)))
    starts = assignments(request.starts, "--start")
    start = {path: quantity(text, f"--start {path}={text}") for path, text in starts.items()}
    default = getattr(translation.model, "stop_time", STOP_TIME)
    stop_time = default if request.stop is None else seconds(request.stop, "--stop-time")
    with progress.shown(0.0, stop_time) as report:
        return translation.simulate(
            stop_time,
            parameters=parameters,
            inputs=inputs,
            start=start,
            options=options(request),
            progress=report,
            steady=request.steady,
        )


def options(request: Request) -> SolverOptions:
    """The solver's options that the command line gives; all others keep their defaults."""
    from arthur_acausal.solve.options import SolverOptions

    if request.points is not None and request.interval is not None:
        raise UsageError("--points and --interval exclude each other")
    given: dict[str, Any] = {"rtol": request.rtol, "intervals": request.points}
    if request.interval is not None:
        given["output_interval"] = seconds(request.interval, "--interval")
    if request.max_step is not None:
        given["max_step"] = seconds(request.max_step, "--max-step")
    return SolverOptions().replace(**{name: value for name, value in given.items() if value is not None})


def seconds(text: str, option: str) -> float:
    """A time in seconds, from a number or a number with a unit."""
    from arthur_acausal.units import to_si

    return to_si(quantity(text, f"{option} {text}"), "s", path=option)


def keep(request: Request, translation: Translation, solution: Solution) -> list[str]:
    """Write the files that were asked for; return a line about each."""
    written = []
    if request.output is not None:
        solution.save(request.output)
        written.append(f"{request.output}: {len(solution.paths):,} variables at {solution.t.size:,} times")
    if request.picture is not None:
        from arthur_acausal.result.plot import write

        write(picture(translation.model, solution), request.picture)
        written.append(f"{request.picture}: picture")
    return written


def keep_part(request: Request, translation: Translation, solution: Solution) -> None:
    """Write what a run that stopped early has computed, and say so."""
    for line in keep(request, translation, solution):
        note(f"up to {solution.t[-1]:g} s: {line}")


def picture(model: object, solution: Solution) -> Figure:
    """The model's own picture where it has one (`figure`), else its states over time."""
    own = getattr(model, "figure", None)
    if own is not None:
        return own(solution)  # type: ignore[no-any-return]
    states = [path for path, variable in solution.variables.items() if variable.kind == "state"]
    return solution.plot(first_of_each_unit(solution, states or solution.paths))


def figures(model: object, solution: Solution) -> dict[str, Any]:
    """The model's own figures of a run where it has some (`figures`)."""
    own = getattr(model, "figures", None)
    return {} if own is None else dict(own(solution))


def notes(model: object, solution: Solution) -> list[str]:
    """What the model itself says about a run (`notes`): what went wrong in it."""
    own = getattr(model, "notes", None)
    return [] if own is None else list(own(solution))


def first_of_each_unit(solution: Solution, paths: Sequence[str]) -> list[str]:
    """As many of the paths as fit into one picture."""
    from arthur_acausal.result.panel import MOST_LINES

    chosen: dict[str, list[str]] = {}
    for path in paths:
        chosen.setdefault(solution.unit(path), []).append(path)
    return [path for members in chosen.values() for path in members[:MOST_LINES]]


def told(request: Request, translation: Translation, solution: Solution, written: Sequence[str]) -> str:
    """The object or the text that tells what came out."""
    translation_s = sum(translation.seconds.values())
    verified = translation.verify(solution) if request.verify else None
    if request.as_json:
        extras: dict[str, Any] = {"translation_s": translation_s}
        extras |= figures(translation.model, solution)
        if said := notes(translation.model, solution):
            extras["notes"] = said
        if verified is not None:
            extras["verify"] = {"worst": verified.largest, "path": verified.path}
        if request.power:
            extras["power"] = {path: balance.energies for path, balance in outcome.balances(solution).items()}
        return json.dumps(outcome.as_object(solution, extras), ensure_ascii=False)
    sections = [outcome.as_text(solution, translation_s)]
    if said := notes(translation.model, solution):
        sections.append("\n".join(f"note: {line}" for line in said))
    if verified is not None:
        sections.append(outcome.verification(verified))
    if request.power:
        sections.append(outcome.powers(solution))
    if written:
        sections.append("\n".join(f"wrote {line}" for line in written))
    return "\n\n".join(sections)
