"""mypy and pyright read models as Python does: right ones pass, a wrong argument is rejected where it stands."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

# A line ends in what each checker must say of it, by the name of its rule; all other lines are right.
SNIPPET = '''
from typing import Any, assert_type

import numpy as np
import pint
from casadi import SX, sqrt

from arthur_acausal import (
    Component, Connector, Equations, Real, Record, Solution, Translation, connect, der, flow, parameter, potential,
    real_input, real_output, simulate, start, translate, variable,
)


class Port(Connector):
    p: Real = potential("Pa")
    q: Real = flow("m^3/s")


class Liquid(Record):
    rho: Real = parameter("kg/m^3", default=850.0)


class Other(Record):
    x: Real = parameter("1", default=1.0)


class Orifice(Component):
    """A required parameter, one with a default, a structural one, a part to replace, variables and signals."""

    port_a = Port()
    port_b = Port()
    liquid: Liquid = Liquid()
    smooth: bool = False
    area: Real = parameter("m^2", min=0.0)
    C_d: Real = parameter("1", default=0.7)
    opening: Real = real_input("1", default=1.0)
    loss: Real = real_output("W")
    dp: Real = variable("Pa", start=0.0)

    def equations(self) -> Equations:
        a, b = self.port_a, self.port_b
        assert_type(self.area, SX)
        assert_type(self.dp, SX)
        assert_type(a, Port)
        assert_type(a.p, SX)
        assert_type(self.liquid.rho, SX)
        assert_type(self.smooth, bool)
        yield self.dp == a.p - b.p
        yield "mass balance", a.q + b.q == 0
        yield "law", a.q == self.C_d * self.area * self.opening * sqrt(2 * self.dp / self.liquid.rho)
        yield self.loss == a.q * self.dp
        yield der(self.missing) == 0  # mypy: attr-defined  # pyright: reportAttributeAccessIssue


class Wide(Orifice):
    """Inherits all of it, and adds a parameter."""

    width: Real = parameter("m", default=lambda self: sqrt(self.area))


class Bench(Component):
    n: int
    first: Orifice = Orifice(area=1e-6)
    second: Orifice = Wide(area="2 mm^2", width=pint.Quantity(1, "mm"), dp=start(1e5, fixed=True), smooth=True)

    def build(self) -> None:
        self.items = [Orifice(area=self.first.area / (k + 1), liquid=self.first.liquid) for k in range(self.n)]

    def equations(self) -> Equations:
        assert_type(self.items, list[Orifice])
        yield connect(self.first.port_b, self.items[0].port_a)


class Cloud(Component):
    """Vectors, which take one value for all elements or a sequence, and are columns."""

    n: int = 3
    g: Real = parameter("m/s^2", shape=3, default=[0.0, 0.0, -9.81], min=-10.0)
    m: Real = parameter("kg", shape=lambda self: self.n, default=lambda self: [1.0] * self.n)
    v: Real = variable("m/s", shape=3, start=[0.0, "1 km/h", 0.0], nominal=[1.0, 2.0, 3.0])

    def equations(self) -> Equations:
        assert_type(self.v, SX)
        yield der(self.v) == self.g


Cloud(g=0.0, m=[1.0, 2.0, 3.0], v=start(["1 m/s", 0.0, 0.0], fixed=True, nominal=[1.0, 1.0, 1.0]))
Cloud(g=np.zeros(3), v=[0.0, 0.0, 0.0])
Cloud(g=[None, 0.0, 0.0])  # mypy: list-item  # pyright: reportArgumentType
variable("m", shape="3")  # mypy: arg-type  # pyright: reportArgumentType

assert_type(Orifice.area, Real)
assert_type(translate(Bench(n=3)), Translation)
assert_type(simulate(Bench(n=3), 1.0), Solution)
Orifice(area=1e-6, C_d=lambda self: 0.5, opening=0.5)
Orifice(liquid=Liquid(rho=900.0), area=1e-6)

Orifice()  # mypy: call-arg  # pyright: reportCallIssue
Orifice(1e-6)  # mypy: arg-type, call-arg  # pyright: reportCallIssue
Orifice(aera=1e-6, area=1e-6)  # mypy: call-arg  # pyright: reportCallIssue
Orifice(area={1e-6})  # mypy: arg-type  # pyright: reportArgumentType
Orifice(area=None)  # mypy: arg-type  # pyright: reportArgumentType
Orifice(area=1e-6, smooth="yes")  # mypy: arg-type  # pyright: reportArgumentType
Orifice(area=1e-6, liquid=Other())  # mypy: arg-type  # pyright: reportArgumentType
Orifice(area=1e-6, liquid=850.0)  # mypy: arg-type  # pyright: reportArgumentType
Orifice(area=1e-6, dp=Port())  # mypy: arg-type  # pyright: reportArgumentType
Wide(width=1e-3)  # mypy: call-arg  # pyright: reportCallIssue
Bench()  # mypy: call-arg  # pyright: reportCallIssue
Bench(n=2.5)  # mypy: arg-type  # pyright: reportArgumentType
Bench(n=2, first=Port())  # mypy: arg-type  # pyright: reportArgumentType
Liquid(rho=850.0, nu=1e-5)  # mypy: call-arg  # pyright: reportCallIssue
translate(Orifice)  # mypy: arg-type  # pyright: reportArgumentType
translate(Bench(n=1)).simulate("1 s")  # mypy: arg-type  # pyright: reportArgumentType
variable("m", state_select="sometimes")  # mypy: arg-type  # pyright: reportArgumentType
parameter("m", unit="m")  # mypy: misc  # pyright: reportCallIssue
x: int = simulate(Bench(n=1), 1.0)  # mypy: assignment  # pyright: reportAssignmentType
'''

Found = dict[int, set[str]]


def expected(checker: str) -> Found:
    """Line -> rules that the snippet's comments name."""
    found = {}
    for number, line in enumerate(SNIPPET.splitlines(), start=1):
        if match := re.search(rf"# {checker}: ([\w-]+(?:, [\w-]+)*)", line):
            found[number] = set(match[1].split(", "))
    return found


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The snippet as a file; pyright has a configuration beside it that finds the package."""
    folder = tmp_path_factory.mktemp("typing")
    path = folder / "snippet.py"
    # the checkers' own comments (`# mypy: ...`) would be read as options
    path.write_text(re.sub(r" +# (mypy|pyright): .*", "", SNIPPET), encoding="utf-8")
    return path


def run(*command: str) -> str:
    """Output of a checker; it may have found errors, but must have run."""
    environment = os.environ | {"PYTHONPATH": str(ROOT), "MYPYPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-m", *command],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1, done.stdout + done.stderr
    return done.stdout


def test_mypy(file: Path) -> None:
    output = run("mypy", "--config-file", str(ROOT / "pyproject.toml"), "--output", "json", str(file))
    found: Found = {}
    for line in output.splitlines():
        if line.startswith("{"):
            message = json.loads(line)
            if message["severity"] == "error" and Path(message["file"]).name == file.name:
                found.setdefault(message["line"], set()).add(message["code"])
    assert lines(found) == lines(expected("mypy"))


def test_pyright(file: Path) -> None:
    configuration = {
        "include": [file.name],
        "extraPaths": [str(ROOT)],
        "pythonVersion": "3.11",
        "typeCheckingMode": "standard",
    }
    (file.parent / "pyrightconfig.json").write_text(json.dumps(configuration), encoding="utf-8")
    output = run("pyright", "--outputjson", "--pythonpath", sys.executable, "--project", str(file.parent))
    found: Found = {}
    for message in json.loads(output)["generalDiagnostics"]:
        if message["severity"] == "error":
            line = message["range"]["start"]["line"] + 1
            found.setdefault(line, set()).add(message.get("rule", ""))
    assert lines(found) == lines(expected("pyright"))


def lines(found: Found) -> dict[str, set[str]]:
    """The same by the text of each line, for a readable comparison."""
    texts = SNIPPET.splitlines()
    return {
        f"{number}: {texts[number - 1].partition('  #')[0]}": rules for number, rules in sorted(found.items())
    }
