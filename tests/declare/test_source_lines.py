"""Every equation knows the file and line that it was written in."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from arthur_acausal import Component, Equations, Real, connect, variable
from arthur_acausal.declare.authored import authored, calling_line, place
from arthur_acausal.errors import DeclarationError, UnitError
from arthur_acausal.flatten.flatten import flatten
from tests.circuit import Ground, Resistor, TwoPin, Voltage

HERE = Path(__file__)


def line_of(mark: str, file: Path = HERE) -> str:
    """file:line of the only line that ends in a mark."""
    lines = [
        k for k, text in enumerate(file.read_text(encoding="utf-8").splitlines(), 1) if text.endswith(mark)
    ]
    assert len(lines) == 1, mark
    return f"{file.name}:{lines[0]}"


def several(component: Any) -> Iterator[Any]:
    yield "from a helper", component.c == 3  # helper


class Lines(Component):
    a: Real = variable("1")
    b: Real = variable("1")
    c: Real = variable("1")
    d: Real = variable("1")
    e: Real = variable("1")

    def equations(self) -> Equations:
        yield self.a == 1  # one
        yield (
            "a long one",
            self.b == self.a,
        )  # two
        yield from several(self)
        for x in (self.d, self.e):
            yield x == self.a  # loop


def test_statements_loops_and_helpers() -> None:
    flat = flatten(Lines())
    found = [e.equation.where for e in flat.equations]
    assert found[0] == line_of("# one")
    first, last = (int(w.split(":")[1]) for w in (found[1], line_of("# two")))
    assert last - 3 <= first <= last, "any line of a statement that takes several"
    assert found[2] == line_of("# helper")
    assert found[3] == found[4] == line_of("# loop")
    assert [e.equation.label for e in flat.equations] == ["", "a long one", "from a helper", "", ""]


def test_equations_of_the_base_class_keep_their_own_file() -> None:
    class Circuit(Component):
        source = Voltage()
        load = Resistor()
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.load.p)  # first connection
            yield connect(self.source.n, self.load.n)
            yield connect(self.source.n, self.ground.p)

    flat = flatten(Circuit())
    circuit = HERE.parents[1] / "circuit.py"
    where = {e.equation.label: e.equation.where for e in flat.equations if e.path == "load"}
    source = circuit.read_text(encoding="utf-8").splitlines()
    for label, text in [("Ohm's law", "self.R * self.i"), ("", "self.p.i + self.n.i")]:
        name, line = where[label].split(":")
        assert name == "circuit.py"
        assert text in source[int(line) - 1]
    assert flat.aliases[0].where == line_of("# first connection")


def test_a_text_of_an_equation_names_path_label_and_line() -> None:
    class Whole(Component):
        part = Resistor()
        x: Real = variable("1")

        def equations(self) -> Equations:
            yield self.x == 2 * self.x + 1  # unlabelled

    flat = flatten(Whole())
    texts = [e.text for e in flat.equations]
    assert f"x == ((2.*x)+1) ({line_of('# unlabelled')})" in texts
    assert any(t.startswith('part "Ohm\'s law" (circuit.py:') for t in texts)


def test_a_class_reads_the_same_in_all_its_places() -> None:
    class Pair(Component):
        def build(self) -> None:
            self.items = [Resistor() for _ in range(2)]

    flat = flatten(Pair())
    texts = [e.text for e in flat.equations if e.path == "items[1]"]
    assert texts and not any("items[0]" in t for t in texts)


def test_the_line_that_is_run_and_the_error_in_it() -> None:
    number = int(calling_line().split(":")[1])
    assert "calling_line().split" in HERE.read_text(encoding="utf-8").splitlines()[number - 1]
    assert place("/a/b.py", 7) == "b.py:7"
    with pytest.raises(DeclarationError) as caught, authored("work", "path.of.it"):
        raise RuntimeError("it broke")  # the author's fault
    error = caught.value
    assert (error.path, error.where) == ("path.of.it", line_of("# the author's fault"))
    assert "work failed: it broke" in str(error)
    assert isinstance(error.__cause__, RuntimeError)


def test_an_error_of_ours_within_the_author_s_code_keeps_what_it_knows() -> None:
    with pytest.raises(UnitError) as caught, authored("work", "outer"):
        raise UnitError("wrong", path="inner", where="there.py:1")
    assert (caught.value.path, caught.value.where) == ("inner", "there.py:1")


def test_interrupts_pass() -> None:
    with pytest.raises(KeyboardInterrupt), authored("work", "path"):
        raise KeyboardInterrupt


class Half(TwoPin):
    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == undefined_name * self.i  # type: ignore[name-defined]  # noqa: F821  # oops


def test_a_python_error_in_an_equation_is_told_with_its_line() -> None:
    with pytest.raises(DeclarationError, match="name 'undefined_name' is not defined") as caught:
        flatten(Half())
    assert caught.value.where == line_of("# oops")
    assert caught.value.path == "Half"
