"""What the mutants of a source are."""

from __future__ import annotations

import ast

from benchmarks.mutate import mutations

SOURCE = '''def f(a: int, b: int) -> int:
    """Größe."""
    if a < b:
        g(a, b)
    return a + 1
'''


def test_each_mutation_is_one_small_change_of_valid_source() -> None:
    found = {(m.line, m.kind, m.text) for m in mutations(SOURCE)}
    assert found == {
        (3, "condition", "(not a < b)"),
        (3, "comparison", "(a <= b)"),
        (4, "early return", "return None"),
        (4, "statement dropped", "pass"),
        (4, "arguments", "(g(b, a))"),
        (5, "return", "return None"),
        (5, "arithmetic", "(a - 1)"),
        (5, "constant", "(2)"),
        (5, "constant", "(0)"),
    }
    for mutation in mutations(SOURCE):
        changed = mutation.apply(SOURCE)
        ast.parse(changed)
        assert [a == b for a, b in zip(changed.splitlines(), SOURCE.splitlines(), strict=True)].count(
            False
        ) == 1
