/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/point_cache.h"
#include "core/base/hash.h"
#include "tests/common/relax_scene.h"
#include "tests/common/run_folder.h"

#include <sys/stat.h>

/* A ball of 523 particles, and where its file lies. */
typedef struct kept_ball {
    mor_shape *shape;
    mor_relax_request request;
    char folder[MOR_PATH_BYTES];
    char file[MOR_PATH_BYTES];
} kept_ball;

static kept_ball new_kept_ball(run_folder *scratch)
{
    kept_ball ball;
    char digits[MOR_HASH_TEXT_BYTES];
    char name[64];
    uint64_t hash = 0;
    memset(&ball, 0, sizeof ball);
    ball.shape = new_relax_shape(&scratch->context, "ball", 0.1);
    ball.request = new_relax_request(ball.shape, 3, 0.212);
    mor_relax_request_hash(&ball.request, &hash);
    mor_hash_format(hash, digits);
    snprintf(name, sizeof name, "particles-%s", digits);
    assert_int_equal(mor_durable_file_join(&scratch->context, ball.folder, scratch->path, "kept"), MOR_OK);
    assert_int_equal(mor_durable_file_join(&scratch->context, ball.file, ball.folder, name), MOR_OK);
    return ball;
}

/* One run: relaxes by the cache, compares with what mor_relax gives, and says where the particles came from. */
static mor_point_cache relax_once(run_folder *scratch, const kept_ball *ball, const char *folder)
{
    mor_point_cache cache;
    mor_relax_points points;
    mor_relax_points direct;
    mor_point_cache_init(&cache, folder);
    assert_int_equal(mor_point_cache_relax(&scratch->context, &cache, &ball->request, &points), MOR_OK);
    assert_int_equal(mor_relax(&scratch->context, &ball->request, &direct), MOR_OK);
    assert_int_equal(points.n_points, direct.n_points);
    assert_memory_equal(points.positions, direct.positions, 24 * (size_t)direct.n_points);
    assert_memory_equal(&points.volume, &direct.volume, sizeof direct.volume);
    assert_memory_equal(&points.residual, &direct.residual, sizeof direct.residual);
    assert_int_equal(points.n_steps, direct.n_steps);
    assert_int_equal(points.is_converged, direct.is_converged);
    mor_relax_clear(&scratch->context, &direct);
    const mor_point_cache told = cache;
    mor_point_cache_clear(&scratch->context, &cache);
    return told;
}

static void second_run_reads_what_the_first_one_found(void **state)
{
    run_folder *scratch = *state;
    kept_ball ball = new_kept_ball(scratch);
    mor_point_cache told = relax_once(scratch, &ball, ball.folder);
    assert_int_equal(told.n_found, 1);
    assert_int_equal(told.n_read, 0);
    told = relax_once(scratch, &ball, ball.folder);
    assert_int_equal(told.n_found, 0);
    assert_int_equal(told.n_read, 1);
    assert_non_null(strstr(scratch->log, "taken from"));
    mor_shape_free(&scratch->context, &ball.shape);
}

static void equal_requests_of_one_run_are_relaxed_once(void **state)
{
    run_folder *scratch = *state;
    kept_ball ball = new_kept_ball(scratch);
    mor_shape *equal = new_relax_shape(&scratch->context, "ball", 0.1);
    mor_point_cache cache;
    mor_relax_points points[3];
    mor_relax_request other = ball.request;
    mor_point_cache_init(&cache, "");
    assert_int_equal(mor_point_cache_relax(&scratch->context, &cache, &ball.request, &points[0]), MOR_OK);
    other.shape = equal;
    assert_int_equal(mor_point_cache_relax(&scratch->context, &cache, &other, &points[1]), MOR_OK);
    assert_int_equal(cache.n_found, 1);
    assert_int_equal(cache.n_shared, 1);
    assert_ptr_equal(points[0].positions, points[1].positions);
    other.seed += 1;
    assert_int_equal(mor_point_cache_relax(&scratch->context, &cache, &other, &points[2]), MOR_OK);
    assert_int_equal(cache.n_found, 2);
    assert_true(memcmp(points[0].positions, points[2].positions, 24 * (size_t)points[0].n_points) != 0);
    mor_point_cache_clear(&scratch->context, &cache);
    mor_shape_free(&scratch->context, &equal);
    mor_shape_free(&scratch->context, &ball.shape);
}

/* Writes one byte, or cuts the file there. */
static void damage(const char *path, long place, bool is_cut)
{
    if (is_cut) {
        assert_int_equal(truncate(path, place), 0);
        return;
    }
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, place, SEEK_SET), 0);
    const int old = fgetc(file);
    assert_int_equal(fseek(file, place, SEEK_SET), 0);
    assert_int_equal(fputc(old ^ 1, file), old ^ 1);
    assert_int_equal(fclose(file), 0);
}

static void damaged_file_is_found_anew_and_replaced(void **state)
{
    static const struct {
        long place;
        bool is_cut;
    } damages[] = {{40, false}, {515, false}, {5000, false}, {700, true}, {0, true}};
    run_folder *scratch = *state;
    kept_ball ball = new_kept_ball(scratch);
    assert_int_equal(relax_once(scratch, &ball, ball.folder).n_found, 1);
    for (size_t k = 0; k < sizeof damages / sizeof *damages; ++k) {
        damage(ball.file, damages[k].place, damages[k].is_cut);
        const int n_logged = scratch->n_logged;
        assert_int_equal(relax_once(scratch, &ball, ball.folder).n_found, 1);
        assert_int_equal(scratch->n_logged, n_logged + 2); /* that it cannot be used, and that it was found anew */
        assert_int_equal(scratch->context.status, MOR_OK);
        assert_int_equal(relax_once(scratch, &ball, ball.folder).n_read, 1);
    }
    mor_shape_free(&scratch->context, &ball.shape);
}

static void file_of_another_request_is_not_taken(void **state)
{
    run_folder *scratch = *state;
    kept_ball ball = new_kept_ball(scratch);
    char own[MOR_PATH_BYTES];
    snprintf(own, sizeof own, "%s", ball.file);
    assert_int_equal(relax_once(scratch, &ball, ball.folder).n_found, 1);
    mor_shape_free(&scratch->context, &ball.shape);
    ball = new_kept_ball(scratch);
    ball.request.spacing = 0.2;
    uint64_t hash = 0;
    char digits[MOR_HASH_TEXT_BYTES];
    mor_relax_request_hash(&ball.request, &hash);
    mor_hash_format(hash, digits);
    snprintf(strrchr(ball.file, '-'), sizeof digits + 1, "-%s", digits);
    assert_int_equal(rename(own, ball.file), 0);
    assert_int_equal(relax_once(scratch, &ball, ball.folder).n_found, 1);
    mor_shape_free(&scratch->context, &ball.shape);
}

/* The folder would lie in a file: no user may make it. */
static void folder_that_cannot_be_written_is_done_without(void **state)
{
    run_folder *scratch = *state;
    kept_ball ball = new_kept_ball(scratch);
    char folder[MOR_PATH_BYTES];
    FILE *file = fopen(ball.folder, "w");
    assert_non_null(file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(mor_durable_file_join(&scratch->context, folder, ball.folder, "below"), MOR_OK);
    for (int run = 0; run < 2; ++run) {
        assert_int_equal(relax_once(scratch, &ball, folder).n_found, 1);
        assert_non_null(strstr(scratch->log, "keep them in another folder"));
        assert_int_equal(scratch->context.status, MOR_OK);
    }
    mor_shape_free(&scratch->context, &ball.shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(second_run_reads_what_the_first_one_found, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(equal_requests_of_one_run_are_relaxed_once, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(damaged_file_is_found_anew_and_replaced, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(file_of_another_request_is_not_taken, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(folder_that_cannot_be_written_is_done_without, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
