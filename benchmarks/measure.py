"""How the benchmarks measure: fresh processes, the best of several runs, peak memory, the machine's load.

The least of several wall times is what the program costs; the rest is what the machine was doing besides.
Both are kept: the JSON holds the least, the tables also the median.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True, slots=True)
class Times:
    """Wall times of equal runs [s]."""

    runs: tuple[float, ...]

    @property
    def best(self) -> float:
        """The least of them [s]."""
        return min(self.runs)

    @property
    def median(self) -> float:
        """The median of them [s]."""
        return statistics.median(self.runs)


def repeat(run: Callable[[], object], times: int) -> Times:
    """Return the wall times of `times` calls of `run`."""
    runs = []
    for _ in range(times):
        begin = time.perf_counter()
        run()
        runs.append(time.perf_counter() - begin)
    return Times(tuple(runs))


def fresh_process(command: Sequence[str], environment: Mapping[str, str] | None = None) -> str:
    """Run `python COMMAND...` in a new process from the repository's root and return its standard output."""
    root = Path(__file__).resolve().parents[1]
    path = os.pathsep.join(filter(None, [str(root), os.environ.get("PYTHONPATH", "")]))
    variables = {**os.environ, "PYTHONPATH": path, **(environment or {})}
    done = subprocess.run(
        [sys.executable, *command], cwd=root, env=variables, stdout=subprocess.PIPE, check=False, text=True
    )
    if done.returncode:
        raise SystemExit(f"`python {' '.join(command)}` ended with status {done.returncode}")
    return done.stdout


def fresh_json(command: Sequence[str], environment: Mapping[str, str] | None = None) -> dict[str, Any]:
    """Run `python COMMAND...` in a new process and return the JSON object that it prints."""
    value: dict[str, Any] = json.loads(fresh_process(command, environment))
    return value


def peak_mb() -> float:
    """Return the greatest resident memory of this process so far [MB, 10^6 bytes]."""
    try:
        # ru_maxrss of a spawned process starts at its parent's peak on Linux; VmHWM is this program's own.
        status = Path("/proc/self/status").read_text()
        return float(status.partition("VmHWM:")[2].split()[0]) * 1024 / 1e6
    except (OSError, IndexError):
        size = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        return size / 1e6 if sys.platform == "darwin" else size * 1024 / 1e6


def load_average() -> float:
    """Return the machine's load average over the last minute."""
    return os.getloadavg()[0]


def parser(description: str) -> argparse.ArgumentParser:
    """Return a command line with the option that all benchmarks share."""
    command_line = argparse.ArgumentParser(description=description)
    command_line.add_argument("--json", action="store_true", help="print one JSON object and nothing else")
    return command_line


def show(title: str, heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table, its first column left, the others right, and the machine's load beneath it."""
    from rich.console import Console
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for index, head in enumerate(heads):
        table.add_column(head, justify="left" if index == 0 else "right")
    for row in rows:
        table.add_row(*row)
    console = Console(width=110)
    console.print(table)
    console.print(f"{os.cpu_count()} processors, load average {load_average():.2f}")
