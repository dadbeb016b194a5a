/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_INSTANCE_H
#define CORE_SURFACE_INSTANCE_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>

#include <impinge/impinge.h>

/* Instances of types, shared
 * ==========================
 * An instance is what one call of a type's create made: a surface without maps, or a map. Surfaces
 * are composed of instances; one instance may be in many surfaces, of several scenes, and is
 * destroyed with its last holder. What other parts make of it once for all holders is on its shelf.
 * It is immutable once in use, except for the shelf and the reference count; several threads may
 * hold, release and use it at once. */

enum { INSTANCE_LABEL_MAX = 240 };

/* The numbers that an instance was made from, for a formula that names parameters: those of rows
 * with a fixed shape, in the table's order, NaN where absent. */
typedef struct fixed_numbers {
    const imp_parameter *rows; /* the type's table */
    size_t row_count, stride;  /* 0 rows: the type has no formula */
    size_t count;
    double *number;
} fixed_numbers;

/* What was made of an instance for all of its holders, each under a hold of its own: the last few,
 * the newest first. They are released with the instance, or when newer ones take their places. */
enum { INSTANCE_KEPT_MAX = 4 };
typedef struct instance_kept {
    void *what; /* NULL: no more */
    void (*release)(void *what);
} instance_kept;
typedef struct instance_shelf {
    pthread_mutex_t lock; /* guards all of it */
    instance_kept kept[INSTANCE_KEPT_MAX];
} instance_shelf;

/* What an instance was made from; equal descriptions are of equal instances of a type. */
typedef struct instance_description {
    uint64_t hash; /* of the bytes */
    size_t size;   /* their count */
    unsigned char bytes[];
} instance_description;

/* An argument that the label of an instance shows when it is read. */
typedef struct label_argument {
    const char *name; /* outlives the instance */
    size_t count;     /* of its numbers; 0: its value is too long, or rows, and shown as dots */
} label_argument;

/* What a label is written from: the arguments, and the numbers of all of them. */
typedef struct label_arguments {
    label_argument *at; /* `count` of them; the numbers follow */
    size_t count;
    size_t room; /* bytes there */
} label_arguments;

typedef struct shared_instance {
    const imp_surface_type *surface; /* NULL: it is a map */
    const imp_map_type *map;         /* NULL: it is a surface */
    void *self;
    _Atomic(size_t) holders;
    double lo[3], hi[3]; /* a surface's domain; of a map only the times, [2] */
    double span[2];      /* times it is made for; -INFINITY, INFINITY: not stated */
    const void **pieces; /* instances that `self` owns and that replace it; NULL: one surface */
    size_t piece_count;  /* 0: one surface */
    size_t piece_room;   /* pieces that there is memory for */
    imp_status breach;   /* other than IMP_STATUS_OK: its domain breaks the ABI, only release it */
    uint32_t clock;      /* if there is an `inner`: the index of its parameter in the scene */
    size_t given;        /* bytes of the values and files it was made from, about what it keeps */
    char *label; /* as on a command line, shortened: "sphere radius=2"; NULL: write it when read */
    label_arguments named; /* from these, behind its type's name */
    uint64_t note_count;   /* number of items that create left out or reinterpreted; 0: no note */
    char *note;            /* the items, with the parameter's name; NULL: none */
    fixed_numbers numbers; /* for its formula */
    instance_shelf *shelf; /* of a surface that has, or had, several pieces; else NULL */
    instance_description *description; /* of a map that reads no file; else NULL */
    /* Under the clock of a scene parameter (clocked.h); held. NULL: it follows time. */
    struct shared_instance *inner;
} shared_instance;

/* Take ownership of the instance `self` and get its domain, or those of its pieces, which have the
 * same times; `lo` and `hi` are then the first piece's. The caller holds the result. NULL: no
 * memory, and the instance is destroyed. */
shared_instance *instance_of_surface(const imp_surface_type *type, void *self);
shared_instance *instance_of_map(const imp_map_type *type, void *self);

/* Takes over an instance that its type has just refilled, and that nobody else holds: like
 * instance_of_surface and instance_of_map of one that is new, in the memory that it has. What was
 * said of its old values is gone, but for room. */
shared_instance *instance_renewed(shared_instance *p);

/* Takes the numbers for its formula away, whose array then holds those of other values. */
fixed_numbers instance_take_numbers(shared_instance *p);

/* Gets the domain of an instance. Returns IMP_STATUS_OK, or how the domain breaks the ABI. */
imp_status instance_domain(const imp_surface_type *type, const void *self, double lo[3],
                           double hi[3]);

/* Appends text to a label, or dots where the label is full. */
void instance_label_add(char label[INSTANCE_LABEL_MAX], const char *text);

/* One parameter of a label, " radius=2": it begins with the name, of which 40 bytes; the value is
 * written to `at` + `head`; it ends with "..." in the value's place where that does not fit. */
enum { LABEL_PART_MAX = 120 };
typedef struct label_part {
    char at[LABEL_PART_MAX];
    size_t head;
} label_part;
void label_part_begin(label_part *part, const char *name);
void label_part_end(label_part *part, bool fits, char label[INSTANCE_LABEL_MAX]);

/* Copies the label, once. False: no memory. */
bool instance_set_label(shared_instance *p, const char label[INSTANCE_LABEL_MAX]);

/* Makes room for what a label is to be written from; *number is where the numbers go. An instance
 * that is filled again has its room already. False: no memory. */
bool instance_name_arguments(shared_instance *p, size_t count, size_t numbers, double **number);

/* Writes the label. */
void instance_label(const shared_instance *p, char label[INSTANCE_LABEL_MAX]);

/* Copies a note of create, once: `count` items, described by the text. False: no memory. */
bool instance_set_note(shared_instance *p, uint64_t count, const char *text);

/* Sets the hash of the description, whose bytes are written. */
void instance_hash_description(instance_description *description);

/* Whether two maps are of one type and have equal descriptions. */
bool instance_is_equal_map(const shared_instance *x, const shared_instance *y);

/* Returns how many numbers a row has: 0 if its shape is not fixed, or it has none. */
size_t fixed_numbers_of_row(const imp_parameter *row);

const imp_parameter *fixed_numbers_row(const fixed_numbers *numbers, size_t k);

/* Copies the numbers from the values, one value for each row. If to->number is not NULL, its array
 * is that of the same rows, and used again. False: no memory. */
bool fixed_numbers_copy(fixed_numbers *to, const imp_parameter *rows, size_t row_count,
                        size_t stride, const imp_value *values);

/* Estimates the bytes of the instance and of what create made, including the allocator's overhead
 * per block. Two that were made of equal values, as text or as numbers, have as many. */
enum {
    INSTANCE_BLOCK = 16, /* bytes */
    INSTANCE_PIECE = 96  /* bytes that a type keeps of one piece, as mesh does in growing arrays */
};
size_t instance_bytes(const shared_instance *p);

/* Puts what the caller holds onto the shelf, which takes over that hold. The lock is the
 * caller's. */
void instance_shelf_add(instance_shelf *shelf, instance_kept one);

/* Drops what other parts have made of it. Nobody else may hold it. */
void instance_clear_shelf(shared_instance *p);

shared_instance *instance_hold(shared_instance *p);

/* Whether the caller, who holds it, is its only holder. */
bool instance_is_own(const shared_instance *p);
void instance_release(shared_instance *p); /* p may be NULL */

/* A list of instances in order. It holds each instance once per occurrence. */
typedef struct instance_list {
    shared_instance **at;
    size_t count, capacity;
} instance_list;

bool instance_list_add(instance_list *list, shared_instance *p); /* holds p; false: no memory */
bool instance_list_add_all(instance_list *list, const instance_list *more);
void instance_list_clear(instance_list *list);

#endif
