"""What the powertrain's energy audit adds up: each power by its part and name, none of them a difference."""

from __future__ import annotations

from typing import Any

POWERS = {
    "input": ("motor", "P_el"),
    "copper": ("motor", "P_copper"),
    "motor_friction": ("motor", "P_friction"),
    "pump_friction": ("pump", "P_friction"),
    "pump_leakage": ("pump", "P_leakage"),
    "pump_compression": ("pump", "P_compression"),
    "relief": ("relief", "P_loss"),
    "filter": ("filter", "P_loss"),
    "cylinders": ("cylinders[*]", "P_loss"),
    "reservoir": ("reservoir", "P_loss"),
    "work": ("loads[*]", "P_work"),
}
"""Term -> (part, signal [W]); [*] stands for all of a list. Each valve's loss comes beside them."""

STORED = [
    "motor.E_stored",
    "pump.E_stored",
    "manifold.E_stored",
    "cylinders[*].E_stored",
    "reservoir.E_stored",
]


def powers(supply: str) -> dict[str, tuple[str, str]]:
    """Return POWERS, with the battery's where there is one."""
    if supply == "ideal":
        return POWERS
    return POWERS | {"input": ("drive", "P_battery"), "drive": ("drive", "P_loss")}


def audit_terms(supply: str, n: int, metered: bool) -> dict[str, Any]:
    """Return the paths that sum to each term: of the meters' energies, or without meters of the powers."""
    terms = {
        name: [f"energy_{name}.E" if metered else f"{part}.{signal}"]
        for name, (part, signal) in powers(supply).items()
    }
    losses = {name: paths for name, paths in terms.items() if name not in ("input", "work")}
    losses |= {
        f"valves[{i}]": [f"energy_valves[{i}].E" if metered else f"valves[{i}].P_loss"] for i in range(n)
    }
    return {"input": terms["input"], "losses": losses, "work": terms["work"], "stored": STORED}
