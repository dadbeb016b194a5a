/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/common/spelling.h"
#include "core/plugin/json_describe.h"
#include "core/reader/json_keys.h"

#include <string.h>

static bool is_one_of(const char *const *keys, const char *key)
{
    while (*keys != NULL && strcmp(*keys, key) != 0) ++keys;
    return *keys != NULL;
}

static imp_code refuse_key(const char *const *keys, const place *at, const char *key,
                           imp_error *error)
{
    char all[120] = "";
    spelling_search search = {.wanted = key};
    for (; *keys != NULL; ++keys) {
        spelling_offer(&search, *keys);
        text_append(all, sizeof all, "%s%s", all[0] ? ", " : "", *keys);
    }
    place member = place_key(at, key);
    if (search.best != NULL)
        return place_error(&member, error, IMP_ERROR_SCENE,
                           "unknown key, did you mean '%s'? Valid keys are %s", search.best, all);
    return place_error(&member, error, IMP_ERROR_SCENE, "unknown key; valid keys are %s", all);
}

imp_code json_keys_check(json_t *object, const char *const *keys, const char *what, const place *at,
                         imp_error *error)
{
    if (!json_is_object(object))
        return place_error(at, error, IMP_ERROR_SCENE, "got %s, must be %s",
                           json_describe(object).at, what);
    const char *key;
    json_t *unused;
    json_object_foreach(object, key, unused)
    {
        if (!is_one_of(keys, key)) return refuse_key(keys, at, key, error);
    }
    return IMP_SUCCESS;
}

imp_code json_keys_refuse(const json_t *object, const char *const *keys, const place *at,
                          imp_error *error)
{
    for (; *keys != NULL; ++keys) {
        if (json_object_get(object, *keys) == NULL) continue;
        place member = place_key(at, *keys);
        return place_error(&member, error, IMP_ERROR_SCENE,
                           "%s needs `impinge simulate` first; pass its output here", *keys);
    }
    return IMP_SUCCESS;
}

imp_code json_keys_array(const json_t *object, const char *key, bool required, const place *at,
                         json_t **array, imp_error *error)
{
    *array = json_object_get(object, key);
    if (*array == NULL && !required) return IMP_SUCCESS;
    if (*array == NULL)
        return place_error(at, error, IMP_ERROR_SCENE, "\"%s\" is missing; it must be an array",
                           key);
    if (json_is_array(*array) && (!required || json_array_size(*array) > 0)) return IMP_SUCCESS;
    place member = place_key(at, key);
    return place_error(&member, error, IMP_ERROR_SCENE, "got %s, must be an array%s",
                       json_describe(*array).at, required ? " of at least 1" : "");
}
