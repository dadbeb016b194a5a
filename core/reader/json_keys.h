/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_JSON_KEYS_H
#define CORE_READER_JSON_KEYS_H

#include <jansson.h>

#include "core/base/place.h"

/* Checks of the keys of objects of the scene format */

/* Checks that `object` is an object and has no key but those in the NULL-terminated list; the error
 * for another key names the nearest of them. `what` says what is allowed, for the error if it is no
 * object. */
imp_code json_keys_check(json_t *object, const char *const *keys, const char *what, const place *at,
                         imp_error *error);

/* Checks that none of the keys is there: they ask for a motion that only a simulation computes. */
imp_code json_keys_refuse(const json_t *object, const char *const *keys, const place *at,
                          imp_error *error);

/* Gets the array at `key` of an object at `at`. If it is required, it must be there and not empty;
 * otherwise *array may become NULL. */
imp_code json_keys_array(const json_t *object, const char *key, bool required, const place *at,
                         json_t **array, imp_error *error);

#endif
