/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/motion.h"
#include "tools/verify/statement_internal.h"
#include "tools/verify/turn.h"
#include "tools/verify/words.h"

#include <stdlib.h>
#include <string.h>

enum { STAGES_MAX = 64 };

static bool read_chain(statement *s, input *in, char **rest)
{
    size_t found[STAGES_MAX], count = 0;
    const size_t body = words_whole(in, rest, s->body_count);
    while (*rest != NULL && count < STAGES_MAX && !input_is_refused(in)) {
        found[count] = words_whole(in, rest, s->stage_count);
        if (!input_is_refused(in) && s->stages[found[count]].is_map != (count > 0))
            input_refuse(in, "a surface is no type and maps");
        ++count;
    }
    if (count == 0 || *rest != NULL) input_refuse(in, "a surface has no type, or too many maps");
    if (input_is_refused(in) || !WORDS_GROW(in, s->chains, s->chain_count, s->chain_room))
        return false;
    chain *made = &s->chains[s->chain_count++];
    *made = (chain){body, malloc(count * sizeof *made->stages), count};
    if (made->stages == NULL) return input_refuse(in, "memory ran out");
    memcpy(made->stages, found, count * sizeof *found);
    return true;
}

/* --- Lines ------------------------------------------------------------------------------------ */

static bool read_source(statement *s, input *in, const char *kind, char **rest)
{
    if (!WORDS_GROW(in, s->sources, s->source_count, s->source_room)) return false;
    source *made = &s->sources[s->source_count++];
    memset(made, 0, sizeof *made);
    words_copy(in, made->kind, sizeof made->kind, kind);
    if (strcmp(kind, "type") == 0)
        words_copy(in, made->type, sizeof made->type, words_take(in, rest));
    words_copy(in, made->hash, sizeof made->hash, words_take(in, rest));
    if (strcmp(kind, "scene") == 0) return !input_is_refused(in);
    if (*rest == NULL || (strcmp(kind, "type") == 0 && strchr(*rest, '/') != NULL))
        return input_refuse(in, "a type or a line 'file' names no file, or a type a folder");
    made->file = strdup(*rest);
    if (made->file == NULL) return input_refuse(in, "memory ran out");
    *rest = NULL;
    return !input_is_refused(in);
}

static void read_body(statement *s, input *in, const char *name)
{
    if (!WORDS_GROW(in, s->bodies, s->body_count, s->body_room)) return;
    s->bodies[s->body_count] = strdup(name);
    if (s->bodies[s->body_count] == NULL)
        input_refuse(in, "memory ran out");
    else
        s->body_count += 1;
}

static int compare_ignored(const void *x, const void *y)
{
    const size_t *a = x, *b = y;
    return a[0] != b[0] ? (a[0] < b[0] ? -1 : 1) : a[1] != b[1] ? (a[1] < b[1] ? -1 : 1) : 0;
}

static void read_ignored(statement *s, input *in, char **rest)
{
    if (!WORDS_GROW(in, s->ignored, s->ignored_count, s->ignored_room)) return;
    const size_t a = words_whole(in, rest, s->body_count), b = words_whole(in, rest, s->body_count);
    s->ignored[s->ignored_count][0] = a < b ? a : b;
    s->ignored[s->ignored_count++][1] = a < b ? b : a;
}

/* Parameters precede what has their numbers. */
static void read_parameter(statement *s, input *in, char **rest)
{
    if (!s->has_parameters || s->clock_count == CLOCKS_MAX || s->stage_count > 0 || s->has_points) {
        input_refuse(in, "a parameter is not expected here");
        return;
    }
    scene_clock *made = &s->clocks[s->clock_count];
    made->lo = words_number(in, rest);
    made->hi = words_number(in, rest);
    if (!(made->lo <= made->hi) || *rest == NULL) {
        input_refuse(in, "a parameter has no range, or no name");
        return;
    }
    made->name = strdup(*rest);
    if (made->name == NULL) input_refuse(in, "memory ran out");
    for (size_t k = 1; k < s->clock_count && made->name != NULL; ++k)
        if (strcmp(s->clocks[k].name, made->name) == 0)
            input_refuse(in, "two parameters are named '%.60s'", made->name);
    s->clock_count += made->name != NULL;
    *rest = NULL;
}

static void read_within(statement *s, input *in, char **rest)
{
    s->within = words_number(in, rest);
    if (strcmp(words_take(in, rest), "at") != 0) input_refuse(in, "expected 'at'");
    for (size_t k = 0; k < s->clock_count; ++k) s->clocks[k].at = words_number(in, rest);
    for (int k = 0; k < 2 && !input_is_refused(in); ++k) {
        char *line = input_line(in, STATEMENT_LINE_MAX), *more = line;
        if (line == NULL) return;
        if (strcmp(words_take(in, &more), "point") != 0) input_refuse(in, "expected 'point'");
        s->point[k].chain = words_whole(in, &more, STATEMENT_PIECES_MAX);
        s->point[k].piece = words_whole(in, &more, STATEMENT_PIECES_MAX);
        s->point[k].u = words_number(in, &more);
        s->point[k].v = words_number(in, &more);
        if (more != NULL) input_refuse(in, "a line 'point' is too long");
        free(line);
    }
    s->has_points = true;
}

enum { KEY_APART = 1, KEY_FROM = 2, KEY_TO = 4, KEYS_NEEDED = 7 };

/* The verdicts, and whether a claim with this verdict must name two points, or a distance above 0:
 * nothing is nearer than 0. */
static const struct {
    const char *word;
    bool has_points, has_distance;
} verdicts[] = {{"clear", false, true},     {"undecided", false, false}, {"holds", false, true},
                {"distance", false, false}, {"contact", true, false},    {"violated", true, false}};

static int compare_names(const void *x, const void *y)
{
    return strcmp(*(char *const *)x, *(char *const *)y);
}

/* Refuses two bodies of one name: their claims could not be told apart. */
static bool check_names(const statement *s, input *in)
{
    const char **sorted = malloc((s->body_count + 1) * sizeof *sorted);
    if (sorted == NULL) return input_refuse(in, "memory ran out");
    for (size_t k = 0; k < s->body_count; ++k) sorted[k] = s->bodies[k];
    qsort(sorted, s->body_count, sizeof *sorted, compare_names);
    for (size_t k = 1; k < s->body_count; ++k)
        if (strcmp(sorted[k - 1], sorted[k]) == 0)
            input_refuse(in, "two bodies are named '%.60s'", sorted[k]);
    free(sorted);
    return !input_is_refused(in);
}

static bool check_claim(const statement *s, input *in, unsigned keys)
{
    bool known = false;
    if (input_is_refused(in)) return false;
    for (size_t k = 0; k < sizeof verdicts / sizeof *verdicts; ++k)
        known = known || (strcmp(verdicts[k].word, s->verdict) == 0 &&
                          (s->has_points || !verdicts[k].has_points) &&
                          (s->apart > 0 || !verdicts[k].has_distance));
    if (keys != KEYS_NEEDED || !(s->apart >= 0) || !(s->clocks[0].lo <= s->clocks[0].hi))
        return input_refuse(in, "it says nothing of 'apart', 'from' and 'to'");
    if (!known) return input_refuse(in, "it has no verdict, or no points or distance for it");
    return check_names(s, in);
}

/* Reads a line; *done becomes true at the last. */
static void read_line(statement *s, input *in, char *line, unsigned *keys, bool *done)
{
    char *rest = line;
    const char *key = words_take(in, &rest);
    const bool is_text = strcmp(key, "program") == 0 || strcmp(key, "body") == 0;
    const bool is_number =
        strcmp(key, "apart") == 0 || strcmp(key, "from") == 0 || strcmp(key, "to") == 0;
    if (is_number) {
        const unsigned bit = key[0] == 'a' ? KEY_APART : key[0] == 'f' ? KEY_FROM : KEY_TO;
        double *to = bit == KEY_APART  ? &s->apart
                     : bit == KEY_FROM ? &s->clocks[0].lo
                                       : &s->clocks[0].hi;
        if (*keys & bit) input_refuse(in, "a second line '%s'", key);
        *keys |= bit;
        *to = words_number(in, &rest);
    } else if (strcmp(key, "trees") == 0)
        *done = true;
    else if (strcmp(key, "program") == 0)
        words_copy(in, s->program, sizeof s->program, rest != NULL ? rest : "");
    else if (strcmp(key, "verdict") == 0 && s->verdict[0] == '\0')
        words_copy(in, s->verdict, sizeof s->verdict, words_take(in, &rest));
    else if (strcmp(key, "scene") == 0 || strcmp(key, "type") == 0 || strcmp(key, "file") == 0)
        read_source(s, in, key, &rest);
    else if (strcmp(key, "parameter") == 0)
        read_parameter(s, in, &rest);
    else if (strcmp(key, "within") == 0 && !s->has_points)
        read_within(s, in, &rest);
    else if (strcmp(key, "shape") == 0 || strcmp(key, "map") == 0)
        statement_read_stage(s, in, key[0] == 'm', &rest);
    else if (strcmp(key, "body") == 0)
        read_body(s, in, rest != NULL ? rest : "");
    else if (strcmp(key, "surface") == 0)
        read_chain(s, in, &rest);
    else if (strcmp(key, "ignore") == 0)
        read_ignored(s, in, &rest);
    else
        input_refuse(in, "a line begins with '%.40s'", key);
    if (rest != NULL && !is_text) input_refuse(in, "a line '%.40s' is too long", key);
}

bool statement_read(statement *s, input *in)
{
    unsigned keys = 0;
    bool done = false;
    *s = (statement){.clock_count = 1};
    char *first = input_line(in, 80);
    s->has_parameters = first != NULL && strcmp(first, "impinge certificate 2") == 0;
    if (first != NULL && !s->has_parameters && strcmp(first, "impinge certificate 1") != 0)
        input_refuse(in, "it begins with no 'impinge certificate 1', or 2");
    free(first);
    while (!done && !input_is_refused(in)) {
        char *line = input_line(in, STATEMENT_LINE_MAX);
        if (line != NULL) read_line(s, in, line, &keys, &done);
        free(line);
    }
    if (s->ignored_count > 0)
        qsort(s->ignored, s->ignored_count, sizeof *s->ignored, compare_ignored);
    if (!check_claim(s, in, keys)) return false;
    motion_prepare(s);
    return true;
}

void statement_free(statement *s)
{
    for (size_t k = 0; k < s->stage_count; ++k) {
        stage *g = &s->stages[k];
        for (size_t i = 0; i < g->count; ++i) {
            for (size_t j = 0; j < g->pieces[i].count; ++j) {
                formula_free(g->pieces[i].parts[j].f);
                free(g->pieces[i].parts[j].net);
                free(g->pieces[i].parts[j].turn);
                circle_free(g->pieces[i].parts[j].circle);
            }
            free(g->pieces[i].parts);
        }
        free(g->pieces);
    }
    for (size_t k = 0; k < s->chain_count; ++k) free(s->chains[k].stages);
    for (size_t k = 0; k < s->body_count; ++k) free(s->bodies[k]);
    for (size_t k = 1; k < s->clock_count; ++k) free(s->clocks[k].name);
    for (size_t k = 0; k < s->source_count; ++k) free(s->sources[k].file);
    free(s->sources);
    free(s->stages);
    free(s->chains);
    free(s->bodies);
    free(s->ignored);
}

bool statement_ignores(const statement *s, size_t a, size_t b)
{
    const size_t pair[2] = {a < b ? a : b, a < b ? b : a};
    return a == b || (s->ignored_count > 0 && bsearch(pair, s->ignored, s->ignored_count,
                                                      sizeof *s->ignored, compare_ignored) != NULL);
}

bool statement_is_said(const statement *s, const chain *c)
{
    for (size_t k = 0; k < c->count; ++k) {
        const stage *g = &s->stages[c->stages[k]];
        for (size_t i = 0; i < g->count; ++i)
            if (g->pieces[i].count == 0) return false;
    }
    return true;
}
