"""Reading the documents: code blocks, links, headings."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = sorted(
    [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *(ROOT / "docs").glob("*.md")]
)

FENCE = re.compile(
    r"^(?P<fence>```+)(?P<info>[^`\n]*)\n(?P<text>.*?)^(?P=fence)[ \t]*$", re.MULTILINE | re.DOTALL
)
CODE = re.compile(r"(`+).*?\1", re.DOTALL)
LINK = re.compile(r"(!?)\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+(?:\([^()\s]*\))?)\)")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Block:
    """A fenced block.

    Attributes
    ----------
    kind : the first word behind the fence: "python", "console", "text".
    words : the others: "file=valve.py", "raises", "norun".
    text : its content.
    line : number of its first line in the page, from 1.
    start, end : where the content stands in the page.
    adjacent : nothing but white space stands between it and the block before.
    """

    kind: str
    words: tuple[str, ...]
    text: str
    line: int
    start: int
    end: int
    adjacent: bool

    def option(self, name: str) -> str:
        """The value of a word "name=value", or an empty text."""
        return next((w.partition("=")[2] for w in self.words if w.startswith(f"{name}=")), "")


def blocks(page: str) -> list[Block]:
    """The fenced blocks of a page, in order."""
    found: list[Block] = []
    behind = 0
    for match in FENCE.finditer(page):
        kind, *words = match["info"].split() or [""]
        start, end = match.span("text")
        line = page.count("\n", 0, start) + 1
        adjacent = bool(found) and not page[behind : match.start()].strip()
        found.append(Block(kind, tuple(words), match["text"], line, start, end, adjacent))
        behind = match.end()
    return found


def prose(page: str) -> str:
    """The page without code."""
    return CODE.sub("", FENCE.sub("", page))


def links(page: str) -> list[str]:
    """Targets of all links and pictures."""
    return [match[2] for match in LINK.finditer(prose(page))]


def anchors(page: str) -> set[str]:
    """The anchors that a code host makes for the headings."""
    seen: Counter[str] = Counter()
    found = set()
    for match in HEADING.finditer(FENCE.sub("", page)):
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", match[1]).lower()
        slug = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
        found.add(f"{slug}-{seen[slug]}" if seen[slug] else slug)
        seen[slug] += 1
    return found
