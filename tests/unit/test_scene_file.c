/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/scene/scene.h"
#include "tests/support/scene_text.h"

START_TEST(a_scene_has_its_bodies_surfaces_and_names)
{
    imp_scene *scene =
        read_good("{'bodies':[{'name':'pot','surfaces':[" KIT "," KIT "]}," BODY "]}");
    ck_assert_uint_eq(imp_scene_body_count(scene), 2);
    ck_assert_str_eq(imp_scene_body_name(scene, 0), "pot");
    ck_assert_str_eq(imp_scene_body_name(scene, 1), "body1");
    ck_assert_uint_eq(imp_scene_surface_count(scene, 0), 2);
    ck_assert_uint_eq(imp_scene_surface_count(scene, 1), 1);
    imp_scene_free(scene);
}
END_TEST

START_TEST(settings_are_taken_or_have_their_presets)
{
    imp_scene *scene = read_good(SCENE(""));
    imp_options options = imp_options_default(scene);
    ck_assert_double_eq(options.t_start, 0);
    ck_assert_double_eq(options.t_end, 1);
    ck_assert_double_eq(options.gamma, 1e-6);
    ck_assert_double_lt(options.gamma_clear, 0);
    imp_scene_free(scene);
    scene = read_good(SCENE(",'time':[-2,3],'gamma':0.5,'gamma_clear':0,'id':7,'reference':{'t':1},"
                            "'note':'n'"));
    options = imp_options_default(scene);
    ck_assert_double_eq(options.t_start, -2);
    ck_assert_double_eq(options.t_end, 3);
    ck_assert_double_eq(options.gamma, 0.5);
    ck_assert_double_eq(options.gamma_clear, 0);
    imp_scene_free(scene);
}
END_TEST

START_TEST(an_instant_is_an_interval) { imp_scene_free(read_good(SCENE(",'time':[1,1]"))); }
END_TEST

START_TEST(settings_out_of_range_are_refused)
{
    assert_wrong(SCENE(",'time':[1,0]"), "s.json: /time: got the empty interval [1, 0], must be "
                                         "[start, end] with start <= end");
    assert_wrong(SCENE(",'time':[0]"),
                 "s.json: /time: got an array of 1, must be an array of 2 numbers");
    assert_wrong(SCENE(",'time':1"), "s.json: /time: got 1, must be an array of 2 numbers");
    assert_wrong(SCENE(",'gamma':0"), "s.json: /gamma: got 0, must be > 0");
    assert_wrong(SCENE(",'gamma':-1e-3"), "s.json: /gamma: got -0.001, must be > 0");
    assert_wrong(SCENE(",'gamma':'small'"), "s.json: /gamma: got \"small\", must be a number > 0");
    assert_wrong(SCENE(",'gamma_clear':1e-6"),
                 "s.json: /gamma_clear: got 1e-06, must be from 0 to below gamma = 1e-06");
    assert_wrong(SCENE(",'gamma_clear':-1"), "s.json: /gamma_clear: got -1, must be >= 0");
}
END_TEST

START_TEST(maps_of_the_surface_come_before_maps_of_the_body)
{
    imp_scene *scene =
        read_good("{'bodies':[{'surfaces':[{'type':'kit','radius':1,'center':[1,2,3],"
                  "'maps':[{'type':'nudge','by':[1,0,0]}]}," KIT "],"
                  "'maps':[{'type':'nudge','by':[0,0,1]},{'type':'nudge','by':[0,0,1]}]}]}");
    assert_point(scene, 0, 0, 2, 2, 5);
    assert_point(scene, 0, 1, 0, 0, 2);
    imp_scene_free(scene);
}
END_TEST

START_TEST(ignored_pairs_are_named)
{
    imp_scene *scene = read_good("{'bodies':[{'name':'a','surfaces':[" KIT "]}," BODY "," BODY
                                 "],'ignore':[['body2','a']]}");
    ck_assert(scene_ignores(scene, 0, 2));
    ck_assert(!scene_ignores(scene, 0, 1));
    imp_scene_free(scene);
    imp_scene_free(read_good(SCENE(",'ignore':[]")));
    assert_wrong(
        SCENE(",'ignore':[['body0','bdoy1']]"),
        "s.json: /ignore/0/1: got \"bdoy1\", which is not a body or group; did you mean 'body1'?");
    assert_wrong(SCENE(",'ignore':[['body0','body1'],['body0']]"),
                 "s.json: /ignore/1: got an array of 1, must be two names of bodies or groups");
    assert_wrong(SCENE(",'ignore':[[0,1]]"),
                 "s.json: /ignore/0/0: got 0, must be the name of a body or group");
    assert_wrong(SCENE(",'ignore':[['body0','body0']]"),
                 "s.json: /ignore/0: got the same body twice, must be two bodies; surfaces of one "
                 "body are never tested with each other");
    assert_wrong(SCENE(",'ignore':'body0'"), "s.json: /ignore: got \"body0\", must be an array");
}
END_TEST

START_TEST(names_of_bodies_are_unique_lines)
{
    assert_wrong("{'bodies':[{'name':'a','surfaces':[" KIT "]},{'name':'a','surfaces':[" KIT "]}]}",
                 "s.json: /bodies/1/name: got the name 'a', which body 0 has; "
                 "names must be unique");
    assert_wrong("{'bodies':[{'name':'body1','surfaces':[" KIT "]}," BODY "]}",
                 "s.json: /bodies/1: got the name 'body1', which body 0 has; "
                 "names must be unique");
    assert_wrong("{'bodies':[{'name':'','surfaces':[" KIT "]}]}",
                 "s.json: /bodies/0/name: got \"\", must be one line of text");
    assert_wrong("{'bodies':[{'name':5,'surfaces':[" KIT "]}]}",
                 "s.json: /bodies/0/name: got 5, must be one line of text");
}
END_TEST

START_TEST(maps_of_a_map_are_refused)
{
    assert_wrong("{'bodies':[{'surfaces':[" KIT "],'maps':[{'type':'shift','maps':[]}]}]}",
                 "s.json: /bodies/0/maps/0/maps: a map has no maps of its own; list them after it, "
                 "in the order in which they apply");
}
END_TEST

START_TEST(unknown_keys_are_refused_with_the_nearest)
{
    assert_wrong(SCENE(",'gama':1"),
                 "s.json: /gama: unknown key, did you mean 'gamma'? "
                 "Valid keys are time, gamma, gamma_clear, define, bodies, ignore, "
                 "id, reference, note, gravity, events, plugins, parameters");
    assert_wrong("{'bodies':[{'surface':[" KIT "]}]}",
                 "s.json: /bodies/0/surface: unknown key, did you mean 'surfaces'? Valid keys "
                 "are name, surfaces, maps, parent, group, solid, mass, inertia, center, "
                 "friction, restitution, velocity, spin");
    assert_wrong(
        SCENE(",'comment':1"),
        "s.json: /comment: unknown key; valid keys are time, gamma, gamma_clear, "
        "define, bodies, ignore, id, reference, note, gravity, events, plugins, parameters");
}
END_TEST

START_TEST(properties_of_bodies_are_ignored_and_motions_to_compute_refused)
{
    assert_wrong("{'bodies':[{'surfaces':[" KIT "],'mass':1,'velocity':[1,0,0]}]}",
                 "s.json: /bodies/0/velocity: velocity needs `impinge simulate` first; pass its "
                 "output here");
    assert_wrong(
        "{'bodies':[{'surfaces':[" KIT "],'spin':[1,0,0]}]}",
        "s.json: /bodies/0/spin: spin needs `impinge simulate` first; pass its output here");
    assert_wrong(SCENE(",'gravity':[0,0,-1]"),
                 "s.json: /gravity: gravity needs `impinge simulate` first; pass its output here");
    imp_scene *scene =
        read_good("{'events':[],'bodies':[{'surfaces':[" KIT "],'mass':1,'inertia':0,"
                  "'center':0,'restitution':1,'friction':1}]}");
    imp_scene_free(scene);
}
END_TEST

START_TEST(missing_and_misshapen_parts_are_told)
{
    assert_wrong("{}", "s.json: \"bodies\" is missing; it must be an array");
    assert_wrong("[]", "s.json: got an array of 0, must be a scene, {\"bodies\": [...]}");
    assert_wrong("{'bodies':[]}", "s.json: /bodies: got an array of 0, must be an array of at "
                                  "least 1");
    assert_wrong("{'bodies':[7]}",
                 "s.json: /bodies/0: got 7, must be a body, {\"surfaces\": [...]}");
    assert_wrong("{'bodies':[{'surfaces':{}}]}",
                 "s.json: /bodies/0/surfaces: got an object, must be an array");
    assert_wrong("{'bodies':[{'surfaces':[[]]}]}", "s.json: /bodies/0/surfaces/0: got an array of "
                                                   "0, must be an object like {\"type\": ...}");
    assert_wrong("{'bodies':[{'surfaces':[" KIT "],'maps':{}}]}",
                 "s.json: /bodies/0/maps: got an object, must be an array");
}
END_TEST

START_TEST(types_are_told_when_unknown_or_of_the_wrong_sort)
{
    const char *list = "`impinge list` shows what there is";
    char expected[300];
    snprintf(
        expected, sizeof expected,
        "s.json: /bodies/0/surfaces/0/type: unknown surface type 'kti', did you mean 'kit'? %s",
        list);
    assert_wrong("{'bodies':[{'surfaces':[{'type':'kti'}]}]}", expected);
    snprintf(expected, sizeof expected,
             "s.json: /bodies/0/surfaces/0/type: unknown surface type 'zebra'; %s", list);
    assert_wrong("{'bodies':[{'surfaces':[{'type':'zebra'}]}]}", expected);
    snprintf(expected, sizeof expected,
             "s.json: /bodies/0/surfaces/0/type: got the map 'nudge', must be a surface type; "
             "%s",
             list);
    assert_wrong("{'bodies':[{'surfaces':[{'type':'nudge'}]}]}", expected);
    assert_wrong(
        "{'bodies':[{'surfaces':[{'radius':1}]}]}",
        "s.json: /bodies/0/surfaces/0: \"type\" is missing; it must be a surface type's name");
    assert_wrong("{'bodies':[{'surfaces':[{'type':1}]}]}",
                 "s.json: /bodies/0/surfaces/0/type: got 1, must be a surface type's name");
}
END_TEST

START_TEST(parameters_are_told_by_their_pointer)
{
    assert_wrong("{'bodies':[" BODY ",{'surfaces':[" KIT ",{'type':'kit','radius':-1}]}]}",
                 "s.json: /bodies/1/surfaces/1/radius: got -1, must be > 0");
    assert_wrong("{'bodies':[{'surfaces':[{'type':'kit','radius':1,'points':[[1,2,3],[1,2]]}]}]}",
                 "s.json: /bodies/0/surfaces/0/points/1: got an array of 2, must be an array of 3 "
                 "numbers");
    assert_wrong("{'bodies':[{'surfaces':[" KIT "],'maps':[{'type':'nudge','by':[1,2]}]}]}",
                 "s.json: /bodies/0/maps/0/by: got an array of 2, must be an array of 3 numbers");
    assert_wrong("{'bodies':[{'surfaces':[{'type':'kit','radius':1,'maps':[{'type':'nudge'}]}]}]}",
                 "s.json: /bodies/0/surfaces/0/maps/0: 'by' is missing; it must be an array of 3 "
                 "numbers");
}
END_TEST

static void assert_mood(const char *mood, const char *message)
{
    char scene[300];
    snprintf(scene, sizeof scene,
             "{'bodies':[{'surfaces':[{'type':'kit','radius':1,'mood':'%s',"
             "'points':[[0,0,0],[1,1,1]]}]}]}",
             mood);
    assert_wrong(scene, message);
}

START_TEST(complaints_of_create_are_told_by_their_pointer)
{
    assert_mood("radius", "s.json: /bodies/0/surfaces/0/radius: got 1, must be 2");
    assert_mood("point", "s.json: /bodies/0/surfaces/0/points/1: got a knot");
    assert_mood("whole", "s.json: /bodies/0/surfaces/0: got nonsense");
    assert_mood("beyond", "s.json: /bodies/0/surfaces/0: row 1234");
    assert_mood("bell", "s.json: /bodies/0/surfaces/0/label: ??");
    assert_mood("silent", "s.json: /bodies/0/surfaces/0: refused, and the plugin does not say why");
}
END_TEST

static void assert_plugin_blamed(const char *type, const char *message)
{
    char scene[200];
    snprintf(scene, sizeof scene, "{'bodies':[{'surfaces':[{'type':'%s'}]}]}", type);
    fp_mode before = fp_mode_read();
    ck_assert_ptr_null(read_scene(scene));
    ck_assert(fp_mode_read() == before);
    ck_assert_int_eq(error.code, IMP_ERROR_PLUGIN);
    ck_assert_msg(strstr(error.text, message) != NULL, "%s", error.text);
    ck_assert_msg(strstr(error.text, type) != NULL, "%s", error.text);
    ck_assert_msg(strstr(error.text, ".so)") != NULL, "%s", error.text);
}

START_TEST(broken_promises_of_create_are_the_plugins_fault)
{
    assert_plugin_blamed("create_fails",
                         "s.json: /bodies/0/surfaces/0: create failed with status 4");
    assert_plugin_blamed("create_null", "create returned IMP_STATUS_OK without an instance");
    assert_plugin_blamed("create_rounds", "create changed the mode of arithmetic");
}
END_TEST

/* The place is ours to get right, the words are jansson's. */
static void assert_syntax(const char *quoted, const char *place, const char *word)
{
    ck_assert_ptr_null(read_scene(quoted));
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    ck_assert_msg(strncmp(error.text, place, strlen(place)) == 0, "%s", error.text);
    ck_assert_msg(strstr(error.text, word) != NULL, "%s", error.text);
}

START_TEST(syntax_is_told_by_line_and_column)
{
    assert_syntax("{'bodies':\n [\n  }", "s.json:3:3: ", "unexpected token");
    assert_syntax("{'gamma':1e999}", "s.json:1:14: ", "overflow");
    assert_syntax("{'gamma':NaN}", "s.json:1:12: ", "invalid token near 'NaN'");
    assert_syntax("{'gamma':1,\n'gamma':2}", "s.json:2:7: ", "duplicate");
    assert_syntax("{'note':'\xFF'}", "s.json:1:9: ", "0xff");
    assert_syntax("{'note':'\\u0000'}", "s.json:1:16: ", "\\u0000");
    assert_syntax("{} {}", "s.json:1:4: ", "end of file expected");
    assert_wrong("", "s.json: is empty, must be a scene, {\"bodies\": [...]}");
    assert_wrong(" \n\t", "s.json: is empty, must be a scene, {\"bodies\": [...]}");
}
END_TEST

START_TEST(a_byte_order_mark_is_passed_over)
{
    imp_scene_free(read_good("\xEF\xBB\xBF" SCENE("")));
}
END_TEST

START_TEST(nesting_without_end_is_refused)
{
    char text[5001];
    memset(text, '[', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    ck_assert_ptr_null(read_scene(text));
    ck_assert_ptr_nonnull(strstr(error.text, "maximum parsing depth reached"));
}
END_TEST

START_TEST(files_are_read_or_refused_with_the_cause)
{
    sandbox box = sandbox_new();
    registry = kit_registry();
    const char *text = "{\"bodies\":[{\"surfaces\":[{\"type\":\"kit\",\"radius\":1}]}]}";
    sandbox_write(&box, "good.json", text, strlen(text));
    sandbox_write(&box, "empty.json", "", 0);
    imp_scene_free(imp_scene_from_file(registry, sandbox_file(&box, "good.json").at, &error));
    ck_assert_ptr_null(imp_scene_from_file(registry, sandbox_file(&box, "empty.json").at, &error));
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    ck_assert_ptr_nonnull(strstr(error.text, "empty.json: is empty"));
    ck_assert_ptr_null(imp_scene_from_file(registry, sandbox_file(&box, "missing").at, &error));
    ck_assert_int_eq(error.code, IMP_ERROR_FILE);
    ck_assert_ptr_nonnull(strstr(error.text, "missing: cannot be read: No such file"));
    ck_assert_ptr_null(imp_scene_from_file(registry, box.path, &error));
    ck_assert_int_eq(error.code, IMP_ERROR_FILE);
    ck_assert_ptr_nonnull(strstr(error.text, "Is a directory"));
    sandbox_remove(&box);
}
END_TEST

START_TEST(arguments_that_are_null_are_wrong_usage)
{
    ck_assert_ptr_null(imp_scene_from_json(NULL, "{}", 2, "s", &error));
    ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
    ck_assert_ptr_null(imp_scene_from_file(NULL, NULL, &error));
    ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
    ck_assert_ptr_null(imp_scene_from_pair(NULL, "a", "b", &error));
    ck_assert_int_eq(error.code, IMP_ERROR_USAGE);
    ck_assert_ptr_null(imp_scene_from_pair(NULL, "a", "b", NULL));
}
END_TEST

/* A byte that means something in a scene, or any byte at all. */
static char random_byte(uint64_t *state)
{
    static const char telling[] = "{}[]\",:0123456789.eE+-tfn\\u \n";
    uint64_t bits = random_bits(state);
    return bits % 4 ? telling[(bits >> 8) % (sizeof telling - 1)] : (char)(bits >> 8);
}

/* Changes, removes, doubles or moves a piece of the text; answers the new length. */
static size_t mutate(char *text, size_t length, size_t capacity, uint64_t *state)
{
    size_t at = random_bits(state) % length, n = 1 + random_bits(state) % 8;
    if (n > length - at) n = length - at;
    switch (random_bits(state) % 4) {
    case 0:
        memmove(text + at, text + at + n, length - at - n);
        return length - n > 0 ? length - n : length;
    case 1:
        if (length + n > capacity) return length;
        memmove(text + at + n, text + at, length - at);
        return length + n;
    case 2: {
        size_t from = random_bits(state) % (length - n + 1);
        memmove(text + at, text + from, n);
        return length;
    }
    default:
        text[at] = random_byte(state);
        return length;
    }
}

START_TEST(damaged_scenes_are_read_or_refused_and_never_harm)
{
    static const char scene[] =
        "{\"time\":[0,1],\"gamma\":1e-3,\"gamma_clear\":1e-4,\"bodies\":[{\"name\":\"a\","
        "\"surfaces\":"
        "[{\"type\":\"kit\",\"radius\":1,\"center\":[1,2,3],\"points\":[[1,2,3],[4,5,6]],\"count\":"
        "3,"
        "\"closed\":true,\"label\":\"x\",\"constants\":{\"a\":1},\"weights\":[0.5,1],\"maps\":["
        "{\"type\":\"nudge\",\"by\":[1,0,0]}]}]},{\"surfaces\":[{\"type\":\"kit\",\"radius\":2}],"
        "\"maps\":[{\"type\":\"nudge\",\"by\":[0,1,0]}]}],\"ignore\":[[\"a\",\"body1\"]]}";
    registry = kit_registry();
    uint64_t state = suite_seed();
    size_t read = 0;
    for (int k = 0; k < suite_times(40000); ++k) {
        char text[2 * sizeof scene];
        size_t length = sizeof scene - 1;
        memcpy(text, scene, length);
        for (uint64_t n = 1 + random_bits(&state) % 4; n > 0; --n)
            length = mutate(text, length, sizeof text, &state);
        imp_scene *damaged = imp_scene_from_json(registry, text, length, "s", &error);
        read += damaged != NULL;
        imp_scene_free(damaged);
    }
    ck_assert_uint_gt(read, 0);
    imp_registry_free(registry);
    registry = NULL;
}
END_TEST

SUITE_MAIN("scene_file", a_scene_has_its_bodies_surfaces_and_names,
           settings_are_taken_or_have_their_presets, an_instant_is_an_interval,
           settings_out_of_range_are_refused, maps_of_the_surface_come_before_maps_of_the_body,
           ignored_pairs_are_named, names_of_bodies_are_unique_lines, maps_of_a_map_are_refused,
           unknown_keys_are_refused_with_the_nearest,
           properties_of_bodies_are_ignored_and_motions_to_compute_refused,
           missing_and_misshapen_parts_are_told, types_are_told_when_unknown_or_of_the_wrong_sort,
           parameters_are_told_by_their_pointer, complaints_of_create_are_told_by_their_pointer,
           broken_promises_of_create_are_the_plugins_fault, syntax_is_told_by_line_and_column,
           a_byte_order_mark_is_passed_over, nesting_without_end_is_refused,
           files_are_read_or_refused_with_the_cause, arguments_that_are_null_are_wrong_usage,
           damaged_scenes_are_read_or_refused_and_never_harm)
