# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""What files of robots and of what is around them say, and what is wrong in them."""

import impinge
import numpy
import pytest
from impinge import robot

from support import SOURCE

ARM = SOURCE / "tools" / "data" / "arm.urdf"
LINK = '<link name="{}"><collision><geometry>{}</geometry></collision></link>'
A, B = LINK.format("a", '<sphere radius="1"/>'), LINK.format("b", '<sphere radius="1"/>')
C, D = LINK.format("c", '<sphere radius="1"/>'), LINK.format("d", '<sphere radius="1"/>')
JOINT = '<joint name="{}" type="{}"><parent link="{}"/><child link="{}"/>{}</joint>'
LIMIT = '<limit lower="-1" upper="1"/>'

# --- URDF -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("inside,message", [
    ("", "no link has a <collision>"),
    (A + A, "link 'a': is there twice"),
    (A + B, "link 'b': is the child of no joint, as is 'a'; join them"),
    (A + B + JOINT.format("j", "revolute", "a", "b", ""), "joint 'j': a revolute joint must have a <limit>"),
    (A + B + JOINT.format("j", "revolute", "a", "b", '<limit lower="1" upper="-1"/>'), "limits from 1.0 to -1.0"),
    (A + B + JOINT.format("j", "prismatic", "a", "b", '<limit lower="nan" upper="1"/>'), "lower: got 'nan'"),
    (A + B + JOINT.format("j", "ball", "a", "b", ""), "got the type 'ball', must be one of revolute"),
    (A + B + JOINT.format("j", "fixed", "a", "c", ""), "got the link 'c', which is not there"),
    (A + B + JOINT.format("j", "fixed", "a", "b", "") + JOINT.format("k", "fixed", "b", "a", ""), "loop"),
    (A + B + C + JOINT.format("j", "fixed", "a", "c", "") + JOINT.format("k", "fixed", "b", "c", ""),
     "link 'c' is the child of 'j' already"),
    (A + B + JOINT.format("j", "continuous", "a", "b", '<axis xyz="0 0 0"/>'), "axis 0 0 0"),
    (A + B + JOINT.format("j", "continuous", "a", "b", '<axis xyz="nan 0 0"/>'), "xyz: got 'nan 0 0'"),
    (A + B + JOINT.format("j", "continuous", "a", "b", '<origin xyz="0 0 inf"/>'), "xyz: got '0 0 inf'"),
    (A + B + JOINT.format("j", "continuous", "a", "b", '<mimic joint="x"/>'), "mimic joint 'x', which is not"),
    (A + B + JOINT.format("j", "continuous", "a", "b", '<mimic joint="j"/>'), "'j': follows itself; leave out"),
    (A + B + C + D + JOINT.format("i", "continuous", "a", "b", "")
     + JOINT.format("j", "continuous", "b", "c", '<mimic joint="i"/>')
     + JOINT.format("k", "continuous", "c", "d", '<mimic joint="j"/>'),
     "joint 'k': got the mimic joint 'j', which follows another itself; let it follow 'i'"),
    (A + B + JOINT.format("j", "floating", "a", "b", '<mimic joint="j"/>'), "a floating joint cannot follow another"),
    (A + B + C + JOINT.format("i", "planar", "a", "b", "")
     + JOINT.format("j", "continuous", "b", "c", '<mimic joint="i"/>'), "'i', which is planar"),
    (LINK.format("a", '<sphere radius="0"/>'), "<sphere>: got the size 0.0, must be > 0"),
    (LINK.format("a", '<cylinder radius="1" length="nan"/>'), "length: got 'nan', must be 1 finite number"),
    (LINK.format("a", '<mesh filename="package://no_such_package/x.stl"/>'),
     "got package 'no_such_package', which is in no folder above the file"),
    (LINK.format("a", '<mesh filename="x.stl"/>'), "x.stl is not there"),
    (LINK.format("a", '<mesh filename="r.dae"/>'), "COLLADA, which is not read; convert it"),
    (LINK.format("a", '<mesh filename="x.stl" scale="1 0 1"/>'), "must not be 0"),
    (LINK.format("a", '<torus/>'), "got the geometry <torus>"),
    ("<link name='a'><collision/></link>", "<collision> must have a <geometry> with one shape"),
    ('<x:macro xmlns:x="http://www.ros.org/wiki/xacro"/>', "got <xacro:macro>, must be plain XML; expand it first"),
    ("<link/>", "<link> has no name"),
    ("<link name='\xe4'/>".encode("latin-1"), "not well-formed"),
    ("<", "must be XML")])
def test_what_is_wrong_in_a_urdf_is_named(inside, message, tmp_path):
    path = tmp_path / "r.urdf"
    (tmp_path / "r.dae").write_text("")
    path.write_bytes(b"<robot name='r'>" + (inside if isinstance(inside, bytes) else inside.encode()) + b"</robot>")
    with pytest.raises(impinge.SceneError, match="r.urdf: ") as caught:
        robot.load(path)
    assert message in str(caught.value)


OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def test_meshes_are_found_in_packages_and_scaled(tmp_path, monkeypatch):
    def placed(folder):
        (folder / "meshes").mkdir(parents=True)
        (folder / "meshes" / "t.obj").write_text(OBJ)

    urdf = tmp_path / "ours" / "urdf" / "r.urdf"
    urdf.parent.mkdir(parents=True)
    urdf.write_text("<robot name='r'>" + LINK.format("a", '<mesh filename="package://{}/meshes/t.obj" scale="2 1 -1"/>')
                    .replace("</collision>", '<origin xyz="0 0 1"/></collision>') + "</robot>")
    text = urdf.read_text()
    for package, folder, known in [("ours", tmp_path / "ours", {}), ("beside", tmp_path / "beside", {}),
                                   ("said", tmp_path / "far" / "off", {"said": tmp_path / "far" / "off"}),
                                   ("ros", tmp_path / "jazzy" / "share" / "ros", {})]:
        placed(folder)
        urdf.write_text(text.format(package))
        monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "none") + ":" + str(tmp_path / "jazzy"))
        points = robot.load(urdf, packages=known).scene([0, 1], numpy.zeros((2, 0))).mesh("a").points
        assert numpy.allclose(points.min(axis=0), [0, 0, 0]) and numpy.allclose(points.max(axis=0), [2, 1, 1]), package


def test_a_link_has_all_of_its_collision_elements(tmp_path):
    (tmp_path / "r.urdf").write_text("""<robot name="r"><link name="a">
        <collision><geometry><box size="1 1 1"/></geometry></collision>
        <collision><origin xyz="3 0 0" rpy="0 1.5707963267948966 0"/>
                   <geometry><capsule radius="0.5" length="2"/></geometry></collision></link></robot>""")
    points = robot.load(tmp_path / "r.urdf").scene([0, 1], numpy.zeros((2, 0))).mesh("a").points
    assert numpy.allclose([points.min(axis=0), points.max(axis=0)], [[-0.5] * 3, [4.5, 0.5, 0.5]], atol=0.01)


# --- SRDF -----------------------------------------------------------------------------------------

SRDF = """<robot name="arm">
  <group name="arm"><chain base_link="base" tip_link="slide"/></group>
  <group name="hand"><link name="left_finger"/><joint name="grip_right"/></group>
  <group name="all"><group name="arm"/><group name="hand"/></group>
  <group_state name="up" group="arm"><joint name="lift" value="-1"/><joint name="to_elbow" value="0"/></group_state>
  <group_state name="open" group="hand"><joint name="grip" value="0.02"/></group_state>
  <group_state name="open" group="all"><joint name="grip" value="0.01"/></group_state>{}</robot>"""


def loaded(tmp_path, more=""):
    (tmp_path / "arm.srdf").write_text(SRDF.format(more))
    return robot.load(ARM, srdf=tmp_path / "arm.srdf")


def test_groups_and_states_have_names(tmp_path):
    arm = loaded(tmp_path)
    assert arm.groups["arm"] == ("turn", "lift", "to_elbow", "bend", "extend")
    assert arm.groups["hand"] == ("grip", "grip_right") and set(arm.groups["all"]) == {
        *arm.groups["arm"], *arm.groups["hand"]}
    assert arm.state("up") == arm.state("arm/up") == {"lift": -1}
    assert arm.state("hand/open") == {"grip": 0.02} and arm.state("all/open") == {"grip": 0.01}
    with pytest.raises(impinge.UsageError, match="state: got 'open', must be one of all/open"):
        arm.state("open")


@pytest.mark.parametrize("more,message", [
    ('<disable_collisions link1="base" link2="x"/>', "disable_collisions: got the link 'x', which"),
    ('<group name="x"><joint name="y"/></group>', "group 'x': got the joint 'y', which"),
    ('<group name="x"><group name="y"/></group>', "group 'x': got the group 'y', which is not there"),
    ('<group name="x"><group name="x"/></group>', "group 'x': is a part of itself"),
    ('<group name="x"><chain base_link="fore" tip_link="base"/></group>', "a chain to 'base', which is not below"),
    ('<group_state name="x" group="y"/>', "group_state 'x': got the group 'y', must be one of arm, hand, all"),
    ('<group_state name="x" group="arm"><joint name="lift" value="up"/></group_state>',
     "joint 'lift': got 'up', must be 1 finite number"),
    ("<", "must be XML")])
def test_what_is_wrong_in_an_srdf_is_named(more, message, tmp_path):
    with pytest.raises(impinge.SceneError, match="arm.srdf: ") as caught:
        loaded(tmp_path, more)
    assert message in str(caught.value)


# --- Planning scenes ------------------------------------------------------------------------------


def world_of(tmp_path, text, arm=None):
    pytest.importorskip("yaml")
    (tmp_path / "world.yaml").write_bytes(text if isinstance(text, bytes) else text.encode())
    return (arm or robot.load(ARM)).world(tmp_path / "world.yaml")


SHAPES = """
fixed_frame_transforms:
  - {child_frame_id: cell, transform: {translation: [0, 0, 1], rotation: [0, 0, 0, 1]}}
world:
  collision_objects:
    - id: shelf
      header: {frame_id: cell}
      pose: {position: {x: 1, y: 0, z: 0}, orientation: {x: 0, y: 0, z: 0.7071067811865476, w: 0.7071067811865476}}
      primitives: [{type: box, dimensions: [2, 1, 0.5]}, {type: 4, dimensions: [1, 0.25]}]
      primitive_poses: [{position: [5, 0, 0]}, {position: [0, 0, 0], orientation: [0, 0, 0, 1]}]
    - id: wedge
      meshes: [{vertices: [[0, 0, 0], {x: 1, y: 0, z: 0}, [0, 1, 0]], triangles: [{vertex_indices: [0, 1, 2]}]}]
      mesh_poses: [{position: [0, 0, -3]}]
    - id: file
      meshes: [{resource: t.obj, dimensions: [2, 2, 2]}]
      mesh_poses: [{position: [0, 0, -9]}]
robot_state:
  attached_collision_objects:
    - link_name: slide
      touch_links: [left_finger]
      object: {id: cup, primitives: [{type: cylinder, dimensions: [0.1, 0.01]}], primitive_poses: [{position: [0.2, 0, 0]}]}
"""


def test_a_planning_scene_stands_where_it_says(tmp_path):
    (tmp_path / "t.obj").write_text(OBJ)
    world = world_of(tmp_path, SHAPES)
    scene = robot.load(ARM).scene([0, 1], {}, world=world)
    def extent(body):
        points = scene.mesh(body, tolerance=1e-4).points
        return numpy.round([points.min(axis=0), points.max(axis=0)], 3).tolist()
    # A quarter about z: the box, 5 along the shelf's x, is 5 along the world's y.
    assert extent("shelf") == [[0.5, -0.25, 0.5], [1.5, 6, 1.5]]
    assert extent("wedge") == [[0, 0, -3], [1, 1, -3]] and extent("file") == [[0, 0, -9], [2, 2, -7]]
    tested = {frozenset(answer.bodies) for answer in scene.each(max_pairs=1)}
    assert {"cup", "shelf"} in tested and {"cup", "base"} in tested and {"shelf", "wedge"} not in tested
    assert not {frozenset(("cup", "slide")), frozenset(("cup", "left_finger"))} & tested


MATRIX = """
world: {{collision_objects: [{{id: ball, primitives: [{{type: sphere, dimensions: [1]}}], primitive_poses: [{{}}]}}]}}
allowed_collision_matrix: {}
"""


def test_the_allowed_collision_matrix_replaces_what_the_srdf_disables(tmp_path):
    pytest.importorskip("yaml")
    arm = loaded(tmp_path, '<disable_collisions link1="base" link2="upper"/>')

    def tested(matrix):
        scene = arm.scene([0, 1], {}, world=world_of(tmp_path, MATRIX.format(matrix), arm))
        return {frozenset(answer.bodies) for answer in scene.each(max_pairs=1)}

    rows = "entry_names: [base, fore, ball], entry_values: [[false, true, true], [true, true, false], [true, false, true]]"
    found = tested("{" + rows + "}")
    assert {"base", "upper"} in found and {"fore", "ball"} in found and {"base", "upper"} not in tested("{}")
    assert {"base", "fore"} not in found and {"base", "ball"} not in found
    enabled = tested("{entry_names: [base, fore], entry_values: [{enabled: [false, true]}, {enabled: [true, false]}]}")
    assert {"base", "fore"} not in enabled and {"base", "ball"} in enabled
    by_default = tested("{" + rows + ", default_entry_names: [ball, slide], default_entry_values: [true, false]}")
    assert {"fore", "ball"} in by_default, "an entry counts more than a default"
    assert {"upper", "ball"} not in by_default and {"slide", "ball"} in by_default, "both defaults must allow it"


BOX = "world: {{collision_objects: [{{id: b, primitives: [{{type: box, dimensions: [1, 1, 1]}}], {}}}]}}"


@pytest.mark.parametrize("text,message", [
    ("world: {octomap: {octomap: {data: [1, 2]}}}", "octomap: has data, which is not understood; let its cells be boxes"),
    ("world: {collision_objects: [{id: b, planes: [{coef: [0, 0, 1, 0]}]}]}", "b: has planes, which is not understood; let"),
    ("world: {collision_objects: [{id: b}]}", "b: has no primitives and no meshes"),
    ("world: {collision_objects: [{}]}", "collision_objects: an object has no id"),
    ("world: {collision_objects: 5}", "world: collision_objects: got 5, must be a list"),
    ("world: [1]", "scene: world: got [1], must be an object"),
    ("[1, 2]", "got list, must be a planning scene"), ("a: 1", "must be a planning scene"),
    ("{", "must be YAML"), (b"world: \xff", "must be YAML"),
    (BOX.format("primitive_poses: [{}, {}]"), "b: has 1 of primitive and 2 primitive_poses, must be as many"),
    (BOX.format("primitive_poses: [{position: [0, 0, .nan]}]"), "b: position: got [0, 0, nan], must be 3 finite numbers"),
    (BOX.format("primitive_poses: [{position: [0, 0]}]"), "b: position: got [0, 0], must be 3 finite"),
    (BOX.format("pose: {orientation: [0, 0, 0, 2]}"), "b: orientation: got a quaternion of length 2.0, must be 1"),
    (BOX.format("header: {frame_id: moon}"), "b: got the frame 'moon', known are base, world"),
    (BOX.format("x: 1").replace("[1, 1, 1]", "[1, 1, 0]"), "b: dimensions: got 0.0, must be > 0"),
    (BOX.format("x: 1").replace("[1, 1, 1]", "[1]"), "b: dimensions: got [1], must be 3 finite"),
    (BOX.format("x: 1").replace("box", "prism"), "b: got the primitive 'prism', must be box, sphere"),
    ("world: {collision_objects: [{id: b, meshes: [{resource: none.stl}]}]}", "none.stl is not there"),
    ("world: {collision_objects: [{id: b, meshes: [{vertices: [[0, 0, 0]]}]}]}", "b: a mesh has no triangles"),
    ("world: {collision_objects: [{id: b, meshes: [{vertices: [[0, 0, 0]], triangles: [{vertex_indices: [0, 0, 1]}]}]}]}",
     "b: vertex_indices: got [0, 0, 1], must be 3 numbers of vertices, below 1"),
    ("{world: {}, link_padding: [{link_name: base, padding: 0.01}]}", "link_padding: has padding, which is not understood"),
    ("{world: {}, link_scale: [{link_name: base, scale: 2}]}", "link_scale: got 2, must be 1"),
    ("{world: {}, robot_state: {multi_dof_joint_state: {transforms: [{translation: [1, 0, 0], rotation: [0, 0, 0, 1]}]}}}",
     "multi_dof_joint_state: moves the robot's base"),
    ("allowed_collision_matrix: {entry_names: [a, b], entry_values: [[true, false]]}", "must be 2 rows of as many booleans"),
    ("allowed_collision_matrix: {entry_names: [a, b], entry_values: [[true, false], [true, true]]}",
     "b and a: got both true and false"),
    ("allowed_collision_matrix: {default_entry_names: [a]}", "default_entry_values: must be 1 booleans")])
def test_what_is_wrong_in_a_planning_scene_is_named(text, message, tmp_path):
    with pytest.raises(impinge.SceneError, match="world.yaml: ") as caught:
        world_of(tmp_path, text)
    assert message in str(caught.value)
