/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/parallel.h"

#include "core/base/active_callback.h"
#include "core/base/fp_mode.h"

typedef struct parallel_call {
    void (*work)(void *of, size_t index);
    void *of;
    double until; /* by when callbacks must answer */
} parallel_call;

FP_APART static void call(const parallel_call *c, size_t index) { c->work(c->of, index); }

static void call_in_environment(void *of, size_t index)
{
    const parallel_call *c = of;
    const fp_environment environment = fp_environment_enter();
    const double before = active_callback_limit(c->until);
    call(c, index);
    active_callback_limit(before);
    fp_environment_leave(&environment);
}

void parallel_run(const imp_options *options, void (*work)(void *of, size_t index), void *of,
                  size_t count)
{
    parallel_call c = {work, of, active_callback_own()->until};
    options->parallel(options->parallel_context, call_in_environment, &c, count);
}
