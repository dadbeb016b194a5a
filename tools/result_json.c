/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "output.h"
#include "result.h"

const char *result_verdict_name(imp_verdict verdict)
{
    switch (verdict) {
    case IMP_CLEAR:
        return "clear";
    case IMP_CONTACT:
        return "contact";
    case IMP_UNDECIDED:
        return "undecided";
    }
    return "undecided";
}

static json_t *reason_json(imp_reason reason)
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
    }
    return json_null();
}

static json_t *vector_json(const double v[3])
{
    return json_pack("[o,o,o]", output_json_number(v[0]), output_json_number(v[1]),
                     output_json_number(v[2]));
}

static json_t *side_json(const imp_scene *scene, const imp_side *side)
{
    return json_pack("{s:o, s:I, s:o, s:o, s:o}", "body",
                     output_json_text(imp_scene_body_name(scene, side->body)), "surface",
                     (json_int_t)side->surface, "u", output_json_number(side->u), "v",
                     output_json_number(side->v), "point", vector_json(side->point));
}

static json_t *stats_json(const imp_stats *stats)
{
    return json_pack("{s:o, s:I, s:I, s:I, s:I, s:I}", "seconds",
                     output_json_number(stats->seconds), "pairs", (json_int_t)stats->pairs, "nodes",
                     (json_int_t)stats->nodes, "peak_heap", (json_int_t)stats->peak_heap,
                     "witness_searches", (json_int_t)stats->witness_searches, "bytes",
                     (json_int_t)stats->bytes);
}

/* json_pack with "o" takes NULL for an error and frees the rest. */
json_t *result_json(const imp_scene *scene, const imp_result *r)
{
    const bool contact = r->verdict == IMP_CONTACT;
    json_t *object = json_pack("{s:s, s:o}", "verdict", result_verdict_name(r->verdict), "reason",
                               reason_json(r->reason));
    if (object == NULL) return NULL;
    int failed = contact ? json_object_set_new(object, "t", output_json_number(r->t)) : 0;
    json_t *rest = json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "t_lower", output_json_number(r->t_lower),
        "gap", contact ? output_json_number(r->gap) : json_null(), "gamma",
        output_json_number(r->gamma), "gamma_clear", output_json_number(r->gamma_clear), "a",
        contact ? side_json(scene, &r->a) : json_null(), "b",
        contact ? side_json(scene, &r->b) : json_null(), "normal",
        contact && r->has_normal ? vector_json(r->normal) : json_null(), "stats",
        stats_json(&r->stats));
    failed |= rest == NULL || json_object_update(object, rest) != 0;
    json_decref(rest);
    if (!failed) return object;
    json_decref(object);
    return NULL;
}
