"""`arthur linearize`: what it prints and draws."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import Result

Arthur = Callable[..., Result]


def test_jack_at_a_time(arthur: Arthur, tmp_path: Path) -> None:
    picture = tmp_path / "bode.png"
    result = arthur(
        "linearize", "examples.jack", "--at", "500ms", "--output", "load.v", "--bode", str(picture)
    )
    assert result.exit_code == 0, result.stderr
    head, modes, *matrices, written = result.stdout.strip().split("\n\n")
    assert head == "examples.jack: linearised at t = 0.5 s: 3 states, 1 input, 1 output"
    assert "integrator" in modes and "load.s 100 %" in modes
    assert "ram.p 50 %, load.v 50 %" in modes
    assert [text[0] for text in matrices] == ["A", "B", "C", "D"]
    assert written == f"wrote {picture}: Bode plot" and picture.stat().st_size > 10_000
    assert max(map(len, result.stdout.splitlines()[:-1])) <= 80


def test_json_holds_everything(arthur: Arthur) -> None:
    result = arthur("linearize", "examples.rc_ladder", "--json")
    found = json.loads(result.stdout)
    assert found["t"] == 0.0 and len(found["A"]) == len(found["states"]) == len(found["eigenvalues"])
    assert found["inputs"] == [] and all(real < 0.0 for real, _ in found["eigenvalues"])
    assert sum(found["modes"][0]["participation"].values()) <= 1.0 + 1e-12


def test_powertrain_at_rest(arthur: Arthur) -> None:
    result = arthur("linearize", "arthur.powertrain", "--steady", "--input", "motor.V=20")
    assert result.exit_code == 0, result.stderr
    assert "linearised at rest" in result.stdout
    assert "motor.phi                  moves on by 210.9 a second" in result.stdout
    assert "(12 times)" in result.stdout


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--at", "1", "--steady"), "--at and --steady exclude each other"),
        (("--output", "load.q"), "there is no variable 'load.q'"),
        (("--bode", "bode.xyz"), "cannot write bode.xyz"),
    ],
)
def test_errors(arthur: Arthur, arguments: tuple[str, ...], message: str) -> None:
    result = arthur("linearize", "examples.jack", *arguments)
    assert result.exit_code == 1 and message in result.stderr
