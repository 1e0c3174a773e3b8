/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/wall_seams.h"

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>
#include <string.h>

/* Lengths in spacings: how far over a face the other wall is looked for, within what distance it counts as flush, and
 * the step of the differences that give a normal. */
#define LIFT 0.3
#define FLUSH 0.75
#define STEP 0x1p-6

/* Faces whose normals have at least this inner product go on in one another, 1. */
#define ALONG 0.9
/* Faces of an inner corner have less than this, 1; over the edge of a flush face it is 0.4 and more. */
#define INNER 0.2
/* Nearer to the second wall, spacings, a place may lie beside the edge of the first. */
#define BESIDE 0.25

enum { POINTS = 8192 };
enum { SIDE = 3 }; /* purposes of random numbers from there on; before, coordinates */

/* The boxes of both walls, a spacing larger, where they overlap within the domain; false: they do not. */
static bool find_overlap(const mor_case *c, const mor_shape *a, const mor_shape *b, mor_bounds *box)
{
    mor_bounds first, second;
    mor_shape_bounds(a, &first);
    mor_shape_bounds(b, &second);
    for (int k = 0; k < 3; ++k) {
        box->minimum[k] = box->maximum[k] = 0.0;
        if (k < c->dimension) {
            box->minimum[k] =
                fmax(fmax(first.minimum[k], second.minimum[k]) - c->spacing, c->domain_minimum[k] - c->spacing);
            box->maximum[k] =
                fmin(fmin(first.maximum[k], second.maximum[k]) + c->spacing, c->domain_maximum[k] + c->spacing);
        }
        if (box->minimum[k] > box->maximum[k]) {
            return false;
        }
    }
    return true;
}

/* A point to look from. Three of four lie within a spacing of a face or an edge of the box, where walls that are much
 * larger than a spacing meet. */
static void draw_point(const mor_case *c, const mor_bounds *box, int number, double *point)
{
    const int held = number % 4; /* coordinates that stay at a side of the box: 0, 1, and twice 2 */
    const int n_held = held < 3 ? held : 2;
    const int first = (int)(c->dimension * mor_random_uniform(0, (uint64_t)number, SIDE));
    for (int k = 0; k < c->dimension; ++k) {
        const double share = mor_random_uniform(0, (uint64_t)number, (uint64_t)k);
        const double side = mor_random_uniform(0, (uint64_t)number, (uint64_t)(SIDE + 1 + k));
        point[k] = box->minimum[k] + share * (box->maximum[k] - box->minimum[k]);
        if ((k - first + c->dimension) % c->dimension < n_held) {
            point[k] =
                side < 0.5 ? box->minimum[k] + 2.0 * share * c->spacing : box->maximum[k] - 2.0 * share * c->spacing;
        }
    }
}

static bool is_in_domain(const mor_case *c, const double *point)
{
    bool is_inside = true;
    for (int a = 0; a < c->dimension; ++a) {
        is_inside = is_inside && point[a] > c->domain_minimum[a] && point[a] < c->domain_maximum[a];
    }
    return is_inside;
}

/* What two walls make together. */
typedef struct seam {
    bool is_flush;   /* a face of one continues in the other */
    bool is_inner;   /* they form an inner corner, too, where a rock touches both */
    double place[3]; /* where they are flush, m */
} seam;

static seam find_seam(const mor_case *c, const mor_shape *a, const mor_shape *b)
{
    mor_bounds box;
    seam found = {false, false, {0.0}};
    if (!find_overlap(c, a, b, &box)) {
        return found;
    }
    for (int n = 0; n < POINTS; ++n) {
        double point[3] = {0.0, 0.0, 0.0};
        double first[3], second[3];
        draw_point(c, &box, n, point);
        if (!mor_shape_project(a, LIFT * c->spacing, STEP * c->spacing, point, first) || !is_in_domain(c, point)) {
            continue;
        }
        const double over = mor_shape_distance(b, point);
        if (!(over > 0.0 && over < FLUSH * c->spacing)) {
            continue;
        }
        mor_shape_normal(b, point, STEP * c->spacing, second);
        const double facing = mor_vector_dot(first, second);
        found.is_inner = found.is_inner || (facing < INNER && facing > -ALONG && over > BESIDE * c->spacing);
        if (facing > ALONG && !found.is_flush) {
            found.is_flush = true;
            memcpy(found.place, point, sizeof found.place);
        }
    }
    return found;
}

static bool has_own_law(const mor_case *c, const char *name)
{
    bool is_named = false;
    for (int p = 0; p < c->contact.n_pairs; ++p) {
        is_named =
            is_named || strcmp(c->contact.pairs[p].first, name) == 0 || strcmp(c->contact.pairs[p].second, name) == 0;
    }
    return is_named;
}

static bool move_alike(const mor_case_path *a, const mor_case_path *b)
{
    const size_t n_bytes = (size_t)a->n_rows * sizeof *a->rows;
    return a->n_rows == b->n_rows &&
           (a->n_rows == 0 ||
            (a->is_smooth == b->is_smooth && memcmp(a->rows, b->rows, n_bytes) == 0 &&
             (memcmp(a->point, b->point, sizeof a->point) == 0 || (isnan(a->point[0]) && isnan(b->point[0]))) &&
             memcmp(a->axis, b->axis, sizeof a->axis) == 0));
}

/* Whether contact with the surfaces of two walls is the same. */
static bool are_alike(const mor_case *c, const mor_case_wall *a, const mor_case_wall *b)
{
    return memcmp(a->velocity, b->velocity, sizeof a->velocity) == 0 && move_alike(&a->path, &b->path) &&
           (a->removed_at == b->removed_at || (isnan(a->removed_at) && isnan(b->removed_at))) &&
           a->contact_modulus == b->contact_modulus && a->contact_poisson == b->contact_poisson &&
           !has_own_law(c, a->name) && !has_own_law(c, b->name);
}

/* The union of the shapes of a wall and all that are joined to it. */
static mor_status unite(mor_context *context, const mor_case *c, const mor_contact_wall *walls, int leader,
                        mor_shape **whole)
{
    mor_shape *parts[MOR_CASE_WALLS_MAX];
    int n = 0;
    mor_status status = MOR_OK;
    for (int w = leader; w < c->n_walls && status == MOR_OK; ++w) {
        if (w == leader || walls[w].joined_to == leader + 1) {
            status = mor_shape_new_view(context, walls[w].shape, &parts[n]);
            n += status == MOR_OK;
        }
    }
    if (status == MOR_OK && n > 1) {
        status = mor_shape_new_union(context, parts, n, whole);
    }
    for (int k = 0; k < n; ++k) { /* what the union did not take */
        mor_shape_free(context, &parts[k]);
    }
    return status;
}

mor_status mor_wall_seams_join(mor_context *context, const mor_case *the_case, mor_contact_wall *walls,
                               mor_shape **wholes)
{
    const mor_case *c = the_case;
    int leaders[MOR_CASE_WALLS_MAX];
    for (int w = 0; w < c->n_walls; ++w) {
        leaders[w] = w;
        for (int v = 0; v < w; ++v) {
            if (leaders[v] == leaders[w] || !are_alike(c, &c->walls[w], &c->walls[v])) {
                continue;
            }
            const seam it = find_seam(c, c->walls[w].shape, c->walls[v].shape);
            if (!it.is_flush || it.is_inner) {
                continue;
            }
            const int least = leaders[v] < leaders[w] ? leaders[v] : leaders[w];
            const int other = leaders[v] < leaders[w] ? leaders[w] : leaders[v];
            for (int u = 0; u <= w; ++u) {
                leaders[u] = leaders[u] == other ? least : leaders[u];
            }
        }
    }
    for (int w = 0; w < c->n_walls; ++w) {
        walls[w].joined_to = leaders[w] == w ? 0 : leaders[w] + 1;
    }
    for (int w = 0; w < c->n_walls; ++w) {
        if (walls[w].joined_to == 0) {
            MOR_TRY(context, unite(context, c, walls, w, &wholes[w]));
            walls[w].whole = wholes[w];
        }
    }
    return MOR_OK;
}

void mor_wall_seams_warn(mor_context *context, const mor_case *the_case)
{
    const mor_case *c = the_case;
    for (int w = 0; w < c->n_walls && c->n_bodies > 0; ++w) {
        for (int v = 0; v < w; ++v) {
            const bool is_alike = are_alike(c, &c->walls[w], &c->walls[v]);
            const seam it = find_seam(c, c->walls[w].shape, c->walls[v].shape);
            if (it.is_flush && (!is_alike || it.is_inner)) {
                mor_context_log(
                    context, MOR_LOG_WARNING,
                    "%s:%d: wall '%s' continues in wall '%s' at (%.4g, %.4g, %.4g) m, but %s, so that contact does not "
                    "treat them as one; within two spacings of that seam a rock is in contact with each as if the "
                    "other were absent, with errors of its forces up to a third: %s",
                    c->walls[w].place.file, c->walls[w].place.line, c->walls[w].name, c->walls[v].name, it.place[0],
                    it.place[1], it.place[2],
                    is_alike ? "forms an inner corner with it elsewhere"
                             : "differs in motion, contact_modulus or contact law",
                    is_alike ? "let one end a spacing before the other"
                             : "give both the same motion, contact_modulus and contact law, or keep rocks "
                               "away from it");
            }
        }
    }
}
