# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""A ball rolls past a dented sheet: control points and the profile of clearance as NumPy arrays."""

import impinge
import numpy

# Control points of a bicubic patch over [-1, 1]^2, dented in the middle; all of it moves upwards.
x, y = numpy.meshgrid(numpy.linspace(-1, 1, 4), numpy.linspace(-1, 1, 4), indexing="ij")
points = numpy.stack([x, y, -0.3 * numpy.exp(-3 * (x**2 + y**2))], axis=-1).reshape(-1, 3)
velocities = numpy.zeros_like(points)
velocities[:, 2] = 0.1

builder = impinge.Builder(time=(0, 1))
builder.body("sheet").surface("bezier", degree=[3, 3], points=points, velocities=velocities)
builder.body("ball").surface("sphere", radius=0.25).map(
    "translate", offset=numpy.array([[-1.5, 0, 0.5], [2.5, 0, 0]]))
scene = builder.build()

profile = scene.profile(12, required=0.2)
for t0, t1, lower, upper, verdict in zip(profile.t0, profile.t1, profile.lower, profile.upper,
                                         profile.verdict):
    print(f"{t0:.2f} to {t1:.2f}: from {lower:.4f} to {upper:.4f}, {verdict}")

tightest = numpy.argmin(profile.upper)
print(f"tightest in slice {tightest}, {profile.upper[tightest]:.4f}")
