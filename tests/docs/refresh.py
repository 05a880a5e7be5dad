"""Rewriting the outputs that pages show: ``python -m tests.docs.refresh README.md docs/tutorial-events.md``.

Pictures that a page's commands write, and that the page shows from docs/images, are copied there. An output with
"..." in it is left as it is. Look at the changes before you commit them.
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
from pathlib import Path

from tests.docs.compare import difference
from tests.docs.markdown import ROOT, blocks
from tests.docs.runner import run_page

PICTURE = re.compile(r"!\[[^\]]*\]\(((?:docs/)?images/([\w.-]+))\)")


def refresh(file: Path, everything: bool) -> None:
    """Run one page and put in what it prints; only where that differs, unless ``everything`` is asked for."""
    page = file.read_text(encoding="utf-8")
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            runs = list(run_page(blocks(page), Path(folder)))
            for match in PICTURE.finditer(page):
                if Path(match[2]).exists():
                    copy_picture(Path(match[2]), file.parent / match[1])
                    print(f"{file.name}: {match[1]}")
        finally:
            os.chdir(before)
    for run in reversed(runs):
        if run.said is None or ("..." in run.said and not run.head):
            continue
        if everything or difference(run.said, run.printed) or bool(run.head) != ("..." in run.said):
            print(f"{file.name}:{run.line}: {run.what}")
            page = page[: run.start] + cut(run.printed, run.head) + page[run.end :]
    file.write_text(page, encoding="utf-8")


def copy_picture(source: Path, target: Path) -> None:
    """Copy a picture with at most 128 colours, which takes a third of the room and looks the same."""
    from PIL import Image

    with Image.open(source) as picture:
        picture.convert("RGB").quantize(128).save(target, optimize=True)


def cut(text: str, head: int) -> str:
    """The first ``head`` lines; all of them for 0."""
    lines = text.splitlines(keepends=True)
    return "".join([*lines[:head], "...\n"]) if 0 < head < len(lines) else text


if __name__ == "__main__":
    names = [name for name in sys.argv[1:] if not name.startswith("-")]
    for name in names:
        refresh((ROOT / name).resolve(), "--all" in sys.argv)
