"""How long `import arthur_acausal` and `arthur --help` take, each in new processes.

    python -m benchmarks.imports [--json]

Both figures hold the start of the interpreter itself, which is measured besides.
"""

from __future__ import annotations

import json
from functools import partial

from benchmarks.measure import fresh_process, load_average, parser, repeat, show

RUNS = 5
HELP = "import sys; sys.argv = ['arthur', '--help']; from arthur_acausal.cli import main; main()"
COMMANDS = {
    "python_s": ["-c", "pass"],
    "import_s": ["-c", "import arthur_acausal"],
    "help_s": ["-c", HELP],
}
HEAVY = ("scipy", "sksundae", "xarray", "pint", "mujoco", "matplotlib", "pandas")


def imported_early() -> list[str]:
    """Return the heavy packages that `import arthur_acausal` loads (none is wanted)."""
    code = f"import sys, arthur_acausal; print(*[m for m in {HEAVY!r} if m in sys.modules])"
    return fresh_process(["-c", code]).split()


def measure() -> dict[str, object]:
    """Return the best wall times [s] of each command, and what was imported though it should come later."""
    figures: dict[str, object] = {}
    for key, command in COMMANDS.items():
        fresh_process(command)  # writes the byte code, fills the page cache
        figures[key] = repeat(partial(fresh_process, command), RUNS).best
    figures["imported_early"] = imported_early()
    figures["load_average"] = load_average()
    return figures


def main() -> None:
    """Measure and print."""
    arguments = parser("Import times, in new processes.").parse_args()
    figures = measure()
    if arguments.json:
        print(json.dumps(figures))
        return
    rows = [
        ["bare python", f"{figures['python_s']:.3f}", ""],
        ["import arthur_acausal", f"{figures['import_s']:.3f}", "0.5"],
        ["arthur --help", f"{figures['help_s']:.3f}", "0.4"],
    ]
    show("Start of a new process", ["what", "best of 5, s", "required, s"], rows)
    early = figures["imported_early"]
    if early:
        print(f"imported with arthur_acausal, though only used later: {early}")


if __name__ == "__main__":
    main()
