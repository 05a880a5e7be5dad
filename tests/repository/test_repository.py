"""What is committed stands by itself: it names no other machine's folders."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def test_no_file_names_a_folder_outside_the_repository() -> None:
    if not (ROOT / ".git").exists():
        pytest.skip("no git checkout: the list of committed files is unknown")
    outside = "/" + "work/"  # in two parts: this file is searched too
    command = ["git", "grep", "--line-number", "--text", "--fixed-strings", outside]
    found = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert found.returncode == 1, found.stdout + found.stderr


def test_the_readme_names_the_two_commands() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert "make demo" in readme and "make test" in readme
