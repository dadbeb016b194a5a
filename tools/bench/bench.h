/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_BENCH_BENCH_H
#define TOOLS_BENCH_BENCH_H

#include <impinge/baseline.h>
#include <impinge/impinge.h>
#include <jansson.h>

#include "core/common/random.h"
#include "tools/cli/message.h"

/* Benchmarks: methods side by side on the same scenes
 * ===================================================
 * A set is a table of cases; a case is one or more scenes asked the same question; every method of
 * the set answers every case, each scene afresh, and its counters are tallied:
 *
 *   bench_sets     which sets there are, and their scenes (bench_patches: random patches)
 *   bench_measure  one method on one case -> tally (bench_measure_stream: a stream of scenes)
 *   bench_print    tallies as a table for people; bench_json: for programs
 *
 * Scenes come from fixed seeds without a call to libm but sqrt, so that all counters are the same
 * in every run and on every machine. Seconds alone are not. */

/* --- What is asked ---------------------------------------------------------------------------- */

enum { BENCH_ROWS_MAX = 8, BENCH_FINDINGS_MAX = 6 };

/* One scene, and when its bodies first touch, where that is known. */
typedef struct bench_scene {
    char *a, *b;  /* two pipelines; b NULL: a is the text of a scene file, */
    bool is_path; /* or the path of one */
    bool has_reference;
    bool meets; /* the reference: whether they touch at all, and when */
    double t;
} bench_scene;

typedef struct bench_case {
    char name[48];
    double gamma, gamma_clear; /* length; gamma_clear < 0: gamma / 2 */
    double required; /* if > 0: whether bodies stay so far apart is asked instead of contact */
    double cut;      /* if > 0: asked only up to this part of the time until the first contact */
    uint64_t goal[BENCH_ROWS_MAX]; /* pairs that each of the set's methods may take; 0: no goal */
    bool goal_is_open[BENCH_ROWS_MAX]; /* known not to be reached yet */
    int change;                        /* BENCH_CHANGES: what changes, of changes.c, */
    size_t steps;                      /* and how often; such a case has no scenes of its own */
    bench_scene *scenes;
    size_t count, capacity;
} bench_case;

/* A list of cases under construction. Once memory has run out, adding does nothing. */
typedef struct bench_cases {
    bench_case *cases;
    size_t count, capacity;
    bool no_memory;
} bench_cases;

/* Begins a case; scenes go to the last one begun. */
void bench_begin(bench_cases *list, double gamma, double gamma_clear, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Adds a scene of two pipelines, or (b NULL) of a scene file's text. Takes over both; a NULL
 * for memory that ran out. Answers the scene, or NULL. */
bench_scene *bench_add_pair(bench_cases *list, char *a, char *b);
bench_scene *bench_add_text(bench_cases *list, char *text);

/* Adds a scene file that comes with the command; complains where it is missing. */
exit_status bench_add_package_file(bench_cases *list, const char *name, const char *verb);

/* Text that printf makes, in memory of its own; NULL: no memory. */
char *bench_text(const char *format, ...) __attribute__((format(printf, 1, 2)));

void bench_cases_free(bench_cases *list);

/* --- Methods and sets ------------------------------------------------------------------------- */

typedef enum bench_question {
    BENCH_CONTACT,    /* when do they first touch, or what the case asks */
    BENCH_CLEARANCE,  /* how near do they come? */
    BENCH_DECISION,   /* is 0.99 of the minimum distance kept? */
    BENCH_PROOF,      /* do they stay 0.99 of the least distance apart? */
    BENCH_STREAM,     /* contact, of all scenes one after the other, reading them included */
    BENCH_CHANGES,    /* contact, in one scene whose numbers change with each step */
    BENCH_CERTIFICATE /* what the case asks, keeping the proof, which is then verified */
} bench_question;

typedef struct bench_method {
    const char *name;
    uint32_t baseline; /* of imp_options */
    bench_question question;
    bool capped;         /* whether it ends at the request's budget, */
    uint64_t pairs_most; /* or at this one, if that is less; 0: none */
    size_t threads;  /* BENCH_STREAM: of the batch; 0: no batch, each scene is read and solved */
    bool is_rebuilt; /* BENCH_CHANGES: each step has a scene of its own, which ratios are against */
} bench_method;

/* What the command line asks for. */
typedef struct bench_request {
    const char *verb;     /* who complains */
    bool only;            /* whether one kind of method alone is wanted, */
    bool is_paper;        /* and it is the paper's */
    uint64_t max_pairs;   /* budget of methods that are capped, for one scene; 0: none */
    uint64_t repeats;     /* how often a scene is timed; at least 1 */
    uint64_t count, seed; /* of random patches besides the file's */
    uint64_t up_to;       /* bodies, triangles or scenes of a case at most; at least: */
} bench_request;

enum { BENCH_SIZE_LEAST = 100 }; /* that each set of sizes has a case for */

/* Over the scenes of a case. */
typedef struct bench_spread {
    double mean, median, max;
} bench_spread;

/* Certificates of scenes, and what impinge-verify made of them. */
typedef struct bench_certificates {
    size_t count, hold;          /* those that hold without assuming anything */
    bench_spread bytes, seconds; /* size of the file, processor time of the verifier */
    bool has_kernel;             /* impinge-verify-kernel is there */
    size_t elaborated, proved;   /* in time (kernel_time.h); by the kernel then */
    bench_spread kernel;         /* processor time of the kernel for these */
} bench_certificates;

/* How one method did on one case. */
typedef struct bench_tally {
    size_t scenes, verdicts[3]; /* by imp_verdict */
    size_t ended;               /* undecided because the budget ended */
    bench_spread pairs, nodes, searches, heap, bytes, seconds;
    double processor; /* BENCH_STREAM: seconds a scene of all threads; `seconds` are the clock's */
    size_t references, agreed;       /* scenes with a reference; whose verdict is the same */
    bench_certificates certificates; /* BENCH_CERTIFICATE; else count is 0 */
    double earliest, latest; /* of t_lower - reference, in time: over the contacts among them, and
                                  over all of them that meet; NAN if there is none */
} bench_tally;

typedef struct bench_row {
    const bench_method *method;
    bench_tally tally;
} bench_row;

/* All methods on one case, and the row that ratios are against: the paper's, BENCH_PROOF, scenes
 * built anew, or NULL. */
typedef struct bench_result {
    const bench_case *about;
    bench_row rows[BENCH_ROWS_MAX];
    size_t row_count;
    uint64_t budget[BENCH_ROWS_MAX]; /* of each row, in pairs a scene; 0: none */
    const bench_row *baseline;
} bench_result;

/* What became of a case's goal for one method: whether all scenes have the verdict of the
 * reference, for no more pairs than the goal. */
typedef enum bench_goal {
    BENCH_GOAL_NONE, /* there is none, or the budget was below it */
    BENCH_GOAL_REACHED,
    BENCH_GOAL_MISSED,
    BENCH_GOAL_OPEN,       /* missed, as is known */
    BENCH_GOAL_REACHED_NOW /* though marked as open */
} bench_goal;
bench_goal bench_goal_of(const bench_result *result, size_t row);

/* Returns the pairs at which a method ends, for one scene; 0: none. */
uint64_t bench_budget(const bench_method *m, const bench_request *request);

/* One number that a set is about, drawn from its results. */
typedef struct bench_finding {
    const char *key;
    char text[128];
    double value;
} bench_finding;

typedef struct bench_set {
    const char *name;
    const char *about;                  /* lines for people */
    const bench_method *const *methods; /* NULL-terminated */
    exit_status (*build)(bench_cases *list, const bench_request *request);
    /* Draws up to BENCH_FINDINGS_MAX findings from the results of all cases, whose first rows are
     * the default method's, and answers how many; NULL: none ever. */
    size_t (*find)(const bench_result *results, size_t count, bench_finding *findings);
} bench_set;

/* All sets, NULL-terminated; the one of that name, or NULL. */
const bench_set *const *bench_sets_all(void);
const bench_set *bench_set_find(const char *name);

/* Machine parts that slide in each other; nested saddles; everyday scenes; scenes of many bodies;
 * meshes of many triangles; streams of scenes; scenes that change; proofs that are verified. */
extern const bench_set bench_conformal, bench_saddles, bench_parameters, bench_everyday,
    bench_bodies, bench_surfaces, bench_batch, bench_changes, bench_certificates_set;

/* Returns whether the request measures any method of the set. */
bool bench_set_is_measured(const bench_set *set, const bench_request *request);

/* Says what the set needs that is not here, or NULL. */
const char *bench_set_lack(const bench_set *set);

/* What building a set answers once its cases are added. */
exit_status bench_built(const bench_cases *list, const bench_request *request);

/* --- Random scenes ---------------------------------------------------------------------------- */

/* A direction of unit length, uniform on the sphere. */
void bench_direction(uint64_t *state, double n[3]);

/* Adds `count` scenes of two random patches of this degree in u and v (patches.c tells how they are
 * drawn) to the case, and those of the file that comes with the command. */
void bench_add_patches(bench_cases *list, uint64_t seed, int degree, uint64_t count);
exit_status bench_add_file(bench_cases *list, const char *verb);

/* --- Measuring and telling -------------------------------------------------------------------- */

/* Everything about one method on one case. Errors are the library's. */
imp_code bench_measure(imp_registry *registry, const bench_case *c, const bench_method *m,
                       const bench_request *request, bench_tally *tally, imp_error *error);

/* Measures a method of BENCH_STREAM on one case. Times are the median of `repeats` runs. */
imp_code bench_measure_stream(imp_registry *registry, const bench_case *c, const bench_method *m,
                              const bench_request *request, bench_tally *tally, imp_error *error);

/* Measures a method of BENCH_CHANGES on one case. Times are the median of `repeats` rounds. */
imp_code bench_measure_changes(imp_registry *registry, const bench_case *c, const bench_method *m,
                               const bench_request *request, bench_tally *tally, imp_error *error);

/* Measures BENCH_CERTIFICATE on one case. The verifier runs once for each scene. */
imp_code bench_measure_certificates(imp_registry *registry, const bench_case *c,
                                    const bench_request *request, bench_tally *tally,
                                    imp_error *error);

/* Tells what a clearance says as the verdict of a search: clear where the minimum distance is above
 * gamma, or where what is required is kept. */
imp_verdict bench_verdict_of(const imp_clearance *answer, double gamma);

/* Returns the verifier's time over that of the search that kept the proof, in the mean. */
double bench_verify_over_solve(const bench_tally *tally);

/* Makes a scene of a case; NULL: *error says why. The caller frees it. */
imp_scene *bench_scene_of(imp_registry *registry, const bench_scene *s, imp_error *error);

/* Processor seconds of this thread: other processes of a busy machine do not count. */
double bench_seconds_computed(void);

/* What the numbers mean; what a set is about and the head of its table; one case of it. */
void bench_print_request(const bench_request *request);
void bench_print_head(const bench_set *set, const bench_request *request);
void bench_print_result(const bench_result *result);
void bench_print_findings(const bench_finding *findings, size_t count);

/* Results as parts of what tools/schema/bench.schema.json describes; takes over `results`. NULL: no
 * memory. */
json_t *bench_result_json(const bench_result *result);
json_t *bench_set_json(const bench_set *set, json_t *results, const bench_finding *findings,
                       size_t count);

#endif
