# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Robots from URDF, against kinematics of their own in NumPy."""

import concurrent.futures
import multiprocessing
import pickle

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


HALVES = {"base": (0.15, 0.15, 0.05), "shoulder": (0.06, 0.06, 0.1), "upper": (0.04, 0.04, 0.19),
          "fore": (0.03, 0.03, 0.13), "slide": (0.05, 0.03, 0.03), "left_finger": (0.03, 0.005, 0.01),
          "right_finger": (0.008, 0.008, 0.008)}


def local_extent(scene, link, t, pose):
    """The ends of the box around a link, in its shape's own frame."""
    points = scene.mesh(link, t, tolerance=2e-4).points
    local = numpy.c_[points, numpy.ones(len(points))] @ numpy.linalg.inv(pose).T
    return local[:, :3].min(axis=0), local[:, :3].max(axis=0)


@pytest.mark.parametrize("t", [0, 0.25, 1, 1.7, 3])
def test_links_are_where_forward_kinematics_puts_them(t):
    arm = robot.load(ARM)
    scene = arm.scene(TIMES, POSITIONS)
    at = frames([numpy.interp(t, TIMES, POSITIONS[:, k]) for k in range(5)])
    assert scene.bodies == arm.links and set(arm.links) == {*CENTERS, "elbow"}
    for link, center in CENTERS.items():
        lo, hi = local_extent(scene, link, t, at[link] @ center)
        assert numpy.allclose(hi, HALVES[link], atol=4e-4) and numpy.allclose(lo, -hi, atol=4e-4), (link, t)


def test_a_cubic_motion_passes_through_its_positions():
    scene = robot.load(ARM).scene(TIMES, POSITIONS, interpolation="cubic")
    for t, q in zip(TIMES, POSITIONS):
        pose = frames(q)["right_finger"] @ CENTERS["right_finger"]
        found = scene.eval("right_finger", 0, [[0, 0, t]])[0]
        assert numpy.allclose(found, (pose @ [0.008, 0, 0, 1])[:3], atol=1e-9)


def test_velocities_and_accelerations_make_the_splines_of_joint_trajectory_controller():
    arm, random = robot.load(ARM), numpy.random.default_rng(1)
    v, a = 0.1 * random.standard_normal((3, 5)), 0.1 * random.standard_normal((3, 5))
    positions = 0.1 * POSITIONS + [0, 0, 0, 0.1, 0.01]
    for bends in (None, a):
        scene = arm.scene(TIMES, positions, velocities=v, accelerations=bends)
        for t in (0, 0.4, 1, 1.5, 2.9):
            k, q = int(t >= 1), numpy.empty(5)
            h, s = TIMES[k + 1] - TIMES[k], (t - TIMES[k]) / (TIMES[k + 1] - TIMES[k])
            for joint in range(5):
                # The polynomial in s with these values and derivatives at 0 and 1.
                rows = [[p == 0 for p in range(6)], [1] * 6, [p == 1 for p in range(6)], range(6),
                        [2 * (p == 2) for p in range(6)], [p * (p - 1) for p in range(6)]]
                known = [*positions[k:k + 2, joint], *(h * v[k:k + 2, joint]), *(h * h * a[k:k + 2, joint])]
                n = 4 if bends is None else 6
                c = numpy.linalg.solve(numpy.array(rows, float)[:n, :n], known[:n])
                q[joint] = numpy.polyval(c[::-1], s)
            pose = frames(q)["right_finger"] @ CENTERS["right_finger"]
            found = scene.eval("right_finger", 0, [[0, 0, t]])[0]
            assert numpy.allclose(found, (pose @ [0.008, 0, 0, 1])[:3], atol=1e-9), (t, bends)
    plain = arm.scene(TIMES, positions, velocities=v, interpolation="linear")
    assert plain.to_json() == arm.scene(TIMES, positions).to_json()


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
    scene = arm.scene([0, 1], [[0, -1.2, 0, 0, 0], [0, 1.2, 0, 0, 0]], world=[wall])
    result = scene.solve()
    assert result.verdict == "contact" and "wall" in result.bodies
    before, after = (max(scene.mesh(link, result.t + late).points[:, 0].max() for link in CENTERS)
                     for late in (-1e-3, 1e-3))
    assert before < 0.3 < after
    free = arm.scene([0, 1], [[0, -0.2, 0, 0, 0], [0, -0.1, 0, 0, 0]],
                     world=[{**wall, "surfaces": [{**wall["surfaces"][0], "origin": [3, -5, -5]}]}])
    assert free.solve().verdict == "clear"


def pairs_of(scene):
    """Names of all bodies that are tested with each other."""
    return {frozenset(answer.bodies) for answer in scene.each(max_pairs=1)}


def test_pairs_that_the_srdf_disables_are_not_tested(tmp_path):
    (tmp_path / "arm.srdf").write_text(
        '<robot name="arm"><disable_collisions link1="base" link2="upper" reason="Never"/></robot>')
    arm = robot.load(ARM, srdf=tmp_path / "arm.srdf")
    pairs = pairs_of(arm.scene([0, 1], POSITIONS[:2]))
    assert {"base", "upper"} not in pairs and {"upper", "fore"} not in pairs
    assert {"base", "fore"} in pairs
    other = pairs_of(arm.scene([0, 1], POSITIONS[:2], allowed=[("base", "fore")]))
    assert {"base", "upper"} in other and {"base", "fore"} not in other


def test_what_is_attached_moves_with_its_link():
    tool = {"name": "tool", "parent": "slide", "surfaces": [{"type": "sphere", "radius": 0.01, "center": [0.2, 0, 0]}]}
    table = {"name": "table", "surfaces": [{"type": "box", "center": [9, 0, 0]}]}
    scene = robot.load(ARM).scene(TIMES, POSITIONS, world=[tool, table])
    pose = frames(POSITIONS[1])["slide"]
    assert numpy.allclose(scene.eval("tool", 0, [[0, 0, 1]])[0], (pose @ [0.21, 0, 0, 1])[:3], atol=1e-12)
    assert {"tool", "table"} in pairs_of(scene)


def test_a_scene_is_the_same_by_its_text():
    scene = robot.load(ARM).scene(TIMES, POSITIONS, world=[{"name": "ball", "surfaces": [
        {"type": "sphere", "radius": 0.1, "center": [0.5, 0.2, 0.5]}]}])
    again = impinge.Scene.from_json(scene.to_json())
    ours, theirs = scene.solve(), again.solve()
    assert (ours.verdict, ours.t, ours.a, ours.pairs) == (theirs.verdict, theirs.t, theirs.a, theirs.pairs)
    assert ours.verdict == "contact" and again.bodies == scene.bodies


MESHED = """<robot name="r">
  <link name="base"><collision><geometry><mesh filename="t.obj"/></geometry></collision></link>
  <link name="ball"><collision><origin xyz="3 0 0"/><geometry><mesh filename="t.obj"/></geometry></collision></link>
  <joint name="j" type="continuous"><parent link="base"/><child link="ball"/><axis xyz="0 0 1"/></joint></robot>"""


def test_a_robot_reads_its_meshes_once(tmp_path):
    (tmp_path / "r.urdf").write_text(MESHED)
    (tmp_path / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    wall = {"name": "wall", "surfaces": [{"type": "box", "center": [-3, 0, 0]}]}
    r = robot.load(tmp_path / "r.urdf")
    scenes = [r.scene([0, 1], [[0], [k]], world=[wall]) for k in (1, 4)]
    text = scenes[1].to_json()
    expected = impinge.Scene.from_json(text).solve()
    again = pickle.loads(pickle.dumps(r)).scene([0, 1], [[0], [4]], world=[wall]).solve()
    (tmp_path / "t.obj").unlink()
    scenes += [r.scene([0, 1], [[0], [4]], world=[wall]) for _ in range(3)]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        results = list(pool.map(lambda scene: scene.solve(), scenes))
    assert results[0].verdict == "clear" and expected.verdict == "contact"
    for result in (*results[1:], again):
        assert (result.t, result.a, result.pairs) == (expected.t, expected.a, expected.pairs)
    with pytest.raises(impinge.SceneError, match="r.urdf: link 'base': .*t.obj"):
        pickle.loads(pickle.dumps(r)).scene([0, 1], [[0], [4]])
    del r, scenes[:2]
    assert scenes[0].solve().t == expected.t


def test_scenes_of_one_world_are_those_of_a_robot_loaded_anew(tmp_path):
    (tmp_path / "w.yaml").write_text("""
world: {collision_objects: [{id: ball, pose: {position: [0.7, 0, 0.6], orientation: [0, 0, 0, 1]},
  primitives: [{type: sphere, dimensions: [0.3]}], primitive_poses: [{position: [0, 0, 0], orientation: [0, 0, 0, 1]}]}]}
""")
    arm = robot.load(ARM)
    world = arm.world(tmp_path / "w.yaml")
    for q in ([0, -1.2, 0, 0, 0], [0.1, -1, 0.2, 0, 0.01]):
        motion = [q, [0.2, 1.2, 0, 0, 0]]
        ours = arm.scene([0, 1], motion, world=world)
        fresh = robot.load(ARM)
        theirs = fresh.scene([0, 1], motion, world=tmp_path / "w.yaml")
        assert ours.to_json() == theirs.to_json() and ours.bodies == theirs.bodies
        found = [scene.solve() for scene in (ours, theirs, impinge.Scene.from_json(ours.to_json()))]
        assert found[0].verdict == "contact"
        assert len({(x.t, x.pairs, x.bodies, x.gap) for x in found}) == 1
        again = pickle.loads(pickle.dumps(arm)).scene([0, 1], motion, world=world).solve()
        assert (again.t, again.pairs) == (found[0].t, found[0].pairs)
        free = arm.scene([0, 1], motion, world=world, allowed=[(link, "ball") for link in arm.links])
        assert free.solve().verdict == "clear"
        errors = arm.scene([0, 1], motion, world=world, errors=(0.01, 0.001))
        assert set(errors.parameters) == {f"{joint.name}.error" for joint in arm.joints}
    assert arm.scene([0, 1], motion).solve().verdict == "clear"


def test_a_copy_of_the_process_makes_scenes_of_its_own():
    arm = robot.load(ARM)
    ours = arm.scene([0, 1], POSITIONS[:2]).solve()
    with multiprocessing.get_context("fork").Pool(1) as pool:
        theirs = pool.apply(_in_a_copy, (arm,))
    assert (ours.verdict, ours.t_lower, ours.pairs) == theirs


def _in_a_copy(arm):
    found = arm.scene([0, 1], POSITIONS[:2]).solve()
    return found.verdict, found.t_lower, found.pairs


def test_a_planar_and_a_floating_joint_have_several_positions(tmp_path):
    (tmp_path / "r.urdf").write_text("""<robot name="r"><link name="floor"/>
      <link name="base"><collision><geometry><sphere radius="1"/></geometry></collision></link>
      <link name="drone"><collision><geometry><sphere radius="1"/></geometry></collision></link>
      <joint name="drive" type="planar"><parent link="floor"/><child link="base"/></joint>
      <joint name="fly" type="floating"><parent link="floor"/><child link="drone"/>
        <origin xyz="0 0 5"/></joint></robot>""")
    r = robot.load(tmp_path / "r.urdf")
    assert r.variables == ("drive/x", "drive/y", "drive/theta", "fly/trans_x", "fly/trans_y", "fly/trans_z", "fly/rot_x",
                           "fly/rot_y", "fly/rot_z", "fly/rot_w") and r.rest["fly/rot_w"] == 1
    half = numpy.sqrt(0.5)
    moved = {"drive/x": [0, 2], "drive/theta": [0, numpy.pi / 2], "fly/trans_z": [0, 1], "fly/rot_x": [0, -half],
             "fly/rot_w": [1, -half]}
    scene = r.scene([0, 2], moved)
    assert numpy.allclose(scene.eval("base", 0, [[0, 0, 2], [0, 0, 1]]), [[2, 1, 0], [1 + half, half, 0]])
    # A quarter about x, to a quaternion of the other sign; v is the latitude of the sphere.
    top = [[0, numpy.pi / 2, 0], [0, numpy.pi / 2, 2], [0, numpy.pi / 2, 1]]
    assert numpy.allclose(scene.eval("drone", 0, top), [[0, 0, 6], [0, -1, 6], [0, -half, 5.5 + half]])
    assert numpy.allclose(r.scene([0, 2], {"fly/rot_x": half, "fly/rot_w": half}).eval("drone", 0, top[1:2]), [[0, -1, 5]])
    smooth = r.scene([0, 2], moved, interpolation="cubic")
    assert numpy.allclose(smooth.eval("drone", 0, top[1:2]), [[0, -1, 6]])
    with pytest.raises(impinge.UsageError, match="a floating joint takes none"):
        r.scene([0, 2], moved, velocities={name: [0, 0] for name in r.variables})


def test_positions_are_checked():
    arm = robot.load(ARM)
    for times, positions, message in [
            ([0, 1], [[0] * 5] * 3, r"shape \(3, 5\), must be \(2, 5\)"),
            ([1, 0], [[0] * 5] * 2, "increasing"), ([0], [[0] * 5], "two or more"),
            ([0, 1], {"lift": [0, 3]}, "positions: lift: got 3.0, must be from -2.0 to 2.0"),
            ([0, 1], {"lift": [0, float("nan")]}, r"lift: got \[0, nan\]"),
            ([0, 1], {"tilt": [0, 1]}, "got 'tilt', must be a joint that moves"),
            ([0, 1], {"lift": [0, 1, 2]}, "must be 2 numbers, or one"),
            ([0, 1], {"grip_right": [0, 0]}, "got 'grip_right'")]:
        with pytest.raises(impinge.UsageError, match=message):
            arm.scene(times, positions)
    for wrong in ([5], [{}], [{"name": 5}], [{"surfaces": []}]):
        with pytest.raises(impinge.UsageError, match="world: got .*each with a name"):
            arm.scene([0, 1], POSITIONS[:2], world=wrong)
    with pytest.raises(impinge.UsageError, match="got the name 'base' twice"):
        arm.scene([0, 1], POSITIONS[:2], world=[{"name": "base", "surfaces": []}])
    with pytest.raises(impinge.UsageError, match="velocities: lift: missing"):
        arm.scene([0, 1], {"lift": [0, 1], "bend": [0, 1]}, velocities={"bend": [0, 0]})
    with pytest.raises(impinge.UsageError, match="accelerations: given without velocities"):
        arm.scene([0, 1], {"lift": [0, 1]}, accelerations={"lift": [0, 0]})
    with pytest.raises(impinge.UsageError, match="interpolation: got 'none'"):
        arm.scene([0, 1], {"lift": [0, 1]}, interpolation="none")
    with pytest.raises(impinge.UsageError, match="allowed: got .*a pair of names"):
        arm.scene([0, 1], {"lift": [0, 1]}, allowed=[("base", "nothing")])


def test_bodies_of_the_world_are_not_tested_with_each_other():
    balls = [{"name": name, "surfaces": [{"type": "sphere", "center": [9, 0, x]}]}
             for name, x in (("one", 0), ("two", 1.5))]
    scene = robot.load(ARM).scene([0, 1], {"bend": 1}, world=balls)
    assert scene.solve().verdict == "clear"
