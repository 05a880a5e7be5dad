"""The commands as people and scripts use them: what they print, where, and how they exit."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import Result

from arthur_acausal import Solution, SolverOptions
from tests.result.sample import disk_of

Arthur = Callable[..., Result]


def only_json(result: Result) -> dict[str, Any]:
    """The one object that was printed, and nothing beside it."""
    assert result.exit_code == 0, result.stderr
    assert result.stdout.count("\n") == 1 and result.stdout.endswith("}\n")
    return dict(json.loads(result.stdout))


# --- help


@pytest.mark.parametrize("command", [(), ("list",), ("info",), ("check",), ("simulate",), ("plot",)])
def test_help_fits_a_terminal(arthur: Arthur, command: tuple[str, ...]) -> None:
    result = arthur(*command, "--help")
    assert result.exit_code == 0
    assert max(map(len, result.stdout.splitlines())) <= 80
    assert "..." not in result.stdout.partition("Commands:")[2], "a summary was cut"


def test_help_states_the_real_defaults(arthur: Arthur) -> None:
    text = re.sub(r"\s+", " ", arthur("simulate", "--help").stdout)
    assert f"Relative tolerance of a step; default {SolverOptions().rtol:.0e}".replace("e-0", "e-") in text
    assert f"Number of output intervals; default {SolverOptions().intervals}" in text


def test_wrong_use_exits_with_2(arthur: Arthur, ball: str) -> None:
    for arguments in [
        ("simulate",),
        ("nonsense",),
        ("simulate", ball, "--nonsense"),
        ("simulate", ball, "--rtol", "x"),
    ]:
        result = arthur(*arguments)
        assert result.exit_code == 2
        assert result.stdout == "" and "Usage: arthur" in result.stderr


def test_version(arthur: Arthur) -> None:
    assert re.fullmatch(r"arthur \d+\.\d+\.\d+\n", arthur("--version").stdout)


# --- list, info, check


def test_list_names_every_model(arthur: Arthur) -> None:
    from arthur_acausal.models import REGISTRY

    result = arthur("list")
    assert result.exit_code == 0
    assert all(name in result.stdout for name in REGISTRY)


def test_info_tells_what_a_model_is(arthur: Arthur, ball: str) -> None:
    text = arthur("info", ball).stdout
    assert "A ball that bounces on a floor." in text
    assert re.search(r"g +9\.81 +m/s² +gravity", text)
    assert re.search(r"height +1\.0 +float", text)
    assert re.search(r"wind +0 +m/s²", text)


def test_info_joins_arrays(arthur: Arthur) -> None:
    text = arthur("info", "arthur.powertrain", "--set", "n=4").stdout
    assert re.search(r"valves\[0-3\] +ServoValve", text)
    assert re.search(r"cylinders\[0-3\]\.m +50 +g ", text)
    assert "cylinders[1]" not in text


def test_check_prints_one_object(arthur: Arthur, ball: str) -> None:
    found = only_json(arthur("check", ball, "--json"))
    keys = {"equations", "unknowns", "states", "aliases", "blocks", "index", "differentiated", "messages"}
    assert keys <= set(found)
    assert found["equations"] == found["unknowns"] == 3
    assert found["states"] == ["h", "v"]
    assert found["differentiated"] == []


def test_check_tells_people_the_same(arthur: Arthur) -> None:
    result = arthur("check", "arthur.powertrain")
    assert result.exit_code == 0
    assert re.search(r"equations +(\d+) +for \1 unknowns", result.stdout)
    assert "cylinders[0-11].p_A" in result.stdout
    assert max(map(len, result.stdout.splitlines())) <= 80


def test_what_is_set_shows_in_info_and_must_be_structural_in_check(arthur: Arthur, ball: str) -> None:
    assert re.search(r"g +2 +m/s²", arthur("info", ball, "--set", "g=2", "--set", "height=3").stdout)
    assert "no parameter 'gg'" in arthur("info", ball, "--set", "gg=2").stderr
    result = arthur("check", ball, "--set", "g=2")
    assert result.exit_code == 1 and "g is no structural parameter of Ball" in result.stderr


def test_what_a_model_prints_does_not_disturb_json(arthur: Arthur, models: Path) -> None:
    models.write_text(models.read_text() + "\nprint('hello')\n")
    for command in ("check", "simulate"):
        result = arthur(command, f"{models}:Ball", "--json")
        only_json(result)
        assert "hello" in result.stderr


# --- simulate


def test_simulate_prints_statistics_and_final_states(arthur: Arthur, ball: str) -> None:
    result = arthur("simulate", ball, "-t", "1")
    assert result.exit_code == 0, result.stderr
    assert result.stdout.startswith("Ball: 0 to 1 s\n")
    assert re.search(r"events +1 +1 state, 0 time, \d restarts?\n", result.stdout)
    assert re.search(r"h +[\d.]+ +mm +height of the ball", result.stdout)
    assert max(map(len, result.stdout.splitlines())) <= 80


def test_simulate_prints_one_object(arthur: Arthur, ball: str) -> None:
    found = only_json(arthur("simulate", ball, "-t", "200ms", "--rtol", "1e-9", "--verify", "--json"))
    assert found["model"] == "Ball"
    assert found["stop_time"] == 0.2
    assert found["statistics"]["steps"] > 0
    assert found["final"]["h"] == pytest.approx(1.0 - 9.81 * 0.2**2 / 2, rel=1e-8)
    assert "energy" not in found
    assert found["verify"]["worst"] < 1e-8 and found["verify"]["path"]


def test_models_by_short_name_keep_it(arthur: Arthur) -> None:
    assert only_json(arthur("simulate", "examples.jack", "-t", "10ms", "--json"))["model"] == "examples.jack"


def test_a_run_that_begins_at_rest(arthur: Arthur) -> None:
    found = only_json(arthur("simulate", "examples.jack", "-t", "10ms", "--steady", "--json"))
    assert found["statistics"]["initial_method"].startswith("rest by")
    assert found["final"]["ram.p"] == pytest.approx(4905.0 / 1e-3)


def test_parameters_structure_inputs_and_starts(arthur: Arthur, ball: str) -> None:
    options = ["--set", "g=2", "--set", "height=3", "--input", "wind=1 m/s^2", "--start", "v=50 cm/s"]
    final = only_json(arthur("simulate", ball, "-t", "1", *options, "--rtol", "1e-9", "--json"))["final"]
    assert final["v"] == pytest.approx(0.5 - 1.0)
    assert final["h"] == pytest.approx(3.0 + 0.5 - 0.5)


def test_an_input_from_a_csv_file(arthur: Arthur, ball: str, tmp_path: Path) -> None:
    file = tmp_path / "wind.csv"
    file.write_text("time,gust\n0,0\n0.4,4\n")
    final = only_json(
        arthur(
            "simulate",
            ball,
            "-t",
            "0.4",
            "--set",
            "g=0",
            "--input",
            f"wind={file}:gust",
            "--rtol",
            "1e-9",
            "--json",
        )
    )["final"]
    assert final["v"] == pytest.approx(10.0 * 0.4**2 / 2, rel=1e-7)


def test_files_are_written_and_can_be_read(arthur: Arthur, ball: str, tmp_path: Path) -> None:
    file, picture = tmp_path / "ball.nc", tmp_path / "ball.png"
    result = arthur("simulate", ball, "-t", "1", "--points", "50", "-o", file, "--plot", picture)
    assert result.exit_code == 0, result.stderr
    assert f"wrote {file}" in result.stdout and f"wrote {picture}" in result.stdout
    solution = Solution.load(file)
    assert solution.t.size == 53, "50 intervals and the two sides of one bounce"
    assert solution.unit("v") == "m/s" and solution.final("bounces") == 1.0
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_output_interval(arthur: Arthur, ball: str, tmp_path: Path) -> None:
    arthur("simulate", ball, "-t", "0.2", "--interval", "50 ms", "-o", tmp_path / "x.nc")
    np.testing.assert_allclose(Solution.load(tmp_path / "x.nc").t, [0.0, 0.05, 0.1, 0.15, 0.2])


def test_the_audit_is_printed_and_closes(arthur: Arthur) -> None:
    options = ["simulate", "arthur.demo", "-t", "20ms", "--set", "n=1", "--rtol", "1e-6"]
    energy = only_json(arthur(*options, "--json"))["energy"]
    assert {"input_J", "losses_J", "work_J", "stored_J", "closure"} == set(energy)
    assert energy["input_J"] > 0.0 and abs(energy["closure"]) < 1e-4
    text = arthur(*options).stdout
    assert re.search(r"input +\d+\.\d{3} +100\.00\n", text) and "closure: " in text


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--set", "gg=2"], r"no parameter 'gg'"),
        (["--set", "e=1.5"], r"e: 1\.5 1 is outside of \[0, 1\]"),
        (["--set", "g=2 bar"], r"g: .*bar"),
        (["--set", "g"], r"write --set path=value"),
        (["--set", "height=tall"], r"structural parameter of type float"),
        (["--input", "winds=1"], r"no input 'winds'\n.*did you mean wind"),
        (["--input", "wind=none.csv"], r"none\.csv cannot be read"),
        (["--start", "hh=1"], r"no start value of 'hh'"),
        (["-t", "soon"], r"--stop-time soon: 'soon' is no number"),
        (["-t", "3 m"], r"--stop-time"),
        (["-t", "-1"], r"stop_time -1"),
        (["--rtol", "2"], r"rtol is 2"),
        (["--points", "0"], r"intervals is 0"),
        (["--points", "5", "--interval", "0.1"], r"exclude each other"),
        (["--plot", "ball.txt"], r"end the name in \.png"),
        (["-o", "/no/such/folder/x.nc"], r"cannot write /no/such/folder/x\.nc"),
    ],
)
def test_the_users_errors(arthur: Arthur, ball: str, options: list[str], message: str) -> None:
    result = arthur("simulate", ball, *options)
    assert result.exit_code == 1
    assert re.search(message, result.stderr), result.stderr
    assert result.stderr.startswith("error: ")
    assert "Traceback" not in result.stderr


def test_a_csv_file_that_is_too_short(arthur: Arthur, ball: str, tmp_path: Path) -> None:
    file = tmp_path / "wind.csv"
    file.write_text("time,gust\n0,0\n0.4,4\n")
    result = arthur("simulate", ball, "-t", "1", "--input", f"wind={file}")
    assert result.exit_code == 1
    assert re.search(r"wind\.csv, column 'gust' covers 0 s to 0\.4 s, the run 0 s to 1 s", result.stderr)


def test_a_run_that_fails_leaves_what_it_computed(arthur: Arthur, models: Path, tmp_path: Path) -> None:
    file = tmp_path / "part.nc"
    result = arthur("simulate", f"{models}:Collapse", "-t", "2", "-o", file, "--json")
    assert result.exit_code == 1
    assert result.stdout == ""
    assert re.search(r"up to 0\.66\d* s: .*part\.nc", result.stderr)
    assert "error: " in result.stderr and "decay" in result.stderr
    solution = Solution.load(file)
    assert solution.run.status == "failed"
    at = solution.t < 0.6
    np.testing.assert_allclose(solution["x"][at], (1.0 - 1.5 * solution.t[at]) ** (2.0 / 3.0), rtol=1e-4)


def test_a_full_disk_does_not_cost_the_run(arthur: Arthur, ball: str, tmp_path: Path) -> None:
    file = tmp_path / "ball.nc"
    file.write_text("before")
    with disk_of(1000):
        result = arthur("simulate", ball, "-t", "0.1", "-o", file)
    assert result.exit_code == 1
    assert "states at the end" in result.stdout and "wrote" not in result.stdout
    assert re.search(r"cannot write .*ball\.nc \(0\.\d MB\)\n +cause: File too large", result.stderr)
    assert file.read_text() == "before"


def test_an_error_in_the_models_own_code(arthur: Arthur, models: Path) -> None:
    models.write_text(
        models.read_text() + "\n\nclass Odd(Ball):\n    def audit_terms(self):\n        1 / 0\n"
    )
    result = arthur("simulate", f"{models}:Odd", "-t", "0.1")
    assert result.exit_code == 1
    assert "ZeroDivisionError" in result.stderr and "--debug" in result.stderr
    assert "Traceback" not in result.stderr
    assert "in audit_terms" in arthur("simulate", f"{models}:Odd", "-t", "0.1", "--debug").stderr


# --- plot


@pytest.fixture
def ball_file(arthur: Arthur, ball: str, tmp_path: Path) -> Path:
    """A stored result."""
    arthur("simulate", ball, "-t", "1", "-o", tmp_path / "ball.nc")
    return tmp_path / "ball.nc"


def test_plot_draws_beside_the_result(arthur: Arthur, ball_file: Path) -> None:
    result = arthur("plot", ball_file, "h", "v")
    assert result.exit_code == 0, result.stderr
    assert ball_file.with_suffix(".png").read_bytes().startswith(b"\x89PNG")
    assert str(ball_file.with_suffix(".png")) in result.stdout


def test_plot_takes_patterns_and_a_name(arthur: Arthur, ball_file: Path) -> None:
    target = ball_file.with_name("other.pdf")
    assert arthur("plot", ball_file, "?", "-o", target).exit_code == 0
    assert target.read_bytes().startswith(b"%PDF")


def test_plot_of_what_is_not_there(arthur: Arthur, ball_file: Path) -> None:
    result = arthur("plot", ball_file, "bouncse")
    assert result.exit_code == 1 and "did you mean bounces" in result.stderr
    assert arthur("plot", ball_file).exit_code == 2
    missing = arthur("plot", ball_file.with_name("none.nc"), "h")
    assert missing.exit_code == 1 and "No such file" in missing.stderr
    ball_file.write_bytes(ball_file.read_bytes()[:2000])
    assert "is damaged" in arthur("plot", ball_file, "h").stderr


# --- power


def test_power_tells_what_enters_each_part(arthur: Arthur) -> None:
    given = ("simulate", "examples.jack", "-t", "0.5", "--power")
    text = arthur(*given).stdout.partition("energy into each part by its connectors\n")[2]
    assert re.search(r"all together +0\.0\d\d\b", text)
    power = only_json(arthur(*given, "--json"))["power"]
    assert {"orifice.port_a", "orifice.port_b"} == set(power["orifice"])
    assert sum(power["orifice"].values()) > 0.0  # it throttles
    parts = [sum(ports.values()) for ports in power.values()]
    assert abs(sum(parts)) < 1e-6 * max(map(abs, parts))
