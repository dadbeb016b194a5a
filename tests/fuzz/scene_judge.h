/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_FUZZ_SCENE_JUDGE_H
#define TESTS_FUZZ_SCENE_JUDGE_H

#include <impinge/impinge.h>

/* What an answer claims, held against points of the surfaces. The search's own arithmetic is not
 * used: only evaluated points with their error bounds. What does not hold ends the process. */

/* Judges the answer of a scene of two bodies: the verdict fits its reason and times; the witness
 * lies on its surfaces, at the gap that is reported; and no two points found by sampling, and by
 * moving the nearest of them towards each other, are nearer than gamma_clear before t_lower. `seed`
 * chooses the samples. */
void scene_judge(const imp_scene *scene, const imp_options *options, const imp_result *r,
                 uint64_t seed);

/* The least distance in the same times, as another search finds it, does not contradict it. */
void scene_judge_by_clearance(imp_scene *scene, const imp_options *options, const imp_result *r);

#endif
