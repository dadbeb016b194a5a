# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""python3 -m impinge.robot: does a motion of a robot touch anything, or come too near?"""

import argparse
import json
import signal
import sys
from typing import Any, Dict, List, NoReturn, Optional, Tuple

from ..errors import ImpingeError, PluginError, UsageError
from ..scene import Scene
from . import Robot, load
from ._course import Table, read_table
from ._matrix_report import as_json as matrix_json
from ._matrix_report import line_of, status_of, summary_of
from ._moveit import read_request
from ._report import Answer, as_json, as_text, sample

_STATUS = {"clear": 0, "contact": 1, "holds": 0, "violated": 1, "undecided": 3}


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message}; --help lists the options")


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"got {text}, must be a number > 0")
    return value


def _errors(text: str) -> Tuple[float, float]:
    try:
        angle, length = (float(word) for word in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"got {text}, must be ANGLE,LENGTH, such as 0.01745,0.0005") from None
    if not (0 <= angle < float("inf") and 0 <= length < float("inf") and angle + length > 0):
        raise argparse.ArgumentTypeError(f"got {text}, must be an angle and a length, neither negative")
    return angle, length


def _count(text: str) -> int:
    value = int(text)
    if value < 2:
        raise argparse.ArgumentTypeError(f"got {text}, must be 2 or more")
    return value


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="python3 -m impinge.robot", description=__doc__, allow_abbrev=False,
        epilog="Exit status: 0 clear or holds, 1 contact or violated, 2 usage, 3 undecided, 4 bad file, "
               "5 plugin. Links are surfaces: what is inside of another body from the start on touches nothing. "
               "Positions go as by joint_trajectory_controller's default: linear between those of a table, "
               "cubic where it has columns NAME.velocity, quintic with NAME.acceleration too.")
    parser.add_argument("urdf", help="the robot, a URDF file")
    parser.add_argument("--srdf", metavar="FILE", help="pairs of links that it disables are not tested; its groups and "
                                                       "states have names")
    parser.add_argument("--package", action="append", default=[], metavar="NAME=FOLDER",
                        help="where meshes of package://NAME/... are, if not above the URDF file; may be repeated")
    parser.add_argument("--trajectory", metavar="FILE.csv",
                        help="times in the first column, positions of joints by name in its head; others rest")
    parser.add_argument("--interpolation", choices=("splines", "linear", "cubic"), default="splines",
                        help="of a trajectory: as above, or without velocities: linear, or smooth")
    parser.add_argument("--request", metavar="FILE.yaml", help="start and goal of a motion plan request")
    parser.add_argument("--start", metavar="POSE", help="positions at t = 0: NAME of a state, or JOINT=Q,..., or Q,Q,... "
                                                        "(otherwise 0, or as near as limits allow)")
    parser.add_argument("--goal", metavar="POSE", help="positions at t = 1; joints that it does not name stay")
    parser.add_argument("--group", metavar="NAME", help="Q,Q,... are those of the joints of this group")
    parser.add_argument("--world", metavar="FILE.yaml", help="a planning scene; its allowed collision matrix, if it has "
                                                             "one, replaces what the SRDF file disables")
    parser.add_argument("--check-matrix", action="store_true",
                        help="instead of a motion: do the links that the SRDF file disables ever touch, over all "
                             "positions of the joints between them? (--max-seconds for each pair: 10)")
    parser.add_argument("--all", action="store_true", help="with --check-matrix: all pairs of links, and which of them "
                                                           "could be disabled")
    parser.add_argument("--require", type=_positive, metavar="DISTANCE", help="is this distance kept?")
    parser.add_argument("--robust", type=_errors, metavar="ANGLE,LENGTH",
                        help="answer for every motion near this one: each joint off by up to the angle, or if it "
                             "slides the length, and each body off by up to the length in any direction")
    parser.add_argument("--gamma", type=_positive, help="what is no farther apart touches (1e-6)")
    parser.add_argument("--max-seconds", type=_positive, metavar="S", help="end as undecided")
    parser.add_argument("--compare-samples", type=_count, metavar="N", help="tell what N single poses show and miss")
    parser.add_argument("--view", metavar="FILE", help="draw it, in the format of the extension")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    return parser


def _joined(line: List[str]) -> List[str]:
    """The words, with --goal -1,2 as --goal=-1,2: argparse would take the number for an option."""
    words: List[str] = []
    for word in line:
        if words and words[-1] in ("--start", "--goal") and word[:1] == "-" and word[1:2] in "0123456789.":
            words[-1] += "=" + word
        else:
            words.append(word)
    return words


def _packages(words: List[str]) -> Dict[str, str]:
    packages = {}
    for word in words:
        name, equals, folder = word.partition("=")
        if not (name and equals and folder):
            raise UsageError(f"--package: got {word!r}, must be NAME=FOLDER")
        packages[name] = folder
    return packages


def _numbers(option: str, text: str, words: List[str]) -> Optional[List[float]]:
    """None: the first word is no number, and so all is a name."""
    numbers = []
    for word in words:
        try:
            numbers.append(float(word))
        except ValueError:
            if not numbers:
                return None
            raise UsageError(f"{option}: got {word!r} in {text!r}, must be a number") from None
    return numbers


def _pose(robot: Robot, option: str, text: str, group: Optional[str]) -> Dict[str, float]:
    """Positions by name, of a state's name, of JOINT=Q,... or of Q,Q,..."""
    if "=" in text:
        words = [word.partition("=") for word in text.split(",")]
        found = _numbers(option, text, [value for _, _, value in words])
        if found is None:
            raise UsageError(f"{option}: got {text!r}, must be JOINT=Q,JOINT=Q,... with numbers")
        return dict(zip((name.strip() for name, _, _ in words), found))
    row = _numbers(option, text, text.split(","))
    if row is None:
        if text not in robot.states:
            raise UsageError(f"{option}: got {text!r}, which is no state of the SRDF file (its states: "
                             f"{', '.join(sorted(robot.states)) or 'none'}) and not JOINT=Q,... or Q,Q,...")
        return robot.state(text)
    names = robot.variables
    if group is not None:
        if group not in robot.groups:
            raise UsageError(f"--group: got {group!r}, must be one of {', '.join(robot.groups) or 'none'}: those "
                             "of the SRDF file")
        names = tuple(name for name in robot.variables if name.partition("/")[0] in robot.groups[group])
    if len(row) != len(names):
        raise UsageError(f"{option}: got {text!r}, must be {len(names)} number{'s' if len(names) != 1 else ''}: "
                         f"{', '.join(names)}")
    return dict(zip(names, row))


def _edge(robot: Robot, asked: argparse.Namespace, notes: List[str]) -> Table:
    """The straight edge from a start to a goal."""
    start: Dict[str, float] = {}
    if asked.request is not None:
        start, goal = read_request(asked.request)
        where = asked.request, asked.request
    else:
        goal, where = _pose(robot, "--goal", asked.goal, asked.group), ("--start", "--goal")
    if asked.start is not None:
        start, where = _pose(robot, "--start", asked.start, asked.group), ("--start", where[1])
    start, left = robot.own_positions(start, where[0])
    goal, more = robot.own_positions({**start, **goal}, where[1])
    notes += [*left, *(note for note in more if note not in left)]
    return Table([0.0, 1.0], {name: [start.get(name, robot.rest[name]), goal[name]] for name in goal}, {}, {})


def _table(robot: Robot, asked: argparse.Namespace, notes: List[str]) -> Table:
    given = [name for name in ("trajectory", "request", "goal") if getattr(asked, name) is not None]
    if len(given) != 1:
        raise UsageError(f"got {' and '.join('--' + name for name in given) or 'no motion'}, must be one of "
                         "--trajectory, --request and --goal (with --start)")
    if asked.trajectory is None:
        return _edge(robot, asked, notes)
    if asked.start is not None:
        raise UsageError("--start: is of no use with --trajectory, whose first row is the start")
    return read_table(asked.trajectory)


def _scene(robot: Robot, table: Table, asked: argparse.Namespace) -> Scene:
    """The motion; what is wrong with a table is told with its file."""
    try:
        return robot.scene(table.times, table.positions, velocities=table.velocities or None,
                           accelerations=table.accelerations or None, interpolation=asked.interpolation,
                           world=asked.world, errors=asked.robust)
    except UsageError as error:
        if asked.trajectory is None or not str(error).startswith(("positions", "velocities", "accelerations")):
            raise
        raise UsageError(f"{asked.trajectory}: {error}") from None


def _answer(asked: argparse.Namespace) -> Answer:
    robot = load(asked.urdf, asked.srdf, _packages(asked.package))
    notes: List[str] = []
    table = _table(robot, asked, notes)
    scene = _scene(robot, table, asked)
    if asked.robust is not None:
        return _robust_answer(scene, asked, notes)
    limits: Dict[str, Any] = {"gamma": asked.gamma, "max_seconds": asked.max_seconds}
    clearance = contact = samples = None
    if asked.require is not None:
        clearance = scene.clearance(required=asked.require, **limits)
    if clearance is None or clearance.verdict == "violated":
        contact = scene.solve(**limits)
    if asked.compare_samples is not None:
        span = table.times[0], table.times[-1]
        samples = sample(scene, span, asked.compare_samples, asked.require, asked.gamma)
    if asked.view is not None:
        scene.view(asked.view, gamma=asked.gamma, max_seconds=asked.max_seconds)
    return Answer(contact, clearance, samples, notes)


def _robust_answer(scene: Scene, asked: argparse.Namespace, notes: List[str]) -> Answer:
    """The errors of joints are parameters of the scene. Two bodies that are each off by up to a length come
    nearer by no more than twice that, and may do so: that is required in addition."""
    for name in ("compare_samples", "view"):
        if getattr(asked, name) is not None:
            raise UsageError(f"--{name.replace('_', '-')}: is of no use with --robust, which asks about many motions")
    kept = asked.require if asked.require is not None else asked.gamma if asked.gamma is not None else 1e-6
    found = scene.clearance(required=kept + 2 * asked.robust[1], gamma=asked.gamma, max_seconds=asked.max_seconds)
    return Answer(None, found, None, notes, asked.robust)


def _check_matrix(asked: argparse.Namespace) -> int:
    """Tells about each pair of links as soon as it is known; the exit status."""
    robot = load(asked.urdf, asked.srdf, _packages(asked.package))
    if not asked.all and not robot.matrix():
        raise UsageError("--check-matrix: no pair of links is disabled; give --srdf FILE with <disable_collisions>, "
                         "or --all for all pairs")
    limits = {} if asked.max_seconds is None else {"max_seconds": asked.max_seconds}
    pairs = []
    for a, b in robot.matrix(asked.all):
        pairs.append(robot.check_pair(a, b, gamma=asked.gamma, **limits))
        if not asked.json:
            print(line_of(pairs[-1]), flush=True)
    print(json.dumps(matrix_json(pairs)) if asked.json else "\n".join(summary_of(pairs)))
    return status_of(pairs)


def _refuse_beside_matrix(asked: argparse.Namespace) -> None:
    for name in ("trajectory", "request", "start", "goal", "world", "require", "compare_samples", "view", "robust"):
        if getattr(asked, name) is not None:
            raise UsageError(f"--{name.replace('_', '-')}: is of no use with --check-matrix, which asks about all "
                             "positions of the joints")


def _run(asked: argparse.Namespace) -> int:
    """Answers what is asked; the exit status."""
    if asked.all and not asked.check_matrix:
        raise UsageError("--all: belongs to --check-matrix")
    if asked.check_matrix:
        _refuse_beside_matrix(asked)
        return _check_matrix(asked)
    answer = _answer(asked)
    for note in answer.notes:
        print(f"impinge.robot: warning: {note}", file=sys.stderr)
    print(json.dumps(as_json(answer)) if asked.json else as_text(answer))
    return _STATUS[answer.verdict]


def _fail(error: Exception, json_asked: bool) -> None:
    print(f"impinge.robot: {error}", file=sys.stderr)
    if json_asked:
        print(json.dumps({"error": str(error)}))


def main(line: List[str]) -> int:
    """Answers a command line; its exit status."""
    json_asked = "--json" in line
    try:
        return _run(_parser().parse_args(_joined(line)))
    except (ImpingeError, MemoryError) as error:
        _fail(error, json_asked)
        if isinstance(error, UsageError):
            return 2
        return 5 if isinstance(error, PluginError) else 4


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # where `head` has heard enough, it ends without a word
    sys.exit(main(sys.argv[1:]))
