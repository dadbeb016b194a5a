/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_BUILDER_INTERNAL_H
#define CORE_READER_BUILDER_INTERNAL_H

#include "core/reader/scene_bodies.h"

/* What builder.c and builder_stages.c share. */

struct imp_builder {
    const imp_registry *registry;
    scene_bodies bodies;
    bool finished;
};

/* Each call begins with this: errors go to `error`, and a builder that is done takes nothing more.
 */
imp_code builder_enter(imp_builder *b, imp_error *error);

imp_code builder_check_body(const imp_builder *b, size_t body, imp_error *error);

/* "body 'arm'", for errors. */
typedef struct body_words {
    char at[100];
} body_words;

body_words builder_body_words(const imp_builder *b, size_t body);

#endif
