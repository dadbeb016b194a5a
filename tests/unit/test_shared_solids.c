/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/box_stacks.h"

/* Solids that share faces: boxes that stand face to face, faces and whole bodies that are there
 * more than once, with any orientation. None may be taken for empty, and no cavity for filled. */

/* --- Boxes in a grid -------------------------------------------------------------------------- */

/* A point of a cell, away from its faces. */
static void point_in(int k, uint64_t *state, double x[3])
{
    int at[3];
    cell_at(k, at);
    for (int i = 0; i < 3; ++i) x[i] = at[i] + random_between(state, 0.01, 0.99);
}

/* Checks points of cells against which of these are filled. */
static void check_cells(const char *surfaces, const stack *s, uint64_t *state)
{
    for (int k = 0; k < CELLS; ++k) {
        double x[3];
        point_in(k, state, x);
        const scene_words w = with_ball(surfaces, x, 0.001);
        if (s->times[k] > 0)
            check_inside(w.text);
        else
            check_clear(w.text);
    }
}

static const char *const stacks[] = {
    "110000000000000000000000000", /* two in a row */
    "111100000000000000000000000", /* around a corner */
    "110110000110110000000000000", /* a larger box of eight */
    "111111111111111111111111111", /* all */
    "111111111111101111111111111", /* around a cavity */
    "110110000000000000000000011", /* two that touch nowhere */
};
enum { STACKS = sizeof stacks / sizeof *stacks };

START_TEST(boxes_that_stand_face_to_face_are_their_union)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < STACKS; ++k) {
        const stack s = stack_of(stacks[k]);
        triangles t = {.count = 0};
        add_stack(&t, &s, &state);
        check_cells(boxes_of(&s).text, &s, &state);
        check_cells(mesh_of(&t, 1).text, &s, &state);
    }
}
END_TEST

START_TEST(bodies_that_are_there_more_than_once_are_neither_empty_nor_filled)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < STACKS; ++k)
        for (int times = 2; times <= 3; ++times) {
            const stack s = stack_of(stacks[k]);
            triangles t = {.count = 0};
            for (int n = 0; n < times; ++n) add_stack(&t, &s, &state);
            check_cells(mesh_of(&t, 1).text, &s, &state);
        }
}
END_TEST

START_TEST(one_box_of_two_may_be_there_again)
{
    uint64_t state = suite_seed();
    stack s = stack_of(stacks[0]);
    s.times[1] = 3;
    check_cells(boxes_of(&s).text, &s, &state);
}
END_TEST

START_TEST(faces_that_are_there_again_change_nothing)
{
    uint64_t state = suite_seed();
    const int times = suite_times(20);
    stack s = stack_of("000000000000010000000000000");
    for (int n = 0; n < times; ++n) {
        triangles t = {.count = 0};
        add_stack(&t, &s, &state);
        const int box = t.count, more = 1 + (int)random_between(&state, 0, 20);
        for (int k = 0; k < more; ++k) {
            const int *from = t.corner[(int)random_between(&state, 0, box)];
            int *to = t.corner[t.count++];
            to[0] = from[1], to[1] = from[n % 2 == 0 ? 2 : 0], to[2] = from[n % 2 == 0 ? 0 : 2];
        }
        check_cells(mesh_of(&t, 1).text, &s, &state);
    }
}
END_TEST

/* --- What is not known is refused ------------------------------------------------------------- */

/* Solves, and returns whether there is an answer: neither refused nor undecided. */
static bool is_answered(const char *bodies, bool *inside)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = scene_of(bodies);
    const imp_options options = imp_options_default(scene);
    imp_result r = {.struct_size = sizeof r};
    const imp_code code = imp_scene_solve(scene, &options, &r, &error);
    ck_assert_msg(code == IMP_SUCCESS || code == IMP_ERROR_SCENE, "%s", error.text);
    imp_scene_free(scene);
    *inside = is_inside(&r);
    return code == IMP_SUCCESS && r.verdict != IMP_VERDICT_UNDECIDED;
}

/* A tank whose walls have two sides each, as programs for pictures write them, is hollow. If only
 * the one wall has two sides, a part may fill the cavity. */
START_TEST(a_tank_of_faces_with_two_sides_stays_hollow)
{
    static const double walls[] = {1, 0.1, 0.01};
    uint64_t state = suite_seed();
    for (int k = 0; k < 9; ++k) {
        const int times[2] = {k / 3 + 1, k % 3 + 1};
        const double wall = walls[(k + k / 3) % 3];
        triangles t = {.count = 0};
        for (int n = 0; n < times[0]; ++n)
            add_box(&t, (const int[3]){0, 0, 0}, (const int[3]){3, 3, 3}, &state);
        for (int n = 0; n < times[1]; ++n)
            add_box(&t, (const int[3]){1, 1, 1}, (const int[3]){2, 2, 2}, &state);
        const scene_words tank = mesh_of(&t, wall);
        const scene_words within = with_ball(tank.text, (const double[3]){1.5, 1.4, 1.6}, 0.2);
        bool inside;
        if (times[0] == times[1])
            check_clear(within.text);
        else
            ck_assert(!is_answered(within.text, &inside));
        check_inside(with_ball(tank.text, (const double[3]){wall / 2, 1.5, 1.5}, wall / 5).text);
        check_clear(with_ball(tank.text, (const double[3]){-0.1, 1.5, 1.5}, 0.05).text);
    }
}
END_TEST

/* A box in the corner of a larger one, whose faces are divided so that three are shared: a notch,
 * or a part of the solid? */
START_TEST(a_box_flush_in_the_corner_of_another_is_not_guessed)
{
    uint64_t state = suite_seed();
    stack all = stack_of(stacks[3]), one = stack_of("100000000000000000000000000");
    triangles t = {.count = 0}, hull = {.count = 0};
    add_stack(&t, &all, &state);
    for (int k = 0; k < t.count; ++k) { /* those that are there once */
        const int *c = t.corner[k];
        for (int i = 0, row = 1; i < 3; ++i, row *= N + 1) {
            const int x = c[0] / row % (N + 1);
            if (x % N != 0 || c[1] / row % (N + 1) != x || c[2] / row % (N + 1) != x) continue;
            memcpy(hull.corner[hull.count++], c, sizeof hull.corner[0]);
        }
    }
    check_cells(mesh_of(&hull, 1).text, &all, &state);
    add_stack(&hull, &one, &state);
    bool inside;
    const scene_words w = with_ball(mesh_of(&hull, 1).text, (const double[3]){0.4, 0.6, 0.3}, 0.01);
    ck_assert(!is_answered(w.text, &inside));
}
END_TEST

/* The faces across y and z of a box that ends at x = 0 and has width X, and its far face. */
#define PLANE(ORIGIN, U, V)                                                                        \
    "{\"type\": \"plane\", \"origin\": [" ORIGIN "], \"edge_u\": [" U "], \"edge_v\": [" V "]}"
#define BESIDE(X)                                                                                  \
    PLANE(X ",0,0", "0,2,0", "0,0,2")                                                              \
    ", " PLANE("0,0,0", X ",0,0", "0,0,2") ", " PLANE("0,2,0", X ",0,0", "0,0,2") ", " PLANE(      \
        "0,0,0", X ",0,0", "0,2,0") ", " PLANE("0,0,2", X ",0,0", "0,2,0")
#define FACE PLANE("0,0,0", "0,2,0", "0,0,2")
#define END(Z)                                                                                     \
    "{\"type\": \"mesh\", \"points\": [[0,0," Z "], [-1,1.5," Z "], [0.3,1.5," Z                   \
    "]], \"faces\": [[0,1,2]]}"

/* Two boxes on one side of the face that they share, the middle of which a wedge covers that stands
 * on one of its edges: what only the boxes hold is not outside. */
START_TEST(a_face_of_boxes_inside_each_other_is_not_left_out_where_a_third_body_covers_it)
{
    static const char bodies[] = FACE ", " BESIDE("2") ", " FACE ", " BESIDE("1") ", " PLANE(
        "0,0,0", "-1,1.5,0",
        "0,0,2") ", " PLANE("-1,1.5,0", "1.3,0,0",
                            "0,0,2") ", " PLANE("0.3,1.5,0", "-0.3,-1.5,0",
                                                "0,0,2") ", " END("0") ", " END("2");
    static const double in_both[2][3] = {{0.5, 0.3, 1}, {0.7, 1.8, 1.3}};
    for (int k = 0; k < 2; ++k) {
        bool inside;
        const scene_words w = with_ball(bodies, in_both[k], 0.01);
        ck_assert(!is_answered(w.text, &inside) || inside);
    }
}
END_TEST

/* Random stacks, with faces that are there again: each answer is true. */
START_TEST(no_stack_is_told_wrong)
{
    uint64_t state = suite_seed();
    const int times = suite_times(200);
    int answers = 0;
    for (int n = 0; n < times; ++n) {
        stack s;
        triangles t = {.count = 0};
        const double filled = random_between(&state, 0.1, 1);
        for (int k = 0; k < CELLS; ++k)
            s.times[k] = random_between(&state, 0, 1) >= filled ? 0
                         : random_between(&state, 0, 1) < 0.9   ? 1
                                                                : 2;
        add_stack(&t, &s, &state);
        const int more = t.count > 0 && n % 3 == 0 ? 3 : 0;
        for (int k = 0; k < more; ++k) {
            const int again = (int)random_between(&state, 0, t.count);
            memcpy(t.corner[t.count++], t.corner[again], sizeof t.corner[0]);
        }
        if (t.count == 0) continue;
        const scene_words mesh = mesh_of(&t, 1), boxes = boxes_of(&s);
        for (int k = 0; k < 4; ++k) {
            double x[3];
            bool inside;
            const int cell = (int)random_between(&state, 0, CELLS);
            point_in(cell, &state, x);
            const char *surfaces = k < 2 ? mesh.text : boxes.text;
            if (!is_answered(with_ball(surfaces, x, 0.001).text, &inside)) continue;
            answers += 1;
            ck_assert_msg(inside == (s.times[cell] > 0), "seed %llu, stack %d: (%g, %g, %g)",
                          (unsigned long long)suite_seed(), n, x[0], x[1], x[2]);
        }
    }
    ck_assert_int_gt(answers, times / 2);
}
END_TEST

/* --- Curved patches --------------------------------------------------------------------------- */

#define CAN(Z, R)                                                                                  \
    "{\"type\": \"cylinder\", \"center\": [0,0," Z "], \"radius\": " R ", \"ends\": true}"
#define BALL "{\"type\": \"sphere\", \"radius\": 1}"
#define RING "{\"type\": \"torus\", \"major_radius\": 1, \"minor_radius\": 0.3}"
/* A pillow's side: its edges are those of a square. */
#define PILLOW(Z)                                                                                  \
    "{\"type\": \"bezier\", \"degree\": [2, 2], \"points\": [[-1,-1,0], [-1,0,0], [-1,1,0], "      \
    "[0,-1,0], [0,0," Z "], [0,1,0], [1,-1,0], [1,0,0], [1,1,0]]}"

START_TEST(curved_bodies_that_are_there_again_change_nothing)
{
    check_inside(with_ball(BALL ", " BALL, (const double[3]){0.5, 0, 0}, 0.1).text);
    check_clear(with_ball(BALL ", " BALL, (const double[3]){1.5, 0, 0}, 0.1).text);
    check_inside(with_ball(RING ", " RING ", " RING, (const double[3]){0, 1, 0}, 0.1).text);
    check_clear(with_ball(RING ", " RING ", " RING, (const double[3]){0, 0, 0}, 0.1).text);
}
END_TEST

START_TEST(cylinders_may_stand_on_each_other)
{
    static const char tower[] = CAN("0", "1") ", " CAN("2", "1") ", " CAN("4", "1");
    for (int k = 0; k < 3; ++k) {
        check_inside(with_ball(tower, (const double[3]){0.3, 0.2, 2 * k + 0.1}, 0.1).text);
        check_clear(with_ball(tower, (const double[3]){1.3, 0.2, 2 * k + 0.1}, 0.1).text);
    }
    check_clear(with_ball(tower, (const double[3]){0.3, 0.2, 5.2}, 0.1).text);
}
END_TEST

START_TEST(patches_with_the_same_edges_are_no_copies)
{
    static const char pillow[] = PILLOW("2") ", " PILLOW("-2");
    const scene_words twice = words("%s, %s", pillow, pillow);
    for (int k = 0; k < 2; ++k) {
        const char *text = k == 0 ? pillow : twice.text;
        check_inside(with_ball(text, (const double[3]){0.1, 0.2, 0.2}, 0.1).text);
        check_inside(with_ball(text, (const double[3]){0.1, 0.2, -0.2}, 0.1).text);
        check_clear(with_ball(text, (const double[3]){0.1, 0.2, 0.8}, 0.1).text);
    }
}
END_TEST

START_TEST(closure_leaves_out_copies_and_faces_between)
{
    imp_scene *scene = scene_of("{\"surfaces\": [" CAN("0", "1") ", " CAN("2", "1") "]}");
    imp_closure c = {.struct_size = sizeof c};
    imp_facing facing[6];
    int left_out = 0;
    ck_assert_int_eq(imp_scene_get_closure(scene, 0, 0, 1e-6, facing, NULL, NULL, &c, NULL),
                     IMP_SUCCESS);
    ck_assert(c.verdict == IMP_CLOSURE_CLOSED && c.shells == 1);
    for (int k = 0; k < 6; ++k) {
        left_out += facing[k].shell == SIZE_MAX && facing[k].sign == 0;
        ck_assert(facing[k].shell == SIZE_MAX || facing[k].shell == 0);
    }
    ck_assert_int_eq(left_out, 2);
    imp_scene_free(scene);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        boxes_that_stand_face_to_face_are_their_union,
        bodies_that_are_there_more_than_once_are_neither_empty_nor_filled,
        one_box_of_two_may_be_there_again,
        faces_that_are_there_again_change_nothing,
        a_tank_of_faces_with_two_sides_stays_hollow,
        a_box_flush_in_the_corner_of_another_is_not_guessed,
        a_face_of_boxes_inside_each_other_is_not_left_out_where_a_third_body_covers_it,
        no_stack_is_told_wrong,
        curved_bodies_that_are_there_again_change_nothing,
        cylinders_may_stand_on_each_other,
        patches_with_the_same_edges_are_no_copies,
        closure_leaves_out_copies_and_faces_between};
    return suite_main_with("shared solids", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
