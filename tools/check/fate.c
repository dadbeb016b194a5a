/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/fate.h"

#include <stdio.h>
#include <string.h>

fate_text fate_text_of(child_fate fate, double seconds)
{
    fate_text t = {"done"};
    switch (fate.end) {
    case CHILD_DONE:
        break;
    case CHILD_KILLED:
        snprintf(t.text, sizeof t.text, "crashed (%s)", strsignal(fate.number));
        break;
    case CHILD_EXITED:
        snprintf(t.text, sizeof t.text, "ended the process (exit status %d)", fate.number);
        break;
    case CHILD_LATE:
        snprintf(t.text, sizeof t.text, "timed out after %g s", seconds);
        break;
    case CHILD_STOPPED:
        snprintf(t.text, sizeof t.text, "was stopped by signal %d (%s)", fate.number,
                 strsignal(fate.number));
        break;
    case CHILD_NOT_RUN:
        snprintf(t.text, sizeof t.text, "could not be run in a child process: %s",
                 strerror(fate.number));
        break;
    }
    return t;
}
