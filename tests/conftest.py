"""What all tests share: repeatable hypothesis runs, no display, and a closing list of what did not run."""

from __future__ import annotations

import os

import hypothesis
import pytest
from hypothesis import Phase

os.environ.setdefault("MPLBACKEND", "Agg")

# Repeatable, and no deadline: a loaded machine is no failure.
hypothesis.settings.register_profile("arthur", derandomize=True, deadline=None)
# For who asks only whether a test fails, not for the simplest example: benchmarks.mutants.
hypothesis.settings.register_profile(
    "unshrunk", hypothesis.settings.get_profile("arthur"), phases=[Phase.explicit, Phase.generate]
)
hypothesis.settings.load_profile("arthur")


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say last, in any case, which tests did not run and why: nothing is skipped silently."""
    reasons = [_reason(report) for report in terminalreporter.stats.get("skipped", [])]
    reasons += [f"{item.nodeid}: deselected" for item in terminalreporter.stats.get("deselected", [])]
    terminalreporter.section("not run")
    for reason in reasons or ["nothing: every collected test ran"]:
        terminalreporter.write_line(reason)


def _reason(report: pytest.TestReport) -> str:
    why = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
    return f"{report.nodeid}: {why}"
