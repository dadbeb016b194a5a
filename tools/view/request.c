/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/request.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/output_operands.h"
#include "tools/cli/verbs.h"
#include "tools/view/at_values.h"

static const char *const formats[] = {"png", "svg", "glb", "html", "obj", "vtu", "pvd", NULL};
static const char *const endings[] = {".png", ".svg", ".glb", ".html", ".obj", ".vtu", ".pvd"};

const option request_options[] = {
    {.name = "output",
     .kind = OPTION_TEXT,
     .argument = "FILE",
     .help = "write here (also -o FILE; '-': standard output)"},
    {.name = "format",
     .kind = OPTION_CHOICE,
     .argument = "NAME",
     .choices = formats,
     .help = "of the output; else its extension selects it"},
    {.name = "width", .kind = OPTION_COUNT, .argument = "PX", .help = "of the picture (1200)"},
    {.name = "height", .kind = OPTION_COUNT, .argument = "PX", .help = "of the picture (960)"},
    {.name = "azimuth",
     .kind = OPTION_NUMBER,
     .argument = "DEGREES",
     .min = -360,
     .help = "look from here, from +x toward +y (the contact is seen)"},
    {.name = "elevation",
     .kind = OPTION_NUMBER,
     .argument = "DEGREES",
     .min = -90,
     .help = "and from this far above the xy plane"},
    {.name = "zoom",
     .kind = OPTION_NUMBER,
     .argument = "FACTOR",
     .min_open = true,
     .help = "magnify, about the contact if there is one (1)"},
    {.name = "at",
     .kind = OPTION_TEXT,
     .argument = "T",
     .help =
         "show this moment alone: a time, or 'nearest', where bodies touch or come nearest (start, "
         "that, and end); and values of parameters: NAME=VALUE,..."},
    {.name = "sweep",
     .kind = OPTION_TEXT,
     .argument = "NAME",
     .help = "let this parameter of the scene run over its range, in the place of time"},
    {.name = "tolerance",
     .kind = OPTION_NUMBER,
     .argument = "LENGTH",
     .min_open = true,
     .help = "draw surfaces at least this exactly (1/2000 of all there is)"},
    {.name = "frames",
     .kind = OPTION_COUNT,
     .argument = "N",
     .help = "of animations: moments in all (61)"},
    {.name = NULL}};

/* A count between `lo` and `hi`. */
static exit_status count_in(const arguments *args, const char *name, uint64_t otherwise,
                            uint64_t lo, uint64_t hi, uint64_t *count)
{
    const option_value *value = arguments_option(args, name);
    *count = arguments_count(args, name, otherwise);
    if (*count >= lo && *count <= hi) return EXIT_ANSWERED;
    return complain(EXIT_USAGE, args->verb->name, "--%s must be from %u to %u, not '%s'", name,
                    (unsigned)lo, (unsigned)hi, value->text);
}

const char *request_ending(const char *path)
{
    const char *slash = strrchr(path, '/');
    return strrchr(slash != NULL ? slash : path, '.');
}

/* Returns the format; NULL: --format is not given, and the name has no ending. */
static const char *format_asked(const arguments *args)
{
    const option_value *output = arguments_option(args, "output");
    const option_value *format = arguments_option(args, "format");
    if (format != NULL) return endings[format->choice];
    return output != NULL ? request_ending(output->text) : NULL;
}

/* A time, or a word for one. */
static exit_status read_at(const arguments *args, view_request *request)
{
    const option_value *value = arguments_option(args, "at");
    char *end, time[64];
    if (value == NULL) return EXIT_ANSWERED;
    const bool is_one = at_values_time(value->text, time, sizeof time);
    if (is_one && time[0] == '\0' && value->text[0] != '\0') return EXIT_ANSWERED;
    request->at = strtod(time, &end);
    request->at_kind = REQUEST_AT_TIME;
    if (is_one && end != time && *end == '\0' && isfinite(request->at)) return EXIT_ANSWERED;
    request->at_kind = REQUEST_AT_SPOT;
    if (is_one && (strcmp(time, "nearest") == 0 || strcmp(time, "contact") == 0))
        return EXIT_ANSWERED;
    return complain(EXIT_USAGE, args->verb->name,
                    "--at must be a finite number, or 'nearest', not '%s' (values of parameters, "
                    "NAME=VALUE, may stand beside it)",
                    value->text);
}

exit_status request_read(const arguments *args, view_request *request)
{
    const option_value *output = arguments_option(args, "output");
    uint64_t width, height, frames;
    exit_status status = count_in(args, "width", 1200, 64, 8192, &width);
    if (status == EXIT_ANSWERED) status = count_in(args, "height", 960, 64, 8192, &height);
    if (status == EXIT_ANSWERED) status = count_in(args, "frames", 61, 2, 2000, &frames);
    if (status == EXIT_ANSWERED) status = output_spares_operands(args, "output");
    if (status != EXIT_ANSWERED) return status;
    *request = (view_request){.verb = args->verb->name,
                              .output = output != NULL ? output->text : NULL,
                              .format = format_asked(args),
                              .json = arguments_option(args, "json") != NULL,
                              .width = (double)width,
                              .height = (double)height,
                              .zoom = arguments_number(args, "zoom", 1),
                              .tolerance = arguments_number(args, "tolerance", 0),
                              .frames = (size_t)frames};
    request->from.azimuth = arguments_number(args, "azimuth", -55);
    request->from.elevation = arguments_number(args, "elevation", 25);
    request->has_azimuth = arguments_option(args, "azimuth") != NULL;
    request->has_elevation = arguments_option(args, "elevation") != NULL;
    return read_at(args, request);
}
