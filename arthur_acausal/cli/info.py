"""`arthur info`: a model in words, and in pictures where they are asked for."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from arthur_acausal.cli.describe import as_text
from arthur_acausal.request.locate import build_model


def describe(model: str, settings: Sequence[str], diagram: Path | None, incidence: Path | None) -> str:
    """Draw the pictures; return what is to be printed: what was drawn, or else the description."""
    from arthur_acausal.api import translate
    from arthur_acausal.result.atomic import check_place
    from arthur_acausal.result.plot import check_format, write

    for file in (diagram, incidence):
        if file is not None:
            check_format(file)
            check_place(file)
    built = build_model(model, settings)
    translation = translate(built.model, name=built.name, compile="never")
    written = []
    if diagram is not None:
        from arthur_acausal.analysis.diagram import diagram_of
        from arthur_acausal.analysis.draw import draw

        found = diagram_of(translation.flat)
        write(draw(found), diagram)
        written.append(f"wrote {diagram}: {len(found.boxes)} boxes, {len(found.lines)} lines")
    if incidence is not None:
        from arthur_acausal.analysis.incidence import draw_incidence, incidence_of

        matrix = incidence_of(translation.structured)
        write(draw_incidence(matrix), incidence)
        written.append(f"wrote {incidence}: {len(matrix.rows):,} equations in {len(matrix.blocks):,} blocks")
    return "\n".join(written) if written else as_text(translation, built.parameters)
