# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""What is proved of robots against poses that FCL tests, one by one: none overlaps before the time of
contact, and none in what is clear. IMPINGE_ROBOTS names a folder of robots and planning problems, which are
then tried, too; IMPINGE_ROBOT_PROBLEMS says how many of each kind."""

import json
import os
import pathlib
import subprocess

import numpy
import pytest
from impinge.robot import __main__ as command

import kinematics

SOURCE = pathlib.Path(os.environ["top_srcdir"])
FOLDER = os.environ.get("IMPINGE_ROBOTS")
POSES = 200


@pytest.fixture(scope="session")
def overlaps(tmp_path_factory):
    """The sampler: from shapes, pairs of them, and poses to the pairs that overlap, pose by pose."""
    program = tmp_path_factory.mktemp("fcl") / "overlaps"
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "fcl"], capture_output=True, text=True)
    if flags.returncode != 0:
        pytest.skip("no FCL (libfcl-dev)")
    subprocess.run(["g++", "-std=c++17", "-O1", "-o", program, SOURCE / "tests" / "peers" / "fcl_overlaps.cc",
                    *flags.stdout.split()], check=True)

    def run(shapes, pairs, poses):
        lines = [str(len(shapes)), *shapes, str(len(pairs)), *(f"{a} {b}" for a, b in pairs), str(len(poses))]
        lines += [" ".join(map(repr, matrix[:3].ravel().tolist())) for pose in poses for matrix in pose]
        done = subprocess.run([program], input="\n".join(lines), capture_output=True, text=True, check=True)
        return [line.split() for line in done.stdout.splitlines()]

    return run


def sampled(overlaps, robot, around, ignored, start, goal, times):
    """The names that overlap at each time, on the straight edge from start to goal."""
    shapes = [(name, None, own, text) for name, own, text in robot.shapes]
    shapes += [(name, at, None, text) for name, at, text in around]
    names, links = [shape[0] for shape in shapes], {shape[0] for shape in robot.shapes}
    pairs = [(a, b) for a in range(len(names)) for b in range(a) if names[b] in links and names[a] != names[b]
             and frozenset((names[a], names[b])) not in ignored]
    poses = []
    for t in times:
        at = robot.frames({name: start[name] + t * (goal.get(name, start[name]) - start[name]) for name in start})
        poses.append([at[name] @ own if fixed is None else fixed for name, fixed, own, _ in shapes])
    found = overlaps([text for _, _, _, text in shapes], pairs, poses)
    return [sorted({names[int(k)] for pair in line for k in pair.split(",")}) for line in found]


def compare(answer, overlaps, *what):
    """No pose overlaps before the time of contact; and where it is said to be, in some pose right after it
    something does, unless it only grazes."""
    end = answer["t"] if answer["verdict"] == "contact" else 1.0
    assert answer["verdict"] in ("clear", "contact")
    times = numpy.linspace(0, end, POSES)
    times = times[times < end - 1e-6] if answer["verdict"] == "contact" else times
    for t, names in zip(times, sampled(overlaps, *what, times)):
        assert not names, (t, names, answer["text"])
    after = [end + late for late in (1e-6, 1e-5, 1e-4, 1e-3) if end + late <= 1]
    return answer["verdict"] == "contact" and any(sampled(overlaps, *what, after))


def ask(capsys, *words):
    command.main([*map(str, words), "--json"])
    return json.loads(capsys.readouterr().out)


def test_an_arm_of_our_own_overlaps_nothing_before_contact(overlaps, capsys, tmp_path):
    arm = kinematics.Robot(SOURCE / "tools" / "data" / "arm.urdf")
    (tmp_path / "w.yaml").write_text("""
world: {collision_objects: [
  {id: shelf, pose: {position: [0.55, 0, 0.75], orientation: [0, 0.28, 0, 0.96]},
   primitives: [{type: box, dimensions: [0.4, 1.6, 0.04]}, {type: cylinder, dimensions: [0.5, 0.05]}],
   primitive_poses: [{position: [0, 0, 0], orientation: [0, 0, 0, 1]},
                     {position: [-0.1, 0.2, 0.2], orientation: [0.6, 0, 0, 0.8]}]}]}
""")
    around, allowed = kinematics.world_of(tmp_path / "w.yaml")
    random, names, hits = numpy.random.default_rng(3), ["turn", "lift", "bend", "extend", "grip"], 0
    for _ in range(6):
        start = dict(zip(names, random.uniform([-1, -1.6, -0.8, 0, 0], [1, -1, 0, 0.2, 0.02]).tolist()))
        goal = dict(zip(names, random.uniform([-1, 0, -0.8, 0, 0], [1, 1.5, 0, 0.2, 0.02]).tolist()))
        poses = [",".join(f"{name}={value!r}" for name, value in pose.items()) for pose in (start, goal)]
        answer = ask(capsys, SOURCE / "tools/data/arm.urdf", "--start", poses[0], "--goal", poses[1], "--world",
                     tmp_path / "w.yaml")
        hits += compare(answer, overlaps, arm, around, arm.joined() | allowed, start, goal)
    assert hits >= 2


def problems():
    most = int(os.environ.get("IMPINGE_ROBOT_PROBLEMS", "1"))
    folders = sorted(pathlib.Path(FOLDER).glob("*/problems/*")) if FOLDER else []
    return [one for folder in folders for one in sorted(folder.glob("request*.yaml"))[:most]]


@pytest.mark.parametrize("request_file", problems(), ids=str)
def test_a_problem_overlaps_nothing_before_contact(request_file, overlaps, capsys):
    folder = request_file.parents[2]
    scene = request_file.with_name(request_file.name.replace("request", "scene"))
    urdf, srdf = folder / f"{folder.name}.urdf", folder / f"{folder.name}.srdf"
    answer = ask(capsys, urdf, "--srdf", srdf, "--request", request_file, "--world", scene)
    request = kinematics.yaml.load(request_file.read_text(), Loader=kinematics.yaml.CSafeLoader)
    state = request["start_state"]["joint_state"]
    start = dict(zip(state["name"], state["position"]))
    goal = {one["joint_name"]: one["position"] for one in request["goal_constraints"][0]["joint_constraints"]}
    robot = kinematics.Robot(urdf)
    around, allowed = kinematics.world_of(scene)
    compare(answer, overlaps, robot, around, robot.joined() | allowed, start, goal)
