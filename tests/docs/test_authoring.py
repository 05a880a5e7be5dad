"""The authoring reference names everything that is public, with the right signatures."""

from __future__ import annotations

import ast
import inspect

import pytest

import arthur_acausal
from tests.docs.markdown import ROOT, blocks

PAGE = (ROOT / "docs" / "authoring.md").read_text(encoding="utf-8")
SIGNATURES = next(block.text for block in blocks(PAGE) if "signatures" in block.words).splitlines()


@pytest.mark.parametrize("name", arthur_acausal.__all__)
def test_public_name_is_described(name: str) -> None:
    assert f"`{name}" in PAGE or any(line.startswith(f"{name}(") for line in SIGNATURES)


@pytest.mark.parametrize("line", SIGNATURES)
def test_signature(line: str) -> None:
    name = line.partition("(")[0]
    value = arthur_acausal
    for part in name.split("."):
        value = getattr(value, part)
    said = ast.parse(f"def f{line.removeprefix(name)}: ...").body[0]
    assert isinstance(said, ast.FunctionDef)
    names = [a.arg for a in (*said.args.args, *said.args.kwonlyargs)]
    assert callable(value)
    real = [p for p in inspect.signature(value).parameters.values() if p.name != "self"]
    plain = [p.name for p in real if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
    assert names == plain


def test_options_are_described() -> None:
    assert [o for o in arthur_acausal.SolverOptions.__slots__ if f"`{o}`" not in PAGE] == []
