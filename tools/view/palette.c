/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/palette.h"

#include <math.h>

const colour palette_mark = {0.84f, 0.10f, 0.11f};

/* Construction: a blue and an orange, then in each step the colour that is farthest from all before
 * it and, weighted by 0.7, from the mark and white and, by 0.6, from black, among those of
 * lightness 0.52, 0.64, 0.76 or 0.88, chroma 0.06, 0.12 or 0.18, and 36 hues, as far as a screen
 * shows them. */
colour palette_colour(size_t k)
{
    static const colour all[PALETTE_COUNT] = {
        {0.400f, 0.620f, 0.860f}, {0.950f, 0.650f, 0.320f}, {0.271f, 0.647f, 0.174f},
        {0.937f, 0.510f, 0.905f}, {0.482f, 0.280f, 0.748f}, {0.393f, 0.432f, 0.276f},
        {0.323f, 0.790f, 0.649f}, {0.576f, 0.956f, 0.492f}, {0.660f, 0.534f, 0.132f},
        {0.159f, 0.423f, 0.670f}, {0.675f, 0.451f, 0.726f}, {0.641f, 0.754f, 0.010f},
        {0.814f, 0.635f, 0.715f}, {0.402f, 0.597f, 0.528f}, {0.956f, 0.850f, 0.085f},
        {0.392f, 0.938f, 0.967f}, {0.656f, 0.192f, 0.536f}, {0.490f, 0.363f, 0.477f},
        {0.478f, 0.478f, 0.963f}, {0.682f, 0.494f, 0.490f}, {0.690f, 0.641f, 0.973f},
        {0.701f, 0.710f, 0.537f}, {0.257f, 0.762f, 0.900f}, {0.847f, 0.332f, 0.609f}};
    return all[k % PALETTE_COUNT];
}

/* From sRGB as shown to linear light. */
static double linear(double share)
{
    return share <= 0.04045 ? share / 12.92 : pow((share + 0.055) / 1.055, 2.4);
}

static void oklab(colour c, double lab[3])
{
    static const double cones[3][3] = {{0.4122214708, 0.5363325363, 0.0514459929},
                                       {0.2119034982, 0.6806995451, 0.1073969566},
                                       {0.0883024619, 0.2817188376, 0.6299787005}};
    static const double axes[3][3] = {{0.2104542553, 0.7936177850, -0.0040720468},
                                      {1.9779984951, -2.4285922050, 0.4505937099},
                                      {0.0259040371, 0.7827717662, -0.8086757660}};
    const double rgb[3] = {linear(c.r), linear(c.g), linear(c.b)};
    double seen[3];
    for (int i = 0; i < 3; ++i)
        seen[i] = cbrt(cones[i][0] * rgb[0] + cones[i][1] * rgb[1] + cones[i][2] * rgb[2]);
    for (int i = 0; i < 3; ++i)
        lab[i] = axes[i][0] * seen[0] + axes[i][1] * seen[1] + axes[i][2] * seen[2];
}

double palette_distance(colour a, colour b)
{
    double x[3], y[3];
    oklab(a, x);
    oklab(b, y);
    return sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) +
                (x[2] - y[2]) * (x[2] - y[2]));
}
