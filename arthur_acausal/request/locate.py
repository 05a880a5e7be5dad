"""Finding the model that a command names."""

from __future__ import annotations

import importlib
import importlib.util
import inspect
import re
import sys
import traceback
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from arthur_acausal.errors import ArthurError, UsageError, nearest
from arthur_acausal.request.settings import read_settings

FOLDERS: set[str] = set()  # that models' files were loaded from, and that stand in sys.path for it
FORMS = "MODEL is a short name (`arthur list` shows them), package.module:Class or file.py:Class"


def find_model(text: str) -> type[Any]:
    """Return the model class that ``text`` names.

    Parameters
    ----------
    text : a short name ("arthur.powertrain"), "package.module:Class", "file.py:Class", or "file.py" where it
        defines only one model.

    Raises
    ------
    UsageError
        Where there is no such file, module or class, or it is no model. What the author's own code raises
        while it is imported is told with its file and line.
    """
    if file := re.fullmatch(r"(.+\.py)(?::(\w*))?", text):
        return pick(load_file(Path(file[1])), file[2] or "", text)
    if ":" not in text:
        registry = short_names()
        if text not in registry:
            raise UsageError(f"there is no model {text!r}", remedy=nearest(text, registry) or FORMS)
        text = registry[text]
    source, _, name = text.partition(":")
    return pick(load_module(source), name, text)


class Built(NamedTuple):
    """A model made for a command: the short name it was called by ("" if none), parameter values by path."""

    model: Any
    name: str
    parameters: dict[str, float | str]


def build_model(text: str, settings: Iterable[str]) -> Built:
    """Make the model that ``text`` names, with the structural parameters among ``settings``."""
    kind = find_model(text)
    structural, parameters = read_settings(kind, settings)
    return Built(kind(**structural), text if text in short_names() else "", parameters)


def short_names() -> Mapping[str, str]:
    """The models that ship with the package: short name to "package.module:Class"."""
    from arthur_acausal.models import REGISTRY

    return REGISTRY


def load_module(name: str) -> ModuleType:
    """Import a module by its name, also from the present folder."""
    if "" not in sys.path and str(Path.cwd()) not in sys.path:
        sys.path.insert(0, str(Path.cwd()))  # as `python -m` has it; a console script does not
    if not re.fullmatch(r"\w+(\.\w+)*", name):
        raise UsageError(f"{name!r} is no module", remedy=FORMS)
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name and (name == error.name or name.startswith(f"{error.name}.")):
            raise UsageError(f"there is no module {error.name!r}", remedy=FORMS) from error
        raise broken(name, error) from error
    except ArthurError:
        raise
    except (Exception, SystemExit) as error:
        raise broken(name, error) from error


def load_file(path: Path) -> ModuleType:
    """Import a Python file; its own folder is where it finds its neighbours."""
    if not path.is_file():
        raise UsageError(f"there is no file {path}", remedy=FORMS)
    folder = str(path.resolve().parent)
    FOLDERS.add(folder)
    if folder not in sys.path:
        sys.path.insert(0, folder)
    name = f"_file_{path.stem}"  # a file may be called like a library
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None and spec.loader is not None  # the name ends in .py
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses and typing look a class's module up there
    try:
        spec.loader.exec_module(module)
    except ArthurError:
        raise
    except (Exception, SystemExit) as error:
        raise broken(str(path), error) from error
    return module


def broken(source: str, error: BaseException) -> UsageError:
    """The error for a file or module that raises while it is imported."""
    if isinstance(error, SyntaxError):
        where = f"{Path(error.filename or source).name}:{error.lineno}"
        return UsageError(f"{source} is not valid Python", where=where, cause=error.msg)
    frame = traceback.extract_tb(error.__traceback__)[-1]
    cause = f"{type(error).__name__}: {error}"
    return UsageError(
        f"{source} cannot be imported", where=f"{Path(frame.filename).name}:{frame.lineno}", cause=cause
    )


def pick(module: ModuleType, name: str, text: str) -> type[Any]:
    """Return a model class of a module, by its name or because it is the only one."""
    models = own_models(module)
    if not name:
        if len(models) == 1:
            return next(iter(models.values()))
        which = f"it defines {', '.join(models)}" if models else "it defines no subclass of Component"
        raise UsageError(f"{text} does not say which model", cause=which, remedy=f"write {text}:Class")
    found = getattr(module, name, None)
    if found is None:
        hint = nearest(name, models) or (
            f"it defines {', '.join(models)}" if models else "it defines no model"
        )
        raise UsageError(f"{module.__name__} has no class {name!r}", remedy=hint)
    if not is_model(found):
        raise UsageError(
            f"{text} is no model",
            cause=f"{name} is {describe(found)}, not a subclass of Component",
            remedy=f"it defines {', '.join(models)}" if models else "",
        )
    return found  # type: ignore[no-any-return]


def own_models(module: ModuleType) -> dict[str, type[Any]]:
    """The model classes that a module defines itself, by name, in their order."""
    members = vars(module).items()
    return {n: v for n, v in members if is_model(v) and v.__module__ == module.__name__ and n == v.__name__}


def is_model(value: object) -> bool:
    """Whether a value is a class of models."""
    from arthur_acausal.declare.model import Component

    return inspect.isclass(value) and issubclass(value, Component) and value is not Component


def describe(value: object) -> str:
    """What a value is, in two words."""
    return "a class" if inspect.isclass(value) else f"a {type(value).__name__}"
