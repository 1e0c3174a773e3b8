/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"

#include "cases/driver/case/schema/case_schema_words.h"
#include "core/particle/field.h"

#include <math.h>
#include <string.h>

/* Entries follow mor_schema: key, kind, components, unit, required, default, range, choices, text. */

/* ---- The top level and the groups that set one thing each -------------------------------------------------------- */

static const mor_case_key root_keys[] = {
    {{"title", WORDS, "1", DEFAULT(0.0), ANY, NULL, "one line that names the case in pictures and reports"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case, title)},
    {{"dimension", WHOLE, "1", REQUIRED, BETWEEN(2.0, 3.0), NULL, "2: plane strain in x and y; 3: three dimensions"},
     MOR_CASE_STORE_INT,
     AT(mor_case, dimension)},
    {{"spacing", SCALAR, "m", REQUIRED, POSITIVE, NULL, "distance between particles"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, spacing)},
    {{"end", SCALAR, "s", REQUIRED, POSITIVE, NULL, "simulated time"}, MOR_CASE_STORE_REALS, AT(mor_case, end)},
    {{"gravity", VECTOR, "m/s2", REQUIRED, ANY, NULL, "acceleration by gravity"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, gravity)},
    {{"start_from", WORDS, "1", DEFAULT(0.0), ANY, NULL,
      "folder of a run whose last state this one starts from, as a stage of construction: soils of the same name with "
      "their stress and state, and the same bodies; path from the folder of the case file"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case, stage.run)},
    {{"seed", WHOLE, "1", DEFAULT(1.0), NOT_NEGATIVE, NULL, "seed of all random numbers"},
     MOR_CASE_STORE_SEED,
     AT(mor_case, seed)},
    END};

static const mor_case_part root_parts[] = {
    {"plugins", false, "list of texts",
     "shared objects with material models, which materials may then name; paths from the folder of the case file. A "
     "plug-in is a program: load only what you trust"},
    {"domain", true, "group", "computational domain, a box; see outflow for soil that leaves it"},
    {"lattice", false, "group", "lattice of the initial positions of soil particles"},
    {"placement", false, "group", "rotation and translation of the whole scene, gravity included"},
    {"scale", false, "group", "change of units of the whole case, to check that results do not depend on them"},
    {"excavate", false, "list of shapes", "with start_from: shapes whose soil is not taken over from the run"},
    {"soil", false, "list of groups", "soil regions; a case has soil, or bodies, or both"},
    {"walls", false, "list of groups", "solid walls"},
    {"bodies", false, "list of groups", "rocks, elastic or rigid"},
    {"rocks", false, "list of groups", "rocks packed at random into a region; each becomes a body"},
    {"contact", false, "group", "contact of bodies with bodies and walls"},
    {"numerics", false, "group", "settings of the numerical scheme"},
    {"gauges", false, "list of groups", "forces on structures, or on parts of them"},
    {"probes", false, "list of groups", "results to measure"},
    {"expect", false, "list of groups", "reference values that results are compared with"},
    {"maps", false, "group", "maps of depth, speed, arrival and deposit on a grid; in three dimensions"},
    {"output", false, "group", "what the run writes"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_case_root_group = {"", "Top level", root_keys, root_parts, offsetof(mor_case, written)};

static const mor_case_key domain_keys[] = {
    {{"min", VECTOR, "m", REQUIRED, ANY, NULL, "lowest corner"}, MOR_CASE_STORE_REALS, AT(mor_case, domain_minimum)},
    {{"max", VECTOR, "m", REQUIRED, ANY, NULL, "highest corner"}, MOR_CASE_STORE_REALS, AT(mor_case, domain_maximum)},
    {{"outflow", CHOICE, "1", DEFAULT(0.0), ANY, "stop|remove",
      "soil that leaves the domain; stop: ends the run with an error; remove: is removed, and its mass, momentum and "
      "energy are counted; rocks that leave always end the run with an error"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case, outflow)},
    {{"periodic", CHOICE, "1", DEFAULT(0.0), ANY, "none|x|y|z|xy|yz|xz|xyz",
      "axes along which the domain repeats itself: soil that leaves through one face comes in through the other and "
      "sees what is there, walls continue; the extent along them is a whole number of spacings"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case, periodic),
     .needs = MOR_CASE_NEEDS_SOIL},
    END};

static const mor_case_key lattice_keys[] = {
    {{"origin", VECTOR, "m", DEFAULT(0.0), ANY, NULL,
      "a corner of a lattice cell; particles lie at the centers of cells"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, lattice_origin),
     .needs = MOR_CASE_NEEDS_SOIL},
    {{"pattern", CHOICE, "1", DEFAULT(0.0), ANY, "square|polar",
      "square: nodes of a square or cubic lattice; polar: rings about the line through origin along z, the edges of a "
      "disc or annulus of whole spacings between them; a ring has a whole number of particles, so that its mass is off "
      "by up to 4.5 % near the line, 0.3 % from 25 spacings on"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case, lattice_pattern),
     .needs = MOR_CASE_NEEDS_SOIL | MOR_CASE_NEEDS_LATTICE},
    {{"jitter", SCALAR, "1", DEFAULT(0.0), BELOW(0.0, 0.5), NULL,
      "largest random displacement of particles along each axis / spacing"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, jitter_ratio),
     .needs = MOR_CASE_NEEDS_SOIL | MOR_CASE_NEEDS_LATTICE},
    END};

static const mor_case_key placement_keys[] = {
    {{"axis", VECTOR, "1", DEFAULT(NAN), ANY, NULL, "axis of the rotation, through the origin"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, placement_axis),
     .computed = "(0, 0, 1)",
     .is_direction = true,
     .needs = MOR_CASE_NEEDS_ROTATION},
    {{"angle", SCALAR, "rad", DEFAULT(0.0), ANY, NULL, "angle of the rotation, right-handed"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, placement_angle)},
    {{"translation", VECTOR, "m", DEFAULT(0.0), ANY, NULL, "translation after the rotation"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, translation),
     .former = "move"},
    END};

static const mor_case_key scale_keys[] = {
    {{"length", SCALAR, "1", DEFAULT(1.0), POSITIVE, NULL, "factor on all lengths; an even power of two"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, scale_length)},
    {{"time", SCALAR, "1", DEFAULT(1.0), POSITIVE, NULL, "factor on all times; an even power of two"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, scale_time)},
    {{"mass", SCALAR, "1", DEFAULT(1.0), POSITIVE, NULL, "factor on all masses; an even power of two"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, scale_mass)},
    END};

/* The settings of the scheme: rows of core/scheme/scheme.def become keys of the same name. */
#define SOIL MOR_CASE_NEEDS_SOIL
#define BODIES MOR_CASE_NEEDS_BODIES
#define ELASTIC MOR_CASE_NEEDS_ELASTIC
#define WALLS MOR_CASE_NEEDS_WALLS
#define GRAVITY MOR_CASE_NEEDS_GRAVITY
#define ARTIFICIAL MOR_CASE_NEEDS_ARTIFICIAL
#define DIFFUSION MOR_CASE_NEEDS_DIFFUSION
#define DISSIPATION MOR_CASE_NEEDS_DISSIPATION
#define BARRIER MOR_CASE_NEEDS_BARRIER
#define RAMP MOR_CASE_NEEDS_RAMP
#define HOURGLASS MOR_CASE_NEEDS_HOURGLASS
#define SUM MOR_CASE_NEEDS_SUM
#define ANGULAR MOR_CASE_NEEDS_ANGULAR
#define DAMPING MOR_CASE_NEEDS_DAMPING
#define SLEEP MOR_CASE_NEEDS_SLEEP
#define MOR_SETTING(type, storage, key, kind, unit, fallback, paper, words, need, computed_default, plane, text, ...)  \
    {{#key, MOR_SCHEMA_##kind, 1, unit, DEFAULT(fallback), __VA_ARGS__, words, text},                                  \
     MOR_CASE_STORE_##storage,                                                                                         \
     AT(mor_case, numerics.key),                                                                                       \
     .computed = (computed_default),                                                                                   \
     .unit_plane = (plane),                                                                                            \
     .has_schemes = true,                                                                                              \
     .zhang2024 = (paper),                                                                                             \
     .needs = (need)},
static const mor_case_key numerics_keys[] = {
#include "core/scheme/scheme.def"
    END};
#undef MOR_SETTING
#undef SOIL
#undef BODIES
#undef ELASTIC
#undef WALLS
#undef GRAVITY
#undef ARTIFICIAL
#undef DIFFUSION
#undef DISSIPATION
#undef BARRIER
#undef RAMP
#undef HOURGLASS
#undef SUM
#undef ANGULAR
#undef DAMPING

#define OUTPUT(member) AT(mor_case, output.member)
static const mor_case_key output_keys[] = {
    {{"snapshots", WHOLE, "1", DEFAULT(20.0), BETWEEN(0.0, 1.0e6), NULL,
      "number of snapshots after the first, evenly spaced in time"},
     MOR_CASE_STORE_INT,
     OUTPUT(n_snapshots)},
    {{"series_interval", SCALAR, "s", DEFAULT(NAN), POSITIVE, NULL, "simulated time between rows of series.csv"},
     MOR_CASE_STORE_REALS,
     OUTPUT(series_interval),
     .computed = "end / 200"},
    {{"checkpoint_seconds", SCALAR, "s", DEFAULT(60.0), POSITIVE, NULL, "wall time between checkpoints"},
     MOR_CASE_STORE_REALS,
     OUTPUT(checkpoint_seconds),
     .keeps_scale = true},
    {{"pictures", SWITCH, "1", DEFAULT(1.0), ANY, NULL, "whether pictures are drawn"},
     MOR_CASE_STORE_BOOL,
     OUTPUT(has_pictures)},
    {{"color", WORDS, "1", DEFAULT(NAN), ANY, NULL, "field that colors the particles of pictures"},
     MOR_CASE_STORE_NAME,
     OUTPUT(color_field),
     .computed = "speed"},
    {{"view", VECTOR, "1", DEFAULT(0.0), ANY, NULL,
      "direction from the scene to the camera; zero: chosen automatically"},
     MOR_CASE_STORE_REALS,
     OUTPUT(view)},
    {{"cut", SWITCH, "1", DEFAULT(0.0), ANY, NULL, "whether the part of the scene nearest to the camera is cut away"},
     MOR_CASE_STORE_BOOL,
     OUTPUT(has_cut)},
    END};

const mor_case_group mor_case_settings_groups[] = {
    {"domain", "Computational domain", domain_keys, NULL, offsetof(mor_case, written_domain)},
    {"lattice", "Lattice of the initial positions of soil particles", lattice_keys, NULL,
     offsetof(mor_case, written_lattice)},
    {"placement", "Rotation and translation of the whole scene", placement_keys, NULL,
     offsetof(mor_case, written_placement)},
    {"scale", "Change of units", scale_keys, NULL, offsetof(mor_case, written_scale)},
    {"numerics", "Settings of the numerical scheme", numerics_keys, NULL, offsetof(mor_case, written_numerics)},
    {"output", "What the run writes", output_keys, NULL, offsetof(mor_case, written_output)},
    {NULL, NULL, NULL, NULL, 0}};

/* ---- Soil and walls ---------------------------------------------------------------------------------------------- */

static const mor_case_key soil_keys[] = {
    {{"name", WORDS, "1", REQUIRED, ANY, NULL, "name of the region"}, MOR_CASE_STORE_NAME, AT(mor_case_soil, name)},
    {{"velocity", VECTOR, "m/s", DEFAULT(0.0), ANY, NULL, "initial velocity"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, velocity)},
    {{"released", SCALAR, "s", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "time until which the soil stands as it was placed, whatever pushes it; other soil and bodies feel it as soil at "
      "rest"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, released)},
    {{"particles", CHOICE, "1", DEFAULT(0.0), ANY, "lattice|relaxed",
      "how the shape is filled; lattice: with the nodes of the lattice; relaxed: with relaxed positions without its "
      "order, that follow surfaces, walls and bodies and hold the mass of the shape"},
     MOR_CASE_STORE_BOOL,
     AT(mor_case_soil, is_relaxed)},
    END};

static const mor_case_part soil_parts[] = {
    {"shape", true, "shape", "region to be filled with particles"},
    {"material", true, "group", "model, density, and the parameters of the model"},
    {"fields", false, "list of groups", "parameters that vary in space, by formulas or at random"},
    {"initial_stress", false, "group", "initial stress"},
    {"velocity_formula", false, "list of texts",
     "initial velocity in place of velocity: a formula of x, y, z (m) for each component (m/s), as (\"0.1*y\", \"0\")"},
    {NULL, false, NULL, NULL}};

static const mor_case_part stress_parts[] = {
    {"formula", false, "list of texts",
     "of type formula: the components xx, yy, zz, xy and in three dimensions yz, zx (Pa, tension positive) as formulas "
     "of x, y, z (m) in the frame of the case"},
    {NULL, false, NULL, NULL}};

#define MODEL_KEYS                                                                                                     \
    {{"model", WORDS, "1", REQUIRED, ANY, NULL, "name of the material model"},                                         \
     MOR_CASE_STORE_NAME,                                                                                              \
     AT(mor_case_soil, model)},                                                                                        \
    {                                                                                                                  \
        {"density", SCALAR, "kg/m3", REQUIRED, POSITIVE, NULL, "initial density"}, MOR_CASE_STORE_REALS,               \
            AT(mor_case_soil, density)                                                                                 \
    }
static const mor_case_key material_keys[] = {MODEL_KEYS, END};

static const mor_case_key external_keys[] = {
    MODEL_KEYS,
    {{"library", WORDS, "1", REQUIRED, ANY, NULL,
      "shared object with the law; path from the folder of the case file. It is a program: load only what you trust"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_soil, external.file)},
    {{"law", WORDS, "1", DEFAULT(NAN), ANY, NULL, "name of the law in the library; of a UMAT, what it gets as CMNAME"},
     MOR_CASE_STORE_NAME,
     AT(mor_case_soil, external.law),
     .computed = "of the interface"},
    END};

static const mor_case_part external_parts[] = {
    {"props", false, "list of numbers", "constants of the law, in its order and units (pascals, seconds)"},
    {"state", false, "list of texts", "names of its state variables, in order; \"q[6]\" names six numbers"},
    {"state_start", false, "list of numbers", "their initial values; those left out are zero"},
    {NULL, false, NULL, NULL}};

static const mor_case_key stress_keys[] = {
    {{"type", CHOICE, "1", DEFAULT(0.0), ANY, "none|k0|settled|uniform|formula",
      "none: zero; k0: vertical stress by the weight above, lateral stress by lateral_ratio; settled: as k0, then "
      "brought to rest before the start, as settle_method says; uniform: the same pressure everywhere, as in a closed "
      "vessel; formula: by formulas of the place"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case_soil, initial_stress)},
    {{"pressure", SCALAR, "Pa", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "pressure of a uniform initial stress; required with it"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, pressure)},
    {{"lateral_ratio", SCALAR, "1", DEFAULT(-1.0), NOT_NEGATIVE, NULL, "lateral stress / vertical stress"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, lateral_ratio),
     .computed = "1 - sin(friction angle)"},
    {{"surface_level", SCALAR, "m", DEFAULT(NAN), ANY, NULL, "height of the free surface, against gravity"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, surface_level),
     .computed = "top of the region"},
    {{"settle_time", SCALAR, "s", DEFAULT(NAN), POSITIVE, NULL, "longest simulated time of settling"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, settle_time),
     .computed = "end"},
    {{"settle_speed_ratio", SCALAR, "1", DEFAULT(1.0e-3), POSITIVE, NULL,
      "settled when the 99th-percentile speed is below this times sqrt(gravity * height)"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, settle_speed_ratio)},
    {{"settle_method", CHOICE, "1", DEFAULT(0.0), ANY, "auto|damping|relaxation",
      "damping: velocities are damped until soil is slow; relaxation: all motion is stopped at each peak of the "
      "kinetic energy until forces balance, which is faster; auto: relaxation with stress_diffusion_limiter = "
      "\"transient\", which lets soil rest, else damping; damping, too, "
      "where settle_speed_ratio is given"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case_soil, settle_method)},
    {{"settle_from", CHOICE, "1", DEFAULT(0.0), ANY, "k0|none",
      "stress that settling begins with; k0: as type k0; none: zero, and the weight loads the soil"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case_soil, settle_from)},
    {{"settle_force_ratio", SCALAR, "1", DEFAULT(1.0e-4), POSITIVE, NULL,
      "settled by relaxation when the mean unbalanced force is below this times the mean weight of a particle"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, settle_force_ratio)},
    END};

static const mor_case_key wall_keys[] = {
    {{"name", WORDS, "1", REQUIRED, ANY, NULL, "name of the wall, not that of a body"},
     MOR_CASE_STORE_NAME,
     .offset = offsetof(mor_case_wall, name),
     .size = MOR_FIELD_NAME_BYTES},
    {{"friction", CHOICE, "1", DEFAULT(0.0), ANY, "rough|smooth|coulomb",
      "with soil; rough: no slip; smooth: free slip; coulomb: Coulomb friction"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case_wall, friction),
     .needs = MOR_CASE_NEEDS_SOIL},
    {{"friction_coefficient", SCALAR, "1", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "Coulomb friction coefficient with soil; required with coulomb, not allowed otherwise"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_wall, friction_coefficient),
     .needs = MOR_CASE_NEEDS_SOIL},
    {{"velocity", VECTOR, "m/s", DEFAULT(0.0), ANY, NULL, "prescribed velocity; not together with path"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_wall, velocity)},
    {{"removed_at", SCALAR, "s", DEFAULT(NAN), POSITIVE, NULL, "time from which the wall is not there any more"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_wall, removed_at),
     .computed = "never"},
    {{"contact_modulus", SCALAR, "Pa", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "Young's modulus of its surface, for contact with rigid bodies; 0: a rigid surface"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_wall, contact_modulus)},
    {{"contact_poissons_ratio", SCALAR, "1", DEFAULT(0.25), BELOW(0.0, 0.5), NULL,
      "Poisson's ratio of its surface, for contact with rigid bodies"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_wall, contact_poisson),
     .needs = MOR_CASE_NEEDS_BODIES | MOR_CASE_NEEDS_COMPLIANCE},
    END};

static const mor_case_part wall_parts[] = {
    {"shape", true, "shape", "the solid"},
    {"friction_with", false, "list of groups", "soils with which the friction is another one"},
    {"path", false, "group", "prescribed motion over time, in place of velocity"},
    {NULL, false, NULL, NULL}};

static const mor_case_key friction_keys[] = {
    {{"soil", WORDS, "1", REQUIRED, ANY, NULL, "name of the soil"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_soil_friction, soil)},
    {{"friction", CHOICE, "1", REQUIRED, ANY, "rough|smooth|coulomb", "with this soil, as of a wall"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case_soil_friction, friction)},
    {{"friction_coefficient", SCALAR, "1", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "Coulomb friction coefficient with this soil; required with coulomb, not allowed otherwise"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil_friction, coefficient)},
    END};

const mor_case_group mor_case_soil_group = {"soil", "Soil regions (list)", soil_keys, soil_parts,
                                            offsetof(mor_case_soil, written)};
const mor_case_group mor_case_material_group = {"material", "Material of a soil region", material_keys, NULL,
                                                offsetof(mor_case_soil, written_material)};
const mor_case_group mor_case_external_group = {"material", "Material of a soil region by a law of another program",
                                                external_keys, external_parts,
                                                offsetof(mor_case_soil, written_material)};
const mor_case_group mor_case_stress_group = {"initial_stress", "Initial stress of a soil region", stress_keys,
                                              stress_parts, offsetof(mor_case_soil, written_stress)};
const mor_case_group mor_case_wall_group = {"walls", "Walls (list)", wall_keys, wall_parts,
                                            offsetof(mor_case_wall, written)};

const mor_case_group mor_case_friction_group = {"friction_with", "Friction of a wall or a body with one soil (list)",
                                                friction_keys, NULL, offsetof(mor_case_soil_friction, written)};

/* ---- Shapes ------------------------------------------------------------------------------------------------------ */

static const mor_case_key box_keys[] = {
    {{"min", VECTOR, "m", REQUIRED, ANY, NULL, "lowest corner; two numbers in plane strain"}, SHAPE(first)},
    {{"max", VECTOR, "m", REQUIRED, ANY, NULL, "highest corner; two numbers in plane strain"}, SHAPE(second)},
    END};
static const mor_case_key cylinder_keys[] = {
    {{"base", VECTOR, "m", REQUIRED, ANY, NULL, "center of the first end"}, SHAPE(first)},
    {{"axis", VECTOR, "1", REQUIRED, ANY, NULL, "direction to the other end"}, SHAPE(second), .is_direction = true},
    {{"radius", SCALAR, "m", REQUIRED, POSITIVE, NULL, "radius"}, SHAPE(radius)},
    {{"height", SCALAR, "m", REQUIRED, POSITIVE, NULL, "distance between the ends"}, SHAPE(height)},
    END};
static const mor_case_key cone_keys[] = {
    {{"base", VECTOR, "m", REQUIRED, ANY, NULL, "center of the base"}, SHAPE(first)},
    {{"axis", VECTOR, "1", REQUIRED, ANY, NULL, "direction from the base to the apex"},
     SHAPE(second),
     .is_direction = true},
    {{"radius", SCALAR, "m", REQUIRED, POSITIVE, NULL, "radius of the base"}, SHAPE(radius)},
    {{"height", SCALAR, "m", REQUIRED, POSITIVE, NULL, "distance from the base to the apex"}, SHAPE(height)},
    END};
static const mor_case_key sphere_keys[] = {{{"center", VECTOR, "m", REQUIRED, ANY, NULL, "center"}, SHAPE(first)},
                                           {{"radius", SCALAR, "m", REQUIRED, POSITIVE, NULL, "radius"}, SHAPE(radius)},
                                           END};
static const mor_case_key ellipsoid_keys[] = {{{"center", VECTOR, "m", REQUIRED, ANY, NULL, "center"}, SHAPE(first)},
                                              {{"radii", VECTOR, "m", REQUIRED, NOT_NEGATIVE, NULL,
                                                "half of its extent along x, y and z; use rotate for other axes"},
                                               SHAPE(second)},
                                              END};
static const mor_case_key half_space_keys[] = {
    {{"point", VECTOR, "m", REQUIRED, ANY, NULL, "a point of the plane"}, SHAPE(first)},
    {{"normal", VECTOR, "1", REQUIRED, ANY, NULL, "outward normal of the solid"}, SHAPE(second), .is_direction = true},
    END};
static const mor_case_key no_keys[] = {END};
static const mor_case_key translate_keys[] = {
    {{"translation", VECTOR, "m", REQUIRED, ANY, NULL, "translation"}, SHAPE(first), .former = "move"}, END};
static const mor_case_key rotate_keys[] = {
    {{"axis", VECTOR, "1", DEFAULT(NAN), ANY, NULL, "direction of the axis"},
     SHAPE(second),
     .computed = "(0, 0, 1)",
     .is_direction = true},
    {{"angle", SCALAR, "rad", REQUIRED, ANY, NULL, "angle, right-handed"}, SHAPE(angle)},
    {{"center", VECTOR, "m", DEFAULT(0.0), ANY, NULL, "a point of the axis"}, SHAPE(first)},
    END};

static const mor_case_part polygon_parts[] = {
    {"points", true, "list of pairs [m]", "corners in order, the first not repeated; unbounded in z"},
    {NULL, false, NULL, NULL}};
static const mor_case_part union_parts[] = {{"parts", true, "list of shapes", "shapes whose union is formed"},
                                            {NULL, false, NULL, NULL}};
static const mor_case_part difference_parts[] = {{"from", true, "shape", "shape from which the others are subtracted"},
                                                 {"minus", true, "shape or list of shapes", "what is subtracted"},
                                                 {NULL, false, NULL, NULL}};
static const mor_case_part moved_parts[] = {{"shape", true, "shape", "shape to be translated or rotated"},
                                            {NULL, false, NULL, NULL}};

#define WRITTEN offsetof(mor_case_shape, written)
const mor_case_group mor_case_shape_groups[MOR_CASE_SHAPE_COUNT] = {
    [MOR_CASE_SHAPE_BOX] = {"box", "Box with faces normal to the axes", box_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_CYLINDER] = {"cylinder", "Solid cylinder", cylinder_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_CONE] = {"cone", "Solid cone", cone_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_SPHERE] = {"sphere", "Ball; a disc in plane strain", sphere_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_ELLIPSOID] = {"ellipsoid", "Ellipsoid with its axes along x, y and z; an ellipse in plane strain",
                                  ellipsoid_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_HALF_SPACE] = {"half_space", "Half-space behind a plane", half_space_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_POLYGON] = {"polygon", "Polygon in x and y", no_keys, polygon_parts, WRITTEN},
    [MOR_CASE_SHAPE_UNION] = {"union", "Union of shapes", no_keys, union_parts, WRITTEN},
    [MOR_CASE_SHAPE_DIFFERENCE] = {"difference", "Difference of shapes", no_keys, difference_parts, WRITTEN},
    [MOR_CASE_SHAPE_TRANSLATE] = {"translate", "Translated shape", translate_keys, moved_parts, WRITTEN},
    [MOR_CASE_SHAPE_ROTATE] = {"rotate", "Shape rotated about an axis", rotate_keys, moved_parts, WRITTEN},
    [MOR_CASE_SHAPE_TERRAIN] = {"terrain", "Ground from an elevation raster; a wall of it follows the surface",
                                mor_case_terrain_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_RELEASE] = {"release", "Layer on the ground inside a polygon; soil of it follows the surface",
                                mor_case_release_keys, mor_case_release_parts, WRITTEN},
    [MOR_CASE_SHAPE_POSTS] = {"posts", "Boxes that stand in the ground", mor_case_posts_keys, mor_case_posts_parts,
                              WRITTEN},
    [MOR_CASE_SHAPE_MESH] = {"mesh", "Solid of a mesh from a file; its center of volume is the origin",
                             mor_case_mesh_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_OUTLINE] = {"outline", "Solid of an outline from a file; its center of area is the origin",
                                mor_case_outline_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_ROCK] = {"rock", "Rock of a random form; its center of volume is the origin", mor_case_rock_keys,
                             NULL, WRITTEN},
};

/* ---- Look-up ----------------------------------------------------------------------------------------------------- */

double mor_case_key_default(const mor_case_key *key, int scheme)
{
    return key->has_schemes && scheme == MOR_SCHEME_ZHANG2024 ? key->zhang2024 : key->schema.default_value;
}

mor_schema mor_case_key_schema(const mor_case_key *key, int dimension)
{
    mor_schema schema = key->schema;
    if (dimension == 2 && key->unit_plane != NULL) {
        schema.unit = key->unit_plane;
    }
    return schema;
}

int mor_case_key_find(const mor_case_key *keys, const char *name)
{
    for (int k = 0; keys[k].schema.key != NULL; ++k) {
        if (strcmp(keys[k].schema.key, name) == 0) {
            return k;
        }
    }
    return -1;
}
