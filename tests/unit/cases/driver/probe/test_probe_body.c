/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/particle/boundary.h"
#include "tests/common/scene.h"

/* Probes of bodies against what mechanics says of a box that flies, slides, lies still, and of one pushed into soil. */

static const double density = 2400.0;
static const double side = 0.4;
static const double gravity = 10.0;

#define BOX                                                                                                            \
    "dimension = 2; spacing = '0.05 m'; end = '2 s'; gravity = (0, -10, 0);"                                           \
    "domain = { min = (-8, -8, -1); max = (8, 8, 1); };"                                                               \
    "bodies = ( { name = 'box'; shape = { type = 'box'; min = (-0.2, -0.2); max = (0.2, 0.2); };"                      \
    "    contact_modulus = '1 MPa'; material = { model = 'rigid'; density = 2400; };"

static const char flying[] =
    BOX "  position = (1, 2); velocity = (1, 3); angular_velocity = (0, 0, 5); } );"
        "probes = ( { name = 'x'; type = 'body_position'; body = 'box'; origin = (0.5, 0); direction = (1, 0); },"
        "  { name = 'v'; type = 'body_velocity'; body = 'box'; direction = (0, 1); },"
        "  { name = 'turn'; type = 'body_rotation_angle'; body = 'box'; direction = (0, 0, 1); },"
        "  { name = 'spin'; type = 'body_angular_velocity'; body = 'box'; direction = (0, 0, 1); },"
        "  { name = 'energy'; type = 'body_kinetic_energy'; body = 'box'; }, { type = 'bodies_kinetic_energy'; },"
        "  { name = 'height'; type = 'potential_energy'; origin = (0, 0.5); },"
        "  { type = 'momentum'; direction = (0, 1); },"
        "  { type = 'angular_momentum'; origin = (0.5, 0); direction = (0, 0, 1); },"
        "  { name = 'depth'; type = 'penetration_depth'; body = 'box'; origin = (0, 3); },"
        "  { name = 'deepest'; type = 'penetration_depth_largest'; body = 'box'; origin = (0, 3); } );";

static scene *make(const char *text)
{
    const scene_request request = {text, NULL, 0, 1};
    return scene_new(&request);
}

static void expect(scene *it, const char *name, double expected, double tolerance)
{
    scene_expect_near(name, scene_probe(it, name), expected, tolerance);
}

/* At the start, and a time later. */
static void check_flight(scene *it, double time)
{
    const double mass = density * side * side;
    const double inertia = mass * side * side / 6.0;
    const double x = 1.0 + time;
    const double y = 2.0 + 3.0 * time - 0.5 * gravity * time * time;
    const double v = 3.0 - gravity * time;
    const double kinetic = 0.5 * mass * (1.0 + v * v) + 0.5 * inertia * 25.0;
    const double error = 1e-9; /* rounding of some thousand steps, over numbers near 10 */
    expect(it, "x", x - 0.5, error);
    expect(it, "v", v, error);
    expect(it, "turn", 5.0 * time, error);
    expect(it, "spin", 5.0, error);
    expect(it, "energy", kinetic, error * kinetic);
    expect(it, "bodies_kinetic_energy", kinetic, error * kinetic);
    expect(it, "height", mass * gravity * (y - 0.5), error * mass * gravity * 10.0);
    expect(it, "momentum", mass * v, error * mass * 10.0);
    expect(it, "angular_momentum", mass * ((x - 0.5) * v - y) + 5.0 * inertia, error * mass * 100.0);
    /* The lowest of four corners. */
    const double reach = 0.5 * side * (fabs(cos(5.0 * time)) + fabs(sin(5.0 * time)));
    expect(it, "depth", 3.0 - (y - reach), 1e-6 * side); /* places of nodes by Newton steps */
}

static void motion_of_a_flying_box_is_that_of_a_throw(void **state)
{
    (void)state;
    scene *it = make(flying);
    check_flight(it, 0.0);
    scene_require(it, mor_probe_follow(&it->context, &it->simulation));
    scene_advance(it, 0.25);
    check_flight(it, 0.25);
    expect(it, "deepest", 3.0 - (2.0 - 0.5 * side), 1e-6 * side); /* at the start: it rises faster than corners turn */
    scene_advance(it, 1.5);
    check_flight(it, 1.5); /* more than a full revolution */
    assert_true(scene_probe(it, "deepest") == scene_probe(it, "depth"));
    scene_free(it);
}

/* Near where the floor carries it: the sink is weight / (modulus / spacing). */
static const char resting[] =
    BOX "  position = (0, '199.55 mm'); } );"
        "contact = { friction_coefficient = 0.4; restitution = 0.1; };"
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
        "probes = ( { name = 'on_floor'; type = 'wall_contact_force'; wall = 'floor'; direction = (0, 1); },"
        "  { name = 'on_box'; type = 'body_force_contact'; body = 'box'; direction = (0, 1); },"
        "  { name = 'depth'; type = 'contact_depth'; }, { name = 'spring'; type = 'contact_energy'; },"
        "  { name = 'elastic'; type = 'bodies_elastic_energy'; } );";

static void box_at_rest_presses_with_its_weight(void **state)
{
    (void)state;
    const double weight = density * side * side * gravity;
    scene *it = make(resting);
    scene_advance(it, 0.6);                         /* damping for so little rebound lets it sink in some 0.1 s */
    expect(it, "on_floor", -weight, 1e-3 * weight); /* what is still to sink */
    expect(it, "on_box", weight, 1e-3 * weight);    /* likewise */
    /* The load grows with the depth by a power of 1, while the contact is narrow, to 0.6, docs/theory/contact.md (C3b);
     * so the energy is 1/2 to 1/1.6 of load times depth. */
    const double depth = scene_probe(it, "depth");
    const double stored = scene_probe(it, "spring");
    assert_true(depth > 0.0 && depth < 0.1 * 0.05);                                  /* a tenth of the spacing */
    assert_true(stored > 0.499 * weight * depth && stored < 0.626 * weight * depth); /* what still swings */
    expect(it, "elastic", stored, 1e-12 * stored);                                   /* the same number, added up */
    scene_free(it);
}

static const char sliding[] =
    BOX "  position = (0, '199.52 mm'); velocity = (2, 0); } );"
        "contact = { friction_coefficient = 0.4; restitution = 0.5; };"
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
        "probes = ( { name = 'way'; type = 'body_position'; body = 'box'; direction = (1, 0); },"
        "  { name = 'friction'; type = 'contact_friction_energy'; }, { name = 'lost'; type = 'dissipated_energy'; },"
        "  { name = 'rebound'; type = 'contact_damping_energy'; }, { name = 'balance'; type = "
        "'bodies_energy_balance'; } );";

static void sliding_box_loses_friction_times_way(void **state)
{
    (void)state;
    const double weight = density * side * side * gravity;
    scene *it = make(sliding);
    scene_advance(it, 0.3);
    const double way = scene_probe(it, "way");
    scene_expect_near("way", way, 2.0 * 0.3 - 0.5 * 0.4 * gravity * 0.09, 0.01 * way); /* it tips a little first */
    expect(it, "friction", 0.4 * weight * way, 0.01 * weight * way);                   /* likewise */
    expect(it, "lost", scene_probe(it, "friction") + scene_probe(it, "rebound"), 0.01 * weight * way); /* the step */
    expect(it, "balance", 1.0, 0.01);                                                                  /* likewise */
    assert_true(scene_probe(it, "lost") > 0.0);
    scene_free(it);
}

/* It falls 0.1 m, flat. */
static const char bouncing[] =
    BOX "  position = (0, 0.3); } );"
        "contact = { friction_coefficient = 0.4; restitution = 0.5; };"
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
        "probes = ( { name = 'friction'; type = 'contact_friction_energy'; },"
        "  { name = 'rebound'; type = 'contact_damping_energy'; }, { name = 'lost'; type = 'dissipated_energy'; },"
        "  { name = 'balance'; type = 'bodies_energy_balance'; } );";

static void bouncing_box_loses_what_restitution_says(void **state)
{
    (void)state;
    const double fall = density * side * side * gravity * 0.1;
    /* Hard, so that it sinks by 1 % of its fall only. */
    static const char *const hard[] = {"bodies[0].contact_modulus='100 MPa'", NULL};
    const scene_request request = {bouncing, (const char *const *[]){hard}, 1, 1};
    scene *it = scene_new(&request);
    scene_advance(it, 0.2);
    expect(it, "friction", 0.0, 1e-9 * fall);
    expect(it, "rebound", 0.75 * fall, 0.01 * fall); /* 1 - 0.5 squared; weight while it touches */
    expect(it, "lost", 0.75 * fall, 0.01 * fall);    /* likewise */
    expect(it, "balance", 1.0, 0.003);               /* likewise, over three times the fall */
    scene_free(it);
}

static const char driven[] =
    "dimension = 2; spacing = '20 mm'; end = '1 s'; gravity = (0, -10, 0);"
    "domain = { min = (-8, -8, -1); max = (8, 8, 1); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (0.4, 0.4); };"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; cohesion = '1 kPa'; }; } );"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
    "bodies = ( { name = 'ram'; shape = { type = 'box'; min = (-0.1, -0.1); max = (0.1, 0.1); };"
    "    position = (0.51, 0.35); velocity = (-1, 0); motion = 'prescribed';"
    "    material = { model = 'rigid'; density = 2400; }; } );"
    "probes = ( { name = 'along'; type = 'body_force_soil'; body = 'ram'; direction = (1, 0); },"
    "  { name = 'upward'; type = 'body_force_soil'; body = 'ram'; direction = (0, 1); },"
    "  { name = 'moment'; type = 'body_moment_soil'; body = 'ram'; direction = (0, 0, 1); } );";

/* Force and moment of the soil are the sums over the points of the ram's surface. */
static void soil_pushes_a_ram_by_the_sum_over_its_points(void **state)
{
    (void)state;
    scene *it = make(driven);
    scene_advance(it, 0.02);
    const mor_body_group *group = it->simulation.bodies.groups[0];
    const mor_boundary *boundary = &group->boundary;
    const double *center = group->bodies[0].center;
    double force[2] = {0.0, 0.0};
    double moment = 0.0;
    for (int64_t j = 0; j < boundary->patches[0].n_points; ++j) {
        const double *x = boundary->records + MOR_BOUNDARY_RECORD * j + MOR_BOUNDARY_POSITION;
        const double *f = boundary->force + 3 * j;
        force[0] += f[0];
        force[1] += f[1];
        moment += (x[0] - center[0]) * f[1] - (x[1] - center[1]) * f[0];
    }
    const double size = mor_vector_length((const double[3]){force[0], force[1], 0.0});
    assert_true(force[0] > 0.0);
    assert_true(fabs(moment) > 0.01 * size * 0.1); /* the soil's top is level with a part of the ram only */
    expect(it, "along", force[0], 1e-12 * size);
    expect(it, "upward", force[1], 1e-12 * size);
    expect(it, "moment", moment, 1e-3 * size); /* the center has moved on by half a step, below a millimeter */
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motion_of_a_flying_box_is_that_of_a_throw),
        cmocka_unit_test(box_at_rest_presses_with_its_weight),
        cmocka_unit_test(sliding_box_loses_friction_times_way),
        cmocka_unit_test(bouncing_box_loses_what_restitution_says),
        cmocka_unit_test(soil_pushes_a_ram_by_the_sum_over_its_points),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
