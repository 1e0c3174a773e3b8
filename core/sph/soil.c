/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/material/checked.h"
#include "core/particle/kernel.h"
#include "core/sph/stress/separation.h"

#include <string.h>

#define BIT(name) MOR_BIT(MOR_FIELD_##name)
#define SHARED(name) MOR_BIT(MOR_RESOURCE_##name)

/* Diameters of the sphere and of the disc whose volume is one: (6 / pi)^(1/3) and 2 / sqrt(pi). */
#define SPHERE_DIAMETER 1.2407009817988
#define DISC_DIAMETER 1.1283791670955126

/* One step, Zhang et al. (2024) eqs. 54-56: positions to the middle, forces there, velocity, positions, stress. */
static bool has_artificial_stress(const void *owner)
{
    return ((const mor_soil *)owner)->settings.scheme.artificial_stress;
}

static bool has_angular_momentum(const void *owner)
{
    return ((const mor_soil *)owner)->settings.scheme.angular_momentum;
}

static bool has_present_spin(const void *owner)
{
    return has_angular_momentum(owner) && ((const mor_soil *)owner)->settings.scheme.angular_momentum_by == 0;
}

static bool has_fit(const void *owner)
{
    return ((const mor_soil *)owner)->settings.scheme.velocity_gradient != 0;
}

static bool has_correction(const void *owner)
{
    return ((const mor_soil *)owner)->settings.scheme.gradient_correction && !has_fit(owner);
}

static bool has_strain_rate(const void *owner)
{
    return ((const mor_soil *)owner)->set.data[MOR_FIELD_STRAIN_RATE] != NULL && !has_fit(owner);
}

static bool has_hourglass(const void *owner)
{
    return ((const mor_soil *)owner)->set.data[MOR_FIELD_HOURGLASS] != NULL;
}

static bool has_mean_stress(const void *owner)
{
    return ((const mor_soil *)owner)->set.data[MOR_FIELD_MEAN_STRESS] != NULL;
}

static bool has_regularization(const void *owner)
{
    return ((const mor_soil *)owner)->regularization != NULL;
}

static bool has_audit(const void *owner)
{
    return ((const mor_soil *)owner)->energy != NULL;
}

#define GAPS (BIT(GAP) | BIT(GAP_FACE) | BIT(FACE_GROWTH))
#define CALM (BIT(QUIET) | BIT(QUIET_PLACE) | BIT(QUIET_STRESS) | BIT(QUIET_SPAN))

#define OR_BIT(name) | BIT(name)
#define STANDING (0 MOR_SOIL_STANDING(OR_BIT))

static const mor_stage soil_stages[] = {
    {"first drift", mor_soil_drift_first, BIT(VELOCITY) | BIT(DENSITY_RATE), 0,
     BIT(POSITION) | BIT(DENSITY) | SHARED(BOUNDARIES) | SHARED(BOUNDS),
     "positions and densities to the middle of the step", NULL},
    {"neighbors", mor_soil_find_neighbors, BIT(POSITION) | SHARED(BOUNDARIES) | SHARED(STATE), 0,
     SHARED(LISTS) | SHARED(ORDER) | SHARED(BOUNDS),
     "sorts particles at an interval; rebuilds neighbor lists when they may lack a neighbor", NULL},
    {"hold", mor_soil_hold, STANDING | SHARED(STATE), 0, SHARED(LISTS),
     "finds the soil that is not released, when there is such", mor_soil_may_hold},
    {"sleep", mor_soil_sleep, BIT(POSITION) | BIT(MASS) | BIT(QUIET) | SHARED(BOUNDARIES), 0,
     BIT(VELOCITY) | BIT(DENSITY_RATE) | SHARED(LISTS),
     "decides which soil at rest is left out of this step, when switched on", mor_soil_may_sleep},
    {"pack", mor_soil_pack,
     BIT(POSITION) | BIT(VELOCITY) | BIT(DENSITY) | BIT(STRESS) | BIT(MASS) | BIT(HOURGLASS) | BIT(MEAN_STRESS) |
         BIT(FLOW) | BIT(SPIN_STRESS) | SHARED(STATE) | SHARED(LISTS),
     SHARED(RECORDS) | SHARED(FORCE_RECORDS), 0, "packs records of the particles for the pair loops", NULL},
    {"wall sums", mor_soil_sum_walls, SHARED(RECORDS) | SHARED(LISTS) | SHARED(BOUNDARIES), SHARED(WALL_SUMS), 0,
     "kernel sums over walls and rocks in reach", NULL},
    {"density", mor_soil_reinitialize_density, SHARED(LISTS) | SHARED(WALL_SUMS) | BIT(MASS), 0,
     BIT(DENSITY) | BIT(SEPARATION) | SHARED(RECORDS), "density by summation at an interval",
     mor_soil_has_density_sums},
    {"artificial stress", mor_soil_find_artificial_stress, BIT(STRESS) | BIT(FLOW), BIT(ARTIFICIAL_STRESS), 0,
     "against tensile instability, where soil flows with transient stress diffusion, when switched on",
     has_artificial_stress},
    {"present skew stress", mor_soil_find_present_spin,
     SHARED(RECORDS) | SHARED(LISTS) | SHARED(WALL_SUMS) | BIT(HOURGLASS_MOMENT) | BIT(STRESS), SHARED(CLOSED),
     BIT(SPIN_STRESS) | SHARED(FORCE_RECORDS),
     "with which the forces of the soil have no moment, found in this step, when switched on", has_present_spin},
    {"momentum", mor_soil_sum_momentum,
     SHARED(RECORDS) | SHARED(FORCE_RECORDS) | SHARED(LISTS) | BIT(ARTIFICIAL_STRESS) | BIT(STRAIN_RATE),
     BIT(ACCELERATION) | BIT(STRESS_DIFFUSION) | SHARED(SHORT_LISTS) | BIT(HOURGLASS_MOMENT), 0,
     "acceleration and stress diffusion by the neighbors", NULL},
    {"impulse on sleep", mor_soil_count_sleep, BIT(ACCELERATION) | BIT(MASS), 0, SHARED(LISTS),
     "impulse given to soil that sleeps, when switched on", mor_soil_may_sleep},
    {"boundary forces", mor_soil_sum_boundary_forces,
     SHARED(RECORDS) | SHARED(SHORT_LISTS) | SHARED(WALL_SUMS) | SHARED(BOUNDARIES) | SHARED(STATE) | BIT(STRAIN_RATE) |
         GAPS | BIT(DENSITY_RATE) | BIT(MEAN_STRESS),
     SHARED(WALL_FORCES) | BIT(GROWTH), BIT(ACCELERATION), "acceleration by walls and rocks, and the forces on them",
     NULL},
    {"kick", mor_soil_kick, SHARED(LISTS), 0,
     BIT(ACCELERATION) | BIT(VELOCITY) | SHARED(RECORDS) | SHARED(BOUNDS) | SHARED(WALL_FORCES),
     "velocities to the end of the step", NULL},
    {"velocity gradient", mor_soil_sum_gradient, SHARED(RECORDS) | SHARED(SHORT_LISTS),
     BIT(VELOCITY_GRADIENT) | BIT(DENSITY_RATE) | BIT(HOURGLASS_RATE) | BIT(MOMENTS), 0,
     "velocity gradient and density rate by the neighbors", NULL},
    {"boundary gradient", mor_soil_sum_boundary_gradient,
     SHARED(RECORDS) | SHARED(WALL_FORCES) | SHARED(BOUNDARIES) | SHARED(STATE) | BIT(MEAN_STRESS), 0,
     BIT(VELOCITY_GRADIENT) | BIT(DENSITY_RATE) | GAPS | BIT(GROWTH) | SHARED(WALL_SUMS),
     "velocity gradient and density rate by walls and rocks", NULL},
    {"energy of forces", mor_soil_audit_forces,
     SHARED(SHORT_LISTS) | SHARED(WALL_SUMS) | SHARED(WALL_FORCES) | SHARED(BOUNDARIES) | BIT(MASS) | BIT(VELOCITY) |
         BIT(ACCELERATION) | BIT(STRAIN_RATE) | BIT(ARTIFICIAL_STRESS) | BIT(HOURGLASS) | BIT(SPIN_STRESS),
     0, SHARED(ENERGY_SUMS) | SHARED(RECORDS),
     "energy dissipated by forces other than the stress, at an interval, when a probe needs it", has_audit},
    {"gradient correction", mor_soil_correct_gradient,
     SHARED(RECORDS) | SHARED(LISTS) | SHARED(WALL_SUMS) | BIT(DENSITY), SHARED(CLOSED),
     BIT(VELOCITY_GRADIENT) | BIT(DENSITY_RATE), "corrects both to be exact for linear fields, when switched on",
     has_correction},
    {"velocity gradient fit", mor_soil_fit_gradient,
     SHARED(LISTS) | SHARED(WALL_SUMS) | SHARED(WALL_FORCES) | BIT(MOMENTS) | BIT(DENSITY) | BIT(FLOW),
     SHARED(CLOSED) | BIT(STRAIN_RATE), BIT(VELOCITY_GRADIENT) | BIT(DENSITY_RATE),
     "makes both those of the linear field that fits the neighbors, when switched on; stores the strain rate", has_fit},
    {"strain rate", mor_soil_store_strain_rate, BIT(VELOCITY_GRADIENT), BIT(STRAIN_RATE), 0,
     "strain rate, stored for the reconstruction and the slip along walls of the next step, when kept without a fit",
     has_strain_rate},
    {"regularization", mor_soil_regularize, SHARED(RECORDS) | SHARED(SHORT_LISTS) | BIT(VELOCITY_GRADIENT),
     SHARED(REGULARIZATION), BIT(POSITION) | BIT(VELOCITY) | SHARED(BOUNDS), "XSPH and shifting, when switched on",
     has_regularization},
    {"second drift", mor_soil_drift_second, BIT(VELOCITY) | BIT(DENSITY_RATE), 0,
     BIT(POSITION) | BIT(DENSITY) | BIT(CROSSINGS) | SHARED(BOUNDS), "positions and densities to the end of the step",
     NULL},
    {"nonlocal field", mor_soil_diffuse_fields, SHARED(RECORDS) | SHARED(SHORT_LISTS) | BIT(STRESS), 0, SHARED(STATE),
     "diffuses the field of a nonlocal law, when there is one", mor_soil_has_field},
    {"stress", mor_soil_advance_stress,
     BIT(VELOCITY_GRADIENT) | BIT(STRESS_DIFFUSION) | BIT(DENSITY) | SHARED(LISTS) | BIT(MOMENTS), 0,
     BIT(STRESS) | BIT(SEPARATION) | SHARED(STATE), "stress and state by the material, where soil has not come apart",
     NULL},
    {"memory", mor_soil_remember,
     BIT(VELOCITY_GRADIENT) | BIT(STRESS) | BIT(HOURGLASS_RATE) | BIT(HOURGLASS_MOMENT) | BIT(MOMENTS) |
         SHARED(WALL_SUMS) | SHARED(LISTS),
     SHARED(CLOSED), BIT(SPIN_STRESS) | BIT(MEAN_STRESS) | BIT(FLOW) | BIT(HOURGLASS),
     "skew stress, recent mean of the stress and hourglass displacement for the next step, when switched on",
     mor_soil_has_memory},
    {"quiet", mor_soil_find_quiet, BIT(POSITION) | BIT(VELOCITY) | BIT(STRESS) | SHARED(LISTS), 0, CALM,
     "for how long each particle has been quiet, when soil may sleep", mor_soil_has_quiet},
    {"stand", mor_soil_put_back, SHARED(LISTS), 0, STANDING | SHARED(STATE),
     "puts soil back that is not released, where it was computed beside other soil", mor_soil_may_hold},
    {"energy of stress", mor_soil_audit_stress,
     SHARED(RECORDS) | SHARED(REGULARIZATION) | SHARED(STATE) | SHARED(WALL_SUMS) | SHARED(WALL_FORCES) | BIT(MASS) |
         BIT(DENSITY) | BIT(VELOCITY) | BIT(VELOCITY_GRADIENT) | BIT(STRESS_DIFFUSION) | BIT(STRESS),
     0, SHARED(ENERGY_SUMS), "energy dissipated by the stress update, at an interval, when a probe needs it",
     has_audit},
    {"outflow", mor_soil_remove_outflow,
     BIT(CROSSINGS) | BIT(POSITION) | BIT(VELOCITY) | BIT(MASS) | BIT(DENSITY) | BIT(STRESS) | SHARED(STATE), 0,
     SHARED(ORDER), "removes particles that left the domain, when outflow is allowed", NULL},
};

enum { N_STAGES = sizeof soil_stages / sizeof *soil_stages };

static const uint64_t evolving_fields = STANDING | BIT(MASS) | BIT(CROSSINGS) | SHARED(STATE) | SHARED(BOUNDARIES) |
                                        SHARED(ENERGY_SUMS) | SHARED(BOUNDS) | SHARED(ORDER) | SHARED(LISTS);

/* Arrays that one stage writes and others read, for the checked build. Those of walls are not among them: they are
 * reallocated with the lists, and have lanes without particles; nor what is kept of clusters at walls, which is, too;
 * nor the records of forces, of which a part stays as it is in steps without stress diffusion.
 * What is closed for all particles is that of one option of the gradient or of the skew stress. */
static void visit_shared(void *owner, mor_shared_visit visit, void *job)
{
    mor_soil *soil = owner;
    const int64_t n = soil->set.n_particles;
    visit(job, MOR_RESOURCE_RECORDS, soil->records, n * MOR_RECORD_SIZE);
    visit(job, MOR_RESOURCE_LISTS, soil->of_soil, n * MOR_PAIR_OF_SOIL_SIZE);
    visit(job, MOR_RESOURCE_REGULARIZATION, soil->regularization, 6 * n);
}

static void set_constants(mor_soil *soil)
{
    const mor_soil_settings *s = &soil->settings;
    const double h = s->scheme.smoothing_ratio * s->spacing;
    soil->smoothing_length = h;
    double moment = 0.0;
    mor_soil_sum_lattice(s, h, &soil->lattice_sum, &moment);
    soil->lattice_moment = moment;
    soil->constants = (mor_pair_constants){
        .dimension = s->dimension,
        .dissipation = (mor_dissipation)s->scheme.dissipation,
        .has_artificial_stress = s->scheme.artificial_stress,
        .has_pressure_term = s->scheme.density_pressure_term,
        .has_transient = has_mean_stress(soil),
        .has_hourglass = has_hourglass(soil),
        .has_fit = has_fit(soil),
        .has_spin = has_angular_momentum(soil),
        .smoothing_length = h,
        .gradient_factor =
            mor_kernel_gradient_factor(h, s->dimension) / (s->scheme.lattice_normalization ? moment : 1.0),
        .laplacian_factor = mor_kernel_gradient_factor(h, s->dimension) / moment,
        .limiter_rate = s->scheme.dissipation_factor / soil->sound_speed,
        .diffusion_factor = 1.0,
        .diffusion_rate = 2.0 * s->scheme.stress_diffusion * h * soil->sound_speed,
        .has_limited_diffusion = s->scheme.stress_diffusion_limiter == 1,
        .artificial_exponent = s->scheme.artificial_stress_exponent,
        .shift_diameter = s->spacing * (s->dimension == 3 ? SPHERE_DIAMETER : DISC_DIAMETER),
        .spacing = s->spacing,
        .spacing_kernel = mor_kernel_value(s->spacing, h, s->dimension),
        .kernel_normalization = mor_kernel_normalization(h, s->dimension),
    };
    for (int k = 0; k < soil->n_kinds; ++k) {
        const mor_soil_kind *kind = &soil->kinds[k];
        soil->pair_soils[k].limiter_rate = s->scheme.dissipation_factor / kind->sound_speed;
        soil->pair_soils[k].hourglass =
            s->scheme.soil_hourglass * kind->reference_density * kind->sound_speed * kind->sound_speed;
        soil->pair_soils[k].diffusion_rate = 2.0 * s->scheme.stress_diffusion * h * kind->sound_speed;
    }
    soil->constants.hourglass = soil->pair_soils[0].hourglass;
    soil->constants.soils = soil->of_soil != NULL ? soil->pair_soils : NULL;
    const double strength = mor_vector_length(s->gravity);
    for (int a = 0; a < 3 && strength > 0.0; ++a) {
        soil->constants.gravity_direction[a] = s->gravity[a] / strength;
    }
}

static mor_status set_kinds(mor_context *context, mor_soil *soil)
{
    const mor_soil_settings *s = &soil->settings;
    const bool has_several = mor_composite_is(soil->material);
    MOR_CHECK(context, has_several ? s->n_kinds >= 1 && s->n_kinds <= MOR_COMPOSITE_PARTS_MAX : s->n_kinds == 0,
              MOR_ERROR_ARGUMENT, "found constants of %d soils; allowed: those of the parts of a composite, 1 to %d",
              s->n_kinds, MOR_COMPOSITE_PARTS_MAX);
    soil->n_kinds = has_several ? s->n_kinds : 1;
    soil->kinds[0] = (mor_soil_kind){.reference_density = s->reference_density, .lateral_ratio = s->lateral_ratio};
    for (int k = 0; k < soil->n_kinds; ++k) {
        soil->kinds[k] = has_several ? s->kinds[k] : soil->kinds[k];
        const mor_status status = mor_soil_kind_find_speed(context, soil->material, k, &soil->kinds[k]);
        MOR_TRY(context, status == MOR_OK ? status : mor_context_name_item(context, status, k));
        if (s->scheme.coulomb_tension == 1) {
            soil->across[k] = mor_soil_kind_find_across(s->guard, soil->material, k, &soil->kinds[k]);
            soil->keeps_gaps = soil->keeps_gaps || soil->across[k] > 0.0;
        }
        soil->sound_speed = fmax(soil->sound_speed, soil->kinds[k].sound_speed);
    }
    soil->settings.kinds = NULL;
    return MOR_OK;
}

/* Makes room for the records of forces, and has what is found later in a step in it where memory is shared. */
static mor_status allocate_extra(mor_context *context, mor_soil *soil, int64_t padded)
{
    if (!has_angular_momentum(soil) && !has_hourglass(soil) && !has_mean_stress(soil)) {
        return MOR_OK;
    }
    MOR_CHECK(context, !soil->settings.shares_memory || !context->is_checked, MOR_ERROR_INTERNAL,
              "soil '%s' shares memory in a checked run, which looks at all of it around each stage", soil->set.name);
    const int width = soil->settings.shares_memory ? mor_set_width(&soil->set, MOR_SOIL_LATE) : 0;
    soil->extra_width = width > MOR_EXTRA_SIZE ? width : MOR_EXTRA_SIZE;
    MOR_TRY(context, MOR_NEW(context, &soil->extra, padded * soil->extra_width, "neighbor records"));
    mor_soil_place_late(context, soil);
    return mor_stage_verify_shared(context, soil_stages, N_STAGES, SHARED(FORCE_RECORDS), MOR_SOIL_LATE, &soil->set);
}

static mor_status allocate_soil(mor_context *context, mor_soil *soil, int64_t n_particles)
{
    const mor_soil_settings *s = &soil->settings;
    MOR_TRY(context, mor_tree_init(context, &soil->tree, n_particles));
    MOR_TRY(context, mor_relation_init(context, &soil->inner, MOR_CONFIGURATION_CURRENT, soil->tree.n_clusters));
    if (!s->is_periodic[0] && !s->is_periodic[1] && !s->is_periodic[2]) {
        MOR_TRY(context, mor_relation_use_runs(context, &soil->inner));
    }
    const int64_t padded = soil->tree.n_clusters * MOR_CLUSTER;
    MOR_TRY(context, MOR_NEW(context, &soil->records, padded * MOR_RECORD_SIZE, "neighbor records"));
    MOR_TRY(context, MOR_NEW(context, &soil->order, n_particles, "order of the sort"));
    MOR_TRY(context, mor_wall_clusters_init(context, &soil->wall_clusters, soil->tree.n_clusters));
    soil->wall_clusters.has_continued = has_fit(soil);
    soil->wall_clusters.has_closed = has_fit(soil) || mor_soil_has_last_spin(soil);
    if (mor_composite_is(soil->material)) {
        MOR_TRY(context, MOR_NEW(context, &soil->of_soil, padded * MOR_PAIR_OF_SOIL_SIZE, "soils of the particles"));
        MOR_TRY(context, MOR_NEW(context, &soil->one_soil, soil->tree.n_clusters, "soils of the clusters"));
    }
    if (s->scheme.xsph > 0.0 || s->scheme.shifting) {
        MOR_TRY(context, MOR_NEW(context, &soil->regularization, padded * 6, "XSPH and shifting sums"));
    }
    if (has_correction(soil) || has_present_spin(soil)) {
        MOR_TRY(context, MOR_NEW(context, &soil->closed, padded * 6, "closed kernel-gradient moments"));
    }
    MOR_TRY(context, allocate_extra(context, soil, padded));
    MOR_TRY(context, mor_soil_allocate_places(context, soil));
    if (mor_soil_has_density_sums(soil)) {
        MOR_TRY(context, MOR_NEW(context, &soil->density_sums, n_particles, "densities by summation"));
    }
    MOR_TRY(context, mor_soil_allocate_images(context, soil));
    MOR_TRY(context, mor_soil_init_sleep(context, soil, n_particles));
    MOR_TRY(context, mor_soil_allocate_fields(context, soil, padded));
    return mor_reduce_room_init(context, &soil->room, n_particles / MOR_SOIL_BATCH + 1, MOR_SOIL_BLOCK_VALUES);
}

/* The state variables of the material, and the number of the region where there are several. */
static mor_status add_state(mor_context *context, mor_soil *soil)
{
    static const mor_schema region = {.key = MOR_COMPOSITE_INDEX_KEY,
                                      .kind = MOR_SCHEMA_INTEGER,
                                      .n_components = 1,
                                      .unit = "1",
                                      .text = "number of the soil region, from 0"};
    const mor_material *material = soil->material->material;
    MOR_TRY(context,
            mor_set_add_state(context, &soil->set, material->state, soil->material->n_state, soil->state_fields));
    soil->region_field = mor_composite_is(soil->material) ? soil->state_fields[0] : -1;
    return soil->region_field < 0 && soil->settings.n_regions > 1
               ? mor_set_add_state(context, &soil->set, &region, 1, &soil->region_field)
               : MOR_OK;
}

mor_status mor_soil_init(mor_context *context, mor_soil *soil, const char *name, const mor_soil_settings *settings,
                         const mor_material_instance *material, int64_t n_particles)
{
    memset(soil, 0, sizeof *soil);
    soil->settings = *settings;
    soil->material = material;
    soil->table = mor_pair_select(NULL);
    soil->lanes = mor_soil_lanes_select(NULL);
    MOR_CHECK(
        context, n_particles >= 1, MOR_ERROR_ARGUMENT,
        "soil '%s' has no particles; its shape must hold at least one lattice point: make the shape larger or the "
        "spacing smaller",
        name);
    MOR_CHECK(context, material->material->form == MOR_MATERIAL_RATE, MOR_ERROR_ARGUMENT,
              "material '%s' is for elastic bodies; soil needs a material in rate form", material->material->name);
    MOR_TRY(context, set_kinds(context, soil));
    const mor_scheme *scheme = &settings->scheme;
    const uint64_t all = ~(uint64_t)0;
    uint64_t fields = ((uint64_t)1 << MOR_FIELD_CORE_COUNT) - 1;
    fields &= scheme->artificial_stress ? all : ~BIT(ARTIFICIAL_STRESS);
    fields &= scheme->stress_diffusion > 0.0 ? all : ~BIT(STRESS_DIFFUSION);
    fields &= scheme->soil_hourglass > 0.0 ? all : ~(BIT(HOURGLASS) | BIT(HOURGLASS_RATE) | BIT(HOURGLASS_MOMENT));
    fields &= scheme->angular_momentum ? all : ~(BIT(SPIN_STRESS) | BIT(HOURGLASS_MOMENT));
    fields &= has_fit(soil) || mor_soil_has_last_spin(soil) ? all : ~BIT(MOMENTS);
    fields &=
        scheme->stress_diffusion > 0.0 && scheme->stress_diffusion_limiter == 2 ? all : ~(BIT(MEAN_STRESS) | BIT(FLOW));
    fields &= scheme->separation_memory ? all : ~BIT(SEPARATION);
    fields &= soil->keeps_gaps ? all : ~(GAPS | BIT(GROWTH));
    fields &= scheme->sleep_after > 0.0 ? all : ~CALM;
    fields &= settings->is_periodic[0] || settings->is_periodic[1] || settings->is_periodic[2] ? all : ~BIT(CROSSINGS);
    fields &= scheme->reconstruction == 1 || scheme->coulomb_tension != 0 ? all : ~BIT(STRAIN_RATE);
    mor_status status = mor_set_init(context, &soil->set, name, n_particles, fields);
    if (status == MOR_OK) {
        status = add_state(context, soil);
    }
    if (status == MOR_OK) {
        status = allocate_soil(context, soil, n_particles);
    }
    if (status != MOR_OK) {
        mor_soil_clear(context, soil);
        return status;
    }
    set_constants(soil);
    for (int64_t i = 0; i < n_particles && soil->set.data[MOR_FIELD_SEPARATION] != NULL; ++i) {
        soil->set.data[MOR_FIELD_SEPARATION][i] = MOR_SEPARATION_UNKNOWN;
    }
    soil->largest_acceleration = mor_vector_length(settings->gravity);
    return MOR_OK;
}

void mor_soil_clear(mor_context *context, mor_soil *soil)
{
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        mor_soil_contact_clear(context, mor_soil_contact_at(soil, k));
    }
    mor_soil_clear_energy(context, soil);
    mor_images_clear(context, &soil->images);
    MOR_FREE(context, &soil->image_stress);
    MOR_FREE(context, &soil->image_strains);
    mor_relation_clear(context, &soil->inner);
    mor_tree_clear(context, &soil->tree);
    mor_reduce_room_clear(context, &soil->room);
    mor_sleep_clear(context, &soil->sleep);
    mor_hold_clear(context, &soil->hold);
    MOR_FREE(context, &soil->moving);
    MOR_FREE(context, &soil->density_sums);
    MOR_FREE(context, &soil->diffusion);
    MOR_FREE(context, &soil->field_records);
    mor_wall_clusters_clear(context, &soil->wall_clusters);
    MOR_FREE(context, &soil->closed);
    MOR_FREE(context, &soil->extra);
    mor_pair_singles_clear(context, &soil->singles);
    MOR_FREE(context, &soil->regularization);
    mor_skin_places_clear(context, &soil->list_places);
    mor_skin_places_clear(context, &soil->boundary_places);
    mor_tree_clear(context, &soil->boundary_tree);
    MOR_FREE(context, &soil->ranges);
    MOR_FREE(context, &soil->order);
    MOR_FREE(context, &soil->one_soil);
    MOR_FREE(context, &soil->of_soil);
    MOR_FREE(context, &soil->records);
    mor_set_clear(context, &soil->set);
    memset(soil, 0, sizeof *soil);
}

mor_status mor_soil_add_wall(mor_context *context, mor_soil *soil, const mor_wall_request *request)
{
    MOR_CHECK(context, soil->n_walls < MOR_SOIL_WALLS_MAX, MOR_ERROR_ARGUMENT,
              "wall '%s' is one too many; at most %d walls are allowed: join some with a union", request->name,
              MOR_SOIL_WALLS_MAX);
    MOR_CHECK(context,
              request->source == NULL || soil->sleep.states == NULL || request->motion == NULL ||
                  !mor_motion_rotates(request->motion),
              MOR_ERROR_ARGUMENT,
              "wall '%s' rotates and is filled where soil is near alone, beside soil that may sleep or is released "
              "later; such a wall must hold all its particles: leave its source out",
              request->name);
    MOR_TRY(context,
            mor_soil_contact_init(context, &soil->walls[soil->n_walls], request, &soil->period, soil->tree.n_clusters));
    mor_soil_contact_number(soil->walls, soil->n_walls, 0);
    soil->wall_clusters.has_corners |= soil->walls[soil->n_walls].normals != NULL;
    soil->n_walls += 1;
    return MOR_OK;
}

mor_status mor_soil_fill_walls(mor_context *context, mor_soil *soil)
{
    mor_tree_fit(&soil->tree, soil->set.data[MOR_FIELD_POSITION], 3);
    for (int w = 0; w < soil->n_walls; ++w) {
        MOR_TRY(context, mor_soil_contact_fill(context, &soil->walls[w], &soil->tree, mor_soil_reach(soil)));
        mor_soil_contact_forget_start(context, &soil->walls[w]);
    }
    return MOR_OK;
}

mor_status mor_soil_add_boundary(mor_context *context, mor_soil *soil, mor_boundary *boundary, mor_wall_stress stress)
{
    MOR_CHECK(context, soil->n_boundaries < MOR_SOIL_BOUNDARIES_MAX, MOR_ERROR_ARGUMENT,
              "boundary '%s' is one too many; at most %d are allowed: join some as patches of one", boundary->name,
              MOR_SOIL_BOUNDARIES_MAX);
    MOR_TRY(context, mor_soil_contact_borrow(context, &soil->boundaries[soil->n_boundaries], boundary, stress,
                                             soil->settings.dimension, soil->tree.n_clusters));
    mor_soil_contact_number(soil->boundaries, soil->n_boundaries, MOR_SOIL_WALLS_MAX);
    soil->n_boundaries += 1;
    soil->wall_clusters.has_corners |= boundary->normals != NULL;
    mor_soil_forget_lists(soil);
    return soil->sleep.states != NULL ? mor_sleep_add_bodies(context, &soil->sleep, boundary->n_patches) : MOR_OK;
}

mor_status mor_soil_set_barrier(mor_context *context, mor_soil *soil, const mor_boundary *boundary,
                                const mor_soil_barrier *barrier)
{
    for (int k = 0; k < soil->n_boundaries; ++k) {
        if (soil->boundaries[k].boundary == boundary) {
            mor_soil_forget_lists(soil);
            return mor_soil_contact_set_barrier(context, &soil->boundaries[k], barrier,
                                                MOR_KERNEL_SUPPORT * soil->smoothing_length);
        }
    }
    return MOR_FAIL(context, MOR_ERROR_ARGUMENT,
                    "a barrier was set for boundary '%s', which the soil '%s' does not see", boundary->name,
                    soil->set.name);
}

void mor_soil_stepper(mor_soil *soil, mor_stepper *stepper, uint64_t *evolving)
{
    static const mor_stepper_operations operations = {
        .kind = "soil", .propose = mor_soil_propose_step, .list_state = mor_soil_list_state, .resume = mor_soil_resume};
    const int n_stages = N_STAGES;
    *stepper = (mor_stepper){.name = soil->set.name,
                             .operations = &operations,
                             .owner = soil,
                             .stages = soil_stages,
                             .n_stages = n_stages,
                             .n_before = n_stages,
                             .n_particles = soil->set.n_particles,
                             .is_leader = true,
                             .set = &soil->set,
                             .visit_shared = visit_shared};
    /* Forces on walls and rocks are known once the boundary forces are summed. */
    for (int k = 0; k < n_stages; ++k) {
        stepper->n_before = soil_stages[k].run == mor_soil_sum_boundary_forces ? k + 1 : stepper->n_before;
    }
    *evolving = evolving_fields;
}

double mor_soil_bytes_per_particle(const mor_soil *soil)
{
    const double n = (double)soil->set.n_particles;
    const double padded = (double)(soil->tree.n_clusters * MOR_CLUSTER);
    double bytes = n * (sizeof *soil->set.id + sizeof *soil->order) + padded * MOR_RECORD_SIZE * sizeof(double);
    bytes += (6.0 * n + (soil->ranges != NULL ? 36.0 : 24.0) * (double)soil->tree.n_clusters) * sizeof(double);
    for (int field = 0; field < soil->set.n_fields; ++field) {
        const bool is_own = soil->set.data[field] != NULL && (soil->set.borrowed >> field & 1u) == 0;
        bytes += is_own ? n * soil->set.fields[field].n_components * (double)sizeof(double) : 0.0;
    }
    bytes += soil->of_soil != NULL ? padded * (MOR_PAIR_OF_SOIL_SIZE * sizeof(double) + 1.0 / MOR_CLUSTER) : 0.0;
    const int n_tensors = (soil->regularization != NULL) + (soil->closed != NULL);
    bytes += n_tensors * padded * 6.0 * sizeof(double);
    bytes += soil->density_sums != NULL ? n * sizeof(double) : 0.0;
    bytes += mor_wall_clusters_bytes(&soil->wall_clusters, soil->tree.n_clusters);
    bytes += soil->energy != NULL ? n * 5.0 * sizeof(double) : 0.0;
    bytes += soil->diffusion != NULL ? padded * 4.0 * sizeof(double) : 0.0;
    bytes += soil->settings.scheme.precision != 1
                 ? 0.0
                 : padded * mor_pair_singles_bytes(soil->extra != NULL, soil->settings.scheme.artificial_stress,
                                                   soil->settings.scheme.reconstruction == 1, soil->of_soil != NULL);
    bytes += soil->sleep.states != NULL ? mor_sleep_bytes(&soil->sleep) : 0.0;
    bytes += padded * soil->extra_width * (double)sizeof(double);
    const int n_sizes = soil->inner.sizes != soil->inner.counts ? 3 : 2; /* with the occupied clusters */
    bytes += (double)soil->inner.n_clusters * (sizeof *soil->inner.lists + (double)n_sizes * sizeof(int32_t));
    for (int buffer = 0; buffer < soil->inner.n_buffers; ++buffer) {
        bytes += (double)soil->inner.capacities[buffer] * sizeof(int32_t);
    }
    return bytes / n;
}

mor_status mor_soil_init_state(mor_context *context, mor_soil *soil)
{
    double *state[MOR_MATERIAL_STATES_MAX];
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < soil->material->n_state; ++k) {
        state[k] = soil->set.data[soil->state_fields[k]];
        state_in[k] = state[k];
    }
    int64_t failed = 0;
    const mor_batch batch = {.n = soil->set.n_particles,
                             .density = soil->set.data[MOR_FIELD_DENSITY],
                             .stress_in = soil->set.data[MOR_FIELD_STRESS],
                             .state_in = state_in,
                             .state_out = state,
                             .failed = &failed};
    const mor_status status = soil->material->operations.init_state(soil->material, &batch);
    MOR_CHECK(context, status == MOR_OK, status < 0 ? status : MOR_ERROR_NUMERIC,
              "material '%s' refused the initial state of particle %lld of set '%s'", soil->material->material->name,
              (long long)soil->set.id[failed], soil->set.name);
    if (has_mean_stress(soil)) {
        memcpy(soil->set.data[MOR_FIELD_MEAN_STRESS], soil->set.data[MOR_FIELD_STRESS],
               (size_t)(6 * soil->set.n_particles) * sizeof(double));
        memset(soil->set.data[MOR_FIELD_FLOW], 0, (size_t)soil->set.n_particles * sizeof(double));
    }
    return MOR_OK;
}
