/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_PART_H
#define CORE_SURFACE_PART_H

#include <impinge/impinge.h>

/* Instances of types, shared
 * ==========================
 * A part is what one call of a type's create made: a surface without maps, or a map. Surfaces are
 * composed of parts; one part may be in many of them, and is destroyed with its last holder.
 * Immutable once it is in use, but for the count of holders, which belongs to one thread. */

enum { PART_LABEL_MAX = 240 };

typedef struct shared_part {
    const imp_surface_type *surface; /* NULL: it is a map */
    const imp_map_type *map;         /* NULL: it is a surface */
    void *self;
    size_t holders;
    double lo[3], hi[3]; /* a surface's domain; of a map, the times alone: [2] */
    const void **pieces; /* instances that `self` owns, in place of it; NULL: it is one surface */
    size_t piece_count;  /* 0: it is one surface */
    imp_status breach;   /* IMP_OK, or for surface_status_text: how the domain breaks the ABI;
                                   then the part may only be released */
    size_t given;        /* bytes of the values it was made from: about what the instance keeps */
    char *label; /* as on a command line, shortened: "sphere radius=2"; NULL: its type's name */
    size_t label_size; /* bytes of it, its end included */
} shared_part;

/* Takes over the instance `self`, and asks for its domain, or those of its pieces, which have their
 * times in common, and of which `lo` and `hi` are the first's; the caller holds the part. NULL: no
 * memory; the instance is destroyed then too. */
shared_part *part_of_surface(const imp_surface_type *type, void *self);
shared_part *part_of_map(const imp_map_type *type, void *self);

/* Whether instances of the type may consist of pieces. */
bool part_offers_pieces(const imp_surface_type *type);

/* Whether the map says that it is rigid (imp_pose). */
bool part_offers_pose(const imp_map_type *type);

/* Whether the type knows distances from its instances. */
bool part_offers_distance(const imp_surface_type *type);

/* Whether the type may know how its instances can be moved within themselves. */
bool part_offers_symmetry(const imp_surface_type *type);

/* The domain of an instance; IMP_OK, or how it breaks the ABI. */
imp_status part_domain(const imp_surface_type *type, const void *self, double lo[3], double hi[3]);

/* Appends to a label, or dots in its place: at the end of a label that is full. */
void part_label_add(char label[PART_LABEL_MAX], const char *text);

/* Copies the label, once. False: no memory. */
bool part_set_label(shared_part *p, const char label[PART_LABEL_MAX]);
const char *part_label(const shared_part *p);

/* What the part and its instance hold, about: each block with what the allocator adds. */
enum { PART_BLOCK = 16 }; /* bytes */
size_t part_bytes(const shared_part *p);

shared_part *part_hold(shared_part *p);
void part_release(shared_part *p); /* NULL is no shared_part */

/* Parts in order, each held once for every time it stands there. */
typedef struct part_list {
    shared_part **at;
    size_t count, capacity;
} part_list;

bool part_list_add(part_list *list, shared_part *p); /* holds p; false: no memory */
bool part_list_add_all(part_list *list, const part_list *more);
void part_list_clear(part_list *list);

#endif
