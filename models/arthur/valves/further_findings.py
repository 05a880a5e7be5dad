"""The findings on designs, testbed, actuation and robot, in words; every figure in the text is computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any


def designs_text(designs: Mapping[str, Any] | None) -> str:
    """Return what the sweep over designs says, nothing without one."""
    if designs is None:
        return ""
    best = designs["best"]
    order = sorted(designs["rank_correlation"].items(), key=lambda item: -abs(item[1]))
    moves = ", ".join(f"{name} {value:+.2f}" for name, value in order)
    return (
        "## Which design wins honestly?\n\n"
        f"{designs['designs']} designs were drawn (Latin hypercube over radius, port, clearance, friction, offset, "
        "balanced or plain passages, and a random error of the jet's angle for the printing). "
        f"{designs['reach_the_flow']} of them reach 0.5 gpm. To that flow, with the jets counted, "
        f"{designs['win_with_jets']} of these need less work than the spool valve's {designs['spool_uJ']:.0f} uJ under "
        f"the same load: {designs['win_balanced']} with balanced passages, {designs['win_unbalanced']} with plain. "
        "Without "
        f"the jets it would be {designs['win_without_jets']}.\n\n"
        f"The best needs {designs['best_uJ']:.0f} uJ: {best['pressure_load']} passages, radius {best['r_c'] * 1e3:.2f} "
        f"mm, port {best['d_p'] * 1e3:.2f} mm, clearance {best['delta_r'] * 1e6:.1f} um, friction {best['mu_k']:.3f}, "
        f"offset {best['offset']:.2f} of the port, jet's angle off by {best['phi_error'] * 57.29578:+.1f} deg. "
        f"Rank correlation of the work with the factors: {moves}. A jet that leaves more steeply helps, so a part of "
        "what wins here is luck in the printing." + _printed(designs)
    )


def _printed(designs: Mapping[str, Any]) -> str:
    """What remains of the best design where only the printing varies."""
    again = designs.get("best_printed_again")
    if again is None:
        return ""
    return (
        f" Printed {again['designs']} times with that error drawn anew, the best design needs {again['median_uJ']:.0f} "
        f"uJ in the middle ({again['least_uJ']:.0f} to {again['most_uJ']:.0f}), and less than the spool valve "
        f"{again['wins']} times."
    )


def testbed_text(bed: Mapping[str, Mapping[str, float]]) -> str:
    """Return what the testbed would measure."""
    rows = "\n".join(
        f"| {name} | {n['T_jet_max_mNm']:.1f} | {n['z_of_the_max']:.2f} | {n['T_friction_max_mNm']:.1f} | "
        f"{n['Q_max_gpm']:.2f} | {n['T_jet_max_over_Q_max_mNm_per_gpm']:.1f} |"
        for name, n in bed.items()
    )
    double, against = bed["double"], bed["antagonistic"]
    torque = against["T_jet_max_mNm"] / double["T_jet_max_mNm"] - 1
    flow = against["Q_max_gpm"] / double["Q_max_gpm"] - 1
    per_flow = against["T_jet_max_over_Q_max_mNm_per_gpm"] / double["T_jet_max_over_Q_max_mNm_per_gpm"]
    verdict = "more" if per_flow > 1 else "less"
    return (
        "## The testbed of section 4.2\n\n"
        "An oversized house-shaped spool, three times the case study's, at 500 psi. Turned both ways, the mean of the "
        "two torques is the jets', half of their difference is friction.\n\n"
        "| spool | jets, largest [mN m] | at position | friction, largest [mN m] | flow, largest [gpm] | "
        "mN m a gpm |\n|---|---|---|---|---|---|\n"
        f"{rows}\n\n"
        f"Antagonistic ports change the largest torque by {torque:+.0%} and the largest flow by {flow:+.0%} against "
        f"two ports in line: for its flow, the antagonistic spool needs {verdict} torque ({per_flow:.2f} times). The "
        "jets oppose each other only while one port is past its housing's; on the way there both close."
    )


def actuation_text(errors: Mapping[str, Sequence[float]]) -> str:
    """Return what the position loops reach."""
    worst = {name: max(abs(error) for error in values) for name, values in errors.items()}
    return (
        "## Actuation (section 4.3)\n\n"
        f"Six steps of 2 deg. The cogging brushless motor comes to rest up to {worst['brushless']:.1f} deg off, which "
        f"is {worst['brushless'] / 11.459:.0%} of the port's width; the motor without steps up to "
        f"{worst['ultrasonic']:.2g} deg. Cogging, rotor and gains are assumed such that the error is figure 4-14's."
    )


def robot_text(robot: Mapping[str, Any]) -> str:
    """Return what the valves cost the robot."""
    plain, larger = robot["pump_without_pilots"], robot["pump_with_pilots"]
    rows = "\n".join(
        f"| {name} | {n['moving_W']:.2f} | {n['holding_W']:.1f} | {n['leakage_gpm_a_valve']:.4f} | "
        f"{n['leakage_electrical_W']:.0f} | {n['minutes']:.1f} | {n['minutes_with_leakage']:.1f} |"
        for name, n in ((name, robot[name]) for name in ("rotary", "spool"))
    )
    return (
        "## What it means for the robot\n\n"
        f"The pilots of 12 two-stage valves take {robot['pilot_flow_gpm']:.2f} gpm at 3000 psi "
        f"({robot['pilot_flow_2000_psi_gpm']:.2f} gpm at 2000), {robot['pilot_hydraulic_W']:.0f} W of fluid power and "
        f"{robot['pilot_electrical_W']:.0f} W from the battery, of {robot['battery_draw_W']:.0f} W (2 kg at 180 "
        "Wh/kg, assumed, in 8 min). With them the pump needs "
        f"{larger['displacement_cc']:.2f} cc a turn and {larger['torque_Nm']:.2f} N m and "
        f"{larger['shaft_power_W']:.0f} W, instead of {plain['displacement_cc']:.2f} cc, {plain['torque_Nm']:.2f} N m "
        f"and {plain['shaft_power_W']:.0f} W: "
        "more than the report's motor gives (3.9 N m).\n\n"
        "Direct drive in a trot of 2 strides a second at half opening, on a cost of transport that stays:\n\n"
        "| valve | moving [W] | holding [W] | leak of a valve [gpm] | leaks, electrical [W] | minutes | minutes with "
        "leaks |\n|---|---|---|---|---|---|---|\n"
        f"{rows}\n\n"
        f"Against {robot['minutes_two_stage']:.0f} min with two-stage valves. The work of moving either valve is "
        "nothing beside the pilots' loss: which of them needs less does not matter to the battery. What matters is the "
        "clearance, by its cube: the rotary valve's 12.7 um over an overlap of 34 um a side leak "
        f"{robot['rotary']['leakage_gpm_a_valve'] / 0.08:.0%} of a pilot's flow. Its slots are assumed two ports wide."
    )
