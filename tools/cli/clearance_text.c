/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/clearance.h"

#include <math.h>
#include <stdio.h>

#include "tools/cli/output.h"
#include "tools/cli/result.h"

/* What is printed:
 *
 *   holds: at least 2, nearest distance 2.8863 at t = 0.5572 between "link5" and "fixture"
 *     time     from 0 to 1
 *     proved   never nearer than 2.8834
 *     a        surface 0 of "link5"    u 1.5         v 0.25   at (1, 0, 0)
 *     b        surface 0 of "fixture"  u 3.14159265  v 1.5    at (1.00009, 0, 0)
 *     normal   (1, 0, 0), from a to b
 *     cost     123 pairs, ...
 *
 * A search that ends with the verdict has no nearest points to show:
 *
 *   violated at t = 0.4: "link1" and "door" 1.9999 apart
 *     time     from 0 to 1
 *     required 2
 *     nearest  distance not searched for; add --tolerance 1e-3 to get it
 *     a        ... of the first violation
 */

static const char *name_of(const imp_scene *scene, size_t body)
{
    return imp_scene_body_name(scene, body);
}

bool clearance_is_ended(imp_reason reason)
{
    return reason != IMP_REASON_NONE && reason != IMP_REASON_DECIDED &&
           result_reason_of_none(reason) == NULL;
}

bool clearance_is_undecided(const imp_clearance *r)
{
    return r->verdict == IMP_REQUIREMENT_UNDECIDED ||
           (r->verdict == IMP_REQUIREMENT_NONE && clearance_is_ended(r->reason));
}

exit_status clearance_status(const imp_clearance *r)
{
    if (r->verdict == IMP_REQUIREMENT_VIOLATED) return EXIT_CONTACT;
    return clearance_is_undecided(r) ? EXIT_UNDECIDED : EXIT_ANSWERED;
}

static bool is_decided_only(const imp_clearance *r) { return r->reason == IMP_REASON_DECIDED; }

static bool is_first_violation_known(const imp_clearance *r) { return !isnan(r->t_violated); }

/* Whether contact is the answer; a requirement has a verdict of its own. */
static bool touches(const imp_clearance *r, double gamma)
{
    return r->verdict == IMP_REQUIREMENT_NONE && r->has_witness && r->upper <= gamma;
}

/* --- The first line --------------------------------------------------------------------------- */

static void print_nearest(const imp_scene *scene, const imp_clearance *r)
{
    printf("distance %s%s at t = %.10g between \"%s\" and \"%s\"",
           clearance_is_ended(r->reason) ? "so far " : "", output_number_upper(r->upper).text, r->t,
           name_of(scene, r->a.body), name_of(scene, r->b.body));
}

/* Returns why there are no two points. */
static const char *reason_of_none(const imp_clearance *r)
{
    const char *why = result_reason_of_none(r->reason);
    if (is_decided_only(r)) return "no two bodies ever come so near";
    return why != NULL ? why : result_excuse(r->reason).why;
}

/* Returns how two bodies meet that are no farther apart than gamma. */
static const char *meeting_of(const imp_clearance *r)
{
    if (r->kind == IMP_CONTACT_INSIDE) return "are one inside the other";
    return r->lower > 0 ? "come within gamma, which counts as contact," : "touch or overlap";
}

static void print_bracket(const imp_scene *scene, const imp_clearance *r, double gamma)
{
    if (!r->has_witness) {
        printf("%s", reason_of_none(r));
    } else if (touches(r, gamma)) {
        printf("they %s at t = %.10g: \"%s\" and \"%s\"", meeting_of(r), r->t,
               name_of(scene, r->a.body), name_of(scene, r->b.body));
    } else {
        printf("nearest ");
        print_nearest(scene, r);
    }
}

static void print_holds(const imp_scene *scene, const imp_clearance *r)
{
    if (!r->has_witness) {
        printf("holds: %s", reason_of_none(r));
        return;
    }
    printf("holds: at least %.10g", r->required);
    if (r->lower < r->required) printf(" (to within 1e-6 of it)");
    if (is_decided_only(r)) return;
    printf(", nearest ");
    print_nearest(scene, r);
}

static void print_violated(const imp_scene *scene, const imp_clearance *r)
{
    printf("violated");
    if (is_first_violation_known(r))
        printf(" at t = %s: \"%s\" and \"%s\" %s apart", output_number_lower(r->t_violated).text,
               name_of(scene, r->a_violated.body), name_of(scene, r->b_violated.body),
               output_number_upper(r->gap_violated).text);
    else
        printf("; when first is not known");
}

static void print_first_line(const imp_scene *scene, const imp_clearance *r, double gamma)
{
    switch (r->verdict) {
    case IMP_REQUIREMENT_NONE:
        print_bracket(scene, r, gamma);
        break;
    case IMP_REQUIREMENT_HOLDS:
        print_holds(scene, r);
        break;
    case IMP_REQUIREMENT_VIOLATED:
        print_violated(scene, r);
        break;
    case IMP_REQUIREMENT_UNDECIDED:
        printf("undecided: %s", result_excuse(r->reason).why);
        break;
    }
    putchar('\n');
}

/* --- What follows ----------------------------------------------------------------------------- */

/* A larger gamma would not help. */
static excuse excuse_of(const imp_clearance *r)
{
    excuse e = result_excuse(r->reason);
    const bool bracket = r->verdict == IMP_REQUIREMENT_NONE;
    if (r->reason == IMP_REASON_PAIRS)
        e.cure = bracket ? "raise --max-pairs, or --tolerance; --require asks less"
                         : "raise --max-pairs";
    if (r->reason == IMP_REASON_SECONDS)
        e.cure = bracket ? "raise --max-seconds, or --tolerance; --require asks less"
                         : "raise --max-seconds";
    if (r->reason == IMP_REASON_MEMORY)
        e.cure = bracket ? "raise --max-bytes, or --tolerance; --require asks less"
                         : "raise --max-bytes";
    if (r->reason == IMP_REASON_RESOLUTION)
        e = (excuse){"double precision resolves no more here",
                     bracket ? "raise --tolerance" : "require a little more or less"};
    return e;
}

static void print_required(const imp_clearance *r)
{
    if (r->verdict != IMP_REQUIREMENT_VIOLATED && r->verdict != IMP_REQUIREMENT_UNDECIDED) return;
    result_print_label("required");
    printf("%.10g\n", r->required);
}

/* Prints proved bounds that are not in the first line. */
static void print_proved(const imp_clearance *r)
{
    const double said = r->verdict == IMP_REQUIREMENT_HOLDS ? r->required : 0;
    if (!(r->lower > said && r->lower < INFINITY)) return;
    result_print_label("proved");
    printf("never nearer than %s\n", output_number_lower(r->lower).text);
}

static void print_ended(const imp_clearance *r)
{
    if (!clearance_is_ended(r->reason)) return;
    const excuse e = excuse_of(r);
    result_print_label("ended");
    printf("%s: %s\n", e.why, e.cure);
}

/* Prints the nearest distance if the first line has a verdict. */
static void print_nearest_line(const imp_scene *scene, const imp_clearance *r)
{
    if (r->verdict == IMP_REQUIREMENT_NONE || !r->has_witness) return;
    if (r->verdict == IMP_REQUIREMENT_HOLDS && !is_decided_only(r)) return;
    result_print_label("nearest");
    if (is_decided_only(r))
        printf("distance not searched for; add --tolerance 1e-3 to get it");
    else
        print_nearest(scene, r);
    putchar('\n');
}

/* Prints the two nearest points, or those of the first violation if only a verdict is wanted. */
static void print_points(const imp_scene *scene, const imp_clearance *r, double gamma)
{
    if (is_decided_only(r)) {
        if (is_first_violation_known(r)) result_print_sides(scene, &r->a_violated, &r->b_violated);
    } else if (r->has_witness) {
        result_print_sides(scene, &r->a, &r->b);
        if (r->kind == IMP_CONTACT_INSIDE) return;
        if (touches(r, gamma)) result_print_gap(r->upper, gamma);
        result_print_normal(r->has_normal ? r->normal : NULL);
    }
}

void clearance_print(const imp_scene *scene, const imp_clearance *r, double gamma)
{
    print_first_line(scene, r, gamma);
    result_print_times(r->t_start, r->t_end);
    print_required(r);
    print_proved(r);
    print_ended(r);
    print_nearest_line(scene, r);
    print_points(scene, r, gamma);
    result_print_cost(&r->stats);
}
