/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/output.h"
#include "tools/cli/result.h"

const char *result_verdict_name(imp_verdict verdict)
{
    switch (verdict) {
    case IMP_VERDICT_CLEAR:
        return "clear";
    case IMP_VERDICT_CONTACT:
        return "contact";
    case IMP_VERDICT_UNDECIDED:
        return "undecided";
    }
    return "undecided";
}

const char *result_kind_name(imp_contact_kind kind)
{
    return kind == IMP_CONTACT_INSIDE ? "inside" : "touch";
}

json_t *result_reason_json(imp_reason reason)
{
    switch (reason) {
    case IMP_REASON_NONE:
        return json_null();
    case IMP_REASON_NO_TIME:
        return json_string("no-time");
    case IMP_REASON_NO_PAIRS:
        return json_string("no-pairs");
    case IMP_REASON_PAIRS:
        return json_string("max-pairs");
    case IMP_REASON_SECONDS:
        return json_string("max-seconds");
    case IMP_REASON_MEMORY:
        return json_string("max-bytes");
    case IMP_REASON_RUNNING:
    case IMP_REASON_CANCELLED:
        return json_string("cancelled");
    case IMP_REASON_RESOLUTION:
        return json_string("resolution");
    case IMP_REASON_DECIDED:
        return json_string("decided");
    }
    return json_null();
}

json_t *result_vector_json(const double v[3])
{
    return json_pack("[o,o,o]", output_json_number(v[0]), output_json_number(v[1]),
                     output_json_number(v[2]));
}

json_t *result_times_json(double from, double to)
{
    if (!(from <= to)) return json_null();
    return json_pack("[o,o]", output_json_number(from), output_json_number(to));
}

json_t *result_side_json(const imp_scene *scene, const imp_side *side)
{
    const bool pieces = imp_scene_piece_count(scene, side->body, side->surface) > 1;
    const bool on_surface = result_is_on_surface(side);
    return json_pack("{s:o, s:o, s:o*, s:o, s:o, s:o}", "body",
                     output_json_text(imp_scene_body_name(scene, side->body)), "surface",
                     on_surface ? json_integer((json_int_t)side->surface) : json_null(), "piece",
                     pieces && on_surface ? json_integer((json_int_t)side->piece) : NULL, "u",
                     output_json_number(side->u), "v", output_json_number(side->v), "point",
                     result_vector_json(side->point));
}

json_t *result_stats_json(const imp_stats *stats)
{
    return json_pack("{s:o, s:I, s:I, s:I, s:I, s:I}", "seconds",
                     output_json_number(stats->seconds), "pairs", (json_int_t)stats->pairs, "nodes",
                     (json_int_t)stats->nodes, "peak_heap", (json_int_t)stats->peak_heap,
                     "witness_searches", (json_int_t)stats->witness_searches, "bytes",
                     (json_int_t)stats->bytes);
}

static json_t *remark_json(const imp_scene *scene, const imp_remark *r)
{
    return json_pack("{s:o, s:I, s:o*, s:s, s:I, s:o}", "body",
                     output_json_text(imp_scene_body_name(scene, r->body)), "surface",
                     (json_int_t)r->surface, "map",
                     r->map != SIZE_MAX ? json_integer((json_int_t)r->map) : NULL, "type", r->type,
                     "count", (json_int_t)r->count, "text", output_json_text(r->text));
}

bool result_set_advice(json_t *object, const char *advice)
{
    return advice == NULL || json_object_set_new(object, "advice", output_json_text(advice)) == 0;
}

/* Adds a warning of each parameter that nothing follows. False: no memory. */
static bool add_idle_parameters(json_t *list, const imp_scene *scene)
{
    imp_scene_parameter_info info;
    bool kept = true;
    for (size_t k = 0; kept && imp_scene_parameter(scene, k, &info); ++k)
        if (!info.is_followed)
            kept = json_array_append_new(
                       list, json_pack("{s:o, s:s}", "parameter", output_json_text(info.name),
                                       "text", "no surface or map has it as its clock")) == 0;
    return kept;
}

bool result_set_warnings(json_t *object, const imp_scene *scene)
{
    imp_remark r = {.struct_size = (uint32_t)sizeof r};
    json_t *list = json_array();
    bool kept = list != NULL;
    for (size_t k = 0; kept && imp_scene_remark(scene, k, &r); ++k)
        kept = json_array_append_new(list, remark_json(scene, &r)) == 0;
    kept = kept && add_idle_parameters(list, scene);
    if (kept && json_array_size(list) > 0)
        return json_object_set_new(object, "warnings", list) == 0;
    json_decref(list);
    return kept;
}

/* If a part is NULL, json_pack with "o" fails and frees the other parts. */
json_t *result_json(const imp_scene *scene, const imp_result *r)
{
    const bool contact = r->verdict == IMP_VERDICT_CONTACT;
    return json_pack(
        "{s:s, s:s*, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "verdict",
        result_verdict_name(r->verdict), "kind", contact ? result_kind_name(r->kind) : NULL,
        "reason", result_reason_json(r->reason), "time", result_times_json(r->t_start, r->t_end),
        "t", contact ? output_json_number(r->t) : json_null(), "t_lower",
        output_json_number(r->t_lower), "t_examined",
        result_times_json(r->t_examined[0], r->t_examined[1]), "gap",
        contact ? output_json_number(r->gap) : json_null(), "gamma", output_json_number(r->gamma),
        "gamma_clear", output_json_number(r->gamma_clear), "a",
        contact ? result_side_json(scene, &r->a) : json_null(), "b",
        contact ? result_side_json(scene, &r->b) : json_null(), "normal",
        contact && r->has_normal ? result_vector_json(r->normal) : json_null(), "stats",
        result_stats_json(&r->stats));
}
