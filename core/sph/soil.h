/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_SOIL_H
#define MOR_CORE_SPH_SOIL_H

#include "core/base/reduce.h"
#include "core/material/composite.h"
#include "core/material/kit/material.h"
#include "core/particle/images.h"
#include "core/particle/set.h"
#include "core/sph/boundary/soil_contact.h"
#include "core/sph/lanes/soil_lanes.h"
#include "core/sph/pair/pair_single.h"
#include "core/sph/settings/soil_settings.h"
#include "core/sph/sleep/hold.h"
#include "core/sph/soil_energy.h"
#include "core/time/stepper.h"

/** @file
 *  Fine grains: updated-Lagrangian Riemann SPH of one particle set, with walls and rocks. The set is of one soil, or of
 *  several behind a composite material, core/material/composite.h. One step is the list of stages in soil.c; time
 *  belongs to the schedule.
 *  Theory: Zhang et al. (2024) eqs. 13-35, 51, 54-56; docs/theory/soil.md. */

enum { MOR_SOIL_WALLS_MAX = 64, MOR_SOIL_BOUNDARIES_MAX = 16 };

/** What has left the domain since the start. */
enum {
    MOR_SOIL_OUTFLOW_MASS = 0,     /* kg (kg/m) */
    MOR_SOIL_OUTFLOW_MOMENTUM = 1, /* shape [3], kg m/s (kg/s) */
    MOR_SOIL_OUTFLOW_MOMENT = 4,   /* mass times place, shape [3], kg m (kg) */
    MOR_SOIL_OUTFLOW_KINETIC = 7,  /* J (J/m) */
    MOR_SOIL_OUTFLOW_ELASTIC = 8,  /* J (J/m); NaN when the material has no energy operation */
    MOR_SOIL_OUTFLOW_STATE = 9
};

/** The stress update that stopped a step. */
typedef struct mor_soil_failure {
    bool is_known;                             /* there was one */
    int64_t particle;                          /* number of the particle */
    uint64_t step;                             /* number of the step */
    double time, time_step;                    /* at the end of the step, and its length, s */
    double density;                            /* kg/m3 */
    double stress[6];                          /* shape [6]; at the start, Pa */
    double velocity_gradient[9];               /* shape [3,3]; 1/s */
    double extra_stress_rate[6];               /* shape [6]; Pa/s */
    double state[9 * MOR_MATERIAL_STATES_MAX]; /* shape [n_values]; at the start; units of the law's schema */
} mor_soil_failure;

/** Looks at the forces of the soil on each boundary right after they have been summed; the results do not depend on
 *  whether anybody does. */
typedef struct mor_soil_watch {
    void *owner;
    /** Looks at one boundary; records: shape [n_particles padded to 8, 16]; units of MOR_RECORD_...; NULL: nobody
     *  looks. */
    void (*run)(mor_context *context, void *owner, const mor_soil_contact *contact, const double *records,
                int64_t n_particles);
    void (*leave)(void *owner, int64_t particle); /* one by one, at the end of its last step */
} mor_soil_watch;

/** One soil. Owner: the run. */
typedef struct mor_soil {
    mor_soil_settings settings;
    mor_set set;
    const mor_material_instance *material;        /* borrowed; outlives the soil */
    int state_fields[MOR_MATERIAL_STATES_MAX];    /* indices of the material's state variables in the set */
    int region_field;                             /* index of the number of the region in the set; -1: one region */
    mor_soil_kind kinds[MOR_COMPOSITE_PARTS_MAX]; /* shape [n_kinds]; in the order of the composite's parts */
    int n_kinds;
    bool keeps_gaps;                                   /* between some soil and boundaries that let it go */
    double across[MOR_COMPOSITE_PARTS_MAX];            /* shape [n_kinds]; mor_soil_kind_find_across, 1 */
    mor_pair_soil pair_soils[MOR_COMPOSITE_PARTS_MAX]; /* shape [n_kinds] */
    int kind_fields[MOR_COMPOSITE_PARTS_MAX]; /* shape [n_kinds]; state variable that is the field of a soil, or -1 */
    int diffusing[MOR_COMPOSITE_PARTS_MAX];   /* shape [n_diffusing]; state variables that are fields */
    int n_diffusing;
    const mor_pair_table *table;
    const mor_soil_lanes *lanes;
    mor_pair_constants constants;
    double *records;        /* shape [n_particles padded to 8, 16]; units of MOR_RECORD_... */
    double *of_soil;        /* shape [n_particles padded to 8, MOR_PAIR_OF_SOIL_SIZE], units of the enum; or NULL */
    int8_t *one_soil;       /* shape [clusters]; the one soil that a cluster sees, or -1; NULL: one soil */
    double *regularization; /* shape [n_particles, 6]; XSPH velocity [m/s] and shift sum [1]; or NULL */
    double *closed;         /* shape [n_particles, 6]; with what boundaries close of them, 1; NULL where that is needed
                             * beside boundaries alone */
    mor_wall_clusters wall_clusters; /* of the particles beside boundaries */
    double *extra;                   /* shape [n_particles padded to 8, 16]; units of MOR_EXTRA_...; or NULL */
    int extra_width;                 /* numbers of a particle for which it has room; 0 without, else at least 16 */
    mor_pair_singles singles;        /* copies of what the pair loops read, with mixed precision; or zeroed */
    double *field_records; /* shape [n_particles padded to 8, MOR_PAIR_FIELD_SIZE]; units of the enum; or NULL */
    double *diffusion;     /* shape [n_particles padded to 8, MOR_PAIR_DIFFUSION_SIZE]; units of the enum; or NULL */
    double *density_sums;  /* shape [n_particles]; densities by summation, kg/m3; or NULL */
    mor_reduce_room room;  /* of reductions over particles */
    mor_sleep sleep;       /* soil at rest that is left out of steps */
    mor_hold hold;         /* soil that is not released */
    bool is_settling;      /* the initial stress settles: all soil is released, whatever is to be held later */
    mor_sleep_box *moving; /* shape [n_moving_room]; scratch, boxes of what moves beside it; NULL without */
    int n_moving_room;
    int32_t *order;          /* shape [n_particles]; scratch of the sort */
    mor_soil_energy *energy; /* the audit; NULL: none */
    mor_tree tree;
    mor_relation inner;
    mor_period period;     /* of the domain */
    mor_images images;     /* of the particles; of no period: zeroed */
    int64_t image_room;    /* images that the records and the next two have room for */
    double *image_stress;  /* shape [n + image_room padded to 8, 6]; artificial stress with images, Pa; or NULL */
    double *image_strains; /* shape [n + image_room padded to 8, 6]; last strain rate with images, 1/s; or NULL */
    mor_soil_contact walls[MOR_SOIL_WALLS_MAX];
    int n_walls;
    mor_soil_contact boundaries[MOR_SOIL_BOUNDARIES_MAX]; /* moved by others */
    int n_boundaries;
    mor_soil_watch watch;            /* of these and of what leaves; the owner is borrowed */
    double sound_speed;              /* c0, m/s; the largest of several soils */
    double smoothing_length;         /* h, m */
    double lattice_moment;           /* moment of the kernel gradient on it, 1 */
    double lattice_sum;              /* sum V W on the perfect lattice, 1 */
    double largest_speed;            /* after the last kick, m/s */
    double largest_acceleration;     /* in the last step, m/s2 */
    bool is_relaxing;                /* it is brought to rest: what moves is no flow */
    mor_skin_places list_places;     /* of particles when the lists of particles were built */
    mor_skin_places boundary_places; /* when those of walls and rocks were; with a tree of its own */
    mor_tree boundary_tree;          /* of the particles then */
    double *ranges;    /* shape [2 * clusters - 1, 6]; scratch, see core/particle/skin.h, m; NULL: in extra */
    bool has_outflow;  /* in this step, whose end removes them */
    int64_t n_outflow; /* particles that have left the domain since the start */
    double outflow[MOR_SOIL_OUTFLOW_STATE];     /* of those, units of the enum above */
    bool has_lists;                             /* lists exist and belong to the present order */
    bool has_boundary_lists;                    /* likewise those of walls and rocks */
    mor_soil_failure failure;                   /* what a step failed at, for a report */
    double gravity[3];                          /* in the last step, with the ramp, m/s2 */
    double wall_force[MOR_SOIL_WALLS_MAX][3];   /* of the soil on each wall in the last step, N (N/m in plane strain) */
    double wall_impulse[MOR_SOIL_WALLS_MAX][3]; /* of the soil on each wall since the start, N s */
} mor_soil;

/** Makes a soil from particles whose position, velocity, mass, density, stress are then set by the caller through
 *  soil->set, before mor_soil_init_state.
 *  @param name        [in]      zero-terminated
 *  @param settings    [in]      copied
 *  @param material    [in]      rate form; borrowed
 *  @param n_particles [in]      number of particles, >= 1
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_MEMORY. */
mor_status mor_soil_init(mor_context *context, mor_soil *soil, const char *name, const mor_soil_settings *settings,
                         const mor_material_instance *material, int64_t n_particles);

/** Frees what the soil owns; accepts a zeroed one. */
void mor_soil_clear(mor_context *context, mor_soil *soil);

/** Adds a wall.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when there are too many, or for a wall with a source that rotates beside soil
 *  that may sleep or is released later; MOR_ERROR_MEMORY. */
mor_status mor_soil_add_wall(mor_context *context, mor_soil *soil, const mor_wall_request *request);

/** Fills the walls that hold particles where soil is near alone, and forgets where all of them would be, as the lists
 *  fill them later, when soil comes near. To be called when all is checked that asks for all particles of walls.
 *  Returns: MOR_OK; as mor_soil_contact_fill. */
mor_status mor_soil_fill_walls(mor_context *context, mor_soil *soil);

/** Adds a boundary that is moved by another solver; core/particle/boundary.h says what is read and written when.
 *  @param boundary [in,out]  borrowed, outlives the soil's steps; its points are in place
 *  @param stress   [in]      stress that a soil particle sees in it
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when there are too many, or for patches that overlap or leave gaps;
 *  MOR_ERROR_MEMORY. */
mor_status mor_soil_add_boundary(mor_context *context, mor_soil *soil, mor_boundary *boundary, mor_wall_stress stress);

/** Sets the barrier between the soil and a boundary, which is off at first.
 *  @param soil     [in,out]  before its first step
 *  @param boundary [in]      added before
 *  @param barrier  [in]      copied
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a stiffness or radius out of range, or a boundary that was not added. */
mor_status mor_soil_set_barrier(mor_context *context, mor_soil *soil, const mor_boundary *boundary,
                                const mor_soil_barrier *barrier);

/** Has lists built in the next step: particles are others, or somewhere else, or in another order. */
static inline void mor_soil_forget_lists(mor_soil *soil)
{
    soil->has_lists = false;
    soil->has_boundary_lists = false;
}

/** Returns the reference density of a particle's soil, unit kg/m3.
 *  @param particle [in]  index in the set */
static inline double mor_soil_reference_density(const mor_soil *soil, int64_t particle)
{
    return soil->kinds[soil->of_soil != NULL ? (int)soil->set.data[soil->state_fields[0]][particle] : 0]
        .reference_density;
}

/** Returns the speed of waves that the scheme assumes in a particle's soil, that without stress, unit m/s.
 *  @param particle [in]  index in the set */
static inline double mor_soil_sound_speed(const mor_soil *soil, int64_t particle)
{
    return soil->kinds[soil->of_soil != NULL ? (int)soil->set.data[soil->state_fields[0]][particle] : 0].sound_speed;
}

/** Initializes the material's state for the present density and stress (a resume restores it instead).
 *  Returns: MOR_OK; what the material returns. */
mor_status mor_soil_init_state(mor_context *context, mor_soil *soil);

/** Sorts the particles into clusters. To be called once when positions have been set, not after a resume.
 *  Gives: a new generation of the set; the lists are rebuilt in the next step. */
void mor_soil_sort(mor_context *context, mor_soil *soil);

/** Divides kernel sums, and kernel gradients where the scheme asks for it, by their means over the particles that soil
 *  surrounds in place of those of the lattice, for particles that stand on none. After mor_soil_sort, also before a
 *  resume: what it finds is that of the start. Where soil surrounds no particle the numbers stay those of the lattice.
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_soil_normalize(mor_context *context, mor_soil *soil);

/** Updates everything that depends on the number of particles of the set, which a restored state may have changed.
 *  @param soil [in,out]  set.n_particles is at most set.n_created
 *  Gives: the lists are rebuilt in the next step. */
void mor_soil_fit(mor_soil *soil);

/** Finds where a particle would be had periodic faces not put it back.
 *  @param particle [in]   index in the set
 *  @param place    [out]  shape [3], unit m */
void mor_soil_find_unwrapped(const mor_soil *soil, int64_t particle, double *place);

/** Checks that no rock comes so near to a periodic face that soil beyond it would see it: rocks have no images. Lists
 *  see soil beyond a face, too, where the first particle of its cluster is before it.
 *  @param is_start [in]  there are no lists yet, and the case is to be refused, not the run to be stopped
 *  @param time     [in]  for the message, unit s
 *  Returns: MOR_OK; MOR_ERROR_CONFIG at the start, MOR_ERROR_NUMERIC later. */
mor_status mor_soil_check_images(mor_context *context, const mor_soil *soil, bool is_start, double time);

/** Finds the energy of what has left the domain, each particle as it was when it left: kinetic, potential, elastic.
 *  @param datum    [in]   shape [3]; potential energy counts from here, unit m
 *  @param energies [out]  shape [3], unit J (J/m in plane strain) */
void mor_soil_outflow_energies(const mor_soil *soil, const double *datum, double *energies);

/** Returns the soil as a stepper: its stages and step limit.
 *  @param soil     [in]   becomes the owner
 *  @param evolving [out]  one number; bits valid at the start of a step */
void mor_soil_stepper(mor_soil *soil, mor_stepper *stepper, uint64_t *evolving);

/** Returns the share of particle-steps that were left out because soil slept, 1; of the particles there are now.
 *  @param n_steps [in]  steps since the start */
static inline double mor_soil_slept_share(const mor_soil *soil, uint64_t n_steps)
{
    const double n = (double)n_steps * (double)soil->set.n_particles;
    return n > 0.0 ? (double)soil->sleep.n_left_out / n : 0.0;
}

/** Returns the instruction set of the loops over pairs for people, in mixed precision with how wide registers are.
 *  Returns: a static text. */
static inline const char *mor_soil_registers(const mor_soil *soil)
{
    const mor_pair_table *table = mor_pair_select(NULL);
    return soil->settings.scheme.precision == 1 ? table->registers : table->instruction_set;
}

/** Returns the bytes held for fine particles alone, lists included, walls not, per particle.
 *  Returns: bytes per particle, 1. */
double mor_soil_bytes_per_particle(const mor_soil *soil);

#endif
