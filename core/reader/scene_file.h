/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_SCENE_FILE_H
#define CORE_READER_SCENE_FILE_H

#include <impinge/impinge.h>

/* The scene format
 * ================
 * Implements imp_scene_from_json, imp_scene_from_file, imp_scene_from_pair and imp_pair_to_json.
 * One JSON object:
 *
 *     "time"       [start, end]; start <= end. Preset [0, 1]
 *     "gamma"      tolerance, > 0, length. Preset 1e-6
 *     "gamma_clear" nothing nearer is missed; in [0, gamma). Preset: half of gamma
 *     "define"     lists of surfaces or of maps by name: scene_instances.h
 *     "bodies"     at least one:
 *         "name"       unique; default "body0", "body1", ... by position
 *         "surfaces"   at least one: "type", its parameters, and perhaps "maps" of its own; or the
 *                      name of a definition
 *         "maps"       of the whole body, after the surfaces' own, first to last; or definitions
 *         "parent"     name of a body whose maps, and then its parent's, come after these
 *         "group"      name, or names, that bodies have in common
 *     "ignore"     pairs of names, of bodies or groups, that are never tested with each other
 *     "id", "reference", "note"    annotations: of any kind, and not looked at here
 *
 * Any other key is an error: misspelt keys must not be overlooked. So are keys given twice.
 * Errors stand as "scene.json:12:7: ..." (syntax: line and column) or
 * "scene.json: /bodies/0/surfaces/2/radius: ..." (JSON pointer). */

#endif
