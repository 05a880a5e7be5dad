"""`arthur export`: to a file or to standard output."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from typer.testing import Result

Arthur = Callable[..., Result]


def test_to_a_file(arthur: Arthur, tmp_path: Path) -> None:
    file = tmp_path / "jack.mo"
    result = arthur("export", "examples.jack", "--format", "modelica", "-o", str(file), "--set", "load.m=400")
    assert result.exit_code == 0, result.stderr
    assert result.stdout == f"wrote {file}: 23 equations in Modelica\n"
    text = file.read_text()
    assert text.startswith("model examples_jack ") and text.endswith("end examples_jack;\n")
    assert "parameter Real 'load.m'(unit=\"kg\", min=0) = 400 " in text


def test_to_standard_output(arthur: Arthur) -> None:
    result = arthur("export", "examples.bouncing_ball")
    assert result.exit_code == 0, result.stderr
    assert "  reinit(v, -e*pre(v));" in result.stdout


def test_an_unknown_format(arthur: Arthur) -> None:
    result = arthur("export", "examples.jack", "--format", "modelca")
    assert result.exit_code == 1 and "did you mean modelica?" in result.stderr


def test_pictures_of_a_model(arthur: Arthur, tmp_path: Path) -> None:
    diagram, incidence = tmp_path / "jack.svg", tmp_path / "jack.png"
    result = arthur("info", "examples.jack", "--diagram", str(diagram), "--incidence", str(incidence))
    assert result.exit_code == 0, result.stderr
    assert result.stdout == (
        f"wrote {diagram}: 5 boxes, 4 lines\nwrote {incidence}: 11 equations in 11 blocks\n"
    )
    assert diagram.read_text().rstrip().endswith("</svg>") and incidence.stat().st_size > 5_000
