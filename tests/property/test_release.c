/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil that is released later than at the start. */
#include "core/sph/soil_internal.h"
#include "tests/common/scene.h"

#include <string.h>

/* The columns 'a' and 'b' stand side by side; clusters hold soil of both. */
#define GROUND                                                                                                         \
    "title = 'columns'; dimension = 2; spacing = '20 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '1 s';"            \
    "domain = { min = ('-2 m', '-0.2 m'); max = ('3 m', '2 m'); };"                                                    \
    "walls = ( { name = 'floor'; friction = 'rough';"                                                                  \
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"                              \
    "probes = ( { name = 'balance'; type = 'energy_balance'; }, { name = 'height'; type = 'height'; } );"

#define SAND                                                                                                           \
    "initial_stress = { type = 'k0'; };"                                                                               \
    "  material = { model = 'drucker_prager'; density = '1600 kg/m3'; youngs_modulus = '1 MPa';"                       \
    "    poissons_ratio = 0.3; friction_angle = '30 deg'; };"

static const char one_column[] = GROUND
    "soil = ( { name = 'a'; " SAND " shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.4 m', '0.62 m'); }; } );";

static const char two_columns[] = GROUND
    "soil = ( { name = 'a'; " SAND " shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.4 m', '0.62 m'); }; },"
    "  { name = 'b'; " SAND " shape = { type = 'box'; min = ('0.4 m', '0 m'); max = ('0.8 m', '0.62 m'); }; } );";

static const char *const nothing[] = {NULL};

enum { COLUMN = 620, PARTICLES = 2 * COLUMN };

static scene *open(const char *text, const char *const *settings, int n_threads)
{
    const scene_request request = {text, (const char *const *[]){settings}, 1, n_threads};
    return scene_new(&request);
}

/* The largest way between the same particles of two soils, and the largest speed of one, m and m/s. */
static double find_difference(const mor_set *a, const mor_set *b, double *fastest)
{
    double place[2 * COLUMN];
    double largest = 0.0;
    *fastest = 0.0;
    assert_int_equal(a->n_particles, COLUMN);
    for (int64_t i = 0; i < COLUMN; ++i) {
        memcpy(place + 2 * a->id[i], a->data[MOR_FIELD_POSITION] + 3 * i, 2 * sizeof *place);
    }
    for (int64_t i = 0; i < COLUMN; ++i) {
        for (int k = 0; k < 2; ++k) {
            largest = fmax(largest, fabs(b->data[MOR_FIELD_POSITION][3 * i + k] - place[2 * b->id[i] + k]));
            *fastest = fmax(*fastest, fabs(b->data[MOR_FIELD_VELOCITY][3 * i + k]));
        }
    }
    return largest;
}

/* Steps are counted where density is summed anew and particles are sorted: after a hold of a multiple of both the
 * motion is the same but for the order of particles, in which sums are rounded. Until then all steps are as long as the
 * first. Found: 5e-16 m after 350 steps; rounding grows with the collapse. */
static void column_released_later_moves_as_one_released_at_the_start(void **state)
{
    enum { DELAY = 200, STEPS = 350 };
    char released[64];
    double fastest = 0.0;
    (void)state;
    scene *early = open(one_column, nothing, 2);
    scene_step(early, 1);
    const double length = mor_schedule_time(&early->simulation.schedule);
    scene_free(early);
    early = open(one_column, nothing, 1);
    scene_step(early, STEPS);
    snprintf(released, sizeof released, "soil[0].released=%.17g", DELAY * length);
    const char *const later[] = {released, NULL};
    scene *late = open(one_column, later, 2);
    scene_step(late, DELAY);
    assert_true(find_difference(&late->simulation.soil.set, &late->simulation.soil.set, &fastest) == 0.0);
    assert_true(fastest == 0.0); /* it stands */
    scene_step(late, STEPS);
    scene_expect_near("way between them, m",
                      find_difference(&early->simulation.soil.set, &late->simulation.soil.set, &fastest), 0.0, 1e-13);
    assert_true(fastest > 0.1);
    scene_expect_near("delay, s",
                      mor_schedule_time(&late->simulation.schedule) - mor_schedule_time(&early->simulation.schedule),
                      DELAY * length, 1e-6 * length);
    scene_free(early);
    scene_free(late);
}

/* Where region b is, and what its particles carry, by number of the particle. */
static void collect(const scene *it, double region, double *values, int *n)
{
    const mor_soil *soil = &it->simulation.soil;
    *n = 0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        double *own = values + 9 * soil->set.id[i];
        memset(own, 0, 9 * sizeof *own);
        if (soil->set.data[soil->region_field][i] == region) {
            memcpy(own, soil->set.data[MOR_FIELD_POSITION] + 3 * i, 2 * sizeof *own);
            memcpy(own + 2, soil->set.data[MOR_FIELD_STRESS] + 6 * i, 6 * sizeof *own);
            own[8] = soil->set.data[MOR_FIELD_DENSITY][i];
            *n += 1;
        }
    }
}

/* Soil b stands to the last bit while a leans on it and flows away on its other side: it is a wall. */
static void soil_that_is_not_released_stands_beside_soil_that_flows(void **state)
{
    static const char *const later[] = {"soil[1].released=1 s", NULL};
    double before[9 * PARTICLES], after[9 * PARTICLES];
    int n = 0;
    (void)state;
    scene *it = open(two_columns, later, 2);
    assert_int_equal(it->simulation.soil.set.n_particles, PARTICLES);
    collect(it, 1.0, before, &n);
    scene_advance(it, 0.25);
    assert_true(it->simulation.soil.hold.n_mixed > 0); /* clusters of both kinds */
    assert_true(it->simulation.soil.sleep.n_asleep > 0);
    collect(it, 1.0, after, &n);
    assert_int_equal(n, PARTICLES / 2);
    assert_memory_equal(before, after, sizeof before);
    collect(it, 0.0, after, &n);
    double lowest = 0.0, highest = 0.0;
    for (int i = 0; i < PARTICLES; ++i) {
        lowest = fmin(lowest, after[9 * i]);
        highest = fmax(highest, after[9 * i + 1] < 0.5 ? after[9 * i] : 0.0);
    }
    assert_true(lowest < -0.1);  /* a has flown to its free side */
    assert_true(highest < 0.42); /* and not a spacing into b */
    scene_expect_near("balance of energy", scene_probe(it, "balance"), 1.0, 0.01);
    scene_free(it);
}

/* What presses on soil that stands does work at its face, which is lost, and none inside of it. */
static void soil_that_is_not_released_is_not_strained(void **state)
{
    static const char *const pressed[] = {
        "soil[0].released=1 s", "numerics.scheme=zhang2024",
        "walls=({name=\"floor\"; friction=\"rough\"; shape={type=\"half_space\"; point=(0, 0); normal=(0, 1);};}, "
        "{name=\"piston\"; friction=\"rough\"; velocity=(0.5, 0); "
        "shape={type=\"box\"; min=(-0.2, 0); max=(-0.001, 0.5);};})",
        NULL};
    (void)state;
    scene *it = open(one_column, pressed, 2);
    scene_advance(it, 0.02);
    const mor_soil *soil = &it->simulation.soil;
    assert_true(soil->wall_force[1][0] < -100.0); /* N/m; of the soil on the piston, against its way */
    const double given = -mor_soil_energy_taken(soil, MOR_SOIL_ENERGY_DRIVEN);
    assert_true(given > 1.0); /* J/m, by the piston */
    scene_expect_near("lost at its face, J/m", mor_soil_energy_taken(soil, MOR_SOIL_ENERGY_BOUNDARY), given,
                      1e-9 * given); /* rounding */
    scene_expect_near("balance of energy", scene_probe(it, "balance"), 1.0, 1e-9);
    scene_free(it);
}

/* Force of walls along x on soil that is computed. */
static double find_wall_force(const scene *it)
{
    const mor_soil *soil = &it->simulation.soil;
    const mor_soil_contact *wall = &soil->walls[0];
    double force = 0.0;
    for (int64_t k = 0; k < wall->n_slots * MOR_CLUSTER; ++k) {
        const int64_t i = (int64_t)wall->slots[k / MOR_CLUSTER].cluster * MOR_CLUSTER + k % MOR_CLUSTER;
        if (i < soil->set.n_particles && !mor_soil_is_asleep(soil, i)) {
            force += soil->set.data[MOR_FIELD_MASS][i] * wall->acceleration[3 * k];
        }
    }
    return force;
}

static double find_momentum(const mor_set *set)
{
    double momentum = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        momentum += set->data[MOR_FIELD_MASS][i] * set->data[MOR_FIELD_VELOCITY][3 * i];
    }
    return momentum;
}

/* Along x it comes from the floor and goes to soil that stands. The account is exact but for rounding: of 1e-16, for
 * each of 300 steps, of 620 particles with up to 0.6 kg m/s. */
static void momentum_given_to_soil_that_stands_is_accounted_for(void **state)
{
    static const char *const later[] = {"soil[1].released=1 s", NULL};
    double pushed = 0.0;
    (void)state;
    scene *it = open(two_columns, later, 1);
    const mor_soil *soil = &it->simulation.soil;
    for (int k = 0; k < 300; ++k) {
        const double time = mor_schedule_time(&it->simulation.schedule);
        scene_step(it, 1);
        pushed += (mor_schedule_time(&it->simulation.schedule) - time) * find_wall_force(it);
    }
    assert_true(fabs(soil->sleep.impulse[0]) > 1.0); /* a leans on b */
    scene_expect_near("momentum, kg m/s", find_momentum(&soil->set), pushed - soil->sleep.impulse[0], 1e-9);
    scene_free(it);
}

static uint64_t find_checksum(const char *const *settings, int n_threads)
{
    scene *it = open(two_columns, settings, n_threads);
    scene_step(it, 250);
    const uint64_t checksum = mor_set_checksum(&it->simulation.soil.set);
    scene_free(it);
    return checksum;
}

/* Released in the middle, with and without sleep. */
static void release_depends_neither_on_threads_nor_on_when_lists_were_built(void **state)
{
    static const char *const usual[] = {"soil[1].released=40 ms", "numerics.sort_interval=13", NULL};
    static const char *const lists[] = {"soil[1].released=40 ms", "numerics.sort_interval=13", "numerics.skin_ratio=0",
                                        NULL};
    static const char *const never[] = {"numerics.sort_interval=13", NULL};
    (void)state;
    const uint64_t checksum = find_checksum(usual, 1);
    assert_true(find_checksum(usual, 3) == checksum);
    assert_true(find_checksum(lists, 2) == checksum);
    assert_true(find_checksum(never, 2) != checksum);
}

/* Soil 'a' is thrown out of the domain, column by column, away from 'b', which stands. */
static const char thrown[] =
    "title = 'thrown'; dimension = 2; spacing = '20 mm'; gravity = (0, -10); end = '1 s';"
    "domain = { min = ('-1 m', '-1 m'); max = ('3 m', '2 m'); outflow = 'remove'; };"
    "soil = ( { name = 'a'; " SAND " shape = { type = 'box'; min = ('-0.99 m', '0 m'); max = ('-0.89 m', '0.3 m'); };"
    "    velocity = (-5, 0); },"
    "  { name = 'b'; " SAND " shape = { type = 'box'; min = ('0.4 m', '0 m'); max = ('0.8 m', '0.62 m'); };"
    "    released = '1 s'; } );"
    "numerics = { sort_interval = 100000; };"
    "probes = ( { name = 'asleep'; type = 'asleep_share'; } );";

/* Particles in clusters that hold nothing but the second soil, which sleep. */
static int64_t count_standing(const mor_soil *soil)
{
    const double *region = soil->set.data[soil->region_field];
    int64_t n = 0;
    for (int64_t first = 0; first < soil->set.n_particles; first += MOR_CLUSTER) {
        const int64_t last = first + MOR_CLUSTER < soil->set.n_particles ? first + MOR_CLUSTER : soil->set.n_particles;
        int64_t n_of_cluster = 0;
        for (int64_t i = first; i < last; ++i) {
            n_of_cluster += region[i] == 1.0;
        }
        n += n_of_cluster == last - first ? n_of_cluster : 0;
    }
    return n;
}

/* Particles behind those that leave move up in the arrays at the end of the step, in which as many slept. */
static void share_of_soil_that_stands_is_right_as_other_soil_leaves(void **state)
{
    (void)state;
    scene *it = open(thrown, nothing, 2);
    const mor_soil *soil = &it->simulation.soil;
    int n_outflows = 0;
    scene_step(it, 1);
    while (n_outflows < 3) {
        const int64_t n_before = soil->set.n_particles;
        const int64_t n_standing = count_standing(soil);
        assert_true(n_standing > COLUMN - 2 * MOR_CLUSTER);
        scene_step(it, 1);
        const double n = (double)soil->set.n_particles;
        scene_expect_near("particles asleep", scene_probe(it, "asleep") * n, (double)n_standing, 1e-9); /* rounding */
        n_outflows += soil->set.n_particles < n_before;
    }
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(column_released_later_moves_as_one_released_at_the_start),
        cmocka_unit_test(soil_that_is_not_released_stands_beside_soil_that_flows),
        cmocka_unit_test(soil_that_is_not_released_is_not_strained),
        cmocka_unit_test(momentum_given_to_soil_that_stands_is_accounted_for),
        cmocka_unit_test(share_of_soil_that_stands_is_right_as_other_soil_leaves),
        cmocka_unit_test(release_depends_neither_on_threads_nor_on_when_lists_were_built),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
