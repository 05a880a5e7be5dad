"""The component reference is what the components themselves say."""

from __future__ import annotations

import importlib.util

from tests.docs.markdown import ROOT


def test_component_reference_is_up_to_date() -> None:
    spec = importlib.util.spec_from_file_location("build_reference", ROOT / "docs" / "build_reference.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    docs = ROOT / "docs"
    written = [docs / "components.md", *(docs / "components").iterdir()]
    found = {str(page.relative_to(docs)): page.read_text(encoding="utf-8") for page in written}
    made = module.render()
    changed = sorted(page for page in found.keys() | made.keys() if found.get(page) != made.get(page))
    assert not changed, "run: python docs/build_reference.py"
