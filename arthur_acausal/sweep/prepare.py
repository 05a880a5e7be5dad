"""What the runs of one structure share, as data: what is kept and reduced, and whose functions may be called."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from arthur_acausal.sweep.job import Job, Values
from arthur_acausal.sweep.reductions import parse
from arthur_acausal.sweep.specification import Output, Specification

if TYPE_CHECKING:
    from arthur_acausal.api import Translation

FINER = 10  # instants that reductions look at, for each one whose trajectory is kept
BATCH = 32  # runs that a worker is given at once at most, where one takes less than what surrounds it
MOST_OUTPUTS = 24  # variables that are kept of a model that names none
_PACKAGE = "arthur_acausal"


def job_of(specification: Specification, translation: Translation, fixed: Values) -> Job:
    """Return what all runs of a structure share; ``fixed``: values that do not vary."""
    from arthur_acausal.result.run import plain
    from arthur_acausal.solve.straight import fits

    output, model = specification.output, translation.model
    paths = list(translation.dae.recovery.paths)
    variables = outputs(translation, output)
    reductions = parse(output.reductions, variables, paths)
    terms = getattr(model, "audit_terms", None)
    modules, folders = _own_modules(type(model), output)
    only_ends = not output.trajectories and all(r.kind in ("final", "initial") for r in reductions)
    span = specification.stop_time - specification.start_time
    return Job(
        system=translation.to_bytes(),
        description=(inspect.getdoc(model) or "").partition("\n")[0],
        audit=plain(terms()) if terms is not None else {},
        start_time=specification.start_time,
        stop_time=specification.stop_time,
        tolerance=specification.tolerance,
        interval=min(output.interval, span),
        resolution=span if only_ends else min(output.interval / FINER, span),
        variables=tuple(variables) if output.trajectories else (),
        reductions=tuple(reductions),
        parameters=fixed.parameters,
        inputs=fixed.inputs,
        start=fixed.start,
        trusted=modules,
        folders=folders,
        batch=BATCH if specification.engine == "auto" and fits(translation.dae) else 1,
    )


def outputs(translation: Translation, output: Output) -> list[str]:
    """Return what is kept: the variables asked for, else the model's ``outputs``, else its signals out, its states."""
    from arthur_acausal.result.pattern import select

    paths = translation.dae.recovery.paths
    if output.variables:
        return list(select(list(output.variables), paths))
    named = getattr(translation.model, "outputs", None)
    if isinstance(named, Sequence) and not isinstance(named, str):
        return list(select(list(named), paths))
    quantities = type(translation.model)._declarations.quantities
    signals = [name for name, quantity in quantities.items() if quantity.kind == "output"]
    dae = translation.dae
    states = [path for path, is_state in zip(dae.y_paths, dae.differential, strict=True) if is_state]
    return signals or states[:MOST_OUTPUTS]


def _own_modules(kind: type[Any], output: Output) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the user's modules that a worker may import functions from, and the folders to find them in."""
    names = [base.__module__ for base in kind.__mro__]
    names += [text.partition(":")[0] for text in output.reductions or () if ":" in text]
    own = sorted({n for n in names if n.partition(".")[0] not in (_PACKAGE, "builtins", "abc", "typing")})
    folders = {
        str(Path(file).resolve().parents[name.count(".")])
        for name in own
        if (file := getattr(sys.modules.get(name), "__file__", None))
    }
    return tuple(own), tuple(sorted(folders))
