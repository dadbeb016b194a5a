/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/candidate.h"

#include "core/tree/bound_audit.h"
#include "core/witness/witness.h"

/* Evaluates the middle of a surface at the start, middle and end of the root's times. *moves: its
 * positions at start and end are apart beyond error. */
static imp_code measure_surface(const surface *s, const node *root, double *largest, bool *moves,
                                imp_error *error)
{
    double lo[3], hi[3];
    const imp_region *r = &root->region;
    surface_domain(s, lo, hi);
    lo[2] = r->lo[2], hi[2] = r->hi[2];
    const imp_region whole = region_make(lo, hi);
    const double u = whole.c[0], v = whole.c[1];
    const double p[3][3] = {{u, v, r->lo[2]}, {u, v, r->c[2]}, {u, v, r->hi[2]}};
    double eval_error[3];
    vec3 x[3];
    imp_code code = witness_eval_errors(s, 3, p, eval_error, x, error);
    for (int k = 0; k < 3 && code == IMP_SUCCESS; ++k) {
        if (root->many == NULL) code = bound_audit_holds_at(s, root, p[k], x[k].x, error);
        if (eval_error[k] > *largest) *largest = eval_error[k];
    }
    if (code == IMP_SUCCESS)
        *moves = vec3_norm1(vec3_sub(x[2], x[0])) > 2 * (eval_error[0] + eval_error[2]);
    return code;
}

enum { PIECES_MEASURED = 16 };

static imp_code count_still_maps(candidate *c, const node *root, imp_error *error)
{
    const surface *s = root->surface;
    if (!surface_has_distance(s)) return IMP_SUCCESS;
    const imp_status status = surface_still_maps(s, &root->region, &c->still_maps);
    if (status == IMP_STATUS_OK) return IMP_SUCCESS;
    surface_fault(s, error, "over t [%.17g, %.17g]: %s", root->region.lo[PARAMETER_T],
                  root->region.hi[PARAMETER_T], surface_status_message(s, status).text);
    return surface_set_code(status, error);
}

static imp_code measure(candidate *c, imp_error *error)
{
    if (c->eval_error >= 0) return IMP_SUCCESS;
    const node *root = tree_root(c->tree);
    const size_t samples = root->many != NULL ? PIECES_MEASURED : 1;
    double largest = 0;
    for (size_t k = 0; k < samples; ++k) {
        const surface *s = root->surface;
        if (root->many != NULL)
            s = surface_piece(s, hierarchy_sample(root->many->of, k, PIECES_MEASURED));
        bool moves;
        const imp_code code = measure_surface(s, root, &largest, &moves, error);
        if (code != IMP_SUCCESS) return code;
        c->moves = moves && root->many == NULL;
    }
    const imp_code code = count_still_maps(c, root, error);
    if (code == IMP_SUCCESS) c->eval_error = largest;
    return code;
}

imp_code candidate_pair_measure(const candidate_pair *both, imp_error *error)
{
    const imp_code code = measure(both->side[0], error);
    return code == IMP_SUCCESS ? measure(both->side[1], error) : code;
}
