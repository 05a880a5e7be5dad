"""Diagrams of models and their incidence matrices: what they hold, and that nothing lies upon anything."""

from __future__ import annotations

import itertools

import pytest

from arthur_acausal import Component, translate
from arthur_acausal.analysis.diagram import SIGNAL, Line, diagram_of
from arthur_acausal.analysis.draw import draw, place
from arthur_acausal.analysis.incidence import draw_incidence, incidence_of
from arthur_acausal.models.arthur.powertrain import Powertrain
from arthur_acausal.models.examples.four_bar import FourBar
from arthur_acausal.models.examples.jack import Jack
from arthur_acausal.models.examples.motor_control import MotorControl
from arthur_acausal.models.examples.rc_ladder import RCLadder
from tests.analysis.systems import Ball

MODELS = [Jack, MotorControl, FourBar, Powertrain, RCLadder, Ball]


def test_jack() -> None:
    diagram = diagram_of(translate(Jack(), name="examples.jack").flat)
    names = [box.name for box in diagram.boxes]
    assert sorted(names) == ["load", "orifice", "ram", "supply", "weight"]
    found = {(frozenset((names[x.a], names[x.b])), x.domain, x.count) for x in diagram.lines}
    assert found == {
        (frozenset(("supply", "orifice")), "hydraulic", 1),
        (frozenset(("orifice", "ram")), "hydraulic", 1),
        (frozenset(("ram", "load")), "translational", 1),
        (frozenset(("weight", "load")), "translational", 1),
    }
    assert diagram.boxes[names.index("weight")].inputs == ("f",)


def test_arrays_share_a_box() -> None:
    diagram = diagram_of(translate(RCLadder(n=10)).flat)
    names = {box.name: box for box in diagram.boxes}
    assert names["resistors[0-9]"].count == 10 and names["resistors[0-9]"].kind == "Resistor"
    own = [line for line in diagram.lines if line.a == line.b]
    assert [line.count for line in own] == [9]
    small = diagram_of(translate(RCLadder(n=2)).flat)
    assert {"resistors[0]", "resistors[1]"} <= {box.name for box in small.boxes}


def test_signals_have_a_direction() -> None:
    diagram = diagram_of(translate(MotorControl()).flat)
    names = [box.name for box in diagram.boxes]
    assert Line(names.index("controller"), names.index("amplifier"), SIGNAL) in diagram.lines
    assert Line(names.index("speed"), names.index("filter"), SIGNAL) in diagram.lines


@pytest.mark.parametrize("model", MODELS)
def test_boxes_do_not_overlap(model: type[Component]) -> None:
    placed = place(diagram_of(translate(model(), compile="never").flat))
    for p, q in itertools.combinations(placed, 2):
        apart = abs(p.x - q.x) - (p.width + q.width) / 2, abs(p.y - q.y) - (p.height + q.height) / 2
        assert max(apart) > 0.1


@pytest.mark.parametrize("model", MODELS)
def test_drawing(model: type[Component]) -> None:
    diagram = diagram_of(translate(model(), compile="never").flat)
    (axes,) = draw(diagram).axes
    texts = {text.get_text() for text in axes.texts}
    assert {box.name for box in diagram.boxes} <= texts
    assert {line.domain for line in diagram.lines} <= texts


@pytest.mark.parametrize("model", MODELS)
def test_incidence_is_block_triangular(model: type[Component]) -> None:
    structured = translate(model(), compile="never").structured
    matrix = incidence_of(structured)
    n = len(matrix.rows)
    assert len(matrix.columns) == n and sum(size for _, size in matrix.blocks) == n
    last = {row: first + size - 1 for first, size in matrix.blocks for row in range(first, first + size)}
    assert all(column <= last[row] for row, column in matrix.entries)
    assert {(k, k) for k in range(n)} <= set(matrix.entries)
    assert len(matrix.torn) == len(structured.causal.torn)
    assert draw_incidence(matrix).axes
