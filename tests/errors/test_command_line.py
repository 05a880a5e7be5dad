"""Faults that a user makes on the command line: one message on standard error, and the exit status."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from typer.testing import CliRunner

from arthur_acausal.cli.batch import app

DECAY = """
from arthur_acausal import Component, Equations, Real, der, parameter, real_input, variable


class Decay(Component):
    T: Real = parameter("s", default=1.0)
    u: Real = real_input("m", default=0.0)
    x: Real = variable("m", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield "balance", self.T * der(self.x) == self.u - self.x
"""

FILES: Mapping[str, str] = {
    "decay.py": DECAY,
    "empty.py": "PI = 3\n",
    "broken.py": "def f(:\n",
    "raises.py": "import nowhere_to_be_found\n",
    "missing.py": DECAY.replace(" == self.u - self.x", ""),
    "short.csv": "time,u\n0,0\n0.5,1\n",
    "words.csv": "time,u\n0,0\n1,fast\n",
    "columns.csv": "time,speed,force\n0,0,0\n1,1,1\n",
    "rows.csv": "time,u\n0,0\n1\n",
    "order.csv": "time,u\n1,0\n0,1\n",
    "header.csv": "time,u\n",
}

# name -> (arguments, exit status, patterns of the message)
FAULTS: Mapping[str, tuple[str, int, list[str]]] = {
    "no model in the file": ("check empty.py", 1, [r"empty\.py", r"no subclass of Component"]),
    "file that is no Python": ("check broken.py", 1, [r"broken\.py is not valid Python", r"broken\.py:1"]),
    "file that cannot be imported": ("check raises.py", 1, [r"raises\.py:1", r"nowhere_to_be_found"]),
    "no such file": ("check nowhere.py", 1, [r"nowhere\.py"]),
    "no such class": ("check decay.py:Decoy", 1, [r"no class 'Decoy'", r"did you mean Decay\?"]),
    "class that is no model": ("check decay.py:der", 1, [r"no model", r"not a subclass of Component"]),
    "no such model": (
        "check arthur.powertran",
        1,
        [r"no model 'arthur\.powertran'", r"did you mean arthur\.powertrain"],
    ),
    "fault in the model": ("simulate missing.py", 1, [r"Decay", r"missing\.py:11", r"is no equation"]),
    "misspelt parameter": ("simulate decay.py --set TT=2", 1, [r"no parameter 'TT'", r"did you mean T\?"]),
    "parameter of a wrong unit": ("simulate decay.py --set T=2bar", 1, [r"\bT\b", r"pressure", r"time"]),
    "setting without a value": ("simulate decay.py --set T", 1, [r"--set T", r"path=value"]),
    "misspelt input": ("simulate decay.py --input v=2", 1, [r"no input 'v'", r"it has u"]),
    "table that is too short": (
        "simulate decay.py --input u=short.csv",
        1,
        [r"'u'", r"short\.csv", r"0 s to 0\.5 s"],
    ),
    "column that is not there": (
        "simulate decay.py --input u=columns.csv:sped",
        1,
        [r"columns\.csv", r"speed"],
    ),
    "column that is not named": (
        "simulate decay.py --input u=columns.csv",
        1,
        [r"columns\.csv", r"speed.*force"],
    ),
    "cell that is no number": (
        "simulate decay.py --input u=words.csv",
        1,
        [r"words\.csv, line 3", r"'fast'"],
    ),
    "row that is too short": ("simulate decay.py --input u=rows.csv", 1, [r"rows\.csv, line 3", r"1 field"]),
    "times that go back": (
        "simulate decay.py --input u=order.csv",
        1,
        [r"order\.csv", r"0 s comes after 1 s"],
    ),
    "table without rows": ("simulate decay.py --input u=header.csv", 1, [r"header\.csv", r"no rows"]),
    "no such table": (
        "simulate decay.py --input u=nowhere.csv",
        1,
        [r"nowhere\.csv", r"cause: no such file"],
    ),
    "result into a full disk": ("simulate decay.py -o /dev/full", 1, [r"/dev/full"]),
    "result into no folder": ("simulate decay.py -o nowhere/x.nc", 1, [r"nowhere"]),
    "variable that is not in the result": ("plot decay.nc speed", 1, [r"'speed'"]),
    "result that is none": ("plot decay.py x", 1, [r"decay\.py"]),
    "stop time that is no time": ("simulate decay.py -t 3kg", 1, [r"3(\.0)? kg", r"mass", r"time"]),
    "unknown option": ("simulate decay.py --stop 3", 2, [r"--stop"]),
    "no argument": ("simulate", 2, [r"MODEL"]),
}


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], tuple[int, str, str]]:
    """The command in a folder with the files: exit status, standard output, standard error."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")

    def command(arguments: str) -> tuple[int, str, str]:
        result = CliRunner().invoke(app, arguments.split(), prog_name="arthur")
        return result.exit_code, result.stdout, result.stderr

    return command


@pytest.mark.parametrize("name", FAULTS)
def test_one_message_and_the_status(name: str, run: Callable[[str], tuple[int, str, str]]) -> None:
    arguments, status, patterns = FAULTS[name]
    if arguments.startswith("plot decay.nc"):
        assert run("simulate decay.py -o decay.nc")[0] == 0
    code, output, complaint = run(arguments)
    assert code == status, complaint
    for pattern in patterns:
        assert re.search(pattern, complaint, re.DOTALL), f"{pattern!r} is not in: {complaint}"
    assert "Traceback" not in complaint + output
    if status == 1:
        assert complaint.count("error:") == 1, complaint
        assert complaint.startswith("error: ")


def test_json_prints_nothing_but_the_message_where_it_fails(
    run: Callable[[str], tuple[int, str, str]],
) -> None:
    code, output, complaint = run("simulate decay.py --set TT=2 --json")
    assert (code, output) == (1, "")
    assert complaint.count("error:") == 1
