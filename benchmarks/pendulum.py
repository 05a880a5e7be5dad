"""The Cartesian pendulum from 24 angles at rest, and once rotating: ``python -m benchmarks.pendulum [--json]``.

m = L = 1, 100 s at rtol 1e-8: drift of the length, error of the energy over m g L + |E_0|; and the angle after 10 s at
rtol 1e-10 beside the closed form in Jacobi's elliptic functions.
"""

from __future__ import annotations

import argparse
import json
import math
from typing import Any

import numpy as np
from scipy.special import ellipj, ellipk

from arthur_acausal import Component, Equations, Real, Translation, der, parameter, translate, variable

G = 9.81  # [m/s^2]
SPIN = 8.0  # [rad/s], at the lowest point: above 2 sqrt(g / L), it goes round
REQUIRED = {"length_drift": 1e-12, "energy_error": 3e-5, "angle_error": 1e-6}


class Pendulum(Component):
    """A point mass on a rigid rod in Cartesian coordinates, index 3. ``F`` [N/m]: the rod's force over its length."""

    m: Real = parameter("kg", default=1.0)
    L: Real = parameter("m", default=1.0)
    g: Real = parameter("m/s^2", default=G)
    x: Real = variable("m")
    y: Real = variable("m")
    vx: Real = variable("m/s")
    vy: Real = variable("m/s")
    F: Real = variable("N/m")

    def equations(self) -> Equations:
        yield der(self.x) == self.vx
        yield der(self.y) == self.vy
        yield "horizontal", self.m * der(self.vx) == -self.F * self.x
        yield "vertical", self.m * der(self.vy) == -self.F * self.y - self.m * self.g
        yield "rod", self.x**2 + self.y**2 == self.L**2


def exact_angle(angle: float, speed: float, t: float) -> float:
    """Return the angle [rad] from the lowest point after t: from rest at ``angle``, or from there with ``speed``."""
    if speed:  # k < 1: sin(phi / 2) = sn(speed t / 2, k), its amplitude goes on growing
        return float(2.0 * ellipj(speed * t / 2.0, 4.0 * G / speed**2)[3])
    k = math.sin(math.remainder(angle, 2.0 * math.pi) / 2.0)
    return float(2.0 * math.asin(k * ellipj(ellipk(k**2) - math.sqrt(G) * t, k**2)[0]))


def run(translation: Translation, angle: float, speed: float) -> dict[str, Any]:
    """Simulate from one start; return its errors."""
    start = {"x": math.sin(angle), "y": -math.cos(angle)}
    start |= {"vx": speed * math.cos(angle), "vy": speed * math.sin(angle)}
    long = translation.simulate(100.0, tolerance=1e-8, start=start)
    x, y, vx, vy = (np.asarray(long[name]) for name in ("x", "y", "vx", "vy"))
    energy = 0.5 * (vx**2 + vy**2) + G * y
    short = translation.simulate(10.0, tolerance=1e-10, start=start)
    found = math.atan2(short.final("x"), -short.final("y"))
    off = math.remainder(found - exact_angle(angle, speed, 10.0), 2.0 * math.pi)
    return {
        "angle_deg": math.degrees(angle),
        "speed": speed,
        "length_drift": float(np.max(np.abs(np.hypot(x, y) - 1.0))),
        "energy_error": float(np.max(np.abs(energy - energy[0])) / (G + abs(energy[0]))),
        "angle_error": abs(off),
    }


def measure(angles: list[float]) -> list[dict[str, Any]]:
    """Return the figures of starts at rest from these angles [deg], and of the rotation."""
    translation = translate(Pendulum())
    starts = [(math.radians(a), 0.0) for a in angles] + [(0.0, SPIN)]
    return [run(translation, angle, speed) for angle, speed in starts]


def main() -> None:
    """Run all and print a table, or one JSON object."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pendulum", description=__doc__)
    parser.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    given = parser.parse_args()
    runs = measure([7.5 + 15.0 * k for k in range(24)])
    for found in runs:
        found["pass"] = all(found[name] <= limit for name, limit in REQUIRED.items())
    passed = sum(found["pass"] for found in runs)
    if given.json:
        print(json.dumps({"runs": runs, "required": REQUIRED, "passed": passed, "total": len(runs)}))
        return
    print("angle, deg  speed, rad/s  length drift  energy error  angle error, rad")
    for r in runs:
        figures = f"{r['length_drift']:12.1e}  {r['energy_error']:12.1e}  {r['angle_error']:16.1e}"
        print(f"{r['angle_deg']:10.1f}  {r['speed']:12.1f}  {figures}  {'pass' if r['pass'] else 'FAIL'}")
    print(f"{passed} of {len(runs)} pass")


if __name__ == "__main__":
    main()
