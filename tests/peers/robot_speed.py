# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Measures planning problems of robots, with all of it loaded: the processor time of making a scene of one and of
its `solve`, in ms, and the memory of all scenes in turn.

    IMPINGE_ROBOTS=FOLDER python3 tests/peers/robot_speed.py [PROBLEMS OF EACH KIND (2) [ROUNDS (5)]]

The folder is that of test_robots.py: ROBOT/ROBOT.urdf, .srdf and problems/KIND/request*.yaml with scene*.yaml."""

import os
import pathlib
import resource
import statistics
import sys
import time

from impinge import robot
from impinge.robot._moveit import read_request


def edges(arm, folder, most):
    """The motions of the problems, from start to goal, and their worlds."""
    found = []
    for kind in sorted(folder.glob("problems/*")):
        for file in sorted(kind.glob("request*.yaml"))[:most]:
            start, goal = read_request(str(file))
            start, _ = arm.own_positions(start, file.name)
            goal, _ = arm.own_positions({**start, **goal}, file.name)
            world = arm.world(file.with_name(file.name.replace("request", "scene")))
            found.append(({name: [start.get(name, arm.rest[name]), goal[name]] for name in goal}, world))
    return found


def measure(arm, problems, rounds):
    """Seconds of each scene and each solve; pairs of the last round. The first round reads, and does not count."""
    seconds, pairs = ([], []), 0
    for k in range(rounds + 1):
        pairs = 0
        for positions, world in problems:
            begun = time.process_time()
            scene = arm.scene([0, 1], positions, world=world)
            made = time.process_time()
            pairs += scene.solve().pairs
            solved = time.process_time()
            if k > 0:
                seconds[0].append(made - begun)
                seconds[1].append(solved - made)
    return (*seconds, pairs)


def main(most=2, rounds=5):
    """Prints a line for each robot."""
    folder = os.environ.get("IMPINGE_ROBOTS")
    if folder is None:
        print("robot_speed: skipped: IMPINGE_ROBOTS names no folder of robots")
        return 77
    for own in sorted(path for path in pathlib.Path(folder).iterdir() if (path / f"{path.name}.urdf").exists()):
        arm = robot.load(own / f"{own.name}.urdf", own / f"{own.name}.srdf")
        problems = edges(arm, own, most)
        making, solving, pairs = measure(arm, problems, rounds)
        both = [1e3 * (x + y) for x, y in zip(making, solving)]
        print(f"{own.name}: {len(problems)} problems, {pairs} pairs; mean {statistics.mean(both):.2f} ms, median "
              f"{statistics.median(both):.2f} ms; scene {1e3 * statistics.mean(making):.2f}, solve "
              f"{1e3 * statistics.mean(solving):.2f}; {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
