"""Networks given as data, so that tests can write the same one in many ways."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

from arthur_acausal import Component, Connector, Equations, connect
from arthur_acausal.components.hydraulic import Fluid, HydraulicPort
from arthur_acausal.components.translational import Flange
from tests.circuit import Pin


class PinJoint(Component):
    """A wire."""

    a = Pin()
    b = Pin()

    def equations(self) -> Equations:
        yield self.a.v == self.b.v
        yield self.b.i == -self.a.i


class FlangeJoint(Component):
    """A rigid joint."""

    a = Flange()
    b = Flange()

    def equations(self) -> Equations:
        yield self.b.s - self.a.s == 0
        yield 0 == self.a.f + self.b.f


class PortJoint(Component):
    """A wide, short pipe."""

    a = HydraulicPort()
    b = HydraulicPort()
    fluid: Fluid = Fluid()

    def equations(self) -> Equations:
        yield self.b.p == self.a.p
        yield self.a.q + self.b.q == 0


JOINTS: Mapping[type[Connector], type[Component]] = {
    Pin: PinJoint,
    Flange: FlangeJoint,
    HydraulicPort: PortJoint,
}


@dataclass(frozen=True)
class Recipe:
    """What a network is: parts, the connectors that meet, the variables to watch, the time to run [s]."""

    parts: Mapping[str, Callable[[], Component]]
    sets: Sequence[Sequence[str]]
    watched: Sequence[str]
    stop: float


@dataclass(frozen=True)
class Writing:
    """One way to write a recipe down."""

    parts: list[tuple[str, Callable[[], Component]]]
    links: list[tuple[str, str]]
    names: dict[str, str] = field(default_factory=dict)

    def path(self, watched: str) -> str:
        """Return where a watched variable of the recipe is now."""
        part, _, rest = watched.partition(".")
        return f"{self.names.get(part, part)}.{rest}"


class Net(Component):
    """The network that a writing says."""

    writing: Writing

    def build(self) -> None:
        for name, make in self.writing.parts:
            setattr(self, self.writing.names.get(name, name), make())

    def equations(self) -> Equations:
        for a, b in self.writing.links:
            yield connect(self.end(a), self.end(b))

    def end(self, path: str) -> Any:
        """Return a connector by its path in the recipe."""
        part, _, port = path.partition(".")
        return getattr(getattr(self, self.writing.names.get(part, part)), port)


def plain(recipe: Recipe) -> Writing:
    """Return the recipe as it stands: each set as a chain."""
    links = [(a, b) for ends in recipe.sets for a, b in pairwise(ends)]
    return Writing(list(recipe.parts.items()), links)


def shuffled(recipe: Recipe, seed: int) -> Writing:
    """Return the recipe with parts and connections in any order, any way around, and as any tree or loop."""
    rng = random.Random(seed)
    links: list[tuple[str, str]] = []
    for ends in recipe.sets:
        order = rng.sample(list(ends), len(ends))
        links += [(order[k], rng.choice(order[:k])) for k in range(1, len(order))]
        if len(order) > 2 and rng.random() < 0.5:
            links.append((order[0], order[-1]))
    links = [(a, b) if rng.random() < 0.5 else (b, a) for a, b in rng.sample(links, len(links))]
    return Writing(rng.sample(list(recipe.parts.items()), len(recipe.parts)), links)


def renamed(recipe: Recipe, seed: int) -> Writing:
    """Return the recipe with other names, whose order is another one, too."""
    rng = random.Random(seed)
    letters = rng.sample("abcdefghijklmnopqrstuvwxyz", len(recipe.parts))
    base = plain(recipe)
    names = dict(zip(recipe.parts, (f"{letter}_part" for letter in letters), strict=True))
    return Writing(base.parts, base.links, names)


def lengthened(recipe: Recipe, seed: int) -> Writing:
    """Return the recipe with up to three joints in each connection."""
    rng = random.Random(seed)
    base = plain(recipe)
    samples = {name: make() for name, make in recipe.parts.items()}
    parts, links = list(base.parts), []
    for a, b in base.links:
        name, _, port = a.partition(".")
        joint = JOINTS[type(getattr(type(samples[name]), port))]
        before = a
        for _ in range(rng.randrange(4)):
            number = f"joint_{len(parts)}"
            parts.append((number, joint))
            near, far = rng.sample(["a", "b"], 2)
            links.append((before, f"{number}.{near}"))
            before = f"{number}.{far}"
        links.append((before, b))
    return Writing(parts, links)


WAYS: Mapping[str, Callable[[Recipe, int], Writing]] = {
    "shuffled": shuffled,
    "renamed": renamed,
    "lengthened": lengthened,
}
