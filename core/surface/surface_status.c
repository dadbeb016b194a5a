/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>

#include "core/base/active_callback.h"
#include "core/base/text.h"
#include "core/surface/surface_internal.h"

/* What the statuses of callbacks mean, in words and as codes. */

const char *surface_status_text(imp_status status)
{
    switch (status) {
    case IMP_STATUS_DOMAIN:
        return "is undefined there, or too large for a double, though that lies in its domain; "
               "shrink the domain, or the times asked for, to where it (and each map on it) is "
               "defined";
    case IMP_STATUS_UNBOUNDED:
        return "has no bounds there";
    case IMP_STATUS_INTERNAL:
        return "reports an internal error";
    case SURFACE_CHANGED_MODE:
        return "changes the floating-point mode of its caller, which breaks every bound";
    case SURFACE_BAD_DOMAIN:
        return "has a domain that is empty, NaN, or infinite in u or v";
    case SURFACE_PIECE_COUNT:
        return "gives a piece_count that is 0 or above IMP_PIECES_MAX; it must be at least 1";
    case SURFACE_NULL_PIECE:
        return "gives NULL for one of its pieces; each must be an instance that it owns";
    case SURFACE_PIECE_TIMES:
        return "has pieces whose domains differ in time; give all of them the same times";
    case SURFACE_BAD_RATES:
        return "a rate is negative, infinite or NaN";
    case SURFACE_BAD_MODEL:
        return "a remainder is negative or NaN, a range inverted or NaN, or a rate negative or NaN";
    case SURFACE_BAD_NET:
        return "a control net has too many points, a number that is infinite or NaN, a negative "
               "error, or a weight that is not positive";
    case SURFACE_BAD_POSE:
        return "a pose depends on more than time, or has a number that is infinite or NaN, a "
               "negative "
               "remainder or rate, or an inverted range";
    case SURFACE_BAD_DISTANCE:
        return "a distance from it has a remainder that is negative or NaN, or a range that is "
               "inverted, NaN or at infinity";
    case SURFACE_BAD_SYMMETRY:
        return "its symmetry has an unknown kind, a center or an axis that is not finite, or an "
               "axis without length";
    case SURFACE_NOT_CLOSED:
        return "its symmetry is said to be closed about a line, but it has no point where a "
               "rotation takes another one; impinge check --only symmetry tells more";
    case SURFACE_BAD_FORMULA:
        return "printed a formula that is empty, or has other than printable characters";
    case SURFACE_BAD_TUBE:
        return "the line in the middle of its tube depends on v, or has a number that is infinite "
               "or NaN, a negative remainder or rate, or an inverted range, or the radius is "
               "negative, infinite or NaN";
    case SURFACE_BAD_SPAN:
        return "the span of its times is empty or NaN";
    case SURFACE_CRASHED:
        return "crashes or ends its process, in which it runs isolated";
    case SURFACE_HUNG:
        return "does not answer within 5 s; it ran isolated, and its process was ended";
    case SURFACE_LATE:
        return "had not answered when max_seconds was over; it ran isolated, and its process was "
               "ended; allow more (0: no limit)";
    case SURFACE_KILLED:
        return "ran isolated, and its process was killed or stopped from outside, as by the "
               "out-of-memory killer";
    case SURFACE_LOST:
        return "ran isolated in a process that another instance of the same type brought down";
    case SURFACE_FORKED:
        return "is isolated in a process that belongs to another process; a copy made by fork "
               "cannot use it: build the registry and the scene there";
    case SURFACE_NO_MEMORY:
        return "no memory for its formula";
    case SURFACE_NO_PROCESS:
        return "cannot be isolated: no process could be made";
    default:
        return "returned an unknown status";
    }
}

/* Whether the text of the status does not say which callback returned it. */
static bool is_of_any_callback(imp_status status)
{
    return status == SURFACE_CRASHED || status == SURFACE_HUNG || status == SURFACE_LATE ||
           status == SURFACE_CHANGED_MODE;
}

static surface_message message_of_last(imp_status status, bool named)
{
    surface_message message;
    const char *callback, *type = active_callback_last(&callback);
    snprintf(message.text, sizeof message.text, "%s", surface_status_text(status));
    if (type != NULL && (named || is_of_any_callback(status)))
        text_append(message.text, sizeof message.text, " (%s of '%s')", callback, type);
    return message;
}

surface_message surface_status_of_last(imp_status status) { return message_of_last(status, false); }

surface_message surface_status_message(const surface *s, imp_status status)
{
    return message_of_last(status, s->map_count > 0);
}

imp_code surface_set_code(imp_status status, imp_error *error)
{
    const imp_code code = status == SURFACE_FORKED       ? IMP_ERROR_USAGE
                          : status == SURFACE_NO_PROCESS ? IMP_ERROR_MEMORY
                          : status == SURFACE_NO_MEMORY  ? IMP_ERROR_MEMORY
                          : status == SURFACE_LATE       ? IMP_ERROR_LIMIT
                                                         : IMP_ERROR_PLUGIN;
    if (error != NULL) error->code = code;
    return code;
}
