/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/survey/box_queue.h"

#include <stdlib.h>

#include "core/common/array.h"

static bool comes_before(const survey_box *x, const survey_box *y)
{
    return x->key < y->key || (x->key == y->key && x->number > y->number);
}

bool box_queue_push(box_queue *queue, survey_box *box)
{
    survey_box **grown = array_reserve(queue->at, queue->count, &queue->capacity, sizeof *grown);
    if (grown == NULL) return free(box), false;
    queue->at = grown;
    size_t k = queue->count++;
    for (; k > 0 && comes_before(box, grown[(k - 1) / 2]); k = (k - 1) / 2)
        grown[k] = grown[(k - 1) / 2];
    grown[k] = box;
    return true;
}

survey_box *box_queue_pop(box_queue *queue)
{
    if (queue->count == 0) return NULL;
    survey_box *first = queue->at[0], *last = queue->at[--queue->count];
    size_t k = 0;
    for (size_t child = 1; child < queue->count; child = 2 * k + 1) {
        if (child + 1 < queue->count && comes_before(queue->at[child + 1], queue->at[child]))
            ++child;
        if (!comes_before(queue->at[child], last)) break;
        queue->at[k] = queue->at[child];
        k = child;
    }
    if (queue->count > 0) queue->at[k] = last;
    return first;
}

const survey_box *box_queue_first(const box_queue *queue)
{
    return queue->count > 0 ? queue->at[0] : NULL;
}

void box_queue_clear(box_queue *queue)
{
    for (size_t k = 0; k < queue->count; ++k) free(queue->at[k]);
    free(queue->at);
    *queue = (box_queue){.count = 0};
}
