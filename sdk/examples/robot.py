# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Is a straight edge in joint space free? python3 robot.py tools/data/arm.urdf [picture.png]"""

import sys

from impinge import robot

if len(sys.argv) < 2:
    sys.exit(__doc__)
arm = robot.load(sys.argv[1])
board = {"type": "box", "size": [0.3, 0.8, 0.02], "center": [0.55, 0, 0.75]}
shelf = {"name": "shelf", "surfaces": [board]}
start = {"lift": -1.0, "bend": -0.3}

# A planner would ask this of each edge; the robot's files are read once.
for lift in (-0.4, 0.2, 0.8):
    edge = {"lift": [start["lift"], lift], "bend": start["bend"], "turn": [0, 0.5]}
    scene = arm.scene([0, 1], edge, world=[shelf])  # or world="scene.yaml", as MoveIt writes it
    answer = scene.solve()
    if answer.verdict == "contact":
        a, b = answer.bodies
        print(f"to lift = {lift}: {a} touches {b} at t = {answer.t:.6f}, not before")
    else:
        print(f"to lift = {lift}: {answer.verdict}, {scene.clearance().lower * 1000:.1f} mm apart")
if len(sys.argv) > 2:
    scene.view(sys.argv[2])
