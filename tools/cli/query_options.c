/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/query.h"

#include <impinge/baseline.h>
#include <math.h>
#include <sched.h>

#include "tools/cli/interrupt.h"
#include "tools/cli/progress.h"
#include "tools/cli/verbs.h"

/* Methods, in the order of the choices of --method. */
enum { METHOD_MODELS, METHOD_PAPER };

exit_status query_check(const arguments *args)
{
    const option_value *gamma = arguments_option(args, "gamma");
    const option_value *clear = arguments_option(args, "gamma-clear");
    const option_value *method = arguments_option(args, "method");
    const char *const paper_only[] = {"bounds", "rates"};
    if (gamma != NULL && clear != NULL && clear->number[0] >= gamma->number[0])
        return complain(EXIT_USAGE, args->verb->name,
                        "--gamma-clear %s must be less than --gamma %s", clear->text, gamma->text);
    if (arguments_option(args, "explain") != NULL && method != NULL &&
        method->choice == METHOD_PAPER)
        return complain(EXIT_USAGE, args->verb->name, "--explain belongs to --method models");
    for (int i = 0; i < 2; ++i)
        if (arguments_option(args, paper_only[i]) != NULL &&
            (method == NULL || method->choice != METHOD_PAPER))
            return complain(EXIT_USAGE, args->verb->name, "--%s belongs to --method paper",
                            paper_only[i]);
    return EXIT_ANSWERED;
}

/* Returns imp_options.baseline from --method, --bounds and --rates. */
static uint32_t baseline_of(const arguments *args)
{
    const uint32_t volumes[] = {IMP_BASELINE_BOXES, IMP_BASELINE_SPHERES},
                   rates[] = {0, IMP_BASELINE_COLUMN_RATES, IMP_BASELINE_CONSTANT_RATES};
    if (arguments_choice(args, "method", 0) != METHOD_PAPER) return IMP_BASELINE_NONE;
    return volumes[arguments_choice(args, "bounds", 0)] | rates[arguments_choice(args, "rates", 0)];
}

static bool goes_on(void *context, const imp_progress *p)
{
    (void)context;
    progress_search(p);
    return !interrupt_came();
}

/* Returns the rest of the time limit after reading; never 0, which would mean no limit. */
static double seconds_left(double limit)
{
    if (!(limit > 0)) return limit;
    const double left = limit - progress_seconds();
    return left > 0 ? left : 0x1p-1000;
}

imp_options query_options(const imp_scene *scene, const arguments *args)
{
    imp_options o = imp_options_default(scene);
    const option_value *time = arguments_option(args, "time");
    if (time != NULL) o.t_start = time->number[0], o.t_end = time->number[1];
    o.gamma = arguments_number(args, "gamma", o.gamma);
    o.gamma_clear = arguments_number(args, "gamma-clear", o.gamma_clear);
    o.max_pairs = arguments_count(args, "max-pairs", args->verb->max_pairs);
    o.max_seconds = seconds_left(arguments_number(args, "max-seconds", o.max_seconds));
    o.max_bytes = arguments_count(args, "max-bytes", o.max_bytes);
    o.baseline = baseline_of(args);
    o.audit = arguments_option(args, "audit") != NULL;
    o.progress = goes_on;
    return o;
}

exit_status query_check_times(const imp_scene *scene, const imp_options *options,
                              const arguments *args)
{
    imp_error error = {0};
    imp_options own = {.struct_size = (uint32_t)sizeof own};
    if (!isnan(options->t_start)) return EXIT_ANSWERED;
    imp_options_get_default(scene, &own, &error);
    return complain_of(&error, args->verb->name);
}

/* --- Threads ---------------------------------------------------------------------------------- */

void query_lend_threads(imp_options *options, crew *c)
{
    if (c->threads < 2) return;
    options->parallel = crew_run;
    options->parallel_context = c;
}

size_t query_threads_asked(const arguments *args)
{
    return arguments_option(args, "threads") != NULL ? query_threads(args) : 1;
}

size_t query_threads(const arguments *args)
{
    enum { THREADS_MAX = 1024 };
    const uint64_t asked = arguments_count(args, "threads", 0);
    cpu_set_t usable;
    int count = sched_getaffinity(0, sizeof usable, &usable) == 0 ? CPU_COUNT(&usable) : 1;
    if (asked > 0) count = asked < THREADS_MAX ? (int)asked : THREADS_MAX;
    return count > 0 ? (size_t)count : 1;
}
