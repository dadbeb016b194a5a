/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#include <impinge/impinge.h>
#include <stdio.h>

/* A loop of fixed steps that never tunnels. A ball flies between two walls, so fast that one step
 * takes it farther than the room is wide: tests made at the steps alone would see it inside, or
 * outside, without any contact between. Here each flight is asked about once, and h(t) = t0 - t,
 * the time left until contact, says of each step whether it may be taken whole.
 *
 *     cc steps.c $(pkg-config --cflags --libs impinge) -o steps && ./steps */

#define STEP 0.5
#define END 10.0
#define RADIUS 0.1
#define WALL 1.0 /* at x = -WALL and x = WALL */

typedef struct ball {
    double t, x, velocity;
    const char *left; /* the wall it has just left, or NULL */
} ball;

static imp_code add_wall(imp_builder *b, const char *name, double x, imp_error *error)
{
    const double corner[3] = {x, -1, -1}, side[3] = {0, 2, 0}, height[3] = {0, 0, 2};
    const imp_argument arguments[] = {imp_argument_list("origin", corner, 3),
                                      imp_argument_list("edge_u", side, 3),
                                      imp_argument_list("edge_v", height, 3)};
    size_t body;
    const imp_code code = imp_builder_body(b, name, &body, error);
    return code != IMP_SUCCESS ? code : imp_builder_surface(b, body, "plane", arguments, 3, error);
}

/* At x when the time is t, and on from there. */
static imp_code add_ball(imp_builder *b, const ball *now, imp_error *error)
{
    const double center[3] = {now->x - now->velocity * now->t, 0, 0};
    const double velocity[3] = {now->velocity, 0, 0};
    const imp_argument shape[] = {imp_argument_number("radius", RADIUS),
                                  imp_argument_list("center", center, 3)};
    const imp_argument motion = imp_argument_list("velocity", velocity, 3);
    size_t body;
    imp_code code = imp_builder_body(b, "ball", &body, error);
    if (code == IMP_SUCCESS) code = imp_builder_surface(b, body, "sphere", shape, 2, error);
    return code != IMP_SUCCESS ? code : imp_builder_map(b, body, "translate", &motion, 1, error);
}

/* The ball's flight from now on. The wall that it leaves is still within gamma, and is ignored: a
 * ball cannot come back to a flat wall without meeting another. */
static imp_code ask(imp_registry *registry, const ball *now, imp_result *next, imp_error *error)
{
    imp_builder *b = imp_builder_new(registry);
    if (b == NULL) return IMP_ERROR_MEMORY;
    imp_code code = imp_builder_time(b, now->t, END, error);
    if (code == IMP_SUCCESS) code = add_wall(b, "west", -WALL, error);
    if (code == IMP_SUCCESS) code = add_wall(b, "east", WALL, error);
    if (code == IMP_SUCCESS) code = add_ball(b, now, error);
    if (code == IMP_SUCCESS && now->left != NULL)
        code = imp_builder_ignore(b, now->left, "ball", error);
    imp_scene *scene = code == IMP_SUCCESS ? imp_builder_finish(b, error) : NULL;
    imp_builder_free(b);
    if (scene == NULL) return error->code;
    const imp_options options = imp_options_default(scene);
    next->struct_size = sizeof *next;
    code = imp_scene_solve(scene, &options, next, error);
    imp_scene_free(scene);
    return code;
}

static void fly(ball *b, double time)
{
    b->x += b->velocity * time;
    b->t += time;
}

/* Flies to the next contact and reflects the velocity there. */
static void bounce(ball *b, double time)
{
    fly(b, time);
    b->left = b->velocity < 0 ? "west" : "east";
    b->velocity = -b->velocity;
}

int main(void)
{
    imp_registry *registry = imp_registry_new(NULL);
    imp_error error = {IMP_SUCCESS, ""};
    imp_result next;
    ball b = {.t = 0, .x = 0.25, .velocity = 7};
    int bounces = 0, outside = 0;
    imp_code code = ask(registry, &b, &next, &error);
    for (int k = 1; code == IMP_SUCCESS && k * STEP <= END; ++k) {
        const double end = k * STEP;
        while (code == IMP_SUCCESS && imp_time_left(&next, b.t) <= end - b.t) {
            bounce(&b, imp_time_left(&next, b.t));
            ++bounces;
            code = ask(registry, &b, &next, &error);
        }
        fly(&b, end - b.t);
        outside += b.x < -WALL || b.x > WALL;
    }
    imp_registry_free(registry);
    if (code != IMP_SUCCESS) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    printf("t = %g, x = %.4f, %d bounces, outside at %d steps\n", b.t, b.x, bounces, outside);
    return 0;
}
