"""--set and --input: what people write and what it means."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from arthur_acausal import Component, Real, Table, parameter
from arthur_acausal.errors import ArthurError, UsageError
from arthur_acausal.request.settings import quantity, read_inputs, read_settings
from arthur_acausal.units import to_si


class Rig(Component):
    """Has structural parameters of every type."""

    n: int = 12
    gain: float = 1.0
    leakage: bool = False
    law: Literal["sharp", "smooth"] = "sharp"
    label: str = "x"
    limit: float | None = None
    area: Real = parameter("m^2", default=1.0)


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("n=4", "n", 4),
        ("gain=2", "gain", 2.0),
        ("leakage=yes", "leakage", True),
        ("leakage=False", "leakage", False),
        ("law=smooth", "law", "smooth"),
        ("label=a=b", "label", "a=b"),
        ("limit=none", "limit", None),
        ("limit=0.5", "limit", 0.5),
    ],
)
def test_structural_parameters_get_their_type(text: str, name: str, value: object) -> None:
    settings = read_settings(Rig, [text])
    assert settings.structural == {name: value}
    assert type(settings.structural[name]) is type(value)
    assert settings.parameters == {}


def test_structural_parameters_are_inherited() -> None:
    class Special(Rig):
        pass

    assert read_settings(Special, ["n=3", "law=smooth"]).structural == {"n": 3, "law": "smooth"}


def test_required_parameters_of_the_model_itself_are_given_where_it_is_made() -> None:
    class Demanding(Rig):
        bore: Real = parameter("m^2")

    settings = read_settings(Demanding, ["bore=2cm^2", "n=3"])
    assert settings.structural == {"bore": "2.0 cm^2", "n": 3}
    assert settings.parameters == {}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("n=four", "--set n=four: n is a structural parameter of type int"),
        ("n=1.5", "structural parameter of type int"),
        ("leakage=maybe", "structural parameter of type bool"),
        ("law=smoth", r"law is one of sharp, smooth[\s\S]*did you mean smooth"),
        ("limit=much", "structural parameter of type float"),
        ("n", "--set n: write --set path=value"),
        ("=3", "write --set path=value"),
        ("area=", "write --set path=value"),
        ("area=big", "'big' is no number"),
    ],
)
def test_what_cannot_be_read(text: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        read_settings(Rig, [text])


def test_parameters_keep_their_unit_for_later() -> None:
    settings = read_settings(Rig, ["area=2e-6", "valves[3].dp=70bar", "n=2", "area=3mm^2"])
    assert settings.structural == {"n": 2}
    assert settings.parameters["valves[3].dp"] == "70.0 bar"
    assert settings.parameters["area"] == "3.0 mm^2", "the last one counts"


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_every_number_is_read_exactly(value: float) -> None:
    assert quantity(repr(value), "") == value
    assert to_si(quantity(f"{value!r} m", ""), "m") == value


UNITS = {"valves[0].I": "A", "motor.V": "V"}


def inputs(*texts: str) -> dict[str, Any]:
    return dict(read_inputs(texts, UNITS))


def test_constant_inputs() -> None:
    assert inputs("valves[0].I=20mA", "motor.V=24") == {"valves[0].I": pytest.approx(0.02), "motor.V": 24.0}


def test_columns_of_csv_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "run.csv"
    file.write_text("time,current,voltage\n0,1,20\n1,2,24\n")
    table = inputs(f"motor.V={file}:voltage")["motor.V"]
    assert isinstance(table, Table)
    np.testing.assert_array_equal(table.values, [20.0, 24.0])
    file = file.rename(tmp_path / "2.csv")
    file.write_text("time,current\n0,1\n1,2\n")
    monkeypatch.chdir(tmp_path)
    np.testing.assert_array_equal(inputs("motor.V=2.csv:current")["motor.V"].values, [1.0, 2.0])
    np.testing.assert_array_equal(inputs(f"motor.V={file}")["motor.V"].values, [1.0, 2.0])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("motor.U=3", r"no input 'motor\.U'[\s\S]*did you mean motor\.V"),
        ("x=3", r"no input 'x'[\s\S]*it has valves\[0\]\.I, motor\.V"),
        ("motor.V=3 A", "motor.V"),
        ("motor.V=missing.csv:a", r"missing\.csv"),
        ("motor.V=missing.csv", r"missing\.csv"),
        ("motor.V={folder}/run.csv:curent", r"no column 'curent'[\s\S]*did you mean current"),
        ("motor.V={folder}/run.csv", "several"),
        ("motor.V={folder}/text.csv", "'high' is not a number"),
        ("motor.V=", "write --input path=value"),
    ],
)
def test_inputs_that_cannot_be_read(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / "run.csv").write_text("time,current,voltage\n0,1,20\n1,2,24\n")
    (tmp_path / "text.csv").write_text("time,current\n0,high\n")
    with pytest.raises(ArthurError, match=message):
        inputs(text.format(folder=tmp_path))
