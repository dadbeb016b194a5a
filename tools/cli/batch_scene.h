/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_BATCH_SCENE_H
#define TOOLS_CLI_BATCH_SCENE_H

#include <jansson.h>

#include "tools/cli/arguments.h"
#include "tools/cli/input.h"

/* Scenes of a batch: shards and ids. */

/* With --shard I/N a run solves scenes I, I + N, I + 2N, ... */
typedef struct batch_shard {
    size_t index, count; /* index from 0 */
} batch_shard;

/* Reads --shard, if it is given. Complains. */
exit_status batch_shard_read(const arguments *args, batch_shard *shard);

/* Returns the "id" of a scene's line, or null, also if the line is no JSON. NULL: no memory. */
json_t *batch_line_id(const input_text *line);

/* Like batch_line_id, without parsing all of the line again. If it was read as a scene, no two of
 * its keys are equal, and what follows its id is not looked at. */
json_t *batch_scene_id(const input_text *line, bool was_read);

#endif
