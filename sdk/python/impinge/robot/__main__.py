# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""python3 -m impinge.robot: does a motion of a robot touch anything, or come too near?"""

import argparse
import csv
import dataclasses
import json
import sys
from typing import Any, Dict, List, Tuple

from .. import _files
from ..errors import ImpingeError, PluginError, SceneError, UsageError
from ..results import Clearance, Result
from . import Robot, load
from ._moveit import read_request, read_world

_STATUS = {"clear": 0, "contact": 1, "holds": 0, "violated": 1, "undecided": 3}


def _arguments(line: List[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python3 -m impinge.robot", description=__doc__,
        epilog="Exit status: 0 clear or holds, 1 contact or violated, 2 usage, 3 undecided, 4 bad file, "
               "5 plugin. Joints move linearly between positions. Links are surfaces: what is inside of "
               "another body from the start on touches nothing.")
    parser.add_argument("urdf")
    parser.add_argument("--srdf", help="pairs of links that it disables are not tested")
    parser.add_argument("--package", action="append", default=[], metavar="NAME=FOLDER",
                        help="where meshes of package://NAME/... are; may be repeated")
    parser.add_argument("--trajectory", metavar="FILE.csv",
                        help="times in the first column, joints by name in its head")
    parser.add_argument("--request", metavar="FILE.yaml", help="start and goal of a motion plan request")
    parser.add_argument("--start", metavar="Q,Q,...", help="positions at t = 0 (all as near 0 as allowed)")
    parser.add_argument("--goal", metavar="Q,Q,...", help="positions at t = 1")
    parser.add_argument("--world", metavar="FILE.yaml", help="a planning scene")
    parser.add_argument("--require", type=float, metavar="DISTANCE", help="is this distance kept?")
    parser.add_argument("--gamma", type=float, help="what is no farther apart touches (1e-6)")
    parser.add_argument("--max-seconds", type=float, help="end as undecided")
    parser.add_argument("--view", metavar="FILE", help="draw it, in the format of the extension")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser.parse_args(line)


def _packages(words: List[str]) -> Dict[str, str]:
    packages = {}
    for word in words:
        name, equals, folder = word.partition("=")
        if not (name and equals and folder):
            raise UsageError(f"--package: got {word!r}, must be NAME=FOLDER")
        packages[name] = folder
    return packages


def _row(robot: Robot, option: str, text: str) -> Dict[str, float]:
    try:
        row = [float(word) for word in text.split(",")]
    except ValueError:
        row = []
    if len(row) != len(robot.joints):
        raise UsageError(f"{option}: got {text!r}, must be {len(robot.joints)} numbers: "
                         f"{', '.join(joint.name for joint in robot.joints)}")
    return {joint.name: value for joint, value in zip(robot.joints, row)}


def _table(path: str) -> Tuple[List[float], Dict[str, List[float]]]:
    """Times and columns of a CSV file whose head names the joints."""
    try:
        rows = list(csv.reader(_files.read(path).decode("utf-8-sig").splitlines()))
    except (UnicodeDecodeError, csv.Error) as error:
        raise SceneError(f"{path}: {error}") from None
    head = [name.strip() for name in rows[0]] if rows else []
    columns: List[List[float]] = [[] for _ in head]
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(head):
            raise SceneError(f"{path}:{number}: got {len(row)} cells, must be {len(head)} as in the head")
        for column, cell in zip(columns, row):
            try:
                column.append(float(cell))
            except ValueError:
                raise SceneError(f"{path}:{number}: got {cell!r}, must be a number") from None
    if len(head) < 2 or len(columns[0]) < 2:
        raise SceneError(f"{path}: must have a head (time, joints by name) and two rows or more")
    return columns[0], dict(zip(head[1:], columns[1:]))


def _course(robot: Robot, asked: argparse.Namespace) -> Tuple[List[float], Dict[str, List[float]]]:
    given = [name for name in ("trajectory", "request", "goal") if getattr(asked, name) is not None]
    if len(given) != 1:
        raise UsageError("give one of --trajectory, --request and --goal (with --start)")
    if asked.trajectory is not None:
        return _table(asked.trajectory)
    start: Dict[str, float] = {}
    if asked.request is not None:
        start, goal = read_request(asked.request)
    else:
        goal = _row(robot, "--goal", asked.goal)
        start = {joint.name: min(max(0.0, joint.lower), joint.upper) for joint in robot.joints}
        if asked.start is not None:
            start = _row(robot, "--start", asked.start)
    moving = {joint.name for joint in robot.joints}
    return [0.0, 1.0], {name: [start[name], goal[name]] for name in start if name in moving}


def _tell(answer: Any) -> None:
    """One line for people."""
    pair = " and ".join(answer.bodies) if answer.bodies else "no bodies"
    if isinstance(answer, Clearance):
        print(f"{answer.verdict}: required {answer.required!r}, proved never nearer than {answer.lower:.6g}")
        if answer.t_violated is not None and answer.a_violated is not None and answer.b_violated is not None:
            print(f"first violation at t = {answer.t_violated:.6g}: {answer.a_violated.body} and "
                  f"{answer.b_violated.body}, {answer.gap_violated:.6g} apart")
    elif answer.verdict == "contact":
        print(f"contact at t = {answer.t:.9g}: {pair}, {answer.gap:.3g} apart")
    elif answer.verdict == "clear":
        print(f"clear from t = {answer.t_start:.6g} to {answer.t_end:.6g}, proved")
    else:
        print(f"undecided ({answer.reason}): proved clear before t = {answer.t_lower:.6g}")


def _plain(answer: Any) -> Dict[str, Any]:
    """For JSON, which has no infinite numbers."""
    return {name: None if isinstance(value, float) and value in (float("inf"), -float("inf")) else value
            for name, value in dataclasses.asdict(answer).items()}


def _run(asked: argparse.Namespace) -> int:
    robot = load(asked.urdf, asked.srdf, _packages(asked.package))
    times, positions = _course(robot, asked)
    scene = robot.scene(times, positions, world=read_world(asked.world) if asked.world else ())
    answer: "Result | Clearance"
    if asked.require is None:
        answer = scene.solve(gamma=asked.gamma, max_seconds=asked.max_seconds)
    else:
        answer = scene.clearance(required=asked.require, gamma=asked.gamma, max_seconds=asked.max_seconds)
    if asked.view is not None:
        scene.view(asked.view)
    if asked.json:
        print(json.dumps(_plain(answer)))
    else:
        _tell(answer)
    return _STATUS[answer.verdict or "undecided"]


def main(line: List[str]) -> int:
    """Answers a command line; its exit status."""
    asked = _arguments(line)
    try:
        return _run(asked)
    except ImpingeError as error:
        print(f"impinge.robot: {error}", file=sys.stderr)
        if asked.json:
            print(json.dumps({"error": str(error)}))
        if isinstance(error, UsageError):
            return 2
        return 5 if isinstance(error, PluginError) else 4


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
