"""The locomotion stack alone: every gait and disturbance in plain MuJoCo, ten seeds each.

Torques are ideal, within what cylinders and linkages can give; sensors are noisy, the trunk's velocity is
estimated, the robot starts a little displaced. `--lag` lets the torques follow as a first-order lag, in place of
the hydraulics. What is required: no fall, mean speed within 10 %, roll and pitch below 5 degrees after the first
second, slip (share of stance with more than 5 N in which the contact point moves faster than 0.05 m/s) at most
5 %, and sideways less than 0.1 m/s from 2 s after a push on.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

import mujoco
import numpy as np

from arthur_acausal.models.arthur.locomotion.actuation import Cylinders, actuator_forces
from arthur_acausal.models.arthur.locomotion.commands import Command, Constant
from arthur_acausal.models.arthur.locomotion.controller import Configuration, Controller
from arthur_acausal.models.arthur.locomotion.flow import predicted_flow
from arthur_acausal.models.arthur.mjcf import quadruped_mjcf
from benchmarks.measure import parser, show
from benchmarks.walking import Push, Record, walk

SETTLED = 1.0
"""From here on attitude and slip count [s]."""
CRUISING = 1.5
"""From here on the mean speed counts [s]: the command is a ramp at first."""
CALM = 2.0
"""Time after a push at which the robot has to be calm again [s]."""
GPM = 3.785411784e-3 / 60


@dataclass(frozen=True, slots=True)
class Scenario:
    """One line of the table: command, duration [s], ground, payload [kg], push, lag of the torques [s].

    ``required``: whether its figures have to meet the targets; else they are only told.
    """

    name: str
    command: Command
    duration: float
    terrain: Literal["flat", "step", "slope"] = "flat"
    payload: float = 0.0
    push: Push | None = None
    lag: float = 0.0
    required: bool = True


SCENARIOS = (
    Scenario("stand", Command(gait="stand"), 10.0),
    Scenario("trot 0.5 m/s", Command(v_x=0.5), 20.0),
    Scenario("walk 0.15 m/s", Command(v_x=0.15, gait="walk"), 10.0),
    Scenario("pace 0.3 m/s", Command(v_x=0.3, gait="pace"), 10.0),
    Scenario("turn 0.5 rad/s", Command(yaw_rate=0.5), 10.0),
    Scenario("sideways 0.2 m/s", Command(v_y=0.2), 10.0),
    Scenario("push in place", Command(gait="stand"), 7.0, push=Push()),
    Scenario("push at 0.5 m/s", Command(v_x=0.5), 7.0, push=Push()),
    Scenario("step 3 cm at 0.3 m/s", Command(v_x=0.3, swing_height=0.08), 8.0, terrain="step"),
    Scenario("payload 2 kg", Command(v_x=0.5), 10.0, payload=2.0),
    Scenario("trot, force lag 3 ms", Command(v_x=0.5), 10.0, lag=3e-3),
    Scenario("bound 0.3 m/s", Command(v_x=0.3, gait="bound"), 6.0, required=False),
)


@dataclass(frozen=True, slots=True)
class Figures:
    """What a run gave.

    Attributes
    ----------
    fell : whether. speed_error : of the mean speed (or yaw rate), relative to the command.
    roll_deg, pitch_deg : largest after the first second. slip_share : see the module.
    v_y : largest from 2 s after a push on [m/s].
    push_N, pull_N : largest forces of the cylinders. flow_gpm, flow_peak_gpm : of the pistons, mean and peak.
    forecast_error : of the flow predicted 100 ms ahead, rms over the mean of the true one.
    lag_error : rms error of the torques over the rms of those asked. cpu_s_per_s : of the controller.
    """

    fell: bool
    speed_error: float | None
    roll_deg: float
    pitch_deg: float
    slip_share: float
    v_y: float | None
    push_N: float
    pull_N: float
    flow_gpm: float
    flow_peak_gpm: float
    forecast_error: float
    lag_error: float
    cpu_s_per_s: float


class Timed(Controller):
    """A controller that keeps its processor time [s]."""

    spent = 0.0

    def __call__(self, t: float, inputs: Any) -> Any:
        begin = time.process_time()
        outputs = super().__call__(t, inputs)
        self.spent += time.process_time() - begin
        return outputs


def run(scenario: Scenario, seed: int) -> Figures:
    """Run a scenario with one seed of noise and start."""
    model = mujoco.MjModel.from_xml_string(quadruped_mjcf(scenario.terrain, scenario.payload))
    controller = Timed(Configuration(Constant(scenario.command), seed=seed))
    record = walk(model, controller, scenario.duration, scenario.push, scenario.lag, seed)
    return figures_of(record, scenario, controller)


def figures_of(record: Record, scenario: Scenario, controller: Timed) -> Figures:
    """Return the figures of a record; those of a time that it did not reach are infinite."""
    settled, cruising = record.t >= SETTLED, record.t >= CRUISING
    roll, pitch = largest(np.degrees(record.angles[settled, :2]))
    flow = predicted_flow(record.joints, record.speeds, Cylinders())
    forces = actuator_forces(record.torque, record.joints)
    asked = record.outputs[:, controller.places["torque"]]
    return Figures(
        fell=record.fell is not None,
        speed_error=_speed_error(record, scenario.command, cruising),
        roll_deg=roll,
        pitch_deg=pitch,
        slip_share=float(record.slip[settled].sum() / max(1.0, record.loaded[settled].sum())),
        v_y=_sideways(record, scenario.push),
        push_N=float(forces.max()),
        pull_N=float(-forces.min()),
        flow_gpm=float(flow.mean() / GPM),
        flow_peak_gpm=float(flow[settled].max(initial=0.0) / GPM),
        forecast_error=_forecast_error(record, controller, flow),
        lag_error=float(np.std(record.torque - asked) / np.std(asked)),
        cpu_s_per_s=controller.spent / max(float(record.t[-1]), SETTLED),
    )


def largest(values: Any) -> tuple[float, ...]:
    """Return the largest magnitude of each column; infinite if there are no rows."""
    return tuple(np.abs(values).max(axis=0).tolist()) if len(values) else (np.inf,) * values.shape[1]


def _speed_error(record: Record, command: Command, cruising: Any) -> float | None:
    """Return the relative error of the mean velocity in the direction commanded, or of the yaw rate."""
    direction = np.array([command.v_x, command.v_y])
    speed = float(np.linalg.norm(direction))
    if not cruising.any():
        return np.inf
    if speed > 0.0:
        mean = record.velocity[cruising, :2].mean(axis=0) @ direction / speed
        return float(abs(mean / speed - 1.0))
    if command.yaw_rate:
        return float(abs(record.yaw_rate[cruising].mean() / command.yaw_rate - 1.0))
    return None


def _sideways(record: Record, push: Push | None) -> float | None:
    if push is None:
        return None
    calm = record.t >= push.start + push.duration + CALM
    return largest(record.velocity[calm, 1:2])[0]


def _forecast_error(record: Record, controller: Timed, flow: Any) -> float:
    """Compare the flow predicted a third of the horizon ahead with the one that came, both averaged over 60 ms."""
    settings = controller.configuration.settings
    ahead = settings.horizon // 3
    shift = round(ahead * settings.step / settings.period)
    predicted = record.outputs[:, controller.places["flow"]][:, ahead]
    width = np.ones(round(2 * settings.step / settings.period))
    smooth = [np.convolve(x, width / len(width), mode="valid") for x in (predicted[:-shift], flow[shift:])]
    return float(np.sqrt(np.mean((smooth[0] - smooth[1]) ** 2)) / np.mean(smooth[1]))


def worst(runs: Iterable[Figures]) -> dict[str, Any]:
    """Return the worst of each figure over the seeds, and the number of falls."""
    rows = [asdict(run) for run in runs]
    found: dict[str, Any] = {"runs": len(rows), "falls": sum(row.pop("fell") for row in rows)}
    for name in rows[0]:
        values = [row[name] for row in rows if row[name] is not None]
        found[name] = max(values) if values else None
    return found


def meets(found: dict[str, Any]) -> bool:
    """Whether the worst figures of a scenario meet the targets."""
    limits = {
        "falls": 0,
        "speed_error": 0.1,
        "roll_deg": 5.0,
        "pitch_deg": 5.0,
        "slip_share": 0.05,
        "v_y": 0.1,
    }
    return all(found[name] is None or found[name] <= limit for name, limit in limits.items())


def measure(
    seeds: int, quick: bool, workers: int, only: str = "", lag: float | None = None
) -> list[dict[str, Any]]:
    """Run the scenarios; ``quick`` shortens them to 4 s or what a push needs, ``lag`` [s] is set for all."""
    chosen = [scenario for scenario in SCENARIOS if only in scenario.name]
    if quick:
        chosen = [replace(s, duration=min(s.duration, 4.0 if s.push is None else 5.5)) for s in chosen]
    if lag is not None:
        chosen = [replace(scenario, lag=lag) for scenario in chosen]
    jobs = [(scenario, seed) for scenario in chosen for seed in range(seeds)]
    if workers > 1:
        with ProcessPoolExecutor(workers) as pool:
            runs = list(pool.map(run, *zip(*jobs, strict=True)))
    else:
        runs = [run(*job) for job in jobs]
    rows = []
    for i, scenario in enumerate(chosen):
        found = worst(runs[i * seeds : (i + 1) * seeds])
        rows.append({"scenario": scenario.name, **found, "required": scenario.required, "met": meets(found)})
    return rows


def main() -> None:
    """Measure and print."""
    command_line = parser(
        "The locomotion stack in plain MuJoCo: gaits and disturbances, the worst of some seeds."
    )
    command_line.add_argument("--quick", action="store_true", help="two seeds, 4 s each")
    command_line.add_argument("--seeds", type=int, default=0, help="10 by default, with --quick 2")
    command_line.add_argument("--workers", type=int, default=1, help="processes")
    command_line.add_argument("--only", default="", metavar="TEXT", help="scenarios whose name contains this")
    command_line.add_argument("--lag", type=float, metavar="SECONDS", help="time constant of all torques")
    arguments = command_line.parse_args()
    seeds = arguments.seeds or (2 if arguments.quick else 10)
    rows = measure(seeds, arguments.quick, arguments.workers, arguments.only, arguments.lag)
    if arguments.json:
        print(json.dumps({"seeds": seeds, "scenarios": rows}))
    else:
        show_all(rows, seeds)


def show_all(rows: list[dict[str, Any]], seeds: int) -> None:
    """Print the figures as a table."""

    def cells(row: dict[str, Any], form: str, *names: str, scale: float = 1.0) -> str:
        return " / ".join(form.format(scale * row[n]) for n in names if row[n] is not None)

    table = [
        [
            row["scenario"],
            str(row["falls"]),
            cells(row, "{:.1f}", "speed_error", scale=100.0),
            cells(row, "{:.1f}", "roll_deg", "pitch_deg"),
            cells(row, "{:.1f}", "slip_share", scale=100.0),
            cells(row, "{:.3f}", "v_y"),
            cells(row, "{:.0f}", "push_N", "pull_N"),
            cells(row, "{:.2f}", "flow_gpm", "flow_peak_gpm"),
            cells(row, "{:.1f}", "lag_error", scale=100.0),
            cells(row, "{:.2f}", "cpu_s_per_s"),
            "yes" if row["met"] else "NO" if row["required"] else "no",
        ]
        for row in rows
    ]
    heads = [
        "falls",
        "speed %",
        "roll/pitch deg",
        "slip %",
        "v_y",
        "push/pull N",
        "flow/peak gpm",
        "lag %",
        "CPU",
        "met",
    ]
    show(f"The worst of {seeds} seeds; CPU: of the controller, s a simulated second", ["", *heads], table)


if __name__ == "__main__":
    main()
