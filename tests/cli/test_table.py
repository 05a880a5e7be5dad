"""Text tables: alignment, and lines that fit a terminal of 80 columns."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from arthur_acausal.cli.table import WIDTH, count, duration, table


def test_columns_are_aligned() -> None:
    text = table([["steps", "4,301"], ["events", "12", "three of them at once"]], "lrw")
    assert text == "  steps   4,301\n  events     12  three of them at once"


def test_long_texts_wrap_under_their_column() -> None:
    lines = table([["name", "word " * 40]], "lw").split("\n")
    assert len(lines) > 2
    assert all(line.startswith(" " * 8) for line in lines[1:])


@given(st.lists(st.lists(st.text("abc ", max_size=60), min_size=2, max_size=2), max_size=5))
def test_wrapped_tables_fit(rows: list[list[str]]) -> None:
    short = [[row[0][:10], row[1]] for row in rows]
    assert all(len(line) <= WIDTH for line in table(short, "lw").split("\n"))


def test_counts_and_durations() -> None:
    assert count(1, "state") == "1 state"
    assert count(4301, "step") == "4,301 steps"
    assert count(2, "index", "indices") == "2 indices"
    assert [duration(s) for s in (2e-5, 0.0234, 3.14159, 600.0)] == ["20 µs", "23.4 ms", "3.14 s", "10 min"]
