/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/survey_boxes.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/sha256.h"
#include "core/common/system_error.h"
#include "tools/cli/output.h"
#include "tools/cli/output_operands.h"
#include "tools/cli/result.h"
#include "tools/cli/run_options.h"
#include "tools/cli/verbs.h"

/* --- Lines ------------------------------------------------------------------------------------ */

json_t *survey_ranges_json(const imp_scene *scene, const double *lo, const double *hi)
{
    imp_scene_parameter_info info;
    json_t *object = json_object();
    for (size_t k = 0; imp_scene_parameter(scene, k, &info); ++k)
        if (json_object_set_new(object, info.name, result_times_json(lo[k], hi[k])) != 0)
            return json_decref(object), NULL;
    return object;
}

json_t *survey_bodies_json(const imp_scene *scene, const size_t body[2])
{
    if (body[0] == SIZE_MAX) return json_null();
    return json_pack("[o,o]", output_json_text(imp_scene_body_name(scene, body[0])),
                     output_json_text(imp_scene_body_name(scene, body[1])));
}

static void write_line(survey_boxes *b, json_t *line)
{
    char *text = output_json_line(line);
    b->failed = b->failed || text == NULL;
    if (text != NULL) fprintf(b->out.file, "%s\n", text);
    free(text);
}

static void write_box(void *context, const imp_survey_box *box)
{
    survey_boxes *b = context;
    const bool is_clear = box->verdict == IMP_VERDICT_CLEAR;
    json_t *lower = is_clear ? output_json_number(box->lower) : json_null();
    write_line(b, json_pack("{s:o, s:o, s:o, s:s, s:o}", "parameters",
                            survey_ranges_json(b->scene, box->lo, box->hi), "time",
                            result_times_json(box->t_start, box->t_end), "lower", lower, "verdict",
                            result_verdict_name(box->verdict), "bodies",
                            survey_bodies_json(b->scene, box->body)));
}

/* Returns the hash of the scene's file, the texts of two surfaces, or null for standard input. */
static json_t *scene_json(const arguments *args)
{
    char hash[SHA256_TEXT], text[sizeof hash + 8];
    if (args->operand_count == 2)
        return json_pack("[o,o]", output_json_text(args->operands[0]),
                         output_json_text(args->operands[1]));
    if (!input_is_file(args->operands[0]) || !sha256_file(args->operands[0], hash))
        return json_null();
    snprintf(text, sizeof text, "sha256:%s", hash);
    return output_json_text(text);
}

/* The first line. NULL: no memory. */
static json_t *head_json(const arguments *args)
{
    json_t *head = run_options_json(args), *scene = scene_json(args);
    if (head != NULL && json_object_set_new(head, "scene", scene) == 0) return head;
    json_decref(head);
    return NULL;
}

/* --- Going on from a file --------------------------------------------------------------------- */

static exit_status refuse(const survey_boxes *b, const char *why)
{
    return complain(EXIT_DATA, b->args->verb->name, "%s: %s", b->path, why);
}

static exit_status judge_head(const survey_boxes *b, json_t *then, json_t *now)
{
    const run_options_source of = {b->path, "its first line"};
    json_t *scene = json_object_get(now, "scene"), *options = json_object_get(then, "options");
    if (now == NULL) return complain_of_memory(b->args->verb->name);
    if (!json_is_object(options) || json_object_get(then, "scene") == NULL)
        return refuse(b, "its first line is not that of a file of boxes; name one that --boxes or "
                         "--resume wrote, or a new file");
    if (!json_equal(scene, json_object_get(then, "scene")))
        return refuse(b, "its boxes are those of another scene, or the scene has changed since; "
                         "name a new file");
    return run_options_compare(&of, options, json_object_get(now, "options"), b->args);
}

/* Reads the first line, and compares it with that of this run. */
static exit_status read_head(survey_boxes *b, FILE *from)
{
    if (!input_read_line(from, b->path, b->args->verb->name, &b->line)) return EXIT_DATA;
    json_t *then = json_loadb(b->line.text, b->line.length, 0, NULL), *now = head_json(b->args);
    const exit_status status = judge_head(b, then, now);
    json_decref(then);
    json_decref(now);
    return status;
}

/* Reads the state from the last line, and counts the boxes between the first and the last. */
static exit_status read_state(survey_boxes *b, FILE *from, size_t *boxes)
{
    json_t *last = NULL;
    size_t lines = 0;
    for (;; ++lines) {
        if (!input_read_line(from, b->path, b->args->verb->name, &b->line))
            return json_decref(last), EXIT_DATA;
        if (b->line.length == 0) break;
        json_decref(last);
        last = json_loadb(b->line.text, b->line.length, 0, NULL);
    }
    json_t *state = json_object_get(last, "state");
    const size_t left = json_array_size(json_object_get(state, "waiting"));
    if (json_is_object(state)) b->state = json_dumps(state, JSON_COMPACT);
    json_decref(last);
    if (b->state == NULL || lines < 1 + left)
        return refuse(b, "its last line, which tells where the run stood, is missing: the file was "
                         "cut off; name a new file");
    *boxes = lines - 1 - left;
    return EXIT_ANSWERED;
}

/* Copies the boxes, but for those that are left, which are the last. */
static exit_status read_boxes(survey_boxes *b, FILE *from)
{
    size_t boxes = 0;
    exit_status status = read_head(b, from);
    if (status == EXIT_ANSWERED) status = read_state(b, from, &boxes);
    rewind(from);
    for (size_t k = 0; k <= boxes && status == EXIT_ANSWERED; ++k) {
        if (!input_read_line(from, b->path, b->args->verb->name, &b->line)) return EXIT_DATA;
        if (k > 0) fwrite(b->line.text, 1, b->line.length, b->out.file);
    }
    return status;
}

/* Reads the file that is there; one that is not there is begun. */
static exit_status go_on(survey_boxes *b)
{
    FILE *from = fopen(b->path, "re");
    if (from == NULL && errno == ENOENT) return EXIT_ANSWERED;
    if (from == NULL) return refuse(b, system_error_text(errno));
    const exit_status status = read_boxes(b, from);
    fclose(from);
    return status;
}

/* Refuses places that cannot be read again, and scenes that cannot be compared. */
static exit_status check_resume(const survey_boxes *b)
{
    const arguments *args = b->args;
    const output_target target = output_target_of(b->path);
    const bool is_file = target.kind == OUTPUT_FILE || target.kind == OUTPUT_NEW;
    free(target.path);
    if (!is_file && target.kind != OUTPUT_REFUSED) /* that is told when it is opened */
        return complain(EXIT_USAGE, args->verb->name,
                        "%s: --resume needs a file, which can be read and replaced", b->path);
    if (args->operand_count == 2 || input_is_file(args->operands[0])) return EXIT_ANSWERED;
    return complain(EXIT_USAGE, args->verb->name,
                    "--resume needs a scene in a file, which it can compare, not '%s'",
                    args->operands[0]);
}

/* --- The file --------------------------------------------------------------------------------- */

exit_status survey_boxes_begin(survey_boxes *b, const imp_scene *scene, imp_survey_options *how,
                               const arguments *args)
{
    const option_value *boxes = arguments_option(args, "boxes");
    const option_value *resume = arguments_option(args, "resume");
    *b = (survey_boxes){.scene = scene, .args = args};
    if (boxes != NULL && resume != NULL)
        return complain(EXIT_USAGE, args->verb->name,
                        "--resume FILE writes the boxes to FILE, too; give it without --boxes");
    if (boxes == NULL && resume == NULL) return EXIT_ANSWERED;
    b->path = boxes != NULL ? boxes->text : resume->text;
    exit_status status = output_spares_operands(args, boxes != NULL ? "boxes" : "resume");
    if (status == EXIT_ANSWERED && resume != NULL) status = check_resume(b);
    if (status == EXIT_ANSWERED) status = output_file_begin(&b->out, b->path, args->verb->name);
    if (status != EXIT_ANSWERED) return status;
    b->begun = true;
    write_line(b, head_json(args));
    if (resume != NULL) status = go_on(b);
    how->sink = write_box;
    how->sink_context = b;
    how->resume = b->state;
    return status;
}

static void write_state(survey_boxes *b, const imp_survey *survey)
{
    char *text = imp_survey_save(survey, NULL);
    b->failed = b->failed || text == NULL;
    if (text != NULL) fprintf(b->out.file, "{\"state\":%s}\n", text);
    free(text);
}

exit_status survey_boxes_end(survey_boxes *b, const imp_survey *survey, exit_status status)
{
    if (b->begun) {
        if (status == EXIT_ANSWERED) write_state(b, survey);
        const exit_status written = output_file_end(&b->out, status == EXIT_ANSWERED && !b->failed);
        if (status == EXIT_ANSWERED) status = written;
        if (b->failed && status == EXIT_ANSWERED) status = complain_of_memory(b->args->verb->name);
    }
    free(b->state);
    free(b->line.text);
    return status;
}
