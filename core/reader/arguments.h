/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_ARGUMENTS_H
#define CORE_READER_ARGUMENTS_H

#include <impinge/impinge.h>
#include <jansson.h>

#include "core/base/place.h"

/* Makes of typed values the object {"type": type, parameters} that a scene file would have, with
 * the same doubles and without text. Whether they fit the type is judged later, as for a file. The
 * caller owns *object. */
imp_code arguments_to_json(const char *type, const imp_argument *arguments, size_t count,
                           const place *at, json_t **object, imp_error *error);

#endif
