/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "json_keys.h"
#include "json_words.h"
#include "text.h"

#include <string.h>

static bool is_one_of(const char *const *keys, const char *key)
{
    while (*keys && strcmp(*keys, key) != 0) ++keys;
    return *keys != NULL;
}

static imp_code refuse_key(const char *const *keys, const place *at, const char *key,
                           imp_error *error)
{
    char all[120] = "";
    imp_nearest search = {.wanted = key};
    for (; *keys; ++keys) {
        imp_nearest_offer(&search, *keys);
        text_append(all, sizeof all, "%s%s", all[0] ? ", " : "", *keys);
    }
    place member = place_key(at, key);
    if (search.best)
        return place_error(&member, error, IMP_ERROR_SCENE,
                           "found an unknown key, did you mean '%s'? Allowed are %s", search.best,
                           all);
    return place_error(&member, error, IMP_ERROR_SCENE, "found an unknown key, allowed are %s",
                       all);
}

imp_code json_keys_check(json_t *object, const char *const *keys, const char *what, const place *at,
                         imp_error *error)
{
    if (!json_is_object(object))
        return place_error(at, error, IMP_ERROR_SCENE, "found %s, allowed %s",
                           json_in_words(object).at, what);
    const char *key;
    json_t *unused;
    json_object_foreach(object, key, unused)
    {
        if (!is_one_of(keys, key)) return refuse_key(keys, at, key, error);
    }
    return IMP_SUCCESS;
}

imp_code json_keys_array(const json_t *object, const char *key, bool required, const place *at,
                         json_t **array, imp_error *error)
{
    *array = json_object_get(object, key);
    if (!*array && !required) return IMP_SUCCESS;
    if (!*array)
        return place_error(at, error, IMP_ERROR_SCENE, "\"%s\" is missing, allowed an array", key);
    if (json_is_array(*array) && (!required || json_array_size(*array) > 0)) return IMP_SUCCESS;
    place member = place_key(at, key);
    return place_error(&member, error, IMP_ERROR_SCENE, "found %s, allowed an array%s",
                       json_in_words(*array).at, required ? " of at least 1" : "");
}
