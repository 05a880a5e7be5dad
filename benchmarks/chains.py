"""Families of the scalable test suite (F. Casella, Politecnico di Milano, BSD-3): systems of any size."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from arthur_acausal import (
    Component,
    Equations,
    Real,
    SolverOptions,
    connect,
    der,
    discrete,
    parameter,
    start,
    translate,
    variable,
    when,
)
from arthur_acausal.components.blocks import Constant, FirstOrder
from arthur_acausal.components.translational import Fixed, Mass, Spring

TIGHT = SolverOptions(rtol=1e-9, intervals=20)


class Cascade(Component):
    """N first-order lags in a row, each of T / N, behind a unit step."""

    N: int
    T: Real = parameter("s", default=1.0)

    def build(self) -> None:
        self.source = Constant(k=1.0)
        self.lags = [FirstOrder(T=self.T / self.N) for _ in range(self.N)]

    def equations(self) -> Equations:
        signal = self.source.y
        for lag in self.lags:
            yield connect(signal, lag.u)
            signal = lag.y


class Oscillator(Component):
    """N masses in a row; ``network``: through massless nodes with springs of their own, between two walls."""

    N: int
    network: bool = False
    m: Real = parameter("kg", default=1.0)
    c: Real = parameter("N/m", default=10.0)

    def build(self) -> None:
        at_rest = [float(self.N)] + [0.0] * (self.N - 1)
        self.masses = [Mass(m=self.m, s=start(s, fixed=True), v=start(0.0, fixed=True)) for s in at_rest]
        between = self.N + 1 if self.network else self.N - 1
        self.springs = [Spring(c=self.c) for _ in range(between)]
        if self.network:
            self.links = [Spring(c=self.c) for _ in range(self.N)]
            self.walls = [Fixed() for _ in range(2)]

    def equations(self) -> Equations:
        if not self.network:
            for spring, a, b in zip(self.springs, self.masses[:-1], self.masses[1:], strict=True):
                yield connect(a.flange, spring.flange_a)
                yield connect(spring.flange_b, b.flange)
            return
        for k, (mass, link) in enumerate(zip(self.masses, self.links, strict=True)):
            yield connect(mass.flange, link.flange_a)
            yield connect(link.flange_b, self.springs[k].flange_b)
            yield connect(link.flange_b, self.springs[k + 1].flange_a)
        yield connect(self.walls[0].flange, self.springs[0].flange_a)
        yield connect(self.walls[1].flange, self.springs[-1].flange_b)


class ManyEvents(Component):
    """N integrators, x[i]' = M / (N + 1 - i); each sets its flag where it passes 1."""

    N: int
    M: int

    def build(self) -> None:
        self.parts = [Counting(rate=self.M / (self.N - i)) for i in range(self.N)]


class Counting(Component):
    """x' = rate; ``passed`` becomes 1 where x passes 1."""

    rate: Real = parameter("1/s")
    x: Real = variable("1", start=0.0, fixed=True)
    passed: Real = discrete()

    def equations(self) -> Equations:
        yield der(self.x) == self.rate
        yield when(self.x > 1.0, self.passed == 1.0)


def cascaded_first_order(case: Mapping[str, Any], folder: Path) -> tuple[float, str]:
    """Solve the cascade of each size; the largest absolute error of a reference value."""
    worst, where = 0.0, ""
    for size, moments in case["reference"]["values"].items():
        translation = translate(Cascade(N=int(size)))
        for moment, values in moments.items():
            solution = translation.simulate(float(moment.partition("=")[2]), options=TIGHT)
            for name, value in values.items():
                error = abs(solution.final(f"lags[{_index(name) - 1}].y") - value)
                if error > worst:
                    worst, where = error, f"worst: N = {size}, {moment}, {name}"
    return worst, where


def harmonic_oscillator(case: Mapping[str, Any], folder: Path) -> tuple[float, str]:
    """Solve chains and networks of masses; the largest error relative to a case's largest value."""
    worst, where = 0.0, ""
    for title, values in case["reference"]["values"].items():
        size = int(title.partition("N=")[2])
        translation = translate(Oscillator(N=size, network="Network" in title))
        solution = translation.simulate(float(case["t_end"]), options=TIGHT)
        largest = max(abs(v) for v in values.values())
        for name, value in values.items():
            error = abs(solution.final(f"masses[{_index(name) - 1}].s") - value) / largest
            if error > worst:
                worst, where = error, f"worst: {title}, {name}"
    return worst, where


def many_events(case: Mapping[str, Any], folder: Path) -> tuple[float, str]:
    """Solve the integrators for N = 1000 and two M; the largest error of an event's time [s], all counted."""
    worst, where = 0.0, ""
    for n, m in ((1000, 10), (1000, 100)):
        solution = translate(ManyEvents(N=n, M=m)).simulate(1.0, options=SolverOptions(intervals=10))
        times = sorted(e.time for e in solution.events if e.kind == "when")
        expected = [k / m for k in range(1, m)]
        if len(times) != len(expected):
            return 1.0, f"N = {n}, M = {m}: {len(times)} events of {len(expected)}"
        error = max(abs(a - b) for a, b in zip(times, expected, strict=True))
        if error >= worst:
            worst, where = error, f"worst: N = {n}, M = {m}"
    return worst, where


def _index(name: str) -> int:
    """Return i of ``x[i](t)``."""
    found = re.search(r"\[(\d+)\]", name)
    assert found is not None, name
    return int(found[1])
