"""What the tests of the command line share: a model file, and the command itself."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from arthur_acausal.cli.batch import app

ROOT = Path(__file__).parents[2]

BALL = '''
"""A file with two models and other things."""

from casadi import sqrt

from arthur_acausal import (
    Component, Equations, Real, der, discrete, parameter, pre, real_input, reinit, variable, when,
)


class Ball(Component):
    """A ball that bounces on a floor."""

    g: Real = parameter("m/s^2", default=9.81, description="gravity")
    e: Real = parameter("1", default=0.8, min=0.0, max=1.0, description="restitution")
    height: float = 1.0
    h: Real = variable("m", start=lambda self: self.height, fixed=True, description="height of the ball")
    v: Real = variable("m/s", start=0.0, fixed=True, display="km/h", description="velocity")
    wind: Real = real_input("m/s^2", default=0.0)
    bounces: Real = discrete("1", start=0.0)

    def equations(self) -> Equations:
        yield "kinematics", der(self.h) == self.v
        yield "gravity", der(self.v) == self.wind - self.g
        yield when(self.h <= 0, reinit(self.v, -self.e * pre(self.v)), self.bounces == pre(self.bounces) + 1)


class Collapse(Component):
    """Its solution x = (1 - 1.5 t)^(2/3) ends at t = 2/3 s with an infinite slope."""

    rate: Real = parameter("1/s", default=1.0)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield "decay", der(self.x) == -self.rate / sqrt(self.x)


class Slow(Component):
    """An oscillator that takes a while: 1e6 rad/s."""

    w: Real = parameter("rad/s", default=1e6)
    x: Real = variable("1", start=1.0, fixed=True)
    v: Real = variable("1/s", start=0.0, fixed=True, nominal=1e6)

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield der(self.v) == -self.w**2 * self.x
'''


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep what is compiled out of the user's cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.getbasetemp() / "cache"))


@pytest.fixture
def models(tmp_path: Path) -> Path:
    """The file with the models."""
    file = tmp_path / "models_of_tests.py"
    file.write_text(BALL)
    return file


@pytest.fixture
def ball(models: Path) -> str:
    """MODEL for the ball."""
    return f"{models}:Ball"


@pytest.fixture
def arthur() -> Callable[..., Result]:
    """The command, within this process."""

    def run(*arguments: object) -> Result:
        return CliRunner().invoke(app, [str(argument) for argument in arguments], prog_name="arthur")

    return run


@contextmanager
def process(*arguments: object, stderr: int = subprocess.PIPE) -> Iterator[subprocess.Popen[bytes]]:
    """The command in a process of its own, which ends with the block."""
    with subprocess.Popen(
        [sys.executable, "-m", "arthur_acausal", *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=stderr,
        env=os.environ | {"PYTHONPATH": str(ROOT), "TERM": "xterm"},
    ) as running:
        try:
            yield running
        finally:
            if running.poll() is None:
                running.kill()


def run(*arguments: object) -> tuple[int, str, str]:
    """Exit status, standard output and standard error of the command in a process of its own."""
    with process(*arguments) as running:
        out, err = running.communicate(timeout=120)
    return running.returncode, out.decode(), err.decode()
