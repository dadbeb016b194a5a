/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/plot_source.h"

#include <stdlib.h>
#include <string.h>

static void mark_contact(plot *p, const subject *what)
{
    p->marked = what->spot.is_contact && what->contact.is_known;
    p->mark = what->contact.t;
    snprintf(p->mark_label, sizeof p->mark_label, "contact, t = %.7g", p->mark);
}

static void mark_least(plot *p, const subject *what)
{
    const stage_spot *least = &what->spot;
    p->has_point = least->is_known && !least->is_contact;
    if (!p->has_point) return;
    p->point[0] = least->t, p->point[1] = least->upper;
    snprintf(p->point_label, sizeof p->point_label, "least %.4g at t = %.4g, %.60s and %.60s",
             least->upper, least->t, imp_scene_body_name(what->scene, least->body[0]),
             imp_scene_body_name(what->scene, least->body[1]));
}

bool plot_of_gap(plot *p, const gap_profile *gap, const subject *what, double required)
{
    *p = (plot){.x_label = "time t", .y_label = "distance"};
    snprintf(p->title, sizeof p->title, "Distance between bodies over time, %.100s", what->title);
    plot_series *s = plot_add(p, "proved to lie in", PLOT_BAND, gap->count);
    if (s == NULL) return false;
    memcpy(s->x, gap->t, (gap->count + 1) * sizeof *s->x);
    memcpy(s->y, gap->lower, gap->count * sizeof *s->y);
    memcpy(s->high, gap->upper, gap->count * sizeof *s->high);
    mark_contact(p, what);
    mark_least(p, what);
    p->has_level = required > 0;
    p->level = required;
    snprintf(p->level_label, sizeof p->level_label, "required %.6g", required);
    return true;
}

/* "oblique, S = 0.01" is the group "oblique" at S 0.01. */
typedef struct case_name {
    char group[32], quantity[32];
    double value;
} case_name;

static bool split_name(const char *text, case_name *n)
{
    const char *comma = strchr(text, ','), *last = text != NULL ? strrchr(text, ' ') : NULL;
    if (comma == NULL || last == NULL || last < comma + 2) return false;
    char *end;
    n->value = strtod(last + 1, &end);
    if (end == last + 1 || *end != '\0') return false;
    snprintf(n->group, sizeof n->group, "%.*s", (int)(comma - text), text);
    snprintf(n->quantity, sizeof n->quantity, "%.*s", (int)(last - comma - 2), comma + 2);
    n->quantity[strcspn(n->quantity, " =")] = '\0';
    return true;
}

static plot_series *series_named(plot *p, const char *name, size_t most)
{
    for (size_t k = 0; k < p->count; ++k)
        if (strcmp(p->series[k].name, name) == 0) return &p->series[k];
    plot_series *s = plot_add(p, name, PLOT_LINE, most);
    if (s != NULL) s->count = 0;
    return s;
}

/* Adds a case; cases whose names do not end with a number are placed side by side. */
static bool add_case(plot *p, const json_t *one, size_t index, size_t most)
{
    const char *text = json_string_value(json_object_get(one, "case"));
    const json_t *methods = json_object_get(one, "methods");
    case_name n = {.quantity = "case", .value = (double)index + 1};
    const bool named = text != NULL && strchr(text, ',') != NULL && split_name(text, &n);
    p->log_x = named;
    snprintf(p->x_label, sizeof p->x_label, "%s", n.quantity);
    for (size_t k = 0; k < json_array_size(methods); ++k) {
        const json_t *m = json_array_get(methods, k);
        const char *method = json_string_value(json_object_get(m, "method"));
        const json_t *pairs = json_object_get(json_object_get(m, "pairs"), "mean");
        char name[64];
        if (method == NULL || !json_is_number(pairs)) return false;
        snprintf(name, sizeof name, "%s%s%.24s", named ? n.group : "", named ? ", " : "", method);
        plot_series *s = series_named(p, name, most);
        if (s == NULL) continue;
        s->x[s->count] = n.value;
        s->y[s->count++] = json_number_value(pairs);
    }
    return json_array_size(methods) > 0;
}

exit_status plot_of_bench(plot *p, const json_t *set, const char *name, const char *verb)
{
    const char *title = json_string_value(json_object_get(set, "set"));
    const json_t *cases = json_object_get(set, "cases");
    const size_t count = json_array_size(cases);
    bool good = title != NULL && count > 0;
    *p = (plot){.y_label = "pairs of regions tested, mean", .log_y = true};
    snprintf(p->title, sizeof p->title, "impinge bench %.64s", good ? title : "");
    for (size_t k = 0; k < count && good; ++k)
        good = add_case(p, json_array_get(cases, k), k, count);
    if (good) return EXIT_ANSWERED;
    return complain(EXIT_DATA, verb, "%s: not what `impinge bench --json` prints", name);
}
