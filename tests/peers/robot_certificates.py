#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the certificates of planning problems of robots that are clear and proves them again: pairs, bytes, and
the processor time of the search and of impinge-verify.

    IMPINGE_ROBOTS=FOLDER python3 tests/peers/robot_certificates.py [PROBLEMS OF EACH KIND (1) [VERIFIER]]

The folder is that of test_robots.py."""

import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

from impinge import robot

from robot_speed import edges


def verify(verifier, path):
    """The verifier's answer, and its processor seconds."""
    begun = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = subprocess.run([verifier, str(path), "--quiet"], capture_output=True, text=True, check=False).stdout.strip()
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    return said, ended.ru_utime + ended.ru_stime - begun.ru_utime - begun.ru_stime


def measure(name, arm, problems, verifier, path):
    """Prints a line for each problem that is clear; returns how many of them are not proved again."""
    refused = 0
    for positions, world in problems:
        scene = arm.scene([0, 1], positions, world=world)
        begun = time.process_time()
        result = scene.solve(proof=path)
        took = time.process_time() - begun
        if result.verdict != "clear":
            continue
        said, seconds = verify(verifier, path)
        refused += said != "holds"
        print(f"{name}: {result.pairs} pairs, {path.stat().st_size} bytes, searched and written in {1e3 * took:.1f} ms, "
              f"verified in {1e3 * seconds:.0f} ms: {said}")
    return refused


def main(most="1", verifier="impinge-verify"):
    """Prints a line for each problem that is clear; fails where a certificate is refused."""
    folder = os.environ.get("IMPINGE_ROBOTS")
    if folder is None:
        print("robot_certificates: skipped: IMPINGE_ROBOTS names no folder of robots")
        return 77
    refused = 0
    with tempfile.TemporaryDirectory() as own_folder:
        for own in sorted(path for path in pathlib.Path(folder).iterdir() if (path / f"{path.name}.urdf").exists()):
            arm = robot.load(own / f"{own.name}.urdf", own / f"{own.name}.srdf")
            path = pathlib.Path(own_folder) / "proof"
            refused += measure(own.name, arm, edges(arm, own, int(most)), verifier, path)
    return refused > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
