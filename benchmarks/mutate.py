"""Small random faults in Python source: the mutants of `benchmarks.mutants`.

A mutation replaces one piece of the text, so that its difference to the original is one that a person can read.
What has no meaning to a test is left alone: docstrings, messages, annotations, assertions, imports.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

_COMPARED = {
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq,
    ast.NotEq: ast.Eq,
    ast.In: ast.NotIn,
    ast.NotIn: ast.In,
    ast.Is: ast.IsNot,
    ast.IsNot: ast.Is,
}
_COMPUTED = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.BitOr: ast.BitAnd}
_SKIPPED = (ast.JoinedStr, ast.Assert, ast.Import, ast.ImportFrom, ast.Raise)
_UNTOUCHED = ("annotation", "returns", "decorator_list", "bases")
_DROPPED = (ast.Assign, ast.AugAssign, ast.Expr, ast.Continue, ast.Break)


@dataclass(frozen=True, slots=True)
class Mutation:
    """A piece of a source, its place in bytes, and what stands there instead."""

    kind: str
    line: int
    begin: int
    end: int
    text: str

    def apply(self, source: str) -> str:
        """Return the source with the mutation."""
        data = source.encode()
        return (data[: self.begin] + self.text.encode() + data[self.end :]).decode()


def mutations(source: str) -> list[Mutation]:
    """Return all mutations of a source, in the order of its text."""
    starts = [0]
    for line in source.encode().splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    found = []
    for node in _walk(ast.parse(source)):
        for kind, target, text in _variants(node):
            assert target.end_lineno is not None and target.end_col_offset is not None
            begin = starts[target.lineno - 1] + target.col_offset
            end = starts[target.end_lineno - 1] + target.end_col_offset
            found.append(Mutation(kind, target.lineno, begin, end, text))
    return found


def _walk(node: ast.AST) -> Iterator[ast.expr | ast.stmt]:
    """Every expression and statement that may be changed."""
    for name, value in ast.iter_fields(node):
        if name in _UNTOUCHED:
            continue
        for child in value if isinstance(value, list) else [value]:
            if not isinstance(child, ast.AST) or isinstance(child, _SKIPPED):
                continue
            if isinstance(child, ast.expr | ast.stmt) and not _is_docstring(child):
                yield child
            yield from _walk(child)


def _is_docstring(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def _variants(node: ast.expr | ast.stmt) -> Iterator[tuple[str, ast.expr | ast.stmt, str]]:
    """The kinds of mutation of a node, with the piece that is replaced and its new text."""
    match node:
        case ast.Compare(left, [operator], [right]) if type(operator) in _COMPARED:
            yield "comparison", node, _text(ast.Compare(left, [_COMPARED[type(operator)]()], [right]))
        case ast.BinOp(left, operator, right) if type(operator) in _COMPUTED:
            yield "arithmetic", node, _text(ast.BinOp(left, _COMPUTED[type(operator)](), right))
        case ast.BoolOp(operator, values):
            other = ast.Or() if isinstance(operator, ast.And) else ast.And()
            yield "and, or", node, _text(ast.BoolOp(other, values))
        case ast.UnaryOp(ast.Not() | ast.USub(), operand):
            yield "sign, not", node, _text(operand)
        case ast.Constant(value) if isinstance(value, bool):
            yield "constant", node, str(not value)
        case ast.Constant(value) if isinstance(value, int | float):
            yield "constant", node, f"({value + 1!r})"
            yield "constant", node, f"({value - 1!r})"
        case ast.Call(function, [first, second, *rest], keywords):
            yield "arguments", node, _text(ast.Call(function, [second, first, *rest], keywords))
        case ast.Return(value) if value is not None:
            yield "return", node, "return None"
        case ast.If(test) | ast.While(test) | ast.IfExp(test):
            yield "condition", test, _text(ast.UnaryOp(ast.Not(), test))
        case ast.Expr(ast.Call()):
            yield "early return", node, "return None"
    if isinstance(node, _DROPPED):
        yield "statement dropped", node, "pass"


def _text(node: ast.expr) -> str:
    return f"({ast.unparse(ast.fix_missing_locations(node))})"
