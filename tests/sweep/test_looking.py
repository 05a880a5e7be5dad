"""Pictures, the report in a real browser, comparisons and Sobol indices against the closed forms of Ishigami."""

from __future__ import annotations

import json
import math
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import arthur_acausal.sweep
from arthur_acausal.errors import UsageError
from arthur_acausal.result.plot import write
from arthur_acausal.sweep.carry_out import How, carry_out
from arthur_acausal.sweep.compare import compare
from arthur_acausal.sweep.design import runs
from arthur_acausal.sweep.importance import importance
from arthur_acausal.sweep.opened import Sweep
from arthur_acausal.sweep.pictures import KINDS, picture
from arthur_acausal.sweep.plan import Plan
from arthur_acausal.sweep.report import content, page
from arthur_acausal.sweep.specification import from_mapping
from arthur_acausal.sweep.store import Store
from tests.sweep.models import Decay

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def stored(folder: Path, frame: dict[str, list[Any]], specification: dict[str, Any]) -> Sweep:
    """A sweep's directory with these rows, as if they had been simulated."""
    found = from_mapping({"model": "m", "stop_time": 1.0, **specification})
    rows = [dict(zip(frame, row, strict=True)) for row in zip(*frame.values(), strict=True)]
    store = Store.create(
        folder,
        {
            "specification": found.to_object(),
            "runs": len(rows),
            "factors": list(found.vary),
            "units": {},
            "trajectories": {"variables": [], "units": [], "time": []},
            "versions": {},
        },
    )
    for k, row in enumerate(rows):
        varied = {name: value for name, value in row.items() if name in found.vary}
        known = {"status": "ok", "error": "", "end_time": 1.0}
        tail = {"steps": 1, "cpu_s": 0.1, "wall_s": 0.1}
        store.add(
            {"run": k, **varied, **known, **{n: row[n] for n in row if n not in varied}, **tail}, None, k
        )
    store.fold()
    return arthur_acausal.sweep.open(folder)


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Sweep:
    folder = tmp_path_factory.mktemp("sweep") / "d"
    given = {"models": ["</script><b>"], "vary": {"tau": "0.5:2:4", "x0": "-1,1,3"}, "stop_time": 1.0}
    carry_out(Plan(from_mapping(given), Path("."), lambda _: Decay), folder, How(workers=1))
    return arthur_acausal.sweep.open(folder)


@pytest.mark.parametrize("kind", KINDS)
def test_each_picture_is_drawn_with_units(swept: Sweep, kind: str, tmp_path: Path) -> None:
    figure = picture(swept, kind)
    write(figure, tmp_path / "p.png")
    assert (tmp_path / "p.png").stat().st_size > 5000
    texts = [ax.get_xlabel() + ax.get_ylabel() for ax in figure.axes]
    texts += [tick.get_text() for ax in figure.axes for tick in ax.get_xticklabels()]
    assert any("[s]" in text for text in texts)


def test_pictures_that_cannot_be_drawn_say_why(swept: Sweep) -> None:
    with pytest.raises(UsageError, match="did you mean curves"):
        picture(swept, "curve")
    with pytest.raises(UsageError, match="did you mean tau"):
        picture(swept, "curves", x="tauu")
    with pytest.raises(UsageError, match="no trajectory of 'y'"):
        picture(swept, "fan", y="y")


def test_the_page_holds_everything_and_nothing_gets_out_of_its_place(swept: Sweep) -> None:
    text = page(swept)
    assert "&lt;/script&gt;&lt;b&gt;" in text
    assert "</script><b>" not in text
    assert not re.search(r"""(src|href)\s*=\s*["']https?:""", text[: text.index("<script>")])
    data = json.loads(text.partition('id="data">')[2].partition("</script>")[0])
    assert data["columns"]["tau"] == swept.table["tau"].tolist()
    assert (data["x"], data["colour"]) == ("tau", "x0")
    assert len(data["trajectories"]["runs"]) == 12


@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium on this machine")
@pytest.mark.parametrize("width", [412, 1280])
def test_a_browser_shows_it(swept: Sweep, tmp_path: Path, width: int) -> None:
    script = """
      document.getElementById("filter").value = "tau > 1.2"; document.getElementById("filter").oninput();
      document.querySelector("#head th:nth-child(2)").click();
      choose(7);
      const told = {rows: document.querySelectorAll("#body tr").length,
        points: document.querySelectorAll("#scatter .scatterlayer .point").length,
        lines: document.querySelectorAll("#trajectory .js-line").length,
        which: document.getElementById("which").textContent,
        first: document.querySelector("#body td:nth-child(2)").textContent,
        wide: Math.max(document.body.scrollWidth, ...[...document.querySelectorAll(".main-svg")].map(
          plot => plot.getBoundingClientRect().right)) > document.documentElement.clientWidth};
      const out = document.createElement("pre"); out.id = "told"; out.textContent = JSON.stringify(told);
      document.body.append(out);
    """
    file = tmp_path / "r.html"
    text = page(swept).replace("</body>", f"<script>{script}</script></body>")
    # no window of Chromium is narrower than 500 pixels
    text = text.replace("</style>", f"html {{ width: {width - 20}px }}</style>", 1)
    file.write_text(text, encoding="utf-8")
    command = [
        str(CHROMIUM),
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        f"--window-size={width},2000",
    ]
    command += [
        f"--user-data-dir={tmp_path}/profile",
        "--virtual-time-budget=5000",
        "--dump-dom",
        file.as_uri(),
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    told = json.loads(re.search(r'<pre id="told">(.*?)</pre>', done.stdout)[1])  # type: ignore[index]
    assert told["rows"] == 6  # two values of tau above 1.2 times three of x0
    assert told["points"] == 12
    assert told["lines"] == 13  # every run, and the chosen one above them
    assert told["which"] == "of run 7"
    assert float(told["first"]) == pytest.approx(1.5)
    assert not told["wide"]


def test_ten_thousand_runs_are_a_page_soon(tmp_path: Path) -> None:
    n = 10_000
    x = np.linspace(0, 1, n)
    sweep = stored(tmp_path / "d", {"a": x.tolist(), "max(y)": (x**2).tolist()}, {"vary": {"a": f"0:1:{n}"}})
    assert len(content(sweep)["columns"]["run"]) == n
    assert len(page(sweep)) < 10e6


def test_comparison_pairs_runs_by_their_factors(tmp_path: Path) -> None:
    a = stored(tmp_path / "a", {"k": [1.0, 2.0, 3.0], "max(y)": [1.0, 4.0, 9.0]}, {"vary": {"k": "1,2,3"}})
    b = stored(tmp_path / "b", {"k": [3.0, 2.0, 4.0], "max(y)": [9.5, 4.0, 0.0]}, {"vary": {"k": "3,2,4"}})
    found = compare(a, b)
    assert (found.common, found.only_a, found.only_b) == (2, 1, 1)
    assert found.specification == ["vary.k: '1,2,3' there, '3,2,4' now"]
    (difference,) = found.reductions
    assert (difference.largest, difference.run) == (0.5, 2)
    assert difference.rms == pytest.approx(0.5 / math.sqrt(2))
    with pytest.raises(UsageError, match="no run in common"):
        compare(a, stored(tmp_path / "c", {"k": [7.0], "max(y)": [0.0]}, {"vary": {"k": "7"}}))


def test_sobol_indices_of_the_ishigami_function(tmp_path: Path) -> None:
    given = {"vary": dict.fromkeys("abc", f"{-math.pi}:{math.pi}"), "method": "saltelli", "samples": 1024}
    design = runs(from_mapping({"model": "m", "stop_time": 1.0, **given}), tmp_path)
    a, b, c = (np.array([float(run.values[name]) for run in design]) for name in "abc")
    f = np.sin(a) * (1 + 0.1 * c**4) + 7 * np.sin(b) ** 2
    columns = {"a": a.tolist(), "b": b.tolist(), "c": c.tolist(), "final(f)": f.tolist()}
    found = importance(stored(tmp_path / "d", columns, given), "final(f)")
    # Ishigami and Homma (1990), with A = 7, B = 0.1
    v_a, v_b, v_ac = 0.5 * (1 + 0.1 * math.pi**4 / 5) ** 2, 49 / 8, 0.01 * math.pi**8 * 8 / 225
    whole = v_a + v_b + v_ac
    for i, first, total in zip(found, (v_a, v_b, 0.0), (v_a + v_ac, v_b, v_ac), strict=True):
        assert i.first == pytest.approx(first / whole, abs=0.03)
        assert i.total == pytest.approx(total / whole, abs=0.03)
        assert i.first_low <= i.first <= i.first_high
        assert i.total_low <= i.total <= i.total_high


def test_indices_need_every_run(tmp_path: Path, swept: Sweep) -> None:
    with pytest.raises(UsageError, match="method saltelli, not grid"):
        importance(swept, "final(x)")
    given = {"vary": {"a": "0:1"}, "method": "saltelli", "samples": 2}
    sweep = stored(tmp_path / "d", {"a": [0.1, 0.2], "max(y)": [1.0, 2.0]}, given)
    with pytest.raises(UsageError, match="4 of 6 runs have no value"):
        importance(sweep, "max(y)")


def test_the_indices_are_those_of_scipy(tmp_path: Path) -> None:
    from scipy.stats import sobol_indices

    given = {"vary": dict.fromkeys("ab", "0:1"), "method": "saltelli", "samples": 512}
    design = runs(from_mapping({"model": "m", "stop_time": 1.0, **given}), tmp_path)
    a, b = (np.array([float(run.values[name]) for run in design]) for name in "ab")
    f = a + a * b + 3.0
    found = importance(
        stored(tmp_path / "d", {"a": a.tolist(), "b": b.tolist(), "y(f)": f.tolist()}, given), "y(f)"
    )
    blocks = f.reshape(4, 1, 512)
    theirs = sobol_indices(func={"f_A": blocks[0], "f_B": blocks[1], "f_AB": blocks[2:]}, n=512)
    np.testing.assert_allclose([i.first for i in found], np.ravel(theirs.first_order), atol=0.02)
    np.testing.assert_allclose([i.total for i in found], np.ravel(theirs.total_order), atol=0.02)
