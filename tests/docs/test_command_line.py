"""The page on the command line describes every command and every option."""

from __future__ import annotations

import typer

from arthur_acausal.cli.batch import app
from tests.docs.markdown import ROOT

PAGE = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")


def test_commands_and_options_are_described() -> None:
    command = typer.main.get_command(app)
    commands = getattr(command, "commands")  # noqa: B009 - a group has them, which its type does not say
    assert [name for name in commands if f"## arthur {name}\n" not in PAGE] == []
    options = {o for c in commands.values() for p in c.params for o in p.opts if o.startswith("--")}
    assert options
    assert sorted(o for o in options if f"`{o}" not in PAGE) == []
