"""The component reference is what the components themselves say."""

from __future__ import annotations

import importlib.util

from tests.docs.markdown import ROOT


def test_component_reference_is_up_to_date() -> None:
    spec = importlib.util.spec_from_file_location("build_reference", ROOT / "docs" / "build_reference.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    written = (ROOT / "docs" / "components.md").read_text(encoding="utf-8")
    assert written == module.render(), "run: python docs/build_reference.py"
