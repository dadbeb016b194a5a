/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_REQUEST_H
#define TOOLS_VIEW_REQUEST_H

#include "tools/cli/arguments.h"
#include "tools/view/visibility.h"

/* The options of `view`. */

typedef enum request_at {
    REQUEST_AT_ALL,  /* --at is not given */
    REQUEST_AT_TIME, /* that of `at` */
    REQUEST_AT_SPOT  /* of the contact, or the nearest approach */
} request_at;

typedef struct view_request {
    const char *verb, *output;
    const char *format;   /* ".png", ...: of --format, or the ending of the output; NULL: none */
    bool json;            /* print a JSON object about the file */
    double width, height; /* pixels */
    bool has_azimuth, has_elevation;
    direction from; /* degrees */
    double zoom;    /* 1: all of it */
    request_at at_kind;
    double at;        /* time */
    double tolerance; /* length; 0: chosen by the picture's size */
    size_t frames;    /* of animations */
} view_request;

extern const option request_options[];

/* Returns the ending of a file's name, after its last dot; NULL: it has none. */
const char *request_ending(const char *path);

/* Checks and complains. */
exit_status request_read(const arguments *args, view_request *request);

#endif
