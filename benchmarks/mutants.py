"""How many small random faults in the compiler's graph algorithms and transformations do the tests notice?

    python -m benchmarks.mutants [--seed 1] [--count 50] [--jobs 1] [--json] [FILE ...]

Each mutant is one random change (a comparison, an operator, a constant off by one, a dropped statement, a negated
condition, an early return, swapped arguments) in `arthur_acausal/graph` or `arthur_acausal/transform`, made in a
temporary copy of the tree, one copy a job. The tests run there up to the first failure, those likeliest to fail first;
a mutant is killed if one fails, or if they do not end in time. Survivors are shown with their difference: each is a gap
in the tests, or a change without effect.
"""

from __future__ import annotations

import difflib
import json
import math
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from pathlib import Path
from queue import Queue

from benchmarks.measure import load_average, parser
from benchmarks.mutate import Mutation, mutations

ROOT = Path(__file__).resolve().parents[1]
MUTATED = ("arthur_acausal/graph", "arthur_acausal/transform")
COPIED = ("arthur_acausal", "benchmarks", "components", "models", "tests", "pyproject.toml")
Stage = tuple[str, ...]
OF_GRAPH: Stage = (
    "tests/graph",
)  # these import nothing of transform, so that a mutant there cannot fail them
OF_BOTH: tuple[Stage, ...] = (
    ("tests/transform",),
    ("tests/faults", "tests/metamorphic", "tests/codegen/test_recovery.py", "tests/flatten"),
)
PATIENCE = 3.0  # times what the tests take without a mutant, in CPU time: that of a loaded machine, too
PYTEST = """
import resource, sys, pytest
limit = int(sys.argv[1])
resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
sys.exit(pytest.main(["-x", "-q", "-p", "no:cacheprovider", "--hypothesis-profile=unshrunk", *sys.argv[2:]]))
"""


@dataclass(frozen=True, slots=True)
class Outcome:
    """A mutant and what became of it: "killed", "timeout" (killed, too) or "survived"."""

    file: str
    line: int
    kind: str
    outcome: str
    diff: str


class Copy:
    """A copy of the tree in which the tests run."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name in COPIED:
            source, target = ROOT / name, folder / name
            if source.is_dir():
                shutil.copytree(source, target, symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy(source, target)

    def read(self, file: str) -> str:
        """Return the text of a file."""
        return (self.folder / file).read_text(encoding="utf-8")

    def write(self, file: str, text: str) -> None:
        """Change a file; compiled code is known by the second in which its source was written: away with it."""
        path = self.folder / file
        path.write_text(text, encoding="utf-8")
        for compiled in (path.parent / "__pycache__").glob(f"{path.stem}.*.pyc"):
            compiled.unlink()

    def outcome(self, file: str, limits: Mapping[Stage, int]) -> str:
        """Run the tests that a mutant of the file can fail, up to the first one; ``limits``: CPU seconds of a stage."""
        for tests, limit in limits.items():
            if tests == OF_GRAPH and not file.startswith(MUTATED[0]):
                continue
            code = self.run(tests, limit)
            if code:
                return "timeout" if -code in (signal.SIGXCPU, signal.SIGKILL) else "killed"
        return "survived"

    def run(self, tests: Stage, limit: int) -> int:
        """Run tests up to the first failure and return pytest's code, or minus the signal that ended it."""
        environment = {**os.environ, "PYTHONPATH": str(self.folder)}
        environment["ARTHUR_CACHE_DIR"] = str(self.folder / "cache")
        command = [sys.executable, "-c", PYTEST, str(limit), *tests]
        done = subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, check=False)
        return done.returncode


def run(seed: int, count: int, files: list[str], jobs: int, progress: bool) -> list[Outcome]:
    """Make ``count`` random mutants, ``jobs`` at a time, and return what became of each."""
    with ExitStack() as stack:
        folders = [stack.enter_context(tempfile.TemporaryDirectory()) for _ in range(jobs)]
        copies = [Copy(Path(folder)) for folder in folders]
        candidates = [(file, mutation) for file in files for mutation in mutations(copies[0].read(file))]
        chosen = random.Random(seed).sample(candidates, count)
        pool = stack.enter_context(ThreadPoolExecutor(jobs))
        limits = {tests: math.ceil(PATIENCE * _cpu_time(copies[0], tests)) for tests in (OF_GRAPH, *OF_BOTH)}
        idle: Queue[Copy] = Queue()
        for copy in copies:
            idle.put(copy)

        def judge(number: int) -> Outcome:
            copy = idle.get()
            found = _judge(copy, *chosen[number], limits)
            idle.put(copy)
            if progress:
                print(f"{number + 1:3} {found.outcome:9} {found.file}:{found.line} {found.kind}", flush=True)
            return found

        return list(pool.map(judge, range(count)))


def _cpu_time(copy: Copy, tests: Stage) -> float:
    """Return the CPU seconds that tests take without a mutant."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    if copy.run(tests, resource.RLIM_INFINITY):
        raise SystemExit(f"without any mutant these fail: {', '.join(tests)}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _judge(copy: Copy, file: str, mutation: Mutation, limits: Mapping[Stage, int]) -> Outcome:
    original = copy.read(file)
    changed = mutation.apply(original)
    copy.write(file, changed)
    outcome = copy.outcome(file, limits)
    copy.write(file, original)
    lines = difflib.unified_diff(original.splitlines(), changed.splitlines(), file, file, n=1, lineterm="")
    return Outcome(file, mutation.line, mutation.kind, outcome, "\n".join(lines))


def main() -> None:
    """Make mutants, test them, and print what survived."""
    command_line = parser("Mutants of the compiler's graph algorithms and transformations.")
    command_line.add_argument("--seed", type=int, default=1)
    command_line.add_argument("--count", type=int, default=50)
    command_line.add_argument("--jobs", type=int, default=1, help="mutants tested at the same time")
    command_line.add_argument("files", nargs="*", help="the files to change, from the root; all by default")
    given = command_line.parse_args()
    everything = [
        str(f.relative_to(ROOT)) for folder in MUTATED for f in sorted((ROOT / folder).glob("*.py"))
    ]
    outcomes = run(given.seed, given.count, given.files or everything, given.jobs, progress=not given.json)
    survivors = [o for o in outcomes if o.outcome == "survived"]
    killed = len(outcomes) - len(survivors)
    if given.json:
        figures = {
            "seed": given.seed,
            "count": len(outcomes),
            "killed": killed,
            "score": killed / len(outcomes),
            "survivors": [asdict(o) for o in survivors],
            "load_average": load_average(),
        }
        print(json.dumps(figures))
        return
    for survivor in survivors:
        print(f"\n{survivor.diff}")
    print(f"\n{killed} of {len(outcomes)} mutants killed ({killed / len(outcomes):.0%}; required 80 %)")


if __name__ == "__main__":
    main()
