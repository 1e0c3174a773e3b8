/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "tests/common/case_reading.h"

/* Everything a case in three dimensions may say about bodies. */
static const char rocks_text[] =
    "dimension = 3; spacing = \"5 mm\"; end = \"0.5 s\"; gravity = (0, 0, \"-9.81 m/s2\");\n"
    "domain = { min = (-1, -1, 0); max = (1, 1, 2); };\n"
    "placement = { axis = (1, 0, 0); angle = \"30 deg\"; translation = (0, 0.5, 0); };\n"
    "soil = ( { name = \"bed\"; shape = { type = \"box\"; min = (-0.5, -0.5, 0); max = (0.5, 0.5, 0.2); };\n"
    "  material = { model = \"drucker_prager\"; density = 1500; youngs_modulus = 1e6; poissons_ratio = 0.2;\n"
    "    friction_angle = 0.5; }; } );\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0, 0); normal = (0, 0, 1); }; },\n"
    "  { name = \"gate\"; shape = { type = \"box\"; min = (1, 1, 1); max = (2, 2, 2); }; } );\n"
    "bodies = (\n"
    "  { name = \"ball\"; shape = { type = \"sphere\"; center = (0, 0, 0); radius = \"25 mm\"; };\n"
    "    position = (\"10 cm\", 0, 0.5); axis = (0, 3, 4); angle = \"30 deg\"; velocity = (0, 0, \"-2 m/s\");\n"
    "    angular_velocity = (\"0 rad/s\", 0, \"60 deg/s\"); friction = \"coulomb\"; friction_coefficient = 0.4;\n"
    "    material = { model = \"neo_hookean\"; density = \"2.2 t/m3\"; youngs_modulus = \"200 MPa\";\n"
    "      poissons_ratio = 0.25; }; },\n"
    "  { name = \"block\"; shape = { type = \"box\"; min = (-1, -1, -1); max = (1, 1, 1); }; friction = \"smooth\";\n"
    "    material = { model = \"rigid\"; density = 2400; }; contact_modulus = \"20 MPa\";\n"
    "    locked = ( \"x\", \"rz\", \"ry\" );\n"
    "    spring = { point = (1, 0, 0); anchor = (\"1 m\", 2, 3); stiffness = \"2 kN/m\"; damping = \"3 N s/m\"; }; },\n"
    "  { name = \"mill\"; motion = \"prescribed\"; angular_velocity = (0, \"1 rad/s\", 0);\n"
    "    shape = { type = \"sphere\"; center = (0, 0, 0); radius = 1; };\n"
    "    material = { model = \"rigid\"; density = 1000; }; },\n"
    "  { name = \"bar\"; shape = { type = \"box\"; min = (0, 0, 0); max = (6, 1, 1); }; contact_modulus = 5e6;\n"
    "    material = { model = \"saint_venant_kirchhoff\"; density = 1100; youngs_modulus = 17e6; poissons_ratio = "
    "0.45; "
    "};\n"
    "    clamp = { type = \"translate\"; translation = (0, 0, 1);\n"
    "      shape = { type = \"box\"; min = (-1, -1, -1); max = (0.1, 2, 2); }; };\n"
    "    start = { type = \"twist\"; axis = (2, 0, 0); origin = (0, 0.5, 0.5); length = 6; rate = \"105 rad/s\"; }; "
    "},\n"
    "  { name = \"beam\"; shape = { type = \"box\"; min = (0, 0, 0); max = (6, 1, 1); };\n"
    "    material = { model = \"neo_hookean\"; density = 1100; youngs_modulus = 17e6; poissons_ratio = 0.45; };\n"
    "    start = { type = \"cantilever\"; axis = (1, 0, 0); direction = (0, 0, 2); length = 6; speed = \"-5 cm/s\"; "
    "}; }\n"
    ");\n"
    "contact = { friction_coefficient = 0.25; pairs = ( { first = \"ball\"; second = \"floor\"; restitution = 0.9; },\n"
    "    { first = \"block\"; second = \"ball\"; friction_coefficient = 0; } ); };\n"
    "numerics = { single_rate = true; body_smoothing_ratio = 1.3; body_courant = 0.2; body_damping = 2; hourglass = "
    "0.1;"
    "\n  body_stress = \"along\"; angular_momentum = false; barrier_stiffness = \"10 kN/m\"; barrier_radius = \"2 "
    "mm\"; "
    "};\n"
    "probes = ( { type = \"penetration_depth\"; body = \"ball\"; origin = (0, 0, 0.2); },\n"
    "  { name = \"turn\"; type = \"body_rotation_angle\"; body = \"mill\"; direction = (0, 2, 0); },\n"
    "  { type = \"wall_contact_force\"; wall = \"floor\"; direction = (0, 0, 1); }, { type = \"contact_energy\"; },\n"
    "  { type = \"angular_momentum\"; direction = (1, 0, 0); origin = (0, 1, 0); }, { type = \"rate_ratio\"; } );\n"
    "expect = ( { probe = \"turn\"; value = \"90 deg\"; tolerance = 0.05; },\n"
    "  { probe = \"penetration_depth\"; value = \"2 cm\"; tolerance = \"1 mm\"; absolute = true; } );\n";

/* Bodies in the plane, without soil. */
static const char plane_text[] =
    "dimension = 2; spacing = 0.01; end = 4; gravity = (0, -8); domain = { min = (-3, 0); max = (3, 4); };\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); }; } );\n"
    "bodies = (\n"
    "  { name = \"wheel\"; shape = { type = \"sphere\"; center = (0, 0); radius = 0.5; }; position = (0, \"1 m\");\n"
    "    angle = \"15 deg\"; angular_velocity = (0, 0, 2); velocity = (1, 0);\n"
    "    material = { model = \"rigid\"; density = 1000; }; },\n"
    "  { name = \"plate\"; shape = { type = \"polygon\"; points = ((0, 0), (0.2, 0), (0.2, 0.02), (0, 0.02)); };\n"
    "    material = { model = \"neo_hookean\"; density = 1000; youngs_modulus = 2e6; poissons_ratio = 0.3975; };\n"
    "    clamp = { type = \"half_space\"; point = (0, 0); normal = (1, 0); };\n"
    "    start = { type = \"cantilever\"; axis = (1, 0); direction = (0, 1); length = 0.2; speed = 2.85; }; },\n"
    "  { name = \"post\"; shape = { type = \"box\"; min = (0, 0); max = (1, 1); }; position = (1, 1);\n"
    "    material = { model = \"rigid\"; density = 2400; }; locked = [ \"x\", \"rz\" ];\n"
    "    spring = { anchor = (0, 2); stiffness = \"2 kN/m2\"; damping = \"3 N s/m2\"; length = 1; }; }\n"
    ");\n"
    "numerics = { barrier_stiffness = \"10 kN/m2\"; };\n"
    "probes = ( { type = \"body_angular_velocity\"; body = \"wheel\"; }, { type = \"body_kinetic_energy\"; body = "
    "\"plate\"; },\n"
    "  { type = \"angular_momentum\"; direction = (0, 0, -1); } );\n"
    "expect = ( { probe = \"body_kinetic_energy\"; value = \"4.065 J/m\"; tolerance = 0.01; } );\n";

/* ---- What arrives ------------------------------------------------------------------------------------------------ */

static void bodies_arrive_in_si(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, rocks_text, NULL, &f->first);
    const mor_case_body *b = f->first.bodies;
    assert_int_equal(f->first.n_bodies, 5);
    assert_string_equal(b[0].name, "ball");
    assert_int_equal(b[0].place.line, 10);
    assert_true(b[0].position[0] == 0.1 && b[0].position[2] == 0.5);    /* exact: decimal factors round once */
    assert_true(b[0].axis[1] == 3.0 && b[0].axis[2] == 4.0);            /* exact: as written */
    assert_true(fabs(b[0].angle - MOR_PI / 6.0) < 2e-16);               /* 1 ulp */
    assert_true(b[0].velocity[2] == -2.0);                              /* exact */
    assert_true(fabs(b[0].angular_velocity[2] - MOR_PI / 3.0) < 4e-16); /* 2 ulp */
    assert_int_equal(b[0].soil_friction, MOR_CASE_FRICTION_COULOMB);
    assert_true(b[0].soil_friction_coefficient == 0.4 && b[0].density == 2200.0); /* exact */
    const mor_schema *schema = mor_registry_find(f->registry, "neo_hookean")->parameters;
    assert_true(b[0].parameters[mor_params_offset(schema, mor_params_find(schema, "youngs_modulus"))] ==
                2e8); /* exact */
    assert_true(mor_shape_distance(b[0].shape, (double[]){0.0, 0.0, 0.024}) < 0.0);
    assert_int_equal(b[1].soil_friction, MOR_CASE_FRICTION_SMOOTH);
    assert_true(b[1].contact_modulus == 2e7); /* exact */
    const bool locks[MOR_CASE_LOCKS] = {true, false, false, false, true, true};
    assert_memory_equal(b[1].is_locked, locks, sizeof locks);
    assert_true(b[1].has_spring && b[1].spring_point[0] == 1.0 && b[1].spring_anchor[2] == 3.0); /* exact */
    assert_true(b[1].spring_stiffness == 2000.0 && b[1].spring_damping == 3.0);                  /* exact */
    assert_true(isnan(b[1].spring_length));
    assert_true(b[2].is_prescribed && !b[1].is_prescribed && !b[2].has_spring);
    assert_true(b[3].clamp != NULL && b[0].clamp == NULL);
    assert_true(mor_shape_distance(b[3].clamp, (double[]){0.0, 0.5, 2.5}) < 0.0);
    assert_int_equal(b[3].motion, MOR_CASE_MOTION_TWIST);
    assert_true(b[3].motion_axis[0] == 2.0 && b[3].motion_origin[1] == 0.5); /* exact */
    assert_true(b[3].motion_length == 6.0 && b[3].motion_speed == 105.0);    /* exact */
    assert_int_equal(b[4].motion, MOR_CASE_MOTION_CANTILEVER);
    assert_true(b[4].motion_direction[2] == 2.0 && b[4].motion_speed == -0.05); /* exact */
    assert_int_equal(b[0].motion, MOR_CASE_MOTION_UNIFORM);
}

static void contact_and_settings_arrive(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, rocks_text, NULL, &f->first);
    const mor_case_contact *contact = &f->first.contact;
    assert_true(contact->friction_coefficient == 0.25 && contact->restitution == 0.5); /* exact: given; default */
    assert_int_equal(contact->n_pairs, 2);
    assert_string_equal(contact->pairs[0].second, "floor");
    assert_true(contact->pairs[0].friction_coefficient == 0.25); /* exact: that of contact */
    assert_true(contact->pairs[0].restitution == 0.9);           /* exact */
    assert_true(contact->pairs[1].friction_coefficient == 0.0);  /* exact */
    assert_true(contact->pairs[1].restitution == 0.5);           /* exact: that of contact */
    const mor_scheme *n = &f->first.numerics;
    assert_true(n->single_rate && !n->angular_momentum);
    assert_true(n->body_smoothing_ratio == 1.3 && n->body_courant == 0.2);      /* exact */
    assert_true(n->body_damping == 2.0 && n->hourglass == 0.1);                 /* exact */
    assert_true(n->barrier_stiffness == 10000.0 && n->barrier_radius == 0.002); /* exact */
    assert_int_equal(n->body_stress, 1);
    const mor_case_probe *p = f->first.probes;
    assert_string_equal(p[0].body, "ball");
    assert_true(p[0].origin[2] == 0.2 && p[1].direction[1] == 1.0);           /* exact; exact: 2 / 2 */
    assert_true(fabs(f->first.expectations[0].value - 0.5 * MOR_PI) < 4e-16); /* 2 ulp */
    assert_true(fabs(f->first.expectations[1].tolerance - 0.001) < 1e-18);    /* 1 ulp */
}

static void what_is_not_written_about_bodies_gets_its_default(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, plane_text, NULL, &f->first);
    const mor_case *c = &f->first;
    assert_int_equal(c->n_soils, 0);
    assert_true(c->contact.friction_coefficient == 0.5 && c->contact.restitution == 0.5);     /* exact */
    assert_true(c->numerics.body_smoothing_ratio == 1.15 && c->numerics.body_courant == 0.5); /* exact */
    assert_true(c->numerics.body_damping == 1.0 && c->numerics.hourglass == 0.1);             /* exact */
    assert_true(c->numerics.barrier_radius == 0.01);                                          /* exact: the spacing */
    assert_true(!c->numerics.single_rate && c->numerics.angular_momentum);
    assert_int_equal(c->numerics.body_stress, 2); /* linear */
    const mor_case_body *b = c->bodies;
    assert_true(b[0].axis[0] == 0.0 && b[0].axis[1] == 0.0 && b[0].axis[2] == 1.0); /* exact */
    assert_int_equal(b[0].soil_friction, MOR_CASE_FRICTION_ROUGH);
    assert_true(isnan(b[0].contact_modulus) && b[2].spring_length == 1.0);                /* exact */
    assert_true(b[1].contact_modulus == 2e6);                                             /* exact: Young's modulus */
    assert_true(b[1].position[0] == 0.0 && b[1].angle == 0.0 && b[1].velocity[1] == 0.0); /* exact */
    /* In the plane a turn is about z unless the file says against it. */
    assert_true(c->probes[0].direction[2] == 1.0 && c->probes[2].direction[2] == -1.0); /* exact */
}

/* ---- The contact modulus that is chosen -------------------------------------------------------------------------- */

static double choose_modulus(case_reading *f, const char *const *settings)
{
    case_reading_read(f, plane_text, settings, &f->first);
    return mor_case_contact_modulus(&f->first, &f->first.bodies[0]);
}

/* A force must not depend on how much air the domain holds, nor on what else there is in the case. */
static void the_modulus_of_a_rigid_body_depends_on_that_body_alone(void **state)
{
    case_reading *f = *state;
    const double chosen = 1000.0 * 1000.0 * 1000.0; /* density times the square of 1000 m/s */
    assert_true(choose_modulus(f, NULL) == chosen); /* exact: products of whole numbers */
    assert_true(choose_modulus(f, (const char *[]){"domain.max=(64, 64)", NULL}) == chosen);
    assert_true(choose_modulus(f, (const char *[]){"gravity=(0, 0)", "walls[0].velocity=(0, 16)", NULL}) == chosen);
    assert_true(choose_modulus(f, (const char *[]){"bodies[0].velocity=(12, 5)", "end=64", NULL}) == chosen);
    assert_true(choose_modulus(f, (const char *[]){"bodies[0].contact_modulus=3 MPa", NULL}) == 3e6); /* exact: given */
}

static void the_speed_at_the_start_is_that_of_the_fastest_point(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, plane_text, (const char *[]){"bodies[1].start.speed=1", NULL}, &f->first);
    assert_true(mor_case_start_speed(&f->first) == sqrt(2.0)); /* exact: the edge of the wheel, 2 rad/s * sqrt(0.5) m */
    case_reading_read(f, plane_text, (const char *[]){"bodies[0].velocity=(12, 5)", NULL}, &f->first);
    assert_true(mor_case_start_speed(&f->first) == 13.0); /* exact */
    case_reading_read(f, plane_text, (const char *[]){"walls[0].velocity=(0, 16)", NULL}, &f->first);
    assert_true(mor_case_start_speed(&f->first) == 16.0); /* exact */
}

/* ---- What is refused --------------------------------------------------------------------------------------------- */

typedef struct refusal {
    const char *setting;
    const char *fragment;
} refusal;

static void refuse_all(case_reading *f, const char *text, const char *start, const refusal *rows, size_t n_rows)
{
    for (size_t k = 0; k < n_rows; ++k) {
        case_reading_refuse(f, text, (const char *[]){rows[k].setting, NULL}, start, rows[k].fragment);
    }
}

static void what_has_no_effect_on_a_body_is_refused(void **state)
{
    static const refusal rows[] = {
        {"bodies[0].motion=free", "found 'motion', which has no effect on the body 'ball'"},
        {"bodies[0].locked=(\"x\")", "allowed: with model = \"rigid\" and motion = \"free\""},
        {"bodies[0].spring.stiffness=1", "found 'spring', which has no effect"},
        {"bodies[1].start.type=uniform", "found 'start', which has no effect"},
        {"bodies[1].clamp.type=sphere", "with the model of an elastic material"},
        {"bodies[2].spring.stiffness=1", "motion = \"free\""},
        {"bodies[2].locked=(\"x\")", "motion = \"free\""},
        {"bodies[1].friction_coefficient=0.1", "'friction_coefficient', which has no effect"},
        {"bodies[2].material.youngs_modulus=1e6", "unknown name 'youngs_modulus' in bodies[2].material"},
        {"bodies[3].start.speed=1", "found 'speed', which has no effect with this type of start"},
        {"bodies[4].start.rate=1", "allowed: with type = \"twist\""},
        {"bodies[3].start.direction=(0, 1, 0)", "allowed: with type = \"cantilever\""}};
    refuse_all(*state, rocks_text, "override", rows, sizeof rows / sizeof rows[0]);
    case_reading_refuse(*state, rocks_text, (const char *[]){"bodies[4].start.type=uniform", NULL}, "t.cfg:29",
                        "found 'axis', which has no effect with this type of start");
}

static void what_makes_no_body_is_refused(void **state)
{
    static const refusal rows[] = {
        {"bodies[0].axis=(0, 0, 0)", "a direction of length zero"},
        {"bodies[0].contact_modulus=0", "allowed: > 0 Pa"},
        {"bodies[0].friction_coefficient=-0.1", "allowed: >= 0"},
        {"bodies[0].material.model=drucker_prager", "allowed: rigid, neo_hookean, saint_venant_kirchhoff"},
        {"bodies[0].material.poissons_ratio=0.5", "allowed: in (-1, 0.5)"},
        {"bodies[1].velocity=(1, 0, 0)", "found velocity with a component that 'x' in locked removes"},
        {"bodies[1].angular_velocity=(0, 1, 0)", "found angular_velocity with a component that 'ry' in locked"},
        {"bodies[1].locked=(\"y\")", "found 'y' in locked, which the rotation of placement moves away from its axis"},
        {"bodies[1].locked=(\"ry\", \"rx\")", "found 'ry' in locked, which the rotation"},
        {"bodies[1].locked=(\"rq\")", "allowed: x, y, z, rx, ry, rz"},
        {"bodies[1].locked=x", "allowed: a list"},
        {"bodies[1].locked=(1)", "allowed: x, y, z"},
        {"bodies[1].spring.stiffness=-1", "allowed: >= 0 N/m"},
        {"bodies[1].spring.stiffness=1 N/m2", "converts to N/m"},
        {"bodies[4].start.direction=(1, 0, 1)", "at right angles to axis"},
        {"bodies[4].start.length=0", "allowed: > 0 m"},
        {"bodies[0].name=gate", "the name 'gate' again"},
        {"bodies[2].name=block", "the name 'block' again"},
        {"bodies[0].shape={ type = \"half_space\"; point = (0, 0, 0); normal = (0, 0, 1); }", "unbounded along x"},
        {"bodies[0].shape={ type = \"polygon\"; points = ((0, 0), (1, 0), (0, 1)); }", "unbounded along z"},
        {"bodies[0].name=a_name_of_forty_eight_bytes_is_one_byte_too_long_", "fewer than 48"},
        {"walls[0].name=a_name_of_forty_eight_bytes_is_one_byte_too_long_", "fewer than 48"}};
    refuse_all(*state, rocks_text, "override", rows, sizeof rows / sizeof rows[0]);
    case_reading_refuse(*state, rocks_text,
                        (const char *[]){"bodies[1].spring.stiffness=0", "bodies[1].spring.damping=0", NULL},
                        "t.cfg:18", "found a spring of stiffness 0 and damping 0");
}

static void a_contact_that_cannot_be_is_refused(void **state)
{
    static const refusal rows[] = {
        {"contact.restitution=0", "allowed: in [0.01, 1]"},
        {"contact.restitution=1.5", "allowed: in [0.01, 1]"},
        {"contact.friction_coefficient=-0.1", "allowed: >= 0"},
        {"contact.pairs[0].second=flor", "did you mean 'floor'?"},
        {"contact.pairs[0].first=bed", "allowed: ball, block, mill, bar, beam, floor, gate (name of a body or a wall)"},
        {"contact.pairs[0].first=gate", "a pair of two walls, 'gate' and 'floor'"},
        {"contact.pairs[0].second=ball", "a pair of 'ball' with itself"},
        {"contact.pairs[0].second=block", "the pair of 'block' and 'ball' again"},
        {"contact.pairs[0].restitution=0", "allowed: in [0.01, 1]"},
        {"contact.stiffness=1", "unknown name 'stiffness' in contact"}};
    refuse_all(*state, rocks_text, "", rows, sizeof rows / sizeof rows[0]);
}

static void bodies_stay_in_the_plane(void **state)
{
    static const refusal rows[] = {
        {"bodies[0].position=(0, 0, 1)", "found position with a component along z"},
        {"bodies[0].velocity=(0, 0, 1)", "found velocity with a component along z"},
        {"bodies[0].angular_velocity=(1, 0, 0)", "found angular_velocity with a component in the plane"},
        {"bodies[0].axis=(0, 1, 1)", "found axis with a component in the plane"},
        {"bodies[2].locked=(\"z\")", "allowed: x, y, rz"},
        {"bodies[2].locked=(\"rx\")", "allowed: x, y, rz"},
        {"bodies[2].spring.anchor=(0, 0, 1)", "found anchor with a component along z"},
        {"bodies[2].spring.stiffness=1 N/m", "converts to N/m2"},
        {"bodies[2].spring.damping=1 N s/m", "converts to N s/m2"},
        {"numerics.barrier_stiffness=1 N/m", "converts to N/m2"},
        {"bodies[1].start.direction=(0, 0, 1)", "found direction with a component along z"},
        {"probes[0].direction=(1, 0, 0)", "found direction with a component in the plane"}};
    refuse_all(*state, plane_text, "override", rows, sizeof rows / sizeof rows[0]);
    case_reading_refuse(
        *state, plane_text,
        (const char *[]){"bodies[1].start={ type = \"twist\"; axis = (1, 0); length = 1; rate = 1; }", NULL},
        "override", "found a twist in plane strain");
}

static void a_probe_of_what_is_not_there_is_refused(void **state)
{
    case_reading *f = *state;
    static const refusal without_soil[] = {
        {"probes=( { name = \"far\"; type = \"run_out\"; } )", "found the probe 'far' of type 'run_out'"},
        {"probes=( { type = \"rate_ratio\"; } )", "in a case without soil"},
        {"probes=( { name = \"time\"; type = \"contact_energy\"; } )", "which are columns of series.csv already"},
        {"probes=( { name = \"rate_ratio\"; type = \"contact_energy\"; } )", "which are columns of series.csv already"},
        {"probes=( { type = \"body_force_soil\"; body = \"wheel\"; direction = (0, 1); } )", "without soil"},
        {"probes=( { type = \"body_velocity\"; body = \"weel\"; direction = (0, 1); } )", "did you mean 'wheel'?"},
        {"probes=( { type = \"body_velocity\"; body = \"floor\"; direction = (0, 1); } )", "name of a body"},
        {"probes=( { type = \"body_velocity\"; direction = (0, 1); } )", "found no 'body'"},
        {"probes=( { type = \"body_velocity\"; body = \"wheel\"; } )", "found no 'direction'"},
        {"probes=( { type = \"contact_energy\"; body = \"wheel\"; } )", "'body', which has no effect"}};
    refuse_all(f, plane_text, "override", without_soil, sizeof without_soil / sizeof without_soil[0]);
    case_reading_refuse(f, rocks_text,
                        (const char *[]){"probes=( { type = \"body_rotation_angle\"; body = \"mill\"; } )", NULL},
                        "override", "found no 'direction'");
}

static const char soil_text[] =
    "dimension = 2; spacing = 0.01; end = 1; gravity = (0, -9.81); domain = { min = (-1, -1); max = (1, 1); };\n"
    "soil = ( { name = \"heap\"; shape = { type = \"box\"; min = (0, 0); max = (0.5, 0.25); };\n"
    "  material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 1e6; poissons_ratio = 0.2;\n"
    "    friction_angle = 0.5; }; } );\n";

static void a_case_without_bodies_takes_nothing_that_is_about_them(void **state)
{
    static const refusal rows[] = {
        {"probes=( { type = \"bodies_kinetic_energy\"; } )", "in a case without bodies"},
        {"probes=( { type = \"contact_depth\"; } )", "in a case without bodies"},
        {"contact.restitution=1", "found 'contact', which has no effect in a case without bodies"},
        {"bodies=( )", "allowed: a list of 1 to 4096 groups"},
        {"soil=( )", "allowed: a list of 1 to 16 groups"}};
    refuse_all(*state, soil_text, "", rows, sizeof rows / sizeof rows[0]);
}

static void a_cut_case_of_bodies_leaves_nothing_behind(void **state)
{
    case_reading *f = *state;
    mor_case_clear(&f->context, &f->first);
    const size_t before = f->context.memory_bytes;
    int n_refused = 0;
    for (size_t n_bytes = strlen(soil_text); n_bytes < strlen(rocks_text); n_bytes += 29) {
        n_refused += case_reading_try(f, rocks_text, n_bytes, NULL, &f->first) != MOR_OK ? 1 : 0;
        mor_case_clear(&f->context, &f->first);
        assert_true(f->context.memory_bytes == before);
    }
    assert_true(n_refused > 50); /* most of the prefixes end within a group */
}

/* ---- Scale, writing and reading again ---------------------------------------------------------------------------- */

static void the_scale_multiplies_everything_about_bodies(void **state)
{
    const char *scale[] = {"scale.length=4", "scale.mass=0.0625", "scale.time=64", NULL};
    case_reading *f = *state;
    static const char *const texts[] = {rocks_text, plane_text};
    for (size_t k = 0; k < sizeof texts / sizeof texts[0]; ++k) {
        case_reading_read(f, texts[k], NULL, &f->first);
        case_reading_read(f, texts[k], scale, &f->second);
        case_reading_scaled_cases(f);
        const double plain = mor_case_contact_modulus(&f->first, &f->first.bodies[f->first.n_soils == 0 ? 0 : 2]);
        const double scaled = mor_case_contact_modulus(&f->second, &f->second.bodies[f->first.n_soils == 0 ? 0 : 2]);
        assert_true(scaled == plain * 0.0625 / 4.0 / 4096.0); /* exact: m / (l t2), powers of two */
    }
    assert_true(f->second.bodies[2].spring_stiffness == 2000.0 * 0.0625 / 4.0 / 4096.0); /* exact: N/m2 in the plane */
}

static void a_written_case_of_bodies_reads_back_to_the_same_bits(void **state)
{
    case_reading_round_trip(*state, rocks_text, NULL);
    case_reading_round_trip(*state, plane_text, NULL);
    case_reading_round_trip(*state, rocks_text,
                            (const char *[]){"scale.length=4", "scale.mass=0.0625", "scale.time=64",
                                             "bodies[0].angle=7 deg", "bodies[1].spring.length=0.3 ft", NULL});
    case_reading_round_trip(*state, plane_text,
                            (const char *[]){"scale.length=0.25", "scale.time=16", "bodies[2].locked=()", NULL});
}

static void a_written_body_says_what_was_chosen(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, plane_text, NULL, &f->first);
    char *text = case_reading_write(f, &f->first);
    assert_non_null(strstr(text, "# contact_modulus: youngs_modulus; of a rigid body"));
    assert_non_null(strstr(text, "contact_modulus = \"2000000.0 Pa\"; # default\n"));
    assert_non_null(strstr(text, "motion = \"free\"; # default\n"));
    assert_non_null(strstr(text, "locked = (\"x\", \"rz\");\n"));
    assert_non_null(strstr(text, "stiffness = \"2000.0 N/m2\";\n"));
    assert_non_null(strstr(text, "speed = \"2.85 m/s\";\n"));
    assert_null(strstr(text, " rate = "));
    assert_non_null(strstr(text, "restitution = 0.5; # default\n"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_arrive_in_si),
        cmocka_unit_test(contact_and_settings_arrive),
        cmocka_unit_test(what_is_not_written_about_bodies_gets_its_default),
        cmocka_unit_test(the_modulus_of_a_rigid_body_depends_on_that_body_alone),
        cmocka_unit_test(the_speed_at_the_start_is_that_of_the_fastest_point),
        cmocka_unit_test(what_has_no_effect_on_a_body_is_refused),
        cmocka_unit_test(what_makes_no_body_is_refused),
        cmocka_unit_test(a_contact_that_cannot_be_is_refused),
        cmocka_unit_test(bodies_stay_in_the_plane),
        cmocka_unit_test(a_probe_of_what_is_not_there_is_refused),
        cmocka_unit_test(a_case_without_bodies_takes_nothing_that_is_about_them),
        cmocka_unit_test(a_cut_case_of_bodies_leaves_nothing_behind),
        cmocka_unit_test(the_scale_multiplies_everything_about_bodies),
        cmocka_unit_test(a_written_case_of_bodies_reads_back_to_the_same_bits),
        cmocka_unit_test(a_written_body_says_what_was_chosen),
    };
    return cmocka_run_group_tests(tests, case_reading_set_up, case_reading_tear_down);
}
