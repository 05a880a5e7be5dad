"""What a model itself says about a run, beside the figures of the run."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from typer.testing import Result

MODEL = """
from arthur_acausal import Component, Equations, Real, Solution, der, parameter, variable


class Fall(Component):
    T: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == -self.x

    def notes(self, solution: Solution) -> list[str]:
        return [f"x fell to {solution.final('x'):.3f}"] if solution.final("x") < 0.5 else []
"""


def test_notes_are_told_where_there_are_any(arthur: Callable[..., Result], tmp_path: Path) -> None:
    file = tmp_path / "fall.py"
    file.write_text(MODEL)
    told = arthur("simulate", f"{file}:Fall", "--stop-time", "1")
    assert "note: x fell to 0.368" in told.stdout
    assert json.loads(arthur("simulate", f"{file}:Fall", "--json").stdout)["notes"] == ["x fell to 0.368"]
    early = arthur("simulate", f"{file}:Fall", "--stop-time", "0.1", "--json")
    assert "notes" not in json.loads(early.stdout)
    assert "note:" not in arthur("simulate", f"{file}:Fall", "--stop-time", "0.1").stdout
