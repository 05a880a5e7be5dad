"""Text tables that read well at 80 columns, on a terminal and in a file."""

from __future__ import annotations

from collections.abc import Sequence

WIDTH = 80


def table(rows: Sequence[Sequence[str]], align: str, indent: int = 2, gap: int = 2) -> str:
    """Columns below each other.

    Parameters
    ----------
    rows : the cells; a shorter row ends early.
    align : for each column "l" left, "r" right, or "w": left, and wrapped to what is left of the line (the
        last column only).
    """
    if not rows:
        return ""
    widths = [max((len(row[k]) for row in rows if k < len(row)), default=0) for k in range(len(align))]
    lines: list[str] = []
    for row in rows:
        cells = [pad(cell, widths[k], align[k]) for k, cell in enumerate(row)]
        start = " " * indent + (" " * gap).join(cells[:-1] if align[len(row) - 1] == "w" else cells)
        if align[len(row) - 1] == "w":
            lines += wrap(start + " " * gap if len(row) > 1 else start, row[-1])
        else:
            lines.append(start.rstrip())
    return "\n".join(lines)


def pad(cell: str, width: int, align: str) -> str:
    """A cell at its column's width."""
    return cell.rjust(width) if align == "r" else cell.ljust(width)


def wrap(start: str, text: str, width: int = WIDTH) -> list[str]:
    """Lines of at most ``width`` characters that begin with ``start`` or as many blanks."""
    import textwrap

    room = max(20, width - len(start))
    pieces = textwrap.wrap(text, room, break_long_words=False, break_on_hyphens=False) or [""]
    blank = " " * len(start)
    return [((start if k == 0 else blank) + piece).rstrip() for k, piece in enumerate(pieces)]


def number(value: float, digits: int = 4) -> str:
    """A number for people, with at most this many significant digits."""
    return f"{value:.{digits}g}"


def count(value: int, thing: str = "", things: str = "") -> str:
    """A count with its noun: "1 state", "12 states", "4,301 steps"."""
    noun = thing if value == 1 else things or f"{thing}s"
    return f"{value:,} {noun}" if thing else f"{value:,}"


def duration(seconds: float) -> str:
    """A wall time for people."""
    if seconds < 1e-3:
        return f"{1e6 * seconds:.0f} µs"
    if seconds < 1.0:
        return f"{1e3 * seconds:.3g} ms"
    return f"{seconds:.3g} s" if seconds < 100.0 else f"{seconds / 60.0:.3g} min"
