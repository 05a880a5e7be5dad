"""Files are data from the model's own folder; what cannot be a pure function is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from arthur_acausal import DeclarationError, UsageError
from arthur_acausal.mujoco.layout import layout
from arthur_acausal.mujoco.load import build, read
from arthur_acausal.mujoco.purity import pure
from tests.mujoco.models import QUADRUPED, joints

CUBE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 5\n"


def write(folder: Path, mesh: str = "cube.obj", include: str = "parts/more.xml") -> Path:
    """A model with a mesh and an include, in folders of their own."""
    (folder / "robot" / "meshes").mkdir(parents=True)
    (folder / "robot" / "parts").mkdir()
    (folder / "robot" / "meshes" / "cube.obj").write_text(CUBE)
    (folder / "secret.obj").write_text(CUBE)
    (folder / "robot" / "parts" / "more.xml").write_text(
        f'<mujoco><asset><mesh name="b" file="{mesh}"/></asset></mujoco>'
    )
    model = folder / "robot" / "robot.xml"
    model.write_text(
        f'<mujoco><compiler meshdir="meshes"/><include file="{include}"/><worldbody>'
        '<body><freejoint/><geom type="mesh" mesh="b"/></body></worldbody></mujoco>'
    )
    return model


def test_includes_and_assets_come_from_the_folder_of_the_model(tmp_path: Path) -> None:
    source = read(write(tmp_path))
    assert build(source).nmesh == 1
    assert set(source.assets) == {"meshes/cube.obj", "parts/more.xml"}


@pytest.mark.parametrize(
    ("mesh", "include"),
    [
        ("../../secret.obj", "parts/more.xml"),
        ("{tmp}/secret.obj", "parts/more.xml"),
        ("link.obj", "parts/more.xml"),
        ("cube.obj", "../outside.xml"),
    ],
)
def test_a_model_cannot_reach_out_of_its_folder(tmp_path: Path, mesh: str, include: str) -> None:
    model = write(tmp_path, mesh.format(tmp=tmp_path), include)
    (tmp_path / "outside.xml").write_text("<mujoco/>")
    (tmp_path / "robot" / "meshes" / "link.obj").symlink_to(tmp_path / "secret.obj")
    with pytest.raises(UsageError, match="outside of the model's folder"):
        read(model)


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"more\.xml names the file 'sphere\.obj'"):
        read(write(tmp_path, "sphere.obj"))
    with pytest.raises(UsageError, match=r"cannot read the MJCF file none\.xml"):
        read(tmp_path / "none.xml")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('<mujoco><include file="a.xml"/></mujoco>', "names the file 'a.xml'"),
        ('<!DOCTYPE x [<!ENTITY a "b">]><mujoco/>', "document type"),
        ("<mujoco>", "is not XML"),
        ('<robot name="a"><link name="b"/></robot>', "is not MJCF"),
    ],
)
def test_a_text_that_is_no_model_is_refused(text: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        read(text)


def test_what_mujoco_says_against_a_model_comes_with_its_line() -> None:
    with pytest.raises(UsageError, match="mass and inertia") as caught:
        build(read("<mujoco><worldbody>\n<body><joint/></body></worldbody></mujoco>"))
    assert caught.value.where == "MJCF:2"


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        (joints(option='<option integrator="discrete"/>'), "discrete"),
        (joints(option='<option><flag sleep="enable"/></option>'), "asleep"),
        (joints(actuator='<pid joint="j" kp="1" slewmax="1"/>'), "has a state that only MuJoCo"),
        (joints(actuator='<pid name="servo" joint="j" kp="1" ki="1"/>'), "'servo' has a state"),
        (joints(actuator='<position joint="j" kp="1" delay="0.01" nsample="8"/>'), "delay"),
        (joints(actuator='<intvelocity joint="j" kp="1" actrange="-1 1"/>'), "within limits"),
        (joints(actuator='<general joint="j" dyntype="filter" actearly="true"/>'), "actearly"),
    ],
)
def test_what_is_no_pure_function_is_refused(text: str, cause: str) -> None:
    with pytest.raises(UsageError, match="pure function") as caught:
        pure(build(read(text)), "robot.xml")
    assert cause in caught.value.cause
    assert caught.value.remedy


def test_the_users_options_stay_and_the_model_is_not_changed() -> None:
    model = build(read(joints(option='<option cone="elliptic" integrator="RK4" impratio="3"/>')))
    forced = pure(model, "")
    assert (forced.opt.cone, forced.opt.impratio) == (1, 3.0)
    assert (model.opt.integrator, forced.opt.integrator) == (1, 0)
    assert model.opt.tolerance > forced.opt.tolerance


def test_names_become_identifiers_and_must_stay_different() -> None:
    found = layout(build(read(joints().replace("'j'", "'front-left/hip 1'"))))
    assert [j.name for j in found.joints] == ["front_left_hip_1"]
    two = "<mujoco><worldbody>" + "".join(
        f"<body><joint name='{name}'/><geom size='1'/></body>" for name in ("a-b", "a.b")
    )
    with pytest.raises(DeclarationError, match="'a_b'"):
        layout(build(read(two + "</worldbody></mujoco>")))


def test_joints_with_their_places() -> None:
    joints_of = layout(build(read(QUADRUPED))).joints
    assert [(j.name, j.kind, j.q, j.v, j.flange) for j in joints_of[:2]] == [
        ("trunk", "free", 0, 0, False),
        ("fl_abd", "hinge", 7, 6, True),
    ]
    assert joints_of[0].q_start == (0.0, 0.0, 0.4, 1.0, 0.0, 0.0, 0.0)


def test_an_unknown_name_is_told_with_those_that_exist() -> None:
    model = build(read(QUADRUPED))
    with pytest.raises(UsageError, match="it has back"):
        layout(model, wrenches=("front",))
    with pytest.raises(UsageError, match="no keyframe 'home'"):
        layout(model, keyframe="home")
