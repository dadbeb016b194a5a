/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/rough_sheets.h"

/* Surfaces that consist of pieces: the clusters above them, what may be asked, and limits. */

/* --- Clusters --------------------------------------------------------------------------------- */

typedef struct visit {
    uint64_t random;
    const tree *tree;
    int points;
} visit;

/* A point of the piece at a time of the node lies within the node's bounds. */
static void expect_inside(visit *v, const node *n, const surface *piece)
{
    double p[3], x[3], error[3];
    const imp_region *r = &n->region;
    for (int j = 0; j < 2; ++j) p[j] = random_between(&v->random, 0, 1);
    p[2] = random_between(&v->random, r->lo[2], r->hi[2]);
    ck_assert_int_eq(surface_eval(piece, 1, p, x, error), IMP_STATUS_OK);
    const double s = r->d[2] > 0 ? (p[2] - r->c[2]) / r->d[2] : 0;
    for (int i = 0; i < 3; ++i) {
        const double middle = n->f.a[i] + n->f.bt[i] * s + n->f.qtt[i] * s * s;
        const double slack = error[i] + 1e-14 * (1 + fabs(x[i]));
        ck_assert_msg(fabs(x[i] - middle) <= n->e[i] + slack, "coordinate %d: %g off, %g allowed",
                      i, fabs(x[i] - middle), n->e[i]);
        ck_assert(x[i] >= n->lo[i] - slack && x[i] <= n->hi[i] + slack);
    }
    v->points += 1;
}

static void visit_pieces(visit *v, const node *n, const cluster *c)
{
    for (int side = 0; side < 2; ++side)
        if (c->child[side] != NULL)
            visit_pieces(v, n, c->child[side]);
        else
            expect_inside(v, n, surface_piece(n->surface, c->piece[side]));
}

/* Visits a cluster and, at half its times, its halves. */
static void visit_clusters(visit *v, tree *t, node *n)
{
    tree_growth growth = {0};
    if (n->many == NULL) return;
    ck_assert(n->bounded);
    visit_pieces(v, n, n->many);
    for (int side = 0; side < 2; ++side) {
        node *half = n, *child;
        if (random_between(&v->random, 0, 1) < 0.5 && region_can_split(&n->region, PARAMETER_T))
            ck_assert_int_eq(node_child(t, n, PARAMETER_T, side, &half, &growth, NULL),
                             IMP_SUCCESS);
        ck_assert_int_eq(node_child(t, half, PARAMETER_U, side, &child, &growth, NULL),
                         IMP_SUCCESS);
        visit_clusters(v, t, child);
    }
}

static int check_surface(uint64_t seed, const surface *s, tree_kind kind)
{
    tree *t = NULL;
    tree_growth growth = {0};
    const tree_plan plan = {.kind = kind, .t_start = 0.125, .t_end = 0.9};
    ck_assert_int_eq(tree_new(s, &plan, &t, &growth, NULL), IMP_SUCCESS);
    visit v = {.random = seed, .tree = t};
    visit_clusters(&v, t, tree_root(t));
    tree_free(t);
    return v.points;
}

START_TEST(every_point_of_every_piece_lies_in_all_clusters_above_it)
{
    uint64_t random = suite_seed();
    for (int k = 0; k < suite_times(4); ++k)
        for (int m = 0; m < MOTIONS; ++m) {
            sheet sheets[2] = {rough_sheet(&random, 0, 0), rough_sheet(&random, 1, m % 2)};
            imp_scene *scene = scene_of(sheets, motions[m], true);
            ck_assert_uint_eq(imp_scene_piece_count(scene, 1, 0), FACES);
            for (size_t b = 0; b < 2; ++b) {
                const surface *s = scene_surface(scene, b, 0);
                ck_assert_int_ge(check_surface(random, s, TREE_MODELS), 5 * FACES);
                check_surface(random, s, TREE_RATES_FULL);
            }
            imp_scene_free(scene);
        }
}
END_TEST

/* A map that has rates alone bounds the cluster's box, too. */
START_TEST(a_map_without_models_bounds_the_box_of_a_cluster)
{
    imp_instance map;
    ck_assert_int_eq(
        imp_instance_from_text(registry, IMP_TYPE_MAP, "rotate axis=1,1,0 rate=2", &map, NULL),
        IMP_SUCCESS);
    imp_map_type rates_alone = *map.map;
    rates_alone.apply = NULL;
    const char *text = "mesh points=[[0,0,0],[1,0,0],[0,1,0],[0,0,1]] "
                       "faces=[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]";
    imp_instance shape;
    ck_assert_int_eq(imp_instance_from_text(registry, IMP_TYPE_SURFACE, text, &shape, NULL),
                     IMP_SUCCESS);
    surface *s = surface_new(shape.surface, shape.self);
    ck_assert_int_eq(surface_add_map(s, &rates_alone, map.self), IMP_SUCCESS);
    ck_assert_int_eq(surface_divide(s), IMP_SUCCESS);
    ck_assert_uint_eq(surface_piece_count(s), 4);
    ck_assert_int_ge(check_surface(suite_seed(), s, TREE_MODELS), 4);
    surface_free(s);
}
END_TEST

/* --- What may be asked ------------------------------------------------------------------------ */

START_TEST(pieces_are_counted_and_asked_one_by_one)
{
    uint64_t random = suite_seed();
    sheet sheets[2] = {rough_sheet(&random, 0, 0), rough_sheet(&random, 1.2, 0)};
    imp_scene *whole = scene_of(sheets, "", true), *apart = scene_of(sheets, "", false);
    ck_assert_uint_eq(imp_scene_piece_count(whole, 0, 0), FACES);
    ck_assert_uint_eq(imp_scene_piece_count(apart, 0, FACES - 1), 1);
    ck_assert_uint_eq(imp_scene_piece_count(whole, 0, 1), 0);
    for (size_t k = 0; k < FACES; ++k) {
        const double p[3] = {0.25, 0.75, 0.5};
        double x[2][3];
        ck_assert_int_eq(imp_piece_eval(whole, (imp_place){1, 0, k}, 1, p, x[0], NULL, NULL),
                         IMP_SUCCESS);
        ck_assert_int_eq(imp_scene_eval(apart, 1, k, 1, p, x[1], NULL, NULL), IMP_SUCCESS);
        ck_assert_mem_eq(x[0], x[1], sizeof x[0]);
    }
    imp_error error;
    const double p[3] = {0, 0, 0};
    double x[3], lo[3], hi[3];
    ck_assert_int_eq(imp_piece_eval(whole, (imp_place){0, 0, FACES}, 1, p, x, NULL, &error),
                     IMP_ERROR_USAGE);
    ck_assert_str_eq(error.text, "body 0, surface 0 has no piece 72, but 72");
    imp_piece_domain(whole, (imp_place){0, 0, FACES}, lo, hi);
    ck_assert(lo[0] > hi[0]);
    imp_scene_free(whole);
    imp_scene_free(apart);
}
END_TEST

START_TEST(what_waits_names_a_piece_or_several)
{
    uint64_t random = suite_seed();
    sheet sheets[2] = {rough_sheet(&random, 0, 0), rough_sheet(&random, 1.2, 0)};
    imp_scene *scene = scene_of(sheets, motions[1], true);
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_query_new(scene, &options, NULL);
    bool several = false, single = false;
    imp_pending p;
    for (int step = 0; step < 100000 && !(several && single); ++step) {
        ck_assert_int_eq(imp_query_step(query, 1, NULL), IMP_SUCCESS);
        if (imp_query_result(query).reason != IMP_REASON_RUNNING) break;
        for (size_t k = 0; imp_query_pending(query, k, &p); ++k) {
            ck_assert(p.a.piece == SIZE_MAX || p.a.piece < FACES);
            several = several || p.a.piece == SIZE_MAX;
            single = single || p.a.piece < FACES;
        }
    }
    ck_assert(several && single);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* --- Limits ----------------------------------------------------------------------------------- */

enum { ROWS = 66, COLUMNS = 66, LARGE_TEXT = 1 << 20 };

/* A flat mesh of 8450 triangles, and a sphere above it. */
static imp_scene *large_scene(void)
{
    static char text[LARGE_TEXT];
    FILE *out = fmemopen(text, sizeof text, "w");
    fprintf(out, "{\"bodies\":[{\"surfaces\":[{\"type\":\"mesh\",\"points\":[");
    for (int k = 0; k < ROWS * COLUMNS; ++k)
        fprintf(out, "%s[%d,%d,0]", k > 0 ? "," : "", k % COLUMNS, k / COLUMNS);
    fprintf(out, "],\"faces\":[");
    for (int j = 0; j + 1 < ROWS; ++j)
        for (int i = 0; i + 1 < COLUMNS; ++i) {
            const int a = COLUMNS * j + i;
            fprintf(out, "%s[%d,%d,%d],[%d,%d,%d]", a > 0 ? "," : "", a, a + 1, a + COLUMNS, a + 1,
                    a + COLUMNS + 1, a + COLUMNS);
        }
    fprintf(out, "]}]},{\"surfaces\":[{\"type\":\"sphere\",\"center\":[9,9,1.5]}]}]}");
    ck_assert_int_eq(fclose(out), 0);
    imp_error error;
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "test", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

/* A limit that is reached once it was asked for `most` times. */
typedef struct asked {
    int count, most;
} asked;

static bool is_near(void *context, uint64_t bytes, uint64_t pairs)
{
    asked *a = context;
    (void)bytes, (void)pairs;
    a->count += 1;
    return a->count > a->most;
}

static bool is_reached(void *context, uint64_t bytes, uint64_t pairs)
{
    const asked *a = context;
    (void)bytes, (void)pairs;
    return a->count > a->most;
}

/* Collects the candidates of a large scene until the limit, and returns how often it was asked. */
static int collect(int most, bool *complete, uint64_t *nodes)
{
    imp_scene *scene = large_scene();
    const imp_options options = imp_options_default(scene);
    asked a = {0, most};
    const candidate_limit limit = {is_reached, is_near, &a};
    const candidate_search search = {.gamma_clear = 1e-6, .in_parts = false};
    candidate_list list = {0};
    imp_stats stats = {0};
    imp_error error;
    ck_assert_int_eq(candidates_find(&list, scene, &options, &search, &limit, &stats, &error),
                     IMP_SUCCESS);
    *complete = list.complete;
    *nodes = stats.nodes;
    candidates_clear(&list);
    imp_scene_free(scene);
    return a.count;
}

START_TEST(limits_end_the_making_of_a_large_hierarchy)
{
    bool complete;
    uint64_t nodes;
    const int all = collect(INT_MAX, &complete, &nodes);
    ck_assert(complete);
    ck_assert_uint_eq(nodes, 2);
    ck_assert_int_ge(all, 6); /* two surfaces, twice 4096 pieces, twice halves of 4096 and more */
    for (int most = 0; most < all; ++most) {
        ck_assert_int_eq(collect(most, &complete, &nodes), most + 1);
        ck_assert(!complete);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        every_point_of_every_piece_lies_in_all_clusters_above_it,
        a_map_without_models_bounds_the_box_of_a_cluster,
        pieces_are_counted_and_asked_one_by_one,
        what_waits_names_a_piece_or_several,
        limits_end_the_making_of_a_large_hierarchy,
    };
    return suite_main_with("pieces", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
