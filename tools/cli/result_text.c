/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdio.h>

#include "tools/cli/output.h"
#include "tools/cli/result.h"

/* What is printed, for a contact:
 *
 *   contact at t = 0.49995
 *     time     from 0 to 1
 *     proved   nothing nearer than 5e-05 before t = 0.49995
 *     a        surface 0 of "pot"   u 1.5         v 0.25   at (1, 0, 0)
 *     b        surface 0 of "ball"  u 3.14159265  v 1.5    at (1.00009, 0, 0)
 *     gap      9e-05, at most gamma = 0.0001
 *     normal   (1, 0, 0), from a to b
 *     cost     123 pairs, 45 nodes, 3 witness searches, 12 pairs waiting at most, 34 kB, 1.23 ms
 */

void result_print_label(const char *label) { printf("  %-8s ", label); }

void result_print_times(double from, double to)
{
    result_print_label("time");
    printf("from %.10g to %.10g\n", from, to);
}

static void print_vector(const double v[3]) { printf("(%.10g, %.10g, %.10g)", v[0], v[1], v[2]); }

/* The columns of one side; both sides are padded to the wider of the two. */
typedef struct side_text {
    char surface[64], u[32], v[32];
    const char *body;
} side_text;

bool result_is_on_surface(const imp_side *side) { return !isnan(side->u); }

static side_text side_columns(const imp_scene *scene, const imp_side *side)
{
    side_text text;
    snprintf(text.surface, sizeof text.surface, "%zu", side->surface);
    if (imp_scene_piece_count(scene, side->body, side->surface) > 1)
        snprintf(text.surface, sizeof text.surface, "%zu piece %zu", side->surface, side->piece);
    snprintf(text.u, sizeof text.u, "%.10g", side->u);
    snprintf(text.v, sizeof text.v, "%.10g", side->v);
    text.body = imp_scene_body_name(scene, side->body);
    return text;
}

/* Characters of UTF-8 text: every byte but those that continue one. */
static int width(const char *text)
{
    int characters = 0;
    for (; *text != '\0'; ++text) characters += ((unsigned char)*text & 0xC0) != 0x80;
    return characters;
}

static int wider(const char *a, const char *b)
{
    const int m = width(a), n = width(b);
    return m > n ? m : n;
}

/* The line of a body that is solid: the point of the other body that it holds. */
static void print_solid(const imp_scene *scene, const char *label, const imp_side *side)
{
    result_print_label(label);
    printf("\"%s\", which is solid, holds ", imp_scene_body_name(scene, side->body));
    print_vector(side->point);
    putchar('\n');
}

static void print_side(const char *label, const imp_side *side, const side_text *own,
                       const side_text *other)
{
    result_print_label(label);
    printf("surface %*s of \"%s\"%*s", wider(own->surface, other->surface), own->surface, own->body,
           wider(own->body, other->body) - width(own->body), "");
    printf("  u %-*s  v %-*s  at ", wider(own->u, other->u), own->u, wider(own->v, other->v),
           own->v);
    print_vector(side->point);
    putchar('\n');
}

void result_print_sides(const imp_scene *scene, const imp_side *side_a, const imp_side *side_b)
{
    const side_text a = side_columns(scene, side_a), b = side_columns(scene, side_b);
    if (result_is_on_surface(side_a))
        print_side("a", side_a, &a, result_is_on_surface(side_b) ? &b : &a);
    else
        print_solid(scene, "a", side_a);
    if (result_is_on_surface(side_b))
        print_side("b", side_b, &b, result_is_on_surface(side_a) ? &a : &b);
    else
        print_solid(scene, "b", side_b);
}

void result_print_normal(const double *normal)
{
    result_print_label("normal");
    if (normal != NULL) {
        print_vector(normal);
        puts(", from a to b");
    } else {
        puts("undefined");
    }
}

void result_print_gap(double gap, double gamma)
{
    result_print_label("gap");
    printf("%s, at most gamma = %.10g\n", output_number_upper(gap).text, gamma);
}

static void print_contact(const imp_scene *scene, const imp_result *r)
{
    result_print_sides(scene, &r->a, &r->b);
    if (r->kind == IMP_CONTACT_INSIDE) return;
    result_print_gap(r->gap, r->gamma);
    result_print_normal(r->has_normal ? r->normal : NULL);
}

static void print_count(uint64_t n, const char *one, const char *many)
{
    printf("%ju %s, ", (uintmax_t)n, n == 1 ? one : many);
}

void result_print_cost(const imp_stats *s)
{
    result_print_label("cost");
    print_count(s->pairs, "pair", "pairs");
    print_count(s->nodes, "node", "nodes");
    print_count(s->witness_searches, "witness search", "witness searches");
    print_count(s->peak_heap, "pair waiting at most", "pairs waiting at most");
    if (s->bytes < 10 * 1024 * 1024)
        printf("%ju KiB, ", (uintmax_t)(s->bytes / 1024));
    else
        printf("%ju MiB, ", (uintmax_t)(s->bytes / 1024 / 1024));
    if (s->seconds < 1)
        printf("%.3g ms\n", s->seconds * 1e3);
    else
        printf("%.3f s\n", s->seconds);
}

const char *result_reason_of_none(imp_reason reason)
{
    if (reason == IMP_REASON_NO_TIME)
        return "no two surfaces that are tested exist together at any time of the interval";
    if (reason == IMP_REASON_NO_PAIRS) return "there are no two bodies to test with each other";
    return NULL;
}

excuse result_excuse(imp_reason reason)
{
    switch (reason) {
    case IMP_REASON_PAIRS:
        return (excuse){"the limit of pairs is reached", "raise --max-pairs, or gamma"};
    case IMP_REASON_SECONDS:
        return (excuse){"the time limit is reached", "raise --max-seconds, or gamma"};
    case IMP_REASON_MEMORY:
        return (excuse){"the limit of memory is reached", "raise --max-bytes, or gamma"};
    case IMP_REASON_RESOLUTION:
        return (excuse){"gamma is below what double precision resolves here", "raise --gamma"};
    default:
        return (excuse){"interrupted", "run it again and let it finish"};
    }
}

static void print_proved(const imp_result *r)
{
    result_print_label("proved");
    const number_text clear = output_number_lower(r->gamma_clear);
    if (r->verdict == IMP_VERDICT_CLEAR)
        printf("never nearer than %s\n", clear.text);
    else
        printf("nothing nearer than %s before t = %s\n", clear.text,
               output_number_lower(r->t_lower).text);
}

static void print_examined(const imp_result *r)
{
    const double *t = r->t_examined;
    if (t[0] == r->t_start && t[1] == r->t_end) return;
    if (!(t[0] <= t[1])) return; /* the reason says so then */
    result_print_label("examined");
    printf("t from %s to %s only; at other times no two surfaces exist together\n",
           output_number_upper(t[0]).text, output_number_lower(t[1]).text);
}

static void print_clear(const imp_result *r)
{
    const char *reason = result_reason_of_none(r->reason);
    if (reason == NULL) return;
    result_print_label("reason");
    puts(reason);
}

static void print_undecided(const imp_result *r)
{
    result_print_label("cure");
    puts(result_excuse(r->reason).cure);
}

void result_print(const imp_scene *scene, const imp_result *r)
{
    static const output_tint tints[] = {[IMP_VERDICT_CLEAR] = OUTPUT_GREEN,
                                        [IMP_VERDICT_CONTACT] = OUTPUT_RED,
                                        [IMP_VERDICT_UNDECIDED] = OUTPUT_YELLOW};
    printf("%s%s%s", output_colour(tints[r->verdict]), result_verdict_name(r->verdict),
           output_colour(OUTPUT_PLAIN));
    if (r->verdict == IMP_VERDICT_CONTACT) printf(" at t = %s", output_number_lower(r->t).text);
    if (r->verdict == IMP_VERDICT_UNDECIDED) printf(": %s", result_excuse(r->reason).why);
    if (r->verdict == IMP_VERDICT_CONTACT && r->kind == IMP_CONTACT_INSIDE)
        printf(": \"%s\" is inside \"%s\"",
               imp_scene_body_name(scene, (result_is_on_surface(&r->a) ? r->a : r->b).body),
               imp_scene_body_name(scene, (result_is_on_surface(&r->a) ? r->b : r->a).body));
    putchar('\n');
    result_print_times(r->t_start, r->t_end);
    print_proved(r);
    print_examined(r);
    if (r->verdict == IMP_VERDICT_CONTACT) print_contact(scene, r);
    if (r->verdict == IMP_VERDICT_CLEAR) print_clear(r);
    if (r->verdict == IMP_VERDICT_UNDECIDED) print_undecided(r);
    result_print_cost(&r->stats);
}
