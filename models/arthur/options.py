"""What can be chosen about the ARTHuR powertrain: our defaults, and the report's printed listings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args, get_type_hints

from arthur_acausal import UsageError
from arthur_acausal.components.hydraulic.cylinder import Efficiency
from arthur_acausal.components.hydraulic.motor import Clamp, MotorLaw
from arthur_acausal.components.hydraulic.relief_valve import ReliefLaw
from arthur_acausal.components.hydraulic.reservoir import GasLaw
from arthur_acausal.components.hydraulic.servo_valve import Spool, ValveLaw


@dataclass(frozen=True, slots=True)
class Options:
    """One choice for each place where the report can be read in more than one way.

    The defaults are physically consistent. For how each choice works see the component that takes it.

    Attributes
    ----------
    motor_law, motor_clamp : see BrushlessMotor.
    supply : "ideal" (the motor gets the voltage asked for) or "battery" (see BatteryDrive).
    sizing : "efficiency" (pump displacement by an assumed eta_v, 5.12) or "consistent" (by 5.14 itself).
    relief_law : see ReliefValve. valve_law, spool : see ServoValve.
    filter_drop : pressure drop of the filter by its "own flow", or by the "pump flow" (6.1 as printed).
    efficiency, stribeck : see Cylinder. c_first, c_others : damping of cylinder 0 and of the others [N s/m].
    A_B : area on the rod's side [m^2].
    gas, A_R, k_R : gas law, area [m^2] and stop stiffness [N/m] of the reservoir.
    constant_density : a fluid of constant density, so that flows are volume flows (5.39).
    air, cavitation : see Fluid.
    stop_events : contact with the stops of cylinders and reservoir makes events.
    """

    motor_law: MotorLaw = "line"
    motor_clamp: Clamp = "both"
    supply: Literal["ideal", "battery"] = "ideal"
    sizing: Literal["efficiency", "consistent"] = "efficiency"
    relief_law: ReliefLaw = "orifice"
    valve_law: ValveLaw = "laminar transition"
    spool: Spool = "ideal"
    filter_drop: Literal["own flow", "pump flow"] = "own flow"
    efficiency: Efficiency = "friction"
    stribeck: bool = False
    c_first: float = 10.0
    c_others: float = 10.0
    A_B: float = 5.35e-5
    gas: GasLaw = "algebraic"
    A_R: float = 1.15e-3
    k_R: float = 1.42e9
    constant_density: bool = False
    air: bool = False
    cavitation: bool = False
    stop_events: bool = False

    def __post_init__(self) -> None:
        for name, kind in get_type_hints(type(self)).items():
            known, given = get_args(kind), getattr(self, name)
            if known and given not in known:
                words = ", ".join(map(repr, known))
                raise UsageError(f"the powertrain has no {name} {given!r}", remedy=f"choose one of {words}")


VARIANTS = {
    "default": Options(),
    "listing": Options(
        motor_clamp="above",
        relief_law="listing",
        valve_law="listing",
        filter_drop="pump flow",
        efficiency="printed",
        c_others=100.0,
        A_B=0.75 * 7.13e-5,
        gas="integrated",
        A_R=1.1e-3,
        k_R=1.42e12,
        constant_density=True,
    ),
}
"""``listing`` reproduces the Matlab code of the report's section 6.3 as printed."""


def options_of(variant: str) -> Options:
    """Return the options of a named variant."""
    if variant not in VARIANTS:
        raise UsageError(
            f"the powertrain has no variant {variant!r}",
            remedy=f"it has {', '.join(VARIANTS)}",
        )
    return VARIANTS[variant]
