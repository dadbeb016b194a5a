/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/expression_oracle.h"
#include "tests/support/map_oracle.h"
#include "tests/support/shape_oracle.h"

#include <stdlib.h>

const imp_value *argument(const type_arguments *arguments, const char *name)
{
    ptrdiff_t row = parameter_table_find(&arguments->table, name);
    if (row < 0) abort();
    return &arguments->value[row];
}

number argument_at(const type_arguments *arguments, const char *name, size_t index)
{
    const imp_value *value = argument(arguments, name);
    if (index >= value->count) abort();
    return num(value->number[index]);
}

static number scalar(const type_arguments *arguments, const char *name)
{
    return argument_at(arguments, name, 0);
}

static void add_center(const type_arguments *arguments, number x[3])
{
    for (size_t i = 0; i < 3; ++i) x[i] = num_add(x[i], argument_at(arguments, "center", i));
}

/* radius (cos v cos u, cos v sin u, sin v) */
static void polar(number radius, number u, number v, number x[3])
{
    number ring = num_mul(radius, num_cos(v));
    x[0] = num_mul(ring, num_cos(u));
    x[1] = num_mul(ring, num_sin(u));
    x[2] = num_mul(radius, num_sin(v));
}

/* --- Surfaces --------------------------------------------------------------------------------- */

static void sphere(const type_arguments *arguments, const number p[3], number x[3])
{
    polar(scalar(arguments, "radius"), p[0], p[1], x);
    add_center(arguments, x);
}

static void torus(const type_arguments *arguments, const number p[3], number x[3])
{
    number tube = scalar(arguments, "minor_radius");
    number ring = num_add(scalar(arguments, "major_radius"), num_mul(tube, num_cos(p[1])));
    x[0] = num_mul(ring, num_cos(p[0]));
    x[1] = num_mul(ring, num_sin(p[0]));
    x[2] = num_mul(tube, num_sin(p[1]));
    add_center(arguments, x);
}

/* One of a spike's repetitions. */
static number peak(const type_arguments *arguments, size_t k, int turn, const number p[3])
{
    const double *top = argument(arguments, "spikes")->number;
    number longitude = num_add(num(top[2 * k]), num_mul(num(2 * turn), num_pi()));
    number east = num_sub(p[0], longitude), north = num_sub(p[1], num(top[2 * k + 1]));
    number square = num_add(num_sqr(east), num_sqr(north));
    number fall = num_div(square, num_sqr(scalar(arguments, "width")));
    return num_is_less(num(5000), fall) ? num(0) : num_exp(num_neg(fall)); /* 10^-2171 at most */
}

static void spike(const type_arguments *arguments, const number p[3], number x[3])
{
    number sum = num(0);
    for (size_t k = 0; k < argument(arguments, "spikes")->extent[0]; ++k)
        for (int turn = -40; turn <= 40; ++turn) sum = num_add(sum, peak(arguments, k, turn, p));
    number height = num_mul(scalar(arguments, "height"), sum);
    polar(num_add(scalar(arguments, "radius"), height), p[0], p[1], x);
    add_center(arguments, x);
}

static number bernstein(unsigned n, unsigned i, number u)
{
    double choose = 1;
    for (unsigned k = 0; k < i; ++k) choose = choose * (n - k) / (k + 1);
    number rest = num_power(num_sub(num(1), u), n - i);
    return num_mul(num(choose), num_mul(num_power(u, i), rest));
}

static void bezier(const type_arguments *arguments, const number p[3], number x[3])
{
    weighting along[2];
    for (int side = 0; side < 2; ++side) {
        const unsigned n = (unsigned)argument(arguments, "degree")->number[side];
        along[side].count = n + 1;
        for (unsigned i = 0; i <= n; ++i) along[side].of[i] = bernstein(n, i, p[side]);
    }
    patch_oracle(arguments, along, p[2], x);
}

/* --- Maps ------------------------------------------------------------------------------------- */

/* Component i of a polynomial given by all coefficients or by its rate of change. */
static number polynomial(const type_arguments *arguments, const char *rate,
                         const char *coefficients, size_t i, number t)
{
    const imp_value *all = argument(arguments, coefficients);
    if (!all->count) return num_mul(argument_at(arguments, rate, i), t);
    size_t width = all->count / all->extent[0];
    return num_poly(all->number + i, all->extent[0], width, t);
}

/* In the middle of its parts a tolerance displaces nothing. */
static void stay(const type_arguments *arguments, const number p[4], number x[3])
{
    (void)arguments;
    for (int i = 0; i < 3; ++i) x[i] = p[i];
}

static void translate(const type_arguments *arguments, const number p[4], number x[3])
{
    number way;
    for (size_t i = 0; i < 3; ++i) {
        if (!table_oracle(arguments, "positions", i, p[3], &way))
            way = polynomial(arguments, "velocity", "offset", i, p[3]);
        x[i] = num_add(p[i], way);
    }
}

/* Rodrigues: w cos A + (k x w) sin A + k (k.w) (1 - cos A). */
static void turn_about(const type_arguments *arguments, number angle, const number p[3],
                       number x[3])
{
    number cosine = num_cos(angle), sine = num_sin(angle), k[3], w[3], square = num(0);
    for (size_t i = 0; i < 3; ++i) {
        k[i] = argument_at(arguments, "axis", i);
        w[i] = num_sub(p[i], argument_at(arguments, "center", i));
        square = num_add(square, num_sqr(k[i]));
    }
    number dot = num(0);
    for (int i = 0; i < 3; ++i) {
        k[i] = num_div(k[i], num_sqrt(square));
        dot = num_add(dot, num_mul(k[i], w[i]));
    }
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, l = (i + 2) % 3;
        number cross = num_sub(num_mul(k[j], w[l]), num_mul(k[l], w[j]));
        number axial = num_mul(num_mul(k[i], dot), num_sub(num(1), cosine));
        x[i] = num_add(num_add(num_mul(w[i], cosine), num_mul(cross, sine)), axial);
    }
    add_center(arguments, x);
}

static void rotate(const type_arguments *arguments, const number p[4], number x[3])
{
    number angle;
    if (!table_oracle(arguments, "angles", 0, p[3], &angle))
        angle = polynomial(arguments, "rate", "angle", 0, p[3]);
    turn_about(arguments, angle, p, x);
}

/* --- Texts of formulas ------------------------------------------------------------------------ */

enum { NAMES = 20 };

/* Variables, which are one letter each, then constants. */
static number text_value(const type_arguments *arguments, const char *text,
                         const char *const *variable, const number *p, size_t variables)
{
    const imp_value *constants = argument(arguments, "constants");
    const char *name[NAMES];
    number value[NAMES];
    size_t count = 0;
    if (variables + constants->count > NAMES) abort();
    for (size_t k = 0; k < variables; ++k, ++count) name[count] = variable[k], value[count] = p[k];
    for (size_t k = 0; k < constants->count; ++k, ++count) {
        name[count] = constants->string[k];
        value[count] = num(constants->number[k]);
    }
    const oracle_names names = {count, name, value};
    return expression_oracle(text, &names);
}

static void texts(const type_arguments *arguments, const char *const *variable, const number *p,
                  size_t variables, number x[3])
{
    static const char *const coordinate[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i)
        x[i] = text_value(arguments, argument(arguments, coordinate[i])->string[0], variable, p,
                          variables);
}

static void formula(const type_arguments *arguments, const number p[3], number x[3])
{
    static const char *const variable[] = {"u", "v", "t"};
    texts(arguments, variable, p, 3, x);
}

static void map_formula(const type_arguments *arguments, const number p[4], number x[3])
{
    static const char *const variable[] = {"x", "y", "z", "t"};
    texts(arguments, variable, p, 4, x);
}

static void motion_formula(const type_arguments *arguments, const number p[4], number x[3])
{
    static const char *const variable[] = {"t"};
    const imp_value *offset = argument(arguments, "offset"), *angle = argument(arguments, "angle");
    for (int i = 0; i < 3; ++i) x[i] = p[i];
    if (angle->count > 0)
        turn_about(arguments, text_value(arguments, angle->string[0], variable, p + 3, 1), p, x);
    for (int i = 0; i < 3; ++i)
        x[i] = num_add(x[i], text_value(arguments, offset->string[i], variable, p + 3, 1));
}

/* --- The table -------------------------------------------------------------------------------- */

const type_oracle oracles[] = {
    {.type = "sphere",
     .surface = sphere,
     .instances = {"{}", "{\"radius\": +, \"center\": [?,?,?]}",
                   "{\"radius\": 1e-3, \"center\": [1e8,-1e8,1e-8]}",
                   "{\"radius\": 1e9, \"center\": [0,0,-1e9]}"}},
    {.type = "torus",
     .surface = torus,
     .instances = {"{}", "{\"major_radius\": +, \"minor_radius\": +, \"center\": [?,?,?]}",
                   "{\"major_radius\": 1e6, \"minor_radius\": 1e-6, \"center\": [1e6,0,0]}"}},
    {.type = "spike",
     .surface = spike,
     .instances = {"{}", "{\"radius\": +, \"height\": ?, \"width\": 0.3, \"spikes\": [@3[?,?]]}",
                   "{\"width\": 1e-3, \"spikes\": [[0,0],[6.28,1.5],[3,-1]]}",
                   "{\"width\": 3, \"height\": -0.5, \"spikes\": [[100,0]], \"center\": [?,?,?]}",
                   "{\"width\": 2.5, \"spikes\": [[83.05,?],[-100,?],[98.7,0.5]]}",
                   "{\"width\": 0.02, \"spikes\": [[83.05,0],[-99.75,0.25],[44,-1],[-17.5,1]]}",
                   "{\"width\": 0.3, \"height\": 1e300, \"spikes\": [[-61,0],[90,1]]}"}},
    {.type = "bezier",
     .surface = bezier,
     .instances =
         {"{\"degree\": [3,3], \"points\": [@16[?,?,?]]}",
          "{\"degree\": [3,3], \"points\": [@16[?,?,?]], \"velocities\": [@16[?,?,?]]}",
          "{\"degree\": [1,1], \"points\": [@4[?,?,?]], \"velocities\": [@4[?,?,?]]}",
          "{\"degree\": [2,5], \"points\": [@18[?,?,?]], \"velocities\": [@18[?,?,?]]}",
          "{\"degree\": [3,2], \"points\": [@12[?,?,?]], \"weights\": [@12+]}",
          "{\"degree\": [2,2], \"points\": [@9[?,?,?]], \"weights\": [@9+],"
          " \"velocities\": [@9[?,?,?]]}",
          "{\"degree\": [20,1], \"points\": [@42[?,?,?]], \"velocities\": [@42[?,?,?]]}",
          "{\"degree\": [3,3], \"points\": [[1e8,1,2],@14[?,1e-9,7],[1e8,1,3]],"
          " \"velocities\": [@16[1e3,?,0]]}",
          "{\"degree\": [3,3], \"points\": [@16[?,?,0.3]], \"velocities\": [@16[?,1e3,0.1]]}",
          "{\"degree\": [1,2], \"points\": [[1,0,0],[1,1,0],[0,1,0],[1,0,1],[1,1,1],[0,1,1]],"
          " \"weights\": [1,0.7071067811865476,1,1e-9,1e9,1]}"}},
    {.type = "bezier-triangle", /* its first piece */
     .surface = bezier_triangle_oracle,
     .instances =
         {"{}", "{\"degree\": 1, \"points\": [@3[?,?,?]], \"velocities\": [@3[?,?,?]]}",
          "{\"degree\": 2, \"points\": [@6[?,?,?]], \"weights\": [@6+]}",
          "{\"degree\": 3, \"points\": [@10[?,?,?]], \"velocities\": [@10[?,?,?]]}",
          "{\"degree\": 3, \"points\": [@10[?,?,?]], \"weights\": [@10+],"
          " \"velocities\": [@10[?,?,?]]}",
          "{\"degree\": 5, \"points\": [@21[1e8,?,?]], \"velocities\": [@21[?,1e3,0]]}",
          "{\"degree\": 10, \"points\": [@66[?,?,?]], \"weights\": [@66+],"
          " \"velocities\": [@66[?,?,?]]}",
          "{\"degree\": 2, \"points\": [@7[?,?,?]], \"faces\": [[6,1,3,0,2,5],[0,1,2,3,4,5]],"
          " \"weights\": [@7+], \"velocities\": [@7[?,?,?]]}",
          "{\"degree\": 4, \"points\": [@15[?,?,1]], \"weights\": [1,@13+,1e9]}"}},
    {.type = "ellipsoid",
     .surface = ellipsoid_oracle,
     .instances = {"{}", "{\"radii\": [+,+,+], \"center\": [?,?,?]}",
                   "{\"radii\": [1e6,1,1e-6], \"center\": [1e8,0,-1e-8]}"}},
    {.type = "cylinder",
     .surface = cylinder_oracle,
     .instances = {"{}", "{\"radius\": +, \"height\": +, \"center\": [?,?,?]}",
                   "{\"radius\": 1e-6, \"height\": 1e6, \"center\": [1e8,0,-1e8]}"}},
    {.type = "cone",
     .surface = cone_oracle,
     .instances = {"{}", "{\"radius\": +, \"height\": ?, \"center\": [?,?,?]}",
                   "{\"radius\": 1e6, \"height\": 0}",
                   "{\"radius\": 1e-3, \"height\": -1e3, \"center\": [1e8,0,-1e8]}"}},
    {.type = "disc",
     .surface = disc_oracle,
     .instances = {"{}", "{\"radius\": +, \"center\": [?,?,?], \"axis\": [?,?,?]}",
                   "{\"axis\": [0,-1e-50,0], \"center\": [?,1e8,0]}",
                   "{\"radius\": 1e6, \"axis\": [1e-90,1,1e90]}",
                   "{\"axis\": [1,1,1], \"radius\": 1e-6, \"center\": [1e8,0,-1e8]}"}},
    {.type = "box", /* its first piece */
     .surface = box_oracle,
     .instances = {"{}", "{\"size\": [+,+,+], \"center\": [?,?,?]}",
                   "{\"size\": [1e-6,1,1e6], \"center\": [1e8,0.1,-1e-8]}"}},
    {.type = "capsule", /* its first piece */
     .surface = capsule_oracle,
     .instances = {"{}", "{\"radius\": +, \"from\": [?,?,?], \"to\": [?,?,?]}",
                   "{\"from\": [1,2,3], \"to\": [1,2,3]}",
                   "{\"from\": [0,5,0], \"to\": [0,-1e-3,0], \"radius\": 1e-6}",
                   "{\"from\": [1e8,0,0.1], \"to\": [1e8,?,-1e-8]}"}},
    {.type = "thread",
     .surface = thread_oracle,
     .instances =
         {"{}", "{\"radius\": +, \"pitch\": +, \"height\": +, \"center\": [?,?,?]}",
          "{\"radius\": 4, \"profile\": [@3?], \"pitch\": -1.5, \"starts\": 3}",
          "{\"radius\": 1e6, \"profile\": 1e5, \"pitch\": 1e-3, \"height\": 1}",
          "{\"radius\": 1e-3, \"profile\": [-5e-4,0,4e-4], \"pitch\": 1e6, \"height\": 1e6,"
          " \"starts\": 7, \"center\": [1e8,0,-1e8]}"}},
    {.type = "plane",
     .surface = plane_oracle,
     .instances = {"{}", "{\"origin\": [?,?,?], \"edge_u\": [?,?,?], \"edge_v\": [?,?,?]}",
                   "{\"origin\": [1e8,-1e8,1], \"edge_u\": [1e-8,?,1e9], \"edge_v\": [?,0,?]}"}},
    {.type = "point",
     .surface = point_oracle,
     .instances = {"{}", "{\"position\": [?,?,?], \"velocity\": [?,?,?]}",
                   "{\"position\": [1e8,-1e-8,0], \"velocity\": [?,1e6,1e-9]}"}},
    {.type = "segment",
     .surface = segment_oracle,
     .instances = {"{}", "{\"points\": [@2[?,?,?]], \"velocities\": [@2[?,?,?]]}",
                   "{\"points\": [[1e8,?,?],[?,-1e8,1e-9]], \"velocities\": [@2[?,1e6,0]]}",
                   "{\"points\": [[1,2,3],[1,2,3]], \"velocities\": [[1,0,0],[-1,0,0]]}"}},
    {.type = "triangle",
     .surface = triangle_oracle,
     .instances = {"{}", "{\"points\": [@3[?,?,?]], \"velocities\": [@3[?,?,?]]}",
                   "{\"points\": [@2[1e8,?,?],[?,-1e8,1e-9]], \"velocities\": [@3[?,1e6,0]]}",
                   "{\"points\": [@3[?,?,1]]}"}},
    {.type = "mesh", /* its first piece */
     .surface = mesh_oracle,
     .instances =
         {"{\"points\": [@3[?,?,?]], \"faces\": [[0,1,2]]}",
          "{\"points\": [@5[?,?,?]], \"faces\": [[4,1,3],[0,1,2]], \"velocities\": [@5[?,?,?]]}",
          "{\"points\": [@2[1e8,?,?],[?,-1e8,1e-9]], \"faces\": [[2,0,1]],"
          " \"velocities\": [@3[?,1e6,0]]}",
          "{\"points\": [[0,0,?],[1,0,0],[2,3,?]], \"faces\": [[1,2,0]]}"}},
    {.type = "subdivision", /* its first piece */
     .surface = subdivision_oracle,
     .instances =
         {/* a cube, and one that moves; a tetrahedron, whose second step leaves quads */
          "{\"points\": "
          "[[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],[-1,1,1],[1,1,1]],"
          " \"faces\": [[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],[0,4,6,2],[1,3,7,5]]}",
          "{\"points\": [@8[?,?,?]], \"velocities\": [@8[?,?,?]],"
          " \"faces\": [[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],[0,4,6,2],[1,3,7,5]]}",
          "{\"points\": [@4[?,?,?]], \"faces\": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}",
          /* regular: inside, and with a border on two sides, and on four */
          "{\"points\": [@16[?,?,?]], \"velocities\": [@16[?,?,?]],"
          " \"faces\": [[5,9,10,6],[0,4,5,1],[1,5,6,2],[2,6,7,3],[4,8,9,5],[6,10,11,7],[8,12,13,9],"
          "[9,13,14,10],[10,14,15,11]]}",
          "{\"points\": [@9[1e8,?,?]],"
          " \"faces\": [[0,3,4,1],[1,4,5,2],[3,6,7,4],[4,7,8,5]]}",
          "{\"points\": [@4[?,?,?]], \"velocities\": [@4[?,1e3,?]], \"faces\": [[0,1,2,3]]}",
          /* five faces at a point inside, and at the border three */
          "{\"points\": [@11[?,?,?]], \"velocities\": [@11[?,?,?]],"
          " \"faces\": [[0,1,2,3],[0,3,4,5],[0,5,6,7],[0,7,8,9],[0,9,10,1]]}",
          "{\"points\": [@8[?,?,0.25]], \"velocities\": [@8[?,?,0]],"
          " \"faces\": [[2,3,0,1],[0,3,4,5],[7,0,5,6]]}"}},
    {.type = "subdivision", /* Loop's */
     .surface = subdivision_oracle,
     .instances =
         {/* an octahedron, and a tetrahedron that moves */
          "{\"scheme\": \"loop\", \"points\": [@6[?,?,?]], \"faces\": "
          "[[0,1,2],[0,2,3],[0,3,4],[0,4,1],"
          "[5,2,1],[5,3,2],[5,4,3],[5,1,4]]}",
          "{\"scheme\": \"loop\", \"points\": [@4[?,?,?]], \"velocities\": [@4[?,?,?]],"
          " \"faces\": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}",
          /* regular: inside, at the border, and at a corner of it */
          "{\"scheme\": \"loop\", \"points\": [@12[?,?,?]], \"velocities\": [@12[?,?,?]],"
          " \"faces\": "
          "[[0,1,2],[1,3,2],[0,4,1],[0,2,5],[1,4,7],[1,7,6],[1,6,3],[2,3,8],[2,8,9],[2,9,5],"
          "[0,5,10],[0,10,11],[0,11,4]]}",
          "{\"scheme\": \"loop\", \"points\": [@6[1e8,?,?]], \"faces\": "
          "[[1,4,3],[0,1,3],[1,2,4],[3,4,5]]}",
          "{\"scheme\": \"loop\", \"points\": [@3[?,?,?]], \"velocities\": [@3[?,1e3,?]],"
          " \"faces\": [[0,1,2]]}",
          /* seven faces at a point inside, and at the border two, with a border on one side and
          * both */
          "{\"scheme\": \"loop\", \"points\": [@9[?,?,?]], \"faces\": "
          "[[0,1,2],[0,2,3],[0,3,4],[0,4,5],"
          "[0,5,6],[0,6,7],[0,7,1],[8,2,1],[8,3,2],[8,4,3],[8,5,4],[8,6,5],[8,7,6],[8,1,7]]}",
          "{\"scheme\": \"loop\", \"points\": [@4[?,?,0.25]], \"velocities\": [@4[?,?,0]],"
          " \"faces\": [[0,1,2],[0,2,3]]}",
          "{\"scheme\": \"loop\", \"points\": [@6[?,?,?]], \"velocities\": [@6[?,?,?]],"
          " \"faces\": [[0,1,2],[0,2,3],[0,3,4],[0,4,5]]}"}},
    {.type = "ripple",
     .surface = ripple_oracle,
     .instances = {"{}",
                   "{\"size\": [+,+], \"amplitude\": ?, \"wavelength\": +,"
                   " \"direction\": [?,?], \"speed\": ?, \"center\": [?,?,?]}",
                   "{\"size\": [1e4,1], \"wavelength\": 1e-3, \"direction\": [0,-1e99]}",
                   "{\"speed\": 0, \"amplitude\": 1e3, \"center\": [1e8,0,0]}"}},
    {.type = "superellipsoid",
     .surface = superellipsoid_oracle,
     .instances = {"{}", "{\"radii\": [+,+,+], \"exponents\": [1,1], \"center\": [?,?,?]}",
                   "{\"radii\": [+,+,+], \"exponents\": [2,1.5]}", "{\"exponents\": [0.2,0.05]}",
                   "{\"exponents\": [1e-3,1e-9], \"center\": [1e6,0,0]}",
                   "{\"exponents\": [1e-300,3e-16]}", "{\"exponents\": [0.9999,1.0001]}",
                   "{\"exponents\": [0.7,0.66]}", "{\"exponents\": [1.9999999999,1.1]}"}},
    {.type = "supertoroid",
     .surface = supertoroid_oracle,
     .instances = {"{}",
                   "{\"major_radius\": +, \"minor_radius\": +, \"exponents\": [0.3,1.7],"
                   " \"center\": [?,?,?]}",
                   "{\"exponents\": [1,0.1]}", "{\"exponents\": [1.2,1]}",
                   "{\"major_radius\": 1e6, \"minor_radius\": 1e-6, \"exponents\": [2,0.01]}"}},
    {.type = "revolution",
     .surface = revolution_oracle,
     .instances = {"{}", "{\"profile\": [@2[?,?]], \"center\": [?,?,?]}",
                   "{\"profile\": [@4[?,?]], \"weights\": [@4+]}", "{\"profile\": [@21[?,?]]}",
                   "{\"profile\": [[1,0],[1,1],[0,1]], \"weights\": [1,1,2],"
                   " \"center\": [1e8,0,0]}"}},
    {.type = "sweep",
     .surface = sweep_oracle,
     .instances = {"{}", "{\"profile\": [@4[?,?,?]], \"path\": [@6[?,?,?]]}",
                   "{\"profile\": [@3[?,?,?]], \"path\": [@2[?,?,?]],"
                   " \"profile_weights\": [@3+], \"path_weights\": [@2+]}",
                   "{\"profile\": [@3[1e8,?,?]], \"path\": [@21[?,?,1e-8]]}"}},
    {.type = "product",
     .surface = product_oracle,
     .instances = {"{}", "{\"k\": [?,?,?], \"c\": [@4[?,?]], \"d\": [@5[?,?]]}",
                   "{\"c\": [@3[?,?]], \"d\": [@4[?,?]], \"c_weights\": [@3+],"
                   " \"d_weights\": [@4+], \"center\": [?,?,?]}",
                   "{\"k\": [1e8,1e-8,0], \"c\": [@2[?,?]], \"center\": [0,1e8,0]}"}},
    {.type = "extrusion", /* its first piece */
     .surface = extrusion_oracle,
     .instances =
         {"{}", "{\"profile\": [@5[?,?]], \"weights\": [@5+], \"vector\": [?,?,1]}",
          "{\"profile\": [@9[?,?]], \"degree\": 3, \"vector\": [1e8,0.1,1e-9]}",
          "{\"profile\": [@7[?,?]], \"degree\": 1, \"vector\": [?,?,1], \"weights\": [@7+]}",
          "{\"profile\": [[?,?],[1e8,?]], \"vector\": [1e8,0.1,1e-9]}",
          "{\"profile\": [@6[1e8,?]], \"degree\": 2, \"knots\": [-2,-1,0,0.5,1,1,4,5,6],"
          " \"weights\": [@6+]}"}},
    {.type = "nurbs",
     .surface = nurbs_oracle,
     .instances =
         {"{}", "{\"points\": [@16[?,?,?]], \"velocities\": [@16[?,?,?]], \"weights\": [@16+]}",
          "{\"degree\": [3,3], \"knots\": "
          "[[0,0,0,0,0.3,0.35,0.7,1,1,1,1],[-2,-1,0,1,2,3,4,5,6,7,8]],"
          " \"points\": [@49[?,?,?]]}",
          "{\"degree\": [3,2], \"knots_u\": [0,0,0,0,1,2,2,2,3,4,5,5,5,5],"
          " \"knots_v\": [0,0,0,0.1,1,1,1.5,1.5,1.5], \"points\": [@60[?,?,?]],"
          " \"velocities\": [@60[?,?,?]]}",
          "{\"degree\": [1,1], \"knots_u\": [0,0,1,2,3,4,5,6,7,8,9,9],"
          " \"knots_v\": [0,0,1,2,3,4,5,5], \"points\": [@60[?,?,?]], \"weights\": [@60+],"
          " \"velocities\": [@60[?,?,?]]}",
          "{\"degree\": [9,1], \"knots_u\": [0,0,0,0,0,0,0,0,0,0,0.4,1,1,1,1,1,1,1,1,1,1], "
          "\"knots_v\": [0,0,1,1],"
          " \"points\": [@22[?,?,?]], \"weights\": [@22+]}",
          "{\"knots\": [[0,0,0,1e-9,1,1,1],[1e6,1e6,1e6,1000000.5,1000001,1000001,1000001]],"
          " \"points\": [@16[1e8,?,?]]}"}},
    {.type = "translate",
     .map = translate,
     .instances =
         {"{\"velocity\": [?,?,?]}", "{\"offset\": [@1[?,?,?]]}", "{\"offset\": [@5[?,?,?]]}",
          "{\"velocity\": [1e8,-1e-8,0]}", "{\"times\": [0,1], \"positions\": [@2[?,?,?]]}",
          "{\"times\": [-0.5,0.125,0.25,0.5], \"positions\": [@4[?,?,?]], \"hold\": true}",
          "{\"times\": [-1,-0.5,0.75,1], \"positions\": [@4[?,?,?]],"
          " \"interpolation\": \"cubic\"}",
          "{\"times\": [-1,-0.5,1], \"positions\": [@3[?,?,?]], \"velocities\": [@3[?,?,?]]}",
          "{\"times\": [-1,-0.5,1], \"positions\": [@3[?,?,?]], \"velocities\": [@3[?,?,?]],"
          " \"accelerations\": [@3[?,?,?]], \"hold\": true}",
          "{\"times\": [1e6,1000000.001,1000001], \"positions\": [[1e8,0,0],[1e8,?,?],"
          "[1e8,1,1e-9]]}"}},
    {.type = "rotate",
     .map = rotate,
     .instances = {"{\"rate\": 1}", "{\"axis\": [?,?,?], \"rate\": ?, \"center\": [?,?,?]}",
                   "{\"axis\": [0,-2,0], \"angle\": [?,?,?]}",
                   "{\"axis\": [1,1e-170,1e-9], \"rate\": 1, \"center\": [1e8,0,-1e8]}",
                   "{\"axis\": [?,?,?], \"rate\": 1000}",
                   "{\"times\": [-1,0,0.25,0.5,1,2], \"angles\": [@6?], \"axis\": [?,?,?],"
                   " \"center\": [?,?,?]}",
                   "{\"times\": [-0.25,0.125,0.5], \"angles\": [0,?,30], \"hold\": true}",
                   "{\"times\": [-1,0,0.25,2], \"angles\": [@4?], \"interpolation\": \"cubic\"}",
                   "{\"times\": [-0.25,0.125,0.5], \"angles\": [0,?,3], \"hold\": true,"
                   " \"interpolation\": \"cubic\"}",
                   "{\"times\": [-1,0.125,0.5,2], \"angles\": [@4?], \"velocities\": [@4?]}",
                   "{\"times\": [-1,0.125,0.5,2], \"angles\": [@4?], \"velocities\": [@4?],"
                   " \"accelerations\": [@4?]}",
                   "{\"times\": [-0.25,0.125,0.5], \"angles\": [0,?,3], \"velocities\": [1,-30,0],"
                   " \"accelerations\": [0,1000,-5]}"}},
    /* In these texts '+' stands only before a digit. */
    {.type = "formula",
     .surface = formula,
     .instances =
         {"{}",
          "{\"x\": \"cos(2*pi*u)*(1+0.3*cos(2*pi*v))\", \"y\": \"sin(2*pi*u)*(1+0.3*cos(2*pi*v))\","
          " \"z\": \"a*sin(2*pi*v)+1*b*t^2\", \"constants\": {\"a\": +, \"b\": ?}}",
          "{\"x\": \"abs(u)-abs(v)*u+1*hypot(u,v)\", \"y\": \"max(u,v,u*v)-min(u^2,v^3,.5)\","
          " \"z\": \"copysign(abs(u)^1.5,u)+1*clamp(3*v,-1,u)-hypot(u,v,sin(t))\","
          " \"domain\": [[-1,1],[-1,1]]}",
          "{\"x\": \"sqrt(u)-u^0.3\", \"y\": \"cbrt(v)+1*u^(1/3)\", \"z\": "
          "\"u^pi-sqrt(u^2+1*v^2)\","
          " \"domain\": [[0,1],[-1,1]], \"time\": [0,2]}",
          "{\"x\": \"u^v-(2+1*sin(t))^u\", \"y\": \"e^(-u^2-v^2)*ln(u)-2^-v\","
          " \"z\": \"log10(u)+1*log2(3+1*v)-exp2(v/3)-lerp(u,v,u*v)\", \"domain\": "
          "[[0.5,2],[-1,1]]}",
          "{\"x\": \"atan2(v,u-3)-tan(u/2)\", \"y\": \"asin(u/3)*acos(v/3)-atan(t)\","
          " \"z\": \"sinh(u)*cosh(v)/(2+1*cosh(u))-tanh(3*v)\", \"domain\": [[-1,1],[0.5,2.5]]}",
          "{\"x\": \"a*u^3-b*v*u^7/(1+1*v^4)\", \"y\": \"(u-a)^5-1e-3*(v-b)^-2\","
          " \"z\": \"sq(a*u-b*v)/3-1/(4-u)\", \"domain\": [[-2,2],[5,6]],"
          " \"constants\": {\"a\": ?, \"b\": +}}"}},
    {.type = "map-formula",
     .map = map_formula,
     .instances = {"{}", "{\"z\": \"z+1*a*sin(k*x-t)\", \"constants\": {\"a\": +, \"k\": ?}}",
                   "{\"x\": \"x*cos(t*z/9)-y*sin(t*z/9)\", \"y\": \"x*sin(t*z/9)+1*y*cos(t*z/9)\"}",
                   "{\"x\": \"x/(1+1*x^2+1*y^2)\", \"y\": \"sqrt(1+1*y^2)-abs(x)\","
                   " \"z\": \"hypot(x,y,z)+1*cbrt(z)*tanh(x)\"}",
                   "{\"x\": \"copysign(sqrt(abs(x)),x)\", \"y\": \"max(y,-z)*e^-abs(x)\","
                   " \"z\": \"z*(2+1*sin(y))^-1.5+1*t\", \"time\": [-1,1]}"}},
    {.type = "motion-formula",
     .map = motion_formula,
     .instances = {"{}",
                   "{\"offset\": [\"0\", \"t\", \"0.4*cos(9*t)-sqrt(1.44-(0.4*sin(9*t))^2)\"]}",
                   "{\"angle\": \"a*t-sin(k*t)\", \"constants\": {\"a\": ?, \"k\": ?}}",
                   "{\"offset\": [\"1e3*t\", \"exp(-t^2)\", \"a\"], \"angle\": \"abs(t)*t/3\","
                   " \"axis\": [?,?,?], \"center\": [?,?,?], \"constants\": {\"a\": ?}}",
                   "{\"angle\": \"asin(t/9)\", \"axis\": [0,-3,0], \"center\": [1e6,0,1],"
                   " \"time\": [-1,2]}",
                   "{\"angle\": \"0.5\", \"offset\": [\"1/(5-t)\", \"0\", \"1e-9*t^3\"],"
                   " \"axis\": [1,1e-3,0], \"time\": [-1,1]}"}},
    {.type = "scale",
     .map = scale_oracle,
     .instances = {"{\"factor\": +}", "{\"factor\": [?,?,?], \"center\": [?,?,?]}",
                   "{\"factors\": [[1],[?],[?]]}", "{\"factors\": [@4[?,?,?]]}", "{\"factor\": 0}",
                   "{\"factor\": 1e8, \"center\": [1e8,-1e-8,0]}"}},
    {.type = "screw",
     .map = screw_oracle,
     .instances = {"{\"rate\": 1}",
                   "{\"axis\": [?,?,?], \"pitch\": ?, \"rate\": ?, \"center\": [?,?,?]}",
                   "{\"axis\": [0,-2,0], \"pitch\": -3, \"angle\": [?,?,?]}",
                   "{\"axis\": [1e-3,2,1e5], \"pitch\": 1e-6, \"rate\": 1e3}"}},
    {.type = "taper",
     .map = taper_oracle,
     .instances = {"{}", "{\"start\": ?, \"end\": ?, \"axis\": [1,0,0], \"range\": [0,+]}",
                   "{\"axis\": [?,?,?], \"center\": [?,?,?], \"start\": [1,?],"
                   " \"end\": [?,?,?], \"range\": [-0.5,0.25]}",
                   "{\"range\": [0,1e-9], \"start\": 1, \"end\": 2}",
                   "{\"range\": [-1e8,1e8], \"end\": -1e3}"}},
    {.type = "tolerance",
     .map = stay,
     .instances = {"{}", "{\"offset\": +, \"angle\": 0.1, \"center\": [?,?,?]}"}},
    {.type = "twist",
     .map = twist_oracle,
     .instances = {"{}", "{\"rate\": ?, \"axis\": [?,?,?], \"center\": [?,?,?]}",
                   "{\"rate\": [?,?,?], \"axis\": [0,1,0]}", "{\"rate\": 100}",
                   "{\"rate\": 1e-9, \"center\": [0,0,1e6]}"}},
    {.type = "bend",
     .map = bend_oracle,
     .instances = {"{}", "{\"curvature\": ?, \"range\": [-0.5,1.5]}",
                   "{\"axis\": [?,?,1], \"along\": [1,?,?], \"center\": [?,?,?],"
                   " \"curvature\": [0,?,?]}",
                   "{\"curvature\": 0}", "{\"curvature\": -20, \"range\": [0.1,3]}",
                   "{\"axis\": [0,0,1], \"along\": [1,0,0], \"curvature\": 1e-9,"
                   " \"range\": [-1e6,1e6]}",
                   "{\"axis\": [1,0,0], \"along\": [1,1e-4,0], \"curvature\": 1}"}},
    {.type = "wave",
     .map = wave_oracle,
     .instances = {"{\"amplitude\": [0,0,1]}",
                   "{\"amplitude\": [?,?,?], \"wave_vector\": [?,?,?], \"speed\": ?,"
                   " \"phase\": ?}",
                   "{\"amplitudes\": [@3[?,?,?]], \"wave_vector\": [0,5,0]}",
                   "{\"amplitude\": [1e-3,1e3,0], \"wave_vector\": [1e3,1,1], \"speed\": 10}"}},
    {.type = "keyframes",
     .map = keyframes_oracle,
     .instances =
         {"{\"times\": [0,1], \"positions\": [@2[?,?,?]]}",
          "{\"times\": [-1,-0.5,0.75,1,3], \"positions\": [@5[?,?,?]]}",
          "{\"times\": [0,1], \"rotations\": [[1,0,0,0],[0.8,0.6,0,0]]}",
          "{\"times\": [0,0.5,1.25,2], \"rotations\": [[1,0,0,0],[-0.8,0,0.6,0],"
          "[0.48,0.36,-0.8,0],[0.36,0.48,-0.8,0]], \"positions\": [@4[?,?,?]]}",
          "{\"times\": [0,1,2,3,4,5,6,7,8,9], \"positions\": [@10[?,?,?]], \"rotations\": ["
          "[1,0,0,0],[0.8,0.6,0,0],[0.6,0.8,0,0],[0.36,0.48,0.8,0],[0.48,0.36,0.8,0],"
          "[0.8,0,0.6,0],[0.8000004,0,0.6000003,0],[0.5,0.5,0.5,0.5],[-0.5,-0.5,-0.5,-0.5],"
          "[0.5,0.5,-0.1,0.7]]}",
          "{\"times\": [1e6,1000000.001,1000001], \"positions\": [[1e8,0,0],[1e8,?,?],"
          "[1e8,1,1e-9]]}",
          "{\"times\": [-0.25,0.5], \"positions\": [@2[?,?,?]], \"hold\": true}",
          "{\"times\": [-0.5,0,0.25], \"rotations\": [[1,0,0,0],[-0.8,0,0.6,0],"
          "[0.48,0.36,-0.8,0]], \"positions\": [@3[?,?,?]], \"hold\": true}"}},
    {.type = "trajectory",
     .map = trajectory_oracle,
     .instances = {"{\"times\": [0,1], \"positions\": [@2[?,?,?]]}",
                   "{\"times\": [-1,-0.5,0.75,1,3], \"positions\": [@5[?,?,?]],"
                   " \"accelerations\": [@4[?,0,?]], \"center\": [?,?,?]}",
                   "{\"times\": [0,1], \"positions\": [@2[?,?,?]], \"rotations\": [[1,0,0,0],"
                   "[0.7316888688738209,0,0,0.6816387600233341]], \"spins\": [[0,0,1.5]],"
                   " \"accelerations\": [[0,0,-9.81]]}",
                   "{\"times\": [-1,-0.5,0.25,0.5,2], \"positions\": [@5[?,?,?]],"
                   " \"rotations\": [[0.5,0.5,-0.5,0.5],[0.2967424962208442,"
                   "0.5118463853645536,-0.726950274508263,-0.348569171210284],"
                   "[0.2967424962208442,0.5118463853645536,-0.726950274508263,"
                   "-0.348569171210284],[-0.6305779848328691,0.39319493710690023,"
                   "-0.6068991224615471,0.28185563970412747],[-0.6305779855505488,"
                   "0.39319493754431545,-0.6068991220831463,0.28185563830308613]],"
                   " \"spins\": [[3,1,-2],[0,0,0],[-1,40,7],[1e-09,0,2e-09]],"
                   " \"accelerations\": [@4[?,?,?]], \"center\": [?,?,?]}",
                   "{\"times\": [-1,-0.75,-0.5,-0.25,0,0.25,0.5,0.75,1,1.25],"
                   " \"positions\": [@10[?,?,?]], \"rotations\": [[0.8,0,0.6,0],"
                   "[0.7751299373685159,0.19792316740361837,0.5813474530263868,"
                   "0.14844237555271375],[0.6997974918234241,0.4067415727997843,"
                   "0.5283526155034782,0.25629724361497963],[0.5813000190020583,"
                   "0.6112995919423608,0.4340895527007929,0.31617931152328055],"
                   "[0.42735308699961083,0.7914451928055388,0.29316242206644394,"
                   "0.32409819515857086],[0.24726747351892445,0.9216637158160171,"
                   "0.10464606806599279,0.28007854599398996],[0.05348149715661091,"
                   "0.9725318474532135,-0.12417119447844391,0.18948100066477214],"
                   "[-0.13708806031902795,0.9150068934217467,-0.37389177081010777,"
                   "0.06460799044338815],[-0.3026209923542964,0.7282714779646337,"
                   "-0.6103548398483637,-0.07421697139729952],[-0.4178121150781574,"
                   "0.4108637693156979,-0.7854368956941482,-0.19928091338598786]],"
                   " \"spins\": [[2,0,0],[2,0.1,-0.3],[2,0.2,-0.6],[2,0.30000000000000004,"
                   "-0.8999999999999999],[2,0.4,-1.2],[2,0.5,-1.5],[2,0.6000000000000001,"
                   "-1.7999999999999998],[2,0.7000000000000001,-2.1],[2,0.8,-2.4]]}",
                   "{\"times\": [-1,0,1,2], \"positions\": [@4[?,?,?]], \"rotations\": [[1,0,"
                   "0,0],[1,0,0,1e-7],[1,2e-7,0,0],[1,2e-7,0,0]], \"spins\": [@3[0,0,0]]}",
                   "{\"times\": [1e6,1000000.001,1000001], \"positions\": [[1e8,0,0],[1e8,?,"
                   "?],[1e8,1,1e-9]], \"accelerations\": [[0,0,1e3],[0,1e-9,0]]}"}},
    {.type = "ffd",
     .map = ffd_oracle,
     .instances = {"{\"points\": [@8[?,?,?]]}", "{\"lattice\": [4,4,4], \"points\": [@64[?,?,?]]}",
                   "{\"lattice\": [2,3,5], \"points\": [@30[?,?,?]],"
                   " \"velocities\": [@30[?,?,?]], \"lo\": [-1,-2,0], \"hi\": [+,+,+]}",
                   "{\"lattice\": [3,3,3], \"points\": [@27[?,?,?]],"
                   " \"velocities\": [@27[?,?,?]]}",
                   "{\"lattice\": [16,2,2], \"points\": [@64[?,?,?]]}",
                   "{\"lattice\": [2,4,2], \"lo\": [1e6,0,0], \"hi\": [1000001,1,1e-6],"
                   " \"points\": [@16[1e6,?,?]], \"velocities\": [@16[1e3,?,1e-9]]}"}},
};

const size_t oracle_count = sizeof oracles / sizeof oracles[0];
