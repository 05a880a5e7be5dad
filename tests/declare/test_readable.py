"""The text of a relation in events and messages."""

from __future__ import annotations

import casadi as ca
import pytest
from casadi import SX

from arthur_acausal.declare.readable import SIDE, readable

a, b, c = (SX.sym(name) for name in "abc")


@pytest.mark.parametrize(
    ("relation", "text"),
    [
        (a < 0, "a < 0"),
        (a > b, "b < a"),
        (a * (b + 1.5) <= -c, "a * (b + 1.5) <= -c"),
        (a**2 < b / c, "a**2 < b / c"),
        (ca.fmax(a, b) < ca.sin(c), "fmax(a, b) < sin(c)"),
        (ca.if_else(a, b, c) < 0, "if a then b else c < 0"),
        (0 < ca.if_else(ca.logic_and(a, ca.logic_not(b)), c, 0), "0 < if a and (not b) then c else 0"),
        (0 < 2 * ca.if_else(a == 1, b, c), "0 < 2 * (if a == 1 then b else c)"),
    ],
)
def test_a_relation_reads_as_it_was_written(relation: SX, text: str) -> None:
    assert readable(relation) == text


def test_what_is_common_to_two_places_stands_in_both() -> None:
    both = a + b
    assert readable(both * both < 1 / both) == "(a + b)**2 < 1 / (a + b)"


def test_long_sides_are_cut_and_the_direction_stays() -> None:
    names = [SX.sym(f"component_{k}") for k in range(20)]
    total = sum(names[1:], names[0])
    for text in readable(total < a), readable(a < total):
        assert len(text) <= SIDE + len("a < ") and "..." in text
    assert readable(total < a).endswith(" < a") and readable(a < total).startswith("a < ")


def test_a_deep_expression_takes_no_time() -> None:
    x = a
    for _ in range(200):
        x = ca.sin(x) * x + b * x  # as a tree it would have 3^200 leaves
    assert len(readable(x < 0)) < 100
