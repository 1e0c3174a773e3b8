/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PROBE_PROBE_MEASURE_H
#define MOR_CASES_DRIVER_PROBE_PROBE_MEASURE_H

#include "cases/driver/probe/probe.h"
#include "core/sph/measure/measure.h"
#include "core/sph/measure/measure_path.h"

/** @file
 *  What the files of probes share among themselves. Not for others. */

struct mor_probe_measure;

/** Some of the particles, gathered: those of one soil, or those that one probe measures. */
typedef struct mor_probe_part {
    bool is_current;                              /* of this measurement */
    int64_t n;                                    /* particles */
    double *position, *velocity, *mass, *density; /* room for all particles; owned; m, m/s, kg (kg/m), kg/m3 */
    int64_t *index;                               /* likewise; in the set */
} mor_probe_part;

/** What the probes of one measurement share, so that it is found once, and their scratch. Owner: the track. */
typedef struct mor_probe_scan {
    bool has_energies;  /* energies are of this measurement */
    double energies[3]; /* of soil and bodies: kinetic, potential, elastic; J (J/m) */
    bool has_soil_kinetic;
    double soil_kinetic; /* J (J/m) */
    bool has_profile;
    mor_measure_frame profile_frame;               /* that the profile was made in */
    int profile_part;                              /* `part` of the view that it was made of */
    mor_measure_profile profile;                   /* owned */
    mor_measure_order orders[MOR_CASE_PROBES_MAX]; /* of the percentile of each probe; owned */
    mor_probe_part parts[MOR_CASE_SOILS_MAX];      /* of the soils that probes name; owned */
    mor_probe_part own[MOR_CASE_PROBES_MAX];       /* of probes with a region or a path; owned */
    mor_measure_path paths[MOR_CASE_PROBES_MAX];   /* in the placed frame; no points: none; owned */
} mor_probe_scan;

/** Everything a measurement may need, in the placed frame. */
typedef struct mor_probe_view {
    const mor_simulation *simulation;
    const mor_case_probe *probe;
    const struct mor_probe_measure *measure;
    mor_probe_scan *scan;
    const double *past;              /* shape [MOR_PROBE_RECORD_NUMBERS]; of what `past` of the measure gives */
    const mor_simulation_body *body; /* NULL: of none */
    int wall;                        /* number in the case; -1: of none */
    int number;                      /* of the probe in the case */
    int soil;                        /* number of the soil region that it measures; -1: all */
    int part;                     /* that points are: -1: all; a soil region; behind those, the own part of the probe */
    const int64_t *index;         /* shape [points.n_points]; of the points in the set; NULL: as they are */
    const mor_measure_path *path; /* NULL: none. Points then stand in its frame: along, beside, height */
    const double *memory;         /* shape of what `remember` of the measure keeps; NULL: nothing */
    const double *velocity;       /* shape [points.n_points, 3], m/s */
    mor_measure_points points;    /* of the soil */
    mor_measure_frame frame;
} mor_probe_view;

/** What a sub-step of some bodies did to a probe of contact. */
typedef enum mor_probe_contact {
    MOR_PROBE_CONTACT_NONE, /* nothing: it is about others */
    MOR_PROBE_CONTACT_NEW,  /* it has a new value */
    MOR_PROBE_CONTACT_LATE  /* a new value, in which the part of others is that of their last sub-step */
} mor_probe_contact;

/** What a measurement costs that looks at all particles. Those that are shared are made once for all probes of a case;
 *  times are those of one core of a common processor, for the choice of an interval alone. */
typedef enum mor_probe_cost {
    MOR_PROBE_COST_NONE,       /* next to nothing, or little beside the step of what it looks at */
    MOR_PROBE_COST_ENERGIES,   /* energies of everything, shared */
    MOR_PROBE_COST_KINETIC,    /* of the soil, shared */
    MOR_PROBE_COST_PROFILE,    /* thickness of the deposit, shared */
    MOR_PROBE_COST_STRESS,     /* of a column */
    MOR_PROBE_COST_SUM,        /* over all particles */
    MOR_PROBE_COST_PERCENTILE, /* of all particles */
    MOR_PROBE_COST_DISTANCE,   /* of all particles from a shape */
    MOR_PROBE_COST_BODIES,     /* of all particles from each body */
    MOR_PROBE_COSTS
} mor_probe_cost;

/** One type of probe: what a case may say of it, and how it is measured. A table ends with run NULL. */
typedef struct mor_probe_measure {
    mor_case_probe_type type; /* first: a case points at it */
    /** Writes the value, one number, in the unit of the type. */
    mor_status (*run)(mor_context *context, const mor_probe_view *view, double *value);
    /** Writes what is recorded over the whole run so that `run` can look back, one number, any unit; NULL: nothing.
     *  Goes with the trait MOR_CASE_PROBE_OF_PAST. */
    mor_status (*past)(mor_context *context, const mor_probe_view *view, double *value);
    /** Returns how many doubles `remember` keeps from the start of the run on; NULL: nothing. */
    int64_t (*count)(const mor_probe_view *view);
    /** Updates what is kept, shape [count], mixed units, in each step; is_start: at the start of the run, when what is
     *  there has no meaning and the points of the view are those that the probe measures; else they are all. Goes
     *  with the trait MOR_CASE_PROBE_OF_PAST. */
    void (*remember)(const mor_probe_view *view, bool is_start, double *memory);
    /** Of contact, NULL for others: writes the value after a sub-step of the steppers with the bits of members, and the
     *  part of it that they gave, both in the unit of the type. */
    mor_probe_contact (*contact)(const mor_probe_view *view, uint64_t members, double *whole, double *part);
    /** Updates what is kept, shape [count], mixed units, for a particle of soil that leaves now; NULL: nothing. */
    void (*leave)(const mor_probe_view *view, int64_t particle, double *memory);
    /** Returns what is integrated in place of the value, for mean and impulse, in the unit of the type; NaN: there is
     *  none yet; NULL: the value. For forces of a step that `run` filters. */
    double (*integrand)(const mor_probe_view *view);
    size_t offset; /* of what `run` gives in what it reads, bytes; for measures that share a `run` */
    mor_probe_cost cost;
} mor_probe_measure;

/** Probes of bodies and contact. */
extern const mor_probe_measure mor_probe_body_measures[];

/** Probes of the soil at a place. */
extern const mor_probe_measure mor_probe_local_measures[];

/** Probes of how dense the soil is. */
extern const mor_probe_measure mor_probe_density_measures[];

/** Probes of the soil at walls. */
extern const mor_probe_measure mor_probe_wall_measures[];

/** Probes of volumes, of what passes a plane, and of how far soil has come. */
extern const mor_probe_measure mor_probe_flow_measures[];

/** Probes of how far a slide reaches. */
extern const mor_probe_measure mor_probe_reach_measures[];

/** Probes of the boulders in a flow. */
extern const mor_probe_measure mor_probe_boulder_measures[];

/** Probes that read gauges. */
extern const mor_probe_measure mor_probe_gauge_measures[];

/** Probes of where energy goes. */
extern const mor_probe_measure mor_probe_energy_measures[];

/** What mor_probe_energy_given tells, of a probe of type energy_balance.
 *  @param v     [in]   of the probe
 *  @param share [out]  one number, unit 1
 *  @param by    [out]  one static text
 *  Returns: as mor_probe_evaluate. */
mor_status mor_probe_energy_find_given(mor_context *context, const mor_probe_view *v, double *share, const char **by);

/** Makes the scratch of a simulation's probes.
 *  @param scan       [out]     one pointer; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_probe_scan_new(mor_context *context, const mor_simulation *simulation, mor_probe_scan **scan);

/** Frees a scratch; accepts NULL.
 *  @param scan    [in,out]  one pointer; NULL afterwards */
void mor_probe_scan_free(mor_context *context, mor_probe_scan **scan);

/** Forgets what was found for the measurement before. */
void mor_probe_scan_begin(mor_probe_scan *scan);

/** Returns the number of the soil region that a probe measures; -1: all.
 *  @param probe [in]  index of the probe in the case */
int mor_probe_find_soil(const mor_case *the_case, int probe);

/** Restricts a view of one soil, of a region or along a path to its particles, which are gathered once for each
 *  measurement. */
void mor_probe_scan_part(mor_probe_view *view);

/** Whether a place lies in the region of a probe; anywhere without one.
 *  @param place [in]  shape [3]; placed frame, unit m */
bool mor_probe_is_inside(const mor_probe_view *view, const double *place);

/** Where a point of a view would be in a domain without periodic faces; its place where there are none.
 *  @param point [in]   index among the points of the view
 *  @param place [out]  shape [3]; placed frame, of a view on a path that of the path, unit m */
void mor_probe_find_place(const mor_probe_view *view, int64_t point, double *place);

/** The center of mass of the points of a view, each where mor_probe_find_place has it.
 *  @param center [out]  shape [3]; as mor_probe_find_place; NaN without points */
void mor_probe_find_center(const mor_probe_view *view, double *center);

/** Prepares the measurement of a probe.
 *  @param probe      [in]   index of the probe in the case */
void mor_probe_view_set(const mor_simulation *simulation, int probe, mor_probe_view *view);

/** Measures a probe; what was found since mor_probe_scan_begin is not found again.
 *  @param value   [out]     one number, in the unit of the probe; NaN where there is nothing to measure
 *  Returns: MOR_OK; what the measurement returns, with the place of the probe. */
mor_status mor_probe_view_measure(mor_context *context, const mor_probe_view *view, double *value);

/** Returns kinetic, potential and elastic energy of soil and bodies, shape [3], unit J (J/m in plane strain). */
const double *mor_probe_energies(const mor_context *context, const mor_probe_view *view);

/** Returns their sum, unit J (J/m in plane strain). */
double mor_probe_total_energy(const mor_context *context, const mor_probe_view *view);

/** Returns the energy of the soil that has left the domain and of the bodies that were removed in this run, about the
 *  origin of mor_probe_energies, unit J (J/m in plane strain). */
double mor_probe_energy_gone(const mor_simulation *s);

#endif
