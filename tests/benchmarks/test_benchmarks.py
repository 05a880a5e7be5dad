"""The benchmarks run and print what they promise; by hand and from components the physics is the same.

No times are asserted: they depend on the machine and on what else it does.
"""

from __future__ import annotations

import math
import shutil
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

from arthur_acausal import SolverOptions, translate
from arthur_acausal.models.arthur.demo import Demo
from benchmarks import imports, scale
from benchmarks.explicit import compiled
from benchmarks.ladder import exact_voltage
from benchmarks.measure import fresh_json
from benchmarks.powertrain_byhand import flat, trot
from benchmarks.race import Idas, error, states_on
from benchmarks.rig import Rig

KEYS = {
    "translate_cold_s",
    "translate_cached_s",
    "simulate_s",
    "idas_s",
    "ratio_to_idas",
    "us_per_residual_call",
    "euler_s",
    "rk4_s",
    "load_average",
}
BY_TOLERANCE = ("simulate_s", "idas_s", "ratio_to_idas")


def test_scale_prints_its_keys_and_meets_the_exact_solution() -> None:
    figures = fresh_json(["-m", "benchmarks.scale", "--json", "--sizes", "3,30"])
    assert [row["n"] for row in figures["ladder"]] == [3, 30]
    for row in figures["ladder"]:
        assert {"n", "equations", "translate_s", "simulate_s", "peak_mb"} <= row.keys()
        assert row["equations"] == 12 * row["n"] + 8
        assert row["error_V"] < 1e-5 and row["peak_mb"] > 10
    assert figures["growth_exponent"] is None
    if figures["rumoca"] is None:
        assert "rumoca" in figures["rumoca_why"]
    else:  # another compiler, from our own export: the same ladder to the same solution
        assert [row["equations"] for row in figures["rumoca"]] == [44, 368]
        assert all(row["error_V"] < 1e-5 for row in figures["rumoca"])
        assert figures["hyd12"]["difference"] < 3e-4
    assert figures["hyd12"]["states"] == 73
    assert {"translate_s", "simulate_s", "rumoca_translate_s", "rumoca_simulate_s"} <= figures["hyd12"].keys()


def test_growth_is_the_exponent_of_a_power_law() -> None:
    assert scale.growth({n: 3e-5 * n**1.1 for n in (100, 1000, 10000)}) == pytest.approx(1.1)
    assert scale.growth({100: 1.0, 1000: 2.0}) is None


def test_the_rig_works_within_its_strokes_and_pressures() -> None:
    solution = translate(Rig(n=2)).simulate(1.0, tolerance=1e-7)
    relief = solution["relief.port_a.q"][solution.t > 0.05]
    assert relief.min() > 0.0  # the pump always delivers more than the legs take
    for k in range(2):
        assert np.abs(solution[f"cylinders[{k}].y"]).max() < 0.033  # a stop stands at 0.035
        assert min(solution[f"cylinders[{k}].p_{side}"].min() for side in "AB") > 1e5
        # The spool's steady answer to a sine, from its transfer function omega^2/(s^2 + 2 zeta omega s + omega^2).
        omega, s = 2 * math.pi * 100.0, 2j * math.pi * (2.0 + 0.2 * k)
        answer = 0.08 * omega**2 / (s**2 + 2 * 0.7 * omega * s + omega**2)
        late = solution.t > 0.1
        turning = np.exp(s * solution.t[late] + 1j * math.pi * k)
        assert solution[f"valves[{k}].x"][late] == pytest.approx((answer * turning).imag, abs=1e-5)


def test_scale_refuses_what_is_no_list_of_sizes() -> None:
    with pytest.raises(Exception, match="no list"):
        scale.sizes_of("10,x")


def test_exact_voltage_agrees_with_the_matrix_exponential() -> None:
    n, t = 7, 0.013
    A = np.diag(np.full(n, -2.0)) + np.diag(np.ones(n - 1), 1) + np.diag(np.ones(n - 1), -1)
    A[-1, -1] = -1.0
    voltages = 1 - expm(A * t / 1e-3) @ np.ones(n)
    for node in range(1, n + 1):
        assert exact_voltage(n, node, np.array([t]))[0] == pytest.approx(voltages[node - 1], abs=1e-13)


def test_nothing_heavy_is_imported_early() -> None:
    assert imports.imported_early() == []


def test_powertrain_prints_its_keys() -> None:
    # The whole command on a short piece of the demo: 16 s, most of it processes and C compilers.
    figures = fresh_json(["-m", "benchmarks.powertrain", "--json", "--stop-time", "0.01"])
    assert figures.keys() >= KEYS
    for key in BY_TOLERANCE:
        assert figures[key].keys() == {"1e-4", "1e-6"}
    numbers: list[Any] = [figures[key] for key in KEYS.difference(BY_TOLERANCE)]
    numbers += [value for key in BY_TOLERANCE for value in figures[key].values()]
    assert all(math.isfinite(value) for value in numbers if value is not None)


def test_components_and_hand_flattened_equations_agree() -> None:
    # Through the start, the opening of the relief valve (28 ms) and reversals, at a tight tolerance.
    equations = flat(trot, audit=True)
    grid = np.linspace(0.0, 0.1, 101)
    options = SolverOptions(rtol=1e-10, intervals=100)
    by_hand = Idas(equations, grid, options.step_rtol).run()
    solution = translate(Demo()).simulate(0.1, options=options)
    off = error(states_on(grid, solution, equations.paths), by_hand, equations.paths)
    assert off.worst < 1e-6, off


def test_explicit_methods_in_c_agree_with_idas() -> None:
    if shutil.which("cc") is None:
        pytest.skip("no C compiler")
    equations = flat(trot)
    reference = Idas(equations, np.linspace(0.0, 0.01, 101), 1e-11).run()
    with compiled(equations, reference[:, -1], np.ptp(reference, axis=1), 0.01) as program:
        assert program.run("rk4", 1e-6).error < 1e-5
        assert program.run("euler", 1e-7).error < 1e-3
        assert program.run("euler", 1e-4).error > 1  # far beyond its limit of stability
