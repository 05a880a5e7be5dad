"""Films of stored runs: from the file alone, the body where it belongs, and a clear word where nothing can be drawn."""

from __future__ import annotations

import platform
from functools import cache
from math import cos, sin, tan
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from arthur_acausal import (
    Component,
    Equations,
    ResultError,
    Solution,
    SolverOptions,
    UsageError,
    connect,
    translate,
)
from arthur_acausal.cli.batch import app
from arthur_acausal.components.rotational import Inertia
from arthur_acausal.mujoco import MujocoBody, offscreen
from arthur_acausal.mujoco.acting import Acting, bodies
from arthur_acausal.mujoco.offscreen import Image, canvas
from arthur_acausal.mujoco.recipe import Recipe
from arthur_acausal.render import movie, render
from tests.mujoco.models import PENDULUM, SPHERE

SIZE, DEPTH, LENGTH = (120, 90), 3.0, 0.5
SEEN = PENDULUM.replace(
    "<worldbody>",
    f'<worldbody><light pos="0 -1 3"/><camera name="front" pos="0 -{DEPTH} 0" xyaxes="1 0 0 0 0 1" fovy="40"/>',
).replace('mass="2"', 'mass="2" rgba="1 0 0 1"')


class Clock(Component):
    """The pendulum with a wheel on its shaft, so that the body is a part."""

    body = MujocoBody(mjcf=SEEN, hinge_phi=0.8)
    wheel = Inertia(J=0.1)

    def equations(self) -> Equations:
        yield connect(self.body.hinge, self.wheel.flange_a)

    def beside(self) -> dict[str, dict[str, str]]:
        return {"angle [deg]": {"pendulum": "body.hinge_phi"}}


@cache
def swing() -> Solution:
    return translate(Clock()).simulate(1.0, options=SolverOptions(rtol=1e-6, intervals=50))


@pytest.fixture
def stored(tmp_path: Path) -> Path:
    file = tmp_path / "swing.nc"
    swing().save(file)
    return file


@pytest.fixture
def opengl() -> None:
    try:
        with canvas(bodies(swing())["body"].dynamics().model, (8, 8)):
            pass
    except UsageError as error:
        pytest.skip(str(error))


def test_a_file_has_all_that_a_film_takes(stored: Path) -> None:
    solution = Solution.load(stored)
    assert bodies(solution)["body"].source.text == SEEN
    acting, times = Acting(solution), np.linspace(0.0, 1.0, 23)
    angles = [float(acting.dynamics.data.qpos[0]) for _ in acting.at(times)]
    assert angles == pytest.approx(solution.at(times, "body.hinge_phi"), abs=1e-14)
    assert solution.run.beside == Clock().beside()
    with pytest.raises(UsageError, match="'body'"):
        Acting(solution, "leg")


def test_the_body_is_drawn_where_it_is(opengl: None) -> None:
    """The ball's picture stands where a pinhole camera sees it."""
    acting, times = Acting(swing()), np.array([0.0, 0.3, 0.5])
    focal = SIZE[1] / 2 / tan(np.radians(20.0))
    with canvas(acting.dynamics.model, SIZE, "front") as drawing:
        for t in acting.at(times):
            image = drawing.draw(acting.dynamics.data).astype(int)
            rows, columns = np.nonzero(image[..., 0] - image[..., 1] > 40)
            phi = float(swing().at(t, "body.hinge_phi"))
            assert columns.mean() == pytest.approx(SIZE[0] / 2 + focal * LENGTH * sin(phi) / DEPTH, abs=1.0)
            assert rows.mean() == pytest.approx(SIZE[1] / 2 + focal * LENGTH * cos(phi) / DEPTH, abs=1.0)


def test_contact_forces_of_a_sphere_that_comes_to_rest() -> None:
    acting = Acting(translate(MujocoBody(mjcf=SPHERE)).simulate(1.0, tolerance=1e-8))
    _, forces = acting.forces()
    assert list(forces) == ["ball"]
    assert forces["ball"][0] == 0.0
    assert forces["ball"][-1] == pytest.approx(9.81, rel=1e-5)


def test_films_and_a_film_strip(opengl: None, stored: Path, tmp_path: Path) -> None:
    import av
    from PIL.Image import open as read

    def run(name: str, *options: str) -> Path:
        file = tmp_path / name
        arguments = [
            "render",
            str(stored),
            "-o",
            str(file),
            "--camera",
            "front",
            "--size",
            "160x320",
            *options,
        ]
        result = CliRunner().invoke(app, arguments)
        assert result.exit_code == 0, result.output
        return file

    with read(run("a.gif", "--fps", "10", "--speed", "0.5")) as gif:
        assert (gif.n_frames, gif.size, gif.info["duration"]) == (20, (560, 320), 100)  # type: ignore[attr-defined]
    with av.open(run("a.mp4", "--fps", "12")) as container:
        pictures = [frame.to_ndarray(format="rgb24").astype(np.uint8) for frame in container.decode(video=0)]
    assert (len(pictures), pictures[0].shape) == (12, (320, 560, 3))
    now = [orange(picture) for picture in pictures]
    assert np.diff(now) == pytest.approx(np.full(11, np.mean(np.diff(now))), abs=2.5)  # the line moves on
    with read(run("a.png", "--frames", "4")) as strip:
        assert min(strip.size) > 300


def orange(picture: Image) -> float:
    """Return the column of the line at the present time."""
    red, _, blue = np.moveaxis(picture[:, 160:].astype(int), 2, 0)
    return float(np.argmax(np.maximum(red - blue, 0).sum(axis=0)))  # the encoder spreads colours a little


def test_what_cannot_be_drawn_is_told(stored: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(name: str, *options: str) -> str:
        result = CliRunner().invoke(app, ["render", str(stored), "-o", str(tmp_path / name), *options])
        assert result.exit_code == 1
        return result.output

    assert ".mp4 or .gif" in fails("a.avi")
    assert "640x480" in fails("a.gif", "--size", "wide")
    assert "must be positive" in fails("a.gif", "--fps", "0")
    monkeypatch.setattr(movie, "find_spec", lambda name: None)
    assert "arthur-acausal[video]" in fails("a.mp4")
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    monkeypatch.setattr(platform, "system", lambda: "Linux")
    monkeypatch.setattr(offscreen, "find_library", lambda name: None)
    assert "neither libEGL nor libOSMesa" in fails("a.gif")
    assert not (tmp_path / "a.gif").exists()


def test_a_run_without_a_body_has_no_film(tmp_path: Path) -> None:
    from arthur_acausal.models.examples.jack import Jack

    solution = translate(Jack()).simulate(0.1, options=SolverOptions(intervals=2))
    with pytest.raises(ResultError, match="no MuJoCo body"):
        render(solution, tmp_path / "a.png")
    with (
        pytest.raises(UsageError, match="no camera 'up'"),
        canvas(Acting(swing()).dynamics.model, (8, 8), "up"),
    ):
        pass


def test_a_body_from_a_file_names_only_files_that_came_with_it() -> None:
    data = Recipe(bodies(swing())["body"].source).as_data()
    for named in ("cube.obj", "/etc/cube.obj", "../cube.obj"):
        mesh = f'<mujoco><asset><mesh name="m" file="{named}"/></asset></mujoco>'
        with pytest.raises(UsageError, match=r"cube\.obj"):
            Recipe.of_data(data | {"text": mesh})
