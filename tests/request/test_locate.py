"""Finding the model that a command names, and telling what is wrong where there is none."""

from __future__ import annotations

from pathlib import Path

import pytest

from arthur_acausal.errors import UsageError
from arthur_acausal.request.locate import find_model, short_names

TANK = '''
from neighbour import AREA
from arthur_acausal import Component, Equations, Real, der, parameter, variable


class Tank(Component):
    """A tank."""
    area: Real = parameter("m^2", default=AREA)
    h: Real = variable("m", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.area * der(self.h) == 0 * self.h


not_a_model = 3
'''


@pytest.fixture
def tank(tmp_path: Path) -> Path:
    """A file with one model, beside a module that it imports."""
    (tmp_path / "neighbour.py").write_text("AREA = 2.0\n")
    file = tmp_path / "tank.py"
    file.write_text(TANK)
    return file


def test_every_short_name_leads_to_a_model() -> None:
    assert "arthur.powertrain" in short_names()
    for name in short_names():
        assert find_model(name).__doc__, name


def test_a_class_of_a_file(tank: Path) -> None:
    assert find_model(f"{tank}:Tank").__name__ == "Tank"
    assert find_model(str(tank)).__name__ == "Tank", "the file's only model needs no name"


def test_a_class_of_a_module_in_the_present_folder(tank: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tank.parent)
    monkeypatch.setattr("sys.path", ["/nowhere"])
    assert find_model("tank:Tank").__module__ == "tank"


def test_a_file_may_be_called_like_a_library(tank: Path) -> None:
    library = tank.with_name("json.py")
    library.write_text(TANK)
    assert find_model(f"{library}:Tank")
    import json

    assert json.loads("1") == 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "arthur.powertrian",
            r"there is no model 'arthur\.powertrian'[\s\S]*did you mean arthur\.powertrain",
        ),
        ("nonsense", r"there is no model 'nonsense'[\s\S]*arthur list"),
        ("{folder}/none.py:Tank", r"there is no file .*none\.py"),
        ("{folder}:Tank", r"is no module"),
        ("no_such_package.module:Tank", r"there is no module 'no_such_package'"),
        ("arthur_acausal.nothing:Tank", r"there is no module 'arthur_acausal\.nothing'"),
        ("{file}:Tnak", r"has no class 'Tnak'[\s\S]*did you mean Tank"),
        ("{file}:not_a_model", r"is no model[\s\S]*not_a_model is a int, not a subclass of Component"),
        ("{file}:Component", r"Component is a class, not a subclass of Component"),
        ("json:JSONDecoder", r"JSONDecoder is a class, not a subclass of Component"),
        ("json", r"there is no model 'json'"),
    ],
)
def test_what_is_not_there(tank: Path, text: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        find_model(text.format(file=tank, folder=tank.parent))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("x = [1, 2\n", r"bad\.py is not valid Python|\(bad\.py:1\)"),
        ("x = 1\n1 / 0\n", r"\(bad\.py:2\): .*bad\.py cannot be imported[\s\S]*ZeroDivisionError"),
        ("import sys\nsys.exit(3)\n", r"\(bad\.py:2\)[\s\S]*SystemExit: 3"),
        ("import no_such_thing\n", r"\(bad\.py:1\)[\s\S]*No module named 'no_such_thing'"),
        ("x = 1\n", r"does not say which model[\s\S]*no subclass of Component"),
        (TANK + "\nclass Other(Tank): pass\n", r"it defines Tank, Other[\s\S]*bad\.py:Class"),
        ("\x00", r"bad\.py"),
    ],
)
def test_files_that_are_no_models(tank: Path, content: str, message: str) -> None:
    file = tank.with_name("bad.py")
    file.write_text(content)
    with pytest.raises(UsageError, match=message):
        find_model(str(file))


def test_a_module_that_cannot_be_imported(tank: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tank.with_name("broken_module.py").write_text("import no_such_thing\n")
    monkeypatch.syspath_prepend(str(tank.parent))
    with pytest.raises(UsageError, match=r"\(broken_module\.py:1\)[\s\S]*No module named 'no_such_thing'"):
        find_model("broken_module:Tank")
