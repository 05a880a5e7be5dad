"""Commands: constants, tables, CSV files, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from arthur_acausal import UsageError
from arthur_acausal.models.arthur.locomotion.commands import Command, Constant, Table, read_commands


def test_a_constant_is_the_same_always() -> None:
    assert Constant(Command(v_x=0.5))(3.0).v_x == 0.5


def test_a_file_gives_commands_that_hold(tmp_path: Path) -> None:
    path = tmp_path / "commands.csv"
    path.write_text("t,v_x,gait\n0,0.0,stand\n1.0,0.5,trot\n2.5,0.1,walk\n")
    commands = read_commands(path)
    found = [(commands(t).v_x, commands(t).gait) for t in (-1.0, 0.5, 1.0, 2.49, 9.0)]
    assert found == [(0.0, "stand"), (0.0, "stand"), (0.5, "trot"), (0.5, "trot"), (0.1, "walk")]
    assert commands(1.0).height == Command().height


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("t,v_x\n0,fast\n", "commands.csv: row 1: v_x is 'fast'"),
        ("t,speed\n0,1\n", r"the columns are \['t', 'speed'\]"),
        ("t,gait\n0,gallop\n", "there is no gait 'gallop'"),
        ("t,height\n0,-1\n", "must be positive"),
        ("t,v_x\n0,nan\n", "not finite"),
        ("t,v_x\n1,0\n0,0\n", "must ascend"),
        ("t,v_x\n", "must ascend"),
        ("t,v_x\n0\n", "row 1 has 1 cells, not 2"),
        ("t,gait\n0,trot,9\n", "row 1 has 3 cells, not 2"),
        ("t,t\n0,1\n", "the columns are"),
        ("t\nnan\n", "must ascend"),
        ("", "the columns are"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "commands.csv"
    path.write_text(text)
    with pytest.raises(UsageError, match=message):
        read_commands(path)


def test_a_table_has_a_time_for_each_command() -> None:
    with pytest.raises(UsageError, match="one for each command"):
        Table((0.0, 1.0), (Command(),))


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="is not read"):
        read_commands(tmp_path / "none.csv")
