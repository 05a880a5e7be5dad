"""The package is whole however it is installed: wheel, sdist, wheel of an sdist, editable."""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).parents[2]
SHIPPED = {"": "arthur_acausal", "components": "components", "models": "models"}
USE = """
import arthur_acausal.components.hydraulic, arthur_acausal.models.arthur
print(arthur_acausal.__file__, arthur_acausal.components.__file__, arthur_acausal.models.__file__, sep="\\n")
"""


@pytest.fixture(scope="module")
def project() -> dict[str, Any]:
    """pyproject.toml."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def source(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of what ships, in a folder whose name has a space, so that builds leave the work tree alone."""
    copy = tmp_path_factory.mktemp("a source")
    for name in (*SHIPPED.values(), "pyproject.toml", "README.md", "LICENSE", "CHANGELOG.md"):
        if (ROOT / name).is_dir():
            ignore = shutil.ignore_patterns("__pycache__")
            shutil.copytree(ROOT / name, copy / name, symlinks=True, ignore=ignore)
        else:
            shutil.copy(ROOT / name, copy / name)
    return copy


@pytest.fixture(scope="module")
def built(source: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Three archives: `sdist`, the `wheel` built from it, and the `direct` wheel of the work tree."""
    out = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--no-isolation"]
    _run(*command, "--outdir", out / "a", source)
    _run(*command, "--wheel", "--outdir", out / "b", source)
    (sdist,), (wheel,) = (out / "a").glob("*.tar.gz"), (out / "a").glob("*.whl")
    (direct,) = (out / "b").glob("*.whl")
    return {"sdist": sdist, "wheel": wheel, "direct": direct}


def _run(*command: str | Path) -> str:
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout


def _site_packages() -> str:
    """Where the dependencies are."""
    spec = importlib.util.find_spec("casadi")
    assert spec is not None and spec.origin is not None
    return str(Path(spec.origin).parents[1])


def _imported_from(target: Path) -> list[Path]:
    """The files of the package and its two libraries as an interpreter sees them that knows only `target`.

    -S leaves the .pth files of the environment out, and with them its own editable install.
    """
    setup = f"import site, sys; site.addsitedir({str(target)!r}); sys.path.append({_site_packages()!r})\n"
    return [Path(line) for line in _run(sys.executable, "-I", "-S", "-c", setup + USE).splitlines()]


def _shipped_folders() -> set[str]:
    packages = set()
    for inside, top in SHIPPED.items():
        for init in (ROOT / top).rglob("__init__.py"):
            parts = init.parent.relative_to(ROOT / top).parts
            if inside or not parts or parts[0] not in SHIPPED:
                packages.add(".".join(["arthur_acausal", *([inside] if inside else []), *parts]))
    return packages


def test_the_packages_list_is_every_folder_with_an_init(project: dict[str, Any]) -> None:
    listed = project["tool"]["setuptools"]["packages"]
    assert listed == sorted(set(listed))
    assert set(listed) == _shipped_folders()


def test_every_folder_with_code_has_an_init() -> None:
    folders = {path.parent for top in SHIPPED.values() for path in (ROOT / top).rglob("*.py")}
    assert not [str(folder) for folder in folders if not (folder / "__init__.py").exists()]


@pytest.mark.parametrize("name", ["components", "models"])
def test_the_libraries_are_relative_symlinks(name: str) -> None:
    assert (ROOT / "arthur_acausal" / name).readlink() == Path("..", name)


def test_constraints_pin_every_dependency_within_its_range(project: dict[str, Any]) -> None:
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    pins = dict(line.split("==") for line in lines if line and not line.startswith("#"))
    versions = {_canonical(name): version for name, version in pins.items()}
    metadata = project["project"]
    for text in [*metadata["dependencies"], *metadata["optional-dependencies"]["test"]]:
        requirement = Requirement(text)
        assert requirement.specifier.contains(versions[_canonical(requirement.name)]), text


def _canonical(name: str) -> str:
    return re.sub("[-_.]+", "-", name).lower()


def test_wheels_hold_every_module_once(built: dict[str, Path]) -> None:
    expected = {"arthur_acausal/py.typed"}
    for inside, top in SHIPPED.items():
        for pattern in ("*.py", "*.csv", "*.c", "*.html", "*.json", "*.npz"):
            for path in (ROOT / top).rglob(pattern):
                parts = path.relative_to(ROOT / top).parts
                if inside or parts[0] not in SHIPPED:
                    expected.add("/".join(["arthur_acausal", *([inside] if inside else []), *parts]))
    for which in ("wheel", "direct"):
        with zipfile.ZipFile(built[which]) as archive:
            names = archive.namelist()
        assert len(names) == len(set(names))
        assert {name for name in names if ".dist-info/" not in name} == expected, which


def test_the_sdist_holds_files_and_no_links(built: dict[str, Path]) -> None:
    with tarfile.open(built["sdist"]) as archive:
        members = archive.getmembers()
    assert not [member.name for member in members if member.issym() or member.islnk()]
    names = {member.name.partition("/")[2] for member in members}
    assert {"LICENSE", "README.md", "components/__init__.py", "models/arthur/__init__.py"} <= names


@pytest.mark.parametrize("which", ["wheel", "direct"])
def test_a_wheel_installs_and_imports(built: dict[str, Path], which: str, tmp_path: Path) -> None:
    target = tmp_path / "target"
    _run(
        *(sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps"),
        *("--target", target, built[which]),
    )
    assert all(target in path.parents for path in _imported_from(target))


def test_an_editable_install_follows_the_source(source: Path, tmp_path: Path) -> None:
    target = tmp_path / "target"
    _run(
        *(sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps"),
        *("--no-build-isolation", "--target", target, "--editable", source),
    )
    assert all(source in path.parents for path in _imported_from(target))
