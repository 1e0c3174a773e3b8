/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/soil_neighbors.h"

#include "cases/driver/scene/soil_columns.h"
#include "core/base/math.h"
#include "core/base/memory.h"

/* Soils touch when particles of both are nearer than this, in spacings: more than the diagonal of a square, less than
 * two rows. */
static const double touching = 1.5;

/* Soil over a gap narrower than this, in spacings, is not meant to fall. */
static const double narrow = 2.0;

/* Gaps that are looked at for what may lie in them, which takes distances to all bodies. */
enum { SAMPLES = 256 };

/* Words of a case for mor_case_stress. */
static const char *const stress_words[] = {"none", "k0", "settled", "uniform", "formula"};

typedef struct columns {
    const mor_simulation *simulation;
    mor_soil_columns grid;
    mor_soil_place *places; /* shape [n], sorted; owned */
    int64_t n;
} columns;

/* Columns in which a soil lies straight above another one. */
typedef struct pair {
    int64_t n_touching;
    int64_t n_gaps;
    double gap; /* the narrowest, m */
    double top; /* of the lower soil there, along up over the origin of space, m */
} pair;

/* Number of the first place of a column. */
static int64_t find_column(const columns *s, int64_t column)
{
    int64_t low = 0;
    int64_t high = s->n;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (s->places[middle].column < column) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static const double *position_of(const columns *s, const mor_soil_place *place)
{
    return s->simulation->soil.set.data[MOR_FIELD_POSITION] + 3 * place->particle;
}

static double distance_between(const columns *s, const mor_soil_place *a, const mor_soil_place *b)
{
    double way[3];
    for (int k = 0; k < 3; ++k) {
        way[k] = position_of(s, a)[k] - position_of(s, b)[k];
    }
    return mor_vector_length(way);
}

/* Whether a column has a particle of a soil near a place. */
static bool has_near(const columns *s, int64_t column, const mor_soil_place *place, int region)
{
    const double reach = touching * s->grid.spacing;
    bool is_near = false;
    for (int64_t k = find_column(s, column); k < s->n && s->places[k].column == column && !is_near; ++k) {
        const mor_soil_place *other = &s->places[k];
        if (other->height < place->height - reach) {
            break;
        }
        is_near = other->region == region && other->height <= place->height + reach &&
                  distance_between(s, other, place) <= reach;
    }
    return is_near;
}

/* Whether a particle touches a soil: a column is as wide as the spacing, so two to each side reach far enough. */
static bool touches(const columns *s, const mor_soil_place *place, int region)
{
    enum { REACH = 2 };
    const int64_t *n = s->grid.n;
    const int64_t row = place->column / n[1];
    const int64_t line = place->column % n[1];
    bool is_touching = false;
    for (int64_t a = row - REACH; a <= row + REACH && !is_touching; ++a) {
        for (int64_t b = line - REACH; b <= line + REACH && !is_touching; ++b) {
            is_touching = a >= 0 && a < n[0] && b >= 0 && b < n[1] && has_near(s, a * n[1] + b, place, region);
        }
    }
    return is_touching;
}

/* Whether a wall or a body bears the soil: it holds the point a spacing under a lowest particle, or nearly so. */
static bool is_borne(const columns *s, const mor_soil_place *place)
{
    const mor_case *c = s->simulation->the_case;
    const double reach = 0.25 * c->spacing;
    double point[3];
    double local[3];
    for (int a = 0; a < 3; ++a) {
        point[a] = position_of(s, place)[a] - c->spacing * s->grid.up[a];
    }
    mor_simulation_take_point_back(c, point, local);
    for (int w = 0; w < c->n_walls; ++w) {
        if (c->walls[w].shape->operations->distance(c->walls[w].shape, local) < reach) {
            return true;
        }
    }
    for (int b = 0; b < c->n_bodies; ++b) {
        double rotation[9];
        double translation[3];
        mor_simulation_body_frame(c, &c->bodies[b], rotation, translation);
        if (mor_simulation_placed_distance(c->bodies[b].shape, rotation, translation, point) < reach) {
            return true;
        }
    }
    return false;
}

/* Whether two places that follow each other are of two soils, one above the other. */
static bool is_step(const columns *s, int64_t k)
{
    return s->places[k].column == s->places[k - 1].column && s->places[k].region != s->places[k - 1].region;
}

static double distance_at(const columns *s, int64_t k)
{
    return s->places[k - 1].height - s->places[k].height;
}

static void count_pairs(const columns *s, pair (*pairs)[MOR_CASE_SOILS_MAX])
{
    const double spacing = s->grid.spacing;
    int64_t n_wide = 0;
    for (int64_t k = 1; k < s->n; ++k) {
        n_wide += is_step(s, k) && distance_at(s, k) > touching * spacing;
    }
    const int64_t stride = n_wide / SAMPLES + 1;
    int64_t wide = 0;
    for (int64_t k = 1; k < s->n; ++k) {
        const mor_soil_place *above = &s->places[k - 1];
        pair *it = &pairs[above->region][s->places[k].region];
        const double distance = distance_at(s, k);
        if (!is_step(s, k)) {
            continue;
        }
        if (!(distance > touching * spacing)) {
            it->n_touching += 1;
        } else if (wide++ % stride == 0) {
            if (touches(s, above, s->places[k].region)) {
                it->n_touching += stride;
            } else if (!is_borne(s, above)) {
                it->n_gaps += stride;
                it->top = distance - spacing < it->gap ? s->places[k].height + 0.5 * spacing : it->top;
                it->gap = fmin(it->gap, distance - spacing);
            }
        }
    }
}

static void warn_of_gap(mor_context *context, const columns *s, int upper, int lower, const pair *it)
{
    const mor_case *c = s->simulation->the_case;
    const mor_case_soil *above = &c->soils[upper];
    const mor_case_soil *below = &c->soils[lower];
    double origin[3];
    mor_simulation_place_point(c, (const double[3]){0.0, 0.0, 0.0}, origin);
    if (above->initial_stress != MOR_CASE_STRESS_NONE || it->gap < narrow * c->spacing) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%s:%d: soil '%s' does not touch soil '%s' below it: there is a gap of %.3g m (%.2f spacings), so that it "
            "falls as the run begins; give their faces one height: move '%s' down or raise the top of '%s' by about "
            "%.3g m",
            above->place.file, above->place.line, above->name, below->name, it->gap, it->gap / c->spacing, above->name,
            below->name, it->gap);
    } else if ((below->initial_stress == MOR_CASE_STRESS_K0 || below->initial_stress == MOR_CASE_STRESS_SETTLED) &&
               isnan(below->surface_level)) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%s:%d: the initial stress of soil '%s' has the weight of soil '%s' in it, which is %.3g m above "
            "it and does not rest on it; give '%s' initial_stress.surface_level = \"%.6g m\"",
            below->place.file, below->place.line, below->name, above->name, it->gap, below->name,
            it->top - mor_vector_dot(origin, s->grid.up));
    }
}

static void warn_of_gaps(mor_context *context, const columns *s)
{
    const int n = s->simulation->the_case->n_soils;
    pair pairs[MOR_CASE_SOILS_MAX][MOR_CASE_SOILS_MAX];
    for (int a = 0; a < n; ++a) {
        for (int b = 0; b < n; ++b) {
            pairs[a][b] = (pair){.gap = INFINITY};
        }
    }
    count_pairs(s, pairs);
    for (int a = 0; a < n; ++a) {
        for (int b = 0; b < n; ++b) {
            if (pairs[a][b].n_gaps > pairs[a][b].n_touching) {
                warn_of_gap(context, s, a, b, &pairs[a][b]);
            }
        }
    }
}

/* A soil with an initial stress that touches a soil; -1: none. */
static int find_stressed(const columns *s, int region)
{
    const mor_case *c = s->simulation->the_case;
    for (int64_t k = 0; k < s->n; ++k) {
        for (int other = 0; other < c->n_soils && s->places[k].region == region; ++other) {
            if (c->soils[other].initial_stress != MOR_CASE_STRESS_NONE && touches(s, &s->places[k], other)) {
                return other;
            }
        }
    }
    return -1;
}

/* Soil that moves from the start may well run into soil at rest. */
static void warn_of_unstressed(mor_context *context, const columns *s)
{
    const mor_case *c = s->simulation->the_case;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const bool is_bare = it->initial_stress == MOR_CASE_STRESS_NONE && mor_vector_length(it->velocity) == 0.0 &&
                             it->velocity_formula[0][0] == '\0' && !mor_case_takes_over(c, k);
        const int other = is_bare ? find_stressed(s, k) : -1;
        if (other >= 0) {
            const char *word = stress_words[c->soils[other].initial_stress];
            mor_context_log(context, MOR_LOG_WARNING,
                            "%s:%d: soil '%s' starts without stress beside soil '%s', which starts with %s: the stress "
                            "jumps where they meet, and both swing as the run begins; give '%s' initial_stress.type = "
                            "\"%s\" as well",
                            it->place.file, it->place.line, it->name, c->soils[other].name, word, it->name, word);
        }
    }
}

mor_status mor_soil_neighbors_warn(mor_context *context, const mor_simulation *simulation)
{
    columns s = {.simulation = simulation, .n = simulation->soil.set.n_particles};
    bool has_stress = false;
    for (int k = 0; k < simulation->the_case->n_soils; ++k) {
        has_stress = has_stress || simulation->the_case->soils[k].initial_stress != MOR_CASE_STRESS_NONE;
    }
    if (simulation->the_case->n_soils < 2 || mor_vector_length(simulation->the_case->gravity) == 0.0) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &s.places, s.n, "columns of soil"));
    mor_soil_columns_find(simulation, &s.grid);
    mor_soil_columns_sort(simulation, &s.grid, s.places);
    warn_of_gaps(context, &s);
    if (has_stress) {
        warn_of_unstressed(context, &s);
    }
    MOR_FREE(context, &s.places);
    return MOR_OK;
}
