/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/proof/proof_pairs.h"

void proof_put_count(const proof_sink *to, size_t n)
{
    for (; n >= 128; n >>= 7) to->write(to->context, &(uint8_t){(uint8_t)(n | 128)}, 1);
    to->write(to->context, &(uint8_t){(uint8_t)n}, 1);
}

const uint32_t *proof_order(const candidate *c)
{
    const node *root = c != NULL ? tree_root(c->tree) : NULL;
    return root != NULL && root->many != NULL ? hierarchy_order(root->many->of) : NULL;
}

void proof_put_order(const proof_sink *to, const uint32_t *order, size_t count)
{
    proof_put_count(to, order != NULL);
    for (size_t k = 0; k < count && order != NULL; ++k) proof_put_count(to, order[k]);
}

bool proof_is_pair(const candidate_pair *p, const size_t body[2], const size_t at[2])
{
    return p->side[0]->body == body[0] && p->side[1]->body == body[1] &&
           p->side[0]->surface == at[0] && p->side[1]->surface == at[1];
}

/* Returns whether the search examined one moment of the pair in place of all times. */
static bool rests(const candidate_list *list, const candidate_pair *both)
{
    const imp_region *r = &tree_root(both->side[0]->tree)->region;
    return list->slip > 0 && r->lo[2] == r->hi[2];
}

void proof_search_write(const proof_search *search, const proof_trees *trees, size_t index,
                        double lo, double hi, const proof_sink *to)
{
    const candidate_list *list = search->list;
    proof_trees_write(trees, (uint32_t)index, lo, hi, rests(list, &list->pairs[index]), to);
}

bool proof_pairs_begin(proof_pairs *p, const imp_scene *scene, const proof_search *search,
                       double from, double to)
{
    *p = (proof_pairs){scene, search, from, to, proof_trees_new(search->log), 0};
    return p->trees != NULL;
}

void proof_pairs_end(proof_pairs *p) { proof_trees_free(p->trees); }

/* A pair of surfaces that is no candidate pair has a tree of one leaf. */
void proof_pairs_put(void *context, const size_t body[2], const size_t at[2], const proof_sink *to)
{
    proof_pairs *p = context;
    const candidate_list *list = p->search->list;
    const bool found = p->next < list->pair_count && proof_is_pair(&list->pairs[p->next], body, at);
    const candidate_pair *both = found ? &list->pairs[p->next] : NULL;
    const surface *s[2];
    for (int side = 0; side < 2; ++side) s[side] = scene_surface(p->scene, body[side], at[side]);
    proof_put_count(to, both != NULL ? both->side[0]->left_out : surface_common_motion(s[0], s[1]));
    for (int side = 0; side < 2; ++side)
        if (surface_piece_count(s[side]) > 1)
            proof_put_order(to, both != NULL ? proof_order(both->side[side]) : NULL,
                            surface_piece_count(s[side]));
    if (both != NULL)
        proof_search_write(p->search, p->trees, p->next, p->from, p->to, to);
    else
        proof_trees_write(p->trees, UINT32_MAX, p->from, p->to, false, to);
    p->next += found;
}
