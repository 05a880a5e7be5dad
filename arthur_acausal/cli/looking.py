"""`arthur sweep-plot`, `compare`, `report` and `importance`: what a sweep has found."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from arthur_acausal.cli.table import count, number, table
from arthur_acausal.errors import UsageError


def plot(folder: Path, kind: str, x: str | None, y: str | None, by: str | None, output: Path) -> str:
    """Carry out ``arthur sweep-plot``."""
    from arthur_acausal.result.atomic import check_place
    from arthur_acausal.result.plot import check_format, write
    from arthur_acausal.sweep.opened import open_sweep
    from arthur_acausal.sweep.pictures import picture

    check_format(output)
    check_place(output)
    write(picture(open_sweep(folder), kind, x=x, y=y, by=by), output)
    return f"wrote {output}"


def report(folder: Path, output: Path) -> str:
    """Carry out ``arthur report``."""
    from arthur_acausal.sweep.opened import open_sweep
    from arthur_acausal.sweep.report import write_report

    write_report(open_sweep(folder), output)
    return f"wrote {output}: {output.stat().st_size / 1e6:.1f} MB, which any browser shows without a network"


def compare(first: Path, second: Path, as_json: bool) -> str:
    """Carry out ``arthur compare``."""
    from dataclasses import asdict

    from arthur_acausal.result.run import to_json
    from arthur_acausal.sweep.compare import compare as carry_out
    from arthur_acausal.sweep.opened import open_sweep

    found = carry_out(open_sweep(first), open_sweep(second))
    if as_json:
        return to_json(asdict(found))
    only = f"{found.only_a:,} only in {first}, {found.only_b:,} only in {second}"
    lines = [f"{count(found.common, 'run')} in both; {only}"]
    lines += [f"  {line}" for line in found.specification]
    if found.status:
        shown = ", ".join(map(str, found.status[:10])) + (", ..." if len(found.status) > 10 else "")
        lines.append(f"{count(len(found.status), 'run')} of another status: {shown}")
    rows = [["reduction", "rms difference", "largest", "at run", "range"]]
    rows += [
        [d.name, number(d.rms), number(d.largest), str(d.run), number(d.range)]
        for d in sorted(found.reductions, key=lambda d: -(d.rms / d.range if d.range else d.rms))
    ]
    if len(rows) > 1:
        lines += ["", table(rows, "lrrrr", indent=0)]
    return "\n".join(lines)


def importance(folder: Path, reduction: str | None, as_json: bool) -> str:
    """Carry out ``arthur importance``."""
    from dataclasses import asdict

    from arthur_acausal.sweep.importance import importance as carry_out
    from arthur_acausal.sweep.opened import open_sweep

    sweep = open_sweep(folder)
    if not sweep.reductions:
        raise UsageError(f"{folder} has no reductions")
    name = reduction or sweep.reductions[0]
    found = carry_out(sweep, name)
    if as_json:
        content: dict[str, Any] = {"reduction": name, "factors": [asdict(i) for i in found]}
        return json.dumps(content)
    rows = [["factor", "alone", "95 %", "with interactions", "95 %"]]
    rows += [
        [
            i.factor,
            f"{i.first:.3f}",
            f"{i.first_low:.3f} to {i.first_high:.3f}",
            f"{i.total:.3f}",
            f"{i.total_low:.3f} to {i.total_high:.3f}",
        ]
        for i in sorted(found, key=lambda i: -i.total)
    ]
    return f"Parts of the variance of {name} (Sobol indices)\n\n{table(rows, 'lrrrr', indent=0)}"
