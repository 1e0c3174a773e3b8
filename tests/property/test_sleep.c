/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil at rest that is left out of the steps: what flows must not notice, and nothing may get lost. */
#include "core/particle/kernel.h"
#include "core/sph/soil_internal.h"
#include "tests/common/scene.h"

#include <string.h>

/* A bed of sand, and a column beside a wall that collapses onto its end. */
static const char bed[] =
    "title = 'Column beside a bed'; dimension = 2; spacing = '20 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '2 s';"
    "domain = { min = ('-0.2 m', '-0.2 m'); max = ('4.2 m', '2 m'); };"
    "soil = ( { name = 'sand'; initial_stress = { type = 'k0'; };"
    "  shape = { type = 'polygon'; points = ( ('0 m', '0 m'), ('4 m', '0 m'), ('4 m', '0.3 m'), ('0.4 m', '0.3 m'),"
    "    ('0.4 m', '0.9 m'), ('0 m', '0.9 m') ); };"
    "  material = { model = 'drucker_prager'; density = '1600 kg/m3'; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"
    "  { name = 'back'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; },"
    "  { name = 'end'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('4 m', '0 m'); normal = (-1, 0); }; } );"
    "probes = ( { name = 'toe'; type = 'toe'; origin = ('0 m', '0.41 m'); direction = (1, 0); },"
    "  { name = 'weight'; type = 'wall_force'; wall = 'floor'; direction = (0, -1); },"
    "  { name = 'center'; type = 'center_of_mass'; origin = ('0 m', '0 m'); direction = (1, 0); },"
    "  { name = 'height'; type = 'center_of_mass'; origin = ('0 m', '0 m'); direction = (0, 1); },"
    "  { name = 'motion'; type = 'soil_kinetic_energy'; },"
    "  { name = 'momentum'; type = 'momentum'; direction = (1, 0); },"
    "  { name = 'balance'; type = 'energy_balance'; } );";

/* Waves change the stress of the bed by a tenth. */
#define SLEEP "numerics.sleep_after=20 ms", "numerics.sleep_stress=0.1"
static const char *const nothing[] = {NULL};
static const char *const sleeping[] = {SLEEP, NULL};
static const char *const short_run[] = {SLEEP, "numerics.sort_interval=13", NULL};

static scene *open_bed(const char *const *settings, const char *const *more, int n_threads)
{
    const scene_request request = {bed, (const char *const *[]){settings, more}, 2, n_threads};
    return scene_new(&request);
}

static double find_share(const scene *it)
{
    return mor_soil_slept_share(&it->simulation.soil, it->simulation.schedule.n_steps);
}

/* Soil that sleeps had moved by less than 0.4 mm in 20 ms: the center of mass may be off by a quarter of that, as half
 * of the soil sleeps and gives nothing way. The toe is that of soil five rows thick, which steps 4 %
 * longer or shorter move from 0.782 to 0.794 m, and the kinetic energy by 4 %; which grain is first where the flow is
 * two rows thick is chance. The weight on the floor swings with waves in the bed by 2 %; its mean is that of the soil,
 * but for 1 % where waves have stopped at chance, for soil keeps the stress with which it falls asleep. */
static void flow_does_not_notice_that_soil_beside_it_sleeps(void **state)
{
    static const char *const names[] = {"toe", "center", "height", "motion"};
    enum { TOE, CENTER, HEIGHT, MOTION, N_NAMES, N_WEIGHTS = 40 };
    double found[2][N_NAMES];
    double weight[2];
    (void)state;
    for (int k = 0; k < 2; ++k) {
        scene *it = open_bed(k == 0 ? nothing : sleeping, nothing, 1);
        scene_advance(it, 0.5);
        for (int n = 0; n < N_NAMES; ++n) {
            found[k][n] = scene_probe(it, names[n]);
        }
        scene_advance(it, 0.9);
        weight[k] = 0.0;
        for (int n = 1; n <= N_WEIGHTS; ++n) {
            scene_advance(it, 0.9 + 0.4 * n / N_WEIGHTS);
            weight[k] += scene_probe(it, "weight") / N_WEIGHTS;
        }
        assert_true(k == 0 || find_share(it) > 0.15); /* or else nothing is tested */
        scene_free(it);
    }
    assert_true(found[0][TOE] > 0.6);
    scene_expect_near("toe, m", found[1][TOE], found[0][TOE], 0.02);
    scene_expect_near("center of mass, m", found[1][CENTER], found[0][CENTER], 1e-4);
    scene_expect_near("height of the center of mass, m", found[1][HEIGHT], found[0][HEIGHT], 1e-4);
    scene_expect_near("kinetic energy / that without sleep", found[1][MOTION] / found[0][MOTION], 1.0, 0.03);
    const double whole = 1600.0 * 9.81 * (4.0 * 0.3 + 0.4 * 0.6);
    scene_expect_near("mean weight on the floor without sleep / that of the soil", weight[0] / whole, 1.0, 0.005);
    scene_expect_near("the same with sleep", weight[1] / whole, 1.0, 0.01);
}

static uint64_t find_checksum(const char *const *more, int n_threads, double *share)
{
    scene *it = open_bed(short_run, more, n_threads);
    scene_step(it, 250);
    const uint64_t checksum = mor_set_checksum(&it->simulation.soil.set);
    *share = find_share(it);
    scene_free(it);
    return checksum;
}

/* Which soil sleeps follows from the state alone: not from threads, nor from when lists were built, as after a resume.
 * The numbers are the same to the last bit. */
static void sleep_depends_neither_on_threads_nor_on_when_lists_were_built(void **state)
{
    static const char *const skins[][2] = {{"numerics.skin_ratio=0", NULL}, {"numerics.skin_ratio=1.2", NULL}};
    double share = 0.0;
    double other = 0.0;
    (void)state;
    const uint64_t usual = find_checksum(nothing, 1, &share);
    assert_true(share > 0.05);
    for (int n_threads = 2; n_threads <= 3; ++n_threads) {
        assert_true(find_checksum(nothing, n_threads, &other) == usual);
        assert_true(other == share);
    }
    for (int k = 0; k < 2; ++k) {
        assert_true(find_checksum(skins[k], 1, &other) == usual);
        assert_true(other == share);
    }
}

/* In mixed precision sums over soil that sleeps beside a body, which are found in each step, are those of what is in
 * reach, whatever else is on its lists. */
static void sleep_beside_a_body_in_mixed_precision_does_not_depend_on_lists(void **state)
{
    static const char *const skins[] = {"numerics.skin_ratio=0.45", "numerics.skin_ratio=0.2",
                                        "numerics.skin_ratio=1.2"};
    uint64_t checksums[3];
    double height[3];
    (void)state;
    for (int k = 0; k < 3; ++k) {
        const char *const ball[] = {
            "numerics.precision=mixed",
            "bodies=({name='ball';position=('3 m','0.44 m');shape={type='sphere';center=(0,0);radius='0.15 m';};"
            "friction='rough';material={model='rigid';density=1600;};})",
            "probes=({name='height';type='body_position';body='ball';direction=(0,1);})", skins[k], NULL};
        scene *it = open_bed(short_run, ball, k + 1);
        scene_step(it, 600);
        assert_true(find_share(it) > 0.05);
        checksums[k] = mor_set_checksum(&it->simulation.soil.set);
        height[k] = scene_probe(it, "height");
        scene_free(it);
    }
    assert_true(checksums[1] == checksums[0] && checksums[2] == checksums[0]);
    assert_true(height[1] == height[0] && height[2] == height[0]);
}

/* Whether any particles of two clusters were within the support in this step. */
static bool clusters_see(const mor_soil *soil, int64_t c, int64_t d)
{
    const double support = MOR_KERNEL_SUPPORT * soil->smoothing_length;
    const int64_t n = soil->set.n_particles;
    bool see = false;
    for (int64_t i = c * MOR_CLUSTER; i < (c + 1) * MOR_CLUSTER && i < n; ++i) {
        for (int64_t j = d * MOR_CLUSTER; j < (d + 1) * MOR_CLUSTER && j < n; ++j) {
            const double *x = soil->records + i * MOR_RECORD_SIZE;
            const double *y = soil->records + j * MOR_RECORD_SIZE;
            const double r[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
            see |= mor_vector_dot(r, r) < support * support;
        }
    }
    return see;
}

static void assert_clusters_list_all_beside_them(const mor_soil *soil)
{
    const mor_sleep *sleep = &soil->sleep;
    for (int64_t c = 0; c < soil->tree.n_clusters; ++c) {
        for (int64_t d = 0; d < soil->tree.n_clusters; ++d) {
            bool is_listed = c == d || !clusters_see(soil, c, d);
            for (int64_t k = sleep->first[c]; k < sleep->first[c + 1] && !is_listed; ++k) {
                is_listed = sleep->neighbors[k] == d;
            }
            assert_true(is_listed);
        }
    }
}

static int32_t count_near(const mor_relation *relation, int64_t cluster)
{
    int32_t count = 0;
    for (int32_t k = 0; k < mor_relation_words(relation->counts[cluster]); ++k) {
        count += __builtin_popcount(mor_relation_near(relation, cluster)[k]);
    }
    return count;
}

/* What is read of soil that sleeps, and what decides that it sleeps, is whole however old lists are. */
static void lists_of_soil_that_sleeps_are_complete(void **state)
{
    int64_t n_asleep = 0;
    (void)state;
    scene *it = open_bed(short_run, nothing, 1);
    const mor_soil *soil = &it->simulation.soil;
    for (int step = 0; step < 250; ++step) {
        scene_step(it, 1);
        assert_clusters_list_all_beside_them(soil);
        for (int64_t cluster = 0; cluster < soil->tree.n_clusters; ++cluster) {
            const bool sleeps = mor_sleep_is(soil->sleep.states, cluster, MOR_SLEEP_ASLEEP);
            assert_true(!sleeps || count_near(&soil->inner, cluster) == soil->inner.counts[cluster]);
            n_asleep += sleeps;
        }
    }
    assert_true(n_asleep > 0);
    scene_free(it);
}

/* Hills whose clusters overlap without being on each other's lists of particles. */
static const char hills[] =
    "title = 'hills'; dimension = 2; spacing = '13 mm'; gravity = (0, -9.81); end = '0.5 s';"
    "domain = { min = (-3, -0.4); max = (6, 4); };"
    "soil = ( { name = 'sand'; initial_stress = { type = 'k0'; };"
    "  shape = { type = 'polygon'; points = ((0, 0), (3, 0), (3, 0.43), (2.77, 0.62), (2.5, 0.8), (2.1, 0.3),"
    "    (1.93, 0.7), (1.7, 1.2), (1.45, 0.62), (1.2, 0.51), (0.93, 1.4), (0.77, 1.1), (0.51, 0.3), (0.31, 0.2),"
    "    (0.2, 0.7), (0, 0.9)); };"
    "  material = { model = 'drucker_prager'; density = '1600 kg/m3'; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); "
    "}; },"
    "  { name = 'left'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; },"
    "  { name = 'right'; friction = 'smooth'; shape = { type = 'half_space'; point = (3, 0); normal = (-1, 0); }; } );"
    "numerics = { sleep_after = 1; sleep_speed = 0.6; sleep_stress = 1; };";

static uint64_t find_hills_checksum(const char *skin, double *share)
{
    const char *const settings[] = {skin, NULL};
    scene *it = scene_new(&(scene_request){hills, (const char *const *[]){settings}, 1, 2});
    it->simulation.soil.settings.scheme.sleep_after = 0.005; /* too short for a case, but much falls asleep and wakes */
    const mor_soil *soil = &it->simulation.soil;
    uint64_t n_left_out = 0;
    for (int step = 0; step < 60; ++step) {
        scene_step(it, 1);
        for (int64_t i = 0; i < soil->set.n_particles; ++i) {
            n_left_out += mor_sleep_is(soil->sleep.states, i / MOR_CLUSTER, MOR_SLEEP_ASLEEP);
        }
    }
    assert_true(soil->sleep.n_left_out == n_left_out);
    const uint64_t checksum = mor_set_checksum(&soil->set);
    *share = find_share(it);
    scene_free(it);
    return checksum;
}

static void sleep_of_clusters_that_overlap_does_not_depend_on_lists_either(void **state)
{
    double share = 0.0;
    double other = 0.0;
    (void)state;
    const uint64_t usual = find_hills_checksum("numerics.skin_ratio=0", &share);
    assert_true(share > 0.01);
    assert_true(find_hills_checksum("numerics.skin_ratio=0.45", &other) == usual);
    assert_true(find_hills_checksum("numerics.skin_ratio=1.2", &other) == usual);
    assert_true(other == share);
}

/* A plate that is driven into a bed at 20 mm/s, below the speed of soil at rest, and a rock as slow as that. */
static const char tool[] =
    "title = 'tool'; dimension = 2; spacing = '20 mm'; gravity = (0, -9.81); end = '3 s';"
    "domain = { min = (-0.2, -0.2); max = (2.2, 2); };"
    "soil = ( { name = 'sand'; initial_stress = { type = 'k0'; }; shape = { type = 'box'; min = (0, 0); max = (2, "
    "0.3); };"
    "  material = { model = 'drucker_prager'; density = '1600 kg/m3'; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); "
    "}; },"
    "  { name = 'left'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; },"
    "  { name = 'right'; friction = 'smooth'; shape = { type = 'half_space'; point = (2, 0); normal = (-1, 0); }; } );"
    "bodies = ( { name = 'tool'; motion = 'prescribed'; shape = { type = 'box'; min = (-0.15, -0.1); max = (0.15, "
    "0.1); };"
    "  position = (1, 0.405); friction = 'rough'; material = { model = 'rigid'; density = '2500 kg/m3'; };"
    "  path = { table = ( { time = 0; }, { time = 0.3; }, { time = 3.3; translation = (0, -0.06); } ); }; } );"
    "probes = ( { name = 'force'; type = 'body_force_soil'; body = 'tool'; direction = (0, 1); } );";

static void soil_wakes_before_a_tool_however_slow_it_is(void **state)
{
    double force[2];
    (void)state;
    for (int k = 0; k < 2; ++k) {
        const char *const settings[] = {k == 0 ? "numerics.sleep_after=0" : "numerics.sleep_after=0.1", NULL};
        scene *it = scene_new(&(scene_request){tool, (const char *const *[]){settings}, 1, 2});
        scene_advance(it, 1.2);
        force[k] = scene_probe(it, "force");
        assert_true(k == 0 || find_share(it) > 0.1); /* it slept, and some of it still does */
        scene_free(it);
    }
    assert_true(force[0] > 500.0);
    /* Load that grows too slowly for the limits is lost where soil sleeps: 1 %. Without a limit of the stress's change
     * 12 % were, and soil that did not wake gave a sixtieth of the force. */
    scene_expect_near("force on the tool / that without sleep", force[1] / force[0], 1.0, 0.01);
}

static void soil_does_not_fall_asleep_in_the_air(void **state)
{
    (void)state;
    mor_context context;
    mor_soil_settings settings = {.spacing = 0.1, .gravity = {0.0, 0.0, -9.81}};
    mor_context_init(&context);
    settings.scheme.sleep_speed = 0.05;
    settings.scheme.sleep_after = 0.003; /* less than 5 ms, after which falling soil is as fast as that */
    assert_int_equal(mor_soil_check_sleep(&context, &settings), MOR_ERROR_CONFIG);
    assert_non_null(strstr(context.message, "at least 0.0202 s"));
    settings.scheme.sleep_after = 0.0203;
    assert_int_equal(mor_soil_check_sleep(&context, &settings), MOR_OK);
    settings.scheme.sleep_after = 0.0;
    assert_int_equal(mor_soil_check_sleep(&context, &settings), MOR_OK);
}

/* Force of walls on the soil that is awake, along x, N/m. */
static double find_wall_force(const scene *it)
{
    const mor_soil *soil = &it->simulation.soil;
    double force = 0.0;
    for (int w = 0; w < soil->n_walls; ++w) {
        const mor_soil_contact *wall = &soil->walls[w];
        for (int64_t k = 0; k < wall->n_slots * MOR_CLUSTER; ++k) {
            const int64_t i = (int64_t)wall->slots[k / MOR_CLUSTER].cluster * MOR_CLUSTER + k % MOR_CLUSTER;
            if (i < soil->set.n_particles && !mor_sleep_is(soil->sleep.states, i / MOR_CLUSTER, MOR_SLEEP_ASLEEP)) {
                force += soil->set.data[MOR_FIELD_MASS][i] * wall->acceleration[3 * k];
            }
        }
    }
    return force;
}

/* Momentum comes from walls and goes to soil that sleeps. The account is exact but for rounding: of 1e-16, for each of
 * 100 steps, of 1500 particles with up to 0.6 kg m/s. */
static void momentum_that_sleep_takes_is_accounted_for(void **state)
{
    (void)state;
    scene *it = open_bed(sleeping, nothing, 1);
    const mor_sleep *sleep = &it->simulation.soil.sleep;
    while (sleep->n_asleep < 96) { /* the bed falls asleep while the column falls */
        assert_true(it->simulation.schedule.now < it->simulation.schedule.end / 4);
        scene_step(it, 10);
    }
    const double before = scene_probe(it, "momentum");
    const double taken = sleep->momentum[0] + sleep->impulse[0];
    double pushed = 0.0;
    for (int k = 0; k < 100; ++k) {
        const double time = mor_schedule_time(&it->simulation.schedule);
        scene_step(it, 1);
        pushed += (mor_schedule_time(&it->simulation.schedule) - time) * find_wall_force(it);
    }
    const double lost = sleep->momentum[0] + sleep->impulse[0] - taken;
    assert_true(fabs(lost) > 0.1);
    scene_expect_near("momentum gained, kg m/s", scene_probe(it, "momentum") - before, pushed - lost, 1e-9);
    scene_free(it);
}

/* A bed that sleeps from early on. Its soil gave 1e-4 J/m to walls while it moved, so that the least that it did asleep
 * would show. What falls asleep in a step has moved for half of it, which nobody counts: 1 % of so little. */
static void soil_that_sleeps_takes_no_energy(void **state)
{
    static const char *const level[] = {
        "soil[0].shape={type='box';min=(0,0);max=('4 m','0.3 m');}",
        "probes=({name='balance';type='energy_balance';},{name='boundary';type='boundary_dissipation';})", NULL};
    (void)state;
    scene *it = open_bed(sleeping, level, 1);
    scene_advance(it, 0.3);
    assert_int_equal(it->simulation.soil.sleep.n_asleep, it->simulation.soil.sleep.n_clusters);
    const double boundary = scene_probe(it, "boundary");
    scene_advance(it, 0.5);
    scene_expect_near("energy lost at walls while all soil sleeps, J/m", scene_probe(it, "boundary"), boundary,
                      1e-9 * fabs(boundary));
    scene_expect_near("balance of energy", scene_probe(it, "balance"), 1.0, 0.02);
    scene_free(it);
}

/* A ball falls on the bed after it has fallen asleep. */
static void falling_ball_wakes_the_soil_under_it(void **state)
{
    static const char *const ball[] = {
        "soil[0].shape={type='box';min=(0,0);max=('4 m','0.6 m');}",
        "bodies=({name='ball';position=('2 m','1.2 m');shape={type='sphere';center=(0,0);radius='0.15 m';};"
        "friction='rough';material={model='rigid';density=2500;};})",
        "probes=({name='height';type='body_position';body='ball';direction=(0,1);})", NULL};
    double depth[2];
    (void)state;
    for (int k = 0; k < 2; ++k) {
        scene *it = open_bed(k == 0 ? nothing : sleeping, ball, 1);
        scene_advance(it, 0.25);
        assert_true(k == 0 || it->simulation.soil.sleep.n_asleep > 640); /* most of 750 */
        scene_advance(it, 0.55);
        depth[k] = 0.75 - scene_probe(it, "height");
        scene_free(it);
    }
    /* The bed ripples for a while at rest, so that the ball meets another state of it: a hundredth of the depth. */
    assert_true(depth[0] > 0.05);
    scene_expect_near("depth of the ball / that in soil that never sleeps", depth[1] / depth[0], 1.0, 0.01);
}

/* First particle of a batch of the stress update that is awake behind others that sleep, which are behind some that are
 * awake; -1: there is none. */
static int64_t find_behind_sleepers(const mor_soil *soil)
{
    for (int64_t first = 0; first + MOR_SOIL_BATCH <= soil->set.n_particles; first += MOR_SOIL_BATCH) {
        const int64_t last = first + MOR_SOIL_BATCH;
        const int64_t asleep = mor_sleep_particles_end(soil->sleep.states, first, last);
        const int64_t behind = asleep < last ? mor_sleep_particles_end(soil->sleep.states, asleep, last) : last;
        if (behind < last && !mor_sleep_is(soil->sleep.states, first / MOR_CLUSTER, MOR_SLEEP_ASLEEP)) {
            return behind;
        }
    }
    return -1;
}

/* A law fails where its state is no number. */
static void law_that_fails_behind_soil_that_sleeps_names_its_particle(void **state)
{
    char name[64];
    int64_t particle = -1;
    (void)state;
    scene *it = open_bed(sleeping, nothing, 1);
    mor_soil *soil = &it->simulation.soil;
    for (int step = 0; step < 400 && particle < 0; ++step) {
        scene_step(it, 1);
        particle = find_behind_sleepers(soil);
    }
    assert_true(particle >= 0);
    snprintf(name, sizeof name, "particle %lld of", (long long)soil->set.id[particle]);
    const int field = soil->state_fields[0];
    soil->set.data[field][particle * soil->set.fields[field].n_components] = NAN;
    assert_int_not_equal(mor_schedule_step(&it->context, &it->simulation.schedule, it->simulation.schedule.end),
                         MOR_OK);
    assert_non_null(strstr(it->context.message, name));
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flow_does_not_notice_that_soil_beside_it_sleeps),
        cmocka_unit_test(sleep_depends_neither_on_threads_nor_on_when_lists_were_built),
        cmocka_unit_test(sleep_beside_a_body_in_mixed_precision_does_not_depend_on_lists),
        cmocka_unit_test(lists_of_soil_that_sleeps_are_complete),
        cmocka_unit_test(sleep_of_clusters_that_overlap_does_not_depend_on_lists_either),
        cmocka_unit_test(soil_wakes_before_a_tool_however_slow_it_is),
        cmocka_unit_test(soil_does_not_fall_asleep_in_the_air),
        cmocka_unit_test(momentum_that_sleep_takes_is_accounted_for),
        cmocka_unit_test(soil_that_sleeps_takes_no_energy),
        cmocka_unit_test(falling_ball_wakes_the_soil_under_it),
        cmocka_unit_test(law_that_fails_behind_soil_that_sleeps_names_its_particle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
