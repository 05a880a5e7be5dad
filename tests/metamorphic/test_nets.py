"""A network is the same however it is written: order, sides, names, joints and nominals change no trajectory."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import Component, Solution, start, translate
from arthur_acausal.components.hydraulic import LaminarPipe, Orifice, PressureSource, Ram, Volume
from arthur_acausal.components.translational import Fixed, Mass, SpringDamper
from tests.circuit import Capacitor, Ground, Inductor, Resistor, Voltage
from tests.metamorphic.net import WAYS, Net, Recipe, Writing, plain

RTOL = 1e-6


def electric(factor: float = 1.0) -> Recipe:
    """A ladder with a coil; ``factor`` times the nominals of its states."""
    return Recipe(
        {
            "source": lambda: Voltage(V=10.0),
            "coil": lambda: Inductor(L=0.3, i=start(0.0, fixed=True, nominal=factor)),
            "first": lambda: Resistor(R=1.0),
            "left": lambda: Capacitor(C=0.2, v=start(0.0, fixed=True, nominal=factor)),
            "second": lambda: Resistor(R=2.0),
            "right": lambda: Capacitor(C=0.5, v=start(1.0, fixed=True, nominal=factor)),
            "load": lambda: Resistor(R=8.0),
            "ground": Ground,
        },
        [
            ["source.p", "coil.p"],
            ["coil.n", "first.p"],
            ["first.n", "left.p", "second.p"],
            ["second.n", "right.p", "load.p"],
            ["source.n", "left.n", "right.n", "load.n", "ground.p"],
        ],
        ["coil.i", "left.v", "right.v", "load.i", "source.i", "first.p.v"],
        2.0,
    )


def hydraulic(factor: float = 1.0) -> Recipe:
    """A supply, an orifice, a volume, a pipe and a ram that moves a mass against a spring."""
    p = 1e7 * factor
    return Recipe(
        {
            "supply": lambda: PressureSource(p=100e5),
            "orifice": lambda: Orifice(area=2e-6),
            "volume": lambda: Volume(V=1e-4, p=start(10e5, fixed=True, nominal=p)),
            "pipe": lambda: LaminarPipe(L=2.0, d=0.004),
            "ram": lambda: Ram(area=1e-3, dead_volume=2e-5, p=start(10e5, fixed=True, nominal=p)),
            "load": lambda: Mass(
                m=200.0,
                s=start(0.0, fixed=True, nominal=factor),
                v=start(0.0, fixed=True, nominal=factor),
            ),
            "spring": lambda: SpringDamper(c=1e5, d=2e3),
            "wall": lambda: Fixed(s0=0.0),
        },
        [
            ["supply.port", "orifice.port_a"],
            ["orifice.port_b", "volume.port", "pipe.port_a"],
            ["pipe.port_b", "ram.port"],
            ["ram.rod", "load.flange", "spring.flange_a"],
            ["spring.flange_b", "wall.flange"],
        ],
        ["volume.p", "ram.p", "load.s", "load.v", "pipe.q", "ram.rod.f", "supply.port.q", "spring.f"],
        0.5,
    )


RECIPES = {"electric": electric, "hydraulic": hydraulic}


def solve(writing: Writing, stop: float, rtol: float = RTOL) -> Solution:
    """Translate and simulate a writing of a network."""
    return translate(Net(writing=writing), compile="never").simulate(stop, tolerance=rtol)


@cache
def reference(name: str) -> Solution:
    """The network as its recipe stands."""
    recipe = RECIPES[name]()
    return solve(plain(recipe), recipe.stop)


def deviation(name: str, found: Solution, writing: Writing) -> dict[str, float]:
    """The largest difference of each watched variable to the reference, over its range, in tolerances."""
    first = reference(name)
    assert found.t.tolist() == first.t.tolist()
    result = {}
    for path in RECIPES[name]().watched:
        a, b = first[path], found[writing.path(path)]
        result[path] = float(np.abs(a - b).max() / (RTOL * max(np.ptp(a), np.abs(a).max())))
    return result


def test_the_reference_itself_moves() -> None:
    for name, make in RECIPES.items():
        solution = reference(name)
        for path in make().watched:
            assert np.ptp(solution[path]) > 0.1 * np.abs(solution[path]).max(), path


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", RECIPES)
@settings(max_examples=5)
@given(seed=st.integers(0, 10**9))
def test_other_writings(name: str, way: str, seed: int) -> None:
    recipe = RECIPES[name]()
    writing = WAYS[way](recipe, seed)
    found = solve(writing, recipe.stop)
    assert max(deviation(name, found, writing).values()) < 10.0


@pytest.mark.parametrize("factor", [0.1, 10.0])
@pytest.mark.parametrize("name", RECIPES)
def test_nominals_changed_tenfold(name: str, factor: float) -> None:
    recipe = RECIPES[name](factor)
    writing = plain(recipe)
    found = solve(writing, recipe.stop)
    assert max(deviation(name, found, writing).values()) < 10.0


def test_a_change_of_the_network_itself_is_seen() -> None:
    recipe = electric()
    parts = {**recipe.parts, "load": lambda: Resistor(R=8.001)}
    changed = Recipe(parts, recipe.sets, recipe.watched, recipe.stop)
    found = solve(plain(changed), recipe.stop)
    assert max(deviation("electric", found, plain(changed)).values()) > 10.0, "the bound is no wide one"


def test_parts_are_made_anew_for_each_writing() -> None:
    parts: list[Component] = [make() for make in electric().parts.values()]
    assert len({id(part) for part in parts}) == len(parts)
