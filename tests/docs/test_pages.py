"""Every Python block and every `arthur` command of the documents runs and prints what the page says."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.docs.compare import difference
from tests.docs.markdown import PAGES, ROOT, blocks
from tests.docs.runner import run_page


def runnable(page: Path) -> bool:
    return any(block.kind in ("python", "console") for block in blocks(page.read_text(encoding="utf-8")))


@pytest.mark.parametrize(
    "page", [pytest.param(page, id=str(page.relative_to(ROOT))) for page in PAGES if runnable(page)]
)
def test_page_runs_as_printed(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    wrong = []
    for run in run_page(blocks(page.read_text(encoding="utf-8")), tmp_path):
        if run.said is None:
            if run.printed:
                wrong.append(
                    f"line {run.line}: {run.what}\n  prints something that the page does not show:\n{run.printed}"
                )
        elif run.failed != run.should_fail:
            wrong.append(
                f"line {run.line}: {run.what}\n  {'failed' if run.failed else 'did not fail'}\n{run.printed}"
            )
        elif found := difference(run.said, run.printed):
            wrong.append(f"line {run.line}: {run.what}\n  {found}\n{run.printed}")
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize(
    ("said", "printed", "equal"),
    [
        ("p  206.8 bar\n", "p 206.9 bar\n", True),
        ("p  206.8 bar\n", "p 216.8 bar\n", False),
        ("a\n...\nd\n", "a\nb\nc\nd\n", True),
        ("a\n...\nd\n", "a\nb\nc\n", False),
        ("closure: 1.5e-06 of\n", "closure: 2.1e-09 of\n", True),
        ("closure: 1.5e-06 of\n", "closure: 2.1e-02 of\n", False),
        ("translation 18.1 ms\n", "translation 1.2 s\n", True),
        ("statistics\n  steps  1,186  and 7 rejected\n", "statistics\n  steps  99  and 0 rejected\n", True),
        ("steps  1,186  and 7 rejected\n", "steps  99  and 0 rejected\n", False),
        ("<Solution of Jack: 501 times>", "<Solution of Jack: 501 times>", True),
    ],
)
def test_comparison(said: str, printed: str, equal: bool) -> None:
    assert (difference(said, printed) == "") is equal
