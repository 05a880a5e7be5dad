"""`arthur export`: a model for other tools."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from arthur_acausal.errors import UsageError, nearest
from arthur_acausal.request.locate import build_model

FORMATS = ("modelica",)


def export(model: str, form: str, settings: Sequence[str], output: Path | None) -> str:
    """Write the model, or return its text where no file is named; return what is to be printed."""
    from arthur_acausal.api import translate
    from arthur_acausal.result.atomic import check_place, write_atomically

    if form not in FORMATS:
        raise UsageError(
            f"there is no format {form!r}", remedy=nearest(form, FORMATS) or f"known: {', '.join(FORMATS)}"
        )
    if output is not None:
        check_place(output)
    built = build_model(model, settings)
    translation = translate(built.model, name=built.name, compile="never")
    stop_time = getattr(built.model, "stop_time", None)
    text = translation.to_modelica(parameters=built.parameters, stop_time=stop_time)
    if output is None:
        return text.rstrip("\n")
    write_atomically(output, text.encode())
    flat = translation.flat
    return f"wrote {output}: {flat.n_equations - len(flat.inputs):,} equations in Modelica"
