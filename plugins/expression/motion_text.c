/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/motion_text.h"
#include "plugins/expression/type.h"

/* The prefix of names that are its own: one letter m more than any constant begins with, and '_'.
 * No function, variable, pi or e has a '_'. */
static size_t prefix_length(const imp_value *constants)
{
    size_t most = 0;
    for (size_t k = 0; k < constants->count; ++k) {
        const size_t run = strspn(constants->string[k], "m");
        if (run > most) most = run;
    }
    return most + 1;
}

/* Prints a text in which '@' stands for the prefix. */
static void add_own(size_t prefix, const char *text, const imp_text_sink *to)
{
    for (; *text != '\0'; ++text) {
        if (*text != '@') {
            to->add(to, text, 1);
            continue;
        }
        for (size_t k = 0; k < prefix; ++k) to->add(to, "m", 1);
        to->add(to, "_", 1);
    }
}

static void define_own(size_t prefix, const char *name, double x, const imp_text_sink *to)
{
    add_own(prefix, name, to);
    imp_add_text(to, " = ");
    imp_add_number(to, x);
    imp_add_text(to, "; ");
}

/* Coordinate I of the turned point, J and K being the next two. */
#define TURNED(I, J, K)                                                                            \
    "@c" I " + @k" I "*@d + @C*(@w" I " - @k" I "*@d) + @S*(@k" J "*@w" K " - @k" K "*@w" J ")"

/* Defines what the coordinates of the turned point need. */
static void write_turn(const motion_text *m, size_t prefix, const imp_text_sink *to)
{
    static const char *const axis[] = {"@a0", "@a1", "@a2"}, *const center[] = {"@c0", "@c1",
                                                                                "@c2"};
    for (int i = 0; i < 3; ++i) {
        define_own(prefix, axis[i], m->axis[i], to);
        define_own(prefix, center[i], m->center[i], to);
    }
    add_own(prefix,
            "@l = hypot(@a0, @a1, @a2); @k0 = @a0/@l; @k1 = @a1/@l; @k2 = @a2/@l; @w0 = x - @c0; "
            "@w1 = y - @c1; @w2 = z - @c2; @d = @k0*@w0 + @k1*@w1 + @k2*@w2; @A = ",
            to);
    imp_add_text(to, m->angle);
    add_own(prefix, "; @C = cos(@A); @S = sin(@A); ", to);
}

void motion_text_write(const motion_text *m, const imp_text_sink *to)
{
    static const char *const place[] = {"x", "y", "z"};
    static const char *const turned[] = {TURNED("0", "1", "2"), TURNED("1", "2", "0"),
                                         TURNED("2", "0", "1")};
    const size_t prefix = prefix_length(m->constants);
    write_constants(m->constants, to);
    write_range("t", m->lo, m->hi, to);
    if (m->angle != NULL) write_turn(m, prefix, to);
    for (int i = 0; i < 3; ++i) {
        add_own(prefix, m->angle != NULL ? turned[i] : place[i], to);
        imp_add_text(to, " + (");
        imp_add_text(to, m->offset[i]);
        imp_add_text(to, i < 2 ? "); " : ")");
    }
}
