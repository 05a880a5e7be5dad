"""Which design makes the rotary valve win: what is varied, and what is asked of each design."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import Solution, UsageError
from arthur_acausal.models.arthur.valves.strokes import GPM

TARGET_GPM = 0.5
"""The flow at which designs are compared: the spool valve's."""

DESIGNS: dict[str, Any] = {
    "vary": {
        "r_c": "2 mm:5 mm",
        "d_p": "0.53 mm:0.7 mm",
        "delta_r": "3 um:20 um",
        "mu_k": "0.002:0.1/log",
        "offset": "0:0.3",
        "pressure_load": ["signed", "balanced"],
        "line": ["laminar", "turbulent"],
    },
    # The overlap stays as long as the case study's, 34 um; the cylinder is as high as its ports need.
    "derive": {"gap": "d_p / r_c + 68e-6 / r_c", "h": "10 / 3 * d_p"},
    "method": "lhs",
    "tolerance": 1e-5,
    "output": {
        "trajectories": False,
        "reductions": ["arthur_acausal.models.arthur.valves.design:to_flow"],
    },
}
"""The sweep of `RotaryStroke`, as designed: luck in the printing comes after. Narrower ports than the case study's;
friction from a needle bearing's on."""

SCATTER = {"phi_error": "normal(0, 0.05)"}
"""The printing's (4.1.1): the jet's angle [rad] is off by about 3 deg, assumed."""


def printed_again(best: Mapping[str, Any]) -> dict[str, Any]:
    """Return the sweep of one design, as `design_numbers` gives the best, over the printing's scatter only."""
    return {**DESIGNS, "vary": SCATTER, "set": dict(best), "method": "random"}


def printed_numbers(work: Sequence[float], spool: float) -> dict[str, float]:
    """Return what the works [J] of `printed_again` come to, against the spool valve's."""
    found = np.asarray(work, dtype=float)
    return {
        "designs": len(found),
        "wins": int((found < spool).sum()),
        "least_uJ": float(found.min()) * 1e6,
        "median_uJ": float(np.median(found)) * 1e6,
        "most_uJ": float(found.max()) * 1e6,
    }


def to_flow(run: Solution) -> dict[str, float]:
    """Return the works [J] to the flow of the comparison, and at which opening [1]; NaN where it is not reached."""
    s = float(np.interp(TARGET_GPM * GPM, run["Q_A"], run["s"], right=np.nan))
    return {"s": s} | {
        name: float(np.interp(s, run["s"], run[name])) for name in ("W_with_jet", "W_no_jet", "W_jet")
    }


def design_numbers(table: Mapping[str, Sequence[Any]], spool: float) -> dict[str, Any]:
    """Return how many designs need less work [J] than the spool valve, what they share, and the best one.

    ``table``: the sweep's, by columns. The rank correlation (Spearman) of a factor says how much it moves the work.
    """
    work = np.asarray(table["to_flow.W_with_jet"], dtype=float)
    reached = np.isfinite(work)
    if not reached.any():
        raise UsageError(
            f"none of {len(work)} rotary valves passes {TARGET_GPM} gpm",
            remedy="draw more of them: --designs 200",
        )
    wins = reached & (work < spool)
    words = ("pressure_load", "line")
    values = {name: np.asarray(table[name], dtype=float) for name in DESIGNS["vary"] if name not in words}
    balanced = np.asarray([str(word) == "balanced" for word in table["pressure_load"]])
    turbulent = np.asarray([str(word) == "turbulent" for word in table["line"]])
    best = int(np.nanargmin(work))
    return {
        "designs": len(work),
        "reach_the_flow": int(reached.sum()),
        "win_with_jets": int(wins.sum()),
        "win_balanced": int((wins & balanced).sum()),
        "win_unbalanced": int((wins & ~balanced).sum()),
        "win_turbulent": int((wins & turbulent).sum()),
        "best_turbulent_uJ": float(np.nanmin(work[turbulent & reached], initial=np.inf)) * 1e6,
        "win_without_jets": int((np.asarray(table["to_flow.W_no_jet"], dtype=float) < spool).sum()),
        "spool_uJ": spool * 1e6,
        "best_uJ": float(work[best]) * 1e6,
        "best": {name: float(x[best]) for name, x in values.items()}
        | {word: str(table[word][best]) for word in words},
        "rank_correlation": {name: correlation(x[reached], work[reached]) for name, x in values.items()},
        "median_of_winners": {
            name: float(np.median(x[wins])) if wins.any() else None for name, x in values.items()
        },
    }


def correlation(x: NDArray[np.float64], y: NDArray[np.float64]) -> float:
    """Return the correlation of ranks; NaN of fewer than two."""
    if len(x) < 2:
        return float("nan")
    ranks = [np.argsort(np.argsort(values)).astype(float) for values in (x, y)]
    return float(np.corrcoef(ranks[0], ranks[1])[0, 1])
