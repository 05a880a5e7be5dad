"""Reading MJCF: the text and every file that it names, all of them data from inside the model's own folder.

MuJoCo gets the contents, never a path: what a model file says cannot make it open another file. The contents travel
with the model, so that it can be built again elsewhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path, PurePosixPath
from xml.etree import ElementTree

from arthur_acausal import UsageError
from arthur_acausal.mujoco.engine import MjModel, mujoco

FOLDERS = ("meshdir", "texturedir", "assetdir")  # attributes of <compiler>
FILES = ("file", "fileright", "fileleft", "fileup", "filedown", "filefront", "fileback")


@dataclass(frozen=True)
class Source:
    """A model as data: the MJCF text, the files that it names (name -> content), and what messages call it."""

    text: str
    assets: dict[str, bytes] = field(default_factory=dict)
    name: str = "MJCF"

    def __hash__(self) -> int:
        return hash((self.text, *sorted(self.assets)))


def read(mjcf: str | Path) -> Source:
    """Return the model in an MJCF file, or in a text that is MJCF itself.

    Files that the model includes, and meshes, textures and height fields, are read from the folder of the file and
    below; a text may not name files. Raises UsageError where a file is missing, stands outside of the folder, or is
    no XML.
    """
    if isinstance(mjcf, str) and "<" in mjcf:
        source = Source(mjcf)
        for name in _named(_parse(mjcf, source.name)):
            raise UsageError(
                f"the MJCF text names the file {name!r}",
                remedy="write the model into a file beside it, and give the path of that file",
            )
        return source
    path = Path(mjcf)
    text = _text(path, path.name)
    assets: dict[str, bytes] = {}
    _collect(_parse(text, path.name), path.parent.resolve(), PurePosixPath(), {""}, assets, path.name)
    return Source(text, assets, path.name)


@lru_cache(maxsize=32)
def build(source: Source) -> MjModel:
    """Compile the model with MuJoCo, as it is written. Whoever changes it takes a copy."""
    try:
        return mujoco().MjModel.from_xml_string(source.text, source.assets)
    except (ValueError, mujoco().FatalError) as error:
        line = re.search(r"line (\d+)", str(error))
        raise UsageError(
            "MuJoCo cannot read the model",
            where=f"{source.name}:{line[1]}" if line else source.name,
            cause=" ".join(str(error).split()),
        ) from error


def _text(path: Path, name: str) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        cause = error.strerror if isinstance(error, OSError) else "not UTF-8"
        raise UsageError(
            f"cannot read the MJCF file {name}",
            cause=str(cause),
            remedy="give the path of an MJCF file, or the MJCF text",
        ) from error


def _parse(text: str, name: str) -> ElementTree.Element:
    """Return the root element. A document type is refused: its entities may grow without bound."""
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise UsageError(f"{name} declares a document type or entities", remedy="remove the declaration")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise UsageError(
            f"{name} is not XML", where=f"{name}:{error.position[0]}", cause=str(error)
        ) from error
    if root.tag not in ("mujoco", "mujocoinclude"):
        raise UsageError(
            f"{name} is not MJCF: its root element is <{root.tag}>",
            remedy="convert it with MuJoCo (a URDF: mujoco.MjSpec.from_file(...).to_xml())",
        )
    return root


def _named(root: ElementTree.Element) -> Iterator[str]:
    """Yield the names of all files that a document uses."""
    for element in root.iter():
        for attribute in FILES:
            if name := element.get(attribute):
                yield name


def received(text: str, assets: dict[str, bytes], name: str) -> Source:
    """Return a model that came as data, with all files that it names.

    Raises UsageError where it names a file that did not come with it: MuJoCo would look for it on this machine.
    """
    documents = {PurePosixPath(name): text}
    documents |= {
        PurePosixPath(file): content.decode() for file, content in assets.items() if file.endswith(".xml")
    }
    roots = {place: _parse(content, str(place)) for place, content in documents.items()}
    folders = {value for root in roots.values() for value in _folders(root)}
    for place, root in roots.items():
        for wanted in _named(root):
            if not any(str(_inside(file, name)) in assets for file in _places(place.parent, folders, wanted)):
                raise UsageError(f"{name} names the file {wanted!r}, which did not come with it")
    return Source(text, assets, name)


def _folders(root: ElementTree.Element) -> set[str]:
    """Return the folders in which a document says that files are."""
    return {value for c in root.iter("compiler") for attribute in FOLDERS if (value := c.get(attribute))}


def _places(here: PurePosixPath, folders: set[str], wanted: str) -> set[PurePosixPath]:
    """Return where MuJoCo may look for a file."""
    names = {wanted, PurePosixPath(wanted).name}
    return {PurePosixPath(start, name) for start in {str(here), "", *folders} for name in names}


def _inside(file: PurePosixPath, name: str) -> PurePosixPath:
    """Return the place of a file. Raises UsageError where it is none in the model's folder or below."""
    if file.is_absolute() or ".." in file.parts or "\\" in str(file):
        raise UsageError(
            f"{name} names the file {file}, which is outside of the model's folder",
            remedy="copy the file into the folder",
        )
    return file


def _collect(
    root: ElementTree.Element,
    folder: Path,
    here: PurePosixPath,
    folders: set[str],
    assets: dict[str, bytes],
    name: str,
) -> None:
    """Read what a document names into ``assets``; ``here``: where it stands itself, from ``folder``."""
    folders |= _folders(root)
    for wanted in _named(root):
        found = False
        for file in _places(here, folders, wanted):
            found |= _read(file, folder, folders, assets, name)
        if not found:
            raise UsageError(
                f"{name} names the file {wanted!r}, which is not there",
                remedy="files are looked up in the folder of the model and those that <compiler> names",
            )


def _read(file: PurePosixPath, folder: Path, folders: set[str], assets: dict[str, bytes], name: str) -> bool:
    """Read one file, and what it names if it is MJCF; False if there is none."""
    path = (folder / _inside(file, name)).resolve()
    if not path.is_relative_to(folder):  # by a symbolic link
        raise UsageError(
            f"{name} names the file {file}, which is outside of the model's folder",
            remedy="copy the file into the folder",
        )
    if str(file) in assets:
        return True
    if not path.is_file():
        return False
    assets[str(file)] = path.read_bytes()
    if file.suffix == ".xml":
        _collect(_parse(_text(path, str(file)), str(file)), folder, file.parent, folders, assets, str(file))
    return True
