"""Equations are the same in any order, with any side left, under any name, and through any chain of aliases."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
from casadi import SX
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import (
    Component,
    Equations,
    Real,
    Solution,
    der,
    discrete,
    if_else,
    parameter,
    pre,
    reinit,
    translate,
    variable,
    when,
)

RTOL = 1e-7
Law = Callable[[Any], Any]


@dataclass(frozen=True)
class System:
    """Quantities by name (made anew each time), laws (lhs, rhs), other statements, and the time to run [s]."""

    quantities: Mapping[str, Callable[[], Any]]
    laws: Sequence[tuple[Law, Law]]
    statements: Sequence[Law]
    stop: float


PENDULUM = System(
    {
        "L": lambda: parameter("m", default=1.0),
        "g": lambda: parameter("m/s^2", default=9.81),
        "x": lambda: variable("m", start=0.8, fixed=True),
        "y": lambda: variable("m", start=-0.6),
        "v": lambda: variable("m/s", start=0.3, fixed=True),
        "w": lambda: variable("m/s"),
        "F": lambda: variable("1/s^2"),
    },
    [
        (lambda s: der(s.x), lambda s: s.v),
        (lambda s: der(s.y), lambda s: s.w),
        (lambda s: der(s.v), lambda s: -s.F * s.x),
        (lambda s: der(s.w) + s.g, lambda s: -s.F * s.y),
        (lambda s: s.x**2 + s.y**2, lambda s: s.L**2),
    ],
    [],
    1.2,
)

HOPPER = System(
    {
        "g": lambda: parameter("m/s^2", default=9.81),
        "c": lambda: parameter("1/s", default=0.2),
        "k": lambda: parameter("1/s^2", default=4000.0),
        "e": lambda: parameter("1", default=0.8),
        "h": lambda: variable("m", start=1.0, fixed=True),
        "v": lambda: variable("m/s", start=0.0, fixed=True),
        "a": lambda: variable("m/s^2"),
        "b": lambda: variable("m/s^2"),
        "E": lambda: variable("m^2/s^2"),
        "n": lambda: discrete("1"),
        "wall": lambda: parameter("m", default=0.9),
    },
    [
        (lambda s: der(s.h), lambda s: s.v),
        (lambda s: der(s.v), lambda s: s.a + s.b),
        (lambda s: s.a, lambda s: -s.g - s.c * s.v),
        (lambda s: s.b, lambda s: if_else(s.h > s.wall, -s.k * (s.h - s.wall), 0)),
        (lambda s: s.E, lambda s: s.g * s.h + s.v**2 / 2),
    ],
    [lambda s: when(s.h <= 0, reinit(s.plain("v"), -s.e * pre(s.plain("v"))), s.n == pre(s.n) + 1)],
    2.0,
)

SYSTEMS = {"pendulum": PENDULUM, "hopper": HOPPER}


class View:
    """What laws see of an instance: names of the system, each as one of its aliases by chance."""

    def __init__(
        self,
        model: Any,
        names: Mapping[str, str],
        aliases: Mapping[str, list[tuple[str, int]]],
        rng: random.Random,
    ) -> None:
        self._model, self._names, self._aliases, self._rng = model, names, aliases, rng

    def plain(self, name: str) -> SX:
        symbol: SX = getattr(self._model, self._names[name])
        return symbol

    def __getattr__(self, name: str) -> SX:
        chosen, sign = self._rng.choice([("", 1), *self._aliases.get(name, [])])
        return sign * getattr(self._model, chosen) if chosen else self.plain(name)


def written(
    system: System, seed: int, *, shuffle: bool = False, rename: bool = False, chain: int = 0
) -> tuple[Component, dict[str, str]]:
    """Return a component that says what the system says, and the names of the quantities in it."""
    rng = random.Random(seed)
    order = list(system.quantities)
    laws = [(a, b) for a, b in system.laws]
    statements: list[Law] = list(system.statements)
    if shuffle:
        rng.shuffle(order)
        laws = [(b, a) if rng.random() < 0.5 else (a, b) for a, b in rng.sample(laws, len(laws))]
    names = {n: n for n in order}
    if rename:
        names = dict(zip(order, rng.sample([f"q{k}" for k in range(99)], len(order)), strict=True))
    body: dict[str, Any] = {names[n]: system.quantities[n]() for n in order}
    aliases: dict[str, list[tuple[str, int]]] = {}
    for name in order:
        own: Real = body[names[name]]
        if own.kind == "variable":
            aliases[name] = [(f"{names[name]}_{k}", rng.choice([1, -1])) for k in range(chain)]
            body |= {alias: variable(own.unit) for alias, _ in aliases[name]}

    def equations(self: Any) -> Equations:
        view = View(self, names, aliases, random.Random(seed))
        for left, right in laws:
            yield left(view) == right(view)
        for statement in statements:
            yield statement(view)
        for name, chained in aliases.items():
            before, sign = names[name], 1
            for alias, total in chained:
                yield getattr(self, alias) == sign * total * getattr(self, before)
                before, sign = alias, total

    return type("Written", (Component,), body | {"equations": equations})(), names


def solve(system: System, seed: int = 0, **how: Any) -> tuple[Solution, dict[str, str]]:
    """Simulate a writing of the system; also return the names in it."""
    model, names = written(system, seed, **how)
    return translate(model, compile="never").simulate(system.stop, tolerance=RTOL), names


@cache
def reference(name: str) -> Solution:
    return solve(SYSTEMS[name])[0]


def compare(name: str, found: Solution, names: Mapping[str, str]) -> None:
    """Every variable at every time within ten tolerances of its range; at events, the same number of them."""
    first = reference(name)
    assert [e.kind for e in found.events] == [e.kind for e in first.events]
    for ours, theirs in zip(found.events, first.events, strict=True):
        assert ours.time == pytest.approx(theirs.time, abs=10 * RTOL)
    # at the times of the output grid: elsewhere what is no state is interpolated with fewer digits
    grid = np.linspace(0.0, SYSTEMS[name].stop, 501)[1:-1]
    events = np.array([e.time for e in first.events])
    if len(events):  # where a variable jumps, a time is left or right of it by chance
        grid = grid[np.abs(grid[:, None] - events).min(axis=1) > 1e-4]
    rows = [np.searchsorted(solution.t, grid - 1e-12) for solution in (first, found)]
    assert all((abs(s.t[r] - grid) < 1e-12).all() for s, r in zip((first, found), rows, strict=True))
    for path, quantity in SYSTEMS[name].quantities.items():
        if quantity().kind in ("variable", "discrete"):
            a, b = first[path][rows[0]], found[names[path]][rows[1]]
            assert np.abs(a - b).max() <= 10 * RTOL * max(np.ptp(a), np.abs(a).max()), path


WAYS: dict[str, dict[str, Any]] = {
    "shuffled": {"shuffle": True},
    "renamed": {"rename": True},
    "chains of aliases": {"chain": 3},
    "all of it": {"shuffle": True, "rename": True, "chain": 2},
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", SYSTEMS)
@settings(max_examples=4)
@given(seed=st.integers(0, 10**9))
def test_other_writings(name: str, way: str, seed: int) -> None:
    found, names = solve(SYSTEMS[name], seed, **WAYS[way])
    compare(name, found, names)


def test_the_reference_is_no_standstill() -> None:
    pendulum, hopper = reference("pendulum"), reference("hopper")
    assert np.ptp(pendulum["x"]) > 1.0
    assert np.abs(pendulum["x"] ** 2 + pendulum["y"] ** 2 - 1).max() < 1e-12
    assert hopper.final("n") >= 2
    assert hopper["b"].min() < -10.0, "it meets the upper wall"


def test_a_change_of_the_system_is_seen() -> None:
    changed = System(
        {**HOPPER.quantities, "g": lambda: parameter("m/s^2", default=9.8101)},
        *(HOPPER.laws, HOPPER.statements, HOPPER.stop),
    )
    found, names = solve(changed)
    with pytest.raises(AssertionError):
        compare("hopper", found, names)
