"""One page about a sweep that needs no network: table, plots, failures, and the trajectory behind each point."""

from __future__ import annotations

import base64
import html
import json
import math
import os
import re
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from arthur_acausal.errors import UsageError
from arthur_acausal.result.atomic import write_atomically
from arthur_acausal.sweep.execute import GOOD
from arthur_acausal.sweep.opened import Sweep

MOST_NUMBERS = 1_500_000  # of trajectories in a page: 8 MB
MOST_TIMES = 200
AT_A_TIME = 500  # trajectories that are read at once, which takes half the time of one by one
TEXT = ("status", "error", "notes", "engine", "platform", "model")
OF_THE_MACHINE = (
    "platform",
    "engine",
    "attempts",
    "rejected_steps",
    "residual_evaluations",
    "jacobian_evaluations",
)


def write_report(sweep: Sweep, file: str | os.PathLike[str]) -> None:
    """Write the page. Raises UsageError for a sweep without runs, ResultError where the file cannot be written."""
    write_atomically(file, page(sweep).encode())


def page(sweep: Sweep) -> str:
    """Return the page's text."""
    from plotly.offline import get_plotlyjs

    if not len(sweep.table):
        raise UsageError(f"{sweep.folder} has no runs yet")
    template = Path(__file__).with_name("report.html").read_text(encoding="utf-8")
    title = f"Sweep of {', '.join(sweep.specification.models)}"
    # what stands in a script must not end it
    data = json.dumps(content(sweep), allow_nan=False).replace("<", "\\u003c")
    parts = {"TITLE": html.escape(title), "PLOTLY": get_plotlyjs(), "DATA": data}
    return re.sub("@(TITLE|PLOTLY|DATA)@", lambda mark: parts[mark[1]], template)


def content(sweep: Sweep) -> dict[str, Any]:
    """Return what the page shows, as JSON values; None stands for what is no number."""
    frame: Any = sweep.table
    columns = {name: _column(frame[name]) for name in frame.columns}
    numeric = [
        name
        for name in frame.columns
        if name not in TEXT and any(isinstance(v, int | float) for v in columns[name])
    ]
    reductions = [name for name in sweep.reductions if name in numeric]
    factors = [name for name in sweep.factors if name in numeric]
    ok = int(frame["status"].isin(GOOD).sum())
    failed = len(frame) - ok
    errors = frame.loc[~frame["status"].isin(GOOD), "error"]
    causes = Counter(str(error).partition("\n")[0] for error in errors)
    missing = int(sweep.about["runs"]) - len(frame)
    summary = (
        f"{len(frame):,} runs, {ok:,} ok, {failed:,} failed"
        + (f", {missing:,} still missing" if missing else "")
        + f"; {frame['cpu_s'].sum():.3g} s of CPU; Arthur {sweep.about['versions'].get('arthur', '')}"
    )
    return {
        "columns": columns,
        "numeric": numeric,
        "factors": sweep.factors,
        "shown": [name for name in frame.columns if name not in OF_THE_MACHINE],
        "units": sweep.about["units"],
        "summary": summary,
        "causes": causes.most_common(20),
        "x": (factors or ["run"])[0],
        "y": (reductions or ["wall_s"])[0],
        "colour": factors[1] if len(factors) > 1 else "",
        "trajectories": _trajectories(sweep),
    }


def _column(values: Any) -> list[Any]:
    return [
        None
        if isinstance(v, float) and not math.isfinite(v)
        else (v.item() if isinstance(v, np.generic) else v)
        for v in values.tolist()
    ]


def _trajectories(sweep: Sweep) -> dict[str, Any]:
    """Return the trajectories of as many runs as a page can hold, at no more than `MOST_TIMES` times."""
    from arthur_acausal.sweep import store

    kept = sweep.about["trajectories"]
    variables, time = list(kept["variables"]), np.array(kept["time"])
    numbers = sweep.table["run"].to_numpy()
    if not variables or not (sweep.folder / store.TRAJECTORIES).exists():
        return {"variables": [], "units": [], "time": [], "runs": [], "values": "", "note": ""}
    step = max(1, math.ceil(time.size / MOST_TIMES))
    time = time[::step]
    most = max(1, MOST_NUMBERS // (time.size * len(variables)))
    chosen = numbers[:: max(1, math.ceil(numbers.size / most))]
    array = store.open_trajectories(sweep.folder, sweep.about)
    blocks = (array.oindex[chosen[k : k + AT_A_TIME]] for k in range(0, chosen.size, AT_A_TIME))
    values = np.concatenate([block[:, :, ::step].astype("<f4") for block in blocks])
    shown = (
        ""
        if chosen.size == numbers.size
        else f"The page holds {chosen.size:,} of {numbers.size:,} trajectories."
    )
    return {
        "variables": variables,
        "units": kept["units"],
        "time": time.tolist(),
        "runs": [int(run) for run in chosen],
        "values": base64.b64encode(values.tobytes()).decode(),
        "note": shown,
    }
