"""The cache: concurrent writers, damage of every kind, directories that cannot be written, pruning."""

from __future__ import annotations

import ctypes
import logging
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from arthur_acausal.codegen.cache import Cache, default_cache, make_key
from arthur_acausal.codegen.kernel import compiler

ROOT = Path(__file__).parents[2]


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "cache")


@pytest.fixture
def unwritable(tmp_path: Path) -> Cache:
    """A directory below a file: nobody can write there, not even root."""
    (tmp_path / "file").touch()
    return Cache(tmp_path / "file" / "cache")


def builder(content: bytes, calls: list[Path]) -> Callable[[Path], None]:
    def build(path: Path) -> None:
        calls.append(path)
        path.write_bytes(content)

    return build


def test_what_is_put_is_got(cache: Cache) -> None:
    key = make_key("x")
    assert cache.get(key) is None
    assert cache.put(key, b"content")
    assert cache.get(key) == b"content"
    assert cache.put(key, b"")
    assert cache.get(key) == b""
    assert [path.name for path in cache.directory.iterdir()] == [key]


def test_keys_differ_where_contents_do() -> None:
    keys = {
        make_key(),
        make_key(""),
        make_key("ab", "c"),
        make_key("a", "bc"),
        make_key("abc"),
        make_key(b"abd"),
    }
    assert len(keys) == 6
    assert make_key("abc") == make_key(b"abc")


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: data[:-1],
        lambda data: data[:10],
        lambda data: b"",
        lambda data: data[:40] + b"\xff" + data[41:],
        lambda data: data + b"\0",
    ],
)
def test_damaged_entry_is_found_and_removed(
    cache: Cache, damage: Callable[[bytes], bytes], caplog: pytest.LogCaptureFixture
) -> None:
    key = make_key("x")
    cache.put(key, b"content, long enough")
    path = cache.directory / key
    path.write_bytes(damage(path.read_bytes()))
    assert cache.get(key) is None
    assert "damaged" in caplog.text
    assert not path.exists()
    assert cache.put(key, b"content, long enough")
    assert cache.get(key) == b"content, long enough"


def test_library_is_built_once(cache: Cache) -> None:
    calls: list[Path] = []
    first = cache.path_of_library(make_key("lib"), builder(b"library", calls))
    second = cache.path_of_library(make_key("lib"), builder(b"library", calls))
    assert first == second
    assert first.read_bytes() == b"library"
    assert len(calls) == 1
    assert not calls[0].exists()


@pytest.mark.parametrize("damage", ["truncate", "flip", "remove"])
def test_damaged_library_is_built_anew(cache: Cache, damage: str) -> None:
    calls: list[Path] = []
    path = cache.path_of_library(make_key("lib"), builder(b"library", calls))
    if damage == "remove":
        path.unlink()
    else:
        path.write_bytes(b"lib" if damage == "truncate" else b"library!")
    path = cache.path_of_library(make_key("lib"), builder(b"library", calls))
    assert path.read_bytes() == b"library"
    assert len(calls) == 2


@pytest.mark.skipif(compiler() is None, reason="needs a C compiler")
def test_damaged_shared_object_is_not_loaded(cache: Cache, tmp_path: Path) -> None:
    source = tmp_path / "seven.c"
    source.write_text("int seven(void) { return 7; }")
    command = compiler()
    assert command is not None

    def build(path: Path) -> None:
        subprocess.run([*command, "-shared", "-fPIC", str(source), "-o", str(path)], check=True)

    path = cache.path_of_library(make_key("seven"), build)
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2])
    path = cache.path_of_library(make_key("seven"), build)
    assert ctypes.CDLL(str(path)).seven() == 7


def test_error_of_the_build_passes_and_leaves_nothing(cache: Cache) -> None:
    def build(path: Path) -> None:
        raise RuntimeError("no compiler")

    with pytest.raises(RuntimeError, match="no compiler"):
        cache.path_of_library(make_key("lib"), build)
    assert not cache.directory.exists()


def test_unwritable_directory_warns_once_and_work_goes_on(
    unwritable: Cache, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING, "arthur_acausal"):
        assert not unwritable.put(make_key("x"), b"content")
        assert not unwritable.put(make_key("y"), b"content")
        assert unwritable.get(make_key("x")) is None
        path = unwritable.path_of_library(make_key("lib"), builder(b"library", []))
    assert path.read_bytes() == b"library"
    assert len(caplog.records) == 1
    assert "going on without" in caplog.text
    del unwritable


def test_refuge_goes_with_the_cache(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    cache = Cache(tmp_path / "file")
    path = cache.path_of_library(make_key("lib"), builder(b"library", []))
    assert path.exists()
    del cache
    assert not path.exists()


def test_read_only_directory_still_serves(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(
        *_: object, **__: object
    ) -> None:  # as for a user without the right to write; root has it always
        raise PermissionError(13, "Permission denied")

    library = cache.path_of_library(make_key("lib"), builder(b"library", []))
    cache.put(make_key("x"), b"content")
    for module, name in ((tempfile, "mkstemp"), (os, "utime"), (os, "replace")):
        monkeypatch.setattr(module, name, refuse)
    assert cache.get(make_key("x")) == b"content"
    assert not cache.put(make_key("y"), b"content")
    assert cache.path_of_library(make_key("lib"), builder(b"library", [])) == library
    other = cache.path_of_library(make_key("other"), builder(b"other", []))
    assert other.parent != cache.directory
    assert other.read_bytes() == b"other"


def test_full_disk_leaves_no_temporary_file(cache: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(path: Path, data: bytes) -> int:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_bytes", full)
        assert not cache.put(make_key("x"), b"content")
    assert list(cache.directory.iterdir()) == []


def test_least_recently_used_entries_go_first(tmp_path: Path) -> None:
    cache = Cache(tmp_path, limit=5000)
    now = time.time()
    for age, name in enumerate("abcde"):
        cache.put(name, bytes(900))
        os.utime(tmp_path / name, (now - 1000 + age, now - 1000 + age))
    assert cache.get("a") is not None  # used: now the newest
    cache.put("f", bytes(900))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "c", "d", "e", "f"]


def test_abandoned_temporary_files_go(tmp_path: Path) -> None:
    old, new = tmp_path / ".new-old", tmp_path / ".new-new"
    old.touch()
    new.touch()
    os.utime(old, (time.time() - 1e5, time.time() - 1e5))
    Cache(tmp_path).prune()
    assert [path.name for path in tmp_path.iterdir()] == [".new-new"]


def test_two_processes_write_at_once(tmp_path: Path) -> None:
    code = f"""
from pathlib import Path
from arthur_acausal.codegen.cache import Cache
cache = Cache(Path({str(tmp_path)!r}), limit=400_000)
for turn in range(200):
    key = f"entry{{turn % 7}}"
    content = bytes([turn % 7]) * 20_000
    assert cache.get(key) in (None, content)
    assert cache.put(key, content)
    path = cache.path_of_library(f"lib{{turn % 3}}", lambda path: path.write_bytes(content))
    assert len(path.read_bytes()) == 20_000
"""
    processes = [
        subprocess.Popen([sys.executable, "-c", code], cwd=ROOT, stderr=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    for process in processes:
        _, errors = process.communicate(timeout=60)
        assert process.returncode == 0, errors
        assert "damaged" not in errors
    assert not list(tmp_path.glob(".new-*"))
    assert Cache(tmp_path).get("entry3") == bytes([3]) * 20_000


def test_directory_is_chosen_by_the_environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ARTHUR_CACHE_DIR", str(tmp_path))
    assert default_cache().directory == tmp_path
    assert default_cache() is default_cache()
    monkeypatch.delenv("ARTHUR_CACHE_DIR")
    assert default_cache().directory.name == "arthur-acausal"
