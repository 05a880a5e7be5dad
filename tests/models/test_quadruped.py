"""The whole robot: it starts standing in balance, keeps its energy, and says when it falls."""

from __future__ import annotations

from functools import cache
from typing import Any

import mujoco
import numpy as np
import pytest

from arthur_acausal import Solution, SolverOptions, Translation, translate
from arthur_acausal.models.arthur.budget import body_energy, budget
from arthur_acausal.models.arthur.dimensions import JOINT_NAMES, LEGS, Dimensions
from arthur_acausal.models.arthur.figures import attitude, contact_speeds, slip_share, spans, tracking
from arthur_acausal.models.arthur.mjcf import quadruped_mjcf
from arthur_acausal.models.arthur.quadruped import Quadruped
from arthur_acausal.models.arthur.quadruped_picture import LOSSES, total
from arthur_acausal.models.arthur.trouble import counts
from arthur_acausal.models.arthur.valves.direct import ValveKind
from arthur_acausal.models.arthur.valves.trot import mean_power, trot_numbers, trots

WEIGHT = Dimensions().mass * 9.81
QPOS = [f"base_{x}" for x in ("x", "y", "z", "q_w", "q_x", "q_y", "q_z")] + [f"{j}_phi" for j in JOINT_NAMES]


@cache
def robot() -> Translation:
    return translate(Quadruped(audit=True))


@cache
def standing() -> Solution:
    """A tenth of a second of standing."""
    return robot().simulate(0.1, options=SolverOptions(rtol=1e-5, intervals=5))


@cache
def trotting() -> Translation:
    return translate(Quadruped(gait="trot", v_x=0.5, audit=True))


@cache
def trotted() -> Solution:
    """The first steps of a trot."""
    return trotting().simulate(0.3, options=SolverOptions(rtol=1e-3, intervals=600))


def initial(name: str) -> float:
    return standing().initial(name)


def test_it_starts_in_balance() -> None:
    """MuJoCo's inverse dynamics needs just the torques of the cylinders, and no force on the trunk."""
    model = mujoco.MjModel.from_xml_string(quadruped_mjcf())
    data = mujoco.MjData(model)
    data.qpos[:] = [initial(f"body.{name}") for name in QPOS]
    mujoco.mj_inverse(model, data)
    assert data.qfrc_inverse[:6] == pytest.approx(np.zeros(6), abs=1e-4)
    torques = [initial(f"actuators[{i}].linkage.tau") for i in range(12)]
    assert data.qfrc_inverse[6:] == pytest.approx(torques, abs=1e-6)
    assert sum(initial(f"body.sensor_{leg}_touch") for leg in LEGS) == pytest.approx(WEIGHT, rel=1e-5)


def test_it_starts_under_pressure() -> None:
    assert initial("unit.manifold.p") == pytest.approx(135e5)
    for i in range(12):
        p_A, p_B = (initial(f"actuators[{i}].cylinder.p_{side}") for side in "AB")
        assert p_A + p_B == pytest.approx(initial("actuators[0].p_s.p") + initial("actuators[0].p_t.p"))
        push = initial(f"actuators[{i}].cylinder.A_A") * p_A - initial(f"actuators[{i}].cylinder.A_B") * p_B
        assert push == pytest.approx(initial(f"actuators[{i}].linkage.f"), abs=1e-6)


def test_it_stands() -> None:
    run = standing()
    assert np.ptp(run["body.base_z"]) < 1e-4
    assert np.abs(np.degrees(attitude(run))).max() < 0.1
    assert contact_speeds(run).max() < 0.01
    assert run["unit.manifold.p"] == pytest.approx(135e5, rel=0.01)


def test_energy() -> None:
    """Standing takes what leaks and what warms the windings."""
    energy = standing().energy()
    assert abs(energy.closure) < 1e-4
    assert energy.losses_J["copper"] + energy.losses_J["pump_leakage"] > 0.8 * energy.input_J
    assert abs(energy.work_J) < 1e-3 * energy.input_J


def test_the_rigid_bodies_balance() -> None:
    """Work of the cylinders = growth of MuJoCo's energies + what contacts take, in the first steps of a trot."""
    run = trotted()
    energy = body_energy(run)
    assert abs(energy.closure) < 0.01
    assert energy.contact_J > 0.01 * energy.positive_J
    assert energy.work_J == pytest.approx(run.energy().work_J, abs=0.01 * energy.positive_J)
    (cascade,) = budget({"trot": run}).axes
    assert len(cascade.patches) == len(cascade.get_yticklabels()) > 8


def test_forces_follow_and_feet_stand_in_a_trot() -> None:
    """Half of what may be: within 5 % of the demand, while legs lift and swing, and next to no slip."""
    run = trotted()
    always = run.t >= 0.0
    touch = run.values([f"body.sensor_{leg}_touch" for leg in LEGS])
    assert (touch == 0.0).any()
    assert 0.01 < tracking(run, always) < 0.05  # type: ignore[operator]
    assert slip_share(run, always) < 0.025


def test_rows_count_by_their_time() -> None:
    assert spans(np.array([0.0, 1.0, 1.0, 3.0])).ravel() == pytest.approx([0.5, 0.5, 1.0, 1.0])


def test_unknowns() -> None:
    """Six an actuator, seven of the unit, 37 of the body; two are implicit."""
    report = translate(Quadruped(), compile="never").report
    assert len(report.states) == 12 * 6 + 7 + 37
    assert report.torn == ["unit.motor.I", "unit.filter.p_s"]


class Limp:
    """Asks for no force."""

    def fresh(self) -> Limp:
        return self

    def __call__(self, t: float, sensors: Any) -> Any:
        return np.concatenate([np.zeros(24), np.full(12, t), np.zeros(22)])


def test_a_fall_ends_the_run_and_is_told() -> None:
    """It is pushed to the left as it falls, and lies there; what went wrong is said in words."""
    model = translate(Quadruped(controller=Limp(), push=50.0))
    late = {"t_push": 0.02, "push_duration": 0.05}
    run = model.simulate(1.0, parameters=late, options=SolverOptions(rtol=1e-3, intervals=10))
    assert run.run.status == "terminated"
    assert "fell" in run.run.message
    assert model.model.figures(run)["locomotion"]["fell"]  # type: ignore[attr-defined]
    assert run.t[-1] < 0.5
    assert np.ptp(run["body.imu_f_y"]) == pytest.approx(50.0)
    assert run.final("body.base_y") > Dimensions().foot_radius
    told = model.model.notes(run)  # type: ignore[attr-defined]
    assert told[-1] == f"the robot fell at {run.t[-1]:.3g} s"
    assert len(told) - 1 == sum(number > 0 for number in counts(run).values())


def test_the_picture_shows_every_loss_once() -> None:
    """The layers of its last panel are the losses of the energy audit, which meters integrate."""
    run = standing()
    layers = sum(np.trapezoid(total(run, *signals), run.t) for signals in LOSSES.values())
    assert layers == pytest.approx(sum(run.energy().losses_J.values()), rel=0.01)
    figure = Quadruped().figure(run)
    assert [axes.get_ylabel().split(" [")[0] for axes in figure.axes[-4:]] == [
        "force on the feet",
        "pressure",
        "flow",
        "power",
    ]
    assert len(figure.axes[2].lines) >= 2  # roll and pitch


@cache
def walks() -> dict[str, Solution]:
    """The start of a trot with ideal and with driven valves in the leg FL."""
    return trots(0.06)


@pytest.mark.parametrize("kind", ["rotary", "spool"])
def test_a_leg_with_driven_valves_follows_as_with_ideal_ones(kind: ValveKind) -> None:
    """What moving the valves takes is told; it is small beside the 100 W of a pilot."""
    run, ideal = walks()[kind], walks()["ideal"]
    for joint in JOINT_NAMES:
        path = f"body.{joint}_phi"
        np.testing.assert_allclose(np.interp(ideal.t, run.t, run[path]), ideal[path], atol=5e-3)
    assert np.ptp(ideal["body.FL_hip_phi"]) > 0.002
    assert run.final("actuators[1].valve.drive.phi") != 0.0
    assert run.select("actuators[*].valve.drive.P") == [f"actuators[{i}].valve.drive.P" for i in range(3)]
    told = Quadruped(valve=kind).figures(run)["valve_actuation"]
    assert told["valves"] == 3
    assert told["force_tracking_rms"] < 0.3  # the start, from rest
    assert 0.0 < told["mechanical_W"] < 0.1
    # Loads of the case studies, mN m at less than half of the opening, which the windings hold.
    assert 1e-5 < told["torque_max_Nm"] < 1e-2
    assert 0.0 < told["copper_W"] < (told["torque_max_Nm"] / 0.01) ** 2
    assert abs(run.energy().closure) < 1e-4


def test_the_budget_by_the_valves() -> None:
    """Battery and fluid power by their own signals; 360 Wh; pilots of 0.08 gpm at 3000 psi, as the root of pressure."""
    begin = 0.02
    told, ideal = trot_numbers(walks(), begin), walks()["ideal"]
    after = ideal.t >= begin
    battery = ideal["unit.drive.P_battery"][after]
    assert told["battery_W"] == pytest.approx(np.trapezoid(battery, ideal.t[after]) / 0.04, rel=0.01)
    # What is not lost before the fluid, but for what turns the pump faster.
    lost = ("drive", "copper", "motor_friction", "pump_friction", "pump_leakage", "pump_compression")
    share = sum(mean_power(ideal, name, begin) for name in lost) / told["battery_W"]
    assert told["battery_to_fluid"] == pytest.approx(1 - share, abs=0.01)
    pressure = float(ideal["unit.manifold.p"][after].mean())
    pilots = 12 * 0.08 * np.sqrt(pressure / (3000 * 6894.757)) * 3.785411784e-3 / 60
    assert told["pilot_electrical_W"] == pytest.approx(pilots * pressure / told["battery_to_fluid"], rel=1e-3)
    both = told["battery_W"] + told["pilot_electrical_W"]
    assert told["minutes_two_stage"] == pytest.approx(2 * 180 * 60 / both)
    for kind in ("rotary", "spool"):
        assert told["minutes_two_stage"] < told[kind]["minutes"] < told["minutes_ideal"]
