"""Solutions on disk: what comes back, and what happens when the disk or the file is not as hoped."""

from __future__ import annotations

import json
import os
import stat
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from arthur_acausal.errors import ResultError
from arthur_acausal.result.run import Run
from arthur_acausal.result.solution import Solution
from arthur_acausal.result.store import to_bytes
from arthur_acausal.result.variable import Variable
from tests.result.sample import Table, bounce, bounce_run, disk_of

NAMES = st.from_regex(r"[a-zα-ω_][a-z0-9_]{0,5}(\[[0-9]{1,3}\])?", fullmatch=True)
PATHS = st.lists(NAMES, min_size=1, max_size=4).map(".".join)


def assert_same(loaded: Solution, original: Solution) -> None:
    assert loaded.paths == original.paths
    assert dict(loaded.variables) == dict(original.variables)
    np.testing.assert_array_equal(loaded.t, original.t)
    np.testing.assert_array_equal(loaded.values(loaded.paths), original.values(original.paths))


def test_everything_comes_back_without_the_model(tmp_path: Path) -> None:
    original, file = bounce(), tmp_path / "bounce.nc"
    original.save(file)
    loaded = Solution.load(file)
    assert_same(loaded, original)
    assert loaded.events == original.events
    np.testing.assert_array_equal(loaded.modes, original.modes)
    assert loaded.statistics.steps == 42 and loaded.options.linear_solver == "dense"
    assert loaded.parameters == {"ball.g": 2.0}
    assert loaded.versions == original.versions
    assert repr(loaded) == repr(original)
    between = np.linspace(0.0, 2.0, 31)
    for path in original.paths:
        np.testing.assert_array_equal(loaded.at(between, path), original.at(between, path))


def test_a_loaded_solution_writes_the_same_file_again(tmp_path: Path) -> None:
    file = tmp_path / "bounce.nc"
    bounce().save(file)
    assert to_bytes(Solution.load(file)) == file.read_bytes()


@given(
    values=st.dictionaries(
        PATHS, arrays.arrays(np.float64, 3, elements=st.floats(width=64)), min_size=1, max_size=6
    ),
    message=st.text(st.characters(codec="utf-8", exclude_characters="\0")),
)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
def test_any_path_and_any_value_survive(
    tmp_path: Path, values: dict[str, np.ndarray[tuple[int], np.dtype[np.float64]]], message: str
) -> None:
    variables = {path: Variable(path, description=message) for path in values}
    original = Solution(Table(np.array([0.0, 1.0, 1.0]), values, variables), Run(model="M", message=message))
    original.save(tmp_path / "x.nc")
    loaded = Solution.load(tmp_path / "x.nc")
    assert_same(loaded, original)
    assert loaded.message == message


def test_other_tools_read_it(tmp_path: Path) -> None:
    import xarray

    bounce().save(tmp_path / "bounce.nc")
    with xarray.open_dataset(tmp_path / "bounce.nc") as dataset:
        pressure = dataset["valves[1].port_a.p"]
        assert pressure.attrs["units"] == "Pa"
        assert pressure.attrs["long_name"] == "pressure at port a"
        assert pressure.attrs["path"] == "valves[1].port_a.p"
        np.testing.assert_array_equal(pressure, bounce()["valves[1].port_a.p"])
        assert dataset["ball.g"].dims == ()
        assert dataset.attrs["model"] == "Bounce"
        assert json.loads(dataset.attrs["statistics"])["steps"] == 42
        assert dataset.attrs["python_version"]


def test_a_variable_called_time_does_not_hide_the_axis(tmp_path: Path) -> None:
    t = np.array([0.0, 2.0])
    names = ["time", "time_", "t"]
    columns = {name: t * index for index, name in enumerate(names)}
    original = Solution(Table(t, columns, {name: Variable(name, "s") for name in names}))
    original.save(tmp_path / "x.nc")
    assert_same(Solution.load(tmp_path / "x.nc"), original)
    np.testing.assert_array_equal(original.to_xarray()["time"], t)


def test_numbers_that_json_lacks_are_written_as_text(tmp_path: Path) -> None:
    run = Run(options={"max_step": np.inf}, statistics={"steps": np.int64(3), "error": float("nan")})
    Solution(bounce()._values, run).save(tmp_path / "x.nc")
    loaded = Solution.load(tmp_path / "x.nc")
    assert loaded.options.max_step == "inf"
    assert loaded.statistics.steps == 3 and loaded.statistics.error == "nan"


# --- writing when it cannot be


def test_a_full_disk_leaves_the_old_file_and_no_scraps(tmp_path: Path) -> None:
    file = tmp_path / "bounce.nc"
    file.write_bytes(b"what stood here")
    message = r"cannot write .*bounce\.nc \(0\.0 MB\)[\s\S]*File too large"
    with disk_of(1000), pytest.raises(ResultError, match=message):
        bounce().save(file)
    assert file.read_bytes() == b"what stood here"
    assert os.listdir(tmp_path) == ["bounce.nc"]


@pytest.mark.parametrize("name", ["missing/x.nc", "file/x.nc"])
def test_a_place_that_is_none(tmp_path: Path, name: str) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(ResultError, match="cannot write"):
        bounce().save(tmp_path / name)


def test_a_folder_or_a_device_is_not_replaced(tmp_path: Path) -> None:
    with pytest.raises(ResultError, match="it is a folder"):
        bounce().save(tmp_path)
    with pytest.raises(ResultError, match="it is not a regular file"):
        bounce().save("/dev/full")
    assert stat.S_ISCHR(os.stat("/dev/full").st_mode)


def test_a_folder_that_may_not_be_written(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    folder = "/proc/self" if os.geteuid() == 0 else tmp_path  # the administrator may write nearly anywhere
    with pytest.raises(ResultError, match=r"Permission denied|No such file"):
        bounce().save(f"{folder}/x.nc")


def test_mode_and_links_stay(tmp_path: Path) -> None:
    file, link = tmp_path / "x.nc", tmp_path / "latest.nc"
    file.write_bytes(b"")
    file.chmod(0o640)
    link.symlink_to(file)
    bounce().save(link)
    assert link.is_symlink()
    assert stat.S_IMODE(file.stat().st_mode) == 0o640
    assert_same(Solution.load(file), bounce())


# --- reading what is no solution


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(ResultError, match=r"cannot read .*none\.nc[\s\S]*No such file"):
        Solution.load(tmp_path / "none.nc")


@pytest.mark.parametrize(
    ("content", "what"),
    [(b"", "not a NetCDF file"), (b"a,b\n1,2\n", "not a NetCDF file"), (b"\x89HDF\r\n\x1a\n", "NetCDF-4")],
)
def test_foreign_files(tmp_path: Path, content: bytes, what: str) -> None:
    (tmp_path / "x.nc").write_bytes(content)
    with pytest.raises(ResultError, match=what):
        Solution.load(tmp_path / "x.nc")


def test_a_netcdf_file_of_someone_else(tmp_path: Path) -> None:
    bounce().to_xarray("ball.h").to_netcdf(tmp_path / "x.nc", engine="scipy")
    with pytest.raises(ResultError, match="no solution of this version"):
        Solution.load(tmp_path / "x.nc")


@given(cut=st.floats(0.0, 0.9999))
def test_a_file_cut_short_is_noticed(tmp_path_factory: pytest.TempPathFactory, cut: float) -> None:
    file = tmp_path_factory.getbasetemp() / "short.nc"
    content = to_bytes(Solution(bounce()._values, bounce_run()))
    file.write_bytes(content[: int(cut * len(content))])
    with pytest.raises(ResultError):
        Solution.load(file)


@given(place=st.floats(0.0, 0.9999), bit=st.integers(0, 7))
@example(place=0.015625, bit=7)  # in the format's name, which is then no UTF-8
@settings(deadline=None)
def test_a_flipped_bit_never_changes_a_value(
    tmp_path_factory: pytest.TempPathFactory, place: float, bit: int
) -> None:
    file = tmp_path_factory.getbasetemp() / "flipped.nc"
    content = bytearray(to_bytes(Solution(bounce()._values, bounce_run())))
    content[int(place * len(content))] ^= 1 << bit
    file.write_bytes(content)
    try:
        loaded = Solution.load(file)
    except ResultError:
        return
    for path in set(loaded.paths) & set(bounce().paths):
        np.testing.assert_array_equal(loaded[path], bounce()[path])
