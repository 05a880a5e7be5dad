"""The command in a process of its own: streams, signals, start-up."""

from __future__ import annotations

import json
import os
import pty
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from arthur_acausal import Solution
from tests.cli.conftest import ROOT, process, run


def test_the_module_is_the_command() -> None:
    status, out, err = run("list")
    assert status == 0 and err == ""
    assert "arthur.powertrain" in out


def test_json_is_alone_on_standard_output(ball: str) -> None:
    status, out, _ = run("simulate", ball, "-t", "0.1", "--json")
    assert status == 0
    assert json.loads(out)["model"] == "Ball"


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [(["check", "nonsense"], 1), (["nonsense"], 2), (["simulate", "examples.jack", "-t", "x"], 1)],
)
def test_exit_status_of_errors(arguments: list[str], expected: int) -> None:
    status, out, err = run(*arguments)
    assert status == expected
    assert out == "" and err and "Traceback" not in err


@pytest.mark.parametrize("more", [[], ["--json"]])
def test_ctrl_c_keeps_what_was_computed(models: Path, tmp_path: Path, more: list[str]) -> None:
    file = tmp_path / "part.nc"
    with process("simulate", f"{models}:Slow", "-t", "1", "--interval", "1ms", "-o", file, *more) as running:
        wait_for_solver(running)
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=60)
    message = err.decode()
    assert running.returncode == 130, message
    assert out == b""
    assert "interrupted" in message and str(file) in message and "Traceback" not in message
    solution = Solution.load(file)
    assert solution.run.status == "interrupted"
    np.testing.assert_allclose(solution["x"], np.cos(1e6 * solution.t), atol=0.1)


def wait_for_solver(running: subprocess.Popen[bytes]) -> None:
    """Wait until the process has loaded the solver, and a second more: it needs many to finish."""
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline and running.poll() is None:
        if "sksundae" in Path(f"/proc/{running.pid}/maps").read_text():
            time.sleep(1.0)
            return
        time.sleep(0.05)
    raise AssertionError(f"the run did not get to work: {running.poll()}")


def test_a_terminal_gets_a_progress_bar(models: Path) -> None:
    terminal, its_end = pty.openpty()
    with process("simulate", f"{models}:Slow", "-t", "0.02", stderr=its_end) as running:
        os.close(its_end)
        shown = b"".join(iter(lambda: read(terminal), b""))
        out, _ = running.communicate(timeout=120)
    os.close(terminal)
    assert running.returncode == 0
    assert b"of 0.02 s" in shown and b"%" in shown
    assert out.startswith(b"Slow: 0 to 0.02 s")


def read(terminal: int) -> bytes:
    """What was written to a terminal since; nothing once its other end is closed."""
    try:
        return os.read(terminal, 65536)
    except OSError:  # Linux says so when the last writer has gone
        return b""


def test_help_loads_no_model_and_no_solver() -> None:
    code = (
        "import sys; sys.argv = ['arthur', '--help']\n"
        "from arthur_acausal.cli import main\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        "heavy = {'casadi', 'numpy', 'rich', 'scipy', 'xarray', 'matplotlib', 'pint', 'sksundae'} & set(sys.modules)\n"
        "print(sorted(heavy), file=sys.stderr)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=True)
    assert run.stderr == "[]\n"
