/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "tools/cli/batch.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/output.h"
#include "tools/cli/progress.h"
#include "tools/cli/verbs.h"
#include "tools/mpi/ranks.h"

/* Scenes that have no answer yet are numbered from 0, and taken from the counter. Every rank reads
 * the whole input, and solves what it takes. Answers go to the file block by block: when a block's
 * scenes are all solved, their lengths tell each rank where its own answers stand. So the file
 * always holds all answers up to some scene, and perhaps, when a rank has died, places of the next
 * block that were never written, which --resume takes for torn. */

enum { BLOCK_PER_RANK = 64 };

typedef struct block {
    int64_t first; /* number of its first scene */
    size_t size;
    batch_item *own; /* scenes that we have solved, each answer with the end of its line */
    int *length;     /* of all answers; 0: none */
} block;

typedef struct ranked_batch {
    batch b;
    ranks_counter counter;
    MPI_File out;
    MPI_Offset end; /* of what is written */
    int64_t taken;  /* the number we have taken from the counter and not solved */
    int64_t read;   /* how many numbered scenes we have read */
    bool at_end;    /* no scene is left to be read, or we stop */
    batch_item item;
} ranked_batch;

/* --- Solving ---------------------------------------------------------------------------------- */

/* Reads on to the scene that we have taken. */
static bool read_taken(ranked_batch *r)
{
    while (r->read <= r->taken) {
        if (!batch_next_line(&r->b, &r->item)) return false;
        r->read += 1;
    }
    return true;
}

/* Returns the answer of a line, with its line end. NULL: there is none, and none comes after it. */
static char *solve_taken(ranked_batch *r)
{
    batch_item *item = &r->item;
    char *line = NULL;
    batch_answer(&r->b, item);
    if (!item->interrupted && item->answer == NULL)
        batch_keep_worst(&r->b, complain_of_memory(r->b.args->verb->name));
    if (!item->interrupted && item->answer != NULL) {
        if (asprintf(&line, "%s\n", item->answer) < 0) line = NULL;
    }
    free(item->answer);
    return line;
}

static void solve_block(ranked_batch *r, block *k)
{
    while (!r->at_end && r->taken < k->first + (int64_t)k->size) {
        char *answer = read_taken(r) ? solve_taken(r) : NULL;
        const size_t place = (size_t)(r->taken - k->first);
        r->at_end = answer == NULL;
        if (answer == NULL) return;
        k->own[place] = r->item;
        k->own[place].answer = answer;
        k->length[place] = (int)strlen(answer);
        r->taken = ranks_counter_next(&r->counter);
    }
}

/* --- Writing ---------------------------------------------------------------------------------- */

static bool write_answer(ranked_batch *r, const batch_item *item, int length)
{
    batch_count(&r->b, item);
    return MPI_File_write_at(r->out, r->end, item->answer, length, MPI_CHAR, MPI_STATUS_IGNORE) ==
           MPI_SUCCESS;
}

/* Writes what has all answers before it. Answers how many that are, of all ranks. */
static size_t write_block(ranked_batch *r, const block *k, bool *ok)
{
    size_t done = 0;
    MPI_Allreduce(MPI_IN_PLACE, k->length, (int)k->size, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    *ok = true;
    for (; done < k->size && k->length[done] > 0; ++done) {
        if (k->own[done].answer != NULL && !write_answer(r, &k->own[done], k->length[done]))
            *ok = false;
        r->end += k->length[done];
    }
    return done;
}

/* One block; answers whether there are more. */
static bool do_block(ranked_batch *r, block *k)
{
    bool written;
    memset(k->own, 0, k->size * sizeof *k->own);
    memset(k->length, 0, k->size * sizeof *k->length);
    solve_block(r, k);
    const size_t done = write_block(r, k, &written);
    for (size_t n = 0; n < k->size; ++n) free(k->own[n].answer);
    if (!written)
        batch_keep_worst(&r->b, complain(EXIT_DATA, r->b.args->verb->name, "%s: cannot be written",
                                         arguments_option(r->b.args, "resume")->text));
    k->first += (int64_t)done;
    if (ranks_own() == FIRST_RANK) progress_count(r->b.resume.answers + (uint64_t)k->first);
    return ranks_worst(!written ? EXIT_DATA : EXIT_ANSWERED) == EXIT_ANSWERED && done == k->size;
}

static exit_status do_blocks(ranked_batch *r)
{
    block k = {.size = (size_t)BLOCK_PER_RANK * (size_t)ranks_count()};
    k.own = calloc(k.size, sizeof *k.own);
    k.length = calloc(k.size, sizeof *k.length);
    exit_status status = k.own == NULL || k.length == NULL
                             ? complain_of_memory(r->b.args->verb->name)
                             : EXIT_ANSWERED;
    status = ranks_worst(status);
    if (status == EXIT_ANSWERED) {
        r->taken = ranks_counter_next(&r->counter);
        while (do_block(r, &k)) continue;
    }
    free(k.own);
    free(k.length);
    return status;
}

/* --- The output ------------------------------------------------------------------------------- */

/* The first rank locks the output, compares ids when it reads the input, and then cuts off what is
 * torn; the others pass over as many scenes as there are answers. */
static exit_status open_output(ranked_batch *r, const char *path)
{
    exit_status status = EXIT_ANSWERED;
    if (ranks_own() == FIRST_RANK) status = batch_resume_open(&r->b.resume, path, r->b.args, false);
    status = ranks_worst(status);
    if (status != EXIT_ANSWERED) return status;
    int64_t known[2] = {(int64_t)r->b.resume.end, (int64_t)r->b.resume.answers};
    MPI_Bcast(known, 2, MPI_INT64_T, FIRST_RANK, MPI_COMM_WORLD);
    r->end = (MPI_Offset)known[0];
    if (ranks_own() != FIRST_RANK) r->b.passed_over = (uint64_t)known[1];
    char *whole = realpath(path, NULL); /* not every MPI takes every relative name */
    const int opened = MPI_File_open(MPI_COMM_WORLD, whole != NULL ? whole : path, MPI_MODE_WRONLY,
                                     MPI_INFO_NULL, &r->out);
    free(whole);
    return ranks_worst(opened == MPI_SUCCESS ? EXIT_ANSWERED
                                             : complain(EXIT_DATA, r->b.args->verb->name,
                                                        "%s: cannot be written", path));
}

/* Failures are reported once, for all ranks. */
static exit_status sum_up(ranked_batch *r)
{
    int64_t total[2] = {(int64_t)r->b.failures, (int64_t)r->b.answered}, lines = (int64_t)r->b.line;
    MPI_Allreduce(MPI_IN_PLACE, &total[0], 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &total[1], 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &lines, 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
    r->b.worst = ranks_worst(r->b.worst);
    r->b.failures = (size_t)total[0];
    r->b.answered = (size_t)total[1];
    r->b.line = (size_t)lines;
    if (ranks_own() == FIRST_RANK) batch_sum_up(&r->b);
    if (interrupt_came()) batch_keep_worst(&r->b, EXIT_UNDECIDED);
    if (r->b.input_failed) batch_keep_worst(&r->b, EXIT_DATA);
    return ranks_worst(r->b.worst);
}

static exit_status answer_all(ranked_batch *r)
{
    complain_aloud(true);
    r->at_end = !batch_next_line(&r->b, &r->item); /* compares all ids before anything is written */
    r->read = r->at_end ? 0 : 1;
    if (ranks_worst(r->b.input_failed ? EXIT_DATA : EXIT_ANSWERED) != EXIT_ANSWERED)
        return MPI_File_close(&r->out), EXIT_DATA;
    if (!ranks_counter_open(&r->counter, 0)) return complain_of_memory(r->b.args->verb->name);
    if (ranks_own() == FIRST_RANK)
        progress_count_from(r->b.resume.answers, batch_scene_count(&r->b), "scenes");
    const exit_status status = do_blocks(r);
    ranks_counter_close(&r->counter);
    MPI_File_close(&r->out);
    const exit_status worst = sum_up(r);
    return status > worst ? status : worst;
}

exit_status ranks_batch(const arguments *args)
{
    const char *path = arguments_option(args, "resume")->text;
    ranked_batch r = {.end = 0};
    exit_status status = ranks_worst(batch_begin(&r.b, args));
    if (status == EXIT_ANSWERED) status = open_output(&r, path);
    if (status == EXIT_ANSWERED) {
        status = ranks_worst(batch_prepare(&r.b));
        if (status == EXIT_ANSWERED)
            status = answer_all(&r);
        else
            MPI_File_close(&r.out);
    }
    if (ranks_own() == FIRST_RANK) batch_keep_worst(&r.b, batch_resume_close(&r.b.resume));
    free(r.item.text.text);
    batch_end(&r.b);
    return status;
}
