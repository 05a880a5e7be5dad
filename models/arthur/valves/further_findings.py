"""The findings on designs, testbed, actuation and robot, in words; every figure in the text is computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any


def designs_text(designs: Mapping[str, Any] | None) -> str:
    """Return what the sweep over designs says, nothing without one."""
    if designs is None:
        return ""
    order = sorted(designs["rank_correlation"].items(), key=lambda item: -abs(item[1]))
    moves = ", ".join(f"{name} {value:+.2f}" for name, value in order)
    return (
        "## Which design wins honestly?\n\n"
        f"{designs['designs']} designs were drawn (Latin hypercube over radius, port, clearance, friction, offset, "
        "balanced or plain passages, laminar or turbulent lines). "
        f"{designs['reach_the_flow']} of them reach 0.5 gpm. To that flow, with the jets counted, "
        f"{designs['win_with_jets']} of these need less work than the spool valve's {designs['spool_uJ']:.0f} uJ under "
        f"the same load: {designs['win_balanced']} with balanced passages, {designs['win_unbalanced']} with plain; "
        f"{designs['win_turbulent']} with turbulent lines, as a Reynolds number near 1e4 asks for, of which the best "
        f"needs {designs['best_turbulent_uJ']:.0f} uJ. Without the jets it would be {designs['win_without_jets']}. "
        f"Rank correlation of the work with the factors: {moves}.\n\n" + _best(designs)
    )


def _best(designs: Mapping[str, Any]) -> str:
    """What the best design is, and how it bears the printing."""
    best, again = designs["best"], designs["best_printed_again"]
    middle, winners = designs["median_of_winners"], ""
    if designs["win_with_jets"]:
        winners = (
            f"In the middle of those that win the port is {middle['d_p'] * 1e3:.2f} mm wide, the friction "
            f"{middle['mu_k']:.3f}, the offset {middle['offset']:.2f}. "
        )
    return (
        winners
        + f"The best needs {designs['best_uJ']:.0f} uJ: {best['pressure_load']} passages, {best['line']} lines, radius "
        f"{best['r_c'] * 1e3:.2f} mm, port {best['d_p'] * 1e3:.2f} mm, clearance {best['delta_r'] * 1e6:.1f} um, "
        f"friction {best['mu_k']:.3f}, offset {best['offset']:.2f} of the port. A port that is just wide enough helps: "
        "jets push least where it is nearly open. "
        f"Printed {again['designs']} times with the jet's angle off by some 3 deg (assumed), it needs "
        f"{again['median_uJ']:.0f} uJ in the middle ({again['least_uJ']:.0f} to {again['most_uJ']:.0f}), and less than "
        f"the spool valve {again['wins']} times."
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


def trot_text(trot: Mapping[str, Any] | None) -> str:
    """Return what the valves cost the quadruped in its own trot, nothing without one."""
    if trot is None:
        return ""
    rows = "\n".join(
        f"| {name} | {n['mechanical_W'] * 1e3:.2f} | {n['copper_W'] * 1e3:.0f} | {n['torque_max_Nm'] * 1e3:.1f} | "
        f"{n['opening_max']:.2f} | {n['battery_more_W']:.0f} | {n['force_tracking_rms']:.1%} | {n['minutes']:.1f} |"
        for name, n in ((name, trot[name]) for name in ("rotary", "spool"))
    )
    return (
        "## The same by the quadruped's own budget\n\n"
        f"Trotting at 0.5 m/s on ideal valves the simulated robot takes {trot['battery_W']:.0f} W from its battery "
        f"at {trot['pressure_bar']:.0f} bar, {trot['battery_to_fluid']:.0%} of which reach the fluid: 2 kg of battery "
        f"last {trot['minutes_ideal']:.1f} min. Pilots would take {trot['pilot_flow_gpm']:.2f} gpm at that pressure, "
        f"{trot['pilot_electrical_W']:.0f} W from the battery with pump and motor larger in proportion: "
        f"{trot['minutes_two_stage']:.1f} min, where the report's budget has 8, at 1.4 m/s and 3000 psi. "
        "With driven valves in a leg, of each valve, and for twelve of them:\n\n"
        "| valve | moving [mW] | windings [mW] | torque, largest [mN m] | opening, largest | battery, twelve [W] | "
        "force tracking | minutes |\n|---|---|---|---|---|---|---|---|\n"
        f"{rows}\n\n"
        "What the battery gives more is the leakage in the middle. The valves' motion and their holding are measured "
        "here, not assumed; the motor's constant is (0.01 N m/W^0.5)."
    )
