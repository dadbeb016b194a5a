/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_REQUEST_H
#define TOOLS_VIEW_REQUEST_H

#include "tools/cli/arguments.h"
#include "tools/view/picture.h"

/* What the options of `view` ask for. */

typedef struct view_request {
    const char *verb, *output;
    const char *format; /* ".png", ...: of --format, or the ending of the output; NULL: none */
    double width, height; /* pixels */
    bool has_azimuth, has_elevation;
    direction from; /* degrees */
    double zoom;    /* 1: all of it */
    bool has_at;
    double at;        /* time */
    double tolerance; /* length; 0: as the size asks */
    size_t frames;    /* of animations */
    size_t body_count;
} view_request;

extern const option request_options[];

/* What a file's name ends with, from its last dot on; NULL: it has none. */
const char *request_ending(const char *path);

/* Checks and complains. */
exit_status request_read(const arguments *args, view_request *request);

#endif
