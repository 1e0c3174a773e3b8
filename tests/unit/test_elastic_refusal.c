/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/drucker_prager.h"
#include "tests/common/elastic_bodies.h"

static elastic_request request_of(const elastic_piece *piece)
{
    return (elastic_request){.dimension = 3,
                             .spacing = 0.1,
                             .pieces = piece,
                             .n_pieces = 1,
                             .youngs = 1e6,
                             .poisson = 0.3,
                             .density = 1000.0,
                             .settings = {1.15, 0.4, 1.0, 0.0}};
}

static const elastic_piece cube = {.side = {0.4, 0.4, 0.4}, .middle = {1.0, 2.0, 3.0}};

/* Whether the message of the context holds all the words, an array ended by NULL. */
static void expect_words(const elastic_bodies *it, const char *const *words)
{
    for (int k = 0; words[k] != NULL; ++k) {
        if (strstr(it->context.message, words[k]) == NULL) {
            fail_msg("'%s' is missing in: %s", words[k], it->context.message);
        }
    }
}

static void test_body_one_layer_thin_is_refused(void **state)
{
    (void)state;
    static const elastic_piece sheet = {.side = {0.5, 0.5, 0.1}, .middle = {1.0, 2.0, 3.0}};
    const elastic_request request = request_of(&sheet);
    elastic_bodies it;
    assert_int_equal(elastic_try_open(&it, &request), MOR_ERROR_ARGUMENT);
    expect_words(&it, (const char *const[]){"'first'", "rigid", "spacing", NULL});
    elastic_close(&it);
}

/* A cube with a thread of single particles: at its end all neighbors lie on a line. */
static void test_thread_of_particles_is_refused_with_name_and_place(void **state)
{
    (void)state;
    enum { CUBE = 64, THREAD = 4 };
    const elastic_request request = request_of(&cube);
    const mor_elastic_settings settings = {1.15, 0.4, 1.0, 0.0};
    double points[3 * (CUBE + THREAD)];
    elastic_bodies it;
    elastic_open(&it, &request);
    memcpy(points, it.elastic.group.reference, 3 * CUBE * sizeof *points);
    for (int k = 0; k < THREAD; ++k) {
        points[3 * (CUBE + k)] = 1.25 + 0.1 * k;
        points[3 * (CUBE + k) + 1] = 2.05;
        points[3 * (CUBE + k) + 2] = 3.05;
    }
    const mor_body *body = &it.elastic.group.bodies[0];
    const mor_body_request threaded = {.name = "kite",
                                       .positions = points,
                                       .n_particles = CUBE + THREAD,
                                       .shape = body->shape,
                                       .shape_turn = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0},
                                       .shape_move = {1.0, 2.0, 3.0},
                                       .density = 1000.0,
                                       .geometry = body->geometry};
    mor_elastic elastic;
    assert_int_equal(mor_elastic_init(&it.context, &elastic, "rocks", &settings, it.material, 3, 0.1, &threaded, 1),
                     MOR_ERROR_ARGUMENT);
    expect_words(&it, (const char *const[]){"'kite'", "too thin at", "2.05, 3.05) m", "plane", NULL});
    elastic_close(&it);
}

static void test_body_two_layers_thin_is_accepted(void **state)
{
    (void)state;
    static const elastic_piece sheet = {.side = {0.5, 0.5, 0.2}};
    const elastic_request request = request_of(&sheet);
    elastic_bodies it;
    elastic_open(&it, &request);
    elastic_steps(&it, 2);
    assert_int_equal(it.elastic.group.set.n_particles, 50);
    elastic_close(&it);
}

/* Takes a step that must fail with a numeric error. */
static void expect_failure(elastic_bodies *it, const char *const *words)
{
    assert_int_equal(mor_schedule_step(&it->context, &it->schedule, it->schedule.end), MOR_ERROR_NUMERIC);
    expect_words(it, words);
}

static void test_body_leaving_the_domain_stops_the_run(void **state)
{
    (void)state;
    const elastic_request request = request_of(&cube);
    elastic_bodies it;
    elastic_open(&it, &request);
    it.elastic.group.domain_maximum[1] = 2.1;
    expect_failure(&it, (const char *const[]){"'first'", "'rocks'", "left the domain", "t = ", NULL});
    elastic_close(&it);
}

static void test_particle_faster_than_sound_stops_the_run(void **state)
{
    (void)state;
    const elastic_request request = request_of(&cube);
    elastic_bodies it;
    elastic_open(&it, &request);
    it.elastic.group.boundary.force[3] = 1e9;
    expect_failure(&it, (const char *const[]){"'first'", "speeds must stay below", "courant", NULL});
    elastic_close(&it);
}

static void test_force_that_is_not_a_number_stops_the_run(void **state)
{
    (void)state;
    const elastic_request request = request_of(&cube);
    elastic_bodies it;
    elastic_open(&it, &request);
    it.elastic.group.contact_force[7] = NAN;
    expect_failure(&it, (const char *const[]){"'first'", "nan", NULL});
    elastic_close(&it);
}

static void test_inverted_particle_stops_the_run(void **state)
{
    (void)state;
    const elastic_request request = request_of(&cube);
    elastic_bodies it;
    elastic_open(&it, &request);
    it.elastic.group.set.data[it.elastic.field_gradient][9 * 17] = -0.5;
    const long long id = (long long)it.elastic.group.set.id[17];
    char who[64];
    snprintf(who, sizeof who, "particle %lld of body 'first'", id);
    expect_failure(&it, (const char *const[]){who, "neo_hookean", "-0.5", NULL});
    elastic_close(&it);
}

static void test_material_of_the_rate_form_is_refused(void **state)
{
    (void)state;
    const double parameters[MOR_DRUCKER_PRAGER_COUNT] = {1e6, 0.3, 0.5, 0.0, 0.0, 0.0, 1.0};
    mor_context context;
    mor_material_instance *material = NULL;
    mor_elastic elastic;
    mor_context_init(&context);
    assert_int_equal(mor_material_create(&context, &mor_drucker_prager, 1000.0, parameters, &material), MOR_OK);
    const mor_elastic_settings settings = {1.15, 0.4, 1.0, 0.0};
    assert_int_equal(mor_elastic_init(&context, &elastic, "rocks", &settings, material, 3, 0.1, NULL, 0),
                     MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "total form"));
    mor_material_destroy(&context, &material);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_body_one_layer_thin_is_refused),
        cmocka_unit_test(test_thread_of_particles_is_refused_with_name_and_place),
        cmocka_unit_test(test_body_two_layers_thin_is_accepted),
        cmocka_unit_test(test_body_leaving_the_domain_stops_the_run),
        cmocka_unit_test(test_particle_faster_than_sound_stops_the_run),
        cmocka_unit_test(test_force_that_is_not_a_number_stops_the_run),
        cmocka_unit_test(test_inverted_particle_stops_the_run),
        cmocka_unit_test(test_material_of_the_rate_form_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
