/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>

#include "tools/bench/crowd.h"

/* crowd_scene COUNT SEED: a scene file of that many bodies, on standard output. */
int main(int count, char **words)
{
    if (count != 3) return EXIT_FAILURE;
    char *text = crowd_text(strtoul(words[1], NULL, 10), strtoull(words[2], NULL, 10));
    if (text == NULL || puts(text) == EOF) return EXIT_FAILURE;
    free(text);
    return EXIT_SUCCESS;
}
