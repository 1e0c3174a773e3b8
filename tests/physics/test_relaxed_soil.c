/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/geometry/shape_analytic.h"
#include "core/particle/kernel.h"
#include "tests/common/scene.h"

#include <stdio.h>

/* Soil filled with relaxed particles (docs/theory/relaxation.md, Soil): the sums of the kernel over soil and walls, the
 * order of the lattice, the mass of regions. */

#define DP 0.01

#define MATERIAL                                                                                                       \
    "material = { model = 'drucker_prager'; density = '1600 kg/m3'; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; "  \
    "friction_angle = '30 deg'; };"

#define BOX(low, high) "{ type = 'box'; min = (" low "); max = (" high "); }"
#define LAYER_BOX BOX("'0 m', '0 m'", "'0.5 m', '0.12 m'")
#define FLOOR_BOX BOX("'-0.1 m', '-0.1 m'", "'0.6 m', '0 m'")
#define LEFT_BOX BOX("'-0.1 m', '0 m'", "'0 m', '0.3 m'")
#define RIGHT_BOX BOX("'0.5 m', '0 m'", "'0.6 m', '0.3 m'")

/* A layer of 12 spacings in a trough. */
static const char trough[] = "dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '1 s';"
                             "domain = { min = ('-2 m', '-2 m'); max = ('2 m', '2 m'); };"
                             "soil = ( { name = 'layer'; shape = " LAYER_BOX "; " MATERIAL " } );"
                             "walls = ( { name = 'floor'; shape = " FLOOR_BOX "; },"
                             "{ name = 'left'; shape = " LEFT_BOX "; },"
                             "{ name = 'right'; shape = " RIGHT_BOX "; } );";

/* The same, turned about a point on its floor. */
#define TILTED(shape) "={ type = 'rotate'; angle = '17 deg'; shape = " shape "; }"

static const char *const relaxed[] = {"soil[0].particles=relaxed", NULL};
static const char *const off_lattice[] = {"lattice.origin=('0 m', '2.5 mm')", NULL};
static const char *const tilted[] = {"soil[0].shape" TILTED(LAYER_BOX), "walls[0].shape" TILTED(FLOOR_BOX),
                                     "walls[1].shape" TILTED(LEFT_BOX), "walls[2].shape" TILTED(RIGHT_BOX), NULL};
static const char *const nothing[] = {NULL};

/* Sums over soil and walls about one particle. h: smoothing length. */
typedef struct kernel_sums {
    double value;       /* sum V W, 1 */
    double gradient[3]; /* h sum V grad W, 1 */
    double moment[9];   /* sum V (r_j - r_i) (x) grad W, 1 */
} kernel_sums;

/* Root mean squares over particles. */
typedef struct sum_errors {
    double value, gradient, moment;
    int n;
} sum_errors;

static void add_point(const scene *it, const double *x, const double *point, double volume, kernel_sums *sums)
{
    const int dimension = it->the_case.dimension;
    const double h = it->the_case.numerics.smoothing_ratio * it->the_case.spacing;
    double way[3];
    for (int a = 0; a < 3; ++a) {
        way[a] = x[a] - point[a];
    }
    const double r = mor_vector_length(way);
    if (r >= MOR_KERNEL_SUPPORT * h) {
        return;
    }
    const double u = 1.0 - r / (MOR_KERNEL_SUPPORT * h);
    const double factor = -mor_kernel_gradient_factor(h, dimension) * u * u * u;
    sums->value += volume * mor_kernel_value(r, h, dimension);
    for (int a = 0; a < 3; ++a) {
        sums->gradient[a] += h * volume * factor * way[a];
        for (int b = 0; b < 3; ++b) {
            sums->moment[3 * a + b] -= volume * way[a] * factor * way[b];
        }
    }
}

static void add_boundary(const scene *it, const double *x, const mor_boundary *boundary, kernel_sums *sums)
{
    for (int64_t j = 0; j < boundary->n_points; ++j) {
        const double *record = boundary->records + j * MOR_BOUNDARY_RECORD;
        add_point(it, x, record + MOR_BOUNDARY_POSITION, record[MOR_BOUNDARY_VOLUME], sums);
    }
}

static void find_sums(const scene *it, int64_t i, kernel_sums *sums)
{
    const mor_soil *soil = &it->simulation.soil;
    double *const *data = soil->set.data;
    const double *x = data[MOR_FIELD_POSITION] + 3 * i;
    memset(sums, 0, sizeof *sums);
    for (int64_t j = 0; j < soil->set.n_particles; ++j) {
        add_point(it, x, data[MOR_FIELD_POSITION] + 3 * j, data[MOR_FIELD_MASS][j] / data[MOR_FIELD_DENSITY][j], sums);
    }
    for (int w = 0; w < it->the_case.n_walls; ++w) {
        add_boundary(it, x, soil->walls[w].boundary, sums);
    }
    for (int g = 0; g < it->simulation.bodies.n_groups; ++g) {
        add_boundary(it, x, &it->simulation.bodies.groups[g]->boundary, sums);
    }
}

/* Of the particles whose distance from the floor is in [least, most) and that are 4 spacings or more from all else. */
static sum_errors measure_errors(const scene *it, double least, double most)
{
    const mor_case *c = &it->the_case;
    const int n_axes = c->dimension;
    sum_errors errors = {0.0, 0.0, 0.0, 0};
    for (int64_t i = 0; i < it->simulation.soil.set.n_particles; ++i) {
        const double *x = it->simulation.soil.set.data[MOR_FIELD_POSITION] + 3 * i;
        const double height = mor_shape_distance(c->walls[0].shape, x);
        double side = INFINITY;
        for (int w = 1; w < c->n_walls; ++w) {
            side = fmin(side, mor_shape_distance(c->walls[w].shape, x));
        }
        if (height < least * DP || height >= most * DP || side < 4.0 * DP || height > 8.0 * DP) {
            continue;
        }
        kernel_sums sums;
        find_sums(it, i, &sums);
        errors.value += (sums.value - 1.0) * (sums.value - 1.0);
        errors.gradient += mor_vector_dot(sums.gradient, sums.gradient);
        for (int a = 0; a < n_axes; ++a) {
            for (int b = 0; b < n_axes; ++b) {
                const double error = sums.moment[3 * a + b] - (a == b ? 1.0 : 0.0);
                errors.moment += error * error / n_axes;
            }
        }
        errors.n += 1;
    }
    assert_true(errors.n > 0);
    errors.value = sqrt(errors.value / errors.n);
    errors.gradient = sqrt(errors.gradient / errors.n);
    errors.moment = sqrt(errors.moment / errors.n);
    return errors;
}

static scene *new_scene(const char *text, const char *const *first, const char *const *second, int n_threads)
{
    const char *const *lists[] = {first, second};
    return scene_new(&(scene_request){.text = text, .settings = lists, .n_lists = 2, .n_threads = n_threads});
}

static void print_errors(const char *wall, const char *particles, const scene *it)
{
    static const double limits[3][2] = {{0.0, 1.0}, {1.0, 2.0}, {3.0, 8.0}};
    static const char *const words[3] = {"first layer", "second layer", "inside"};
    for (int k = 0; k < 3; ++k) {
        const sum_errors errors = measure_errors(it, limits[k][0], limits[k][1]);
        printf("%-18s %-8s %-13s %3d particles: sum %.4f, gradient %.4f, moment %.4f\n", wall, particles, words[k],
               errors.n, errors.value, errors.gradient, errors.moment);
    }
}

/* Where a lattice lies anyhow beside a wall, the gradient of the kernel sums to 0.15 / h beside it, and its moment is 8
 * to 12 % off; relaxed particles lie where it closes, whatever the place of the wall. */
static void relaxed_soil_closes_kernel_sums_at_a_tilted_wall(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        const char *const *where;
        bool is_closed; /* by the lattice, too */
    } walls[] = {
        {"on the lattice", nothing, true}, {"a quarter off it", off_lattice, false}, {"tilted", tilted, false}};
    for (int k = 0; k < 3; ++k) {
        scene *lattice = new_scene(trough, walls[k].where, nothing, 1);
        print_errors(walls[k].name, "lattice", lattice);
        const sum_errors before = measure_errors(lattice, 0.0, 1.0);
        scene_free(lattice);
        scene *soil = new_scene(trough, walls[k].where, relaxed, 1);
        print_errors(walls[k].name, "relaxed", soil);
        const sum_errors after = measure_errors(soil, 0.0, 1.0);
        scene_free(soil);
        assert_true(walls[k].is_closed ? before.gradient < 1e-12 : before.gradient > 0.1); /* rounding; a tenth */
        assert_true(after.gradient < 0.02); /* what the end of relaxation leaves */
        assert_true(after.value < 0.015);   /* 0.0095 is the kernel's own at 1.3 */
        assert_true(after.moment < 0.04);   /* 0.026 is the kernel's own */
        assert_true(walls[k].is_closed || after.moment < 0.5 * before.moment);
    }
}

/* ---- Mass -------------------------------------------------------------------------------------------------------- */

#define LAYER(name, low, high, density)                                                                                \
    "{ name = '" name "'; shape = { type = 'box'; min = ('0 m', '" low "'); max = ('0.3 m', '" high "'); };"           \
    "particles = 'relaxed'; initial_stress = { type = 'k0'; lateral_ratio = 0.5; };"                                   \
    "material = { model = 'drucker_prager'; density = '" density "'; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; " \
    "friction_angle = '30 deg'; }; }"

/* Faces off the lattice, and a rock in the lower layer and across the face between both. */
static const char layers[] =
    "dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '-10 m/s2'); end = '1 s';"
    "domain = { min = ('-1 m', '-1 m'); max = ('1 m', '1 m'); };"
    "soil = ( " LAYER("upper", "0.083 m", "0.157 m", "1500 kg/m3") ", " LAYER(
        "lower", "0 m", "0.083 m",
        "2000 kg/m3") " );"
                      "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, "
                      "1); }; },"
                      "{ name = 'left'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; },"
                      "{ name = 'right'; shape = { type = 'half_space'; point = ('0.3 m', '0 m'); normal = (-1, 0); }; "
                      "} );"
                      "bodies = ( { name = 'rock'; position = ('0.15 m', '0.07 m'); shape = { type = 'sphere'; center "
                      "= ('0 m', '0 m');"
                      "radius = '31 mm'; }; material = { model = 'rigid'; density = '2600 kg/m3'; }; } );";

/* Mass and center along y of a region. */
static double sum_region(const scene *it, int region, double *center)
{
    const mor_soil *soil = &it->simulation.soil;
    double mass = 0.0;
    *center = 0.0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        if ((int)soil->set.data[soil->region_field][i] == region) {
            mass += soil->set.data[MOR_FIELD_MASS][i];
            *center += soil->set.data[MOR_FIELD_MASS][i] * soil->set.data[MOR_FIELD_POSITION][3 * i + 1];
        }
    }
    *center /= mass;
    return mass;
}

static void relaxed_soil_keeps_the_mass_of_its_region(void **state)
{
    (void)state;
    scene *it = scene_new(&(scene_request){.text = layers});
    const double pi = 3.14159265358979323846;
    const double r = 0.031;
    const double cut = 0.013; /* of the face above the middle of the rock */
    const double cap = r * r * acos(cut / r) - cut * sqrt(r * r - cut * cut);
    const double volumes[2] = {0.3 * 0.074 - cap, 0.3 * 0.083 - (pi * r * r - cap)};
    const double densities[2] = {1500.0, 2000.0};
    for (int k = 0; k < 2; ++k) {
        double center = 0.0;
        const double mass = sum_region(it, k, &center);
        /* relative: the integral of what the rock takes of a layer */
        scene_expect_near("mass", mass, densities[k] * volumes[k], 1e-5 * mass);
        /* All particles have one volume up to half a particle in those of the region. */
        const double each = it->simulation.particle_volumes[k] / (DP * DP);
        scene_expect_near("volume of a particle", each, 1.0, 0.5 / (double)it->simulation.region_particles[k]);
    }
    scene_free(it);
}

/* No particle of one layer lies deep in the other one, or in the rock. */
static void relaxed_soil_stays_in_its_region(void **state)
{
    (void)state;
    scene *it = scene_new(&(scene_request){.text = layers});
    const mor_soil *soil = &it->simulation.soil;
    double least = INFINITY;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        const double *x = soil->set.data[MOR_FIELD_POSITION] + 3 * i;
        const bool is_upper = soil->set.data[soil->region_field][i] < 0.5;
        const double rock = hypot(x[0] - 0.15, x[1] - 0.07) - 0.031;
        assert_true(rock > 0.2 * DP); /* a quarter is kept */
        assert_true(x[0] > 0.2 * DP && x[0] < 0.3 - 0.2 * DP && x[1] > 0.2 * DP);
        /* The outer layer lies at 0.46; beside a wall, where half of what is outside is wall, up to 0.2 higher. */
        assert_true(x[1] < 0.157 - (fabs(x[0] - 0.15) < 0.14 ? 0.44 : 0.25) * DP);
        assert_true(is_upper ? x[1] > 0.083 - 0.7 * DP : x[1] < 0.083 + 0.7 * DP); /* half a layer and its scatter */
        least = fmin(least, rock);
    }
    assert_true(least < 0.7 * DP); /* soil touches the rock: no layer is missing */
    scene_free(it);
}

/* Root mean square of h sum V grad W over the particles within a spacing of the rock. */
static double find_gradient_at_rock(const scene *it)
{
    const mor_soil *soil = &it->simulation.soil;
    double squares = 0.0;
    int n = 0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        const double *x = soil->set.data[MOR_FIELD_POSITION] + 3 * i;
        if (hypot(x[0] - 0.15, x[1] - 0.07) < 0.031 + DP) {
            kernel_sums sums;
            find_sums(it, i, &sums);
            squares += mor_vector_dot(sums.gradient, sums.gradient);
            n += 1;
        }
    }
    assert_true(n > 15); /* 20 fit around it */
    return sqrt(squares / n);
}

static void relaxed_soil_closes_kernel_sums_around_a_rock(void **state)
{
    (void)state;
    static const char *const particles[] = {"bodies[0].particles=relaxed", NULL};
    static const char *const lattices[] = {"soil[0].particles=lattice", "soil[1].particles=lattice", NULL};
    scene *soil = new_scene(layers, particles, nothing, 1);
    scene *lattice = new_scene(layers, particles, lattices, 1);
    const double found = find_gradient_at_rock(soil);
    const double before = find_gradient_at_rock(lattice);
    printf("around a rock: gradient %.4f, on the lattice %.4f\n", found, before);
    assert_true(found < 0.02 && found < 0.1 * before); /* what the end of relaxation leaves; a tenth */
    scene_free(soil);
    scene_free(lattice);
}

/* Soil that stays on the lattice is a neighbor like walls: it keeps its places, and the other fits to it. */
static void relaxed_soil_fits_to_soil_on_the_lattice(void **state)
{
    (void)state;
    static const char *const below[] = {"soil[1].particles=lattice", NULL};
    scene *it = new_scene(layers, below, nothing, 1);
    const mor_soil *soil = &it->simulation.soil;
    double lowest = INFINITY;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        const double *x = soil->set.data[MOR_FIELD_POSITION] + 3 * i;
        if (soil->set.data[soil->region_field][i] > 0.5) {
            scene_expect_near("place on the lattice", remainder(x[1] / DP - 0.5, 1.0), 0.0, 1e-12); /* rounding */
        } else if (fabs(x[0] - 0.15) > 0.06) {
            lowest = fmin(lowest, x[1]);
        }
    }
    /* The uppermost row of the lattice lies at 7.5 spacings, under a face at 8.3: a layer above it, no gap of two. */
    assert_true(lowest > 0.083 && lowest < 0.095);
    scene_free(it);
}

/* The vertical stress is the weight above to rounding, not to half a particle. */
static void relaxed_soil_bears_the_weight_of_the_shapes_above(void **state)
{
    (void)state;
    scene *it = scene_new(&(scene_request){.text = layers});
    const mor_soil *soil = &it->simulation.soil;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        const double y = soil->set.data[MOR_FIELD_POSITION][3 * i + 1];
        const double *stress = soil->set.data[MOR_FIELD_STRESS] + 6 * i;
        const bool is_upper = soil->set.data[soil->region_field][i] < 0.5;
        const double own = is_upper ? 1500.0 : 2000.0;
        const double above = fmax(0.157 - fmax(y, 0.083), 0.0);
        const double below = fmax(0.083 - y, 0.0);
        /* A particle beyond the face of its layer counts what lies above it as it is there. */
        const double expected = -10.0 * (1500.0 * above + 2000.0 * below);
        scene_expect_near("vertical stress", stress[1], expected, 10.0 * 500.0 * 0.03 * DP); /* the step of the sum */
        scene_expect_near("lateral stress", stress[0], 0.5 * stress[1], 1e-9 * own);         /* rounding */
    }
    scene_free(it);
}

/* ---- Order ------------------------------------------------------------------------------------------------------- */

static const char block[] =
    "dimension = 3; spacing = '10 mm'; gravity = ('0 m/s2', '0 m/s2', '-9.81 m/s2'); end = '1 s';"
    "domain = { min = ('-1 m', '-1 m', '-1 m'); max = ('1 m', '1 m', '1 m'); };"
    "soil = ( { name = 'block'; shape = { type = 'box'; min = ('0 m', '0 m', '0 m'); max = ('0.16 m', '0.16 m', "
    "'0.16 m'); }; " MATERIAL " } );"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 0, 1); }; "
    "} );";

/* Height of the peak of the structure factor at the period of the lattice along an axis, over that of the lattice, 1.
 * Beside faces particles lie in layers whatever they come from, so that only those inside count. */
static double find_peak(const scene *it, int axis)
{
    const mor_set *set = &it->simulation.soil.set;
    double sums[2] = {0.0, 0.0};
    double n = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        double depth = INFINITY;
        for (int a = 0; a < 3; ++a) {
            const double x = set->data[MOR_FIELD_POSITION][3 * i + a];
            depth = fmin(depth, fmin(x, 0.16 - x));
        }
        if (depth < 3.0 * DP) {
            continue;
        }
        n += 1.0;
        const double phase = 6.283185307179586 * set->data[MOR_FIELD_POSITION][3 * i + axis] / DP;
        sums[0] += cos(phase);
        sums[1] += sin(phase);
    }
    return (sums[0] * sums[0] + sums[1] * sums[1]) / (n * n);
}

static void relaxed_soil_has_no_order_of_the_lattice(void **state)
{
    (void)state;
    scene *lattice = new_scene(block, nothing, nothing, 1);
    scene *soil = new_scene(block, relaxed, nothing, 1);
    for (int axis = 0; axis < 3; ++axis) {
        scene_expect_near("peak of the lattice", find_peak(lattice, axis), 1.0, 1e-12); /* rounding */
        assert_true(find_peak(soil, axis) < 0.01); /* statistical: 1 / n = 0.001 without any order */
    }
    scene_free(lattice);
    scene_free(soil);
}

static void relaxed_soil_is_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    static const char *const small[] = {"soil[0].shape.max=('0.08 m', '0.08 m', '0.08 m')", NULL};
    scene *one = new_scene(block, relaxed, small, 1);
    scene *two = new_scene(block, relaxed, small, 2);
    const mor_set *first = &one->simulation.soil.set;
    const mor_set *second = &two->simulation.soil.set;
    assert_int_equal(first->n_particles, second->n_particles);
    assert_memory_equal(first->data[MOR_FIELD_POSITION], second->data[MOR_FIELD_POSITION],
                        (size_t)(3 * first->n_particles) * sizeof(double));
    scene_free(one);
    scene_free(two);
}

/* A change of units by powers of two changes no bit, and a turn of the scene nothing but rounding. */
static void relaxed_soil_is_the_same_in_other_units_and_places(void **state)
{
    (void)state;
    static const char *const units[] = {"scale={length=4; time=4; mass=4;}", NULL};
    static const char *const turned[] = {"placement.angle='90 deg'", NULL};
    scene *it = new_scene(layers, nothing, nothing, 1);
    scene *scaled = new_scene(layers, units, nothing, 1);
    scene *placed = new_scene(layers, turned, nothing, 1);
    const mor_set *sets[3] = {&it->simulation.soil.set, &scaled->simulation.soil.set, &placed->simulation.soil.set};
    assert_int_equal(sets[0]->n_particles, sets[1]->n_particles);
    assert_int_equal(sets[0]->n_particles, sets[2]->n_particles);
    scene_find_places(it);
    scene_find_places(scaled);
    for (int64_t k = 0; k < sets[0]->n_particles; ++k) {
        const double *x = sets[0]->data[MOR_FIELD_POSITION] + 3 * it->place[k];
        const double *y = sets[1]->data[MOR_FIELD_POSITION] + 3 * scaled->place[k];
        assert_true(y[0] == 4.0 * x[0] && y[1] == 4.0 * x[1]);
        double nearest = INFINITY;
        for (int64_t i = 0; i < sets[2]->n_particles; ++i) {
            const double *z = sets[2]->data[MOR_FIELD_POSITION] + 3 * i;
            nearest = fmin(nearest, hypot(z[1] - x[0], z[0] + x[1]));
        }
        assert_true(nearest < 1e-9 * DP); /* rounding of 1e-16 that grows over 300 steps */
    }
    scene_free(it);
    scene_free(scaled);
    scene_free(placed);
}

/* ---- What cannot be relaxed -------------------------------------------------------------------------------------- */

/* Reads and builds a scene that is refused; the message has a word. */
static void refuse(const char *text, const char *const *settings, const char *word)
{
    mor_context context;
    mor_registry *registry = NULL;
    mor_case *the_case = calloc(1, sizeof *the_case);
    mor_simulation *simulation = calloc(1, sizeof *simulation);
    char *quoted = scene_quote(text);
    assert_non_null(the_case);
    assert_non_null(simulation);
    int n_settings = 0;
    while (settings[n_settings] != NULL) {
        n_settings += 1;
    }
    mor_context_init(&context);
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)), MOR_OK);
    const mor_case_text source = {.name = "scene",
                                  .text = quoted,
                                  .n_bytes = (int64_t)strlen(quoted),
                                  .settings = settings,
                                  .n_settings = n_settings,
                                  .registry = registry,
                                  .probe_types = mor_probe_type_at};
    mor_status status = mor_case_read_text(&context, &source, the_case);
    if (status == MOR_OK) {
        status = mor_simulation_init(&context, simulation, the_case, registry);
        mor_simulation_clear(&context, simulation);
    }
    assert_int_equal(status, MOR_ERROR_CONFIG);
    if (strstr(context.message, word) == NULL) {
        fail_msg("'%s' is not in '%s'", word, context.message);
    }
    mor_case_clear(&context, the_case);
    mor_registry_free(&context, &registry);
    assert_int_equal(context.memory_bytes, 0);
    free(simulation);
    free(the_case);
    free(quoted);
}

/* Mean of dv_x/dx over 1/s in the inner of the trough when all of it is stretched along x at 1e-7 1/s. */
static double find_stretch(const char *const *settings)
{
    scene *it = new_scene(trough, settings, nothing, 1);
    mor_set *set = &it->simulation.soil.set;
    const double rate = 1e-7; /* 1/s: nothing else moves as fast in a step without gravity */
    double sum = 0.0;
    int64_t n = 0;
    for (int64_t k = 0; k < set->n_particles; ++k) {
        set->data[MOR_FIELD_VELOCITY][3 * k] = rate * set->data[MOR_FIELD_POSITION][3 * k];
    }
    scene_step(it, 1);
    for (int64_t k = 0; k < set->n_particles; ++k) {
        const double *x = set->data[MOR_FIELD_POSITION] + 3 * k;
        if (x[0] > 0.05 && x[0] < 0.45 && x[1] > 0.04 && x[1] < 0.1) {
            sum += set->data[MOR_FIELD_VELOCITY_GRADIENT][9 * k] / rate;
            n += 1;
        }
    }
    assert_true(n > 50);
    scene_free(it);
    return sum / (double)n;
}

static void normalized_sums_of_relaxed_soil_see_a_linear_field_on_average(void **state)
{
    (void)state;
    static const char *const plain[] = {"soil[0].particles=relaxed", "gravity=(0, 0)", "numerics.scheme=zhang2024",
                                        NULL};
    static const char *const normalized[] = {"soil[0].particles=relaxed", "gravity=(0, 0)", "numerics.scheme=zhang2024",
                                             "numerics.lattice_normalization=true", NULL};
    /* 1: what a few hundred particles out of all of them deviate by. */
    scene_expect_near("normalized", find_stretch(normalized), 1.0, 2e-3);
    assert_true(find_stretch(plain) < 0.99); /* or the test sees nothing: 2 % */
}

static void what_cannot_be_relaxed_is_refused_with_a_remedy(void **state)
{
    (void)state;
    static const char thin[] = "soil[0].shape.max=(\"0.5 m\", \"0.015 m\")";
    static const char empty[] = "soil[0].shape.max=(\"0.5 m\", \"0.004 m\")";
    static const char filled[] = "soil[0].particles=\"relaxed\"";
    refuse(trough, (const char *const[]){thin, filled, NULL}, "0.015 m thick at its thickest");
    refuse(trough, (const char *const[]){empty, filled, NULL}, "without a single particle");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normalized_sums_of_relaxed_soil_see_a_linear_field_on_average),
        cmocka_unit_test(relaxed_soil_closes_kernel_sums_at_a_tilted_wall),
        cmocka_unit_test(relaxed_soil_keeps_the_mass_of_its_region),
        cmocka_unit_test(relaxed_soil_stays_in_its_region),
        cmocka_unit_test(relaxed_soil_closes_kernel_sums_around_a_rock),
        cmocka_unit_test(relaxed_soil_fits_to_soil_on_the_lattice),
        cmocka_unit_test(relaxed_soil_bears_the_weight_of_the_shapes_above),
        cmocka_unit_test(relaxed_soil_has_no_order_of_the_lattice),
        cmocka_unit_test(relaxed_soil_is_the_same_for_any_number_of_threads),
        cmocka_unit_test(relaxed_soil_is_the_same_in_other_units_and_places),
        cmocka_unit_test(what_cannot_be_relaxed_is_refused_with_a_remedy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
