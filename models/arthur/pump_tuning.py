"""Tuning of the pump's controllers, each by the same search with the same number of runs of the power unit alone.

    python -m arthur_acausal.models.arthur.pump_tuning -o tuned.csv

The demand is that of a walk which starts, trots, turns and stops, recorded with feed-forward control. What is minimised
is the electrical power and, at ``PRICE`` a bar, the rms of what the pressure falls short of its bound: P_des, or where
the pressure is the controller's decision, the bound that it has set itself. Set points are not tuned but for the
constant speed, which has nothing else: over them stretches the front of power against shortfall.
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import exp, log
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import SimulationError, Solution, SolverOptions, Translation, translate
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.locomotion.commands import Command
from arthur_acausal.models.arthur.locomotion.commands import Table as CommandTable
from arthur_acausal.models.arthur.locomotion.controller import Configuration
from arthur_acausal.models.arthur.power_unit import PumpLaw
from arthur_acausal.models.arthur.pump_plant import PumpPlant, inputs_of
from arthur_acausal.models.arthur.quadruped import Quadruped
from arthur_acausal.models.arthur.walking import Walking

FloatArray = NDArray[np.float64]

PRICE = 20.0
"""Of a bar of rms shortfall [W/bar]."""
STAND = Command()
SETTLED = 0.1
"""What comes before counts not [s]."""


@dataclass(frozen=True, slots=True)
class Range:
    """Where a parameter is sought, ``low`` to ``high``; ``log`` : by its logarithm."""

    low: float
    high: float
    log: bool = False

    def at(self, share: float) -> float:
        """Return the value at a place between 0 and 1."""
        if self.log:
            return exp(log(self.low) + share * log(self.high / self.low))
        return self.low + share * (self.high - self.low)

    def place(self, value: float) -> float:
        """Return the place of a value: the inverse of ``at``."""
        if self.log:
            return log(value / self.low) / log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


PI = {"omega_c": Range(10.0, 1e4, log=True), "T_i": Range(5e-3, 1.0, log=True)}
FORWARD = PI | {"k_q": Range(0.6, 1.4)}
PROGRAM = {
    "undershoot": Range(1e-10, 1e-7, log=True),
    "smoothness": Range(1e-4, 1.0, log=True),
    "observer": Range(0.0, 1.0),
}
PREVIEW = PROGRAM | {"decay": Range(2e-3, 0.2, log=True)}
RANGES: dict[PumpLaw, dict[str, Range]] = {
    "constant speed": {"w_0": Range(150.0, 550.0)},
    "pressure": PI,
    "feed-forward": FORWARD,
    "foresight": FORWARD
    | {"lead": Range(0.0, 0.05), "span": Range(1e-3, 0.2, log=True), "peak": Range(0.0, 1.0)},
    "predictive": PREVIEW,
    "predictive pressure": PREVIEW,
    "clairvoyant": PROGRAM,
}
"""What is tuned of each controller: parameters of ``unit.control``."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """One run: its parameters, mean electrical power [W], rms shortfall [Pa], and cost [W]; inf where it failed."""

    parameters: dict[str, float]
    power: float
    shortfall: float

    @property
    def cost(self) -> float:
        """Return what is minimised [W]."""
        return self.power + PRICE * self.shortfall / 1e5


class Trial:
    """Runs of one controller with a demand; translated once."""

    def __init__(self, law: PumpLaw, demand: Demand, accumulator: bool = True) -> None:
        self.law: PumpLaw = law
        self._demand = demand
        self._plant: Translation = translate(PumpPlant(demand=demand, law=law, accumulator=accumulator))
        self._inputs = inputs_of(demand)

    def run(self, parameters: Mapping[str, float]) -> Solution:
        """Return the run with these parameters of the controller."""
        given = {f"unit.control.{name}": value for name, value in parameters.items()}
        options = SolverOptions(rtol=1e-4, output_interval=0.002)
        return self._plant.simulate(
            float(self._demand.t[-1]), inputs=self._inputs, parameters=given, options=options
        )

    def __call__(self, parameters: dict[str, float]) -> Outcome:
        """Return how good they are. A run that fails is worse than all."""
        try:
            solution = self.run(parameters)
        except SimulationError:
            return Outcome(parameters, float("inf"), float("inf"))
        counted = solution.t >= SETTLED
        t, p = solution.t[counted], solution["unit.manifold.p"][counted]
        short = np.maximum(self.bound(solution)[counted] - p, 0.0)
        power = np.trapezoid(solution["unit.motor.P_el"][counted], t) / (t[-1] - t[0])
        return Outcome(parameters, float(power), float(np.sqrt(np.trapezoid(short**2, t) / (t[-1] - t[0]))))

    def defaults(self) -> dict[str, float]:
        """Return the parameters that the controller has without tuning."""
        values = self._plant.simulate(1e-3, inputs=self._inputs)
        return {name: values.initial(f"unit.control.{name}") for name in RANGES[self.law]}

    def bound(self, solution: Solution) -> FloatArray:
        """Return the pressure that the controller shall keep [Pa], over the run."""
        kept = solution.initial("unit.control.P_des")
        if self.law != "predictive pressure":
            return np.full(solution.t.size, kept)
        margin, floor = (solution.initial(f"unit.control.{name}") for name in ("margin", "p_floor"))
        return np.clip(solution["unit.control.plan[0].p"] + margin, floor, kept)


def search(
    evaluate: Callable[[dict[str, float]], Outcome],
    ranges: Mapping[str, Range],
    begin: Mapping[str, float],
    runs: int,
    seed: int = 0,
) -> list[Outcome]:
    """Return ``runs`` outcomes: that of ``begin``, a Latin hypercube for a third, then steps about the best so far.

    The steps are normal, of a fifth of the ranges at first; they shrink by a tenth where one does not improve, and grow
    by half where it does, as in the (1+1) evolution strategy (Rechenberg 1973: one success in five keeps their size).
    """
    random = np.random.default_rng(seed)
    first = max(1, runs // 3)
    order = np.array([random.permutation(first) for _ in ranges]).T
    outcomes: list[Outcome] = []
    places = [np.array([r.place(begin[name]) for name, r in ranges.items()])]
    places += list((order + random.uniform(size=order.shape)) / first)
    step, best = 0.2, 0
    for k in range(runs):
        if k <= first:
            place = places[k]
        else:
            place = np.clip(places[best] + step * random.normal(size=len(ranges)), 0.0, 1.0)
            places.append(place)
        values = {name: r.at(float(x)) for (name, r), x in zip(ranges.items(), place, strict=True)}
        outcomes.append(evaluate(values))
        improved = outcomes[k].cost < outcomes[best].cost
        if k > first:
            step = min(step * 1.5, 0.3) if improved else step * 0.9
        best = k if improved else best
    return outcomes


def best_of(outcomes: list[Outcome]) -> Outcome:
    """Return the one of least cost."""
    return min(outcomes, key=lambda outcome: outcome.cost)


TUNED = Path(__file__).with_name("tuned.csv")
"""What the search has found: columns pump, accumulator, parameter, value."""


def tuned(law: PumpLaw, accumulator: bool = True, path: Path = TUNED) -> dict[str, float]:
    """Return the parameters of ``unit.control`` that the search has found; none where it was not carried out."""
    with path.open(newline="", encoding="utf-8") as lines:
        rows = [row for row in csv.DictReader(lines) if row["pump"] == law]
    return {r["parameter"]: float(r["value"]) for r in rows if r["accumulator"] == str(accumulator)}


def recorded(seed: int = 0) -> Demand:
    """Return the demand of a walk that starts, trots, turns and stops."""
    trot = Command(v_x=0.5)
    walk = CommandTable((0.0, 0.3, 1.8, 2.6), (STAND, trot, replace(trot, v_x=0.2, yaw_rate=0.4), STAND))
    robot = Quadruped(controller=Walking(Configuration(commands=walk, seed=seed)))
    return Demand.of(translate(robot).simulate(3.2, options=SolverOptions(rtol=1e-3, output_interval=0.002)))


def main() -> None:
    """Tune every controller, with and without the accumulator."""
    command_line = argparse.ArgumentParser(description="Tune the pump's controllers on the power unit alone.")
    command_line.add_argument("-o", "--output", type=Path, default=Path("tuned.csv"))
    command_line.add_argument("--runs", type=int, default=40, help="for each controller")
    command_line.add_argument("--seed", type=int, default=0)
    command_line.add_argument("--demand", type=Path, help="written by Demand.save, in place of the walk")
    options = command_line.parse_args()
    demand = recorded(options.seed) if options.demand is None else Demand.load(options.demand)
    with options.output.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("pump", "accumulator", "parameter", "value"))
        for accumulator in (True, False):
            for law, ranges in RANGES.items():
                trial = Trial(law, demand, accumulator)
                outcomes = search(trial, ranges, trial.defaults(), options.runs, options.seed)
                first, best = outcomes[0], best_of(outcomes)
                failed = sum(outcome.cost == float("inf") for outcome in outcomes)
                print(
                    f"{law}, accumulator {accumulator}: {best.power:.1f} W, {best.shortfall / 1e5:.2f} bar short, "
                    f"cost {best.cost:.1f} W; untuned {first.cost:.1f} W; {failed} of {len(outcomes)} runs failed",
                    flush=True,
                )
                for name, value in best.parameters.items():
                    writer.writerow((law, accumulator, name, f"{value:.4g}"))
                file.flush()


if __name__ == "__main__":
    main()
