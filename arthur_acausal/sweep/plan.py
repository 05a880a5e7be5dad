"""From a specification to what each run needs: models translated once for each structure, values in SI."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.sweep import derived
from arthur_acausal.sweep.design import Run, runs
from arthur_acausal.sweep.factor import Value, inside
from arthur_acausal.sweep.job import Job, Signal, Values
from arthur_acausal.sweep.prepare import job_of
from arthur_acausal.sweep.specification import Specification
from arthur_acausal.sweep.task import Task
from arthur_acausal.units import to_si

if TYPE_CHECKING:
    from arthur_acausal.api import Translation

WORTH_COMPILING = 20  # runs

Structure = tuple[str, tuple[tuple[str, str], ...]]  # a model's name and its structural parameters as text


@dataclass
class Plan:
    """All runs of a specification.

    Attributes
    ----------
    specification, folder : what was asked for, and where its files stand.
    find : name of a model -> its class.
    chosen : runs in place of those of the specification's design, where a search asks for them one by one.
    """

    specification: Specification
    folder: Path
    find: Callable[[str], type[Any]]
    chosen: Sequence[Run] = ()
    _structures: dict[Structure, _Prepared] = field(default_factory=dict)
    _names: dict[str, set[str]] = field(default_factory=dict)
    _parts: dict[Structure, Mapping[str, type[Any]]] = field(default_factory=dict)

    @cached_property
    def runs(self) -> list[Run]:
        """Every run with what varies, in order."""
        return list(self.chosen) or runs(self.specification, self.folder)

    @property
    def factors(self) -> list[str]:
        """Columns of the table that say what a run is."""
        names = list(self.specification.vary)
        if self.specification.replicates.parameter:
            names.append(self.specification.replicates.parameter)
        return (["model"] if len(self.specification.models) > 1 else []) + list(dict.fromkeys(names))

    def prepared(self, run: Run) -> _Prepared:
        """Return the structure that a run belongs to, translated when it is first asked for."""
        key = self._structure(run)
        if key not in self._structures:
            self._structures[key] = _prepare(self, run.model, dict(key[1]))
        return self._structures[key]

    def task(self, run: Run) -> tuple[Task, dict[str, float | str]]:
        """Return a run's task, and its columns of the table: what varies and what is derived, in SI.

        Raises ArthurError where the values do not fit the model.
        """
        prepared = self.prepared(run)
        found = self._values(prepared, run)
        return Task(run.number, prepared.job, found.values, prepared.translation.to_bytes), found.columns

    def _structure(self, run: Run) -> Structure:
        given = {**self.specification.set, **run.values}
        names = self._structural_names(run.model)
        own = {path: _text(value) for path, value in given.items() if path in names}
        parts = self._structural_parts((run.model, tuple(sorted(own.items()))), given)
        of_parts = {path: _text(value) for path, value in given.items() if path in parts}
        return run.model, tuple(sorted({**own, **of_parts}.items()))

    def _structural_parts(self, own: Structure, paths: Iterable[str]) -> Mapping[str, type[Any]]:
        """Return the structural parameters of parts, for given ones of the model itself."""
        from arthur_acausal.request.settings import structural_parts

        if own not in self._parts:
            self._parts[own] = structural_parts(self._built(own), paths)
        return self._parts[own]

    def _built(self, own: Structure) -> Any:
        """Return an instance of a model with structural parameters of its own."""
        from arthur_acausal.request.settings import read_settings

        kind = self.find(own[0])
        return kind(**read_settings(kind, [f"{path}={text}" for path, text in own[1]]).structural)

    def _structural_names(self, model: str) -> set[str]:
        from arthur_acausal.request.settings import required_parameters, structural_parameters

        if model not in self._names:
            kind = self.find(model)
            self._names[model] = {*structural_parameters(kind), *required_parameters(kind)}
        return self._names[model]

    def _values(self, prepared: _Prepared, run: Run) -> _Found:
        """Sort a run's values into parameters, inputs and start values."""
        found = _Found()
        if len(self.specification.models) > 1:
            found.columns["model"] = run.model
        for path, value in run.values.items():
            prepared.place(path, value, found, self.folder)
        known: dict[str, float] = {}
        if self.specification.derive:
            known = {p: v for p, v in found.columns.items() if isinstance(v, float)} | dict(prepared.fixed)
        for path, expression in self.specification.derive.items():
            value = derived.compute(expression, known)
            known[path] = value
            prepared.place(path, value, found, self.folder)
        return found


@dataclass
class _Found:
    columns: dict[str, float | str] = field(default_factory=dict)
    parameters: dict[str, float] = field(default_factory=dict)
    inputs: dict[str, float | Signal] = field(default_factory=dict)
    start: dict[str, float] = field(default_factory=dict)

    @property
    def values(self) -> Values:
        return Values(self.parameters, self.inputs, self.start)


@dataclass(frozen=True)
class _Prepared:
    """One structure: its translation, the job of its runs, its structural parameters, and fixed values in SI."""

    translation: Translation
    job: Job
    structural: Mapping[str, str]
    fixed: Mapping[str, float]

    def place(self, path: str, value: Value, found: _Found, folder: Path) -> None:
        """Put a value where it belongs: the model decides what a path is."""
        if path in self.structural:
            found.columns[path] = value
            return
        _place(self.translation, path, value, found, folder)


def _place(translation: Translation, path: str, value: Value, found: _Found, folder: Path) -> None:
    dae = translation.dae
    table = dae.parameters
    if path in table.number or path in table.alias:
        info = table.infos[table.find(path)]
        number = to_si(value, info.unit, path=path)
        found.parameters[path] = number
        found.columns[path] = number
    elif path in dae.u_paths:
        unit = dae.u_units[dae.u_paths.index(path)]
        if isinstance(value, str) and (signal := _signal(value, folder)) is not None:
            found.inputs[path] = signal
            found.columns[path] = value
        else:
            number = to_si(value, unit, path=path)
            found.inputs[path] = number
            found.columns[path] = number
    elif path in dae.start_aliases:
        entry = dae.starts[dae.start_aliases[path][0]]
        number = to_si(value, entry.unit, path=path)
        found.start[path] = number
        found.columns[path] = number
    else:
        known = [*table.number, *table.alias, *dae.u_paths, *dae.start_aliases]
        raise UsageError(
            f"{path} is no parameter, input or start value of {translation.dae.name}",
            remedy=nearest(path, known),
        )


def _signal(text: str, folder: Path) -> Signal | None:
    """Return the signal of ``file.csv`` or ``file.csv:column``; None for what is no CSV file."""
    from arthur_acausal.solve.table import Table

    name, colon, column = text.rpartition(":")
    if not colon:
        name, column = text, ""
    if not name.lower().endswith(".csv"):
        return None
    table = Table.from_csv(inside(name, folder), column=column or None)
    return Signal(tuple(table.times.tolist()), tuple(table.values.tolist()), text)


def _prepare(plan: Plan, model: str, structural: Mapping[str, str]) -> _Prepared:
    """Translate one structure, and settle what all its runs share."""
    from arthur_acausal.api import translate
    from arthur_acausal.request.settings import convert

    specification, names = plan.specification, plan._structural_names(model)
    own: Structure = model, tuple((path, text) for path, text in structural.items() if path in names)
    parts = plan._structural_parts(own, structural)
    built = plan._built(own)
    translation = translate(
        built,
        name=model if ":" not in model else "",
        compile=_mode(plan),
        structural={
            path: convert(kind, path.rpartition(".")[2], structural[path])
            for path, kind in parts.items()
            if path in structural
        },
    )
    found = _Found()
    for section in (specification.set, specification.inputs, specification.start):
        for path, value in section.items():
            if path not in structural:
                _place(translation, path, _number(value), found, plan.folder)
    numbers = {p: v for p, v in found.columns.items() if isinstance(v, float)}
    job = job_of(specification, translation, found.values)
    return _Prepared(translation, job, structural, numbers)


def _mode(plan: Plan) -> str:
    """Compile also what is too small for it to pay in a single run."""
    from arthur_acausal.codegen.kernel import compiler

    many = bool(plan.chosen) or len(plan.runs) >= WORTH_COMPILING
    return "often" if many and compiler() is not None else "auto"


def _text(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float) and value.is_integer():
        return str(int(value))
    return str(value)


def _number(value: float | str | bool) -> Value:
    return float(value) if isinstance(value, bool | int | float) else value
