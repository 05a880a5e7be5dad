"""Every fault of the corpus ends with exactly one clear error.

Every other file of this folder holds a broken model or call: ``run()`` does what is wrong, ``ERROR`` is the class of
the error, ``EXPECT`` lists patterns that its text must match, and a line that ends in ``# culprit`` is the line that
must be named.
"""

from __future__ import annotations

import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest
from typer.testing import CliRunner

import arthur_acausal
from arthur_acausal import ArthurError
from arthur_acausal.cli.batch import app

FOLDER = Path(__file__).parent
FAULTS = sorted(set(FOLDER.glob("*.py")) - {FOLDER / "__init__.py", Path(__file__)})
CULPRIT = "# culprit"


def load(file: Path) -> ModuleType:
    """Import a fault by its file."""
    name = f"tests.faults.{file.stem}"
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def fail(module: ModuleType) -> ArthurError:
    """Return the error that a fault ends with."""
    with pytest.raises(ArthurError) as caught:
        module.run()
    return caught.value


@pytest.mark.parametrize("file", FAULTS, ids=[file.stem for file in FAULTS])
def test_one_clear_message(file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    module = load(file)
    error = fail(module)
    text = str(error)
    assert isinstance(error, module.ERROR), f"{type(error).__name__}: {text}"
    for pattern in module.EXPECT:
        assert re.search(pattern, text, re.MULTILINE), f"{pattern!r} is not in: {text}"
    lines = file.read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, start=1):
        if line.endswith(CULPRIT):
            assert re.search(rf"\b{file.name}:{number}\b", text), f"line {number} is not named in: {text}"
    assert len(text) < 1500, "short enough to be read"
    assert "0x" not in text and "<bound" not in text, "no addresses of objects"


AT_TRANSLATION = re.compile(r"^def run\(\) -> object:\n    return translate\((\w+)\(\)\)$", re.MULTILINE)


@pytest.mark.parametrize(
    ("file", "name"),
    [
        pytest.param(file, found[1], id=file.stem)
        for file in FAULTS
        if (found := AT_TRANSLATION.search(file.read_text(encoding="utf-8")))
    ],
)
def test_check_prints_the_same_message(file: Path, name: str) -> None:
    error = fail(load(file))
    result = CliRunner().invoke(app, ["check", f"{file}:{name}"], prog_name="arthur")
    assert (result.exit_code, result.stdout) == (1, "")
    assert result.stderr.strip() == f"error: {error}"


def test_the_corpus_is_large_and_of_every_kind() -> None:
    modules = [load(file) for file in FAULTS]
    assert len(modules) >= 100
    kinds = {module.ERROR for module in modules}
    assert kinds == {
        getattr(arthur_acausal, name)
        for name in arthur_acausal.__all__
        if name.endswith("Error") and name != "ArthurError"
    }


def test_an_error_at_simulation_keeps_what_was_computed() -> None:
    error = fail(load(FOLDER / "not_finite_root.py"))
    solution = error.solution  # type: ignore[attr-defined]
    assert 0.999 < solution.t[-1] <= 1.0
    # the closed form up to there: x = 1 - t, w = 1 + 2/3 (1 - (1 - t)^1.5)
    assert solution["x"] == pytest.approx(1.0 - solution.t, abs=1e-6)
    assert solution["w"] == pytest.approx(1 + 2 / 3 * (1 - abs(1 - solution.t) ** 1.5), abs=1e-4)
