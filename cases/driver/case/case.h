/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_CASE_H
#define MOR_CASES_DRIVER_CASE_CASE_H

#include "cases/driver/case/case_field.h"
#include "core/geometry/motion.h"
#include "core/geometry/shape.h"
#include "core/material/plugin.h"
#include "core/scheme/scheme.h"

#include <stdbool.h>
#include <stdint.h>

/** @file
 *  A case file after reading: every value in SI, every default filled in, everything multiplied by the case's scale.
 *  Made by case_read.c, written back by case_write.c, consumed by scene/build. Which key goes where: case_schema.c.
 *
 *  Members named `written` have bit k set when the file gave key k of the group's table in case_schema.c; the other
 *  values are defaults. */

enum {
    MOR_CASE_WALL_LAYERS = 4, /* layers of wall particles; they fill the kernel's support */
    MOR_CASE_POLYGON_POINTS_MAX = 4096,
    MOR_CASE_SHAPE_PARTS_MAX = 256,
    MOR_CASE_NAME_BYTES = 64,
    MOR_CASE_TEXT_BYTES = 256,
    MOR_CASE_PARAMETERS_MAX = 32,
    MOR_CASE_SOILS_MAX = 16,
    MOR_CASE_PLUGINS_MAX = 16,
    MOR_CASE_WALLS_MAX = 64,
    MOR_CASE_BODIES_MAX = 4096,
    MOR_CASE_ROCKS_MAX = 8,
    MOR_CASE_ROCK_FORMS_MAX = 16,
    MOR_CASE_ROCK_SHAPES_MAX = 256,
    MOR_CASE_ROCK_SIZES_MAX = 32,
    MOR_CASE_PAIRS_MAX = 64,
    MOR_CASE_PATH_ROWS_MAX = 1024,
    MOR_CASE_EXCAVATIONS_MAX = 32,
    MOR_CASE_PROBES_MAX = 64,
    MOR_CASE_GAUGES_MAX = 64,
    MOR_CASE_PATH_POINTS_MAX = 256,
    MOR_CASE_EXPECTATIONS_MAX = 32
};

/** Where in the file something was written, for messages of later checks. */
typedef struct mor_case_place {
    char file[MOR_CASE_TEXT_BYTES]; /* path as the user gave it */
    int line;                       /* 1-based line */
} mor_case_place;

/** Kinds of shapes, in the order of mor_case_shape_groups. */
typedef enum mor_case_shape_kind {
    MOR_CASE_SHAPE_BOX,
    MOR_CASE_SHAPE_CYLINDER,
    MOR_CASE_SHAPE_CONE,
    MOR_CASE_SHAPE_SPHERE,
    MOR_CASE_SHAPE_ELLIPSOID,
    MOR_CASE_SHAPE_HALF_SPACE,
    MOR_CASE_SHAPE_POLYGON,
    MOR_CASE_SHAPE_UNION,
    MOR_CASE_SHAPE_DIFFERENCE,
    MOR_CASE_SHAPE_TRANSLATE,
    MOR_CASE_SHAPE_ROTATE,
    MOR_CASE_SHAPE_TERRAIN,
    MOR_CASE_SHAPE_RELEASE,
    MOR_CASE_SHAPE_POSTS,
    MOR_CASE_SHAPE_MESH,
    MOR_CASE_SHAPE_OUTLINE,
    MOR_CASE_SHAPE_ROCK,
    MOR_CASE_SHAPE_COUNT
} mor_case_shape_kind;

/** Terrain from an elevation raster, and releases and posts on it. Lengths of the raster are those of its file, which
 *  the scale of the case does not touch. */
typedef struct mor_case_ground {
    char file[MOR_CASE_TEXT_BYTES]; /* path; as given, or absolute where it exists */
    char wall[MOR_CASE_NAME_BYTES]; /* of a release and of posts: the wall that is their ground */
    double crop_minimum[2];         /* m, in the raster's coordinates; -INFINITY: all */
    double crop_maximum[2];         /* likewise; INFINITY: all */
    double cell;                    /* m; NaN: as in the raster */
    double offset[3];               /* subtracted from the raster's coordinates and heights, m; NaN: chosen */
    bool fills_no_data;
    bool extends_edge; /* the ground is extended level beyond the raster, as far as the domain reaches */
    double thickness;  /* of the ground below its lowest point, or of a release, m */
    double rim;        /* of a release, m */
    double size[2];    /* of a post along x and y, m */
    double height;     /* of posts above the ground at their middle, m; NaN: top is given */
    double top;        /* height of the tops of all posts, m; NaN: height is given */
} mor_case_ground;

/** A rock from a file, or generated at random. At most one of the sizes is given; the others are NaN. */
typedef struct mor_case_form {
    char file[MOR_CASE_TEXT_BYTES]; /* path; as given, or absolute where it exists */
    double scale;                   /* of the lengths of the file, 1 */
    double length;                  /* longest side of the box around it, m */
    double volume;                  /* m3 */
    double diameter;                /* of the ball (disc) of the same volume (area), m */
    double elongation, flatness;    /* of a rock generated at random, 1 */
    double angularity, roughness;   /* likewise, 1 */
    uint64_t seed;
} mor_case_form;

/** A shape as the case describes it, kept so that the case can be written back; mor_shape is what it builds. */
typedef struct mor_case_shape {
    mor_case_shape_kind kind;
    bool is_flat;                    /* a box of two components: unbounded in z */
    double first[3];                 /* lowest corner, base, center, point or translation, m */
    double second[3];                /* highest corner [m], axis [1], normal [1] or radii [m] */
    double radius;                   /* m */
    double height;                   /* m */
    double angle;                    /* rad */
    double *points;                  /* shape [n_points,2], m; owned; corners of a polygon, places of posts */
    int n_points;                    /* number of corners */
    mor_case_ground ground;          /* of terrain, release and posts */
    mor_case_form form;              /* of mesh, outline and rock */
    uint64_t file_hash;              /* of the content of its file; 0: it has none */
    struct mor_case_shape *children; /* shape [n_children]; owned; of a difference: from, then what is cut off */
    int n_children;                  /* number of children */
    uint64_t written;                /* see above */
} mor_case_shape;

/** One plug-in: a shared object with models of materials. */
typedef struct mor_case_plugin {
    char file[MOR_CASE_TEXT_BYTES];   /* path; absolute */
    uint64_t file_hash;               /* of its content when it was read */
    char models[MOR_CASE_TEXT_BYTES]; /* names and versions: "undrained_clay 1.0, peat 0.3" */
    mor_plugin *plugin;               /* loaded; owned by the case */
} mor_case_plugin;

/** A law of another program: what its interface is told. */
typedef struct mor_case_external {
    char file[MOR_CASE_TEXT_BYTES]; /* the library; path; absolute */
    uint64_t file_hash;             /* of its content when it was read */
    char law[MOR_CASE_NAME_BYTES];  /* in the library; "": the usual one */
    double *constants;              /* shape [n_constants], unit 1: those of the law; owned */
    int n_constants;
    char states[MOR_MATERIAL_STATES_MAX][MOR_CASE_NAME_BYTES]; /* shape [n_states]; names of its state variables */
    int n_states;
    double *state_start; /* shape [n_state_start], unit 1: those of the law; owned */
    int n_state_start;
    mor_external_law *made; /* owned */
} mor_case_external;

typedef enum mor_case_stress {
    MOR_CASE_STRESS_NONE,
    MOR_CASE_STRESS_K0,
    MOR_CASE_STRESS_SETTLED,
    MOR_CASE_STRESS_UNIFORM,
    MOR_CASE_STRESS_FORMULA
} mor_case_stress;

/** One soil region. */
typedef struct mor_case_soil {
    char name[MOR_CASE_NAME_BYTES];
    mor_case_place place;
    mor_shape *shape;       /* owned by the case; in the scene frame (before the case's placement) */
    mor_case_shape outline; /* what shape was built from; owned by the case */
    char model[MOR_CASE_NAME_BYTES];
    const mor_material *law;                    /* of that name, or made by the interface of that name; borrowed */
    mor_case_external external;                 /* of an interface; else zeroed */
    double density;                             /* initial density, kg/m3 */
    double parameters[MOR_CASE_PARAMETERS_MAX]; /* in the order of the model's parameter schema, SI */
    mor_case_field fields[MOR_CASE_FIELDS_MAX]; /* shape [n_fields]; parameters that vary in space */
    int n_fields;
    double velocity[3]; /* initial velocity, m/s */
    /* Formulas of a place in the frame of the case in m, before the scale; "": none. */
    char velocity_formula[3][MOR_CASE_TEXT_BYTES]; /* initial velocity in place of the above, m/s */
    char stress_formula[6][MOR_CASE_TEXT_BYTES];   /* initial stress: xx, yy, zz, xy, yz, zx; tension positive, Pa */
    double released;                               /* time until which it stands as placed, s; 0: from the start */
    bool is_relaxed;                               /* filled with relaxed particles, else with those of the lattice */
    mor_case_stress initial_stress;
    double pressure;           /* of a uniform initial stress, Pa */
    double lateral_ratio;      /* K0 of the initial stress; < 0: 1 - sin(friction angle) */
    double surface_level;      /* height against gravity of the free surface, m; NaN: top of the region's particles */
    double settle_time;        /* longest settling, s */
    double settle_speed_ratio; /* settled when the 99th-percentile speed is under this times sqrt(|g| * height) */
    int settle_method;         /* a mor_case_settle_method; the chosen one, once the case has been read */
    int settle_from;           /* stress that settling begins with: 0: as k0; 1: none */
    double settle_force_ratio; /* relaxed when unbalanced forces are under this times the weight, in the mean */
    uint64_t written, written_stress, written_material, written_parameters;
} mor_case_soil;

/** How soil is brought to rest before the start. */
typedef enum mor_case_settle_method {
    MOR_CASE_SETTLE_AUTO, /* relaxation where the scheme lets soil rest and no speed ratio is given, else damping */
    MOR_CASE_SETTLE_DAMPING,
    MOR_CASE_SETTLE_RELAXATION
} mor_case_settle_method;

typedef enum mor_case_friction {
    MOR_CASE_FRICTION_ROUGH,
    MOR_CASE_FRICTION_SMOOTH,
    MOR_CASE_FRICTION_COULOMB
} mor_case_friction;

/** Friction of a wall or a body with one soil. */
typedef struct mor_case_soil_friction {
    char soil[MOR_CASE_NAME_BYTES]; /* name of the region */
    mor_case_friction friction;
    double coefficient; /* Coulomb only, 1 */
    uint64_t written;
} mor_case_soil_friction;

/** Soils whose friction is not that with the others. */
typedef struct mor_case_frictions {
    mor_case_soil_friction of[MOR_CASE_SOILS_MAX];
    int n;
} mor_case_frictions;

/** Prescribed motion over time of a wall or a body; the numbers of its file are in rows, too. */
typedef struct mor_case_path {
    mor_case_place place;
    double point[3]; /* of the axis of rotation, frame of the case, m; NaN: the origin, of a
                                     * body its center of mass */
    double axis[3];  /* any length but zero, 1 */
    bool is_smooth;  /* between rows, else linear */
    char file
        [MOR_CASE_TEXT_BYTES]; /* path of a table; as given, or absolute where it exists; "": rows are in the case */
    uint64_t file_hash;        /* of the content of that file; 0: there is none */
    mor_motion_row *rows;      /* shape [n_rows]; owned */
    int n_rows;                /* 0: there is no path */
    uint64_t written;
} mor_case_path;

/** One wall. */
typedef struct mor_case_wall {
    char name[MOR_CASE_NAME_BYTES];
    mor_case_place place;
    mor_shape *shape;       /* the solid; owned by the case */
    mor_case_shape outline; /* what shape was built from; owned by the case */
    mor_case_friction friction;
    double friction_coefficient; /* Coulomb only, 1 */
    mor_case_frictions friction_with;
    double velocity[3];     /* prescribed velocity, m/s */
    mor_case_path path;     /* prescribed in place of it */
    double removed_at;      /* s; NaN: never */
    double contact_modulus; /* Young's modulus of its surface for bodies that touch it; 0: rigid, Pa */
    double contact_poisson; /* Poisson's ratio of it, 1 */
    uint64_t written;
} mor_case_wall;

/** Velocity of a body at the start, beside velocity and angular velocity. */
typedef enum mor_case_motion {
    MOR_CASE_MOTION_UNIFORM,    /* velocity + angular_velocity x arm, nothing more */
    MOR_CASE_MOTION_CANTILEVER, /* first bending mode of a cantilever */
    MOR_CASE_MOTION_TWIST       /* rotation about an axis that grows along it, sin(pi x / (2 length)) */
} mor_case_motion;

/** How a body is filled with particles. */
typedef enum mor_case_particles {
    MOR_CASE_PARTICLES_BY_SHAPE, /* relaxed for a mesh, an outline or a procedural rock, a lattice for others */
    MOR_CASE_PARTICLES_LATTICE,
    MOR_CASE_PARTICLES_RELAXED
} mor_case_particles;

/** One rock. */
typedef struct mor_case_body {
    char name[MOR_CASE_NAME_BYTES];
    mor_case_place place;
    mor_shape *shape;                           /* in the body's own frame; owned by the case */
    mor_case_shape outline;                     /* what shape was built from; owned by the case */
    double position[3];                         /* of the origin of the body's frame, m */
    double height_over_ground;                  /* smallest distance from walls and soil, reached by translation along
                                * gravity, m; NaN: at position */
    double axis[3];                             /* of the rotation of the body's frame, any length but zero, 1 */
    double angle;                               /* of that rotation, rad */
    double velocity[3];                         /* of the center of mass, m/s */
    double angular_velocity[3];                 /* about the center of mass, rad/s */
    char model[MOR_CASE_NAME_BYTES];            /* "rigid", or a model in total form */
    double density;                             /* kg/m3 */
    double parameters[MOR_CASE_PARAMETERS_MAX]; /* in the order of the model's parameter schema, SI; not of "rigid" */
    double contact_modulus;                     /* Pa; NaN (rigid bodies only): what mor_case_contact_modulus chooses */
    double contact_poisson;                     /* Poisson's ratio of a rigid body's surface in contact, 1 */
    mor_case_friction soil_friction;
    double soil_friction_coefficient; /* Coulomb only, 1 */
    mor_case_frictions friction_with;
    bool is_prescribed; /* rigid: moves with its velocities, or on its path, whatever forces act on it */
    mor_case_path path; /* of a prescribed motion, in place of the velocities */
    double removed_at;  /* rigid: s; NaN: never */
    mor_case_particles particles;
    bool is_locked[6];            /* rigid: no translation along x, y, z; no rotation about x, y, z */
    bool has_spring;              /* rigid: spring and damper to a fixed point */
    double spring_point[3];       /* of the body's own frame, m */
    double spring_anchor[3];      /* fixed, frame of the case, m */
    double spring_length;         /* at rest, m; NaN: the distance at the start */
    double spring_stiffness;      /* N/m (N/m2) */
    double spring_damping;        /* N s/m (N s/m2) */
    mor_shape *clamp;             /* elastic: particles inside do not move; frame of the case; NULL: none; owned */
    mor_case_shape clamp_outline; /* what clamp was built from; owned by the case */
    mor_case_motion motion;
    double motion_axis[3];      /* along the bar, 1 */
    double motion_direction[3]; /* of bending, 1 */
    double motion_origin[3];    /* clamped end, frame of the case, m */
    double motion_length;       /* of the bar, m */
    double motion_speed;        /* cantilever: of the free end, m/s; twist: angular velocity of the free end, rad/s */
    double packed_diameter;     /* of a packed rock: of the ball (disc) of the same volume (area), m */
    uint64_t written, written_material, written_parameters, written_spring, written_motion;
} mor_case_body;

/** A point of a size distribution. */
typedef struct mor_case_size {
    double diameter; /* of the ball (disc) of the same volume (area), m */
    double passing;  /* share of the rocks' volume of rocks up to this diameter, 1 */
    uint64_t written;
} mor_case_size;

/** Rocks packed into a region. Each becomes a body of its own, named name_1, name_2, ... */
typedef struct mor_case_rocks {
    mor_case_body body;                              /* what they have in common; has no shape */
    mor_shape *region;                               /* owned by the case */
    mor_case_shape region_outline;                   /* what region was built from; owned by the case */
    mor_case_shape forms[MOR_CASE_ROCK_FORMS_MAX];   /* as written; owned by the case; of diameter 1 m */
    int n_forms;                                     /* number of forms */
    mor_shape *shapes[MOR_CASE_ROCK_SHAPES_MAX];     /* of diameter 1 m whatever the scale; owned; bodies view them */
    int form_of[MOR_CASE_ROCK_SHAPES_MAX];           /* shape [n_shapes]; form that a shape was made from */
    int n_shapes;                                    /* number of shapes */
    mor_case_size sizes[MOR_CASE_ROCK_SIZES_MAX];    /* rising */
    int n_sizes;                                     /* number of sizes */
    double content;                                  /* rocks' volume over the region's, 1; NaN: count is given */
    int count;                                       /* of rocks; 0: content or list is given */
    char list[MOR_CASE_TEXT_BYTES];                  /* path of a table of rocks; "": content or count is given */
    uint64_t list_hash;                              /* of the content of that table; 0: there is none */
    double gap;                                      /* least distance between two, m; default the spacing */
    double margin;                                   /* least depth under the region's surface, m; likewise */
    int n_variants;                                  /* rocks drawn of each form of type rock */
    uint64_t seed;                                   /* of positions and rotations */
    int n_rocks;                                     /* placed */
    int n_given_up;                                  /* without a position */
    double content_reached;                          /* 1 */
    double smallest_gap;                             /* between two of them, m; INFINITY for one */
    double passing_reached[MOR_CASE_ROCK_SIZES_MAX]; /* 1 */
    uint64_t written;
} mor_case_rocks;

/** Contact of two bodies, or of a body and a wall, by name. */
typedef struct mor_case_contact_pair {
    char first[MOR_CASE_NAME_BYTES], second[MOR_CASE_NAME_BYTES];
    mor_case_place place;
    double friction_coefficient; /* 1 */
    double restitution;          /* 1 */
    uint64_t written;
} mor_case_contact_pair;

/** Contact among bodies and walls. */
typedef struct mor_case_contact {
    double friction_coefficient; /* of pairs not listed, 1 */
    double restitution;          /* likewise, 1 */
    mor_case_contact_pair pairs[MOR_CASE_PAIRS_MAX];
    int n_pairs;
    uint64_t written;
} mor_case_contact;

/** One gauge: the force on a structure, or on a part of it. */
typedef struct mor_case_gauge {
    char name[MOR_CASE_NAME_BYTES];
    mor_case_place place;
    char wall[MOR_CASE_NAME_BYTES], body[MOR_CASE_NAME_BYTES]; /* the structure: one of the two, the other "" */
    double origin[3];                                          /* of moments and heights, m */
    double direction[3];                                       /* unit vector; of the normal force, 1 */
    double filter;                                             /* length of a running mean, s; NaN: none */
    double cutoff;                                             /* frequency of a low pass, 1/s; NaN: none */
    double cell;                                               /* side of the cells of a pressure map, m; NaN: no map */
    mor_shape *region;             /* that restricts it to a part; frame of the case; owned by the case; NULL: all */
    mor_case_shape region_outline; /* what region was built from; owned by the case */
    uint64_t written;
} mor_case_gauge;

/** Keys of a probe that only some types take. */
enum {
    MOR_CASE_PROBE_WALL = 1,
    MOR_CASE_PROBE_MEASURE = 2,
    MOR_CASE_PROBE_PERCENTILE = 4,
    MOR_CASE_PROBE_THICKNESS = 8,
    MOR_CASE_PROBE_ORIGIN = 16,
    MOR_CASE_PROBE_DIRECTION = 32,
    MOR_CASE_PROBE_RADIAL = 64,
    MOR_CASE_PROBE_BODY = 128,
    MOR_CASE_PROBE_SOIL = 256,
    MOR_CASE_PROBE_GAUGE = 512,
    MOR_CASE_PROBE_REGION = 1024,
    MOR_CASE_PROBE_PATH = 2048,
    MOR_CASE_PROBE_SPEED = 4096,
    MOR_CASE_PROBE_STRAIN = 8192,
    MOR_CASE_PROBE_FRICTION = 16384
};

/** What sets a type of probe apart, beside its keys. */
enum {
    MOR_CASE_PROBE_OF_SOIL = 1,     /* makes sense in a case with soil only */
    MOR_CASE_PROBE_OF_BODIES = 2,   /* makes sense in a case with bodies only */
    MOR_CASE_PROBE_OF_ROTATION = 4, /* direction is an axis, in plane strain always z */
    MOR_CASE_PROBE_OF_AUDIT = 8,    /* needs the audit of the soil's energy */
    MOR_CASE_PROBE_OF_STEP = 16,    /* holds over a step, as a force; others have a value at each instant */
    MOR_CASE_PROBE_OF_FORCE = 32,   /* a force, which has an impulse */
    MOR_CASE_PROBE_OF_PAST = 128,   /* remembers from the start on, so that it cannot be added to a run that goes on */
    MOR_CASE_PROBE_OF_PLANE = 256,  /* counts what crosses the plane through origin, along direction */
    MOR_CASE_PROBE_OF_POINT = 512,  /* looks around origin, or into a region in place of that */
    MOR_CASE_PROBE_OF_DATUM = 1024, /* counts heights over origin along a path as well */
    MOR_CASE_PROBE_OF_CONTACT = 64  /* changes with each sub-step of the bodies */
};

/** What a type of probe measures. */
typedef struct mor_case_probe_type {
    const char *name;
    const char *unit;       /* SI unit of the value in three dimensions */
    const char *unit_plane; /* in plane strain, where extensive values are per meter of thickness */
    unsigned allowed;       /* MOR_CASE_PROBE_ bits of the keys it takes */
    unsigned required;      /* and of those it cannot do without; see mor_case_probe_required */
    unsigned traits;        /* MOR_CASE_PROBE_OF_ bits */
    double percentile;      /* default of that key, percent */
    const char *text;       /* one line for people */
} mor_case_probe_type;

/** Returns the types of probes one after the other, NULL behind the last one.
 *  @param index [in]  >= 0 */
typedef const mor_case_probe_type *(*mor_case_probe_catalog)(int index);

/** One probe: a named result. */
typedef struct mor_case_probe {
    char name[MOR_CASE_NAME_BYTES];
    mor_case_place place;
    char type[MOR_CASE_NAME_BYTES];    /* "run_out", "height", "repose_angle", "kinetic_energy", ... */
    const mor_case_probe_type *kind;   /* the type of that name */
    char measure[MOR_CASE_NAME_BYTES]; /* of a run-out: "mass_percentile" or "thickness" */
    char wall[MOR_CASE_NAME_BYTES];    /* of a wall force */
    char body[MOR_CASE_NAME_BYTES];    /* of a probe of one body */
    char soil[MOR_CASE_NAME_BYTES];    /* of a probe of one soil; "": of all */
    char gauge[MOR_CASE_NAME_BYTES];   /* of a probe that reads a gauge */
    bool is_radial;                    /* run-out measured as a radius about origin, else along direction */
    double origin[3];                  /* m */
    double direction[3];               /* unit vector; run-out and force component */
    double percentile;                 /* percent of the mass (or of the particles sorted by the value), 0 to 100 */
    double thickness;                  /* threshold, m; default half the spacing */
    double window[2];                  /* times between which statistics are taken, s; NaN: the whole run */
    double speed;                      /* threshold, m/s */
    double strain;                     /* threshold of the plastic strain, 1 */
    double friction_coefficient;       /* of the ground, 1 */
    mor_shape *region;             /* that restricts it to a part; frame of the case; owned by the case; NULL: all */
    mor_case_shape region_outline; /* what region was built from; owned by the case */
    double *path;                  /* shape [n_path, 3]; corners of a polyline, m; owned by the case; NULL: none */
    int n_path;
    uint64_t written;
} mor_case_probe;

/** What of a probe is compared with a reference. */
typedef enum mor_case_statistic {
    MOR_CASE_STATISTIC_VALUE, /* the last value */
    MOR_CASE_STATISTIC_MAXIMUM,
    MOR_CASE_STATISTIC_MINIMUM,
    MOR_CASE_STATISTIC_MEAN,
    MOR_CASE_STATISTIC_IMPULSE /* of a force */
} mor_case_statistic;

/** One expectation. */
typedef struct mor_case_expectation {
    char probe[MOR_CASE_NAME_BYTES]; /* name of a probe */
    mor_case_place place;
    mor_case_statistic statistic;
    double value;         /* reference in the SI unit of the statistic */
    double tolerance;     /* relative to value, 1; or absolute when is_absolute */
    double tolerance_low; /* allowed shortfall, same kind as tolerance; default: as tolerance */
    bool is_absolute;
    char source[MOR_CASE_TEXT_BYTES];
    uint64_t written;
} mor_case_expectation;

/** A run before, whose end this one starts from. */
typedef struct mor_case_stage {
    char run[MOR_CASE_TEXT_BYTES]; /* its folder; absolute; "": this one starts from the case alone */
    mor_case_place place;
    uint64_t hash;                     /* of the content of its checkpoint */
    int region_of[MOR_CASE_SOILS_MAX]; /* of each soil of this case: the region of the run with its name; -1: none */
    double density_ratio[MOR_CASE_SOILS_MAX]; /* density of each soil over that of the soil that it takes over, 1 */
    mor_shape *excavations[MOR_CASE_EXCAVATIONS_MAX];             /* whose soil is not taken over; owned by the case */
    mor_case_shape excavation_outlines[MOR_CASE_EXCAVATIONS_MAX]; /* what they were built from; owned by the case */
    int n_excavations;
} mor_case_stage;

/** What to write. */
typedef struct mor_case_output {
    int n_snapshots;           /* snapshots after the initial one, evenly spaced */
    double series_interval;    /* s between rows of series.csv */
    double checkpoint_seconds; /* wall seconds between checkpoints */
    bool has_pictures;
    char color_field[MOR_CASE_NAME_BYTES]; /* "speed", "plastic_strain", "pressure", ... */
    double view[3];                        /* direction from the scene towards the camera; zero: chosen */
    bool has_cut;                          /* leave out the quadrant / half nearest to the camera */
} mor_case_output;

/** Maps of the run on a grid seen from above. */
typedef struct mor_case_maps {
    bool is_wanted;
    mor_case_place place;
    char ground[MOR_CASE_NAME_BYTES]; /* wall whose raster gives the grid; "": a grid over the domain */
    double cell;      /* size of the cells, m, which the scale does not touch; NaN: those of the raster, or spacing */
    double threshold; /* depth from which soil counts as arrived, m */
    double duration_depth; /* depth whose duration is mapped, m */
    int interval;          /* steps from one measurement to the next; 0: chosen */
    uint64_t written;
} mor_case_maps;

/** A whole case. */
typedef struct mor_case {
    char path[MOR_CASE_TEXT_BYTES];
    char title[MOR_CASE_TEXT_BYTES];
    mor_case_stage stage;
    int dimension;            /* 2 (plane strain in x, y) or 3 */
    double spacing;           /* m */
    double lattice_origin[3]; /* a lattice node, m */
    int lattice_pattern;      /* of soil; 0: square or cubic, 1: rings about the line through the origin along z */
    double gravity[3];        /* m/s2 */
    double end;               /* simulated time, s */
    double domain_minimum[3]; /* m */
    double domain_maximum[3]; /* m */
    int outflow;              /* of soil from the domain: 0 stops the run, 1 is removed */
    int periodic;             /* axes along which the domain repeats itself, see mor_case_is_periodic */
    uint64_t seed;
    double jitter_ratio; /* random displacement of the lattice / spacing */
    /* Placement of the whole scene (geometry, lattice, gravity): x -> rotation * x + translation. */
    double rotation[9];       /* shape [3,3], rotation matrix, 1; made from the two that follow */
    double placement_axis[3]; /* axis of the rotation, any length but zero, 1 */
    double placement_angle;   /* rad */
    double translation[3];    /* m */
    /* Powers of two multiplying lengths, times and masses, for the unit-change check. */
    double scale_length, scale_time, scale_mass; /* 1 */
    mor_case_reduction reduction;                /* of the strength of all soils */
    uint64_t written, written_domain, written_lattice, written_placement, written_scale, written_numerics;
    uint64_t written_output;
    mor_registry *registry; /* the models that the case was read with, those of its plug-ins among them; owned */
    mor_case_plugin plugins[MOR_CASE_PLUGINS_MAX];
    int n_plugins;
    mor_case_soil soils[MOR_CASE_SOILS_MAX];
    int n_soils;
    mor_case_wall walls[MOR_CASE_WALLS_MAX];
    int n_walls;
    mor_case_body *bodies; /* shape [n_bodies]; owned; those of the list bodies, then packed rocks */
    int n_bodies;
    int n_listed_bodies; /* those of the list bodies */
    mor_case_rocks rocks[MOR_CASE_ROCKS_MAX];
    int n_rocks;
    mor_case_contact contact;
    mor_scheme numerics;
    mor_case_gauge gauges[MOR_CASE_GAUGES_MAX];
    int n_gauges;
    mor_case_probe_catalog probe_types; /* that the case was read with; NULL: none */
    mor_case_probe probes[MOR_CASE_PROBES_MAX];
    int n_probes;
    mor_case_expectation expectations[MOR_CASE_EXPECTATIONS_MAX];
    int n_expectations;
    mor_case_maps maps;
    mor_case_output output;
} mor_case;

/** Whether the domain repeats itself along an axis.
 *  @param axis [in]  0 to 2: x, y, z */
static inline bool mor_case_is_periodic(const mor_case *the_case, int axis)
{
    static const int masks[] = {0, 1, 2, 4, 3, 6, 5, 7}; /* in the order of the words of domain.periodic */
    return (masks[the_case->periodic] >> axis & 1) != 0;
}

/** Whether the particles of a soil region come from the run that a case starts from.
 *  @param soil [in]  index of the region */
static inline bool mor_case_takes_over(const mor_case *the_case, int soil)
{
    return the_case->stage.run[0] != '\0' && the_case->stage.region_of[soil] >= 0;
}

/** Frees what a case owns, unloads its plug-ins and zeroes it. What was made from its models is gone before.
 *  @param the_case [in,out]  read or zeroed */
void mor_case_clear(mor_context *context, mor_case *the_case);

/** Frees what an outline owns, children included.
 *  @param outline [in,out]  read or zeroed */
void mor_case_shape_clear(mor_context *context, mor_case_shape *outline);

#endif
