/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_HTML_H
#define TOOLS_VIEW_HTML_H

#include "tools/view/events.h"
#include "tools/view/film.h"
#include "tools/view/gap.h"
#include "tools/view/regions.h"

/* One page that needs nothing else: tools/data/page.html with three.js and the film put in. */

bool html_is_available(void);

/* Complains, with the cure, where three.js is not. */
exit_status html_check(const char *path, const char *verb);

/* What the page shows. */
typedef struct html_page {
    const film *film;
    const event_list *events;
    const char *title;
    gap_profile gap;     /* in slices of time; none of them: it is not shown */
    gap_profile moments; /* at the film's frames; none: it is not shown */
    regions regions;     /* none: they are not shown */
    vec toward;          /* from where to look */
} html_page;

/* Complains of files that cannot be read. */
exit_status html_write(const html_page *page, FILE *file, const char *verb);

#endif
