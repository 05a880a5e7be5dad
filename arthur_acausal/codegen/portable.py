"""A compiled system as bytes: what a worker elsewhere needs to run it, neither the model's source nor a compiler.

A ZIP archive of JSON, arrays, CasADi's own serialisation of functions, and machine code for the platform that it was
made on. Nothing is pickled. It holds code, so it is to be exchanged between the processes of one user only, never
taken from strangers.
"""

from __future__ import annotations

import hashlib
import importlib
import io
import json
import math
import types
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import partial
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from arthur_acausal.codegen import calls, compiled, origins, parameters, recovery, tables
from arthur_acausal.codegen.cache import Cache, default_cache, make_key
from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.kernel import load_library
from arthur_acausal.errors import UsageError
from arthur_acausal.transform import state_sets

# The only classes that an archive may name.
_CLASSES: dict[str, type[Any]] = {
    kind.__name__: kind
    for module in (calls, compiled, tables, origins, parameters, recovery, state_sets)
    for kind in vars(module).values()
    if isinstance(kind, type) and is_dataclass(kind)
}
_OWN = "arthur_acausal"
_EPOCH = (1980, 1, 1, 0, 0, 0)


def to_bytes(dae: CompiledDAE, plain: CompiledDAE) -> bytes:
    """Return a compiled system as bytes, the same for the same system.

    ``plain`` is the same system as CasADi expressions. Raises UsageError for a sampled or external function that
    cannot be named for another process.
    """
    writer = _Writer()
    tree = writer.encode(plain)
    libraries: dict[str, list[str]] = {}
    for name, function in dae.functions.items():
        library = getattr(function, "library", None)
        if library is not None:
            libraries.setdefault(str(library), []).append(name)
    contents = {path: Path(path).read_bytes() for path in libraries}
    index = {
        "platform": make_key(),
        "system": tree,
        "libraries": {hashlib.sha256(contents[path]).hexdigest(): names for path, names in libraries.items()},
    }
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:

        def add(name: str, content: bytes) -> None:
            archive.writestr(zipfile.ZipInfo(name, _EPOCH), content, zipfile.ZIP_DEFLATED, 1)

        add("index.json", json.dumps(index).encode())
        for k, text in enumerate(writer.functions):
            add(f"functions/{k}", text.encode())
        for k, array in enumerate(writer.arrays):
            stream = io.BytesIO()
            np.save(stream, array, allow_pickle=False)
            add(f"arrays/{k}", stream.getvalue())
        for content in contents.values():
            add(f"libraries/{hashlib.sha256(content).hexdigest()}", content)
    return buffer.getvalue()


def from_bytes(data: bytes, cache: Cache | None = None, trusted: tuple[str, ...] = ()) -> CompiledDAE:
    """Return the system again; its machine code too, where the platform and the versions are the same.

    ``trusted``: modules besides this package that functions may be imported from.
    """
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        index = json.loads(archive.read("index.json"))
        reader = _Reader(archive, trusted)
        dae: CompiledDAE = reader.decode(index["system"])
        if index["platform"] != make_key():
            return dae
        for digest, names in index["libraries"].items():
            content = archive.read(f"libraries/{digest}")
            path = (cache or default_cache()).path_of_library(
                make_key("portable", digest), partial(_write, content)
            )
            for name in names:
                dae.functions[name] = load_library(name, path)
    return dae


def _write(content: bytes, path: Path) -> None:
    path.write_bytes(content)


class _Writer:
    """Turns values into JSON, and keeps arrays and functions aside."""

    def __init__(self) -> None:
        self.arrays: list[Any] = []
        self.functions: list[str] = []

    def encode(self, value: Any) -> Any:
        """Return the JSON of a value: itself, or a list that starts with what it is."""
        if isinstance(value, float) and not isinstance(value, np.floating):
            return value if math.isfinite(value) else ["float", repr(value)]
        if value is None or isinstance(value, bool | int | str):
            return value
        if isinstance(value, np.generic):
            return self.encode(value.item())
        if isinstance(value, ca.Function):
            self.functions.append(value.serialize())
            return ["function", len(self.functions) - 1]
        if isinstance(value, np.ndarray):
            self.arrays.append(value)
            return ["array", len(self.arrays) - 1]
        if isinstance(value, Mapping):
            return ["dict", [[self.encode(k), self.encode(v)] for k, v in value.items()]]
        if isinstance(value, list | tuple):
            return [type(value).__name__, [self.encode(v) for v in value]]
        if isinstance(value, frozenset):
            return ["frozenset", sorted(value)]
        if type(value).__name__ in _CLASSES and is_dataclass(value):
            content = {f.name: self.encode(getattr(value, f.name)) for f in fields(value)}
            return ["object", type(value).__name__, content]
        return ["reference", *reference(value)]


class _Reader:
    def __init__(self, archive: zipfile.ZipFile, trusted: tuple[str, ...]) -> None:
        self._archive, self._trusted = archive, trusted

    def decode(self, value: Any) -> Any:
        if not isinstance(value, list):
            return value
        match value:
            case ["float", text]:
                return float(text)
            case ["function", number]:
                return ca.Function.deserialize(self._archive.read(f"functions/{number:d}").decode())
            case ["array", number]:
                return np.load(io.BytesIO(self._archive.read(f"arrays/{number:d}")), allow_pickle=False)
            case ["dict", pairs]:
                return {self.decode(k): self.decode(v) for k, v in pairs}
            case ["list", entries]:
                return [self.decode(v) for v in entries]
            case ["tuple", entries]:
                return tuple(self.decode(v) for v in entries)
            case ["frozenset", entries]:
                return frozenset(entries)
            case ["object", name, content]:
                return _CLASSES[name](**{k: self.decode(v) for k, v in content.items()})
            case ["reference", name, data]:
                return restore(name, data, self._trusted)
        raise UsageError(f"the archive holds {value[0]!r}, which is not of the format")


def reference(function: Any) -> tuple[str, Any]:
    """Return what another process finds a function by: "module:name", and the JSON data of ``describe()``, or None.

    An object whose class has ``describe()`` (JSON data) and a class method ``restore(data)`` is named by its class.
    Raises UsageError for what only exists in this process: a lambda, a nested function, an object without these.
    """
    describe: Callable[[], Any] | None = getattr(function, "describe", None)
    named = type(function) if describe is not None else function
    name = getattr(named, "__qualname__", "")
    module = getattr(named, "__module__", "")
    if describe is None and not isinstance(function, types.FunctionType | types.BuiltinFunctionType):
        name = ""
    if not name or "<" in name or module in ("__main__", ""):
        raise UsageError(
            f"{function!r} cannot be found by another process",
            cause="it has no name in a module",
            remedy="define it at the top of a module, or give its class describe() and restore(data)",
        )
    return f"{module}:{name}", describe() if describe is not None else None


def restore(name: str, data: Any, trusted: tuple[str, ...] = ()) -> Any:
    """Return the function that `reference` named, out of this package or the ``trusted`` modules only."""
    module, _, attributes = name.partition(":")
    if module != _OWN and not module.startswith(f"{_OWN}.") and module not in trusted:
        raise UsageError(f"{name} is not imported", cause=f"{module} is no module of the model's")
    found: Any = importlib.import_module(module)
    for attribute in attributes.split("."):
        found = getattr(found, attribute)
    return found if data is None else found.restore(data)
