/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_READER_CASE_READER_H
#define MOR_CASES_DRIVER_CASE_READER_CASE_READER_H

#include "cases/driver/case/schema/case_schema.h"
#include "core/base/units.h"
#include "core/io/case_file/case_file.h"

/** @file
 *  Values, names, shapes and files that the sections of a case are made of. Every error names the place in the file,
 *  what was found, what is allowed and what to do, and is MOR_ERROR_CONFIG. */

enum { MOR_CASE_MISTAKES_BYTES = 512, MOR_CASE_PROPOSALS_MAX = 16 };

/** A name that was proposed for one that a group does not have. Borrowed. */
typedef struct mor_case_proposal {
    const mor_case_node *group; /* with the name that is unknown */
    const char *name;           /* zero-terminated; a key of the group */
} mor_case_proposal;

/** Names that no group has: they are told together, for nothing else depends on them. Zero-initialized before use. */
typedef struct mor_case_mistakes {
    mor_context first;                    /* the error about the first of them */
    char others[MOR_CASE_MISTAKES_BYTES]; /* zero-terminated; a line about each of the others, a newline before each */
    int n;
    int n_untold;                                        /* of them, for which others had no room */
    mor_case_proposal proposals[MOR_CASE_PROPOSALS_MAX]; /* shape [n_proposals]; for those that are told */
    int n_proposals;
    bool ends_with_misspelled; /* what ended the reading is that one of them is missing */
} mor_case_mistakes;

/** State shared by all parts. */
typedef struct mor_case_reader {
    mor_context *context;
    const mor_units *units;
    const mor_registry *registry;
    mor_case_probe_catalog probe_types; /* NULL: there are none */
    int dimension;                      /* 2 or 3 */
    int scheme;                         /* index of the word of numerics.scheme */
    double spacing;                     /* m; 0 before it is read */
    mor_bounds domain;                  /* m; empty before it is read */
    mor_case_mistakes *mistakes;        /* NULL: the first ends the reading */
    double spread;                      /* largest over smallest size of what a shape is used for, 1; 0: of one size */
    int length_power;                   /* the scale of the case as powers of two */
    int time_power;
    int mass_power;
} mor_case_reader;

/** Reads the numbers of a real, vector, whole number, boolean or choice: unit, range and size checked, scaled.
 *  @param keeps_scale [in]   whether the scale of the case leaves it alone
 *  @param values      [out]  shape [schema->n_components]; unit: of the schema; a vector of two has z = 0
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_INTERNAL for a schema without sense. */
mor_status mor_case_reader_numbers(const mor_case_reader *reader, const mor_case_node *node, const mor_schema *schema,
                                   bool keeps_scale, double *values);

/** Multiplies values by the scale of the case, exactly.
 *  @param unit   [in]      zero-terminated; unit of the values
 *  @param values [in,out]  shape [n]; unit: as given
 *  @param n      [in]      number of values
 *  @param sign   [in]      1: multiply; -1: divide
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL when unit is none. */
mor_status mor_case_reader_scale(const mor_case_reader *reader, const char *unit, double *values, int n, int sign);

/** Reads all keys of a group into a record and fills in the constant defaults.
 *  @param node   [in]      NULL: a group that was not written
 *  @param group  [in]      its keys
 *  @param record [in,out]  of the struct that the group's offsets refer to
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_group(const mor_case_reader *reader, const mor_case_node *node, const mor_case_group *group,
                                 void *record);

/** Refuses names that a group does not have, or keeps them in the mistakes of the reader.
 *  @param node   [in]  NULL is accepted
 *  @param extra  [in]  zero-terminated name allowed besides; NULL: none
 *  @param more   [in]  table ended by key NULL of keys allowed besides; NULL: none
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with the nearest name. */
mor_status mor_case_reader_names(const mor_case_reader *reader, const mor_case_node *node, const mor_case_group *group,
                                 const char *extra, const mor_schema *more);

/** Makes one error of the mistakes of a reader and of what ended its reading.
 *  @param status [in]  of the reading
 *  Returns: status when there are no mistakes; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_finish(const mor_case_reader *reader, mor_status status);

/** Finds a member that must exist and be of a kind.
 *  @param name   [in]   zero-terminated
 *  @param kind   [in]   the kind it must be of
 *  @param child  [out]  one pointer; borrowed
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_member(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                  mor_case_node_kind kind, const mor_case_node **child);

/** Finds a list of groups; checks that it is not empty nor too long and holds groups only.
 *  @param name   [in]   zero-terminated
 *  @param n_max  [in]   most entries
 *  @param list   [out]  one pointer; borrowed; NULL when it was not written
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_list(const mor_case_reader *reader, const mor_case_node *root, const char *name, int n_max,
                                const mor_case_node **list);

/** Refuses a word that is none of a list, proposing the nearest.
 *  @param node    [in]  holds the word
 *  @param what    [in]  zero-terminated; what the words are: "type of shape"
 *  @param words   [in]  shape [n_words] of zero-terminated strings
 *  @param n_words [in]  number of words
 *  Returns: MOR_ERROR_CONFIG. */
mor_status mor_case_reader_refuse(const mor_case_reader *reader, const mor_case_node *node, const char *what,
                                  const char *const *words, int n_words);

/** Refuses a group for what it lacks. Not told when it is there under a misspelled name, which is.
 *  @param group   [in]  that lacks it
 *  @param name    [in]  zero-terminated; what it lacks
 *  @param allowed [in]  zero-terminated; what may be written
 *  Returns: MOR_ERROR_CONFIG. */
mor_status mor_case_reader_refuse_missing(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                          const char *allowed);

/** Notes where a setting was written. */
void mor_case_reader_place(const mor_case_node *node, mor_case_place *place);

/** Whether a key was written.
 *  @param written [in]  the group's mask
 *  @param name    [in]  zero-terminated; a key of the group */
bool mor_case_reader_has(const mor_case_group *group, uint64_t written, const char *name);

/** Reads a shape and builds it.
 *  @param outline [out]  zeroed before; owned by the case; mor_case_shape_clear frees it, after a
 *                        failure, too
 *  @param shape   [out]  one pointer; owned by the case; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_shape(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline,
                                 mor_shape **shape);

/** What reads a shape, as mor_case_reader_shape does. */
typedef mor_status (*mor_case_shape_reader)(const mor_case_reader *reader, const mor_case_node *node,
                                            mor_case_shape *outline, mor_shape **shape);

/** Builds a terrain, a release or posts: reads the raster they lie on.
 *  @param node    [in]      the shape's group
 *  @param read_shape [in]   reads the wall that is the ground
 *  @param outline [in,out]  its keys and points are read; file and thickness are completed
 *  @param shape   [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_ground(const mor_case_reader *reader, const mor_case_node *node,
                                  mor_case_shape_reader read_shape, mor_case_shape *outline, mor_shape **shape);

/** Finds a file by its path from the folder of the case file.
 *  @param node   [in]      the group that names the file
 *  @param what   [in]      zero-terminated; what the file is, for messages: "a mesh"
 *  @param file   [in,out]  shape [MOR_CASE_TEXT_BYTES]; zero-terminated; becomes absolute, so that a copy of the case
 *                          elsewhere finds it
 *  @param hash   [out]     one number; of the content
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_locate(const mor_case_reader *reader, const mor_case_node *node, const char *what,
                                  char *file, uint64_t *hash);

/** Builds a mesh, an outline or a rock: reads its file or draws it.
 *  @param node    [in]      the shape's group
 *  @param outline [in,out]  its keys are read; file is completed
 *  @param shape   [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_form(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline,
                                mor_shape **shape);

/** Refuses a vector that leaves the plane in plane strain.
 *  @param group  [in]  the vector's group
 *  @param name   [in]  zero-terminated; the vector's key
 *  @param vector [in]  shape [3]; any unit
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_in_plane(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                    const double *vector);

/** Refuses an axis or an angular velocity that is not normal to the plane in plane strain.
 *  @param group  [in]  the vector's group
 *  @param name   [in]  zero-terminated; the vector's key
 *  @param vector [in]  shape [3]; any unit
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_out_of_plane(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                        const double *vector);

/** Refuses a name that is taken.
 *  @param group  [in]  has the name again
 *  @param name   [in]  zero-terminated
 *  @param first  [in]  where the name was taken
 *  Returns: MOR_ERROR_CONFIG. */
mor_status mor_case_reader_refuse_duplicate(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                            const mor_case_place *first);

/** Places a body that is to have a height over the ground: changes its position along gravity alone.
 *  @param the_case [in]      its walls, soil, domain and gravity are read
 *  @param body     [in,out]  whole
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when there is no ground below it; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_height(const mor_case_reader *reader, const mor_case *the_case, mor_case_body *body);

#endif
