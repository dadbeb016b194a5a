/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/scene_json.h"
#include "tests/support/compose.h"
#include "tests/support/scene_text.h"

/* Scenes a mechanism is written in: parents, definitions, groups. */

/* A surface that shows its centre, under its own maps; a body "NAME" of one. */
#define AT(X, Y, Z) "{'type':'kit','radius':1,'center':[" #X "," #Y "," #Z "]}"
#define NUDGE(X, Y, Z) "{'type':'nudge','by':[" #X "," #Y "," #Z "]}"
#define LINK(NAME, MORE) "{'name':'" NAME "','surfaces':[" AT(0, 0, 0) "]" MORE "}"
#define BODIES(...) "{'bodies':[" __VA_ARGS__ "]}"

/* --- Parents ---------------------------------------------------------------------------------- */

START_TEST(a_child_moves_with_its_parent_and_that_with_its_own)
{
    imp_scene *scene =
        read_good(BODIES(LINK("hand", ",'parent':'arm','maps':[" NUDGE(1, 0, 0) "]") "," LINK(
            "arm", ",'parent':'base','maps':[" NUDGE(
                       0, 2, 0) "]") "," LINK("base",
                                              ",'maps':[" NUDGE(0, 0, 3) "," NUDGE(0, 0, 4) "]")));
    assert_point(scene, 0, 0, 1, 2, 7);
    assert_point(scene, 1, 0, 0, 2, 7);
    assert_point(scene, 2, 0, 0, 0, 7);
    imp_scene_free(scene);
}
END_TEST

START_TEST(parents_there_are_not_are_refused)
{
    assert_wrong(BODIES(LINK("arm", "") "," LINK("hand", ",'parent':'amr'")),
                 "s.json: /bodies/1/parent: got \"amr\", which is not a body; did you mean 'arm'?");
    assert_wrong(BODIES(LINK("hand", ",'parent':'shoulder'")),
                 "s.json: /bodies/0/parent: got \"shoulder\", must be the name of a body");
    assert_wrong(BODIES(LINK("hand", ",'parent':0")),
                 "s.json: /bodies/0/parent: got 0, must be the name of a body");
    assert_wrong(BODIES(LINK("hand", ",'group':'limbs'") "," LINK("arm", ",'parent':'limbs'")),
                 "s.json: /bodies/1/parent: got \"limbs\", must be the name of a body");
}
END_TEST

START_TEST(circles_of_parents_are_refused_and_told)
{
    const char *allowed = "; must be a parent that is not the body itself nor moves with it";
    char expected[400];
    snprintf(expected, sizeof expected,
             "s.json: /bodies/0/parent: got a circle of parents: 'a', whose parent is 'a' "
             "again%s",
             allowed);
    assert_wrong(BODIES(LINK("a", ",'parent':'a'")), expected);
    snprintf(expected, sizeof expected,
             "s.json: /bodies/1/parent: got a circle of parents: 'b', whose parent is 'c', whose "
             "parent is 'd', whose parent is 'b' again%s",
             allowed);
    assert_wrong(BODIES(LINK("a", ",'parent':'b'") "," LINK("b", ",'parent':'c'") "," LINK(
                     "c", ",'parent':'d'") "," LINK("d", ",'parent':'b'")),
                 expected);
}
END_TEST

/* --- Definitions ------------------------------------------------------------------------------ */

START_TEST(definitions_stand_for_what_they_hold)
{
    imp_scene *scene = read_good("{'define':{'joint':[" NUDGE(1, 0, 0) "," NUDGE(
        0, 1, 0) "],'twice':['joint','joint'],"
                 "'ends':[" AT(5, 0, 0) ",{'type':'kit','radius':1,'maps':['joint']}]},"
                                        "'bodies':[{'surfaces':['ends'," AT(
                                            9, 9, 9) "]},"
                                                     "{'surfaces':['ends'],'maps':['twice'," NUDGE(
                                                         0, 0, 1) "]}]}");
    ck_assert_uint_eq(imp_scene_surface_count(scene, 0), 3);
    assert_point(scene, 0, 0, 5, 0, 0);
    assert_point(scene, 0, 1, 1, 1, 0);
    assert_point(scene, 0, 2, 9, 9, 9);
    ck_assert_uint_eq(imp_scene_surface_count(scene, 1), 2);
    assert_point(scene, 1, 0, 7, 2, 1);
    assert_point(scene, 1, 1, 3, 3, 1);
    imp_scene_free(scene);
}
END_TEST

START_TEST(definitions_there_are_not_are_refused)
{
    assert_wrong("{'define':{'arm':[" AT(0, 0, 0) "]},'bodies':[{'surfaces':['amr']}]}",
                 "s.json: /bodies/0/surfaces/0: got \"amr\", which is not in \"define\"; did you "
                 "mean 'arm'?");
    assert_wrong(BODIES("{'surfaces':['arm']}"),
                 "s.json: /bodies/0/surfaces/0: got \"arm\", which is not in \"define\"; must be "
                 "a name from there, or an object like {\"type\": ...}");
    assert_wrong("{'define':{'arm':[" AT(0, 0, 0) "]},'bodies':[" LINK("a", ",'maps':['arm']") "]}",
                 "s.json: /bodies/0/maps/0: got \"arm\", a definition of surfaces; must be "
                 "maps");
    assert_wrong("{'define':{'j':['k'],'k':[" NUDGE(1, 1, 1) "]},'bodies':[{'surfaces':['j']}]}",
                 "s.json: /define/j/0: got \"k\", a definition of maps; must be surfaces");
}
END_TEST

START_TEST(definitions_that_go_in_circles_are_refused)
{
    assert_wrong("{'define':{'a':['b'],'b':['a']},'bodies':[" LINK("x", ",'maps':['a']") "]}",
                 "s.json: /define/b/0: got \"a\", which is being defined here: a definition may "
                 "not use itself, nor what uses it");
    assert_wrong("{'define':{'a':['a']},'bodies':[" LINK("x", "") "]}",
                 "s.json: /define/a/0: got \"a\", which is being defined here: a definition may "
                 "not use itself, nor what uses it");
}
END_TEST

START_TEST(definitions_are_checked_whether_used_or_not)
{
    assert_wrong("{'define':{'arm':[{'type':'nudge','by':[1]}]},'bodies':[" BODY "]}",
                 "s.json: /define/arm/0/by: got an array of 1, must be an array of 3 numbers");
    assert_wrong("{'define':{'arm':[{'type':'kit','radius':0}]},'bodies':[" BODY "]}",
                 "s.json: /define/arm/0/radius: got 0, must be > 0");
    assert_wrong("{'define':{'arm':[]},'bodies':[" BODY "]}",
                 "s.json: /define/arm: got an array of 0, must be an array of at least 1");
    assert_wrong("{'define':[],'bodies':[" BODY "]}",
                 "s.json: /define: got an array of 0, must be an object, {\"NAME\": [...], ...}");
    assert_wrong("{'define':{'arm':[5]},'bodies':[" BODY "]}",
                 "s.json: /define/arm/0: got 5, must be an object like {\"type\": ...}");
}
END_TEST

/* d0 uses d1 ten times, d1 uses d2 ten times, ...: 10^depth maps from few bytes. */
static char *multiplied(unsigned depth)
{
    const size_t size = 4000 + 200 * depth;
    char *text = malloc(size);
    size_t used = (size_t)snprintf(text, size, "{'define':{");
    for (unsigned k = 0; k < depth; ++k) {
        used += (size_t)snprintf(text + used, size - used, "'d%u':['d%u'", k, k + 1);
        for (int n = 0; n < 9; ++n)
            used += (size_t)snprintf(text + used, size - used, ",'d%u'", k + 1);
        used += (size_t)snprintf(text + used, size - used, "],");
    }
    snprintf(text + used, size - used,
             "'d%u':[" NUDGE(1, 0, 0) "]},'bodies':[{'surfaces':[" AT(0, 0, 0) "],'maps':['d0']}]}",
             depth);
    return text;
}

START_TEST(definitions_within_definitions_have_an_end)
{
    char *text = multiplied(3);
    imp_scene *scene = read_good(text);
    assert_point(scene, 0, 0, 1000, 0, 0);
    imp_scene_free(scene);
    free(text);
    text = multiplied(9);
    ck_assert_ptr_null(read_scene(text));
    ck_assert_ptr_nonnull(strstr(error.text, "more than 4194304 surfaces and maps"));
    free(text);
    text = multiplied(40);
    ck_assert_ptr_null(read_scene(text));
    ck_assert_ptr_nonnull(strstr(error.text, "must be at most 32 deep"));
    free(text);
}
END_TEST

START_TEST(what_is_defined_is_created_once)
{
    json_t *root =
        json_pack("{s{s[{sssf}]s[{sss[fff]}]}s[{s[ss]s[s]}{s[s]s[ss]}]}", "define", "s", "type",
                  "kit", "radius", 1.0, "m", "type", "nudge", "by", 1.0, 1.0, 1.0, "bodies",
                  "surfaces", "s", "s", "maps", "m", "surfaces", "s", "maps", "m", "m");
    ck_assert_ptr_nonnull(root);
    scene_bodies b;
    imp_registry *kit = kit_registry();
    const scene_source source = {.registry = kit};
    const place at = place_document("s.json");
    ck_assert_int_eq(scene_bodies_start(&b, &source, &error), IMP_SUCCESS);
    ck_assert_int_eq(scene_json_read(&b, root, &at), IMP_SUCCESS);
    const assembly_body *body = b.assembly.bodies;
    shared_instance *s = body[0].shapes.at[0].type, *m = body[0].maps.at[0];
    ck_assert(body[0].shapes.at[1].type == s && body[1].shapes.at[0].type == s);
    ck_assert(body[1].maps.at[0] == m && body[1].maps.at[1] == m);
    imp_scene *scene = scene_bodies_finish(&b, &at);
    ck_assert_ptr_nonnull(scene);
    ck_assert_uint_eq(s->holders, 3); /* three surfaces */
    ck_assert_uint_eq(m->holders,
                      4 + 3); /* under four maps; the bodies' lists name it three times */
    assert_point(scene, 1, 0, 2, 2, 2);
    imp_scene_free(scene);
    json_decref(root);
    imp_registry_free(kit);
}
END_TEST

START_TEST(values_of_a_body_are_freed_once_it_is_read)
{
    json_t *root = json_pack("{s[{sss[{sssf}]}{sss[{sssf}]s[]}]}", "bodies", "name", "hand",
                             "surfaces", "type", "kit", "radius", 1.0, "parent", "hand", "surfaces",
                             "type", "kit", "radius", 2.0, "maps");
    ck_assert_ptr_nonnull(root);
    scene_bodies b;
    imp_registry *kit = kit_registry();
    const scene_source source = {.registry = kit};
    const place at = place_document("s.json");
    ck_assert_int_eq(scene_bodies_start(&b, &source, &error), IMP_SUCCESS);
    ck_assert_int_eq(scene_json_read(&b, root, &at), IMP_SUCCESS);
    const json_t *bodies = json_object_get(root, "bodies"), *part = json_array_get(bodies, 1);
    ck_assert(json_is_null(json_array_get(bodies, 0)));
    ck_assert(json_object_size(part) == 1 && json_object_get(part, "parent") != NULL);
    ck_assert_uint_eq(b.assembly.bodies[1].parent, 0);
    imp_scene *scene = scene_bodies_finish(&b, &at);
    ck_assert_ptr_nonnull(scene);
    imp_scene_free(scene);
    json_decref(root);
    imp_registry_free(kit);
}
END_TEST

/* A chain of n links, each with so many maps. */
static char *chain(size_t n, size_t maps)
{
    const size_t size = 200 + n * (120 + 40 * maps);
    char *text = malloc(size);
    size_t used = (size_t)snprintf(text, size, "{'bodies':[");
    for (size_t k = 0; k < n; ++k) {
        used += (size_t)snprintf(text + used, size - used,
                                 "%s{'name':'l%zu','surfaces':[" AT(0, 0, 0) "],'maps':[",
                                 k ? "," : "", k);
        for (size_t m = 0; m < maps; ++m)
            used += (size_t)snprintf(text + used, size - used, "%s" NUDGE(1, 0, 0), m ? "," : "");
        used += (size_t)snprintf(text + used, size - used, "]");
        if (k > 0) used += (size_t)snprintf(text + used, size - used, ",'parent':'l%zu'", k - 1);
        used += (size_t)snprintf(text + used, size - used, "}");
    }
    snprintf(text + used, size - used, "]}");
    return text;
}

/* Each body hangs on the next: d and c, b with a map, a, and z with another. */
/* clang-format off */
static const char bare_ancestors[] =
    "{'bodies':["
    "{'name':'d','parent':'c','surfaces':[" AT(0, 0, 0) "]},"
    "{'name':'c','parent':'b','surfaces':[" AT(0, 0, 0) "]},"
    "{'name':'b','parent':'a','surfaces':[" AT(0, 0, 0) "],'maps':[" NUDGE(1, 0, 0) "]},"
    "{'name':'a','parent':'z','surfaces':[" AT(0, 0, 0) "]},"
    "{'name':'z','surfaces':[" AT(0, 0, 0) "],'maps':[" NUDGE(0, 1, 0) "]}]}";
/* clang-format on */

START_TEST(ancestors_without_maps_count_for_nothing)
{
    char *text = chain(20000, 0);
    imp_scene *scene = read_good(text);
    assert_point(scene, 19999, 0, 0, 0, 0);
    imp_scene_free(scene);
    free(text);
    scene = read_good(bare_ancestors);
    for (size_t body = 0; body < 3; ++body) assert_point(scene, body, 0, 1, 1, 0);
    assert_point(scene, 3, 0, 0, 1, 0);
    imp_scene_free(scene);
}
END_TEST

START_TEST(long_chains_are_composed_or_refused)
{
    char *text = chain(300, 2);
    imp_scene *scene = read_good(text);
    assert_point(scene, 299, 0, 600, 0, 0);
    imp_scene_free(scene);
    free(text);
    text = chain(3000, 1);
    ck_assert_ptr_null(read_scene(text));
    ck_assert_ptr_nonnull(strstr(error.text, "found more than 4194304 maps"));
    free(text);
}
END_TEST

/* --- Groups ----------------------------------------------------------------------------------- */

START_TEST(groups_are_ignored_among_themselves_and_with_others)
{
    imp_scene *scene = read_good(
        "{'bodies':[" LINK("a", ",'group':'arm'") "," LINK("b", ",'group':['arm','tool']") "," LINK(
            "c", ",'group':['tool']") "," LINK("d", "") "],"
                                                        "'ignore':[['arm','arm'],['d','tool']]}");
    ck_assert(scene_ignores(scene, 0, 1) && scene_ignores(scene, 1, 0));
    ck_assert(!scene_ignores(scene, 0, 2) && !scene_ignores(scene, 1, 2));
    ck_assert(!scene_ignores(scene, 0, 3));
    ck_assert(scene_ignores(scene, 1, 3) && scene_ignores(scene, 3, 2));
    imp_scene_free(scene);
    scene = read_good("{'bodies':[" LINK("a", ",'group':'arm'") "," LINK(
        "b", ",'group':'cell'") "," LINK("c", ",'group':'cell'") "],'ignore':[['arm','cell']]}");
    ck_assert(scene_ignores(scene, 0, 1) && scene_ignores(scene, 2, 0));
    ck_assert(!scene_ignores(scene, 1, 2));
    imp_scene_free(scene);
}
END_TEST

START_TEST(groups_that_are_unclear_are_refused)
{
    assert_wrong(BODIES(LINK("a", "") "," LINK("b", ",'group':'a'")),
                 "s.json: /bodies/1/group: found the group 'a', which is the name of body 0; "
                 "must be names that no body has");
    assert_wrong(BODIES(LINK("a", ",'group':['b']") "," LINK("b", "")),
                 "s.json: /bodies/1/name: got the name 'b', which a group has; names must be "
                 "unique");
    assert_wrong(BODIES(LINK("a", ",'group':['g',7]")),
                 "s.json: /bodies/0/group/1: got 7, must be the name of a group");
    assert_wrong(BODIES(LINK("a", ",'group':''")),
                 "s.json: /bodies/0/group: got \"\", must be one line of text");
    assert_wrong("{'bodies':[" LINK("a", ",'group':'tools'") "],'ignore':[['a','tool']]}",
                 "s.json: /ignore/0/1: got \"tool\", which is not a body or group; did you mean "
                 "'tools'?");
}
END_TEST

START_TEST(many_ignored_pairs_are_all_found)
{
    imp_scene *scene = scene_new();
    for (int k = 0; k < 60; ++k) ck_assert_int_eq(scene_add_body(scene, "x"), IMP_SUCCESS);
    uint64_t state = suite_seed();
    bool ignored[60][60] = {{false}};
    for (int k = 0; k < 900; ++k) {
        const size_t a = random_bits(&state) % 60, b = random_bits(&state) % 60;
        ck_assert_int_eq(scene_ignore(scene, a, b), IMP_SUCCESS);
        ignored[a][b] = ignored[b][a] = true;
    }
    for (size_t a = 0; a < 60; ++a)
        for (size_t b = 0; b < 60; ++b) ck_assert(scene_ignores(scene, a, b) == ignored[a][b]);
    imp_scene_free(scene);
}
END_TEST

/* Prints a body in up to two of four groups, without a surface now and then. */
static int print_member(char *text, size_t size, int k, uint64_t *state)
{
    char groups[40] = "";
    const unsigned first = random_bits(state) % 4, count = random_bits(state) % 3;
    if (count == 1) snprintf(groups, sizeof groups, ",'group':'g%u'", first);
    if (count == 2)
        snprintf(groups, sizeof groups, ",'group':['g%u','g%u']", first, (first + 1) % 4);
    return snprintf(text, size, "%s{'name':'b%d','surfaces':[%s]%s}", k > 0 ? "," : "", k,
                    random_bits(state) % 8 > 0 ? AT(0, 0, 0) : "", groups);
}

/* Prints two names of bodies, from the lower and the upper half of them, or of groups. */
static int print_names(char *text, size_t size, unsigned bodies, uint64_t *state)
{
    char name[2][8];
    for (unsigned k = 0; k < 2; ++k) {
        const unsigned group = random_bits(state) % 4,
                       body = k * bodies / 2 + random_bits(state) % (bodies / 2);
        const bool is_group = random_bits(state) % 2 == 0;
        snprintf(name[k], sizeof name[k], "%c%u", is_group ? 'g' : 'b', is_group ? group : body);
    }
    return snprintf(text, size, "['%s','%s']", name[0], name[1]);
}

START_TEST(pairs_are_counted_as_if_one_by_one)
{
    enum { BODIES_MADE = 14, TEXT = 4096 };
    uint64_t state = suite_seed();
    for (int n = 0; n < suite_times_at_least(40); ++n) {
        char text[TEXT];
        int used = snprintf(text, TEXT,
                            "{'bodies':[{'name':'all','group':['g0','g1','g2','g3'],"
                            "'surfaces':[" AT(0, 0, 0) "]},");
        for (int k = 0; k < BODIES_MADE; ++k)
            used += print_member(text + used, TEXT - (size_t)used, k, &state);
        used += snprintf(text + used, TEXT - (size_t)used, "],'ignore':[");
        for (unsigned k = 0, ignored = random_bits(&state) % 9; k < ignored; ++k) {
            used += snprintf(text + used, TEXT - (size_t)used, "%s", k > 0 ? "," : "");
            used += print_names(text + used, TEXT - (size_t)used, BODIES_MADE, &state);
        }
        snprintf(text + used, TEXT - (size_t)used, "]}");
        imp_scene *scene = read_good(text);
        size_t count = 0;
        for (size_t a = 0; a <= BODIES_MADE; ++a)
            for (size_t b = a + 1; b <= BODIES_MADE; ++b) count += !imp_scene_ignores(scene, a, b);
        ck_assert_msg(imp_scene_pair_count(scene) == count, "%zu, not %zu: %s",
                      imp_scene_pair_count(scene), count, text);
        imp_scene_free(scene);
    }
}
END_TEST

SUITE_MAIN("mechanism", a_child_moves_with_its_parent_and_that_with_its_own,
           parents_there_are_not_are_refused, circles_of_parents_are_refused_and_told,
           definitions_stand_for_what_they_hold, definitions_there_are_not_are_refused,
           definitions_that_go_in_circles_are_refused, definitions_are_checked_whether_used_or_not,
           definitions_within_definitions_have_an_end, what_is_defined_is_created_once,
           values_of_a_body_are_freed_once_it_is_read, ancestors_without_maps_count_for_nothing,
           long_chains_are_composed_or_refused, groups_are_ignored_among_themselves_and_with_others,
           groups_that_are_unclear_are_refused, many_ignored_pairs_are_all_found,
           pairs_are_counted_as_if_one_by_one)
