"""`Solution`: every variable of a model over time."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import count, takewhile
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from arthur_acausal.errors import ResultError
from arthur_acausal.result.interpolate import FloatArray, Side, interpolate
from arthur_acausal.result.pattern import require, select
from arthur_acausal.result.run import Run, versions_here
from arthur_acausal.result.variable import Variable
from arthur_acausal.solve.trajectory import Event

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

    from arthur_acausal.result.chain import Piece
    from arthur_acausal.result.energy import Energy
    from arthur_acausal.result.panel import Wanted
    from arthur_acausal.result.power import PowerBalance, Powers


AT_ONCE = 4_000_000  # values that may be computed beside those that are asked for: 32 MB


class Values(Protocol):
    """Where a solution's values come from: a trajectory and its model, or a file."""

    @property
    def t(self) -> FloatArray:
        """Times (nt,), s, ascending; an event's time stands twice."""
        ...

    @property
    def variables(self) -> Mapping[str, Variable]:
        """All variables by path, in the model's order."""
        ...

    @property
    def modes(self) -> FloatArray:
        """Truth values (nt, number of relations), 0 or 1, of the relations that make events."""
        ...

    def observe(self, paths: Sequence[str]) -> FloatArray:
        """Values (nt, len(paths)) in SI."""
        ...

    def slope(self, state: str) -> FloatArray | None:
        """Time derivative (nt,) of a state, or None where it is not known."""
        ...


class Solution:
    """What a simulation computed: ``solution["load.flange.s"]`` is an array over ``solution.t``, in SI.

    Every variable of the model is there, also those that were eliminated, parameters and discrete ones; each
    is computed when it is first asked for. At an event two rows have the same time: before it and after it.

    Attributes
    ----------
    t : times (nt,), s.
    run : how the solution came about; its parts are also `model`, `events`, `statistics`, `parameters`,
        `options`, `message`.
    """

    def __init__(self, values: Values, run: Run | None = None) -> None:
        self._values = values
        self._columns: dict[str, FloatArray] = {}
        self.run = run if run is not None else Run()
        self.t: FloatArray = values.t
        self.powers: Powers | None = None

    # --- what there is

    @property
    def paths(self) -> list[str]:
        """Paths of all variables, in the model's order."""
        return list(self._values.variables)

    @property
    def variables(self) -> Mapping[str, Variable]:
        """Unit, kind and description of each variable, by path."""
        return self._values.variables

    def variable(self, path: str) -> Variable:
        """What is known of one variable. Raises ResultError, with the nearest paths, where there is none."""
        return self.variables[require(path, self.variables)]

    def unit(self, path: str) -> str:
        """SI unit of a variable."""
        return self.variable(path).unit

    def description(self, path: str) -> str:
        """One line about a variable, or an empty string."""
        return self.variable(path).description

    def select(self, patterns: str | Iterable[str]) -> list[str]:
        """Paths by patterns such as ``valves[*].I``: ``**`` reaches over dots, brackets are literal."""
        return select(patterns, self.paths)

    # --- values

    def __getitem__(self, path: str) -> FloatArray:
        """Values (nt,) of a variable, or (nt, n) of a vector of n."""
        if path not in self._columns:
            if path not in self.variables and f"{path}[0]" in self.variables:
                return self.values(self._elements(path))
            self._fetch([require(path, self.variables)])
        return self._columns[path]

    def _elements(self, vector: str) -> list[str]:
        every = (f"{vector}[{k}]" for k in count())
        return list(takewhile(self.variables.__contains__, every))

    def __contains__(self, path: object) -> bool:
        return path in self.variables

    def values(self, paths: Sequence[str]) -> FloatArray:
        """Values (nt, len(paths)) of several variables at once, which is faster than one by one."""
        missing = [require(path, self.variables) for path in paths if path not in self._columns]
        if missing:
            self._fetch(missing)
        block = np.empty((self.t.size, len(paths)))
        for index, path in enumerate(paths):
            block[:, index] = self._columns[path]
        return block

    def ends(self, paths: Sequence[str]) -> FloatArray:
        """Values (2, len(paths)) at the first and the last time, where nothing is computed for those in between."""
        ends: Callable[[Sequence[str]], FloatArray] | None = getattr(self._values, "ends", None)
        return self.values(paths)[[0, -1]] if ends is None else ends(paths)

    def _fetch(self, paths: list[str]) -> None:
        wanted = list(dict.fromkeys([*paths, *self._companions(paths)]))
        block = self._values.observe(wanted)
        for index, path in enumerate(wanted):
            column = np.array(block[:, index], dtype=np.float64)
            column.flags.writeable = False  # it is handed out again and again
            self._columns[path] = column

    def _companions(self, paths: list[str]) -> list[str]:
        """Return what costs nothing beside these: one eliminated variable is computed together with all."""
        eliminated = [v for v in map(self.variables.__getitem__, paths) if v.kind == "eliminated"]
        if not eliminated:
            return []
        refined = any(v.refined for v in eliminated)
        others = [
            v.path
            for v in self.variables.values()
            if v.kind == "eliminated" and v.path not in self._columns and refined >= v.refined
        ]
        return others if len(others) * self.t.size <= AT_ONCE else []

    def at(self, time: ArrayLike, path: str, side: Side = "right") -> FloatArray:
        """Values at any times within the solution, shape of ``time``.

        States and their aliases by cubic Hermite interpolation; discrete variables hold; others are linear.
        At the time of an event: what was before it (``side="left"``) or after it.
        """
        tau = np.asarray(time, dtype=np.float64)
        held = self.variable(path).held
        return interpolate(self.t, self[path], tau, slope=self.slope(path), held=held, side=side)

    def slope(self, path: str) -> FloatArray | None:
        """Time derivative (nt,) of a state or an alias of one, None for all others."""
        variable = self.variable(path)
        slope = self._values.slope(variable.state) if variable.state else None
        return None if slope is None else variable.sign * slope

    def initial(self, path: str) -> float:
        """Value at the start, before any event."""
        return float(self[path][0])

    def final(self, path: str) -> float:
        """Value at the end."""
        return float(self[path][-1])

    def final_values(self, patterns: str | Iterable[str] = "**") -> dict[str, float]:
        """Values at the end of all variables that the patterns choose."""
        paths = self.select(patterns)
        return dict(zip(paths, self.values(paths)[-1].tolist(), strict=True))

    # --- how it came about

    @property
    def model(self) -> str:
        """Name of the model."""
        return self.run.model

    @property
    def message(self) -> str:
        """Why the run ended."""
        return self.run.message

    @property
    def events(self) -> tuple[Event, ...]:
        """What happened, in order of time."""
        return self.run.events

    @property
    def statistics(self) -> Any:
        """Counts of steps and evaluations, and wall times, of the run."""
        return self.run.statistics

    @property
    def parameters(self) -> Mapping[str, Any]:
        """What was set for this run, by path."""
        return self.run.parameters

    @property
    def options(self) -> Any:
        """Options of the solver."""
        return self.run.options

    @property
    def pieces(self) -> Sequence[Piece]:
        """The run's trajectories and the compiled systems that they belong to; none where it was read from a file."""
        found: Sequence[Piece] = getattr(self._values, "pieces", ())
        return found

    @property
    def versions(self) -> Mapping[str, str]:
        """Versions of the software that computed it."""
        return self.run.versions or versions_here()

    @property
    def modes(self) -> FloatArray:
        """Truth values (nt, number of relations), 0 or 1, of the relations that make events."""
        return self._values.modes

    def __repr__(self) -> str:
        name = self.run.model or "model"
        span = f"{self.t[0]:g} to {self.t[-1]:g} s" if self.t.size else "empty"
        counts = f"{self.t.size} times, {len(self.variables)} variables, {len(self.events)} events"
        status = "" if self.run.status == "finished" else f", {self.run.status}: {self.run.message}"
        return f"<Solution of {name}: {span}, {counts}{status}>"

    # --- views, files, pictures: each in its own module, imported when used

    def to_xarray(self, patterns: str | Iterable[str] | None = None) -> xarray.Dataset:
        """An xarray Dataset over ``time`` with units; all variables, or those that the patterns choose."""
        from arthur_acausal.result.views import to_xarray

        return to_xarray(self, patterns)

    def to_pandas(self, patterns: str | Iterable[str] | None = None) -> pandas.DataFrame:
        """A pandas DataFrame over ``time``; all that varies in time, or what the patterns choose."""
        from arthur_acausal.result.views import to_pandas

        return to_pandas(self, patterns)

    def save(self, file: str | os.PathLike[str]) -> None:
        """Write everything to a NetCDF file; what stood there stays whole until the new file is."""
        from arthur_acausal.result.store import save

        save(self, file)

    @classmethod
    def load(cls, file: str | os.PathLike[str]) -> Solution:
        """Read a solution that `save` wrote; the model is not needed."""
        from arthur_acausal.result.stored import load

        return load(file)

    def plot(self, wanted: Wanted, file: str | os.PathLike[str] | None = None) -> Figure:
        """Draw variables over time, and write the picture where a file is given (png, pdf or svg).

        Parameters
        ----------
        wanted : patterns, which give one panel for each unit; or panels, from the text at their axis with the
            unit to patterns or labelled paths: ``{"pressure [bar]": {"supply": "manifold.p"}}``.

        Raises ResultError or UnitError where that cannot be drawn, ResultError where the file cannot be written.
        """
        from arthur_acausal.result.plot import plot

        return plot(self, wanted, file)

    def power(self, path: str) -> FloatArray:
        """Power (nt,) [W] that enters a component by its connector ``path``: "valve.port_a", for instance."""
        return self._powers().power(path, self.t, self.__getitem__)

    def power_balance(self, component: str = "") -> PowerBalance:
        """The powers that enter a component by all of its connectors; their sum is what it stores or turns to heat."""
        return self._powers().balance(component, self.t, self.__getitem__)

    def _powers(self) -> Powers:
        if self.powers is None:
            raise ResultError(
                "this solution does not know its model's connectors: it was read from a file",
                remedy="give it the model that it is of: translate(model).adopt(solution), or simulate anew",
            )
        return self.powers

    def energy(self) -> Energy:
        """The model's energy audit. Raises ResultError where the model has none."""
        from arthur_acausal.result.energy import audit

        if not self.run.audit:
            raise ResultError(f"{self.run.model or 'this model'} has no energy audit")
        return audit(self)
