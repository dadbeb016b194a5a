/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_HTML_H
#define TOOLS_VIEW_HTML_H

#include "tools/view/events.h"
#include "tools/view/film.h"
#include "tools/view/gap.h"
#include "tools/view/regions.h"

/* One self-contained page: tools/data/page.html with three.js and the film inserted. */

bool html_is_available(void);

/* Complains, with the cure, if three.js is missing. */
exit_status html_check(const char *path, const char *verb);

/* The contents of the page. */
typedef struct html_page {
    const film *film;
    const event_list *events;
    const char *title;
    const char *axis;    /* what moments are of (subject.h) */
    gap_profile gap;     /* in slices of time; none of them: it is not shown */
    gap_profile moments; /* at the film's frames; none: it is not shown */
    regions regions;     /* none: they are not shown */
    vec toward;          /* the view's direction */
} html_page;

/* Complains of files that cannot be read. */
exit_status html_write(const html_page *page, FILE *file, const char *verb);

#endif
