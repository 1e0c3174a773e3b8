/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_VIEW_PICTURE_H
#define MOR_CASES_DRIVER_PICTURE_VIEW_PICTURE_H

#include "cases/driver/picture/draw/canvas.h"
#include "cases/driver/picture/draw/chart.h"
#include "core/geometry/shape.h"

#include <stdbool.h>

/** @file
 *  A finished picture of particles: lit spheres in space or discs in the plane, colored by a field, with title, time,
 *  color bar, scale bar or axes, and a legend. A record filled with zeros but for dimension and groups is a valid
 *  picture. It neither reads runs nor distinguishes soil and rock. */

enum {
    MOR_PICTURE_GROUPS_MAX = 96,
    MOR_PICTURE_PART_MAX = 9999 /* largest number of a part of a group */
};

/** How the particles of a group are shown. */
typedef enum mor_picture_style {
    MOR_PICTURE_SOLID, /* opaque spheres or discs */
    MOR_PICTURE_GHOST, /* transparent, no shadow; for walls in front of the particles */
    MOR_PICTURE_GROUND /* not as particles: the plane along their upper side, as a disc with a grid; for flat floors,
                          level or inclined. Pictures of dimension 2 show it like MOR_PICTURE_SOLID */
} mor_picture_style;

/** Particles that are shown in the same way. The arrays are borrowed for the call. */
typedef struct mor_picture_group {
    const char *name;       /* for messages and the legend; NULL: not in the legend */
    const double *position; /* shape [n_particles,3], m */
    int64_t n_particles;    /* >= 0 */
    double radius;          /* m; of every particle when radii is NULL: half the particle spacing */
    const double *radii;    /* shape [n_particles], m; NULL: radius holds for all */
    const double *value;    /* shape [n_particles], in the unit of the picture's value_unit; NULL: one color */
    double color[3];     /* shape [3]; screen values, 1, in [0, 1]; read when value is NULL; all zero: a stone gray */
    const double *part;  /* shape [n_particles], whole numbers from 0 to MOR_PICTURE_PART_MAX; which part of the group a
                           particle belongs to: parts of one color differ slightly in shade. NULL: all of one part */
    const double *light; /* shape [n_particles], 1, >= 0; multiplies the color of each particle; NULL: 1 for all */
    bool is_piece; /* one piece of material per part, not particles: drawn with a closed surface, and in the plane with
                           a dark line around each part, over groups that are not */
    mor_picture_style style;
    bool is_whole;  /* the cut leaves this group alone */
    bool is_framed; /* the camera frames these particles too when the picture has a frame */
} mor_picture_group;

/** What to show and how. */
typedef struct mor_picture {
    int dimension;                   /* 2: seen along -z, x to the right, y up, with axes; 3: orthographic in space */
    const mor_picture_group *groups; /* shape [n_groups] */
    int n_groups;                    /* 1 to MOR_PICTURE_GROUPS_MAX */
    double gravity[3];               /* shape [3], m/s2; up is against it; zero: up is z in space */
    double view[3];         /* shape [3], 1; from the scene to the viewer; zero: azimuth -60, elevation 25 degrees.
                                        In space only */
    const char *title;      /* one line; NULL: none */
    const char *time_text;  /* such as "t = 0.40 s"; NULL: none */
    const char *value_name; /* such as "speed"; NULL: the color bar shows the unit alone */
    const char *value_unit; /* SI, such as "m/s"; prefixes are chosen; NULL: "1" */
    bool has_range;         /* range is given; otherwise from the 1st to the 99th percentile, rounded outwards */
    double range[2];        /* shape [2], unit value_unit; lower and upper end of the color bar */
    bool has_cut; /* in space only: the quadrant nearest to the viewer is left out of all groups that are not whole */
    double j_minus_1;  /* 1; particles are drawn this much larger than their radius, so that a body looks
                                        closed; 1: as they are; 0: 1.55 in the plane; in space 1.22, pieces 1.5 */
    int width;         /* pixels; 0: from the height, or MOR_CANVAS_WIDTH */
    int height;        /* pixels; 0: in space from the width, or MOR_CANVAS_HEIGHT; in the plane what the
                                        axes need, at most that, so that a series needs a frame */
    bool has_frame;    /* frame is given; otherwise all particles but those of ground groups are framed */
    mor_bounds frame;  /* m; what the camera frames, together with groups that are framed: where these stand still, the
                                        same box gives the same camera */
    bool hides_ground; /* no ground plane; otherwise one lies under the particles even without a group */
} mor_picture;

/** Makes an empty box, to start a frame from. */
void mor_picture_bounds_init(mor_bounds *bounds);

/** Draws the picture.
 *  @param context [in,out]  n_threads threads are used, and their number does not change the picture
 *  @param canvas  [out]     the address of one pointer; NULL on failure; the caller frees it with mor_canvas_free
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when there is no particle to show, a number is not finite, a radius is not
 *  positive, a range or frame is empty or a size is out of range, with group, particle and value found;
 *  MOR_ERROR_MEMORY; what mor_scene_new and mor_canvas_new return.
 *  Cost: seconds for 1600 x 1000 pixels; about 200 bytes per particle. */
mor_status mor_picture_draw(mor_context *context, const mor_picture *picture, mor_canvas **canvas);

/** Draws the picture and writes it as PNG.
 *  @param path    [in]      zero-terminated; an existing file is replaced
 *  Returns: as mor_picture_draw and mor_canvas_write. */
mor_status mor_picture_write(mor_context *context, const mor_picture *picture, const char *path);

/** Draws a chart of curves and writes it as PNG.
 *  @param path    [in]      zero-terminated; an existing file is replaced
 *  Returns: as mor_chart_draw and mor_canvas_write. */
mor_status mor_picture_chart(mor_context *context, const mor_chart *chart, const char *path);

#endif
