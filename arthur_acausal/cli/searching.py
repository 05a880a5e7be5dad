"""`arthur fit` and `arthur optimize`: runs that a search asks for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from arthur_acausal.cli.sweep import Request, read
from arthur_acausal.cli.table import count, number, table
from arthur_acausal.errors import UsageError
from arthur_acausal.request.settings import assignments


def request_of(
    model: str,
    vary: Sequence[str],
    settings: Sequence[str] | None,
    inputs: Sequence[str] | None,
    starts: Sequence[str] | None,
    scalars: dict[str, Any],
    workers: int | None,
) -> Request:
    """Return what the options that both commands have ask for."""
    return Request(
        model,
        vary=vary,
        settings=settings or (),
        inputs=inputs or (),
        starts=starts or (),
        scalars=scalars,
        workers=workers,
    )


def fit(request: Request, measured: Path, match: Sequence[str], folder: Path, as_json: bool) -> str:
    """Carry out ``arthur fit``."""
    from arthur_acausal.request.locate import find_model
    from arthur_acausal.result.run import to_json
    from arthur_acausal.sweep.carry_out import How
    from arthur_acausal.sweep.fit import fit as carry_out
    from arthur_acausal.sweep.plan import Plan

    specification, place = read(request)
    plan = Plan(specification, place, find_model)
    found = carry_out(plan, measured, assignments(match, "--match"), folder, How(request.workers))
    if as_json:
        return to_json(asdict(found))
    rows = [["parameter", "value", "standard error", ""]]
    rows += [
        [p.path, number(p.value, 6), number(p.error, 3), "at its bound" if p.at_bound else ""]
        for p in found.parameters
    ]
    lines = [table(rows, "lrrl", indent=0), ""]
    lines += [f"{variable}: residuals of {number(rms)} rms" for variable, rms in found.rms.items()]
    told = "converged" if found.success else "did not converge"
    lines.append(f"{count(found.evaluations, 'run')} in {folder}; {told}: {found.message}")
    return "\n".join(lines)


def optimize(
    request: Request,
    minimize: str | None,
    maximize: str | None,
    limits: Sequence[str],
    folder: Path,
    population: int,
    generations: int,
    as_json: bool,
) -> str:
    """Carry out ``arthur optimize``."""
    from arthur_acausal.request.locate import find_model
    from arthur_acausal.result.run import to_json
    from arthur_acausal.sweep.carry_out import How
    from arthur_acausal.sweep.optimize import optimize as carry_out
    from arthur_acausal.sweep.plan import Plan

    objective = minimize or maximize
    if objective is None or (minimize and maximize):
        raise UsageError("give either --minimize or --maximize")
    specification, place = read(request)
    found = carry_out(
        Plan(specification, place, find_model),
        objective,
        folder,
        How(request.workers),
        maximize=minimize is None,
        limits=limits,
        population=population,
        generations=generations,
    )
    if as_json:
        return to_json(asdict(found))
    rows = [["parameter", "value"], *([path, number(value, 6)] for path, value in found.parameters.items())]
    lines = [table(rows, "lr", indent=0), "", f"{objective} = {number(found.objective, 6)}"]
    lines += [f"{name} = {number(value, 6)}" for name, value in found.limits.items()]
    failed = f", {found.failed:,} of them failed" if found.failed else ""
    told = "converged" if found.success else "not converged or a limit is broken"
    lines.append(f"{count(found.evaluations, 'run')} in {folder}{failed}; {told}: {found.message}")
    return "\n".join(lines)
