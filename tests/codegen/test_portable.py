"""A compiled system goes through bytes and comes back the same, without the model's source."""

from __future__ import annotations

import json
import math
import zipfile
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SolverOptions,
    der,
    discrete,
    parameter,
    sampled,
    start,
    translate,
    variable,
)
from arthur_acausal.codegen.cache import Cache
from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.portable import from_bytes, reference, restore
from arthur_acausal.errors import UsageError
from arthur_acausal.models.examples.bouncing_ball import BouncingBall
from arthur_acausal.models.examples.clutch_engagement import ClutchEngagement
from arthur_acausal.models.examples.jack import Jack
from arthur_acausal.result.simulated import run
from arthur_acausal.result.solution import Solution

FloatArray = NDArray[np.float64]


def simulated(dae: CompiledDAE, stop_time: float, **given: Any) -> Solution:
    return run(
        dae,
        None,
        stop_time=stop_time,
        start_time=0.0,
        options=SolverOptions(),
        parameters=given,
        inputs=None,
        start=None,
        progress=None,
    )


@pytest.mark.parametrize(
    ("model", "stop_time"), [(Jack(), 0.1), (BouncingBall(), 1.0), (ClutchEngagement(), 1.0)]
)
def test_the_same_bits_come_out(model: Component, stop_time: float, tmp_path: Path) -> None:
    translation = translate(model)
    copy = from_bytes(translation.to_bytes(), Cache(tmp_path))
    here, there = translation.simulate(stop_time), simulated(copy, stop_time)
    assert here.paths == there.paths
    np.testing.assert_array_equal(here.values(here.paths), there.values(here.paths))


def test_bytes_are_the_same_each_time_and_hold_no_pickle() -> None:
    translation = translate(Jack())
    data = translation.to_bytes()
    assert data == translation.to_bytes()
    with zipfile.ZipFile(BytesIO(data)) as archive:
        for name in archive.namelist():
            assert not archive.read(name).startswith(b"\x80")  # how every binary pickle begins


def test_elsewhere_the_virtual_machine_serves(tmp_path: Path) -> None:
    translation = translate(Jack(), compile="always")
    data = translation.to_bytes()
    changed = BytesIO()
    with zipfile.ZipFile(BytesIO(data)) as old, zipfile.ZipFile(changed, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            if name == "index.json":
                content = json.dumps({**json.loads(content), "platform": "another"}).encode()
            new.writestr(name, content)
    copy = from_bytes(changed.getvalue(), Cache(tmp_path))
    assert not any(hasattr(f, "library") for f in copy.functions.values())
    here, there = translation.simulate(0.1), simulated(copy, 0.1)
    np.testing.assert_allclose(there["load.s"], here["load.s"], rtol=1e-9)


def halve(t: float, inputs: FloatArray) -> FloatArray:
    return inputs / 2.0


class Halver:
    def __init__(self, by: float) -> None:
        self.by = by

    def __call__(self, t: float, inputs: FloatArray) -> FloatArray:
        return inputs / self.by

    def describe(self) -> dict[str, float]:
        return {"by": self.by}

    @classmethod
    def restore(cls, data: dict[str, float]) -> Halver:
        return cls(**data)


class Decay(Component):
    law: Callable[[float, FloatArray], FloatArray] = halve
    tau: Real = parameter("s", default=1.0, min=0.0)
    x: Real = variable("1", start=1.0, fixed=True)
    held: Real = discrete("1", start=0.0)

    def equations(self) -> Equations:
        yield self.tau * der(self.x) == -self.x + self.held
        yield sampled(self.law, period=0.1, inputs=[self.x], outputs=[self.held])


@pytest.mark.parametrize("law", [halve, Halver(2.0)])
def test_sampled_functions_are_found_by_name(law: Any) -> None:
    translation = translate(Decay(law=law))
    with pytest.raises(UsageError, match="is no module of the model's"):
        from_bytes(translation.to_bytes())
    copy = from_bytes(translation.to_bytes(), trusted=(__name__,))
    np.testing.assert_array_equal(translation.simulate(1.0)["x"], simulated(copy, 1.0)["x"])


@pytest.mark.parametrize("law", [lambda t, x: x, math.nan.__add__, object()])
def test_what_has_no_name_is_refused(law: Any) -> None:
    with pytest.raises(UsageError, match="cannot be found by another process"):
        reference(law)


def test_only_named_modules_are_imported() -> None:
    with pytest.raises(UsageError, match="os is no module of the model's"):
        restore("os:system", None)


def test_start_values_and_parameters_are_still_set() -> None:
    translation = translate(Decay(x=start(3.0, fixed=True)))
    copy = from_bytes(translation.to_bytes(), trusted=(__name__,))
    assert simulated(copy, 1.0, tau="500 ms")["x"][0] == 3.0
