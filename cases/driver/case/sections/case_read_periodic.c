/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What does not go with a domain that repeats itself. */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/math.h"
#include "core/particle/kernel.h"

#include <math.h>
#include <string.h>

/* Part of a spacing by which an extent may miss a whole number of spacings: numbers in a case have few digits. */
#define ON_LATTICE 1.0e-6

static mor_status check_extents(const mor_case_reader *reader, const mor_case_node *domain, const mor_case *c)
{
    for (int a = 0; a < 3; ++a) {
        const double spacings = (c->domain_maximum[a] - c->domain_minimum[a]) / c->spacing;
        if (mor_case_is_periodic(c, a) && fabs(spacings - rint(spacings)) > ON_LATTICE) {
            return MOR_CASE_NODE_FAIL(
                reader->context, mor_case_node_find(domain, "periodic"),
                "found domain.periodic with an extent of %.10g m along %c, %.10g spacings of %g m; "
                "allowed is a whole number of spacings, so that the lattice goes on beyond the "
                "face; give an extent of %.10g m or change the spacing",
                c->domain_maximum[a] - c->domain_minimum[a], "xyz"[a], spacings, c -> spacing,
                rint(spacings) * c -> spacing);
        }
    }
    return MOR_OK;
}

static mor_status check_reach(const mor_case_reader *reader, const mor_case_node *domain, const mor_case *c)
{
    const double reach = MOR_KERNEL_SUPPORT * c->numerics.smoothing_ratio + c->numerics.skin_ratio;
    for (int a = 0; a < 3; ++a) {
        const double length = c->domain_maximum[a] - c->domain_minimum[a];
        if (mor_case_is_periodic(c, a) && length < 2.0 * reach * c->spacing) {
            return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(domain, "periodic"),
                                      "found domain.periodic with an extent of %.4g m along %c; allowed are at least "
                                      "%.4g m, twice the reach of the neighbor lists, so that no particle sees another "
                                      "twice; make the domain longer along %c or the spacing smaller",
                                      length, "xyz"[a], 2.0 * reach * c -> spacing, "xyz"[a]);
        }
    }
    return MOR_OK;
}

/* Whether any row of a path rotates. */
static bool rotates(const mor_case_path *path)
{
    bool does = false;
    for (int k = 1; k < path->n_rows; ++k) {
        does = does || path->rows[k].angle != path->rows[0].angle;
    }
    return does;
}

/* Whether any row of a path, or a velocity, moves along a periodic axis. */
static bool moves_along(const mor_case *c, const mor_case_wall *wall)
{
    bool does = false;
    for (int a = 0; a < 3; ++a) {
        does = does || (mor_case_is_periodic(c, a) && wall->velocity[a] != 0.0);
        for (int k = 0; k < wall->path.n_rows; ++k) {
            does = does || (mor_case_is_periodic(c, a) && wall->path.rows[k].translation[a] != 0.0);
        }
    }
    return does;
}

/* A rotation leaves space as periodic as it was about the one axis along which it repeats itself. */
static bool keeps_period(const mor_case *c, const mor_case_path *path)
{
    bool does = true;
    for (int a = 0; a < 3; ++a) {
        does = does && mor_case_is_periodic(c, a) == (path->axis[a] != 0.0);
    }
    return does && c->periodic <= 3;
}

static mor_status check_wall(const mor_case_reader *reader, const mor_case_node *node, const mor_case *c,
                             const mor_case_wall *wall)
{
    if (wall->outline.kind == MOR_CASE_SHAPE_TERRAIN) {
        return MOR_CASE_NODE_FAIL(
            reader->context, node,
            "found domain.periodic with the terrain '%s'; allowed are other walls, for ground does "
            "not repeat itself; take its shape from something else, or leave out 'periodic'",
            wall->name);
    }
    if (rotates(&wall->path) && !keeps_period(c, &wall->path)) {
        return MOR_CASE_NODE_FAIL(
            reader->context, node,
            "found domain.periodic with wall '%s' that rotates; allowed are rotations about an axis "
            "along which alone the domain is periodic; move the wall without rotation or leave "
            "out 'periodic'",
            wall->name);
    }
    if (c->n_bodies > 0 && moves_along(c, wall)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found domain.periodic with bodies and wall '%s' that moves along a periodic axis; "
                                  "allowed is one of both, for bodies do not touch what comes in through a periodic "
                                  "face; let the wall stand or leave out the bodies",
                                  wall->name);
    }
    return MOR_OK;
}

/* The shape of a wall is known where it has moved to, not where faces have put it back. */
static mor_status check_gap(mor_context *context, const mor_case *c, const mor_case_probe *probe)
{
    for (int w = 0; w < c->n_walls; ++w) {
        const mor_case_wall *wall = &c->walls[w];
        if (strcmp(probe->type, "wall_gap") == 0 && strcmp(wall->name, probe->wall) == 0 &&
            wall->outline.kind != MOR_CASE_SHAPE_HALF_SPACE && moves_along(c, wall)) {
            return MOR_FAIL(context, MOR_ERROR_CONFIG,
                            "%s:%d: found domain.periodic with probe '%s' of the gap to wall '%s', which moves along a "
                            "periodic axis; allowed are walls that do not, and half-spaces; remove the probe",
                            probe->place.file, probe->place.line, probe->name, wall->name);
        }
    }
    return MOR_OK;
}

/* Soil that stands is left out, as soil that sleeps. */
static mor_status check_released(const mor_case_reader *reader, const mor_case_node *node, const mor_case *c)
{
    for (int k = 0; k < c->n_soils; ++k) {
        if (c->soils[k].released > 0.0) {
            return MOR_CASE_NODE_FAIL(
                reader->context, node,
                "found domain.periodic with released = %g s of soil '%s'; allowed is one of both, for soil that stands "
                "is not continued beyond a periodic face; leave released out",
                c->soils[k].released, c->soils[k].name);
        }
    }
    return MOR_OK;
}

mor_status mor_case_reader_periodic(const mor_case_reader *reader, const mor_case_node *root, const mor_case *c)
{
    const mor_case_node *domain = mor_case_node_find(root, "domain");
    const mor_case_node *node = mor_case_node_find(domain, "periodic");
    if (c->periodic == 0) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, check_extents(reader, domain, c));
    MOR_TRY(reader->context, check_reach(reader, domain, c));
    if (c->numerics.sleep_after > 0.0) {
        return MOR_CASE_NODE_FAIL(
            reader->context, node,
            "found domain.periodic with numerics.sleep_after = %g s; allowed is one of both, for "
            "soil that sleeps does not see what moves beyond a periodic face; leave sleep_after out",
            c->numerics.sleep_after);
    }
    MOR_TRY(reader->context, check_released(reader, node, c));
    if (c->dimension == 2 && mor_case_is_periodic(c, 2)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found domain.periodic along z in plane strain; allowed: none, x, y, xy; correct it");
    }
    if (c->placement_angle != 0.0 || mor_vector_length(c->translation) > 0.0) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found domain.periodic with a placement; allowed is one of both; incline gravity in "
                                  "place of the scene");
    }
    if (c->lattice_pattern == 1 && (mor_case_is_periodic(c, 0) || mor_case_is_periodic(c, 1))) {
        return MOR_CASE_NODE_FAIL(
            reader->context, node,
            "found domain.periodic across the axis of lattice.pattern = \"polar\"; allowed: z, or "
            "a square pattern; correct one of both");
    }
    if (c->maps.is_wanted) {
        return MOR_CASE_NODE_FAIL(
            reader->context, node,
            "found domain.periodic with maps; allowed is one of both, for a map shows places, and "
            "soil comes back to them; leave out one of both");
    }
    for (int w = 0; w < c->n_walls; ++w) {
        MOR_TRY(reader->context, check_wall(reader, node, c, &c->walls[w]));
    }
    for (int k = 0; k < c->n_probes; ++k) {
        MOR_TRY(reader->context, mor_case_reader_periodic_probe(reader->context, c, &c->probes[k]));
        MOR_TRY(reader->context, check_gap(reader->context, c, &c->probes[k]));
    }
    return MOR_OK;
}
