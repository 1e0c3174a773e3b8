/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_GAUGE_GAUGE_H
#define MOR_CASES_DRIVER_GAUGE_GAUGE_H

#include "cases/driver/case/case.h"
#include "cases/driver/gauge/signal_filter.h"
#include "core/particle/state.h"

/** @file
 *  Gauges: force, moment and height of action on a structure or a part of it, by the soil and by bodies, in each step.
 *  Boundary forces of the soil count where the line from the particle along the normal meets the structure's surface;
 *  forces of contact where the surfaces touch. Those of contact are means over a step, that is impulse over length,
 *  for bodies take several sub-steps. What is remembered is state, which a checkpoint saves. */

struct mor_simulation;
struct mor_soil_contact;

/** Who loads a structure. */
typedef enum mor_gauge_source {
    MOR_GAUGE_SOIL,
    MOR_GAUGE_BODIES, /* contact with other bodies; of a body not that with walls */
    MOR_GAUGE_SOURCES
} mor_gauge_source;

/** Numbers of a load, in the placed frame. */
enum {
    MOR_GAUGE_FORCE = 0,  /* 3; N (N/m in plane strain) */
    MOR_GAUGE_MOMENT = 3, /* 3; about the gauge's origin, N m (N) */
    MOR_GAUGE_RAISED = 6, /* normal force times its height over the origin, N m (N) */
    MOR_GAUGE_LOADS = 7,
    MOR_GAUGE_SIGNALS = MOR_GAUGE_LOADS * MOR_GAUGE_SOURCES /* the soil's, then the bodies' */
};

/** Largest values so far, and what was at the same time. NaN: there was no step yet. */
enum {
    MOR_GAUGE_PEAK_NORMAL,      /* of the filtered normal force, N */
    MOR_GAUGE_PEAK_TIME,        /* when it was, s */
    MOR_GAUGE_PEAK_SOIL,        /* the soil's share of it, N */
    MOR_GAUGE_PEAK_BODIES,      /* the bodies' share of it, N */
    MOR_GAUGE_PEAK_HEIGHT,      /* height of action then, m */
    MOR_GAUGE_PEAK_SHEAR,       /* of the filtered shear force, N */
    MOR_GAUGE_PEAK_SHEAR_TIME,  /* s */
    MOR_GAUGE_PEAK_MOMENT,      /* of the filtered overturning moment, the largest to either side, N m */
    MOR_GAUGE_PEAK_MOMENT_TIME, /* s */
    MOR_GAUGE_PEAK_SINGLE,      /* of the normal force of single steps, N */
    MOR_GAUGE_PEAK_SINGLE_TIME, /* s */
    MOR_GAUGE_PEAKS
};

/** What evolves beside the filter. */
enum {
    MOR_GAUGE_NOW = 0,                                       /* loads of the last step */
    MOR_GAUGE_CONTACT = MOR_GAUGE_NOW + MOR_GAUGE_SIGNALS,   /* impulses of contact in this step so far, N s */
    MOR_GAUGE_SUM = MOR_GAUGE_CONTACT + MOR_GAUGE_LOADS,     /* integrals of loads since the start, N s */
    MOR_GAUGE_ROW = MOR_GAUGE_SUM + MOR_GAUGE_SIGNALS,       /* those at the last row of its table */
    MOR_GAUGE_FILTERED = MOR_GAUGE_ROW + MOR_GAUGE_SIGNALS,  /* filtered loads */
    MOR_GAUGE_PEAK = MOR_GAUGE_FILTERED + MOR_GAUGE_SIGNALS, /* the peaks above */
    MOR_GAUGE_ROW_TIME = MOR_GAUGE_PEAK + MOR_GAUGE_PEAKS,   /* of the last row, s */
    MOR_GAUGE_ROW_PEAK,                                      /* largest filtered normal force since, N; or NaN */
    MOR_GAUGE_STEPS,                                         /* taken so far, 1 */
    MOR_GAUGE_NUMBERS
};

/** A map of the pressure on a structure: cells in the plane through the gauge's origin across its direction, that
 *  divide the extent of the structure and its region evenly. */
typedef struct mor_gauge_map {
    int n_across, n_up;      /* cells; in plane strain one across; 0: no map */
    double cell[2];          /* sides of a cell, across and up, m */
    double across[3], up[3]; /* unit vectors in that plane, 1 */
    double start[2];         /* of the first cell from the origin, across and up, m */
    double frame[4];         /* start and cell as a state has them, m */
    double area;             /* of a cell, m2 (m) */
    double *covered;  /* shape [cells]; area of a cell in which the structure lies, seen along the direction as it
                              * stands at first, m2 (m) */
    double least;     /* a cell in which it covers less tells no pressure of soil, m2 (m) */
    double *now;      /* shape [MOR_GAUGE_SOURCES, cells]; normal force in the last step, N; of bodies the impulse
                              * so far in a step, N s */
    double *filtered; /* likewise, filtered, N */
    double *memory;   /* of its filter */
    double *peak;     /* shape [MOR_GAUGE_SOURCES, cells]; largest filtered normal force, N; 0: never pressed */
    double *time;     /* likewise, when that was, s; NaN: never */
} mor_gauge_map;

/** What one gauge measures and remembers. */
typedef struct mor_gauge {
    const mor_case_gauge *asked; /* borrowed from the case */
    int wall, body;              /* number in the case; -1: it is no wall, no body */
    mor_signal_filter filter;
    double origin[3];    /* placed, m */
    double direction[3]; /* placed, 1 */
    double up[3];        /* 1 */
    double axis[3];      /* of overturning, up x direction, 1; zero where direction is vertical, and of a structure that
                          * goes on through a periodic face, whose axis is not that of the period */
    bool has_height;     /* false for such a structure where gravity has a part along the axis of the period */
    double numbers[MOR_GAUGE_NUMBERS];
    double *memory; /* of the filter */
    mor_gauge_map map;
    double *partial; /* scratch of sums over the soil */
    double *sums;    /* shape [MOR_GAUGE_LOADS + cells]; likewise */
} mor_gauge;

/** All gauges of a simulation. Owner: the track of its probes. */
typedef struct mor_gauges {
    struct mor_simulation *simulation; /* borrowed */
    int n;
    mor_gauge *of;         /* shape [n]; owned */
    double contact_length; /* of the sub-step that contact is in, s */
} mor_gauges;

/** Loads as engineers name them. */
typedef struct mor_gauge_reading {
    double normal;                       /* force along direction, N (N/m) */
    double of_source[MOR_GAUGE_SOURCES]; /* its shares, N (N/m) */
    double shear;                        /* length of the rest of the force, N (N/m) */
    double moment; /* about the axis up x direction through the origin: positive overturns, N m (N);
                                         * NaN where the gauge has no axis */
    double height; /* of the normal force's action over the origin, m; NaN without such a force or has_height */
} mor_gauge_reading;

/** Makes the gauges of a case; they look on from then on.
 *  @param simulation [in,out]  whole but for its probes; outlives the gauges
 *  @param gauges     [out]     cleared by the caller, also after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a map of too many cells; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_gauges_init(mor_context *context, struct mor_simulation *simulation, mor_gauges *gauges);

/** Frees what gauges own; accepts zeroed ones. */
void mor_gauges_clear(mor_context *context, mor_gauges *gauges);

/** Forgets everything: a run begins. */
void mor_gauges_start(mor_gauges *gauges);

/** Lists what gauges remember.
 *  Returns: as mor_state_add. */
mor_status mor_gauges_list_state(mor_context *context, mor_gauges *gauges, mor_state_list *list);

/** Says whether a state that was put back belongs to these gauges.
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line where the cells of a map lie elsewhere. */
mor_status mor_gauges_resume(mor_context *context, const mor_gauges *gauges);

/** Takes up the forces of the soil on a boundary, as mor_soil_watch shows them.
 *  @param contact [in]  the boundary, with the forces of this step
 *  @param records [in]  shape [n_particles padded to 8, 16]; units of MOR_RECORD_... */
void mor_gauges_watch_soil(mor_context *context, mor_gauges *gauges, const struct mor_soil_contact *contact,
                           const double *records, int64_t n_particles);

/** Takes up what happened in a step. To be called once after each. */
void mor_gauges_follow(mor_gauges *gauges);

/** Turns loads into a reading.
 *  @param loads [in]  shape [MOR_GAUGE_SIGNALS]; units of the enum */
void mor_gauge_read(const mor_gauge *gauge, const double *loads, mor_gauge_reading *reading);

/** Reads the means over the time since the last row, and begins a new row.
 *  @param time     [in]   now, s
 *  @param largest  [out]  one number; largest filtered normal force since, N; NaN without a step
 *  Gives: a reading of NaN where no time has passed. */
void mor_gauge_take_row(mor_gauge *gauge, double time, mor_gauge_reading *reading, double *largest);

enum { MOR_GAUGE_FILTER_BYTES = 64 };

/** How a gauge filters, in words: "running mean over 0.25 s".
 *  @param text [out]  shape [MOR_GAUGE_FILTER_BYTES]; zero-terminated */
void mor_gauge_describe_filter(const mor_case_gauge *asked, char *text);

/** Distance of a point from the surface of the structure of a gauge, m; negative inside. A body that deforms counts as
 *  rigid here.
 *  @param point [in]  shape [3], placed, m */
double mor_gauge_structure_distance(const struct mor_simulation *simulation, const mor_gauge *gauge,
                                    const double *point);

/** Distance of a point from what a gauge measures, structure and region, m; negative inside both.
 *  @param point [in]  shape [3], placed, m */
double mor_gauge_distance(const struct mor_simulation *simulation, const mor_gauge *gauge, const double *point);

/** Adds a force to the map of a gauge, spread evenly over a square of a side.
 *  @param place [in]      shape [3], placed, m
 *  @param side  [in]      of that square, m; 0: all of it in one cell
 *  @param force [in]      normal, any unit
 *  @param cells [in,out]  shape [cells]; same unit; what lies beyond the edges counts in the cells there */
void mor_gauge_map_add(const mor_gauge *gauge, const double *place, double side, double force, double *cells);

/** Pressure of soil on the structure in a cell, Pa; NaN where there is too little of the structure to tell it.
 *  @param cell  [in]  number, across fastest
 *  @param force [in]  normal, of the soil, N (N/m) */
double mor_gauge_map_pressure(const mor_gauge_map *map, int64_t cell, double force);

/** Writes the middle of a cell.
 *  @param cell  [in]   number, across fastest
 *  @param plane [out]  shape [2]; across and up from the origin, m */
void mor_gauge_map_place(const mor_gauge_map *map, int64_t cell, double *plane);

/** Makes the map of a gauge that asks for one; used by mor_gauges_init.
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for too many cells; MOR_ERROR_MEMORY. */
mor_status mor_gauge_map_init(mor_context *context, const struct mor_simulation *simulation, mor_gauge *gauge);

/** Frees what a map owns; accepts a zeroed one. */
void mor_gauge_map_clear(mor_context *context, mor_gauge_map *map);

/** Forgets what a map remembers. */
void mor_gauge_map_start(mor_gauge *gauge);

/** Takes up what the map of a gauge gathered in a step.
 *  @param step [in]  its length, s
 *  @param time [in]  of its end, s */
void mor_gauge_map_follow(mor_gauge *gauge, double step, double time);

/** Number of cells of a map, 0: none. */
static inline int64_t mor_gauge_map_cells(const mor_gauge_map *map)
{
    return (int64_t)map->n_across * map->n_up;
}

#endif
