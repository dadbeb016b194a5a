/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/eliminate.h"

bool eliminate_solve(size_t count, double m[EQUATIONS_MAX][EQUATIONS_MAX + 1],
                     const double least[EQUATIONS_MAX], double x[EQUATIONS_MAX])
{
    for (size_t i = 0; i < count; ++i) {
        if (!(m[i][i] > least[i])) return false;
        for (size_t k = i + 1; k < count; ++k) {
            const double factor = m[k][i] / m[i][i];
            for (size_t j = i; j <= count; ++j) m[k][j] -= factor * m[i][j];
        }
    }
    for (size_t i = count; i-- > 0;) {
        x[i] = m[i][count];
        for (size_t j = i + 1; j < count; ++j) x[i] -= m[i][j] * x[j];
        x[i] /= m[i][i];
    }
    return true;
}
