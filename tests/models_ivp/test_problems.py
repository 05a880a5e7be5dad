"""The test set's problems end at its reference values, more exactly for a smaller tolerance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from arthur_acausal import Component, SimulationError, SolverOptions, Translation, translate
from arthur_acausal.models.examples.bouncing_ball import BouncingBall
from tests.models_ivp.problems import (
    CHEMICAL_AKZO,
    HIRES,
    ROBERTSON,
    ChemicalAkzo,
    Hires,
    Reference,
    Robertson,
)


@dataclass(frozen=True)
class Case:
    """A problem, its reference, and the absolute tolerances that it needs, over rtol."""

    model: Component
    reference: Reference
    atol: dict[str, float]

    def error(self, translation: Translation, rtol: float) -> float:
        """The error at the end of a run."""
        atol = {path: factor * rtol for path, factor in self.atol.items()} or None
        options = SolverOptions(rtol=rtol, atol=atol, intervals=10)
        solution = translation.simulate(self.reference.t, options=options)
        return self.reference.error({path: solution.final(path) for path in self.reference.values})


CASES = {
    "robertson": Case(Robertson(), ROBERTSON, {"y1": 1e-8, "y2": 1e-14}),
    "chemical akzo": Case(ChemicalAkzo(), CHEMICAL_AKZO, {}),
    "hires": Case(Hires(), HIRES, {}),
}


@pytest.mark.parametrize("name", CASES)
def test_the_error_goes_down_with_the_tolerance_to_what_is_required(name: str) -> None:
    case = CASES[name]
    translation = translate(case.model)
    rtols = np.array([1e-4, 1e-6, 1e-8, 1e-10])
    errors = np.array([case.error(translation, float(rtol)) for rtol in rtols])
    assert errors[-1] < case.reference.required, errors
    assert (errors < 100 * rtols).all(), errors
    # by the slope of a line through the logarithms: about one digit for each digit of the tolerance
    slope = np.polyfit(np.log10(rtols), np.log10(errors), 1)[0]
    assert slope > 0.4, errors
    assert errors[-1] < 1e-2 * errors[0], errors


def test_robertson_keeps_its_mass_and_is_of_index_1() -> None:
    translation = translate(Robertson())
    assert translation.report.states == ["y1", "y2"]
    solution = translation.simulate(1e4, options=SolverOptions(rtol=1e-6, atol={"y1": 1e-14, "y2": 1e-20}))
    total = sum(solution[path] for path in ("y1", "y2", "y3"))
    assert np.abs(total - 1.0).max() < 1e-14
    assert translation.verify(solution).largest < 1e-9


def test_akzo_s_equilibrium_holds_at_all_times() -> None:
    solution = translate(ChemicalAkzo()).simulate(180.0)
    np.testing.assert_allclose(115.83 * solution["y1"] * solution["y4"], solution["y6"], rtol=1e-13)
    assert solution["y6"][0] == pytest.approx(115.83 * 0.444 * 0.007, rel=1e-12), "not the guess of 0.36"


def test_hires_conserves_the_sum_of_two_reactants() -> None:
    solution = translate(Hires()).simulate(321.8122, tolerance=1e-8)
    np.testing.assert_allclose(solution["y7"] + solution["y8"], 0.0057, rtol=1e-8)


# Bounces of a ball from h = 1 m with e = 0.7 and g = 9.81 m/s^2, in closed form: t_1 = sqrt(2 h / g), then 2 e^k t_1
FIRST = (2.0 / 9.81) ** 0.5
BOUNCES = FIRST + np.concatenate([[0.0], np.cumsum(2 * FIRST * 0.7 ** np.arange(1, 10))])
ZENO = FIRST * (1 + 0.7) / (1 - 0.7)


def test_the_closed_form_is_that_of_the_reference() -> None:
    assert BOUNCES[0] == pytest.approx(0.4515236409857309, abs=1e-15)
    assert BOUNCES[4] == pytest.approx(2.0527167766493295, abs=1e-14)
    assert BOUNCES[9] == pytest.approx(2.473604463641254, abs=1e-14)
    assert pytest.approx(2.5586339655858077, abs=1e-14) == ZENO


@pytest.mark.parametrize("rtol", [1e-4, 1e-6, 1e-9])
def test_each_bounce_of_the_ball_is_at_its_time(rtol: float) -> None:
    solution = translate(BouncingBall(e=0.7)).simulate(2.5, tolerance=rtol)
    times = [event.time for event in solution.events if event.kind == "state"]
    np.testing.assert_allclose(times[:10], BOUNCES, atol=1e-9)  # a parabola is exact for any tolerance
    assert solution["h"].min() > -1e-9
    assert solution.final("bounces") == len(times)


def test_the_zeno_point_is_found() -> None:
    with pytest.raises(SimulationError, match="Zeno") as caught:
        translate(BouncingBall(e=0.7)).simulate(3.0)
    assert caught.value.solution.t[-1] == pytest.approx(ZENO, abs=1e-5)
