/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <string.h>

#include "tools/cli/verbs.h"
#include "tools/view/view.h"

static exit_status run(const arguments *args)
{
    view_request request;
    subject what;
    exit_status status = request_read(args, &request);
    if (status == EXIT_ANSWERED) status = view_check_output(&request);
    if (status != EXIT_ANSWERED) return status;
    status = subject_read(&what, args);
    if (status == EXIT_ANSWERED) status = view_write_and_tell(&what, &request);
    subject_free(&what);
    return status;
}

static const option *const tables[] = {request_options,  options_search, options_query,
                                       options_registry, options_always, NULL};

const verb verb_view = {
    .name = "view",
    .operands = "SCENE|RESULT or A B",
    .summary = "Draw a scene: picture, animation, page",
    .details =
        "Solves the scene and writes what --output names; its extension, or --format, says how:\n"
        "\n"
        "  .png   start, contact or nearest approach, end, and that from near, shaded\n"
        "  .svg   the same as lines\n"
        "  .glb   animation (glTF 2.0): rigid motions as tracks, deformations as morph targets\n"
        "  .html  a page for any browser: turn, play, distance over time, events of a simulation\n"
        "  .obj   triangles of one moment, as .vtu for VTK and its kin\n"
        "  .pvd   a .vtu beside it for each moment\n"
        "\n"
        "SCENE is a scene file ('-': standard input), RESULT what `solve --json` or `pair --json`\n"
        "printed, A and B are two surfaces as for `pair`. Lines on surfaces are of constant u and\n"
        "v; a dot marks the contact, an arrow its normal. Surfaces are drawn as triangles, made\n"
        "from their own Taylor models as fine as --tolerance asks; how far they are from the\n"
        "surfaces at most is printed.\n",
    .example = "impinge view 'torus ! rotate rate=2' \\\n"
               "                 'sphere center=3,0,0 ! translate velocity=-3,0,0' -o meet.svg",
    .operand_min = 1,
    .operand_max = 2,
    .options = tables,
    .run = run};
