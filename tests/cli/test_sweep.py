"""`arthur sweep`: what cannot be meant is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner

from arthur_acausal.cli.batch import app

TOML = 'model = "examples.jack"\nstop_time = 0.1\n[vary]\n"load.m" = "100,200"\n'


@pytest.mark.parametrize(
    "option",
    [
        ("--vary", "load.m=1,2"),
        ("--set", "load.m=1"),
        ("--keep", "load.s"),
        ("--reduce", "max(load.s)"),
        ("--interval", "1ms"),
        ("--no-trajectories",),
        ("-t", "2"),
        ("--rtol", "1e-4"),
        ("--method", "sobol"),
        ("--seed", "0"),
        ("--replicates", "2"),
        ("--seed-parameter", "load.m"),
        ("--start", "load.s=1"),
        ("--input", "weight.f=1"),
    ],
)
def test_an_option_that_a_file_settles_is_not_ignored(tmp_path: Path, option: tuple[str, ...]) -> None:
    (tmp_path / "s.toml").write_text(TOML)
    result = CliRunner().invoke(app, ["sweep", str(tmp_path / "s.toml"), *option, "--dry-run"])
    assert result.exit_code == 1
    assert "says what the sweep is" in result.output


def test_a_seed_parameter_without_replicates_is_given_the_seed(tmp_path: Path) -> None:
    command = ["sweep", "examples.jack", "-t", "0.01", "--seed", "300", "--seed-parameter", "load.m"]
    result = CliRunner().invoke(app, [*command, "--dry-run"])
    assert result.exit_code == 0
    assert "300" in result.output
