/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_SCHEMA_CASE_SCHEMA_H
#define MOR_CASES_DRIVER_CASE_SCHEMA_CASE_SCHEMA_H

#include "cases/driver/case/case.h"
#include "core/base/schema.h"
#include "core/material/registry.h"

#include <stddef.h>
#include <stdio.h>

/** @file
 *  The language of case files as tables: every key with its type, unit, default, bounds, text, and the member of
 *  struct mor_case it fills. Reading, writing and the printed reference all walk these tables. */

/** How a value is stored. */
typedef enum mor_case_storage {
    MOR_CASE_STORE_REALS, /* double [n_components] */
    MOR_CASE_STORE_INT,   /* int */
    MOR_CASE_STORE_SEED,  /* uint64_t */
    MOR_CASE_STORE_BOOL,  /* bool */
    MOR_CASE_STORE_TEXT,  /* char [size], any text */
    MOR_CASE_STORE_NAME,  /* char [size]; letters, digits, '_' and '-' */
    MOR_CASE_STORE_WORD,  /* char [size]; the word of a choice */
    MOR_CASE_STORE_CHOICE /* int or enum; the index of the word */
} mor_case_storage;

/** What a key may need to have an effect. */
enum {
    MOR_CASE_NEEDS_SOIL = 1,
    MOR_CASE_NEEDS_BODIES = 2,
    MOR_CASE_NEEDS_ELASTIC = 4,
    MOR_CASE_NEEDS_WALLS = 8,
    MOR_CASE_NEEDS_GRAVITY = 16,
    MOR_CASE_NEEDS_ARTIFICIAL = 32,
    MOR_CASE_NEEDS_DIFFUSION = 64,
    MOR_CASE_NEEDS_DISSIPATION = 128,
    MOR_CASE_NEEDS_BARRIER = 256,
    MOR_CASE_NEEDS_ROTATION = 512,
    MOR_CASE_NEEDS_BODY_ROTATION = 1024,
    MOR_CASE_NEEDS_STIFF_SPRING = 2048,
    MOR_CASE_NEEDS_COMPLIANCE = 4096,
    MOR_CASE_NEEDS_RAMP = 8192,
    MOR_CASE_NEEDS_HOURGLASS = 16384,
    MOR_CASE_NEEDS_LATTICE = 32768,
    MOR_CASE_NEEDS_SUM = 65536,
    MOR_CASE_NEEDS_ANGULAR = 131072,
    MOR_CASE_NEEDS_DAMPING = 262144,
    MOR_CASE_NEEDS_SLEEP = 524288
};

/** One key. A table ends with schema.key NULL. */
typedef struct mor_case_key {
    mor_schema schema; /* of a choice, default_value is the index of the word */
    mor_case_storage storage;
    size_t offset;          /* of the member in the record, bytes */
    size_t size;            /* of the member, bytes */
    const char *computed;   /* words for a default that depends on other values; NULL: default_value */
    bool is_direction;      /* a vector whose length means nothing, and which may not be zero */
    bool keeps_scale;       /* not simulated time, so that the scale of the case does not touch it */
    bool shares_member;     /* another key fills the same member: left alone when this one is not written */
    const char *former;     /* name in earlier versions, which works with a warning; NULL: none */
    bool has_schemes;       /* the default depends on numerics.scheme: default_value, or zhang2024 */
    double zhang2024;       /* default with scheme = "zhang2024" */
    const char *unit_plane; /* in plane strain, per meter of thickness; NULL: the same as in space */
    unsigned needs;         /* MOR_CASE_NEEDS_ bits without which it has no effect */
} mor_case_key;

/** A key that holds a group or a list of its own. A table ends with name NULL. */
typedef struct mor_case_part {
    const char *name; /* as written in the case file */
    bool is_required;
    const char *form; /* what the value looks like */
    const char *text; /* one line for people */
} mor_case_part;

/** One group of keys. */
typedef struct mor_case_group {
    const char *name; /* as written in the case file; of a shape, its type */
    const char *text; /* one line for people */
    const mor_case_key *keys;
    const mor_case_part *parts; /* NULL: none */
    size_t written_offset;      /* of the member `written` in the record, bytes */
} mor_case_group;

/** The group of the top level; its record is mor_case. */
extern const mor_case_group mor_case_root_group;

/** Groups directly below the top whose record is mor_case; ends with name NULL. */
extern const mor_case_group mor_case_settings_groups[];

/** Members of the list bodies, and the groups of a body; record mor_case_body. */
extern const mor_case_group mor_case_body_group, mor_case_body_material_group, mor_case_spring_group,
    mor_case_start_group;

/** The group contact and the members of its list pairs; records mor_case_contact and mor_case_contact_pair. */
extern const mor_case_group mor_case_contact_group, mor_case_pair_group;

enum { MOR_CASE_LOCKS = 6 };

/** Words of the member locked of a body, in the order of mor_case_body.is_locked. */
extern const char *const mor_case_lock_words[MOR_CASE_LOCKS];

/** Models of bodies that do not deform and have no material, one for each such kind; ends with NULL. */
extern const char *const mor_case_rigid_words[];

/** Members of the lists soil, walls, gauges, probes and expect, and the groups of a soil; records mor_case_soil,
 *  mor_case_wall, mor_case_gauge, mor_case_probe, mor_case_expectation. */
extern const mor_case_group mor_case_soil_group, mor_case_material_group, mor_case_stress_group, mor_case_wall_group,
    mor_case_gauge_group, mor_case_probe_group, mor_case_expectation_group;

/** Members of the list fields of a soil; record mor_case_field. */
extern const mor_case_group mor_case_field_group;

/** The group path of walls and bodies, and the members of its list table; records mor_case_path and
 *  mor_case_path_row. */
extern const mor_case_group mor_case_path_group, mor_case_path_row_group;

/** A row of a path while it is read. */
typedef struct mor_case_path_row {
    mor_motion_row row;
    uint64_t written;
} mor_case_path_row;

/** Largest speed that a path gives a shape, about; where the shape is unbounded, within the domain.
 *  @param the_case [in]  its domain
 *  @param path     [in]  zero speed without rows
 *  @param shape    [in]  in the frame of the case, or of a body
 *  Returns: unit m/s. */
double mor_case_path_speed(const mor_case *the_case, const mor_case_path *path, const mor_shape *shape);

/** The group maps; record mor_case_maps. */
extern const mor_case_group mor_case_maps_group;

/** Members of the list friction_with of walls, bodies and rocks; record mor_case_soil_friction. */
extern const mor_case_group mor_case_friction_group;

/** The group material of a soil whose model is an interface to laws of other programs; record mor_case_soil. */
extern const mor_case_group mor_case_external_group;

/** One group per kind of shape, in the order of mor_case_shape_kind; record mor_case_shape. */
extern const mor_case_group mor_case_shape_groups[MOR_CASE_SHAPE_COUNT];

/** Keys and parts of the shapes of the ground, which mor_case_shape_groups lists; record mor_case_shape. */
extern const mor_case_key mor_case_terrain_keys[], mor_case_release_keys[], mor_case_posts_keys[];
extern const mor_case_part mor_case_release_parts[], mor_case_posts_parts[];

/** Keys of the shapes of rocks, likewise. */
extern const mor_case_key mor_case_mesh_keys[], mor_case_outline_keys[], mor_case_rock_keys[];

/** Members of the list rocks, and of its list sizes; records mor_case_rocks and mor_case_size. */
extern const mor_case_group mor_case_rocks_group, mor_case_size_group;

enum { MOR_CASE_ROCK_FORM_COUNT = 5 };

/** Members of the list forms of rocks, one group per type, and the kinds of shape they make; record mor_case_shape. */
extern const mor_case_group mor_case_rock_form_groups[MOR_CASE_ROCK_FORM_COUNT];
extern const mor_case_shape_kind mor_case_rock_form_kinds[MOR_CASE_ROCK_FORM_COUNT];

/** Returns the group of the form that makes a kind of shape.
 *  @param kind [in]  one of mor_case_rock_form_kinds */
const mor_case_group *mor_case_rock_form_group(mor_case_shape_kind kind);

/** A column that a series of results has beside its probes. A table ends with name NULL. */
typedef struct mor_case_own_column {
    const char *name, *unit;
} mor_case_own_column;
extern const mor_case_own_column mor_case_own_columns[];

/** Names of the keys that MOR_CASE_PROBE_ bits stand for, in the order of the bits; ends with NULL. */
extern const char *const mor_case_probe_key_names[];

/** Returns a type of probe, or NULL.
 *  @param catalog [in]  the types there are; NULL: none
 *  @param name    [in]  zero-terminated */
const mor_case_probe_type *mor_case_probe_type_find(mor_case_probe_catalog catalog, const char *name);

/** Returns the MOR_CASE_PROBE_ bits of the keys a type requires: in plane strain the axis of a rotation is known.
 *  @param dimension [in]  2 or 3 */
unsigned mor_case_probe_required(const mor_case_probe_type *type, int dimension);

/** Returns the key that leaves one of a probe without effect, a static string: a path takes the place of a line through
 *  the origin, a region that of what is around the origin; NULL: none.
 *  @param key        [in]  zero-terminated name of a key
 *  @param has_path   [in]  whether the probe has a path
 *  @param has_region [in]  whether it has a region */
const char *mor_case_probe_replacement(const mor_case_probe_type *type, const char *key, bool has_path,
                                       bool has_region);

/** Writes the names of the keys that a type takes: "name, type, origin, window".
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut where it is too long
 *  @param text_bytes [in]   size of text */
void mor_case_probe_list_keys(const mor_case_probe_type *type, char *text, size_t text_bytes);

/** Returns the SI unit of a probe's value.
 *  @param dimension [in]  2 or 3 */
const char *mor_case_probe_unit(const mor_case_probe_type *type, int dimension);

/** Returns the SI unit of the impulse of a probe, or NULL when it is no force.
 *  @param dimension [in]  2 or 3 */
const char *mor_case_probe_impulse_unit(const mor_case_probe_type *type, int dimension);

/** Words for mor_case_statistic, in its order, as a list of choices. */
extern const char mor_case_statistic_words[];

/** Returns the SI unit of a statistic of a probe; NULL for the impulse of what is no force.
 *  @param statistic [in]  which
 *  @param dimension [in]  2 or 3 */
const char *mor_case_statistic_unit(const mor_case_probe_type *type, mor_case_statistic statistic, int dimension);

/** Whether a body is of a kind that does not deform. */
bool mor_case_body_is_rigid(const mor_case_body *body);

/** Tells what a key or a group of a body needs to have an effect.
 *  @param body [in]  model and motion are known
 *  @param name [in]  zero-terminated; of a key or a part of mor_case_body_group
 *  Returns: NULL when it has an effect on this body, else words that say with what it would. */
const char *mor_case_body_condition(const mor_case_body *body, const char *name);

/** Tells what a key of the start of a body needs to have an effect.
 *  @param motion [in]  kind of start
 *  @param name   [in]  zero-terminated; a key of mor_case_start_group
 *  Returns: NULL when it has an effect, else words that say with what it would. */
const char *mor_case_start_condition(mor_case_motion motion, const char *name);

/** Largest of the speeds at the start of bodies, walls and soil and of a fall through the domain; where there is none,
 *  what crosses the domain before the end.
 *  @param the_case [in]  whole
 *  Returns: unit m/s; > 0. */
double mor_case_largest_speed(const mor_case *the_case);

/** Largest of the speeds at the start of bodies and walls.
 *  @param the_case [in]  whole
 *  Returns: unit m/s. */
double mor_case_start_speed(const mor_case *the_case);

/** Young's modulus of a body's surface in contact: the one given, else that of a rigid body in which sound travels at
 *  1000 m/s. It depends on the body alone.
 *  @param the_case [in]  its units
 *  @param body     [in]  of the case
 *  Returns: unit Pa; > 0. */
double mor_case_contact_modulus(const mor_case *the_case, const mor_case_body *body);

/** Returns the default of a key that is no text, unit: of its schema.
 *  @param scheme [in]  index of a word of numerics.scheme */
double mor_case_key_default(const mor_case_key *key, int scheme);

/** Schema of a key with the unit it has in this dimension.
 *  @param dimension [in]  2 or 3 */
mor_schema mor_case_key_schema(const mor_case_key *key, int dimension);

/** Returns the place of a key in a table, or -1.
 *  @param keys [in]  table ended by schema.key NULL
 *  @param name [in]  zero-terminated */
int mor_case_key_find(const mor_case_key *keys, const char *name);

/** Prints the keys and parts of a group as a table in Markdown, under a heading.
 *  @param level  [in]      of the heading, 1 to 4
 *  @param type   [in]      zero-terminated; word of the key type, which a shape has beside its keys; NULL: none
 *  @param stream [in,out]  one open stream, to be checked by the caller */
void mor_case_schema_print_group(const mor_case_group *group, int level, const char *type, FILE *stream);

/** Prints the reference of case files in Markdown: every key of every group and every model.
 *  @param registry [in]      the models to list
 *  @param stream   [in,out]  one open stream, to be checked by the caller */
void mor_case_schema_print(const mor_registry *registry, mor_case_probe_catalog probe_types, FILE *stream);

#endif
