"""The computed course of all that the solver knows."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from arthur_acausal.solve.options import SolverOptions
from arthur_acausal.solve.protocol import FloatArray
from arthur_acausal.solve.statistics import Statistics

Status = Literal["finished", "terminated", "failed", "interrupted"]


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened at one instant.

    Attributes
    ----------
    time : s.
    what : in words.
    path : the component that it belongs to; empty for the model itself.
    kind : "state" or "time" (a relation changed), "when" (a clause acted) or "input" (a table jumps).
    where : file and line of the relation or clause.
    """

    time: float
    what: str
    path: str = ""
    kind: str = ""
    where: str = ""


@dataclass(frozen=True, slots=True)
class Trajectory:
    """Values at nt times. At an event two rows have the same time: before and after.

    Attributes
    ----------
    t : (nt,), s.
    y, yp : (nt, n), unknowns and their derivatives (zero for algebraic ones).
    u, z, m : (nt, .), inputs, discrete variables, truth values of the relations.
    p : parameters.
    status : "finished", "terminated" (by the model), "failed" or "interrupted".
    message : why it ended.
    """

    t: FloatArray
    y: FloatArray
    yp: FloatArray
    u: FloatArray
    z: FloatArray
    m: FloatArray
    p: FloatArray
    start_time: float
    stop_time: float
    options: SolverOptions
    events: list[Event] = field(default_factory=list)
    statistics: Statistics = field(default_factory=Statistics)
    status: Status = "finished"
    message: str = ""


class Recorder:
    """Collects rows in pieces; z and m are constant over a piece."""

    def __init__(self) -> None:
        self._pieces: list[tuple[FloatArray, ...]] = []

    def add(
        self, t: FloatArray, y: FloatArray, yp: FloatArray, u: FloatArray, z: FloatArray, m: FloatArray
    ) -> None:
        """Append rows: t (k,), y and yp (k, n), u (k, nu) or (nu,), z (nz,) and m (nm,). All are kept: pass copies."""
        self._pieces.append((t, y, yp, u, z, m))

    def columns(self) -> tuple[FloatArray, ...]:
        """t, y, yp, u, z, m of all rows."""
        pieces = self._pieces
        t, y, yp = (np.concatenate([piece[k] for piece in pieces]) for k in range(3))
        rows = [len(piece[0]) for piece in pieces]
        u = np.concatenate(
            [np.broadcast_to(p[3], (k, p[3].shape[-1])) for p, k in zip(pieces, rows, strict=True)]
        )
        z, m = (np.repeat([piece[k] for piece in pieces], rows, axis=0) for k in (4, 5))
        return t, y, yp, u, z, m
