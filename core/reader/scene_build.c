/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/active_callback.h"
#include "core/base/fp_mode.h"
#include "core/base/text.h"
#include "core/base/unconst.h"
#include "core/common/search_path.h"
#include "core/plugin/isolate.h"
#include "core/plugin/json_describe.h"
#include "core/plugin/parameter_numbers.h"
#include "core/plugin/type_view.h"
#include "core/reader/scene_build.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* --- Which type ------------------------------------------------------------------------------- */

static const char *kind_word(imp_type_kind kind)
{
    return kind == IMP_TYPE_SURFACE ? "surface type" : "map";
}

/* A name that is unknown, perhaps because it is of the other kind. */
static imp_code refuse_type(const imp_registry *registry, imp_type_kind kind, const char *name,
                            const place *at, imp_error *error)
{
    imp_type_kind other = kind == IMP_TYPE_SURFACE ? IMP_TYPE_MAP : IMP_TYPE_SURFACE;
    const char *verb = "`impinge list` shows what there is";
    if (registry_find_file(registry, other, name) != NULL)
        return place_error(at, error, IMP_ERROR_SCENE, "got the %s '%s', must be a %s; %s",
                           kind_word(other), name, kind_word(kind), verb);
    if (is_named_so(name))
        return place_error(at, error, IMP_ERROR_SCENE,
                           "'%.80s' is a file, must be the name of a %s; give the directory of the "
                           "file by --plugin-path and take a name from `impinge list`",
                           name, kind_word(kind));
    const char *near = registry_nearest(registry, kind, name);
    const registry_text left_out = registry_left_out(registry, name);
    if (near != NULL)
        return place_error(at, error, IMP_ERROR_SCENE,
                           "unknown %s '%.80s', did you mean '%s'? %s%s", kind_word(kind), name,
                           near, verb, left_out.text);
    return place_error(at, error, IMP_ERROR_SCENE, "unknown %s '%.80s'; %s%s", kind_word(kind),
                       name, verb, left_out.text);
}

static imp_code read_type(const json_t *object, imp_type_kind kind, const place *at,
                          const char **name, imp_error *error)
{
    if (!json_is_object(object))
        return place_error(at, error, IMP_ERROR_SCENE,
                           "got %s, must be an object like {\"type\": ...}",
                           json_describe(object).at);
    const json_t *type = json_object_get(object, "type");
    if (type == NULL)
        return place_error(at, error, IMP_ERROR_SCENE,
                           "\"type\" is missing; it must be a %s's name", kind_word(kind));
    place member = place_key(at, "type");
    if (!json_is_string(type))
        return place_error(&member, error, IMP_ERROR_SCENE, "got %s, must be a %s's name",
                           json_describe(type).at, kind_word(kind));
    *name = json_string_value(type);
    return IMP_SUCCESS;
}

/* --- Creating --------------------------------------------------------------------------------- */

const char *scene_making_file(const scene_making *m)
{
    const imp_type_kind kind = m->instance.surface != NULL ? IMP_TYPE_SURFACE : IMP_TYPE_MAP;
    return registry_find_file(m->source->registry, kind, m->view.name);
}

static imp_code blame(const scene_making *m, const char *what, const place *at, imp_error *error)
{
    return place_error(at, error, IMP_ERROR_PLUGIN, "%s: bug in plugin type '%s' (%s)", what,
                       m->view.name, scene_making_file(m));
}

static imp_code judge_failure(imp_status status, const scene_making *m, imp_create_error *why,
                              const place *at, imp_error *error)
{
    const type_view *view = &m->view;
    if (status > IMP_STATUS_INTERNAL) {
        const char *callback;
        active_callback_last(&callback);
        place_error(at, error, IMP_ERROR_PLUGIN, "%s of '%s' (%s) %s%s%s", callback, view->name,
                    scene_making_file(m), surface_status_text(status),
                    why->text[0] != '\0' ? ": " : "", why->text);
        return surface_set_code(status, error);
    }
    if (status == IMP_STATUS_PARAMETER)
        return parameters_create_error(&view->table, &m->values, why, at, error);
    char what[360];
    why->text[sizeof why->text - 1] = '\0';
    snprintf(what, sizeof what, "create failed with status %d%s%s", (int)status,
             why->text[0] ? ", " : "", why->text);
    return blame(m, what, at, error);
}

/* A complaint, and marks on either side that show when create writes beyond it. */
#define MARK 0x5a
typedef struct guarded_error {
    unsigned char before[64];
    imp_create_error why;
    unsigned char after[256]; /* texts that are too long end here */
    reading_budget *budget;   /* NULL: no limits */
    const scene_source *source;
} guarded_error;

static const guarded_error *guarded_error_of(const imp_create_error *why)
{
    return (const guarded_error *)(const void *)((const char *)why - offsetof(guarded_error, why));
}

/* What create asks (imp_create_error.goes_on). */
static int goes_on(imp_create_error *why, uint64_t bytes)
{
    return reading_budget_allows(guarded_error_of(why)->budget, bytes);
}

/* What create tells (imp_create_error.reads). */
static int reads(imp_create_error *why, const char *path)
{
    const scene_source *source = guarded_error_of(why)->source;
    return path != NULL && named_files_add(source->files, path, source->folder);
}

static void guard(guarded_error *g, const scene_making *m)
{
    memset(g, MARK, sizeof *g);
    g->why = (imp_create_error){.struct_size = sizeof g->why, .parameter = -1, .element = -1};
    g->budget = m->budget;
    g->source = m->source;
    if (m->budget != NULL) g->why.goes_on = goes_on;
    if (m->source->files != NULL) g->why.reads = reads;
}

/* In this process, or in that of the stand-in, which then is the instance. */
static imp_status call_create(const type_view *view, isolated *stand_in, const imp_value *values,
                              void **self, guarded_error *g)
{
    if (stand_in == NULL) return view->create(values, self, &g->why);
    *self = stand_in;
    isolate_limit(stand_in, reading_budget_rest(g->budget));
    const imp_status status = isolate_create(stand_in, values, &g->why);
    if (g->budget != NULL) g->budget->end = isolate_end(stand_in);
    return status;
}

/* Whether all bytes are marks: the first is, and each is like the one before it. */
static bool is_marked(const unsigned char *bytes, size_t size)
{
    return bytes[0] == MARK && memcmp(bytes, bytes + 1, size - 1) == 0;
}

static bool is_whole(const guarded_error *g)
{
    if (!is_marked(g->before, sizeof g->before) || !is_marked(g->after, sizeof g->after))
        return false;
    /* A text that does not end, and something behind it: the text went on there. */
    return (g->why.text[sizeof g->why.text - 1] == '\0' || g->why.note_count == 0) &&
           (g->why.note[sizeof g->why.note - 1] == '\0' || g->why.is_repeatable == 0);
}

/* Takes a note over; texts of plugins are not trusted. */
static void take_note(const parameter_table *table, const imp_create_error *why,
                      scene_build_note *note)
{
    const bool has_row = why->note_parameter >= 0 && (size_t)why->note_parameter < table->count;
    note->count = why->note_count;
    snprintf(note->text, sizeof note->text, "%.64s%s%.*s",
             has_row ? parameter_table_row(table, (size_t)why->note_parameter)->name : "",
             has_row ? ": " : "", (int)sizeof why->note - 1, why->note);
    for (char *c = note->text; *c != '\0'; ++c)
        if ((unsigned char)*c < ' ') *c = ' ';
}

/* Runs the plugin's create and judges its answer. */
static imp_code run_create(scene_making *m, const place *at, scene_build_note *note,
                           imp_error *error)
{
    const type_view *view = &m->view;
    void **self = &m->instance.self;
    guarded_error g;
    guard(&g, m);
    *self = NULL;
    fp_mode before = fp_mode_read();
    imp_call *call = m->stand_in == NULL ? active_callback_begin(view->name, "create") : NULL;
    imp_status status = call_create(view, m->stand_in, m->values.value, self, &g);
    if (call != NULL) active_callback_end(call);
    bool kept = fp_mode_kept(before);
    if (!is_whole(&g))
        return blame(m, "create wrote beyond the imp_create_error it was given", at, error);
    if (status == IMP_STATUS_INTERNAL && reading_budget_is_over(m->budget))
        return reading_budget_refuse(m->budget, at, error);
    if (status != IMP_STATUS_OK) return judge_failure(status, m, &g.why, at, error);
    if (*self == NULL)
        return blame(m, "create returned IMP_STATUS_OK without an instance", at, error);
    if (note != NULL && g.why.note_count > 0) take_note(&view->table, &g.why, note);
    if (note != NULL) note->is_repeatable = g.why.is_repeatable == 1;
    if (kept) return IMP_SUCCESS;
    view->destroy(*self);
    *self = NULL;
    fp_mode_kept(before);
    return blame(m, "create changed the mode of arithmetic", at, error);
}

/* Lets the plugin refill an instance. False: create has to make one, and says what is wrong. */
static bool run_renew(scene_making *m, scene_build_note *note)
{
    guarded_error g;
    guard(&g, m);
    const fp_mode before = fp_mode_read();
    imp_call *call = active_callback_begin(m->view.name, "renew");
    const imp_status status = m->view.renew(m->again->self, m->values.value, &g.why);
    active_callback_end(call);
    if (!fp_mode_kept(before) || !is_whole(&g) || status != IMP_STATUS_OK) return false;
    if (g.why.note_count > 0) take_note(&m->view.table, &g.why, note);
    note->is_repeatable = g.why.is_repeatable == 1;
    return true;
}

/* Refills m->again, or calls create. */
static imp_code run(scene_making *m, const place *at, scene_build_note *note, imp_error *error)
{
    if (m->again != NULL && run_renew(m, note)) return IMP_SUCCESS;
    instance_release(m->again);
    m->again = NULL;
    return run_create(m, at, note, error);
}

/* Bytes of the regular files that the values name: create reads them, and keeps about as much. */
static uint64_t bytes_of_files(const parameter_table *table, const parameter_values *values)
{
    uint64_t bytes = 0;
    for (size_t k = 0; k < values->count; ++k) {
        const imp_value *v = &values->value[k];
        struct stat file;
        if (!(parameter_table_row(table, k)->flags & IMP_PARAMETER_FILE) || v->count == 0) continue;
        if (stat(v->string[0], &file) == 0 && S_ISREG(file.st_mode))
            bytes += (uint64_t)file.st_size;
    }
    return bytes;
}

/* False: no memory. */
static bool keep_numbers(const type_view *view, const parameter_values *values, fixed_numbers *to)
{
    const parameter_table *t = &view->table;
    return fixed_numbers_copy(to, t->rows, t->count, t->stride, values->value);
}

/* Puts a stand-in in the place of the instance's type. False: no memory. */
static bool isolate(worker_pool *workers, imp_instance *i, isolated **stand_in)
{
    *stand_in =
        i->surface != NULL ? isolate_surface(workers, i->surface) : isolate_map(workers, i->map);
    if (*stand_in == NULL) return false;
    if (i->surface != NULL)
        i->surface = isolate_surface_type(*stand_in);
    else
        i->map = isolate_map_type(*stand_in);
    return true;
}

/* Isolates the type that *m has if the registry says so. */
static imp_code take_type(const imp_registry *registry, scene_making *m, imp_error *error)
{
    worker_pool *workers = registry_isolation(registry, m->view.name);
    if (workers != NULL && !isolate(workers, &m->instance, &m->stand_in))
        return error_set_memory(error);
    return IMP_SUCCESS;
}

/* False: there is no such type. */
static bool look_up(const imp_registry *registry, imp_type_kind kind, const char *name,
                    scene_making *m)
{
    imp_instance *i = &m->instance;
    if (kind == IMP_TYPE_SURFACE)
        i->surface = registry_find_surface(registry, name);
    else
        i->map = registry_find_map(registry, name);
    if (i->surface == NULL && i->map == NULL) return false;
    m->view = i->surface != NULL ? type_view_of_surface(i->surface) : type_view_of_map(i->map);
    return true;
}

static imp_code find_type(const imp_registry *registry, imp_type_kind kind, const json_t *object,
                          const place *at, scene_making *m, imp_error *error)
{
    const char *name = NULL;
    const imp_code code = read_type(object, kind, at, &name, error);
    if (code != IMP_SUCCESS) return code;
    const place where = at->argument ? *at : place_key(at, "type");
    if (!look_up(registry, kind, name, m)) return refuse_type(registry, kind, name, &where, error);
    return take_type(registry, m, error);
}

static bool allows(void *budget, uint64_t bytes) { return reading_budget_allows(budget, bytes); }

imp_code scene_making_begin(scene_making *m, const scene_source *source, imp_type_kind kind,
                            const json_t *object, const place *at, imp_error *error)
{
    *m = (scene_making){.source = source, .budget = source->budget};
    imp_code code = find_type(source->registry, kind, object, at, m, error);
    if (code != IMP_SUCCESS) return code;
    const array_file_limit limit = {.allows = allows, .context = m->budget};
    code = parameters_read(&m->view.table, m->view.name, object, source->folder, &limit, at,
                           &m->values, error);
    if (code == IMP_ERROR_LIMIT) code = reading_budget_refuse(m->budget, at, error);
    if (code != IMP_SUCCESS) isolate_destroy(m->stand_in);
    return code;
}

/* Takes the type that an instance has, or looks its name up. False: there is no such type. */
static bool choose(const imp_registry *registry, const type_choice *type, scene_making *m)
{
    const shared_instance *like = type->like;
    if (like == NULL || like->inner != NULL || registry_has_isolated(registry))
        return look_up(registry, type->kind, type->name, m);
    m->instance = (imp_instance){.surface = like->surface, .map = like->map};
    m->view =
        like->surface != NULL ? type_view_of_surface(like->surface) : type_view_of_map(like->map);
    return true;
}

imp_code scene_making_begin_numbers(scene_making *m, const scene_source *source,
                                    const type_choice *type, const imp_argument *arguments,
                                    size_t count, const place *at, imp_error *error)
{
    *m = (scene_making){.source = source, .budget = source->budget};
    if (!choose(source->registry, type, m)) return IMP_SUCCESS;
    imp_code code = parameter_numbers_read(&m->view.table, arguments, count,
                                           registry_store(source->registry), at, &m->values, error);
    if (code != IMP_SUCCESS || m->values.value == NULL) return code;
    code = take_type(source->registry, m, error);
    if (code != IMP_SUCCESS) parameters_clear(&m->values);
    return code;
}

imp_code scene_making_create(scene_making *m, const place *at, scene_build_note *note,
                             imp_error *error)
{
    imp_code code;
    const uint64_t of_files = bytes_of_files(&m->view.table, &m->values) + m->values.file_bytes;
    if (!reading_budget_allows(m->budget, of_files))
        code = reading_budget_refuse(m->budget, at, error);
    else if (note == NULL || !m->view.has_formula ||
             keep_numbers(&m->view, &m->values, &note->numbers))
        code = run(m, at, note, error);
    else
        code = error_set_memory(error);
    if (code != IMP_SUCCESS) m->instance.self = NULL;
    if (note != NULL) note->bytes += of_files;
    if (note != NULL && m->stand_in != NULL) note->bytes += isolate_bytes(m->stand_in);
    return code;
}

void scene_making_clear(scene_making *m)
{
    if (m->instance.self == NULL) isolate_destroy(m->stand_in);
    instance_release(m->again);
    parameters_clear(&m->values);
}

imp_code scene_build_instance(const scene_source *source, imp_type_kind kind, const json_t *object,
                              const place *at, imp_instance *instance, imp_error *error)
{
    scene_making m;
    imp_code code = scene_making_begin(&m, source, kind, object, at, error);
    if (code != IMP_SUCCESS) return code;
    code = scene_making_create(&m, at, NULL, error);
    if (code == IMP_SUCCESS) *instance = m.instance;
    scene_making_clear(&m);
    return code;
}
