/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/spin_text.h"

#include "plugins/common/keys.h"

/* M_0 w as m0 ... m2 and M_h w as o0 ... o2, by the quaternions p and q. */
static void write_ends(const double from[4], const double to_rotation[4], const imp_text_sink *to)
{
    keys_define(to, "p", from, 4);
    keys_define(to, "q", to_rotation, 4);
    imp_add_text(to, "n = 2/(p0^2 + p1^2 + p2^2 + p3^2); d0 = p2*w2 - p3*w1; "
                     "d1 = p3*w0 - p1*w2; d2 = p1*w1 - p2*w0; "
                     "m0 = w0 + n*(p0*d0 + p2*d2 - p3*d1); "
                     "m1 = w1 + n*(p0*d1 + p3*d0 - p1*d2); "
                     "m2 = w2 + n*(p0*d2 + p1*d1 - p2*d0); "
                     "N = 2/(q0^2 + q1^2 + q2^2 + q3^2); e0 = q2*w2 - q3*w1; "
                     "e1 = q3*w0 - q1*w2; e2 = q1*w1 - q2*w0; "
                     "o0 = w0 + N*(q0*e0 + q2*e2 - q3*e1); "
                     "o1 = w1 + N*(q0*e1 + q3*e0 - q1*e2); "
                     "o2 = w2 + N*(q0*e2 + q1*e1 - q2*e0); ");
}

/* A turn about k by the angle A takes m to k (k.m) + cos A (m - k (k.m)) + sin A (k x m); without a
 * spin it does nothing. */
void spin_write(const double spin[3], const double from[4], const double to_rotation[4],
                const imp_text_sink *to)
{
    write_ends(from, to_rotation, to);
    if (spin[0] == 0 && spin[1] == 0 && spin[2] == 0) {
        imp_add_text(to, "r0 = m0 + s/h*(o0 - m0); r1 = m1 + s/h*(o1 - m1); "
                         "r2 = m2 + s/h*(o2 - m2); ");
        return;
    }
    keys_define(to, "f", spin, 3);
    imp_add_text(to, "l = hypot(f0, f1, f2); k0 = f0/l; k1 = f1/l; k2 = f2/l; "
                     "D = k0*m0 + k1*m1 + k2*m2; u0 = m0 - k0*D; u1 = m1 - k1*D; u2 = m2 - k2*D; "
                     "v0 = k1*m2 - k2*m1; v1 = k2*m0 - k0*m2; v2 = k0*m1 - k1*m0; "
                     "r0 = k0*D + cos(l*s)*u0 + sin(l*s)*v0 + "
                     "s/h*(o0 - k0*D - cos(l*h)*u0 - sin(l*h)*v0); "
                     "r1 = k1*D + cos(l*s)*u1 + sin(l*s)*v1 + "
                     "s/h*(o1 - k1*D - cos(l*h)*u1 - sin(l*h)*v1); "
                     "r2 = k2*D + cos(l*s)*u2 + sin(l*s)*v2 + "
                     "s/h*(o2 - k2*D - cos(l*h)*u2 - sin(l*h)*v2); ");
}
