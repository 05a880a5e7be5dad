"""Running the documents: Python blocks in one namespace a page, `arthur` commands in the same folder.

A block ``python`` is run; what it prints stands in a block ``text`` directly below. ``python raises``: it must end
with an error of Arthur, whose class and text are then the output. ``python norun`` is not run. ``file=NAME``: a block
of any kind is written to that file first. In a block ``console`` each ``$ arthur ...`` and ``$ python FILE`` is run;
other commands are not.
``console head=9`` shows the first nine lines of each output only.
"""

from __future__ import annotations

import contextlib
import io
import re
import runpy
import shlex
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from typing import Any

from typer.testing import CliRunner

from arthur_acausal import ArthurError
from arthur_acausal.cli.batch import app
from tests.docs.markdown import Block

PROMPT = re.compile(r"^\$ ((?:.*\\\n)*.*)\n", re.MULTILINE)  # a backslash at the end continues the command
FAILURE = re.compile(r"^(error: |Usage: )", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Ran:
    """What one block or command printed, and what the page says that it prints.

    Attributes
    ----------
    line : where the output, or what makes it, stands in the page.
    what : the command, or the first line of the block.
    said : None where the page shows no output.
    start, end : where ``said`` stands in the page; equal where it is None.
    failed : the command's exit status was not 0.
    head : how many lines of the output the page shows; 0: all.
    """

    line: int
    what: str
    said: str | None
    printed: str
    start: int
    end: int
    failed: bool = False
    head: int = 0

    @property
    def should_fail(self) -> bool:
        """Whether the page shows a failure."""
        return "--help" not in self.what and bool(FAILURE.search(self.said or ""))


def run_page(page: list[Block], folder: Path) -> Iterator[Ran]:
    """Run a page's blocks in order; the current folder must be ``folder``.

    Raises
    ------
    AssertionError
        Where a block raises that should not, or the other way round.
    """
    namespace: dict[str, Any] = {"__name__": "page"}
    known = set(sys.modules)
    sys.path.insert(0, str(folder))  # as for a script in the folder
    try:
        yield from run_blocks(page, namespace, folder)
    finally:
        sys.path[:] = [entry for entry in sys.path if Path(entry).resolve() != folder.resolve()]
        for name in set(sys.modules) - known:  # another page may have files of the same names
            if (getattr(sys.modules[name], "__file__", None) or "").startswith(str(folder)):
                del sys.modules[name]


def run_blocks(page: list[Block], namespace: dict[str, Any], folder: Path) -> Iterator[Ran]:
    """Run the blocks one after the other."""
    for block, following in zip_longest(page, page[1:]):
        if block.kind == "python" and "norun" not in block.words:
            printed = run_python(block, namespace, folder)
            output = following if following and following.kind == "text" and following.adjacent else None
            what = block.text.partition("\n")[0]
            if output is None:
                yield Ran(block.line, what, None, printed, block.end, block.end)
            else:
                yield Ran(output.line, what, output.text, printed, output.start, output.end)
        elif block.kind == "console":
            yield from run_commands(block)
        elif block.option("file"):
            (folder / block.option("file")).write_text(block.text, encoding="utf-8")


def run_python(block: Block, namespace: dict[str, Any], folder: Path) -> str:
    """Run a block; return what it printed, and the error where one is expected."""
    name = block.option("file")
    if name:
        (folder / name).write_text(block.text, encoding="utf-8")
    code = compile(block.text, name or "page.py", "exec")
    printed = io.StringIO()
    error: Exception | None = None
    with contextlib.redirect_stdout(printed):
        try:
            exec(code, namespace)
        except ArthurError as raised:
            error = raised
    if "raises" in block.words:
        assert error is not None, f"line {block.line}: the block should raise an error"
        printed.write(f"{type(error).__name__}: {error}\n")
    elif error is not None:
        raise AssertionError(f"line {block.line}: {type(error).__name__}: {error}") from error
    return printed.getvalue()


def run_commands(block: Block) -> Iterator[Ran]:
    """Run the `arthur` commands of a console block."""
    found = list(PROMPT.finditer(block.text))
    for match, following in zip_longest(found, found[1:]):
        command = match[1].replace("\\\n", " ")
        end = following.start() if following else len(block.text)
        said = block.text[match.end() : end]
        program, *arguments = shlex.split(command)
        if program == "arthur":
            printed, failed = run_arthur(arguments)
        elif program == "python":
            printed, failed = run_script(arguments[0]), False
        else:
            continue
        line = block.line + block.text.count("\n", 0, match.end())
        place = block.start + match.end(), block.start + end
        yield Ran(line, command, said, printed, *place, failed, int(block.option("head") or 0))


def run_arthur(arguments: list[str]) -> tuple[str, bool]:
    """Run the command line; return what it printed, and whether it failed."""
    result = CliRunner().invoke(app, arguments, prog_name="arthur")
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result.output, result.exit_code != 0


def run_script(file: str) -> str:
    """Run a Python file; return what it printed."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        runpy.run_path(file, run_name="__main__")
    return printed.getvalue()
