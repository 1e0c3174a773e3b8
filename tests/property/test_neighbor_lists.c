/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Neighbor lists that are kept from step to step: complete while they hold, which the checked build sees to. */
#include "core/sph/soil_internal.h"
#include "tests/common/scene.h"

#include <string.h>

/* A column that collapses from a wall onto a disc and a floor. */
static const char column[] =
    "title = 'Column onto a disc'; dimension = 2; spacing = '20 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '1 s';"
    "domain = { min = ('-0.2 m', '-0.2 m'); max = ('3 m', '2 m'); };"
    "soil = ( { name = 'sand'; initial_stress = { type = 'k0'; };"
    "  shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.4 m', '0.8 m'); };"
    "  material = { model = 'drucker_prager'; density = '1600 kg/m3'; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; }; } );"
    "bodies = ( { name = 'disc'; shape = { type = 'sphere'; center = ('0.62 m', '0.1 m'); radius = '0.1 m'; };"
    "  material = { model = 'rigid'; density = '2400 kg/m3'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"
    "  { name = 'back'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; } );";

static scene *open_checked(void)
{
    static const char *const nothing[] = {NULL};
    const scene_request request = {column, (const char *const *[]){nothing}, 1, 1};
    return scene_build_checked(&request, true);
}

/* A cluster is looked at in each step: all of them once and more while soil flows onto the disc. */
static void lists_are_complete_in_each_step(void **state)
{
    (void)state;
    scene *it = open_checked();
    const uint64_t n_before = it->simulation.soil.inner.n_builds;
    scene_advance(it, 0.12);
    assert_true(it->simulation.schedule.n_steps > (uint64_t)it->simulation.soil.tree.n_clusters);
    /* Or else lists were not kept. */
    assert_true(it->simulation.soil.inner.n_builds - n_before < it->simulation.schedule.n_steps / 2);
    scene_free(it);
}

/* Runs on until a step fails, and looks for a text in its message. */
static void expect_stop(scene *it, const char *text)
{
    mor_schedule *schedule = &it->simulation.schedule;
    mor_status status = MOR_OK;
    for (int64_t k = 0; k < it->simulation.soil.tree.n_clusters && status == MOR_OK; ++k) {
        status = mor_schedule_step(&it->context, schedule, schedule->end);
    }
    assert_int_equal(status, MOR_ERROR_INTERNAL);
    if (strstr(it->context.message, text) == NULL) {
        fail_msg("%s", it->context.message);
    }
}

/* Takes an entry from the list of a cluster: the last, or one of a run of several. */
static void leave_one_out(const mor_relation *relation, int64_t cluster)
{
    if (!relation->has_runs) {
        relation->counts[cluster] -= relation->counts[cluster] > 0 ? 1 : 0;
        return;
    }
    for (int32_t k = 0; k < relation->sizes[cluster]; ++k) {
        int32_t *run = relation->lists[cluster] + k;
        const uint32_t points = mor_run_points(*run);
        if ((points & (points - 1)) != 0) {
            *run &= *run - 1; /* its lowest point */
            relation->counts[cluster] -= 1;
            return;
        }
    }
}

static void list_that_lacks_a_neighbor_stops_the_checked_build(void **state)
{
    static const char *const texts[] = {"neighbor lists of soil and soil", "neighbor lists of soil and floor"};
    (void)state;
    for (int k = 0; k < 2; ++k) {
        scene *it = open_checked();
        scene_step(it, 20);
        mor_soil *soil = &it->simulation.soil;
        const mor_relation *relation = k == 0 ? &soil->inner : &mor_soil_contact_at(soil, 0)->relation;
        for (int64_t cluster = 0; cluster < relation->n_clusters; ++cluster) {
            leave_one_out(relation, cluster);
        }
        expect_stop(it, texts[k]);
        scene_free(it);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_are_complete_in_each_step),
        cmocka_unit_test(list_that_lacks_a_neighbor_stops_the_checked_build),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
