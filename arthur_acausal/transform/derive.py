"""New rows out of given ones: their time derivatives and their linear combinations."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

import casadi as ca
from casadi import SX

from arthur_acausal.declare.scope import Atom
from arthur_acausal.errors import StructureError
from arthur_acausal.flatten.block import Expression
from arthur_acausal.transform.rows import Evaluator, Nodes, Ref, Row

HELD = ("parameter", "discrete", "pre", "mode", "initial", "homotopy")  # constant between events
Lookup = Callable[[Ref], SX]


class Symbols:
    """Symbols of a row that is being made: one for each ref, whatever its sign."""

    def __init__(self, nodes: Nodes) -> None:
        self._nodes = nodes
        self.of: dict[Ref, SX] = {}

    def __call__(self, ref: Ref) -> SX:
        """Return the symbol of a ref without its sign."""
        if ref.kind == "zero":
            return SX(0.0)
        plain = Ref(ref.kind, ref.number)
        if plain not in self.of:
            name = self._nodes.name(ref.number) if ref.kind == "node" else f"{ref.kind}_{ref.number}"
            self.of[plain] = SX.sym(name)
        return self.of[plain]

    def row(self, value: SX, text: str) -> Row:
        """Return the row ``value == 0``, over the symbols that it depends on."""
        used = {s.element_hash() for s in ca.symvar(value)}
        refs = [ref for ref, own in self.of.items() if own.element_hash() in used]
        kinds = {"node": "variable", "parameter": "parameter"}
        atoms = [Atom(kinds.get(r.kind, "time"), r.number) for r in refs]  # type: ignore[arg-type]
        return Row(Expression(value, [self.of[r] for r in refs], atoms), tuple(refs), text)


def differentiated(row: Row, nodes: Nodes, evaluator: Evaluator) -> Row:
    """Return the time derivative of a row, over symbols of its own."""
    symbols = Symbols(nodes)
    if row.expression.through is not None:
        raise StructureError(
            f"{row.text}: must be differentiated, but it calls an external function",
            cause="a constraint between states goes through the function, whose derivative in time is not known",
            remedy="let the function give the highest derivative (accelerations, not positions), or put an element "
            "with a state of its own (a spring, a volume) between the function and what it is rigidly joined to",
        )
    value = evaluator(row, symbols)
    total = SX(0.0)
    for ref, own in list(symbols.of.items()):
        slope = ca.jacobian(value, own)
        if slope.nnz() == 0 or ref.kind in HELD:
            continue
        if ref.kind == "input":
            raise StructureError(
                f"{row.text}: must be differentiated, but it depends on an external input",
                cause="a constraint between states contains a signal whose derivative is not known",
                remedy="pass the signal through a filter within the model",
            )
        rate = SX(1.0) if ref.kind == "time" else symbols(Ref("node", nodes.derivative_of(ref.number)))
        total = total + slope * rate
    return symbols.row(total, f"der({row.text})")


def combination(
    rows: Sequence[Row],
    factors: Callable[[Lookup], Sequence[SX]],
    without: Collection[Ref],
    nodes: Nodes,
    evaluator: Evaluator,
) -> Row:
    """Return the sum of rows times factors, functions of parameters; the nodes ``without`` cancel in it."""
    symbols = Symbols(nodes)
    values = [evaluator(row, symbols) for row in rows]
    total = sum((f * v for f, v in zip(factors(symbols), values, strict=True)), SX(0.0))
    gone = [symbol for ref, symbol in symbols.of.items() if ref in without]
    total = ca.substitute(total, ca.vertcat(*gone), SX.zeros(len(gone)))
    texts = "; ".join(dict.fromkeys(row.text for row in rows))
    return symbols.row(ca.simplify(total), f"combination of {texts}")
