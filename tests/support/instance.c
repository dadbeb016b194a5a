/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <ctype.h>
#include <string.h>

#include "tests/support/instance.h"
#include "tests/support/suite.h"

/* --- Templates -------------------------------------------------------------------------------- */

/* Length of what '@' repeats: an array with all inside it, or one character. */
static size_t item_length(const char *text)
{
    size_t length = 0;
    int depth = 0;
    do {
        depth += text[length] == '[' ? 1 : text[length] == ']' ? -1 : 0;
        ++length;
    } while (depth > 0 && text[length]);
    return length;
}

static void draw(FILE *out, const char *text, size_t length, uint64_t *random)
{
    const char *end = text + length;
    while (text < end) {
        if (*text == '@') {
            char *item;
            long copies = strtol(text + 1, &item, 10);
            size_t item_end = item_length(item);
            for (long k = 0; k < copies; ++k) {
                if (k > 0) fputc(',', out);
                draw(out, item, item_end, random);
            }
            text = item + item_end;
            continue;
        }
        bool positive = *text == '+' && !(text[1] && isdigit((unsigned char)text[1]));
        if (*text == '?')
            fprintf(out, "%.17g", random_between(random, -1, 1));
        else if (positive)
            fprintf(out, "%.17g", random_power(random, -2, 2));
        else
            fputc(*text, out);
        ++text;
    }
}

char *template_draw(const char *template, uint64_t *random)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    ck_assert_ptr_nonnull(out);
    draw(out, template, strlen(template), random);
    fclose(out);
    return text;
}

/* --- Instances -------------------------------------------------------------------------------- */

static void find(instance *made, const imp_registry *registry, const char *type)
{
    made->surface = registry_find_surface(registry, type);
    made->map = registry_find_map(registry, type);
    ck_assert_msg(made->surface != NULL || made->map != NULL, "%s is not built", type);
    made->view =
        made->surface != NULL ? type_view_of_surface(made->surface) : type_view_of_map(made->map);
}

instance instance_make(const imp_registry *registry, const char *type, const char *template,
                       uint64_t *random)
{
    instance made = {.text = template_draw(template, random)};
    imp_error error = {.text = ""};
    imp_create_error why = {.struct_size = sizeof why, .parameter = -1, .element = -1};
    place at = place_document(type);
    find(&made, registry, type);
    made.json = json_loads(made.text, PARAMETERS_JSON_FLAGS, NULL);
    ck_assert_msg(made.json != NULL, "%s: not JSON: %s", type, made.text);
    imp_code code =
        parameters_read(&made.view.table, type, made.json, NULL, NULL, &at, &made.values, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s %s: %s", type, made.text, error.text);
    imp_status status = made.view.create(made.values.value, &made.self, &why);
    ck_assert_msg(status == IMP_STATUS_OK, "%s %s: %s", type, made.text, why.text);
    made.arguments = (type_arguments){made.view.table, made.values.value};
    return made;
}

void instance_free(instance *made)
{
    made->view.destroy(made->self);
    parameters_clear(&made->values);
    json_decref(made->json);
    free(made->text);
}
