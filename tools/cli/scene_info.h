/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SCENE_INFO_H
#define TOOLS_CLI_SCENE_INFO_H

#include "tools/cli/arguments.h"

/* Whether an operand of `info` names a scene: a file that ends in .json, or standard input. */
bool scene_info_is_asked(const char *operand);

/* Prints the bodies of a scene, and which of them are closed, as text or JSON. */
exit_status scene_info_print(imp_registry *registry, const arguments *args);

/* How many pieces the surfaces of a body have. */
size_t scene_info_pieces(const imp_scene *scene, size_t body);

#endif
