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
    {{"dimension", WHOLE, "1", REQUIRED, 2.0, 3.0, 0, 0, NULL, "2: plane strain in x and y; 3: three dimensions"},
     MOR_CASE_STORE_INT,
     AT(mor_case, dimension)},
    {{"spacing", SCALAR, "m", REQUIRED, POSITIVE, NULL, "distance between particles"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, spacing)},
    {{"end", SCALAR, "s", REQUIRED, POSITIVE, NULL, "simulated time"}, MOR_CASE_STORE_REALS, AT(mor_case, end)},
    {{"gravity", VECTOR, "m/s2", REQUIRED, ANY, NULL, "acceleration by gravity"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, gravity)},
    {{"seed", WHOLE, "1", DEFAULT(1.0), NOT_NEGATIVE, NULL, "seed of everything random"},
     MOR_CASE_STORE_SEED,
     AT(mor_case, seed)},
    END};

static const mor_case_part root_parts[] = {
    {"domain", true, "group", "box that particles may not leave"},
    {"lattice", false, "group", "lattice that regions are filled from"},
    {"placement", false, "group", "rotation and translation of the whole scene, gravity included"},
    {"scale", false, "group", "change of units of the whole case, to check that results do not depend on them"},
    {"soil", false, "list of groups", "soil regions; a case has soil, or bodies, or both"},
    {"walls", false, "list of groups", "solid walls"},
    {"bodies", false, "list of groups", "rocks, elastic or rigid"},
    {"rocks", false, "list of groups", "rocks packed at random into a region; each becomes a body"},
    {"contact", false, "group", "contact of bodies with bodies and walls"},
    {"numerics", false, "group", "settings of the method"},
    {"probes", false, "list of groups", "results to measure"},
    {"expect", false, "list of groups", "reference values that results are compared with"},
    {"output", false, "group", "what the run writes"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_case_root_group = {"", "Top level", root_keys, root_parts, offsetof(mor_case, written)};

static const mor_case_key domain_keys[] = {
    {{"min", VECTOR, "m", REQUIRED, ANY, NULL, "lowest corner"}, MOR_CASE_STORE_REALS, AT(mor_case, domain_minimum)},
    {{"max", VECTOR, "m", REQUIRED, ANY, NULL, "highest corner"}, MOR_CASE_STORE_REALS, AT(mor_case, domain_maximum)},
    {{"outflow", CHOICE, "1", DEFAULT(0.0), ANY, "stop|remove",
      "what becomes of soil that leaves: it stops the run, or is removed and counted; rocks always stop the run"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case, outflow)},
    END};

static const mor_case_key lattice_keys[] = {
    {{"origin", VECTOR, "m", DEFAULT(0.0), ANY, NULL, "a corner of a lattice cell; particles fill the cells"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, lattice_origin)},
    {{"jitter", SCALAR, "1", DEFAULT(0.0), 0.0, 0.5, 0, 1, NULL, "random displacement of particles / spacing"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, jitter_ratio)},
    END};

static const mor_case_key placement_keys[] = {
    {{"axis", VECTOR, "1", DEFAULT(NAN), ANY, NULL, "axis of the rotation, through the origin"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, placement_axis),
     .computed = "(0, 0, 1)",
     .is_direction = true},
    {{"angle", SCALAR, "rad", DEFAULT(0.0), ANY, NULL, "angle of the rotation, right-handed"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, placement_angle)},
    {{"translation", VECTOR, "m", DEFAULT(0.0), ANY, NULL, "translation after the rotation"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, translation),
     .former = "move"},
    END};

static const mor_case_key scale_keys[] = {
    {{"length", SCALAR, "1", DEFAULT(1.0), POSITIVE, NULL, "all lengths are multiplied by it; an even power of two"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, scale_length)},
    {{"time", SCALAR, "1", DEFAULT(1.0), POSITIVE, NULL, "all times are multiplied by it; an even power of two"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, scale_time)},
    {{"mass", SCALAR, "1", DEFAULT(1.0), POSITIVE, NULL, "all masses are multiplied by it; an even power of two"},
     MOR_CASE_STORE_REALS,
     AT(mor_case, scale_mass)},
    END};

#define NUMERICS(member) AT(mor_case, numerics.member)
static const mor_case_key numerics_keys[] = {
    {{"smoothing_ratio", SCALAR, "1", DEFAULT(1.3), 1.0, 3.0, 0, 0, NULL, "smoothing length / spacing"},
     MOR_CASE_STORE_REALS,
     NUMERICS(smoothing_ratio)},
    {{"courant", SCALAR, "1", DEFAULT(0.4), 0.0, 1.0, 1, 0, NULL, "Courant number of the time step"},
     MOR_CASE_STORE_REALS,
     NUMERICS(courant)},
    {{"lattice_normalization", SWITCH, "1", DEFAULT(0.0), ANY, NULL,
      "whether the kernel gradient is scaled to be exact for linear fields on the initial lattice"},
     MOR_CASE_STORE_BOOL,
     NUMERICS(lattice_normalization)},
    {{"dissipation", CHOICE, "1", DEFAULT(0.0), ANY, "separation|approach|both",
      "relative motion between soil particles that the Riemann solver damps"},
     MOR_CASE_STORE_CHOICE,
     NUMERICS(dissipation)},
    {{"wall_dissipation", CHOICE, "1", DEFAULT(0.0), ANY, "separation|approach|both",
      "relative motion between soil and walls that the Riemann solver damps"},
     MOR_CASE_STORE_CHOICE,
     NUMERICS(wall_dissipation)},
    {{"wall_stress", CHOICE, "1", DEFAULT(1.0), ANY, "uniform|along|linear",
      "stress a particle sees in a wall: its own, or its own varying as in the soil along the wall, or everywhere"},
     MOR_CASE_STORE_CHOICE,
     NUMERICS(wall_stress)},
    {{"dissipation_factor", SCALAR, "1", DEFAULT(NAN), NOT_NEGATIVE, NULL, "slope of the dissipation limiter"},
     MOR_CASE_STORE_REALS,
     NUMERICS(dissipation_factor),
     .computed = "20 * dimension"},
    {{"reconstruction", CHOICE, "1", DEFAULT(0.0), ANY, "none|linear",
      "velocities between which the Riemann solver damps: of the soil particles, or continued linearly to the middle "
      "of the pair, so that smooth motion is not damped"},
     MOR_CASE_STORE_CHOICE,
     NUMERICS(reconstruction)},
    {{"density_pressure_term", SWITCH, "1", DEFAULT(0.0), ANY, NULL,
      "pressure part of the Riemann velocity in the "
      "rate of density"},
     MOR_CASE_STORE_BOOL,
     NUMERICS(density_pressure_term)},
    {{"stress_diffusion", SCALAR, "1", DEFAULT(0.1), 0.0, 0.5, 0, 0, NULL, "factor of the stress diffusion; 0: off"},
     MOR_CASE_STORE_REALS,
     NUMERICS(stress_diffusion)},
    {{"stress_diffusion_limiter", CHOICE, "1", DEFAULT(0.0), ANY, "none|motion",
      "where stress diffuses: everywhere, or only as far as particles move against each other, so that soil at rest "
      "under a load does not creep (nowhere with dissipation_factor = 0)"},
     MOR_CASE_STORE_CHOICE,
     NUMERICS(stress_diffusion_limiter)},
    {{"artificial_stress", SWITCH, "1", DEFAULT(0.0), ANY, NULL,
      "artificial stress against clumping in tension, for "
      "cohesive soil"},
     MOR_CASE_STORE_BOOL,
     NUMERICS(artificial_stress)},
    {{"artificial_stress_exponent", SCALAR, "1", DEFAULT(2.55), POSITIVE, NULL, "exponent of the artificial stress"},
     MOR_CASE_STORE_REALS,
     NUMERICS(artificial_stress_exponent)},
    {{"artificial_stress_factor", SCALAR, "1", DEFAULT(0.5), NOT_NEGATIVE, NULL, "factor of the artificial stress"},
     MOR_CASE_STORE_REALS,
     NUMERICS(artificial_stress_factor)},
    {{"gradient_correction", SWITCH, "1", DEFAULT(0.0), ANY, NULL, "correction of kernel gradients to first order"},
     MOR_CASE_STORE_BOOL,
     NUMERICS(gradient_correction)},
    {{"xsph", SCALAR, "1", DEFAULT(0.0), 0.0, 1.0, 0, 0, NULL,
      "share of the neighbors' velocity in the motion; 0: off"},
     MOR_CASE_STORE_REALS,
     NUMERICS(xsph)},
    {{"shifting", SWITCH, "1", DEFAULT(0.0), ANY, NULL, "shifting of particles towards even spacing"},
     MOR_CASE_STORE_BOOL,
     NUMERICS(shifting)},
    {{"density_reinitialization", WHOLE, "1", DEFAULT(20.0), 0.0, 1.0e9, 0, 0, NULL,
      "steps between summations of the density; 0: off"},
     MOR_CASE_STORE_INT,
     NUMERICS(density_reinitialization)},
    {{"skin_ratio", SCALAR, "1", DEFAULT(0.45), 0.0, 4.0, 0, 0, NULL, "extra reach of neighbor lists / spacing"},
     MOR_CASE_STORE_REALS,
     NUMERICS(skin_ratio)},
    {{"sort_interval", WHOLE, "1", DEFAULT(100.0), 1.0, 1.0e9, 0, 0, NULL, "steps between sorts of the particles"},
     MOR_CASE_STORE_INT,
     NUMERICS(sort_interval)},
    {{"damping", SCALAR, "1/s", DEFAULT(0.0), NOT_NEGATIVE, NULL, "rate at which velocities are damped; 0: off"},
     MOR_CASE_STORE_REALS,
     NUMERICS(damping)},
    {{"gravity_ramp", SCALAR, "s", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "time over which gravity grows from zero; 0: none"},
     MOR_CASE_STORE_REALS,
     NUMERICS(gravity_ramp)},
    {{"single_rate", SWITCH, "1", DEFAULT(0.0), ANY, NULL,
      "whether soil and bodies take the same steps, in place of several of the bodies in one of the soil"},
     MOR_CASE_STORE_BOOL,
     NUMERICS(single_rate)},
    {{"narrow_gaps", CHOICE, "1", DEFAULT(0.0), ANY, "refuse|allow",
      "gaps narrower than two spacings between walls and prescribed bodies, which soil does not pass"},
     MOR_CASE_STORE_CHOICE,
     NUMERICS(narrow_gaps)},
    {{"body_smoothing_ratio", SCALAR, "1", DEFAULT(1.15), 1.0, 3.0, 0, 0, NULL,
      "smoothing length / spacing of elastic bodies"},
     MOR_CASE_STORE_REALS,
     NUMERICS(body_smoothing_ratio)},
    {{"body_courant", SCALAR, "1", DEFAULT(0.4), 0.0, 1.0, 1, 0, NULL, "Courant number of elastic bodies"},
     MOR_CASE_STORE_REALS,
     NUMERICS(body_courant)},
    {{"body_damping", SCALAR, "1", DEFAULT(1.0), NOT_NEGATIVE, NULL,
      "viscous damping of elastic bodies / that of Zhang et al. (2024); 0: off"},
     MOR_CASE_STORE_REALS,
     NUMERICS(body_damping)},
    {{"hourglass", SCALAR, "1", DEFAULT(0.1), NOT_NEGATIVE, NULL,
      "strength of the hourglass control of elastic bodies; 0: off"},
     MOR_CASE_STORE_REALS,
     NUMERICS(hourglass)},
    {{"body_stress", CHOICE, "1", DEFAULT(2.0), ANY, "uniform|along|linear",
      "stress a soil particle sees in a body, as wall_stress"},
     MOR_CASE_STORE_CHOICE,
     NUMERICS(body_stress)},
    {{"angular_momentum", SWITCH, "1", DEFAULT(0.0), ANY, NULL,
      "whether forces within the soil keep its angular momentum to rounding"},
     MOR_CASE_STORE_BOOL,
     NUMERICS(angular_momentum)},
    {{"barrier_stiffness", SCALAR, "N/m", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "stiffness of the barrier that keeps soil particles out of bodies, Jiang et al. (2022) eq. 23; 0: off"},
     MOR_CASE_STORE_REALS,
     NUMERICS(barrier_stiffness),
     .unit_plane = "N/m2"},
    {{"barrier_radius", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL, "distance at which the barrier begins to push"},
     MOR_CASE_STORE_REALS,
     NUMERICS(barrier_radius),
     .computed = "spacing"},
    END};

#define OUTPUT(member) AT(mor_case, output.member)
static const mor_case_key output_keys[] = {
    {{"snapshots", WHOLE, "1", DEFAULT(20.0), 0.0, 1.0e6, 0, 0, NULL, "snapshots after the first, evenly spaced"},
     MOR_CASE_STORE_INT,
     OUTPUT(n_snapshots)},
    {{"series_interval", SCALAR, "s", DEFAULT(NAN), POSITIVE, NULL, "simulated time between rows of series.csv"},
     MOR_CASE_STORE_REALS,
     OUTPUT(series_interval),
     .computed = "end / 200"},
    {{"checkpoint_seconds", SCALAR, "s", DEFAULT(60.0), POSITIVE, NULL, "time on the clock between checkpoints"},
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
    {{"view", VECTOR, "1", DEFAULT(0.0), ANY, NULL, "direction from the scene to the camera; zero: chosen"},
     MOR_CASE_STORE_REALS,
     OUTPUT(view)},
    {{"cut", SWITCH, "1", DEFAULT(0.0), ANY, NULL, "whether the part nearest to the camera is left out"},
     MOR_CASE_STORE_BOOL,
     OUTPUT(has_cut)},
    END};

const mor_case_group mor_case_settings_groups[] = {
    {"domain", "Box that particles may not leave", domain_keys, NULL, offsetof(mor_case, written_domain)},
    {"lattice", "Lattice that regions are filled from", lattice_keys, NULL, offsetof(mor_case, written_lattice)},
    {"placement", "Rotation and translation of the whole scene", placement_keys, NULL,
     offsetof(mor_case, written_placement)},
    {"scale", "Change of units", scale_keys, NULL, offsetof(mor_case, written_scale)},
    {"numerics", "Settings of the method", numerics_keys, NULL, offsetof(mor_case, written_numerics)},
    {"output", "What the run writes", output_keys, NULL, offsetof(mor_case, written_output)},
    {NULL, NULL, NULL, NULL, 0}};

/* ---- Soil and walls ---------------------------------------------------------------------------------------------- */

static const mor_case_key soil_keys[] = {
    {{"name", WORDS, "1", REQUIRED, ANY, NULL, "name of the region"}, MOR_CASE_STORE_NAME, AT(mor_case_soil, name)},
    {{"velocity", VECTOR, "m/s", DEFAULT(0.0), ANY, NULL, "initial velocity"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, velocity)},
    END};

static const mor_case_part soil_parts[] = {
    {"shape", true, "shape", "region that is filled"},
    {"material", true, "group", "model, density, and the parameters of the model"},
    {"initial_stress", false, "group", "stress at the start"},
    {NULL, false, NULL, NULL}};

static const mor_case_key material_keys[] = {{{"model", WORDS, "1", REQUIRED, ANY, NULL, "name of the material model"},
                                              MOR_CASE_STORE_NAME,
                                              AT(mor_case_soil, model)},
                                             {{"density", SCALAR, "kg/m3", REQUIRED, POSITIVE, NULL, "initial density"},
                                              MOR_CASE_STORE_REALS,
                                              AT(mor_case_soil, density)},
                                             END};

static const mor_case_key stress_keys[] = {
    {{"type", CHOICE, "1", DEFAULT(0.0), ANY, "none|k0|settled",
      "none: free of stress; k0: weight above and a lateral ratio; settled: as k0, then brought to rest before the "
      "start"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case_soil, initial_stress)},
    {{"lateral_ratio", SCALAR, "1", DEFAULT(-1.0), NOT_NEGATIVE, NULL, "lateral stress / vertical stress"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, lateral_ratio),
     .computed = "1 - sin(friction_angle)"},
    {{"surface_level", SCALAR, "m", DEFAULT(NAN), ANY, NULL, "height of the free surface, against gravity"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, surface_level),
     .computed = "top of the region"},
    {{"settle_time", SCALAR, "s", DEFAULT(NAN), POSITIVE, NULL, "longest time to settle"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, settle_time),
     .computed = "end"},
    {{"settle_speed_ratio", SCALAR, "1", DEFAULT(1.0e-3), POSITIVE, NULL,
      "settled when the 99th-percentile speed is below this times sqrt(gravity * height)"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_soil, settle_speed_ratio)},
    END};

static const mor_case_key wall_keys[] = {
    {{"name", WORDS, "1", REQUIRED, ANY, NULL, "name of the wall, not that of a body"},
     MOR_CASE_STORE_NAME,
     .offset = offsetof(mor_case_wall, name),
     .size = MOR_FIELD_NAME_BYTES},
    {{"friction", CHOICE, "1", DEFAULT(0.0), ANY, "rough|smooth|coulomb",
      "rough: no slip; smooth: free slip; coulomb: "
      "slip at friction_coefficient"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case_wall, friction)},
    {{"friction_coefficient", SCALAR, "1", DEFAULT(0.0), NOT_NEGATIVE, NULL, "needed with coulomb, refused without"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_wall, friction_coefficient)},
    {{"velocity", VECTOR, "m/s", DEFAULT(0.0), ANY, NULL, "prescribed velocity"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_wall, velocity)},
    {{"contact_modulus", SCALAR, "Pa", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "Young's modulus of its surface, for rigid bodies that touch it; 0: it does not yield"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_wall, contact_modulus)},
    {{"contact_poissons_ratio", SCALAR, "1", DEFAULT(0.25), 0.0, 0.5, 0, 1, NULL,
      "Poisson's ratio of its surface, with contact_modulus"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_wall, contact_poisson)},
    END};

static const mor_case_part wall_parts[] = {{"shape", true, "shape", "the solid"}, {NULL, false, NULL, NULL}};

const mor_case_group mor_case_soil_group = {"soil", "Soil regions (list)", soil_keys, soil_parts,
                                            offsetof(mor_case_soil, written)};
const mor_case_group mor_case_material_group = {"material", "Material of a soil region", material_keys, NULL,
                                                offsetof(mor_case_soil, written_material)};
const mor_case_group mor_case_stress_group = {"initial_stress", "Stress of a soil region at the start", stress_keys,
                                              NULL, offsetof(mor_case_soil, written_stress)};
const mor_case_group mor_case_wall_group = {"walls", "Walls (list)", wall_keys, wall_parts,
                                            offsetof(mor_case_wall, written)};

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
static const mor_case_key ellipsoid_keys[] = {
    {{"center", VECTOR, "m", REQUIRED, ANY, NULL, "center"}, SHAPE(first)},
    {{"radii", VECTOR, "m", REQUIRED, NOT_NEGATIVE, NULL, "half of its extent along x, y and z; rotate turns it"},
     SHAPE(second)},
    END};
static const mor_case_key half_space_keys[] = {
    {{"point", VECTOR, "m", REQUIRED, ANY, NULL, "a point of the face"}, SHAPE(first)},
    {{"normal", VECTOR, "1", REQUIRED, ANY, NULL, "direction out of the solid"}, SHAPE(second), .is_direction = true},
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
    {"points", true, "list of pairs [m]", "corners in order, the first not repeated; without end in z"},
    {NULL, false, NULL, NULL}};
static const mor_case_part union_parts[] = {{"parts", true, "list of shapes", "what is put together"},
                                            {NULL, false, NULL, NULL}};
static const mor_case_part difference_parts[] = {{"from", true, "shape", "what is kept"},
                                                 {"minus", true, "shape or list of shapes", "what is taken away"},
                                                 {NULL, false, NULL, NULL}};
static const mor_case_part moved_parts[] = {{"shape", true, "shape", "what is moved or turned"},
                                            {NULL, false, NULL, NULL}};

#define WRITTEN offsetof(mor_case_shape, written)
const mor_case_group mor_case_shape_groups[MOR_CASE_SHAPE_COUNT] = {
    [MOR_CASE_SHAPE_BOX] = {"box", "Box with faces normal to the axes", box_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_CYLINDER] = {"cylinder", "Solid cylinder", cylinder_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_CONE] = {"cone", "Solid cone", cone_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_SPHERE] = {"sphere", "Ball; a disc in plane strain", sphere_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_ELLIPSOID] = {"ellipsoid", "Ellipsoid with its axes along x, y and z; an ellipse in plane strain",
                                  ellipsoid_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_HALF_SPACE] = {"half_space", "Everything behind a plane", half_space_keys, NULL, WRITTEN},
    [MOR_CASE_SHAPE_POLYGON] = {"polygon", "Polygon in x and y", no_keys, polygon_parts, WRITTEN},
    [MOR_CASE_SHAPE_UNION] = {"union", "Shapes put together", no_keys, union_parts, WRITTEN},
    [MOR_CASE_SHAPE_DIFFERENCE] = {"difference", "One shape without others", no_keys, difference_parts, WRITTEN},
    [MOR_CASE_SHAPE_TRANSLATE] = {"translate", "A shape moved", translate_keys, moved_parts, WRITTEN},
    [MOR_CASE_SHAPE_ROTATE] = {"rotate", "A shape turned about an axis", rotate_keys, moved_parts, WRITTEN},
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
    [MOR_CASE_SHAPE_ROCK] = {"rock", "Rock drawn at random; its center of volume is the origin", mor_case_rock_keys,
                             NULL, WRITTEN},
};

/* ---- Look-up ----------------------------------------------------------------------------------------------------- */

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
