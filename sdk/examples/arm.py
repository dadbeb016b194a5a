# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Does a six-joint arm stay 2 mm away from a fixture? python3 arm.py tools/data/arm.json"""

import sys

import impinge

scene = impinge.Scene.from_file(sys.argv[1])

answer = scene.clearance(required=2, tolerance=1e-3)  # without tolerance: only the verdict
print(f"{answer.verdict}, tightest {answer.upper:.4g} mm at t = {answer.t:.3g} "
      f"between {answer.a.body} and {answer.b.body}")

# The same motion in ten slices, as NumPy arrays.
profile = scene.profile(10, required=2)
for t0, t1, lower in zip(profile.t0, profile.t1, profile.lower):
    print(f"{t0:.1f} to {t1:.1f}: at least {lower:.4g} mm")
