/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */
#ifndef IMPINGE_SURFACE_H
#define IMPINGE_SURFACE_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__FAST_MATH__)
#error "Impinge bounds are proofs: -ffast-math (or -Ofast) breaks them. Remove the flag."
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "Impinge bounds assume plain double arithmetic: build with SSE2, not x87."
#endif

#if defined(__cplusplus) && __cplusplus < 201703L
#error "Impinge's headers need C++17: compile with -std=c++17 or later."
#include <impinge/stop.h> /* there is none: ends the compiler's run before a hundred errors more */
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The surface ABI, version 1
 * ==========================
 *
 * A plugin is one shared object that adds one or more surface types or maps to Impinge. It exports
 * one symbol, `impinge_plugin`, and an ELF note with the same facts. The host reads the note before
 * it runs any of the plugin's code.
 *
 *   surface   f(u, v, t) -> (x, y, z), continuous on a box of parameters
 *   map       phi(x, y, z, t) -> (x, y, z), a motion or deformation of any surface
 *
 * The host pairs any surface with any other, because each type answers three questions about itself
 * alone: where is a point (eval), how fast can it change over a region (rate), and optionally which
 * quadratic does it follow there within which error (include, an order-2 Taylor model). The method
 * is from B. Von Herzen, A. Barr, H. Zatz, "Geometric Collisions for Time-Dependent Parametric
 * Surfaces", SIGGRAPH 1990 ("the paper").
 *
 * Most authors write one formula with <impinge/formula.h> and get all three.
 *
 * Rules for the whole ABI
 *   - Structs that may grow begin with their size and only grow at the end; the
 *     host reads no further than that size.
 *   - The caller owns every output buffer. Nothing is freed across the boundary.
 *   - Tables, names and texts live as long as the shared object is loaded.
 *   - After create, an instance never changes, except by renew. eval, rate, include, apply, net,
 *     rigid, distance, symmetry and tube are pure: no allocation, no errno, no change of rounding
 *     mode or of any other floating-point setting, same answer every time, safe from many
 *     threads at once [thread-safe]. create, renew and destroy are called by one thread at a
 *     time [main-thread].
 *   - Rounding is to nearest. Every bound must hold in spite of rounding: pad
 *     outward (<impinge/interval.h> has the helpers).
 *
 * Units: u, v are whatever the type's documentation says (often radians), t is
 * the scene's time, lengths are the scene's length. Angles are radians. */

#define IMP_ABI_MAJOR 1 /* differs: the host refuses the plugin */
#define IMP_ABI_MINOR 0 /* the plugin's may be at most the host's */

/* The minor version that a plugin is built for: defined before this header is included, an older
 * one makes newer headers build for older hosts. Fields that minor version N appends stand between
 * #if IMP_ABI_MINOR_TARGET >= N and #endif. */
#ifndef IMP_ABI_MINOR_TARGET
#define IMP_ABI_MINOR_TARGET IMP_ABI_MINOR
#elif IMP_ABI_MINOR_TARGET > IMP_ABI_MINOR || IMP_ABI_MINOR_TARGET < 0
#error "IMP_ABI_MINOR_TARGET is beyond what these headers know: install a newer Impinge."
#endif

#define IMP_PLUGIN_MAGIC 0x31706D49u /* the bytes "Imp1" in a little-endian file */

#if defined(__GNUC__)
#define IMP_EXPORT __attribute__((visibility("default")))
#else
#define IMP_EXPORT
#endif

/* IMP_HAS tells whether the struct that p points to, which begins with its struct_size, has a
 * field: structs of a plugin that was built with an older header end before fields that were
 * appended later. IMP_OFFERS tells whether it has a callback there that is not NULL. */
#define IMP_HAS(p, field)                                                                          \
    ((size_t)((const char *)(&(p)->field + 1) - (const char *)(p)) <= (p)->struct_size)
#define IMP_OFFERS(p, callback) (IMP_HAS(p, callback) && (p)->callback != NULL)

/* --- Status ----------------------------------------------------------------------------------- */

/* What a callback returns. Errors are return values, not exceptions: set no errno. (Functions of
 * libimpinge return an imp_code: IMP_SUCCESS, IMP_ERROR_....) */
typedef int32_t imp_status;
enum {
    IMP_STATUS_OK = 0,
    IMP_STATUS_DOMAIN = 1,    /* the region or point is outside the type's domain */
    IMP_STATUS_UNBOUNDED = 2, /* no finite rate over this region: the host splits it
                          further and never reports it as clear */
    IMP_STATUS_PARAMETER = 3, /* create only: the parameters are wrong, see imp_create_error */
    IMP_STATUS_INTERNAL = 4   /* anything else, memory included; the query ends with an error */
};

/* --- Parameters of a type --------------------------------------------------------------------- */

typedef uint32_t imp_kind;
enum {
    IMP_KIND_NUMBER = 1,  /* finite double */
    IMP_KIND_INTEGER = 2, /* whole number of at most 2^53 in magnitude */
    IMP_KIND_BOOLEAN = 3,
    IMP_KIND_STRING = 4, /* UTF-8, no NUL inside */
    IMP_KIND_TABLE = 5   /* names to numbers, as in {"a": 1, "b": 2} */
};

enum {
    IMP_PARAMETER_MIN_OPEN = 1u << 0,  /* the value must be greater than min, not equal */
    IMP_PARAMETER_MAX_OPEN = 1u << 1,  /* the value must be less than max, not equal */
    IMP_PARAMETER_SCALAR_OK = 1u << 2, /* rank 1: a bare value stands for an array of one */
    IMP_PARAMETER_OPTIONAL = 1u << 3,  /* may be absent: `default_value` is NULL */
    IMP_PARAMETER_FILE = 1u << 4       /* STRING of rank 0: name of a file; create gets a relative
                                          one with the scene file's folder in front */
};

#define IMP_RANK_MAX 3

/* One row of a type's parameter table. A vector is an IMP_KIND_NUMBER of rank 1 and
 * extent {3}; a list of points is rank 2 and extents {0, 3}. */
typedef struct imp_parameter {
    const char *name;          /* letters, digits, '_', a letter first; as in scene files */
    const char *unit;          /* "length", "rad", "rad/time", "1", ... */
    const char *doc;           /* one line */
    const char *default_value; /* default as JSON text; NULL: required, or IMP_PARAMETER_OPTIONAL */
    imp_kind kind;
    uint32_t flags;                /* IMP_PARAMETER_MIN_OPEN | ... */
    uint32_t rank;                 /* 0 for a single value, else the number of extents */
    uint32_t extent[IMP_RANK_MAX]; /* 0: any number from 1 up */
    double min, max;               /* of each number; -INFINITY and INFINITY: no limit */
} imp_parameter;

/* A parameter's value, checked by the host against its row: kind, rank, extents,
 * range, finiteness. The arrays are the host's and die when create returns. */
typedef struct imp_value {
    size_t count;                /* numbers or strings in all; 0: absent */
    size_t extent[IMP_RANK_MAX]; /* as found; 1 beyond the rank */
    const double *number;        /* NUMBER, INTEGER, BOOLEAN (0 or 1), TABLE: count, row-major */
    const char *const *string;   /* STRING, TABLE (the names): count */
} imp_value;

/* What create fills before it returns IMP_STATUS_PARAMETER. The host has set struct_size, parameter
 * = -1, element = -1, text = "". State what was found and what is allowed; the host adds the place
 * (file, line, JSON pointer). */
typedef struct imp_create_error {
    uint32_t struct_size;
    int32_t parameter; /* row of the wrong parameter, or -1 for the type as a whole */
    int64_t element;   /* index along its first extent, or -1 */
    char text[240];    /* NUL-terminated, one sentence */
    /* Set with IMP_STATUS_OK too: what was left out or read otherwise than its author may expect.
     * The host has set note_count = 0, note = "", and shows the note as a warning if the count is
     * not 0. Use imp_note, which leaves hosts alone that are older than these fields. */
    uint64_t note_count;    /* how many things the note counts */
    int32_t note_parameter; /* row, or -1 for the type as a whole */
    char note[244];         /* NUL-terminated, one sentence */
    /* Set to 1 with IMP_STATUS_OK by imp_repeatable: the instance follows from the values and from
     * the contents of the files that they name (IMP_PARAMETER_FILE), and create read nothing else.
     * The host may then share it with later scenes, as long as these files do not change. */
    uint32_t is_repeatable;
    uint32_t reserved; /* 0 */
    /* Asked now and then by a create that reads or makes much: whether it goes on, while it holds
     * that many bytes. 0: a limit on time or memory was reached; free everything and return
     * IMP_STATUS_INTERNAL, and the host tells the limit. NULL: no limits. Use imp_goes_on. */
    int (*goes_on)(struct imp_create_error *why, uint64_t bytes);
    /* Create calls this before it opens a file that no value names (the buffers of an asset, say):
     * `path` as for fopen, NUL-terminated. The host copies it, and certificates of the scene then
     * hold the file's hash. 0: no memory; free everything and return IMP_STATUS_INTERNAL. NULL:
     * nobody asks. Use imp_reads. */
    int (*reads)(struct imp_create_error *why, const char *path);
} imp_create_error;

/* --- Regions, rates, models ------------------------------------------------------------------- */

/* A box in p = (u, v, t). Guaranteed: lo <= c <= hi, all finite; c - d <= lo and
 * hi <= c + d in exact arithmetic; d == 0 exactly where lo == hi. Inside a region,
 * s = (p - c) / d, so s is in [-1, 1]; s is 0 where d is 0. */
typedef struct imp_region {
    double lo[3], hi[3];
    double c[3]; /* centre */
    double d[3]; /* half-width, rounded up */
} imp_region;

/* A box in (x, y, z, t); lo <= hi, all finite. */
typedef struct imp_box4 {
    double lo[4], hi[4];
} imp_box4;

/* M[i][j] >= max over a region of |d f_i / d p_j| (paper, eq. 19). Finite, >= 0.
 * Where f has a kink, the bound holds for difference quotients (Lipschitz). */
typedef struct imp_rate_matrix {
    double m[3][3];
} imp_rate_matrix;

/* Rates of a map: m[i][j] >= max over a box of |d phi_i / d (x, y, z, t)_j|. Finite, >= 0. */
typedef struct imp_map_rates {
    double m[3][4];
} imp_map_rates;

/* Index into imp_model.q of the coefficient of s_j s_k, j <= k. */
enum { IMP_UU = 0, IMP_UV = 1, IMP_UT = 2, IMP_VV = 3, IMP_VT = 4, IMP_TT = 5 };

/* An inclusion of one coordinate g over a region: an order-2 Taylor model. For every point p of the
 * region, with s = (p - c) / d, both hold for the exact value g(p):
 *
 *   | g(p) - (a + sum_j b_j s_j + sum_{j<=k} q_jk s_j s_k) | <= e
 *   lo <= g(p) <= hi
 *
 * and |g(p) - g(p')| <= sum_j rate_j |p_j - p'_j| inside the region. All finite, e >= 0, lo <= hi,
 * rate >= 0, unless the callback returns IMP_STATUS_UNBOUNDED: then rate may be INFINITY, lo
 * -INFINITY, hi and e INFINITY, and every bound that is finite still holds. A model can be made of
 * a point and the rates alone: a = g(c), b = q = 0, e = sum_j M_ij d_j. */
typedef struct imp_model {
    double a;          /* length */
    double b[3];       /* length, per unit of s */
    double q[6];       /* length; order IMP_UU ... IMP_TT */
    double e;          /* length */
    double lo, hi;     /* length */
    double rate[3];    /* length per unit of u, v, t */
    uint32_t depends;  /* bit j set: may depend on p_j. Clear: g does not depend on
                         p_j over the region, and b_j, q_j., rate_j are 0 */
    uint32_t reserved; /* 0 */
} imp_model;

/* Most control points of a net. */
enum { IMP_NET_POINTS = 36 };

/* A control net over a region: a moving Bezier patch of degrees n and m that the surface follows.
 * For every (u, v, t) in the region, with s = (p - lo) / (hi - lo) for u and v (0 where lo == hi),
 * the Bernstein polynomials B of degrees n and m, tau = t - c[2], and each coordinate f of the
 * surface,
 *
 *   | f - (place + tau drift + sum_ij b_ij (point_k + tau velocity_k)) | <= error,
 *   b_ij = w_k B_i(s_u) B_j(s_v) / sum of all of these,   k = i (m + 1) + j,   i <= n, j <= m.
 *
 * So the convex hull of the control points holds the surface at each moment, but for the error. The
 * host has set all to 0, and reads the first (n + 1) (m + 1) points, IMP_NET_POINTS at most. Far
 * from the origin, place and drift keep points and velocities small. All finite, error >= 0,
 * weights > 0. */
typedef struct imp_net {
    uint32_t degree[2];                 /* n along u, m along v */
    uint32_t is_moving;                 /* 0: velocities are all 0 */
    uint32_t is_weighted;               /* 0: weights are all 1, whatever stands there */
    double place[3], drift[3];          /* length, length/time */
    double error[3];                    /* length */
    double point[3][IMP_NET_POINTS];    /* of x, of y, of z; length */
    double velocity[3][IMP_NET_POINTS]; /* length/time */
    double weight[IMP_NET_POINTS];      /* 1; only their ratios matter */
} imp_net;

/* The pose of a rigid map over a span of times: for every point x of space and every time t of the
 * span,
 *
 *   phi(x, t) = shift(t) + turn(t) (x - pivot)
 *
 * turn(t) is a rotation: no entry of turn^T turn - 1 is beyond IMP_RIGID_SLACK in size, and its
 * determinant is positive. The entries are models of functions of t alone, whose s_2 is that of t;
 * the pivot is exact. Any pivot is right; best is one about which the map turns, because what is
 * not known of a rotation moves a point the farther, the farther it is from the pivot. All finite.
 *
 * `fixed` is a direction that turn(t) leaves as it is at all times, in exact arithmetic: that of a
 * constant axis. 0: none is known. Some component is from 1e-100 to 1e100, none is larger. */
#define IMP_RIGID_SLACK 0x1p-16

typedef struct imp_pose {
    imp_model turn[3][3]; /* row, column; 1 */
    imp_model shift[3];   /* length */
    double pivot[3];      /* length */
    double fixed[3];      /* any unit */
} imp_pose;

/* A line in the middle of a surface that runs around it, over a region: models of c(u, t), which do
 * not depend on v, with finite rates, and how far the surface is from it at most; finite. */
typedef struct imp_tube {
    imp_model line[3]; /* length */
    double radius;     /* length */
} imp_tube;

/* --- How a surface can be moved within itself ------------------------------------------------- */

/* The rigid motions that map the surface onto itself at any time: those of a sphere, of a surface
 * of revolution, of an endless cylinder or of an endless plane. If `distance` measures from a
 * larger surface that holds this one, they are the motions of the larger surface. The line goes
 * through the center along the axis, whose length matters for screws only. Center and axis are
 * exact.
 *
 * Screws: endless threads, worms, springs. A turn by any angle A about the line, |A| at most 2 pi
 * IMP_SCREW_TURNS, comes with a translation by A / (2 pi) times the axis, which is as long as the
 * lead. SCREW_RIGHT turns counterclockwise as seen from the axis' end, SCREW_LEFT clockwise. A lead
 * that is no double is rounded, and IMP_SCREW_TURNS times what it is off by is taken off the
 * distances. */
enum {
    IMP_SYMMETRY_ABOUT_POINT = 1, /* every rotation about the center; the axis is not read */
    IMP_SYMMETRY_ABOUT_LINE = 2,  /* every rotation about the line */
    IMP_SYMMETRY_ALONG_LINE = 3,  /* these, and every translation along it */
    IMP_SYMMETRY_ACROSS_LINE = 4, /* these rotations, and translations perpendicular to the line */
    IMP_SYMMETRY_SCREW_RIGHT = 5, /* right-handed screw motions along the line */
    IMP_SYMMETRY_SCREW_LEFT = 6   /* left-handed ones */
};

#define IMP_SCREW_TURNS 0x1p10
#define IMP_SCREW_SLACK 0x1p-44

/* What a symmetry claims besides, of the surface itself over all u and v of its domain; the sum of
 * any of these; of screws CLOSED alone.
 *
 * CLOSED: each rotation of the kind maps the surface onto itself. A whole cylinder is closed, half
 * a cylinder is not (a full turn needs IMP_TWO_PI_UPPER). The distance of two bodies that only turn
 * about closed axes never changes. A screw motion takes a point of a surface with screws that is
 * CLOSED to another point of it, unless that is higher or lower along the line than all points of
 * the surface at that t: a thread that goes all around, and ends in planes across the line. What is
 * rounded may move the other point by IMP_SCREW_SLACK (r + (turns + 1) lead), r being the image's
 * distance from the center.
 *
 * ORBIT_U: points of the same v and t are taken to each other by rotations about the line through
 * the center along the axis (which then counts for ABOUT_POINT, too); ORBIT_V: points of the same u
 * and t. ORBIT_ALL, for ABOUT_POINT only: all points of the same t are as far from the center. One
 * point then stands for its whole orbit where two surfaces have an axis or a center in common.
 *
 * ZONE, for ABOUT_POINT only: the surface is no whole ball, but rotations about the line through
 * the center along the axis (which then counts) map it onto itself: a zone or a cap of a sphere.
 *
 * NEARLY, with CLOSED or ZONE of what is no screw: what is closed but for rounding. These
 * rotations, and their inverses, take each point of the surface to one that is off the surface by
 * at most IMP_NEARLY_SLACK times the greatest distance of two of its points at that t; that is
 * taken off the distances. With ORBIT_U such images are off points of the same v, and points of the
 * same v and t are taken to each other but for that; with ORBIT_V likewise of the same u; with
 * ORBIT_ALL distances from the center differ by no more. */
enum {
    IMP_SYMMETRY_CLOSED = 1,
    IMP_SYMMETRY_ORBIT_U = 2,
    IMP_SYMMETRY_ORBIT_V = 4,
    IMP_SYMMETRY_ORBIT_ALL = 8,
    IMP_SYMMETRY_ZONE = 16,
    IMP_SYMMETRY_NEARLY = 32
};

#define IMP_NEARLY_SLACK 0x1p-36

typedef struct imp_symmetry {
    uint32_t kind;      /* IMP_SYMMETRY_ABOUT_POINT, ... */
    uint32_t is_closed; /* IMP_SYMMETRY_CLOSED, ... or 0 */
    double center[3];   /* length */
    double axis[3];     /* some component from 1e-100 to 1e100; of a screw length per turn */
} imp_symmetry;

/* --- Formulas as text ------------------------------------------------------------------------- */

/* Takes a text in portions. It grows at the end. `add` appends size bytes; sinks are the host's. */
typedef struct imp_text_sink {
    uint32_t struct_size;
    uint32_t reserved; /* 0 */
    void *host;
    void (*add)(const struct imp_text_sink *sink, const char *text, size_t size);
} imp_text_sink;

/* Capability `formula`: what an instance is, in a language that people and other programs read. A
 * proof that is written to a file states the surfaces by these formulas, and `impinge check` proves
 * the callbacks' bounds by them. A type has `formula`, a text in which its parameters stand by
 * their names, or `write_formula`, which prints an instance, or both.
 *
 *   text     = part { "|" part }
 *   part     = { item ";" } X ";" Y ";" Z
 *   item     = variable "in" "[" sum "," sum "]"  |  name "=" sum
 *   sum      = product { ("+" | "-") product }
 *   product  = signed { ("*" | "/") signed }
 *   signed   = { "+" | "-" } power
 *   power    = operand [ "^" signed ]
 *   operand  = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
 *
 * X, Y and Z are sums: the three coordinates, lengths. The variables are u, v and t of a surface,
 * and x, y, z and t of a map; t is the time, or what the map's or surface's clock shows. Items
 * stand before what uses them. `variable in [lo, hi]` is the domain, closed: of a surface those of
 * u and v are said, and t has all times if none are said; of a map only t may have one. Its ends
 * are without variables, and those of t may be -inf and inf. `name = sum` defines a name, letters,
 * digits and '_', a letter first, which is no variable, function, pi, e or name that has a meaning
 * already, but may be one of a parameter that stands for nothing here. Blanks and line ends
 * separate.
 *
 * Names that are not defined are pi, e, and the numbers among the instance's parameters: of a
 * number, integer or boolean (0 or 1) by its name, of an array with the place behind it, row-major
 * from 0, as in center0; only those of a fixed shape. A parameter should not be named pi or e: in
 * a certificate it would be defined, and impinge-verify refuses that.
 * Functions are those that `impinge info formula` lists. Numbers are decimal or as C's hexadecimal
 * ones, and stand for the nearest double; all else is exact: real numbers, no rounding.
 *
 * The surface is the union of its parts. Where the boxes of two parts overlap, they agree; every
 * point of the instance's domain that the host may ask for is in one, but for the rounding of the
 * domain's ends: IMP_TWO_PI_UPPER stands for 2*pi. For a surface that has no other times, or a map,
 * what is said for times outside of the boxes is nothing. */

/* --- Types ------------------------------------------------------------------------------------ */

/* Set in `flags` of a surface type or map that is defined for some times only: at other times the
 * surface does not exist and touches nothing. Without the flag the host knows nothing about other
 * times, and rejects a query that needs them. */
enum { IMP_FLAG_ABSENT_OUTSIDE_TIMES = 1u << 0 };

/* Set in `flags` of a map with the capability `rigid`, if turn(t) of its pose is a rotation in
 * exact arithmetic, not only within IMP_RIGID_SLACK. */
enum { IMP_FLAG_TURNS_EXACTLY = 1u << 1 };

/* --- Surface types ---------------------------------------------------------------------------- */

/* [thread-safe] means: called from any thread, many at once, on one instance. */
typedef struct imp_surface_type {
    uint32_t struct_size;
    uint32_t parameter_count;
    uint32_t parameter_size; /* sizeof(imp_parameter): the stride of the table */
    uint32_t flags;          /* 0 or IMP_FLAG_ABSENT_OUTSIDE_TIMES */
    const char *name;        /* letters, digits, '_', '-', a letter first; at most 63 bytes */
    const char *summary;     /* one line */
    const char *equation;    /* how (x, y, z) follows from u, v, t and the parameters */
    const char *source;      /* paper or book the equation comes from; may be NULL */
    const char *example;     /* a surface as on the command line: "sphere radius=2" */
    const imp_parameter *parameters;

    /* Makes an instance from one value per row of the table, in its order. On IMP_STATUS_OK sets
     * *self (never NULL) and the host calls destroy once later; on any other status *self is
     * ignored and the plugin must have freed everything. [main-thread] */
    imp_status (*create)(const imp_value *values, void **self, imp_create_error *why);
    void (*destroy)(void *self); /* [main-thread] */

    /* The whole parameter domain: finite lo <= hi for u and v. For t, lo may be
     * -INFINITY and hi INFINITY; the host then asks only about the times it needs.
     * What holds at other times: IMP_FLAG_ABSENT_OUTSIDE_TIMES.
     * [thread-safe] */
    void (*domain)(const void *self, double lo[3], double hi[3]);

    /* n points p[3*k] = (u, v, t), inside the domain, to x[3*k] = (x, y, z), and to
     * error[3*k] the absolute error of each coordinate: |x - f(p)| <= error in exact
     * arithmetic. error may be NULL: not wanted. [thread-safe] */
    imp_status (*eval)(const void *self, size_t n, const double *p, double *x, double *error);

    /* Computes the rate matrix over a region inside the domain. [thread-safe] */
    imp_status (*rate)(const void *self, const imp_region *region, imp_rate_matrix *rates);

    /* Capability `order-2`. Computes models of x, y and z over a region inside the domain. May be
     * NULL: the host then makes models of eval at the region's centre and of rate. [thread-safe] */
    imp_status (*include)(const void *self, const imp_region *region, imp_model model[3]);

    /* Capability `net`. Computes a control net over a region inside the domain. A net is useful
     * where the surface is, or nearly is, polynomial or rational of low degree: its hull lies
     * closer to the surface than a model does. IMP_STATUS_UNBOUNDED: there is none over this
     * region, and *net is ignored; smaller regions may have one. May be NULL: there is none at all.
     * [thread-safe] */
    imp_status (*net)(const void *self, const imp_region *region, imp_net *net);

    /* Capability `pieces`; both or neither, and a struct_size that ends before them means neither.
     *
     * An instance may stand for many surfaces: a mesh for its triangles. piece(self, k), k <
     * piece_count(self), is an instance of the same type that `self` owns, never NULL, the same one
     * each time, valid until `self` is destroyed; it is never passed to destroy, piece_count or
     * piece. piece_count is from 1 to IMP_PIECES_MAX and never changes. The host then calls domain,
     * eval, rate and include for the pieces alone; their domains must have the same times. The
     * pieces are one surface of the scene and move together: they are not tested with each other.
     * With a piece_count of 1, piece(self, 0) may be `self`: then it is one surface without pieces.
     * [main-thread], like create */
    size_t (*piece_count)(const void *self);
    const void *(*piece)(const void *self, size_t k);

    /* Capability `distance`; NULL, or a struct_size that ends before it: there is none.
     *
     * Bounds how far moving points stay from the whole surface. `point` holds models over one
     * region: of the x, y and z of a point anywhere in space that depends on the region's
     * parameters, and of t, at times of the domain. Their rates are not known and may be infinite.
     * *distance becomes a model (a, b, q, e, lo, hi, as in imp_model; rates are ignored) of any g
     * with
     *
     *   |g(p)| <= |(x, y, z)(p) - f(u, v, t(p))|   for all p of the region, all u, v of the domain
     *
     * for every point that the models allow. The best g is the signed distance, negative on one
     * side, or a number near it that is smooth at the surface. The host uses it to prove that two
     * surfaces stay apart that slide along each other. The distance from a larger surface that
     * holds this one, such as an endless cylinder, will do. IMP_STATUS_UNBOUNDED: nothing is known
     * there. [thread-safe] */
    imp_status (*distance)(const void *self, const imp_model point[4], imp_model *distance);

    /* Capability `symmetry`; NULL, or a struct_size that ends before it: there is none. Not without
     * `distance`.
     *
     * Names rigid motions that change no distance from the surface. For every such motion S, the g
     * that `distance` gives for models of a point bounds the distance of the moved point, too,
     *
     *   |g(p)| <= |S((x, y, z)(p)) - f(u, v, t(p))|   for every p of the region, all u, v of the
     *                                                 domain,
     *
     * and S may be another motion for each p. So a surface that turns about an axis of this one
     * stays as far from it as it is at one moment, which spares the host from dividing time. The
     * host has set *symmetry to 0. IMP_STATUS_UNBOUNDED: there is no symmetry with these
     * parameters. [thread-safe] */
    imp_status (*symmetry)(const void *self, imp_symmetry *symmetry);

    /* Capability `formula` (see above); NULL, or a struct_size that ends before it: no such text.
     *
     * The formula of every instance, or of those that `write_formula` does not print otherwise. It
     * says nothing about an instance that consists of pieces. */
    const char *formula;

    /* Capability `formula`; NULL, or a struct_size that ends before it: `formula` alone counts.
     *
     * Prints the formula of an instance, or of a piece where instances consist of pieces. It may
     * use the names of parameters, and print `formula`. <impinge/formula_text.h> writes exact
     * numbers. IMP_STATUS_UNBOUNDED: the instance has no formula, and what was printed is ignored.
     * Other statuses are errors. It may allocate. [thread-safe] */
    imp_status (*write_formula)(const void *self, const imp_text_sink *to);

    /* Capability `renew`; NULL, or a struct_size that ends before it: there is none.
     *
     * Refills an instance with other values, instead of destroy and create, for hosts whose numbers
     * change again and again. On IMP_STATUS_OK all callbacks answer, bit for bit, as those of a new
     * instance that create made from these values; its pieces may be others than before. On any
     * other status the values are wrong, or more than the instance has room for; then it may hold
     * anything, and the host does nothing with it but destroy it, and calls create, whose answer
     * counts. After IMP_STATUS_OK an instance whose domain or pieces break a promise is an error,
     * as after create, which is then not tried: it would hide the fault. `why` is as in create, and
     * what it says of a failure is not read. A renew for values of the same shapes as before should
     * not allocate. The host calls it only while nothing else uses the instance. [main-thread] */
    imp_status (*renew)(void *self, const imp_value *values, imp_create_error *why);

    /* Capability `tube`; NULL, or a struct_size that ends before it: there is none.
     *
     * For surfaces that run around a line: a torus, a pipe, a capsule. Finds the line c(u, t) in
     * the middle over the u and t of a region inside the domain, and a radius with
     *
     *   |f(u, v, t) - c(u, t)| <= radius   for all u and t of the region, all v of the domain.
     *
     * Best is the least such radius: where v runs all around the line at exactly that distance, two
     * surfaces are nearest where their lines are, and the host divides u and t alone until it knows
     * where that is. IMP_STATUS_UNBOUNDED: there is no line over this region. [thread-safe] */
    imp_status (*tube)(const void *self, const imp_region *region, imp_tube *tube);
} imp_surface_type;

#define IMP_PIECES_MAX ((size_t)1 << 24)

/* --- Maps ------------------------------------------------------------------------------------- */

/* A map moves or deforms any surface: g(u,v,t) = phi(f(u,v,t), t). Fields shared
 * with imp_surface_type mean the same. */
typedef struct imp_map_type {
    uint32_t struct_size;
    uint32_t parameter_count;
    uint32_t parameter_size;
    uint32_t flags; /* 0, IMP_FLAG_ABSENT_OUTSIDE_TIMES, IMP_FLAG_TURNS_EXACTLY, or both */
    const char *name;
    const char *summary;
    const char *equation;
    const char *source;
    const char *example; /* "rotate axis=0,0,1 rate=2", as after a '!' */
    const imp_parameter *parameters;
    imp_status (*create)(const imp_value *values, void **self, imp_create_error *why);
    void (*destroy)(void *self);

    /* The times the map is defined for; -INFINITY and INFINITY if always. A map should be defined
     * at all times, or have IMP_FLAG_ABSENT_OUTSIDE_TIMES. Space is not restricted: every (x, y, z)
     * must have an image. [thread-safe] */
    void (*time_domain)(const void *self, double *lo, double *hi);

    /* n points p[4*k] = (x, y, z, t) to x[3*k], and errors as for a surface: the map's own,
     * for exactly the given point. [thread-safe] */
    imp_status (*eval)(const void *self, size_t n, const double *p, double *x, double *error);

    /* Computes the rates over a box of (x, y, z, t). [thread-safe] */
    imp_status (*rate)(const void *self, const imp_box4 *box, imp_map_rates *rates);

    /* Capability `order-2`. Computes models of phi from models of x, y, z and t over one region of
     * a surface's parameters. `in` and `out` do not overlap. May be NULL: the host then uses rate
     * and the chain rule (paper, section 5: M_g[:,j] = P M_f[:,j], + p_t for j = t).
     * [thread-safe] */
    imp_status (*apply)(const void *self, const imp_model in[4], imp_model out[3]);

    /* Capability `net`. Replaces the net of a surface over a region by the net of its image: for
     * maps that are affine in space and keep motions linear in time. IMP_STATUS_UNBOUNDED: the
     * image has none over this region. May be NULL: it never has one. [thread-safe] */
    imp_status (*net)(const void *self, const imp_region *region, imp_net *net);

    /* Capability `rigid`; a struct_size that ends before it means NULL: the map is not rigid.
     *
     * Computes the pose over the times of the model *t, which depends on t alone, or is constant.
     * With it the host bounds a surface that does not move by itself once, before the map, instead
     * of anew for each span of times. IMP_STATUS_UNBOUNDED: there is no pose over these times, and
     * *pose is ignored; shorter spans may have one. The host has set all to 0. [thread-safe] */
    imp_status (*rigid)(const void *self, const imp_model *t, imp_pose *pose);

    /* Capability `span`; NULL, or a struct_size that ends before it: the span is the time domain.
     *
     * Tells the times that the map is made for, if it is defined at others, too: the times of a
     * table whose ends hold before and after it. A host that is not told which times to examine
     * examines these. -INFINITY and INFINITY: no times are preferred. [thread-safe] */
    void (*span)(const void *self, double *lo, double *hi);

    /* Capability `formula`; each may be missing as in imp_surface_type. A text of several parts has
     * one for each span of times: of a table those between two of its rows. [thread-safe] */
    const char *formula;
    imp_status (*write_formula)(const void *self, const imp_text_sink *to);

    /* Capability `parts`; NULL, or a struct_size that ends before it: it is one map, with one t.
     *
     * The maps that stand for this one in a scene, first to last, as after a '!':
     * "rotate axis=1,0,0 rate=1 clock=-$angle,$angle ! translate velocity=1,0,0 clock=-$d,$d".
     * $NAME is the value of that parameter, which is required or has a default and is a number, or
     * several; it stands there as JSON. Each clock that is a range is a parameter of the scene of
     * its own, named after this type: TYPE#1, TYPE#2, ...; so one map may move with more than one
     * t. A part whose clock ranges from 0 to 0 is left out: it moves nothing there. The parts are
     * types that the host finds by name, and have no parts themselves. create is called for what it
     * refuses; the other callbacks are those of the map where each clock is in the middle of its
     * range. */
    const char *parts;

    /* Capability `renew`, as in imp_surface_type. [main-thread] */
    imp_status (*renew)(void *self, const imp_value *values, imp_create_error *why);
} imp_map_type;

/* --- The plugin ------------------------------------------------------------------------------- */

#define IMP_SURFACE_FACTORY "impinge.surface/1"
#define IMP_MAP_FACTORY "impinge.map/1"

typedef struct imp_surface_factory {
    uint32_t struct_size;
    uint32_t count;
    const imp_surface_type *const *types; /* count pointers */
} imp_surface_factory;

typedef struct imp_map_factory {
    uint32_t struct_size;
    uint32_t count;
    const imp_map_type *const *types;
} imp_map_factory;

/* How a plugin was compiled. IMPINGE_PLUGIN offers it; it is optional, and `impinge check` reports
 * it to authors. */
#define IMP_BUILD_FACTORY "impinge.build/1"

typedef struct imp_build {
    uint32_t struct_size;
    uint32_t is_contracted; /* 1: a * b + c is rounded once, not twice (-ffp-contract) */
} imp_build;

/* Tells whether products and sums are contracted: x * y + z is 0 as two operations and -2^-60 as
 * one. */
static inline const void *imp_build_facts_(void)
{
    static const imp_build facts[2] = {{sizeof(imp_build), 0}, {sizeof(imp_build), 1}};
    volatile double a = 1 + 0x1p-30, b = 1 - 0x1p-30, c = -1;
    const double x = a, y = b, z = c;
    return &facts[x * y + z != 0];
}

static inline int imp_text_is_(const char *text, const char *other)
{
    while (*other != '\0' && *other == *text) ++other, ++text;
    return *other == *text;
}

typedef struct imp_plugin {
    uint32_t magic; /* IMP_PLUGIN_MAGIC */
    uint32_t struct_size;
    uint32_t abi_major, abi_minor;
    const char *name;    /* of the plugin; at most 63 bytes */
    const char *version; /* of the plugin */
    const char *license; /* SPDX expression */
    const char *author;
    /* Returns the factory of that id, or NULL for ids the plugin does not know. [main-thread] */
    const void *(*get_factory)(const char *id);
} imp_plugin;

/* The one symbol a plugin exports; IMPINGE_PLUGIN defines it. Plugins that are linked into a
 * program, which hands them to imp_registry_add, are each compiled with a name of their own for it,
 * as by -DIMPINGE_PLUGIN_SYMBOL=seashell_plugin. */
#ifdef IMPINGE_PLUGIN_SYMBOL
#define IMP_LINKED_IN_
#else
#define IMPINGE_PLUGIN_SYMBOL impinge_plugin
#endif
extern IMP_EXPORT const imp_plugin IMPINGE_PLUGIN_SYMBOL;

/* The facts of imp_plugin for a host that has not run any code of the plugin yet: an ELF note,
 * owner "Impinge", type 1, descriptor: abi_major, abi_minor (32 bits each), then name and version,
 * NUL-terminated. Written by the assembler because compilers give the section the wrong type. */
#define IMP_NOTE_OWNER "Impinge"
#define IMP_NOTE_TYPE 1
#define IMP_TEXT_OF_(x) #x
#define IMP_TEXT_OF(x) IMP_TEXT_OF_(x)
#ifdef IMP_LINKED_IN_ /* nothing reads a program's notes */
#define IMP_NOTE_(NAME, VERSION) extern const imp_plugin IMPINGE_PLUGIN_SYMBOL
#else
#define IMP_NOTE_(NAME, VERSION)                                                                   \
    __asm__(".pushsection .note.impinge,\"a\",%note\n"                                             \
            "\t.balign 4\n"                                                                        \
            "\t.long 771f-770f, 773f-772f, " IMP_TEXT_OF(                                          \
                IMP_NOTE_TYPE) "\n"                                                                \
                               "770:\t.asciz \"" IMP_NOTE_OWNER "\"\n"                             \
                               "771:\t.balign 4\n"                                                 \
                               "772:\t.long " IMP_TEXT_OF(IMP_ABI_MAJOR) ", " IMP_TEXT_OF(         \
                                   IMP_ABI_MINOR_TARGET) "\n"                                      \
                                                         "\t.asciz \"" NAME "\"\n"                 \
                                                         "\t.asciz \"" VERSION "\"\n"              \
                                                         "773:\t.balign 4\n"                       \
                                                         "\t.popsection\n")
#endif

/* Defines the plugin, once per shared object, at file scope. Strings are literals; GET_FACTORY
 * is a function as in imp_plugin. One type per file? See IMPINGE_SURFACE_PLUGIN below. */
#define IMPINGE_PLUGIN(NAME, VERSION, LICENSE, AUTHOR, GET_FACTORY)                                \
    IMP_NOTE_(NAME, VERSION);                                                                      \
    static const void *imp_find_factory_(const char *id)                                           \
    {                                                                                              \
        return imp_text_is_(id, IMP_BUILD_FACTORY) ? imp_build_facts_() : (GET_FACTORY)(id);       \
    }                                                                                              \
    const imp_plugin IMPINGE_PLUGIN_SYMBOL = {IMP_PLUGIN_MAGIC,                                    \
                                              (uint32_t)sizeof(imp_plugin),                        \
                                              IMP_ABI_MAJOR,                                       \
                                              IMP_ABI_MINOR_TARGET,                                \
                                              NAME,                                                \
                                              VERSION,                                             \
                                              LICENSE,                                             \
                                              AUTHOR,                                              \
                                              imp_find_factory_}

#define IMP_SINGLE_PLUGIN_(FACTORY, ID, NAME, VERSION, LICENSE, AUTHOR, TYPE)                      \
    static const FACTORY##_type *const imp_types_[] = {&(TYPE)};                                   \
    static const FACTORY##_factory imp_factory_ = {(uint32_t)sizeof(FACTORY##_factory), 1,         \
                                                   imp_types_};                                    \
    static const void *imp_get_factory_(const char *id)                                            \
    {                                                                                              \
        return imp_text_is_(id, ID) ? &imp_factory_ : NULL;                                        \
    }                                                                                              \
    IMPINGE_PLUGIN(NAME, VERSION, LICENSE, AUTHOR, imp_get_factory_)

/* A plugin of one surface type, or of one map: TYPE is the static const struct. */
#define IMPINGE_SURFACE_PLUGIN(NAME, VERSION, LICENSE, AUTHOR, TYPE)                               \
    IMP_SINGLE_PLUGIN_(imp_surface, IMP_SURFACE_FACTORY, NAME, VERSION, LICENSE, AUTHOR, TYPE)
#define IMPINGE_MAP_PLUGIN(NAME, VERSION, LICENSE, AUTHOR, TYPE)                                   \
    IMP_SINGLE_PLUGIN_(imp_map, IMP_MAP_FACTORY, NAME, VERSION, LICENSE, AUTHOR, TYPE)

/* --- Layout, frozen for version 1 on 64-bit machines ------------------------------------------ */

#ifdef __cplusplus
#define IMP_LAYOUT(cond) static_assert(cond, "layout of the surface ABI, version 1")
#else
#define IMP_LAYOUT(cond) _Static_assert(cond, "layout of the surface ABI, version 1")
#endif
IMP_LAYOUT(sizeof(double) == 8 && sizeof(void *) == 8 && sizeof(size_t) == 8);
IMP_LAYOUT(sizeof(imp_parameter) == 72 && offsetof(imp_parameter, kind) == 32);
IMP_LAYOUT(offsetof(imp_parameter, extent) == 44 && offsetof(imp_parameter, min) == 56);
IMP_LAYOUT(sizeof(imp_value) == 48 && offsetof(imp_value, number) == 32);
IMP_LAYOUT(sizeof(imp_create_error) == 536 && offsetof(imp_create_error, text) == 16);
IMP_LAYOUT(offsetof(imp_create_error, note_count) == 256 &&
           offsetof(imp_create_error, note) == 268);
IMP_LAYOUT(offsetof(imp_create_error, is_repeatable) == 512 &&
           offsetof(imp_create_error, goes_on) == 520 && offsetof(imp_create_error, reads) == 528);
IMP_LAYOUT(sizeof(imp_region) == 96 && offsetof(imp_region, c) == 48);
IMP_LAYOUT(sizeof(imp_box4) == 64);
IMP_LAYOUT(sizeof(imp_rate_matrix) == 72 && sizeof(imp_map_rates) == 96);
IMP_LAYOUT(sizeof(imp_model) == 136 && offsetof(imp_model, q) == 32);
IMP_LAYOUT(offsetof(imp_model, e) == 80 && offsetof(imp_model, rate) == 104);
IMP_LAYOUT(offsetof(imp_model, depends) == 128);
IMP_LAYOUT(sizeof(imp_net) == 2104 && offsetof(imp_net, place) == 16);
IMP_LAYOUT(offsetof(imp_net, error) == 64 && offsetof(imp_net, point) == 88);
IMP_LAYOUT(offsetof(imp_net, velocity) == 952 && offsetof(imp_net, weight) == 1816);
IMP_LAYOUT(sizeof(imp_text_sink) == 24 && offsetof(imp_text_sink, add) == 16);
IMP_LAYOUT(sizeof(imp_surface_type) == 184 && offsetof(imp_surface_type, name) == 16);
IMP_LAYOUT(offsetof(imp_surface_type, create) == 64 && offsetof(imp_surface_type, include) == 104);
IMP_LAYOUT(offsetof(imp_surface_type, net) == 112);
IMP_LAYOUT(offsetof(imp_surface_type, piece_count) == 120);
IMP_LAYOUT(offsetof(imp_surface_type, distance) == 136);
IMP_LAYOUT(offsetof(imp_surface_type, symmetry) == 144);
IMP_LAYOUT(offsetof(imp_surface_type, formula) == 152);
IMP_LAYOUT(offsetof(imp_surface_type, write_formula) == 160);
IMP_LAYOUT(offsetof(imp_surface_type, renew) == 168);
IMP_LAYOUT(offsetof(imp_surface_type, tube) == 176);
IMP_LAYOUT(sizeof(imp_tube) == 416 && offsetof(imp_tube, radius) == 408);
IMP_LAYOUT(sizeof(imp_pose) == 1680 && offsetof(imp_pose, shift) == 1224);
IMP_LAYOUT(offsetof(imp_pose, pivot) == 1632 && offsetof(imp_pose, fixed) == 1656);
IMP_LAYOUT(sizeof(imp_symmetry) == 56 && offsetof(imp_symmetry, center) == 8);
IMP_LAYOUT(sizeof(imp_map_type) == 168 && offsetof(imp_map_type, name) == 16);
IMP_LAYOUT(offsetof(imp_map_type, create) == 64 && offsetof(imp_map_type, apply) == 104);
IMP_LAYOUT(offsetof(imp_map_type, net) == 112 && offsetof(imp_map_type, rigid) == 120);
IMP_LAYOUT(offsetof(imp_map_type, span) == 128);
IMP_LAYOUT(offsetof(imp_map_type, formula) == 136);
IMP_LAYOUT(offsetof(imp_map_type, write_formula) == 144);
IMP_LAYOUT(offsetof(imp_map_type, parts) == 152);
IMP_LAYOUT(offsetof(imp_map_type, renew) == 160);
IMP_LAYOUT(sizeof(imp_surface_factory) == 16 && sizeof(imp_map_factory) == 16);
IMP_LAYOUT(sizeof(imp_plugin) == 56 && offsetof(imp_plugin, name) == 16);
IMP_LAYOUT(offsetof(imp_plugin, get_factory) == 48);

#ifdef __cplusplus
}
#endif

#endif /* IMPINGE_SURFACE_H */
