"""The demonstration: the powertrain works through a trot in the air, from its cold start."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import pi
from typing import TypeVar

import casadi
from casadi import SX

from arthur_acausal import Equations, Real, connect, parameter, time
from arthur_acausal.components.blocks import Source
from arthur_acausal.models.arthur.powertrain import Powertrain

Number = TypeVar("Number", float, SX)

VOLTAGE = 41.0
"""Of the motor [V]: about 5070 rpm; the pump then gives more than the legs take, and the relief valve stays open."""
RISE_OF_VOLTAGE, RISE = 0.02, 0.15
"""Time constants [s] with which the voltage, and currents and loads, are brought up."""
STRIDES = 1.6
"""Strides a second [Hz]: 0.25 s of swing and 0.375 s of stance."""
HOLD = 5.34
"""The load [N] that holds a piston at rest with 3 bar in both chambers, 3e5 Pa (A_A - A_B)."""


@dataclass(frozen=True, slots=True)
class Joint:
    """What one joint of each leg does: amplitude of the current [A], mean load [N], phase [rad]."""

    current: float
    force: float
    phase: float


JOINTS = (Joint(0.0165, 50.0, pi / 2), Joint(0.044, 120.0, 0.0), Joint(0.0495, 170.0, pi / 2))
"""Abduction, hip and knee. Loads swing from ``HOLD`` to twice ``force`` more in phase with the current: they resist."""
LEG_PHASE = (0.0, pi, pi, 0.0)
"""Front left, front right, hind left, hind right [rad]: a trot moves diagonal legs together."""


def exp(x: Number) -> Number:
    """Return e^x; CasADi's function takes floats as well, which its types do not say."""
    return casadi.exp(x)  # pyright: ignore[reportReturnType]


def sin(x: Number) -> Number:
    """Return sin(x)."""
    return casadi.sin(x)  # pyright: ignore[reportReturnType]


def rise(t: Number, amplitude: float | Number, T: float | Number) -> Number:
    """Return a level that is brought up from 0 with the time constant ``T`` [s]."""
    return amplitude * (1 - exp(-t / T))


def ramp(t: Number, T: float | Number) -> Number:
    """Return a level that is brought up from 0 to 1, smoothly, within about 2 ``T`` [s]."""
    return 1 - exp(-((t / T) ** 2))


def stroke(t: Number, amplitude: float, f: float, phase: float, T: float) -> Number:
    """Return amplitude sin^3(2 pi f t + phase), ramped up: the piston comes to rest where it turns, as a foot does."""
    return ramp(t, T) * amplitude * sin(2 * pi * f * t + phase) ** 3


def load(t: Number, force: float, f: float, phase: float, T: float) -> Number:
    """Return HOLD + force (1 + sin(2 pi f t + phase)), the second part ramped up [N]."""
    return HOLD + ramp(t, T) * force * (1 + sin(2 * pi * f * t + phase))


class Rise(Source):
    """y = amplitude (1 - exp(-t/T))."""

    _units = {"y": "{y}", "amplitude": "{y}"}
    amplitude: Real = parameter("1")
    T: Real = parameter("s", min=0.0)

    def equations(self) -> Equations:
        yield self.y == rise(time(), self.amplitude, self.T)


class Stroke(Source):
    """y = amplitude sin^3(2 pi f t + phase), brought up as 1 - exp(-(t/T)^2)."""

    _units = {"y": "{y}", "amplitude": "{y}"}
    amplitude: Real = parameter("1")
    f: Real = parameter("Hz", default=STRIDES)
    phase: Real = parameter("rad", default=0.0)
    T: Real = parameter("s", default=RISE, min=0.0)

    def equations(self) -> Equations:
        turn = sin(2 * pi * self.f * time() + self.phase)
        yield self.y == ramp(time(), self.T) * self.amplitude * turn**3


class Load(Source):
    """y = hold + amplitude (1 + sin(2 pi f t + phase)), the second part brought up as 1 - exp(-(t/T)^2)."""

    _units = {"y": "{y}", "amplitude": "{y}", "hold": "{y}"}
    amplitude: Real = parameter("1")
    hold: Real = parameter("1", default=HOLD)
    f: Real = parameter("Hz", default=STRIDES)
    phase: Real = parameter("rad", default=0.0)
    T: Real = parameter("s", default=RISE, min=0.0)

    def equations(self) -> Equations:
        swing = 1 + sin(2 * pi * self.f * time() + self.phase)
        yield self.y == self.hold + ramp(time(), self.T) * self.amplitude * swing


def joint_of(i: int) -> tuple[Joint, float]:
    """Return what actuator ``i`` is (three a leg: abduction, hip, knee), and its phase [rad]."""
    joint = JOINTS[i % 3]
    return joint, LEG_PHASE[i // 3 % 4] + joint.phase


class Demo(Powertrain):
    """The powertrain driven by 41 V and twelve trot-like current profiles against swinging loads.

    Diagonal legs move together at 1.6 strides a second; pistons reach 0.05 (abduction) to 0.15 m/s (knee)
    within +-20 mm and come to rest where they turn. It starts as Table 5 says, at rest with 3 bar everywhere,
    each piston held by its load.
    """

    def build(self) -> None:
        super().build()
        self.voltage = Rise.of("V")(amplitude=VOLTAGE, T=RISE_OF_VOLTAGE)
        joints = [joint_of(i) for i in range(self.n)]
        current, force = Stroke.of("A"), Load.of("N")
        self.currents = [current(amplitude=joint.current, phase=phase) for joint, phase in joints]
        self.forces = [force(amplitude=joint.force, phase=phase) for joint, phase in joints]

    def equations(self) -> Equations:
        yield from super().equations()
        has_drive = self.choice.supply == "battery"
        yield connect(self.voltage.y, self.drive.V_command if has_drive else self.motor.V)
        for i in range(self.n):
            yield connect(self.currents[i].y, self.valves[i].I)
            yield connect(self.forces[i].y, self.loads[i].F)


def demo_inputs(n: int = 12) -> dict[str, Callable[[float], float]]:
    """Return the demo's inputs for ``Powertrain`` itself, by path, as functions of time [s]."""
    inputs: dict[str, Callable[[float], float]] = {
        "motor.V": partial(rise, amplitude=VOLTAGE, T=RISE_OF_VOLTAGE),
    }
    for i in range(n):
        joint, phase = joint_of(i)
        common = {"f": STRIDES, "phase": phase, "T": RISE}
        inputs[f"valves[{i}].I"] = partial(stroke, amplitude=joint.current, **common)
        inputs[f"loads[{i}].F"] = partial(load, force=joint.force, **common)
    return inputs
