# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Robots from URDF, against kinematics of their own in NumPy."""

import json
import subprocess
import sys

import impinge
import numpy
import pytest
from impinge import robot

from support import SOURCE

ARM = SOURCE / "tools" / "data" / "arm.urdf"
POSITIONS = numpy.array([[0, 0, 0, 0, 0], [1, 0.5, -1, 0.1, 0.01], [-2, 1.5, 2, 0.2, 0.02]])
TIMES = [0, 1, 3]


# --- Forward kinematics, written from the URDF specification by hand ------------------------------


def turned(axis, angle):
    """Rodrigues' formula."""
    x, y, z = numpy.array(axis) / numpy.linalg.norm(axis)
    k = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = numpy.eye(4)
    matrix[:3, :3] += numpy.sin(angle) * k + (1 - numpy.cos(angle)) * (k @ k)
    return matrix


def shifted(*xyz):
    matrix = numpy.eye(4)
    matrix[:3, 3] = xyz
    return matrix


def rpy(r, p, y):
    return turned([0, 0, 1], y) @ turned([0, 1, 0], p) @ turned([1, 0, 0], r)


def frames(q):
    """Poses of the links of arm.urdf."""
    turn, lift, bend, extend, grip = q
    at = {"base": numpy.eye(4)}
    at["shoulder"] = at["base"] @ shifted(0, 0, 0.1) @ turned([0, 0, 1], turn)
    at["upper"] = at["shoulder"] @ shifted(0, 0, 0.3) @ rpy(0.2, 0, 0) @ turned([0, 1, 0], lift)
    elbow = at["upper"] @ shifted(0, 0, 0.5) @ rpy(0, 0.3, 0)
    at["fore"] = elbow @ shifted(0.05, 0, 0) @ turned([0, 1, 0.5], bend)
    at["slide"] = at["fore"] @ shifted(0.4, 0, 0) @ shifted(extend, 0, 0)
    at["left_finger"] = at["slide"] @ shifted(0, 0.01, 0) @ shifted(0, grip, 0)
    at["right_finger"] = at["slide"] @ shifted(0, -0.01, 0) @ shifted(0, -grip, 0)
    return at


CENTERS = {"base": shifted(0, 0, 0.05), "shoulder": shifted(0, 0, 0.15),
           "upper": shifted(0, 0, 0.25) @ rpy(0, 0, 0.3),
           "fore": shifted(0.2, 0, 0) @ rpy(0.1, numpy.pi / 2, 0.2), "slide": numpy.eye(4),
           "left_finger": shifted(0.08, 0, 0), "right_finger": shifted(0.08, 0, 0)}


@pytest.mark.parametrize("t", [0, 0.25, 1, 1.7, 3])
def test_links_are_where_forward_kinematics_puts_them(t):
    arm = robot.load(ARM)
    scene = arm.scene(TIMES, POSITIONS)
    q = [numpy.interp(t, TIMES, POSITIONS[:, k]) for k in range(5)]
    at = frames(q)
    assert set(scene.bodies) == set(CENTERS)
    for link, center in CENTERS.items():
        pose = at[link] @ center
        for surface, p, local in SAMPLES[link]:
            found = scene.eval(link, surface, [[*p, t]])[0]
            assert numpy.allclose(found, (pose @ [*local, 1])[:3], atol=1e-12), (link, t)


SAMPLES = {
    "base": [(0, (0, 0), (-0.15, -0.15, -0.05)), (5, (1, 0), (0.15, -0.15, 0.05))],
    "shoulder": [(1, (0.06, 0), (0.06, 0, -0.1)), (2, (0.03, numpy.pi / 2), (0, 0.03, 0.1))],
    "upper": [(1, (0, 0), (0.04, 0, -0.15)), (2, (0, 0), (0.04, 0, 0.15))],
    "fore": [(1, (0, 0), (0.03, 0, -0.1)), (2, (0, 0), (0.03, 0, 0.1))],
    "slide": [(1, (0, 0), (0.05, -0.03, -0.03)), (0, (1, 1), (-0.05, 0.03, 0.03))],
    "left_finger": [(1, (0, 0), (0.03, -0.005, -0.01))],
    "right_finger": [(0, (0, 0), (0.008, 0, 0))],
}


def test_a_cubic_motion_passes_through_its_positions():
    scene = robot.load(ARM).scene(TIMES, POSITIONS, interpolation="cubic")
    for t, q in zip(TIMES, POSITIONS):
        pose = frames(q)["right_finger"] @ CENTERS["right_finger"]
        found = scene.eval("right_finger", 0, [[0, 0, t]])[0]
        assert numpy.allclose(found, (pose @ [0.008, 0, 0, 1])[:3], atol=1e-9)


def test_a_robot_names_its_links_and_joints():
    arm = robot.load(ARM)
    assert [joint.name for joint in arm.joints] == ["turn", "lift", "bend", "extend", "grip"]
    assert "elbow" in arm.links and arm.name == "arm" and "5 joints" in repr(arm)
    named = arm.scene([0, 1], {"lift": [0, 1], "grip": 0.02})
    rows = arm.scene([0, 1], [[0, 0, 0, 0, 0.02], [0, 1, 0, 0, 0.02]])
    assert named.to_json() == rows.to_json()


def test_the_first_contact_with_the_world_is_that_of_sampled_poses():
    arm = robot.load(ARM)
    wall = {"name": "wall", "surfaces": [{"type": "plane", "origin": [0.3, -5, -5], "edge_u": [0, 10, 0],
                                          "edge_v": [0, 0, 10]}]}
    scene = arm.scene([0, 1], [[0, 0, 0, 0, 0], [0, 1.2, 0, 0, 0]], world=[wall])
    result = scene.solve()
    assert result.verdict == "contact" and "wall" in result.bodies
    late = [t for t in numpy.linspace(0, 1, 4001)
            if max(scene.eval("left_finger", k, [[u, v, t]])[0, 0] for k in range(6)
                   for u in (0, 1) for v in (0, 1)) >= 0.3]
    assert result.t <= late[0] + 1e-3
    free = arm.scene([0, 1], [[0, -0.2, 0, 0, 0], [0, -0.1, 0, 0, 0]],
                     world=[{**wall, "surfaces": [{**wall["surfaces"][0], "origin": [3, -5, -5]}]}])
    assert free.solve().verdict == "clear"


def test_pairs_that_the_srdf_disables_are_not_tested(tmp_path):
    (tmp_path / "arm.srdf").write_text(
        '<robot name="arm"><disable_collisions link1="base" link2="upper" reason="Never"/></robot>')
    scene = robot.load(ARM, srdf=tmp_path / "arm.srdf").scene([0, 1], POSITIONS[:2])
    pairs = {frozenset(answer.bodies) for answer in scene.each(max_pairs=1)}
    assert {"base", "upper"} not in pairs and {"upper", "fore"} not in pairs
    assert {"base", "fore"} in pairs
    (tmp_path / "bad.srdf").write_text('<robot><disable_collisions link1="base" link2="x"/></robot>')
    with pytest.raises(impinge.SceneError, match="bad.srdf: disable_collisions: got the link 'x'"):
        robot.load(ARM, srdf=tmp_path / "bad.srdf")


LINK = '<link name="{}"><collision><geometry>{}</geometry></collision></link>'
A, B = LINK.format("a", '<sphere radius="1"/>'), LINK.format("b", '<sphere radius="1"/>')
JOINT = '<joint name="{}" type="{}"><parent link="{}"/><child link="{}"/>{}</joint>'
LIMIT = '<limit lower="-1" upper="1"/>'


@pytest.mark.parametrize("inside,message", [
    ("", "no link has a <collision>"),
    (A + A, "link 'a': is there twice"),
    (A + B + JOINT.format("j", "revolute", "a", "b", ""), "joint 'j': a revolute joint must have a <limit>"),
    (A + B + JOINT.format("j", "revolute", "a", "b", '<limit lower="1" upper="-1"/>'), "limits from 1.0 to -1.0"),
    (A + B + JOINT.format("j", "floating", "a", "b", ""), "got the type 'floating', must be one of revolute"),
    (A + B + JOINT.format("j", "fixed", "a", "c", ""), "got the link 'c', which is not there"),
    (A + B + JOINT.format("j", "fixed", "a", "b", "") + JOINT.format("k", "fixed", "b", "a", ""), "loop"),
    (A + B + JOINT.format("j", "continuous", "a", "b", '<axis xyz="0 0 0"/>'), "axis 0 0 0"),
    (A + B + JOINT.format("j", "continuous", "a", "b", '<axis xyz="nan 0 0"/>'), "xyz: got 'nan 0 0'"),
    (A + B + JOINT.format("j", "continuous", "a", "b", '<mimic joint="x"/>'), "mimic joint 'x', which is not"),
    (A + B + JOINT.format("j", "continuous", "a", "b", '<mimic joint="j"/>'), "follows another itself"),
    (LINK.format("a", '<sphere radius="0"/>'), "<sphere>: got the size 0.0, must be > 0"),
    (LINK.format("a", '<mesh filename="package://p/x.stl"/>'), "got package 'p', known are none"),
    (LINK.format("a", '<mesh filename="x.stl"/>'), "x.stl is not there"),
    (LINK.format("a", '<mesh filename="x.stl" scale="1 0 1"/>'), "must not be 0"),
    (LINK.format("a", '<torus/>'), "got the geometry <torus>"),
    ("<link/>", "<link> has no name"),
    ("<", "must be XML")])
def test_what_is_wrong_in_a_urdf_is_named(inside, message, tmp_path):
    path = tmp_path / "r.urdf"
    path.write_text(f"<robot name='r'>{inside}</robot>")
    with pytest.raises(impinge.SceneError, match="r.urdf: ") as caught:
        robot.load(path)
    assert message in str(caught.value)


def test_positions_are_checked():
    arm = robot.load(ARM)
    for times, positions, message in [
            ([0, 1], [[0] * 5] * 3, r"shape \(3, 5\), must be \(2, 5\)"),
            ([1, 0], [[0] * 5] * 2, "increasing"), ([0], [[0] * 5], "two or more"),
            ([0, 1], {"lift": [0, 3]}, "positions: lift: got 3.0, must be from -2.0 to 2.0"),
            ([0, 1], {"lift": [0, float("nan")]}, "lift: got nan"),
            ([0, 1], {"tilt": [0, 1]}, "got 'tilt', must be a joint that moves"),
            ([0, 1], {"lift": [0, 1, 2]}, "must be 2 numbers, or one"),
            ([0, 1], {"grip_right": [0, 0]}, "got 'grip_right'")]:
        with pytest.raises(impinge.UsageError, match=message):
            arm.scene(times, positions)
    for wrong in ([5], [{}], [{"name": 5}], [{"surfaces": []}]):
        with pytest.raises(impinge.UsageError, match="world: got .*each with a name"):
            arm.scene([0, 1], POSITIONS[:2], world=wrong)


def test_bodies_of_the_world_are_not_tested_with_each_other():
    balls = [{"name": name, "surfaces": [{"type": "sphere", "center": [9, 0, x]}]}
             for name, x in (("one", 0), ("two", 1.5))]
    scene = robot.load(ARM).scene([0, 1], {"bend": 1}, world=balls)
    assert scene.solve().verdict == "clear"


def command(*words):
    return subprocess.run([sys.executable, "-m", "impinge.robot", *map(str, words)], capture_output=True,
                          text=True)


def test_the_command_answers_with_an_exit_status(tmp_path):
    clear = command(ARM, "--start", "0,0,1,0,0", "--goal", "1,0,1,0,0")
    assert clear.returncode == 0 and clear.stdout.startswith("clear from t = 0"), clear
    (tmp_path / "world.yaml").write_text(
        "world:\n  collision_objects:\n    - id: box\n      primitive_poses:\n"
        "        - {position: [0.3, 0, 0.8], orientation: [0, 0, 0, 1]}\n"
        "      primitives:\n        - {type: box, dimensions: [0.1, 0.5, 0.1]}\n")
    hit = command(ARM, "--start=0,-1,0,0,0", "--goal=0,1,0,0,0", "--world", tmp_path / "world.yaml", "--json")
    if "needs PyYAML" in hit.stderr:
        pytest.skip("no PyYAML")
    assert hit.returncode == 1 and "box" in json.loads(hit.stdout)["bodies"], hit
    (tmp_path / "q.csv").write_text("time,turn,bend\n0,0,1\n1,1,1\n2,2,1\n")
    kept = command(ARM, "--trajectory", tmp_path / "q.csv", "--require", "0.001", "--json")
    assert kept.returncode == 0 and json.loads(kept.stdout)["verdict"] == "holds", kept
    for words, status, message in [
            (["--goal", "1,2"], 2, "--goal: got '1,2', must be 5 numbers: turn, lift"),
            ([], 2, "give one of --trajectory"),
            (["--goal", "0,9,0,0,0"], 2, "lift: got 9.0"),
            (["--trajectory", tmp_path / "none.csv"], 4, "cannot be read")]:
        told = command(ARM, *words, "--json")
        assert told.returncode == status and message in told.stderr, told
        assert message in json.loads(told.stdout)["error"]
