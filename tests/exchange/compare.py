"""Simulating an exported model with rumoca, a Modelica compiler in Rust that shares nothing with this project."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import rumoca

from arthur_acausal import Component, SolverOptions, translate
from arthur_acausal.exchange.names import identifier

INTERVALS = 200
AROUND_EVENTS = 2e-3  # of the run, that is left out on both sides of an event


@dataclass(frozen=True)
class Difference:
    """The largest difference of a variable, in units of the largest value of all variables of its unit."""

    path: str
    kind: str
    size: float


def differences(
    model: Component,
    stop_time: float,
    tolerance: float,
    parameters: Mapping[str, float] | None = None,
) -> list[Difference]:
    """Simulate with both, and return the differences of all variables, largest first."""
    translation = translate(model, compile="never")
    text = translation.to_modelica(parameters=parameters, stop_time=stop_time)
    name = text.split(maxsplit=2)[1]
    config = rumoca.SimConfig(rtol=tolerance, atol=1e-3 * tolerance, max_wall_seconds=60.0)
    theirs = (
        rumoca.Session()
        .loads(text, model=name)
        .simulate(t=(0.0, stop_time), dt=stop_time / INTERVALS, config=config)
    )
    ours = translation.simulate(
        stop_time, options=SolverOptions(rtol=tolerance, intervals=INTERVALS), parameters=parameters
    )
    t = np.asarray(theirs.time)
    far = np.ones(t.size, dtype=bool)
    for event in ours.events:
        far &= np.abs(t - event.time) > AROUND_EVENTS * stop_time
    names = set(theirs.names)
    paths = [
        path for path in ours.paths if identifier(path) in names and ours.variable(path).kind != "parameter"
    ]
    assert len(paths) >= len(translation.dae.y_paths)
    values = {path: ours.at(t[far], path) for path in paths}
    scale: dict[str, float] = {}
    for path, value in values.items():
        unit = ours.unit(path)
        scale[unit] = max(scale.get(unit, 0.0), float(np.abs(value).max(initial=0.0)))
    found = [
        Difference(
            path,
            ours.variable(path).kind,
            float(np.abs(np.asarray(theirs[identifier(path)])[far] - value).max(initial=0.0))
            / (scale[ours.unit(path)] or 1.0),
        )
        for path, value in values.items()
    ]
    return sorted(found, key=lambda d: -d.size)
