"""What can be chosen about the quadruped: sizes that can work, and the report's own."""

from __future__ import annotations

from dataclasses import dataclass

from arthur_acausal import UsageError
from arthur_acausal.components.hydraulic import GPM
from arthur_acausal.components.hydraulic.servo_valve import Spool
from arthur_acausal.models.arthur.actuator import ForceLaw
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.power_unit import PumpLaw


@dataclass(frozen=True, slots=True)
class QuadrupedOptions:
    """The hydraulics of the quadruped.

    Attributes
    ----------
    p_relief, P_des : cracking pressure of the relief valve, pressure that the pump's controller keeps [Pa].
    Q_req : flow by which the pump is sized [m^3/s]. q_rated : rated flow of each valve at 70 bar [m^3/s].
    accumulator : 10 cc of gas at 84 bar beside the manifold. pump : controller of the pump, see PowerUnit.
    horizon : how far a controller with foresight uses the plan [s]. model_error : share by which the pump's controller
    takes the pump to be larger than it is. known : the demand that a clairvoyant controller knows.
    force : controller of the forces, see Actuator. spool : of the valves, see ServoValve.
    c : damping of the cylinders [N s/m]. b_tank : damping of the reservoir's piston [N s/m].
    cavitation : of the fluid, see Fluid.
    """

    p_relief: float = 140e5
    P_des: float = 135e5
    Q_req: float = 1.25 * GPM
    q_rated: float = 2e-3 / 60
    accumulator: bool = True
    pump: PumpLaw = "feed-forward"
    horizon: float = 0.3
    model_error: float = 0.0
    known: Demand | None = None
    force: ForceLaw = "feed-forward"
    spool: Spool = "second order"
    c: float = 100.0
    b_tank: float = 1e3
    cavitation: bool = True


VARIANTS = {
    "default": QuadrupedOptions(),
    "no accumulator": QuadrupedOptions(accumulator=False, pump="constant speed"),
    "report": QuadrupedOptions(
        p_relief=20.68e6,
        P_des=20.68e6,
        Q_req=GPM,
        q_rated=7.5e-3 / 60,
        accumulator=False,
        pump="constant speed",
        c=10.0,
        b_tank=10.0,
    ),
}
"""``report``: the values of sections 5 and 6, 207 bar and 1 gpm; a trot leaves that supply almost no reserve."""


def options_of(variant: str) -> QuadrupedOptions:
    """Return the options of a named variant."""
    if variant not in VARIANTS:
        raise UsageError(
            f"the quadruped has no variant {variant!r}", remedy=f"it has {', '.join(map(repr, VARIANTS))}"
        )
    return VARIANTS[variant]
