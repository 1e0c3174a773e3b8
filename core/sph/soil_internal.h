/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_SOIL_INTERNAL_H
#define MOR_CORE_SPH_SOIL_INTERNAL_H

#include "core/base/math.h"
#include "core/particle/kernel.h"
#include "core/sph/soil.h"
#include "core/sph/stress/stress_update.h"

/** @file
 *  What the files of the soil solver share among themselves. Not for others. */

/** Stages of a step; owner is one mor_soil. Each returns MOR_OK or what went wrong. */
mor_status mor_soil_drift_first(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_find_neighbors(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_reinitialize_density(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_pack(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_walls(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_find_artificial_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_momentum(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_find_present_spin(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_boundary_forces(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_kick(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_boundary_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_correct_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_fit_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_store_strain_rate(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_regularize(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_drift_second(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_diffuse_fields(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_advance_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_remember(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_audit_forces(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_audit_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_remove_outflow(mor_context *context, void *owner, mor_view *view, const mor_step *step);

mor_status mor_soil_hold(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_put_back(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sleep(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_count_sleep(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_find_quiet(mor_context *context, void *owner, mor_view *view, const mor_step *step);

/** Proposes a step; an operation of a stepper.
 *  Returns: MOR_OK; MOR_ERROR_NUMERIC when the material gives none. */
mor_status mor_soil_propose_step(mor_context *context, void *owner, double *step_length, const char **limit);

/** Whether soil at rest may be left out of steps. */
bool mor_soil_may_sleep(const void *owner);

/** Whether any soil is released later than at the start. */
bool mor_soil_may_hold(const void *owner);

/** Whether soil at rest falls asleep. */
bool mor_soil_has_quiet(const void *owner);

/** Makes what soil needs that is left out of steps.
 *  @param n_particles [in]  number of particles, >= 1
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_soil_init_sleep(mor_context *context, mor_soil *soil, int64_t n_particles);

/** Makes room for where particles were when lists were built.
 *  @param soil [in,out]  with its tree
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_soil_allocate_places(mor_context *context, mor_soil *soil);

/** Finds which clusters have points of bodies on their lists, after each build of these or of the particles' lists.
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_soil_list_sleep_bodies(mor_context *context, mor_soil *soil);

/** Lists what a resumed run needs of the soil that slept.
 *  Returns: MOR_OK; as mor_state_add. */
mor_status mor_soil_list_sleep(mor_context *context, mor_soil *soil, mor_state_list *list);

/** Whether a particle stands still in the present step. */
static inline bool mor_soil_is_asleep(const mor_soil *soil, int64_t particle)
{
    return (soil->hold.is_held != NULL && soil->hold.is_held[particle]) ||
           mor_sleep_is(soil->sleep.states, particle / MOR_CLUSTER, MOR_SLEEP_ASLEEP);
}

/** Reach of the lists: kernel support plus skin, unit m. */
static inline double mor_soil_reach(const mor_soil *soil)
{
    return MOR_KERNEL_SUPPORT * soil->smoothing_length + soil->settings.scheme.skin_ratio * soil->settings.spacing;
}

/** Sizes of reductions over particles: particles handed to a material at once, most values of a block. */
enum { MOR_SOIL_BATCH = MOR_STRESS_BATCH, MOR_SOIL_BLOCK_VALUES = 4 };

/** Blocks of particles for reductions.
 *  @param block_items [in]  particles of a block, at least MOR_SOIL_BATCH
 *  @param grain       [in]  blocks a thread takes at once */
static inline mor_blocks mor_soil_blocks(const mor_soil *soil, int64_t block_items, int64_t grain)
{
    return (mor_blocks){.n_items = soil->set.n_particles, .block_items = block_items, .grain = grain};
}

/** Whether the density is reinitialized by summation at an interval. */
bool mor_soil_has_density_sums(const void *owner);

/** Steps of which stress diffuses in one, for all of them, 1: two where only what changes diffuses, the diffusion
 *  number, zeta times courant times two, is at most 0.2 (unstable between 0.32 and 0.36), and courant at most 0.5
 *  (unstable at 0.7 around elastic rocks), else one. Four were unstable at 0.16 around rocks, three stable at 0.19. */
static inline int mor_soil_diffusion_interval(const mor_soil *soil)
{
    const double largest_number = 0.2;
    const double largest_courant = 0.5;
    const mor_scheme *scheme = &soil->settings.scheme;
    const double steps = largest_number / (scheme->stress_diffusion * scheme->courant);
    return !soil->constants.has_transient || steps < 2.0 || scheme->courant > largest_courant ? 1 : 2;
}

/** Whether stress diffuses in this step. */
static inline bool mor_soil_diffuses(const mor_soil *soil, const mor_step *step)
{
    return step->number % (uint64_t)mor_soil_diffusion_interval(soil) == 0;
}

/** Takes the kernel sums over the soil of particle i, shape [MOR_KERNEL_SUMS], units of the enum. */
typedef void (*mor_soil_kernel_use)(void *job, int64_t i, const double *sums);

/** What of the kernel sums over boundaries is added to a field of the soil. */
typedef struct mor_soil_wall_sums {
    int first_sum;         /* of MOR_KERNEL_SUM_... */
    int n_sums;            /* from that one on, 1 */
    const double *scale;   /* shape [n_particles]; factor on the sums of each particle, any unit; NULL: 1 */
    bool of_walls_only;    /* not of rocks */
    bool of_awake_only;    /* not for soil that sleeps */
    const int32_t *places; /* of clusters in the field, see mor_wall_clusters; NULL: those of the particles */
} mor_soil_wall_sums;

/** Adds sums over walls and rocks to a field: out[i, a] += scale[i] * sum a of particle i.
 *  @param what [in]      which sums
 *  @param out  [in,out]  shape [n_particles, what->n_sums] without places; unit: of the sums times that of the scale */
void mor_soil_add_wall_sums(mor_context *context, mor_soil *soil, mor_view *view, const mor_soil_wall_sums *what,
                            double *out);

/** Sums kernel values over the soil, particle by particle.
 *  @param records [in]  shape [n_particles padded to 8, 16]; units of MOR_RECORD_...
 *  @param use     [in]  called once for each particle, by any thread
 *  @param job     [in]  its first argument */
void mor_soil_sum_kernels(mor_context *context, mor_soil *soil, mor_view *view, const double *records,
                          mor_soil_kernel_use use, void *job);

/** Cofactors of a moment of the kernel gradient, whose out-of-plane entry counts as one in plane strain; the inverse is
 *  that over the determinant.
 *  @param moment    [in]   shape [6], unit 1
 *  @param dimension [in]   2 or 3
 *  @param cofactors [out]  shape [6], unit 1
 *  Returns: the determinant, 1. */
static inline double mor_soil_moment_cofactors(const double *moment, int dimension, double *cofactors)
{
    const double solid[6] = {moment[MOR_XX], moment[MOR_YY], dimension == 3 ? moment[MOR_ZZ] : 1.0,
                             moment[MOR_XY], moment[MOR_YZ], moment[MOR_ZX]};
    return mor_symmetric_cofactors(solid, cofactors);
}

/** Copies moments of the particles of clusters that list a boundary and are awake; those of others that are awake are
 *  read where they are.
 *  @param moments [in]   shape [n_particles padded to 8, 6], unit 1
 *  @param at      [out]  closed becomes the copy, continued zero, where it is wanted */
void mor_soil_copy_moments(mor_context *context, const mor_soil *soil, const double *moments,
                           const mor_wall_clusters *at);

/** Whether forces conserve angular momentum by a skew stress that was found in the last step. */
bool mor_soil_has_last_spin(const void *owner);

/** Whether there is anything that the next step takes over, see soil_memory.c. */
bool mor_soil_has_memory(const void *owner);

/** Whether the velocity gradient is another than the sum whose counterpart the forces are. */
static inline bool mor_soil_corrects_gradient(const mor_soil *soil)
{
    return soil->settings.scheme.gradient_correction || soil->settings.scheme.velocity_gradient != 0;
}

/** Whether the soil has a law with a field. */
bool mor_soil_has_field(const void *owner);

/** Finds which state variables are fields of nonlocal laws, and allocates what their diffusion needs.
 *  @param padded [in]  particles, padded to whole clusters
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_soil_allocate_fields(mor_context *context, mor_soil *soil, int64_t padded);

/** Looks for particles outside the domain, with a position that is not a number, or without density.
 *  @param soil    [in,out]  has_outflow is set when particles are to be removed
 *  Returns: MOR_OK; MOR_ERROR_NUMERIC naming the first particle that stops the run. */
mor_status mor_soil_check_domain(mor_context *context, mor_soil *soil, mor_view *view, const mor_step *step);

/** The constants of the soil that a particle is of, or of the first with the same ones; valid after packing. */
static inline const mor_soil_kind *mor_soil_kind_of(const mor_soil *soil, int64_t particle)
{
    return &soil->kinds[soil->of_soil != NULL
                            ? (int)soil->of_soil[particle * MOR_PAIR_OF_SOIL_SIZE + MOR_PAIR_OF_SOIL_INDEX]
                            : 0];
}

/** Part of gravity that acts in a step, 1: that of the ramp at the middle of the step. */
double mor_soil_gravity_part(const mor_soil *soil, const mor_step *step);

/** What soil that is not released keeps, beside its state: its fields, one after the other. */
#define MOR_SOIL_STANDING(FIELD)                                                                                       \
    FIELD(POSITION)                                                                                                    \
    FIELD(VELOCITY)                                                                                                    \
    FIELD(DENSITY)                                                                                                     \
    FIELD(DENSITY_RATE)                                                                                                \
    FIELD(STRESS)                                                                                                      \
    FIELD(STRAIN_RATE)                                                                                                 \
    FIELD(MEAN_STRESS)                                                                                                 \
    FIELD(FLOW)                                                                                                        \
    FIELD(HOURGLASS)                                                                                                   \
    FIELD(HOURGLASS_MOMENT) FIELD(SPIN_STRESS) FIELD(SEPARATION) FIELD(GAP) FIELD(GAP_FACE) FIELD(FACE_GROWTH)         \
        FIELD(QUIET) FIELD(QUIET_PLACE) FIELD(QUIET_STRESS) FIELD(QUIET_SPAN)

/** Number of walls and boundaries together, 1. */
static inline int mor_soil_contact_count(const mor_soil *soil)
{
    return soil->n_walls + soil->n_boundaries;
}

/** The walls in their order, then the boundaries; owned by the soil. */
static inline mor_soil_contact *mor_soil_contact_at(mor_soil *soil, int index)
{
    return index < soil->n_walls ? &soil->walls[index] : &soil->boundaries[index - soil->n_walls];
}

/** Makes period and images of the particles, and refuses what does not go with them.
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_soil_allocate_images(mor_context *context, mor_soil *soil);

/** Builds the lists of the particles.
 *  @param position [in]   shape [n_particles, 3], unit m
 *  @param reach    [in]   of the lists, unit m
 *  @param points   [out]  the particles as lists see them
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_soil_build_inner(mor_context *context, mor_soil *soil, const double *position, double reach,
                                mor_relation_points *points);

/** Gives images the records of their owners, and what the momentum loop reads beside them. */
void mor_soil_follow_records(mor_context *context, const mor_soil *soil);

/* Found late in a step, when the records of forces are not needed any more. */
#define MOR_SOIL_LATE                                                                                                  \
    (MOR_BIT(MOR_FIELD_VELOCITY_GRADIENT) | MOR_BIT(MOR_FIELD_HOURGLASS_RATE) | MOR_BIT(MOR_FIELD_MOMENTS))

/** Returns whether other data lie where records of forces are while these are not needed. */
static inline bool mor_soil_shares(const mor_soil *soil)
{
    return soil->settings.shares_memory && soil->extra != NULL;
}

/** Has them there, whenever the records of forces have moved: what is found late, and the ranges of displacements,
 *  which the neighbor search needs before the records are packed. */
static inline void mor_soil_place_late(mor_context *context, mor_soil *soil)
{
    if (mor_soil_shares(soil)) {
        mor_set_place(context, &soil->set, MOR_SOIL_LATE, soil->extra);
        soil->list_places.ranges = soil->boundary_places.ranges = soil->extra;
    }
}

/** What all pair loops need, without fields; borrowed until the next resize or permute.
 *  @param lists [in]  MOR_RESOURCE_LISTS or MOR_RESOURCE_SHORT_LISTS, which the loop reads */
mor_pair_arrays mor_soil_pair_arrays(const mor_soil *soil, mor_view *view, int lists);

/** Number of the region that each particle is of, shape [n_particles], unit 1; NULL: one region. Needs the material
 *  state declared. */
static inline const double *mor_soil_read_region(const mor_soil *soil, mor_view *view)
{
    return soil->region_field >= 0 ? mor_view_read(view, soil->region_field) : NULL;
}

/** Runs a pair loop over all clusters.
 *  @param loop      [in]      which */
void mor_soil_run_pairs(mor_context *context, const mor_pair_constants *constants, const mor_pair_arrays *arrays,
                        mor_pair_loop loop);

/** What energies are found from; NULL what the stage does not declare. */
typedef struct mor_soil_powers {
    mor_soil *soil;
    const mor_step *step;
    double *records;                              /* shape [n padded to 8, 16]; units of MOR_RECORD_... */
    const double *mass;                           /* shape [n], kg (kg/m) */
    const double *density;                        /* shape [n], kg/m3 */
    const double *velocity;                       /* shape [n, 3], m/s */
    const double *acceleration;                   /* shape [n, 3], m/s2 */
    const double *velocity_gradient;              /* shape [n, 9], 1/s */
    const double *stress;                         /* shape [n, 6], Pa */
    const double *stress_diffusion;               /* shape [n, 6], Pa/s; NULL without */
    const double *state[MOR_MATERIAL_STATES_MAX]; /* state variables of the material */
    const double *region;                         /* shape [n], number of the region, 1; NULL: one region */
} mor_soil_powers;

/** Finds the stored energy of stresses of the particles [first, first + n) by the material.
 *  @param job    [in]   soil, density and state are read
 *  @param stress [in]   shape [n, 6], unit Pa
 *  @param stored [out]  shape [n], unit J/m3; not a number when the material has no energy operation */
void mor_soil_find_stored(const mor_soil_powers *job, int64_t first, int64_t n, const double *stress, double *stored);

/** Adds the powers of all particles, block by block, to those of the present sample of the audit.
 *  @param job     [in,out]  of a soil with an audit
 *  @param block   [in]      finds those of a block, shape [MOR_SOIL_ENERGY_PARTS], unit W (W/m); job is its first
 *                           argument */
void mor_soil_energy_add(mor_context *context, mor_soil_powers *job, mor_reduce_block block);

/** What the audit asks of a boundary, mor_soil_contact_audit_... */
typedef void (*mor_soil_boundary_audit)(mor_context *context, const mor_soil_contact *contact,
                                        const mor_contact_audit *audit);

/** Fills the scratch of the audit with the powers of all boundaries, shape [n, MOR_CONTACT_POWERS].
 *  @param job   [in]  of a soil with an audit
 *  @param audit [in]  what to ask of each */
void mor_soil_audit_boundaries(mor_context *context, const mor_soil_powers *job, mor_soil_boundary_audit audit);

/** Whether there is an audit and a step is one of its samples. */
bool mor_soil_energy_is_due(const mor_soil *soil, const mor_step *step);

/** Lists what the audit carries from step to step; nothing without one. */
mor_status mor_soil_list_energy(mor_context *context, mor_soil *soil, mor_state_list *list);

/** Frees the audit of a soil; accepts a soil without. */
void mor_soil_clear_energy(mor_context *context, mor_soil *soil);

/** Returns stress : velocity gradient, unit W/m3.
 *  @param stress   [in]  shape [6], unit Pa
 *  @param gradient [in]  shape [3,3], unit 1/s */
double mor_soil_stress_power(const double *stress, const double *gradient);

/** What a resumed run needs of the soil, what follows from it; owner is one mor_soil. See mor_stepper_operations. */
mor_status mor_soil_list_state(mor_context *context, void *owner, mor_state_list *list);
mor_status mor_soil_resume(mor_context *context, void *owner);

#endif
