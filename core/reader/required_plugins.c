/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/required_plugins.h"

#include <ctype.h>
#include <string.h>

#include "core/common/spelling.h"

/* --- Versions --------------------------------------------------------------------------------- */

/* Compares the numbers that two texts begin with, of any length, and steps over both. */
static int compare_numbers(const char **x, const char **y)
{
    while (**x == '0') ++*x;
    while (**y == '0') ++*y;
    const size_t m = strspn(*x, "0123456789"), n = strspn(*y, "0123456789");
    const int order = m != n ? (m < n ? -1 : 1) : strncmp(*x, *y, m);
    *x += m;
    *y += n;
    return order;
}

static bool is_numeral(char c) { return isdigit((unsigned char)c) != 0; }

int required_plugins_compare(const char *x, const char *y)
{
    while (is_numeral(*x) || is_numeral(*y)) {
        const int order = compare_numbers(&x, &y);
        if (order != 0) return order;
        if (*x == '.' && is_numeral(x[1])) ++x;
        if (*y == '.' && is_numeral(y[1])) ++y;
    }
    if ((*x == '\0') != (*y == '\0')) return *x == '\0' ? 1 : -1;
    return strcmp(x, y);
}

/* --- Comparisons ------------------------------------------------------------------------------ */

typedef struct comparison {
    int op;           /* index in `ops` */
    char version[64]; /* cut where it is longer */
} comparison;

static const char *const ops[] = {">=", "<=", "==", ">", "<"};
enum { OPS = sizeof ops / sizeof *ops };

/* Reads one comparison and steps over it and the comma behind it. False: it is none. */
static bool read_comparison(const char **text, comparison *c)
{
    const char *p = *text + strspn(*text, " ");
    c->op = -1;
    for (int k = 0; k < OPS && c->op < 0; ++k)
        if (strncmp(p, ops[k], strlen(ops[k])) == 0) c->op = k;
    if (c->op < 0) return false;
    p += strlen(ops[c->op]);
    p += strspn(p, " ");
    const size_t length = strcspn(p, " ,");
    if (length == 0 || length >= sizeof c->version || !is_numeral(*p)) return false;
    memcpy(c->version, p, length);
    c->version[length] = '\0';
    p += length;
    p += strspn(p, " ");
    if (*p != '\0' && (*p != ',' || p[1] == '\0')) return false;
    *text = *p == ',' ? p + 1 : p;
    return true;
}

static bool holds(const comparison *c, const char *version)
{
    const int order = required_plugins_compare(version, c->version);
    switch (c->op) {
    case 0:
        return order >= 0;
    case 1:
        return order <= 0;
    case 2:
        return order == 0;
    case 3:
        return order > 0;
    default:
        return order < 0;
    }
}

/* --- Plugins ---------------------------------------------------------------------------------- */

/* Finds a type in force of the plugin of that name; `near` is offered all names. */
static bool find_plugin(const imp_registry *registry, const char *name, imp_type_info *found,
                        spelling_search *near)
{
    for (size_t k = 0; imp_registry_type(registry, k, found); ++k) {
        if (found->shadowed_by != NULL) continue;
        if (strcmp(found->plugin, name) == 0) return true;
        spelling_offer(near, found->plugin);
    }
    return false;
}

static imp_code check_one(const imp_registry *registry, const char *name, const char *wanted,
                          const place *at, imp_error *error)
{
    imp_type_info found;
    spelling_search near = {.wanted = name};
    if (!find_plugin(registry, name, &found, &near))
        return place_error(at, error, IMP_ERROR_SCENE,
                           "found no plugin of this name with a type in force%s%s%s; `impinge list "
                           "--json` names those there are",
                           near.best != NULL ? ", did you mean '" : "",
                           near.best != NULL ? near.best : "", near.best != NULL ? "'?" : "");
    for (const char *text = wanted; *text != '\0';) {
        comparison c;
        if (!read_comparison(&text, &c))
            return place_error(at, error, IMP_ERROR_SCENE,
                               "got \"%.80s\", must be comparisons with >=, >, ==, < or <= and a "
                               "version, with commas between, as in \">= 0.2, < 1\"",
                               wanted);
        if (!holds(&c, found.version))
            return place_error(at, error, IMP_ERROR_SCENE,
                               "found version %s in %s, must be %s %s; install such a version, or "
                               "name its folder by --plugin-path",
                               found.version, found.file, ops[c.op], c.version);
    }
    return IMP_SUCCESS;
}

imp_code required_plugins_check(const imp_registry *registry, const json_t *root, const place *at,
                                imp_error *error)
{
    const place all = place_key(at, "plugins");
    json_t *plugins = json_object_get(root, "plugins"), *wanted;
    const char *name;
    if (plugins == NULL) return IMP_SUCCESS;
    if (!json_is_object(plugins))
        return place_error(&all, error, IMP_ERROR_SCENE,
                           "must be an object of plugins' names and versions, {\"gear\": \">= "
                           "0.2\"}");
    json_object_foreach(plugins, name, wanted)
    {
        const place one = place_key(&all, name);
        const char *text = json_string_value(wanted);
        if (text == NULL || *text == '\0')
            return place_error(&one, error, IMP_ERROR_SCENE, "must be a text such as \">= 0.2\"");
        const imp_code code = check_one(registry, name, text, &one, error);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}
