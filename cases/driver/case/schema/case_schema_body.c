/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"

#include "cases/driver/case/schema/case_schema_words.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "core/particle/field.h"

#include <math.h>
#include <string.h>

/* Speed of sound of a rigid body in contact where no modulus is given, m/s: a third of that of hard rock, so that steps
 * are three times as long. */
#define CHOSEN_WAVE_SPEED 1000.0

/* Bodies and their contact: the tables, and what depends on the kind of a body. Entries follow mor_schema as in
 * case_schema.c. */
#define BODY(member) AT(mor_case_body, member)

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

const char *const mor_case_rigid_words[] = {"rigid", NULL};
const char *const mor_case_lock_words[MOR_CASE_LOCKS] = {"x", "y", "z", "rx", "ry", "rz"};

static const mor_case_key body_keys[] = {
    {{"name", WORDS, "1", REQUIRED, ANY, NULL, "name of the body, not that of a wall"},
     MOR_CASE_STORE_NAME,
     .offset = offsetof(mor_case_body, name),
     .size = MOR_FIELD_NAME_BYTES},
    {{"position", VECTOR, "m", DEFAULT(0.0), ANY, NULL, "position of the origin of the frame of its shape"},
     MOR_CASE_STORE_REALS,
     BODY(position)},
    {{"height_over_ground", SCALAR, "m", DEFAULT(NAN), NOT_NEGATIVE, NULL,
      "distance from walls and soil: the body is lowered along gravity, from the top of the domain, to this distance"},
     MOR_CASE_STORE_REALS,
     BODY(height_over_ground),
     .computed = "none: it stays at position"},
    {{"axis", VECTOR, "1", DEFAULT(NAN), ANY, NULL, "axis of the rotation of its shape, through position"},
     MOR_CASE_STORE_REALS,
     BODY(axis),
     .computed = "(0, 0, 1)",
     .is_direction = true,
     .needs = MOR_CASE_NEEDS_BODY_ROTATION},
    {{"angle", SCALAR, "rad", DEFAULT(0.0), ANY, NULL, "angle of that rotation, right-handed"},
     MOR_CASE_STORE_REALS,
     BODY(angle)},
    {{"velocity", VECTOR, "m/s", DEFAULT(0.0), ANY, NULL,
      "initial velocity of the center of mass; with prescribed motion, at all times"},
     MOR_CASE_STORE_REALS,
     BODY(velocity)},
    {{"angular_velocity", VECTOR, "rad/s", DEFAULT(0.0), ANY, NULL,
      "initial angular velocity about the center of mass; with prescribed motion, at all times"},
     MOR_CASE_STORE_REALS,
     BODY(angular_velocity)},
    {{"friction", CHOICE, "1", DEFAULT(0.0), ANY, "rough|smooth|coulomb",
      "with soil; rough: no slip; smooth: free slip; coulomb: Coulomb friction"},
     MOR_CASE_STORE_CHOICE,
     BODY(soil_friction),
     .needs = MOR_CASE_NEEDS_SOIL},
    {{"friction_coefficient", SCALAR, "1", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "Coulomb friction coefficient with soil; required with coulomb, not allowed otherwise"},
     MOR_CASE_STORE_REALS,
     BODY(soil_friction_coefficient),
     .needs = MOR_CASE_NEEDS_SOIL},
    {{"contact_modulus", SCALAR, "Pa", DEFAULT(NAN), POSITIVE, NULL,
      "Young's modulus of its surface in contact with bodies and walls; between rigid surfaces Hertz's law holds"},
     MOR_CASE_STORE_REALS,
     BODY(contact_modulus),
     .computed = "youngs_modulus; of a rigid body density * (1000 m/s)^2, chosen for long time steps: give the true "
                 "modulus where contact forces matter"},
    {{"contact_poissons_ratio", SCALAR, "1", DEFAULT(0.25), BELOW(0.0, 0.5), NULL,
      "Poisson's ratio of its surface in contact"},
     MOR_CASE_STORE_REALS,
     BODY(contact_poisson)},
    {{"motion", CHOICE, "1", DEFAULT(0.0), ANY, "free|prescribed",
      "of a rigid body; free: as forces move it; prescribed: with constant velocity and angular_velocity, or on a "
      "path, "
      "whatever the forces"},
     MOR_CASE_STORE_BOOL,
     BODY(is_prescribed)},
    {{"removed_at", SCALAR, "s", DEFAULT(NAN), POSITIVE, NULL,
      "of a rigid body: time from which it is not there any more"},
     MOR_CASE_STORE_REALS,
     BODY(removed_at),
     .computed = "never"},
    {{"particles", CHOICE, "1", DEFAULT(0.0), ANY, "by_shape|lattice|relaxed",
      "how the shape is filled; lattice: with the nodes of a lattice; relaxed: with relaxed positions that follow its "
      "surface; by_shape: relaxed for a mesh, an outline or a rock, else lattice"},
     MOR_CASE_STORE_CHOICE,
     BODY(particles)},
    END};

static const mor_case_part body_parts[] = {
    {"shape", true, "shape", "shape of the body, in its own frame"},
    {"material", true, "group", "model, density, and the parameters of the model"},
    {"friction_with", false, "list of groups", "soils with which the friction is another one"},
    {"path", false, "group", "of a prescribed motion: motion over time, in place of velocity and angular_velocity"},
    {"locked", false, "list of words", "of a free rigid body: no motion along x, y, z, no rotation about rx, ry, rz"},
    {"spring", false, "group", "of a free rigid body: spring and damper to a fixed point"},
    {"clamp", false, "shape",
     "of an elastic body: particles inside this shape, given in the frame of the case, are fixed"},
    {"start", false, "group", "of an elastic body: initial velocity field, added to velocity and angular_velocity"},
    {NULL, false, NULL, NULL}};

static const mor_case_key material_keys[] = {
    {{"model", WORDS, "1", REQUIRED, ANY, NULL, "rigid, or the name of the model of an elastic body"},
     MOR_CASE_STORE_NAME,
     BODY(model)},
    {{"density", SCALAR, "kg/m3", REQUIRED, POSITIVE, NULL, "density"}, MOR_CASE_STORE_REALS, BODY(density)},
    END};

static const mor_case_key spring_keys[] = {
    {{"point", VECTOR, "m", DEFAULT(0.0), ANY, NULL,
      "where it is attached to the body, in the frame of the body's shape"},
     MOR_CASE_STORE_REALS,
     BODY(spring_point)},
    {{"anchor", VECTOR, "m", REQUIRED, ANY, NULL, "fixed end"}, MOR_CASE_STORE_REALS, BODY(spring_anchor)},
    {{"length", SCALAR, "m", DEFAULT(NAN), NOT_NEGATIVE, NULL, "length at which the force is zero"},
     MOR_CASE_STORE_REALS,
     BODY(spring_length),
     .computed = "initial distance of its ends",
     .needs = MOR_CASE_NEEDS_STIFF_SPRING},
    {{"stiffness", SCALAR, "N/m", REQUIRED, NOT_NEGATIVE, NULL, "spring force / elongation"},
     MOR_CASE_STORE_REALS,
     BODY(spring_stiffness),
     .unit_plane = "N/m2"},
    {{"damping", SCALAR, "N s/m", DEFAULT(0.0), NOT_NEGATIVE, NULL, "damping force / rate of elongation"},
     MOR_CASE_STORE_REALS,
     BODY(spring_damping),
     .unit_plane = "N s/m2"},
    END};

static const mor_case_key start_keys[] = {
    {{"type", CHOICE, "1", DEFAULT(0.0), ANY, "uniform|cantilever|twist",
      "uniform: nothing added; cantilever: first bending mode; twist: a rotation about axis that grows as "
      "sin(pi x / (2 length))"},
     MOR_CASE_STORE_CHOICE,
     BODY(motion)},
    {{"axis", VECTOR, "1", DEFAULT(0.0), ANY, NULL, "direction of the bar, away from the clamped end"},
     MOR_CASE_STORE_REALS,
     BODY(motion_axis),
     .computed = "needed with cantilever and twist",
     .is_direction = true},
    {{"direction", VECTOR, "1", DEFAULT(0.0), ANY, NULL, "direction of bending, perpendicular to axis"},
     MOR_CASE_STORE_REALS,
     BODY(motion_direction),
     .computed = "needed with cantilever",
     .is_direction = true},
    {{"origin", VECTOR, "m", DEFAULT(0.0), ANY, NULL,
      "a point of the axis at the clamped end, in the frame of the case"},
     MOR_CASE_STORE_REALS,
     BODY(motion_origin)},
    {{"length", SCALAR, "m", DEFAULT(0.0), POSITIVE, NULL, "length of the bar"},
     MOR_CASE_STORE_REALS,
     BODY(motion_length),
     .computed = "needed with cantilever and twist"},
    {{"speed", SCALAR, "m/s", DEFAULT(0.0), ANY, NULL, "initial speed of the free end"},
     MOR_CASE_STORE_REALS,
     BODY(motion_speed),
     .computed = "needed with cantilever",
     .shares_member = true},
    {{"rate", SCALAR, "rad/s", DEFAULT(0.0), ANY, NULL, "initial rate of rotation of the free end"},
     MOR_CASE_STORE_REALS,
     BODY(motion_speed),
     .computed = "needed with twist",
     .shares_member = true},
    END};

#define WRITTEN(member) offsetof(mor_case_body, member)
const mor_case_group mor_case_body_group = {"bodies", "Bodies (list)", body_keys, body_parts, WRITTEN(written)};
const mor_case_group mor_case_body_material_group = {"material", "Material of a body", material_keys, NULL,
                                                     WRITTEN(written_material)};
const mor_case_group mor_case_spring_group = {"spring", "Spring of a rigid body", spring_keys, NULL,
                                              WRITTEN(written_spring)};
const mor_case_group mor_case_start_group = {"start", "Initial velocity field of an elastic body", start_keys, NULL,
                                             WRITTEN(written_motion)};

/* ---- Contact ----------------------------------------------------------------------------------------------------- */

static const mor_case_key contact_keys[] = {
    {{"friction_coefficient", SCALAR, "1", DEFAULT(0.5), NOT_NEGATIVE, NULL,
      "Coulomb friction coefficient of pairs without their own"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_contact, friction_coefficient)},
    {{"restitution", SCALAR, "1", DEFAULT(0.5), BETWEEN(0.01, 1.0), NULL,
      "coefficient of restitution of pairs without their own: normal speed after / before an impact; 0.01: no rebound"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_contact, restitution)},
    END};

static const mor_case_part contact_parts[] = {
    {"pairs", false, "list of groups", "pairs with coefficients of their own"}, {NULL, false, NULL, NULL}};

static const mor_case_key pair_keys[] = {
    {{"first", WORDS, "1", REQUIRED, ANY, NULL, "name of a body or a wall"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_contact_pair, first)},
    {{"second", WORDS, "1", REQUIRED, ANY, NULL, "name of a body, or of a wall if the first is a body"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_contact_pair, second)},
    {{"friction_coefficient", SCALAR, "1", DEFAULT(NAN), NOT_NEGATIVE, NULL,
      "Coulomb friction coefficient of this pair"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_contact_pair, friction_coefficient),
     .computed = "that of contact"},
    {{"restitution", SCALAR, "1", DEFAULT(NAN), BETWEEN(0.01, 1.0), NULL, "coefficient of restitution of this pair"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_contact_pair, restitution),
     .computed = "that of contact"},
    END};

const mor_case_group mor_case_contact_group = {"contact", "Contact of bodies with bodies and walls", contact_keys,
                                               contact_parts, offsetof(mor_case_contact, written)};
const mor_case_group mor_case_pair_group = {"pairs", "Pairs with coefficients of their own (list)", pair_keys, NULL,
                                            offsetof(mor_case_contact_pair, written)};

/* ---- What depends on the kind of a body -------------------------------------------------------------------------- */

bool mor_case_body_is_rigid(const mor_case_body *body)
{
    bool is_rigid = false;
    for (const char *const *word = mor_case_rigid_words; *word != NULL; ++word) {
        is_rigid = is_rigid || strcmp(body->model, *word) == 0;
    }
    return is_rigid;
}

enum { ELASTIC = 1, FREE = 2, PRESCRIBED = 4 };

const char *mor_case_body_condition(const mor_case_body *body, const char *name)
{
    static const char with_free[] = "with model = \"rigid\" and motion = \"free\"";
    static const char with_elastic[] = "with the model of an elastic material";
    static const struct {
        const char *name;
        int kinds;
        const char *condition;
    } uses[] = {{"motion", FREE | PRESCRIBED, "with model = \"rigid\""},
                {"removed_at", FREE | PRESCRIBED, "with model = \"rigid\""},
                {"path", PRESCRIBED, "with model = \"rigid\" and motion = \"prescribed\""},
                {"contact_poissons_ratio", FREE | PRESCRIBED, "with model = \"rigid\""},
                {"locked", FREE, with_free},
                {"spring", FREE, with_free},
                {"clamp", ELASTIC, with_elastic},
                {"start", ELASTIC, with_elastic}};
    const int rigid_kind = body->is_prescribed ? PRESCRIBED : FREE;
    const int kind = mor_case_body_is_rigid(body) ? rigid_kind : ELASTIC;
    for (size_t k = 0; k < sizeof uses / sizeof uses[0]; ++k) {
        if (strcmp(uses[k].name, name) == 0 && (uses[k].kinds & kind) == 0) {
            return uses[k].condition;
        }
    }
    return NULL;
}

const char *mor_case_start_condition(mor_case_motion motion, const char *name)
{
    static const char with_cantilever[] = "with type = \"cantilever\"";
    static const char with_both[] = "with type = \"cantilever\" or \"twist\"";
    static const struct {
        const char *name;
        bool is_used[3]; /* by uniform, cantilever, twist */
        const char *condition;
    } uses[] = {
        {"axis", {false, true, true}, with_both},         {"direction", {false, true, false}, with_cantilever},
        {"origin", {false, true, true}, with_both},       {"length", {false, true, true}, with_both},
        {"speed", {false, true, false}, with_cantilever}, {"rate", {false, false, true}, "with type = \"twist\""}};
    for (size_t k = 0; k < sizeof uses / sizeof uses[0]; ++k) {
        if (strcmp(uses[k].name, name) == 0 && !uses[k].is_used[motion]) {
            return uses[k].condition;
        }
    }
    return NULL;
}

/* ---- Contact modulus --------------------------------------------------------------------------------------------- */

/* Square of the speed that the edges of a body have by a rotation about its middle, m2/s2. */
static double find_edge_speed(const mor_case_body *body, int dimension, double squared_rate)
{
    mor_bounds bounds;
    double squared_radius = 0.0;
    if (squared_rate == 0.0) {
        return 0.0;
    }
    mor_shape_bounds(body->shape, &bounds);
    for (int a = 0; a < dimension; ++a) {
        const double half = 0.5 * (bounds.maximum[a] - bounds.minimum[a]);
        squared_radius += half * half;
    }
    return squared_rate * squared_radius;
}

static double find_body_speed(const mor_case_body *body, int dimension)
{
    const double own = body->motion_speed * body->motion_speed;
    const bool is_twisted = body->motion == MOR_CASE_MOTION_TWIST;
    const double rate2 = mor_vector_dot(body->angular_velocity, body->angular_velocity);
    const double edge = find_edge_speed(body, dimension, fmax(rate2, is_twisted ? own : 0.0));
    return fmax(fmax(mor_vector_dot(body->velocity, body->velocity), is_twisted ? 0.0 : own), edge);
}

/* Square of the largest speed of bodies and walls at the start, m2/s2. */
static double find_start_speed2(const mor_case *the_case)
{
    double squared_speed = 0.0;
    for (int k = 0; k < the_case->n_bodies; ++k) {
        const mor_case_body *body = &the_case->bodies[k];
        const double on_path = mor_case_path_speed(the_case, &body->path, body->shape);
        squared_speed = fmax(squared_speed, find_body_speed(body, the_case->dimension));
        squared_speed = fmax(squared_speed, on_path * on_path);
    }
    for (int k = 0; k < the_case->n_walls; ++k) {
        const double *velocity = the_case->walls[k].velocity;
        const double on_path = mor_case_path_speed(the_case, &the_case->walls[k].path, the_case->walls[k].shape);
        squared_speed = fmax(squared_speed, fmax(mor_vector_dot(velocity, velocity), on_path * on_path));
    }
    return squared_speed;
}

/* Square of the largest speed of a case, m2/s2. */
static double find_squared_speed(const mor_case *the_case)
{
    double squared_speed = 0.0; /* of a fall: 2 |g| times the extent of the domain along g */
    double squared_diagonal = 0.0;
    for (int a = 0; a < the_case->dimension; ++a) {
        const double extent = the_case->domain_maximum[a] - the_case->domain_minimum[a];
        squared_speed += 2.0 * fabs(the_case->gravity[a]) * extent;
        squared_diagonal += extent * extent;
    }
    squared_speed = fmax(squared_speed, find_start_speed2(the_case));
    for (int k = 0; k < the_case->n_soils; ++k) {
        const double *velocity = the_case->soils[k].velocity;
        squared_speed = fmax(squared_speed, mor_vector_dot(velocity, velocity));
    }
    if (squared_speed == 0.0) { /* what crosses the domain before the end */
        squared_speed = squared_diagonal / (the_case->end * the_case->end);
    }
    return squared_speed;
}

double mor_case_largest_speed(const mor_case *the_case)
{
    return sqrt(find_squared_speed(the_case));
}

double mor_case_start_speed(const mor_case *the_case)
{
    return sqrt(find_start_speed2(the_case));
}

double mor_case_contact_modulus(const mor_case *the_case, const mor_case_body *body)
{
    const double speed = CHOSEN_WAVE_SPEED * the_case->scale_length / the_case->scale_time;
    return isnan(body->contact_modulus) ? body->density * speed * speed : body->contact_modulus;
}
