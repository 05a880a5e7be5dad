"""`arthur linearize`: matrices, modes and Bode plots of a model about a point."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from arthur_acausal.cli.alike import names
from arthur_acausal.cli.failure import quiet
from arthur_acausal.cli.simulate import Request as SimulationRequest
from arthur_acausal.cli.simulate import run, seconds
from arthur_acausal.cli.table import count, number, table
from arthur_acausal.errors import UsageError
from arthur_acausal.request.locate import build_model
from arthur_acausal.request.settings import assignments, quantity, read_inputs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from arthur_acausal.analysis.linearize import LinearModel, Mode
    from arthur_acausal.analysis.steady import SteadyState
    from arthur_acausal.api import Translation

SHOWN = 8  # rows and columns up to which matrices are printed; --json has all
TAKING_PART = 3  # states that are named for a mode
SHARED = 0.2  # share from which on a state is named for modes that are alike
CLEAR = 1e-12  # of the fastest mode, below which an eigenvalue counts as zero


@dataclass(frozen=True, slots=True)
class Request:
    """What the command line asks for."""

    model: str
    at: str | None = None
    steady: bool = False
    settings: Sequence[str] = ()
    inputs: Sequence[str] = ()
    starts: Sequence[str] = ()
    outputs: Sequence[str] = ()
    bode: Path | None = None
    as_json: bool = False


def linearize(request: Request) -> str:
    """Carry out ``arthur linearize``; return what is to be printed."""
    from arthur_acausal.result.plot import check_format, write

    with quiet(request.as_json):
        if request.at is not None and request.steady:
            raise UsageError("--at and --steady exclude each other")
        if request.bode is not None:
            check_format(request.bode)
        translation, model, steady = compute(request)
        written = []
        if request.bode is not None:
            from arthur_acausal.analysis.bode import bode

            write(bode(model), request.bode)
            written.append(f"wrote {request.bode}: Bode plot")
        if request.as_json:
            return json.dumps(as_object(model, steady), ensure_ascii=False)
        return "\n\n".join([*as_text(translation.dae.name, model, steady), *written])


def compute(request: Request) -> tuple[Translation, LinearModel, SteadyState | None]:
    """Translate, find the point and linearise there: at a time, at rest, or at the start."""
    from arthur_acausal.analysis.linearize import linearize as about
    from arthur_acausal.api import translate
    from arthur_acausal.solve.simulate import initial_point

    built = build_model(request.model, request.settings)
    translation = translate(built.model, name=built.name)
    dae, outputs = translation.dae, list(request.outputs) or None
    if request.at is not None and seconds(request.at, "--at") > 0.0:
        wanted = SimulationRequest(
            request.model, request.at, inputs=request.inputs, starts=request.starts, points=1
        )
        solution = run(wanted, translation, built.parameters)
        return translation, translation.linearize(solution, outputs=outputs), None
    given: dict[str, Any] = {
        "parameters": built.parameters,
        "inputs": read_inputs(request.inputs, dict(zip(dae.u_paths, dae.u_units, strict=True))),
        "start": _starts(request.starts),
    }
    if request.steady:
        rest = translation.steady_state(**given)
        return translation, translation.linearize(rest, outputs=outputs), rest
    return translation, about(dae, initial_point(dae, stop_time=1.0, **given), outputs=outputs), None


def _starts(texts: Sequence[str]) -> Mapping[str, float | str]:
    given = assignments(texts, "--start").items()
    return {path: quantity(text, f"--start {path}={text}") for path, text in given}


def as_object(model: LinearModel, steady: SteadyState | None) -> dict[str, Any]:
    """The object that --json prints; complex numbers as [real, imaginary]."""
    found: dict[str, Any] = {
        "t": model.t,
        "states": model.states,
        "inputs": model.inputs,
        "outputs": model.outputs,
        "state_values": model.state_values.tolist(),
    }
    found |= {name: getattr(model, name).tolist() for name in "ABCD"}
    found["eigenvalues"] = [[v.real, v.imag] for v in model.eigenvalues().tolist()]
    found["modes"] = [
        {
            "eigenvalue": [m.eigenvalue.real, m.eigenvalue.imag],
            "frequency": m.frequency,
            "damping": m.damping,
            "participation": m.participation,
        }
        for m in model.modes()
    ]
    if steady is not None:
        found |= {"steady": steady.method, "free": steady.free, "drifts": dict(steady.drifts)}
    return found


def as_text(name: str, model: LinearModel, steady: SteadyState | None) -> list[str]:
    """What people read, in sections."""
    where = f"at t = {model.t:g} s" if steady is None else "at rest"
    sections = [
        f"{name}: linearised {where}: {count(len(model.states), 'state')}, "
        f"{count(len(model.inputs), 'input')}, {count(len(model.outputs), 'output')}"
    ]
    if steady is not None and steady.free:
        held = [path for path in steady.free if path not in steady.drifts]
        rows = [[name, "at the start value"] for name in names(held)]
        rows += [[path, f"moves on by {number(rate)} a second"] for path, rate in steady.drifts.items()]
        sections.append("states that the equations leave free\n" + table(rows, "lw"))
    sections.append(modes(model.modes()))
    for letter, rows_of, columns_of in (
        ("A", model.states, model.states),
        ("B", model.states, model.inputs),
        ("C", model.outputs, model.states),
        ("D", model.outputs, model.inputs),
    ):
        own = model.outputs == model.states and letter in "CD"
        if rows_of and columns_of and not own:
            sections.append(matrix(letter, getattr(model, letter), rows_of, columns_of))
    return [section for section in sections if section]


def modes(found: Sequence[Mode]) -> str:
    """The eigenvalues, slowest first, each with the states that take part in it."""
    if not found:
        return "no states: no modes"
    largest = max(abs(mode.eigenvalue) for mode in found)
    together: dict[tuple[str, str, str], list[Mode]] = {}
    for mode in found:
        together.setdefault(_told(mode, largest), []).append(mode)
    rows = [["eigenvalue [1/s]", "frequency", "damping", "states"]]
    for told, members in together.items():
        times = f" ({len(members)} times)" if len(members) > 1 else ""
        rows.append([told[0] + times, *told[1:], _part(members)])
    return "modes: frequency and damping ratio, or time constant\n" + table(rows, "lrrw")


def _told(mode: Mode, largest: float) -> tuple[str, str, str]:
    """Eigenvalue, frequency and damping of a mode as text."""
    value, size = mode.eigenvalue, abs(mode.eigenvalue)
    if size <= CLEAR * largest:
        return "0", "integrator", ""
    if value.imag == 0.0:
        return number(value.real), f"{number(1.0 / size)} s", ""
    return (
        f"{number(value.real)} ± {number(value.imag)}j",
        f"{number(mode.frequency)} Hz",
        number(mode.damping, 3),
    )


def _part(members: Sequence[Mode]) -> str:
    """The states that take part: with their shares for one mode, by name where several modes are alike."""
    if len(members) == 1:
        shares = list(members[0].participation.items())
        text = ", ".join(f"{path} {100.0 * share:.0f} %" for path, share in shares[:TAKING_PART])
        return text + (f" and {len(shares) - TAKING_PART} more" if len(shares) > TAKING_PART else "")
    weight: dict[str, float] = {}
    for mode in members:
        for path, share in mode.participation.items():
            weight[path] = weight.get(path, 0.0) + share
    return ", ".join(names(sorted(path for path, share in weight.items() if share >= SHARED)))


def matrix(
    letter: str, values: NDArray[np.float64], rows_of: Sequence[str], columns_of: Sequence[str]
) -> str:
    """A matrix with its rows and columns named; a large one by its size only."""
    size = f"{letter}: {len(rows_of)} × {len(columns_of)}"
    if max(values.shape) > SHOWN:
        return f"{size}, {np.count_nonzero(values)} entries (--json has all)"
    keys = [f"({k + 1})" for k in range(len(columns_of))]
    head = ["", *keys]
    body = [
        [path, *(number(v) if v else "0" for v in row)]
        for path, row in zip(rows_of, values.tolist(), strict=True)
    ]
    legend = ", ".join(f"{key} {path}" for key, path in zip(keys, columns_of, strict=True))
    return f"{size}, columns {legend}\n" + table([head, *body], "l" + "r" * len(keys))
