/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_BATCH_SCENE_H
#define TOOLS_CLI_BATCH_SCENE_H

#include <jansson.h>

#include "tools/cli/arguments.h"
#include "tools/cli/input.h"

/* Scenes of a batch: which are ours, and what they are called. */

/* With --shard I/N a run answers scenes I, I + N, I + 2N, ... */
typedef struct batch_shard {
    size_t index, count; /* index from 0 */
} batch_shard;

/* From --shard, if it is given. Complains of what is wrong. */
exit_status batch_shard_read(const arguments *args, batch_shard *shard);

/* The "id" of a scene's line, or null, also where the line is no JSON. NULL: no memory. */
json_t *batch_line_id(const input_text *line);

/* Like batch_line_id, of a line that is known to be a scene, without reading it all again. */
json_t *batch_scene_id(const input_text *line);

#endif
