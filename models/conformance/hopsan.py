"""Cases of Hopsan: a model of library components, connected as the case says, whatever is in it."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from arthur_acausal import Component, Equations, UsageError, connect
from arthur_acausal.components.blocks import Gain
from arthur_acausal.components.hydraulic import FlowSensor
from arthur_acausal.models.conformance.hopsan_given import Given, fluid, number
from arthur_acausal.models.conformance.hopsan_table import (
    FLOW_SENSOR,
    NOTES,
    SCALES,
    SINKS,
    TABLE,
    Counterpart,
)

QUANTITIES = {"Pressure": "p", "Flow": "q", "Position": "s", "Angle": "phi"}
"""Quantities of a node of Hopsan -> of our connectors."""
OUTPUTS = frozenset({"out", "y", "xv", "Va", "pa"})
"""Names of output variables; all other variables take signals in."""
MEASURED = {
    "FlowSensor": "Flow",
    "PressureSensor": "Pressure",
    "PositionSensor": "Position",
    "SpeedSensor": "Velocity",
}
"""Sensors -> what they measure."""
STARTS = ("Pressure", "Position", "Velocity", "Angle", "AngularVelocity")

End = tuple[str, str]
"""Component and port, or component and variable."""


@dataclass(eq=False)
class Plan:
    """What an assembly consists of: parts by name, and pairs of ``(part, connector or signal)`` to be connected."""

    parts: dict[str, Callable[[], Component]] = field(default_factory=dict)
    joins: list[tuple[End, End]] = field(default_factory=list)


class Assembly(Component):
    """The components and connections of a plan."""

    plan: Any

    def build(self) -> None:
        for name, make in self.plan.parts.items():
            setattr(self, name, make())

    def equations(self) -> Equations:
        for (one, a), (other, b) in self.plan.joins:
            yield connect(getattr(getattr(self, one), a), getattr(getattr(self, other), b))


def own_name(name: str) -> str:
    """Return the name of a part for the name of a component of Hopsan."""
    return "c_" + re.sub(r"\W", "_", name)


class Reader:
    """Reads one case; ``plan`` is the model that it describes."""

    def __init__(self, case: Mapping[str, Any]) -> None:
        self.types: dict[str, str] = {c["name"]: c["type"] for c in case["components"]}
        self.values: dict[str, dict[str, Any]] = {
            c["name"]: {k: v["value"] for k, v in c["parameters"].items()} for c in case["components"]
        }
        self.step = number(case["simulation"]["timestep"], "the time step")
        self.fluid = fluid()
        self.plan = Plan()
        links = [(self.end(a), self.end(b)) for a, b in case["connections"]]
        power = [link for link in links if all(self.is_power(e) for e in link)]
        signals = [
            link
            for link in links
            if link not in power and not any(self.types[name] in SINKS for name, _ in link)
        ]
        self.signal_ends = {end for link in signals for end in link}
        self.nodes = list(nodes_of(power))
        self.flow_sensors = self.places_of_flow_sensors(power)
        self.add_parts()
        for node in self.nodes:
            self.join_node(node)
        for link in signals:
            self.join_signal(*link)

    def end(self, text: str) -> End:
        """Return component and port of ``component.port``."""
        name, _, port = text.rpartition(".")
        if name not in self.types:
            raise UsageError(f"a connection names {text}, but there is no component {name!r}")
        return name, port

    def counterpart(self, name: str) -> Counterpart:
        """Return what stands for a component."""
        kind = self.types[name]
        if kind not in TABLE:
            raise UsageError(f"Hopsan's {kind} ({name}) has no counterpart")
        return TABLE[kind]

    def is_power(self, end: End) -> bool:
        """Whether an end is a port, and not a signal."""
        name, port = end
        if self.types[name] in SINKS:
            return False
        ports = {"P1"} if self.types[name] == FLOW_SENSOR else self.counterpart(name).ports
        return port in ports

    def add_parts(self) -> None:
        """Put a part into the plan for each component that is connected."""
        joined = {name for node in self.nodes for name, _ in node} | {name for name, _ in self.signal_ends}
        for name, kind in self.types.items():
            if kind not in SINKS and kind != FLOW_SENSOR:
                self.counterpart(name)  # what is not known is refused, connected or not
            if name not in joined:
                continue
            if kind == FLOW_SENSOR:
                self.plan.parts[own_name(name)] = self.flow_sensor
            elif kind not in SINKS:
                make, given = self.counterpart(name).make, self.given(name)
                self.plan.parts[own_name(name)] = partial(make, given)

    def given(self, name: str) -> Given:
        """Return what the case says of a component; start values of a node may be said by any of its members."""
        starts: dict[str, float] = {}
        for node in self.nodes:
            for port in (port for member, port in node if member == name):
                for quantity in STARTS:
                    texts = [self.values[n].get(f"{p}#{quantity}") for n, p in node if not self.is_sensor(n)]
                    said = [number(text, quantity) for text in texts if text is not None]
                    if said:
                        starts[f"{port}#{quantity}"] = max(said, key=abs)
        driven = frozenset(port for member, port in self.signal_ends if member == name)
        return Given(name, self.types[name], self.values[name], starts, driven, self.fluid, self.step)

    def is_sensor(self, name: str) -> bool:
        """Whether a component measures only."""
        return "Sensor" in self.types[name]

    def flow_sensor(self) -> FlowSensor:
        """Return a sensor that stands in series."""
        return FlowSensor(fluid=self.fluid)

    def places_of_flow_sensors(self, power: list[tuple[End, End]]) -> dict[End, list[str]]:
        """Return the ports whose flow is measured, and by which sensors: the ones that they are connected to.

        A sensor that is connected to another sensor measures what flows into the component that stores.
        """
        found: dict[End, list[str]] = defaultdict(list)
        for node in self.nodes:
            ports = [end for end in node if not self.is_sensor(end[0])]
            by_storage = sorted(ports, key=lambda e: not self.counterpart(e[0]).stores)
            for sensor in (name for name, _ in node if self.types[name] == FLOW_SENSOR):
                beside = [b if a[0] == sensor else a for a, b in power if sensor in (a[0], b[0])]
                direct = [e for e in beside if e in ports]
                found[(direct or by_storage)[0]].append(sensor)
        return found

    def join_node(self, node: list[End]) -> None:
        """Join all ports of a node, with the flow sensors in series with the ports that they measure."""
        open_ends: list[End] = []
        for end in node:
            name, port = end
            if self.types[name] == FLOW_SENSOR:
                continue
            part = self.counterpart(name)
            outer = (own_name(name), part.ports[port])
            inward, outward = ("port_b", "port_a") if part.stores else ("port_a", "port_b")
            for sensor in self.flow_sensors.get(end, ()):
                self.plan.joins.append((outer, (own_name(sensor), inward)))
                outer = (own_name(sensor), outward)
            open_ends.append(outer)
        self.plan.joins += [(open_ends[0], other) for other in open_ends[1:]]

    def join_signal(self, one: End, other: End) -> None:
        """Join an output variable to an input, through a gain: signals of Hopsan have no unit, ours have."""
        source, target = (one, other) if one[1] in OUTPUTS else (other, one)
        giver, taker = ((own_name(end[0]), self.signal(end)) for end in (source, target))
        kind = self.types[target[0]]
        k = SCALES[kind](self.given(target[0])) if target[1] == "in" and kind in SCALES else 1.0
        gain = f"{'_'.join(giver)}__{'_'.join(taker)}"
        self.plan.parts[gain] = partial(Gain.of(self.unit(taker), self.unit(giver)), k=k)
        self.plan.joins += [(giver, (gain, "u")), ((gain, "y"), taker)]

    def unit(self, end: End) -> str:
        """Return the unit of a signal of a part."""
        unit: str = getattr(type(self.plan.parts[end[0]]()), end[1]).unit
        return unit

    def signal(self, end: End) -> str:
        """Return our name of a variable."""
        name, variable = end
        if self.types[name] == FLOW_SENSOR and variable == "out":
            return "q"
        signals = self.counterpart(name).signals
        if variable not in signals:
            raise UsageError(f"the variable {variable} of Hopsan's {self.types[name]} ({name}) is not known")
        return signals[variable]

    def path(self, signal: str) -> tuple[str, float]:
        """Return the variable for ``model$component#port or variable#quantity`` of a reference, and its sign."""
        name, variable, quantity = signal.rpartition("$")[2].split("#")
        if quantity == "Value":
            return f"{own_name(name)}.{self.signal((name, variable))}", 1.0
        part = self.counterpart(name)
        if variable not in part.ports or quantity not in QUANTITIES:
            raise UsageError(f"no variable is known for {signal}")
        sign = -1.0 if quantity == "Flow" and not part.stores else 1.0
        return f"{own_name(name)}.{part.ports[variable]}.{QUANTITIES[quantity]}", sign

    def notes(self) -> str:
        """Return what of Hopsan's discretisation the model follows."""
        return "; ".join(note for kind, note in NOTES.items() if kind in self.types.values())

    def before(self, signal: str) -> float | None:
        """Return the start value that the case states for a sensor's node, which Hopsan logs before its first step."""
        name = signal.rpartition("$")[2].split("#")[0]
        for measured, quantity in MEASURED.items():
            if measured in self.types[name]:
                return number(self.values[name].get(f"P1#{quantity}", 0.0), f"{name}.P1#{quantity}")
        return None


def nodes_of(links: list[tuple[End, End]]) -> Iterator[list[End]]:
    """Yield the sets of ports that are connected, directly or through others."""
    sets: dict[End, list[End]] = {}
    for a, b in links:
        one, other = sets.setdefault(a, [a]), sets.setdefault(b, [b])
        if one is not other:
            one += other
            sets.update(dict.fromkeys(other, one))
    seen: set[int] = set()
    for members in sets.values():
        if id(members) not in seen:
            seen.add(id(members))
            yield members
