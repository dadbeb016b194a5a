/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/candidate.h"

#include "core/base/rounding.h"
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

/* --- Half planes ------------------------------------------------------------------------------ */

/* Bounds k.x over the node from below. Lemma. x is within e of its polynomial, each monomial of
 * which is within [-1, 1]. Rounding, in units of u S, S the sum of all terms' sizes: a product, two
 * sums and those of 9 coefficients. */
enum { HEIGHT_ROUNDING = 1 + 2 + 9 };
PAD_COVERS(32, HEIGHT_ROUNDING + 2 + 9);
static double height_lower(const node *n, const double k[3], double sign)
{
    const quadratic3 *f = &n->f;
    const double *const terms[] = {f->bu,  f->bv,  f->bt,  f->quu, f->quv,
                                   f->qut, f->qvv, f->qvt, f->qtt};
    double middle = 0, size = 0, spread = 0;
    for (int i = 0; i < 3; ++i) {
        middle += sign * k[i] * f->a[i];
        size += fabs(k[i] * f->a[i]);
        spread += fabs(k[i]) * n->e[i];
    }
    for (size_t j = 0; j < sizeof terms / sizeof *terms; ++j) {
        double term = 0;
        for (int i = 0; i < 3; ++i) {
            term += k[i] * terms[j][i];
            size += fabs(k[i] * terms[j][i]);
        }
        spread += fabs(term);
    }
    const double slack =
        padded_upper(spread + 32 * UNIT_ROUNDOFF * size, 32) + 2 * PRODUCTS_UNDERFLOW;
    return difference_lower(middle, slack);
}

static bool misses(const half_plane *h, const node *n)
{
    if (h == NULL || n->many != NULL || !n->bounded || n->is_bare) return false;
    return height_lower(n, h->across, 1) > h->across_hi ||
           height_lower(n, h->across, -1) > -h->across_lo ||
           height_lower(n, h->along, -1) > -h->along_lo ||
           (h->height_hi < INFINITY && (height_lower(n, h->up, 1) > h->height_hi ||
                                        height_lower(n, h->up, -1) > -h->height_lo));
}

bool candidate_pair_leaves_out(const candidate_pair *both, const node *a, const node *b)
{
    return misses(both->side[0]->half, a) || misses(both->side[1]->half, b);
}
