/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_SCENE_JSON_H
#define CORE_READER_SCENE_JSON_H

#include "core/reader/scene_bodies.h"

/* The bodies of a scene as JSON
 * =============================
 * Everything of the scene at `at` under "define", "bodies" and "ignore". Values of bodies are freed
 * as soon as they are read: the bodies of `root` are of no use after that. */
imp_code scene_json_read(scene_bodies *b, json_t *root, const place *at);

#endif
