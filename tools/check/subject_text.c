/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>

#include "tools/check/subject.h"

/* Points, boxes and calls in words. */

static char letter(int n, int j) { return n == 3 ? "uvt"[j] : "xyzt"[j]; }

subject_text subject_point_text(int n, const double *p)
{
    subject_text t = {""};
    size_t used = 0;
    for (int j = 0; j < n && used < sizeof t.text; ++j)
        used += (size_t)snprintf(t.text + used, sizeof t.text - used, "%s%c=%.17g",
                                 j > 0 ? ", " : "", letter(n, j), p[j]);
    return t;
}

subject_text subject_box_text(int n, const double *lo, const double *hi)
{
    subject_text t = {""};
    size_t used = 0;
    for (int j = 0; j < n && used < sizeof t.text; ++j)
        used += (size_t)snprintf(t.text + used, sizeof t.text - used, "%s%c in [%.17g, %.17g]",
                                 j > 0 ? ", " : "", letter(n, j), lo[j], hi[j]);
    return t;
}

/* Returns words for what a call was about: a stage, a point, or a region. */
static subject_text matter_text(const check_call *call)
{
    subject_text t = {""};
    const int count = call->count;
    if (call->stage[0] != '\0')
        snprintf(t.text, sizeof t.text, " of '%s'", call->stage);
    else if (count == 3 || count == 4)
        snprintf(t.text, sizeof t.text, " at %.200s", subject_point_text(count, call->number).text);
    else if (count == 6 || count == 8)
        snprintf(t.text, sizeof t.text, " over %.200s",
                 subject_box_text(count / 2, call->number, call->number + count / 2).text);
    return t;
}

subject_text subject_call_text(const check_call *call)
{
    subject_text t = {""};
    if (call->name == NULL) return t;
    snprintf(t.text, sizeof t.text, "in %s%.220s%s%s", call->name, matter_text(call).text,
             call->hint != NULL ? ", " : "", call->hint != NULL ? call->hint : "");
    return t;
}

const char *subject_status_name(imp_status status)
{
    static const char *const names[] = {"ok", "domain", "unbounded", "parameter", "internal"};
    return status >= 0 && status <= 4 ? names[status] : "an unknown status";
}
