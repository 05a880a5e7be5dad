"""Imports go one way: a stage of the pipeline uses only the stages left of it, a model only public names."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

import arthur_acausal

ROOT = Path(__file__).parents[2]

# The way of the data, left to right.
LAYERS = (
    "errors",
    "units",
    "declare",
    "graph",
    "flatten",
    "transform",
    "codegen",
    "solve",
    "result",
    "analysis",
    "exchange",
    "api",
    "learning",
    "components",
    "mujoco",
    "models",
    "render",
    "request",
    "sweep",
    "cli",
)

# Libraries that cost a noticeable time to import or open windows, and the layers built upon them. Everybody
# else imports them inside the function that needs them; so do these layers where they are imported early.
HEAVY = {
    "distributed": set[str](),
    "gymnasium": {"learning"},
    "matplotlib": {"result"},
    "mujoco": {"mujoco"},
    "pandas": {"result"},
    "pint": set[str](),
    "rich": {"cli", "sweep"},
    "plotly": set[str](),
    "psutil": set[str](),
    "pydantic": {"sweep"},
    "scipy": {"solve"},
    "sksundae": {"solve"},
    "typer": {"cli"},
    "xarray": {"result"},
    "zarr": set[str](),
}


class Import(NamedTuple):
    """One imported module, or one name imported from it."""

    module: str
    name: str
    line: int
    top: bool
    """Executed when the importing module is: neither in a function nor under `if TYPE_CHECKING`."""


def imports(source: str, package: str) -> Iterator[Import]:
    """Every import statement of a module in `package`, relative ones made absolute."""
    parts = package.split(".")

    def visit(node: ast.AST, top: bool) -> Iterator[Import]:
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.Import):
                yield from (Import(alias.name, "", child.lineno, top) for alias in child.names)
            elif isinstance(child, ast.ImportFrom):
                base = parts[: len(parts) - child.level + 1] if child.level else []
                module = ".".join([*base, *([child.module] if child.module else [])])
                yield from (Import(module, alias.name, child.lineno, top) for alias in child.names)
            yield from visit(child, top and not _is_deferred(child))

    return visit(ast.parse(source), True)


def _imports_of(path: Path) -> Iterator[Import]:
    module = _module(path)
    package = module if path.name == "__init__.py" else module.rpartition(".")[0]
    return imports(path.read_text(encoding="utf-8"), package)


def _is_deferred(node: ast.AST) -> bool:
    function = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
    return function or (isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test))


def _module(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    if parts[0] in ("components", "models"):
        parts = ("arthur_acausal", *parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _layer(module: str) -> str | None:
    """The layer of a module inside the package; None for the package itself and for what is outside."""
    parts = module.split(".")
    return parts[1] if parts[0] == "arthur_acausal" and len(parts) > 1 else None


def _files(*folders: str) -> list[Path]:
    """Python files below the folders; the two symlinks are left out."""
    links = (ROOT / "arthur_acausal/components", ROOT / "arthur_acausal/models")
    found = (path for folder in folders for path in sorted((ROOT / folder).rglob("*.py")))
    return [path for path in found if not any(link in path.parents for link in links)]


def _imported_layers(item: Import) -> Iterator[str]:
    """`from arthur_acausal import flatten` names a layer too."""
    if layer := _layer(item.module):
        yield layer
    elif item.module == "arthur_acausal" and (item.name in LAYERS or not item.name):
        yield item.name or "api"


def _place(path: Path, item: Import) -> str:
    return f"{path.relative_to(ROOT)}:{item.line}: {item.module} {item.name}".rstrip()


PACKAGE_FILES = [path for path in _files("arthur_acausal") if _layer(_module(path)) is not None]


def test_imports_are_found_wherever_they_stand() -> None:
    source = """
import casadi as ca, numpy
from ..graph import matching
if TYPE_CHECKING:
    from .system import FlatSystem
def late():
    import scipy.sparse
"""
    assert [item._replace(line=0) for item in imports(source, "arthur_acausal.flatten")] == [
        Import("casadi", "", 0, True),
        Import("numpy", "", 0, True),
        Import("arthur_acausal.graph", "matching", 0, True),
        Import("arthur_acausal.flatten.system", "FlatSystem", 0, False),
        Import("scipy.sparse", "", 0, False),
    ]


def test_every_module_has_a_layer() -> None:
    strangers = {_layer(_module(path)) for path in PACKAGE_FILES} - set(LAYERS) - {"__main__"}
    assert not strangers, f"place {strangers} in LAYERS"


def test_a_layer_imports_only_layers_left_of_it() -> None:
    wrong = [
        _place(path, item)
        for path in PACKAGE_FILES
        if (own := _layer(_module(path))) in LAYERS
        for item in _imports_of(path)
        for other in _imported_layers(item)
        if other not in LAYERS or LAYERS.index(other) > LAYERS.index(own)
    ]
    assert not wrong, "imports against the way of the data:\n" + "\n".join(wrong)


def test_graph_algorithms_see_plain_integers() -> None:
    wrong = [
        _place(path, item)
        for path in _files("arthur_acausal/graph")
        for item in _imports_of(path)
        if item.module.split(".")[0] not in sys.stdlib_module_names
        and not item.module.startswith("arthur_acausal.graph")
    ]
    assert not wrong, "graph/ imports the standard library and itself only:\n" + "\n".join(wrong)


@pytest.mark.parametrize(
    ("folder", "packages"),
    [
        ("components", ("arthur_acausal.components",)),
        ("arthur_acausal/mujoco", ("arthur_acausal.components", "arthur_acausal.mujoco")),
        (
            "models",
            tuple(f"arthur_acausal.{part}" for part in ("components", "learning", "models", "mujoco")),
        ),
    ],
)
def test_the_library_uses_public_names_only(folder: str, packages: tuple[str, ...]) -> None:
    public = set(arthur_acausal.__all__)
    wrong = [
        _place(path, item)
        for path in _files(folder)
        for item in _imports_of(path)
        if item.module.startswith("arthur_acausal")
        and not (item.module == "arthur_acausal" and item.name in public)
        and not any(f"{item.module}.".startswith(f"{package}.") for package in packages)
    ]
    assert not wrong, f"{folder}/ imports more than public names:\n" + "\n".join(wrong)


def test_heavy_libraries_are_imported_where_they_are_used() -> None:
    wrong = [
        _place(path, item)
        for path in _files("arthur_acausal", "components", "models")
        for item in _imports_of(path)
        if item.top
        and (library := item.module.split(".")[0]) in HEAVY
        and _layer(_module(path)) not in HEAVY[library]
    ]
    assert not wrong, "import these inside the function that needs them:\n" + "\n".join(wrong)


@pytest.mark.parametrize(
    "statement",
    [
        "import arthur_acausal",
        "import arthur_acausal.cli",
        "import arthur_acausal.components.hydraulic, arthur_acausal.models.arthur",
    ],
)
def test_importing_the_package_loads_nothing_heavy(statement: str) -> None:
    names = sorted(set(HEAVY) - {"rich", "typer"})
    code = f"import sys; {statement}; print(*[name for name in {names} if name in sys.modules])"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=False)
    assert run.returncode == 0, run.stderr
    assert run.stdout.split() == [], f"`{statement}` also loads {run.stdout.strip()}"
