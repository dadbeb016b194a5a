/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/examine.h>

#include "tests/support/query_helpers.h"
#include "tests/support/sphere_scenes.h"
#include "tests/support/suite.h"

/* Every public function is called with every combination of missing objects, missing places, wild
 * indices and numbers that are none. The table is made from the header
 * (tests/support/api_table.awk), so that a new function is tested as soon as it is declared, and a
 * parameter of a new type does not compile before it has values below. Each function has a process
 * of its own. */

/* --- Values of each type ---------------------------------------------------------------------- */

enum { ROOM = 64 };

static double numbers[ROOM];
static imp_error error_place;
static imp_options options_none, options_good, options_wild;
static imp_result result_none, result_good, result_wild;
static imp_clearance_options asked_none, asked_good, asked_wild;
static imp_clearance answer_none, answer_good, answer_wild;
static imp_survey_options how_none, how_good, how_wild;
static imp_survey_state state_none, state_good, state_wild;
static imp_survey_cost cost_none, cost_good, cost_wild;
static imp_scene_parameter_info parameter_place;
static imp_argument argument_none;
static imp_instance instance_none;
static imp_model models[4];
static imp_rigid_motion motion_place;
static imp_facing facing_place[ROOM];
static imp_closure closure_none, closure_good = {.struct_size = sizeof(imp_closure)};
static imp_explanation explanation_place;
static imp_pending pending_place;
static imp_plugin plugin_none;
static imp_plugin_refusal refusal_place;
static imp_remark remark_none, remark_good = {.struct_size = sizeof(imp_remark)};
static imp_stage stage_place;
static imp_type_info info_place;
static const char *text_place;
static size_t size_place[ROOM];
static uint64_t cut_place[ROOM];

static void ignore_finding(void *context, const char *check, imp_finding finding, const char *text)
{
    (void)context, (void)check, (void)finding, (void)text;
}

static void ignore_bytes(void *context, const void *bytes, size_t size)
{
    (void)context, (void)bytes, (void)size;
}

static bool never_go_on(void *context)
{
    (void)context;
    return false;
}

/* The first of a pointer is NULL. Objects are made before the calls. */
static imp_registry *of_imp_registry_p[2];
static imp_scene *of_imp_scene_p[2];
static imp_query *of_imp_query_p[4]; /* new, answered, of a clearance, divided */
static imp_builder *of_imp_builder_p[2];
static imp_survey *of_imp_survey_p[3]; /* for a contact, for a clearance */
static const imp_call *of_imp_call_p[2];
static imp_error *const of_imp_error_p[] = {NULL, &error_place};
static imp_options *const of_imp_options_p[] = {NULL, &options_none, &options_good, &options_wild};
static imp_result *const of_imp_result_p[] = {NULL, &result_none, &result_good, &result_wild};
static imp_clearance_options *const of_imp_clearance_options_p[] = {NULL, &asked_none, &asked_good,
                                                                    &asked_wild};
static imp_clearance *const of_imp_clearance_p[] = {NULL, &answer_none, &answer_good, &answer_wild};
static imp_survey_options *const of_imp_survey_options_p[] = {NULL, &how_none, &how_good,
                                                              &how_wild};
static imp_survey_state *const of_imp_survey_state_p[] = {NULL, &state_none, &state_good,
                                                          &state_wild};
static imp_survey_cost *const of_imp_survey_cost_p[] = {NULL, &cost_none, &cost_good, &cost_wild};
static imp_scene_parameter_info *const of_imp_scene_parameter_info_p[] = {NULL, &parameter_place};
static imp_argument *const of_imp_argument_p[] = {NULL, &argument_none};
static imp_instance *const of_imp_instance_p[] = {NULL, &instance_none};
static imp_model *const of_imp_model_p[] = {NULL, models};
static imp_rigid_motion *const of_imp_rigid_motion_p[] = {NULL, &motion_place};
static imp_facing *const of_imp_facing_p[] = {NULL, facing_place};
static imp_closure *const of_imp_closure_p[] = {NULL, &closure_none, &closure_good};
static imp_explanation *const of_imp_explanation_p[] = {NULL, &explanation_place};
static imp_pending *const of_imp_pending_p[] = {NULL, &pending_place};
static imp_plugin *const of_imp_plugin_p[] = {NULL, &plugin_none};
static imp_plugin_refusal *const of_imp_plugin_refusal_p[] = {NULL, &refusal_place};
static imp_remark *const of_imp_remark_p[] = {NULL, &remark_none, &remark_good};
static imp_stage *const of_imp_stage_p[] = {NULL, &stage_place};
static imp_type_info *const of_imp_type_info_p[] = {NULL, &info_place};
static const char *const of_char_p[] = {NULL, "", "sphere", "{\"bodies\": []}"};
static void *const of_char_p_p[] = {NULL, &text_place}; /* of const char or char */
static double *const of_double_p[] = {NULL, numbers};
static size_t *const of_size_t_p[] = {NULL, size_place};
static uint64_t *const of_uint64_t_p[] = {NULL, cut_place};
static void *const of_void_p[] = {NULL, numbers};
static const imp_proof_sink of_imp_proof_sink[] = {NULL, ignore_bytes};
static const imp_go_on of_imp_go_on[] = {NULL, never_go_on};
static const imp_finding_sink of_imp_finding_sink[] = {NULL, ignore_finding};
static const double of_double[] = {0, -1, 1e-9, NAN, INFINITY};
static const size_t of_size_t[] = {0, 1, 2, SIZE_MAX};
static const size_t of_count[] = {0, 1, SIZE_MAX};
static const uint64_t of_uint64_t[] = {1, UINT64_MAX};
static const uint32_t of_uint32_t[] = {0, UINT32_MAX};
static const unsigned of_unsigned[] = {0, UINT32_MAX};
static const bool of_bool[] = {false, true};
static const imp_place of_imp_place[] = {
    {0, 0, 0}, {SIZE_MAX, 0, 0}, {0, SIZE_MAX, 0}, {0, 0, SIZE_MAX}, {2, 2, 2}};
static const imp_code of_imp_code[] = {IMP_SUCCESS, (imp_code)-1, (imp_code)77};
static const imp_kind of_imp_kind[] = {IMP_KIND_NUMBER, (imp_kind)-1};
static const imp_type_kind of_imp_type_kind[] = {IMP_TYPE_SURFACE, IMP_TYPE_MAP, (imp_type_kind)77};

#define API_VALUE(TYPE, PICK) (of_##TYPE[PICK])
#define API_COUNT(TYPE) (sizeof of_##TYPE / sizeof *of_##TYPE)

/* --- Whether the answer says that something is missing ---------------------------------------- */

static bool drop_registry(imp_registry *made) { return imp_registry_free(made), made == NULL; }
static bool drop_scene(imp_scene *made) { return imp_scene_free(made), made == NULL; }
static bool drop_query(imp_query *made) { return imp_query_free(made), made == NULL; }
static bool drop_survey(imp_survey *made) { return imp_survey_free(made), made == NULL; }
static bool drop_builder(imp_builder *made) { return imp_builder_free(made), made == NULL; }

static bool drop_text(char *made) { return free(made), made == NULL; }
static bool is_none(const char *answer) { return answer == NULL; }

/* So that the compiler does not leave out a call whose answer nobody needs. */
static void *volatile kept;

#define KEEP(TYPE, ANSWER) (kept = &(TYPE){0}, *(TYPE *)kept = (ANSWER), true)

#define API_REFUSED_imp_code(ANSWER) ((ANSWER) == IMP_ERROR_USAGE)
#define API_REFUSED_bool(ANSWER) (!(ANSWER))
#define API_REFUSED_size_t(ANSWER) ((ANSWER) == 0)
/* The caller frees a char *; a const char * is the library's. */
#define API_REFUSED_char_p(ANSWER) _Generic((ANSWER), char * : drop_text, default : is_none)(ANSWER)
#define API_REFUSED_imp_call_p(ANSWER) ((ANSWER) == NULL)
#define API_REFUSED_imp_registry_p(ANSWER) drop_registry(ANSWER)
#define API_REFUSED_imp_scene_p(ANSWER) drop_scene(ANSWER)
#define API_REFUSED_imp_query_p(ANSWER) drop_query(ANSWER)
#define API_REFUSED_imp_survey_p(ANSWER) drop_survey(ANSWER)
#define API_REFUSED_imp_survey_options(ANSWER) KEEP(imp_survey_options, ANSWER)
#define API_REFUSED_imp_builder_p(ANSWER) drop_builder(ANSWER)
/* What answers nothing, a number or a struct cannot refuse. */
#define API_REFUSED_void(ANSWER) (ANSWER, true)
#define API_REFUSED_double(ANSWER) KEEP(double, ANSWER)
#define API_REFUSED_imp_argument(ANSWER) KEEP(imp_argument, ANSWER)
#define API_REFUSED_imp_options(ANSWER) KEEP(imp_options, ANSWER)
#define API_REFUSED_imp_clearance_options(ANSWER) KEEP(imp_clearance_options, ANSWER)
#define API_REFUSED_imp_result(ANSWER) KEEP(imp_result, ANSWER)

#include "tests/unit/api_table.h"

enum { PARAMETERS_MAX = 10 };

typedef struct api_row {
    const char *name;
    bool (*call)(const size_t *pick);
    size_t parameters;
    const char *type[PARAMETERS_MAX + 1];
    size_t choices[PARAMETERS_MAX + 1];
} api_row;

static const api_row table[] = {API_TABLE};
enum { ROWS = sizeof table / sizeof *table };

/* --- Objects ---------------------------------------------------------------------------------- */

#define MAKE_SIZED(TYPE, NAME)                                                                     \
    do {                                                                                           \
        NAME##_good = (TYPE){.struct_size = (uint32_t)sizeof(TYPE)};                               \
        NAME##_wild = (TYPE){.struct_size = UINT32_MAX};                                           \
        NAME##_none = (TYPE){.struct_size = 0};                                                    \
    } while (0)

static void make_places(void)
{
    MAKE_SIZED(imp_options, options);
    MAKE_SIZED(imp_result, result);
    MAKE_SIZED(imp_clearance_options, asked);
    MAKE_SIZED(imp_clearance, answer);
    MAKE_SIZED(imp_survey_options, how);
    MAKE_SIZED(imp_survey_state, state);
    MAKE_SIZED(imp_survey_cost, cost);
    instance_none = (imp_instance){NULL, NULL, NULL};
}

static imp_scene *two_balls(void)
{
    static const ball a = {.radius = 1}, b = {.radius = 1, .centre = {3, 0, 0}};
    return spheres_scene(&ball_type, &a, &ball_type, &b);
}

static void make_objects(void)
{
    imp_error why;
    make_places();
    of_imp_registry_p[1] = imp_registry_open("", IMP_REGISTRY_ONLY_PATH);
    of_imp_scene_p[1] = two_balls();
    of_imp_builder_p[1] = imp_builder_new(of_imp_registry_p[1]);
    const imp_options options = imp_options_default(of_imp_scene_p[1]);
    size_t parts;
    of_imp_query_p[1] = imp_query_new(of_imp_scene_p[1], &options, &why);
    of_imp_query_p[2] = imp_clearance_new(of_imp_scene_p[1], &options, NULL, &why);
    of_imp_query_p[3] = imp_query_new(of_imp_scene_p[1], &options, &why);
    ck_assert_int_eq(imp_query_divide(of_imp_query_p[3], &parts, &why), IMP_SUCCESS);
    ck_assert_int_eq(imp_builder_body(of_imp_builder_p[1], "body", NULL, &why), IMP_SUCCESS);
    of_imp_survey_p[1] = imp_survey_new(of_imp_scene_p[1], &options, NULL, NULL, &why);
    const imp_clearance_options asked = imp_clearance_options_default();
    of_imp_survey_p[2] = imp_survey_new(of_imp_scene_p[1], &options, &asked, NULL, &why);
    of_imp_call_p[1] = imp_call_of_thread();
}

/* --- Calls ------------------------------------------------------------------------------------ */

static bool is_object(const char *type)
{
    static const char *const objects[] = {"imp_registry_p", "imp_scene_p", "imp_query_p",
                                          "imp_builder_p",  "imp_call_p",  "imp_survey_p"};
    for (size_t k = 0; k < sizeof objects / sizeof *objects; ++k)
        if (strcmp(type, objects[k]) == 0) return true;
    return false;
}

static bool is_array(const char *type)
{
    return strcmp(type, "double_p") == 0 || strcmp(type, "imp_argument_p") == 0 ||
           strcmp(type, "char_p") == 0;
}

static bool ends_with(const char *name, const char *end)
{
    const size_t length = strlen(name), last = strlen(end);
    return length >= last && strcmp(name + length - last, end) == 0;
}

/* The program must not say that an array is longer than it is, nor free twice. */
static bool is_allowed(const api_row *f, const size_t *pick)
{
    bool wild_count = false;
    if ((ends_with(f->name, "_free") || ends_with(f->name, "_finish")) && pick[0] > 0) return false;
    for (size_t k = 0; k < f->parameters; ++k)
        wild_count |= strcmp(f->type[k], "count") == 0 && pick[k] + 1 == API_COUNT(count);
    for (size_t k = 0; wild_count && k < f->parameters; ++k)
        if (is_array(f->type[k]) && pick[k] > 0) return false;
    return true;
}

/* The next combination; false: that was the last. */
static bool next(const api_row *f, size_t *pick)
{
    for (size_t k = 0; k < f->parameters; ++k) {
        pick[k] += 1;
        if (pick[k] < f->choices[k]) return true;
        pick[k] = 0;
    }
    return false;
}

START_TEST(no_function_is_harmed_by_what_is_missing_or_wild)
{
    const api_row *f = &table[_i];
    size_t pick[PARAMETERS_MAX] = {0};
    fprintf(stderr, "%s\n", f->name); /* is the last line of the log where the call crashes */
    make_objects();
    do {
        if (!is_allowed(f, pick)) continue;
        make_places();
        const bool refused = f->call(pick);
        const bool lacks_object = f->parameters > 0 && is_object(f->type[0]) && pick[0] == 0;
        ck_assert_msg(refused || !lacks_object, "%s takes a NULL for a good %s", f->name,
                      f->type[0]);
    } while (next(f, pick));
}
END_TEST

START_TEST(the_table_has_all_functions_of_the_library)
{
    char command[4096], line[256];
    const char *build = getenv("top_builddir");
    size_t count = 0;
    snprintf(command, sizeof command, "nm -D --defined-only %s/.libs/libimpinge.so",
             build != NULL ? build : ".");
    FILE *symbols = popen(command, "r");
    while (symbols != NULL && fgets(line, sizeof line, symbols) != NULL) {
        char kind, name[128];
        bool found = false;
        if (sscanf(line, "%*s %c %127[a-z_0-9]", &kind, name) != 2 || kind != 'T') continue;
        if (strncmp(name, "imp_", 4) != 0) continue;
        for (size_t k = 0; k < ROWS; ++k) found |= strcmp(table[k].name, name) == 0;
        ck_assert_msg(found, "%s is not in the table", name);
        count += 1;
    }
    ck_assert(symbols != NULL && pclose(symbols) == 0);
    ck_assert_uint_gt(count, 50);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("api");
    TCase *each = tcase_create("each function"), *all = tcase_create("all functions");
    tcase_set_timeout(each, 300);
    tcase_add_loop_test(each, no_function_is_harmed_by_what_is_missing_or_wild, 0, ROWS);
    tcase_add_test(all, the_table_has_all_functions_of_the_library);
    suite_add_tcase(suite, each);
    suite_add_tcase(suite, all);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
