/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Settings that contradict one another are refused; those without effect give a warning. */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/math.h"
#include "core/particle/kernel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { VALUES_MAX = 9 };

/* ---- Settings that have no effect -------------------------------------------------------------------------------- */

/* Text for the condition under which a key has an effect. */
static const struct {
    unsigned need;
    const char *words;
} needs[] = {{MOR_CASE_NEEDS_SOIL, "in a case with soil"},
             {MOR_CASE_NEEDS_BODIES, "in a case with bodies"},
             {MOR_CASE_NEEDS_ELASTIC, "with elastic bodies"},
             {MOR_CASE_NEEDS_WALLS, "in a case with walls"},
             {MOR_CASE_NEEDS_GRAVITY, "with gravity"},
             {MOR_CASE_NEEDS_ARTIFICIAL, "with artificial_stress = true"},
             {MOR_CASE_NEEDS_DIFFUSION, "with stress_diffusion above 0"},
             {MOR_CASE_NEEDS_DISSIPATION, "with dissipation_factor above 0"},
             {MOR_CASE_NEEDS_BARRIER, "with barrier_stiffness above 0"},
             {MOR_CASE_NEEDS_ROTATION, "with an angle other than 0"},
             {MOR_CASE_NEEDS_BODY_ROTATION, "with an angle other than 0"},
             {MOR_CASE_NEEDS_STIFF_SPRING, "with a stiffness above 0"},
             {MOR_CASE_NEEDS_COMPLIANCE, "with contact_modulus"},
             {MOR_CASE_NEEDS_RAMP, "with gravity_ramp above 0"},
             {MOR_CASE_NEEDS_HOURGLASS, "with soil_hourglass above 0"},
             {MOR_CASE_NEEDS_LATTICE, "with soil of particles = \"lattice\""},
             {MOR_CASE_NEEDS_SUM, "with velocity_gradient = \"sum\""},
             {MOR_CASE_NEEDS_ANGULAR, "with angular_momentum = true"},
             {MOR_CASE_NEEDS_DAMPING, "with damping or local_damping above 0"},
             {MOR_CASE_NEEDS_SLEEP, "with sleep_after above 0"}};

static unsigned find_given(const mor_case *c)
{
    const mor_scheme *n = &c->numerics;
    unsigned given = (c->n_soils > 0 ? MOR_CASE_NEEDS_SOIL : 0U) | (c->n_bodies > 0 ? MOR_CASE_NEEDS_BODIES : 0U) |
                     (c->n_walls > 0 ? MOR_CASE_NEEDS_WALLS : 0U);
    for (int k = 0; k < c->n_bodies; ++k) {
        given |= mor_case_body_is_rigid(&c->bodies[k]) ? 0U : MOR_CASE_NEEDS_ELASTIC;
    }
    for (int k = 0; k < c->n_soils; ++k) {
        given |= c->soils[k].is_relaxed ? 0U : MOR_CASE_NEEDS_LATTICE;
    }
    given |= mor_vector_length(c->gravity) > 0.0 ? MOR_CASE_NEEDS_GRAVITY : 0U;
    given |= n->artificial_stress ? MOR_CASE_NEEDS_ARTIFICIAL : 0U;
    given |= n->stress_diffusion > 0.0 ? MOR_CASE_NEEDS_DIFFUSION : 0U;
    given |= n->dissipation_factor > 0.0 ? MOR_CASE_NEEDS_DISSIPATION : 0U;
    given |= n->barrier_stiffness > 0.0 ? MOR_CASE_NEEDS_BARRIER : 0U;
    given |= n->gravity_ramp > 0.0 ? MOR_CASE_NEEDS_RAMP : 0U;
    given |= n->soil_hourglass > 0.0 ? MOR_CASE_NEEDS_HOURGLASS : 0U;
    given |= n->angular_momentum ? MOR_CASE_NEEDS_ANGULAR : 0U;
    given |= n->velocity_gradient == 0 ? MOR_CASE_NEEDS_SUM : 0U;
    given |= n->damping > 0.0 || n->local_damping > 0.0 ? MOR_CASE_NEEDS_DAMPING : 0U;
    given |= n->sleep_after > 0.0 ? MOR_CASE_NEEDS_SLEEP : 0U;
    return given | (c->placement_angle != 0.0 ? MOR_CASE_NEEDS_ROTATION : 0U);
}

/* Whether a key has the value it has when it is not written; case.resolved.cfg writes them all. */
static bool is_default(const mor_case_reader *reader, const mor_case *c, const mor_case_key *key, const void *record)
{
    const char *member = (const char *)record + key->offset;
    int whole = 0;
    double values[VALUES_MAX];
    const double fallback = mor_case_key_default(key, c->numerics.scheme);
    if (key->storage == MOR_CASE_STORE_BOOL) {
        return *(const bool *)member == (fallback == 1.0);
    }
    if (key->storage != MOR_CASE_STORE_REALS) {
        memcpy(&whole, member, sizeof whole);
        return whole == (int)fallback;
    }
    for (int k = 0; k < key->schema.n_components; ++k) {
        values[k] = fallback;
    }
    if (key->is_direction) { /* an axis: (0, 0, 1) */
        memcpy(values, (double[]){0.0, 0.0, 1.0}, 3 * sizeof *values);
    } else if (strcmp(key->schema.key, "barrier_radius") == 0) {
        values[0] = c->spacing;
    } else if (strcmp(key->schema.key, "dissipation_factor") == 0) {
        values[0] = 20.0 * c->dimension;
    } else {
        const mor_schema schema = mor_case_key_schema(key, reader->dimension);
        if (mor_case_reader_scale(reader, schema.unit, values, schema.n_components, 1) != MOR_OK) {
            return true;
        }
    }
    return memcmp(values, member, (size_t)key->schema.n_components * sizeof *values) == 0;
}

/* Warns of the keys of one group of the file that have no effect in this company. Keys that only one kind of record
 * takes are refused where that kind is read: mor_case_body_condition, mor_case_start_condition and their like. */
static void warn_of_group(const mor_case_reader *reader, const mor_case_node *node, const mor_case *c,
                          const mor_case_group *group, const void *record, unsigned given)
{
    for (const mor_case_key *key = group->keys; key->schema.key != NULL; ++key) {
        const unsigned missing = key->needs & ~given;
        const mor_case_node *child = node == NULL ? NULL : mor_case_node_find(node, key->schema.key);
        if (missing == 0U || child == NULL || is_default(reader, c, key, record)) {
            continue;
        }
        size_t first = 0;
        while ((needs[first].need & missing) == 0U) {
            ++first;
        }
        char path[MOR_CASE_NODE_TEXT_BYTES];
        mor_case_node_path(child, path, sizeof path);
        mor_context_log(reader->context, MOR_LOG_WARNING, "%s:%d: '%s' has no effect here; it has one %s",
                        child->origin, child->line, path, needs[first].words);
    }
}

static void warn_of_idle_settings(const mor_case_reader *reader, const mor_case_node *root, const mor_case *c)
{
    const unsigned given = find_given(c);
    for (const mor_case_group *group = mor_case_settings_groups; group->name != NULL; ++group) {
        warn_of_group(reader, mor_case_node_find(root, group->name), c, group, c, given);
    }
    const mor_case_node *walls = mor_case_node_find(root, "walls");
    const mor_case_wall *wall = c->walls;
    for (const mor_case_node *it = walls == NULL ? NULL : walls->first_child; it != NULL; it = it->next) {
        const unsigned own = given | (wall->contact_modulus > 0.0 ? MOR_CASE_NEEDS_COMPLIANCE : 0U);
        warn_of_group(reader, it, c, &mor_case_wall_group, wall++, own);
    }
    const mor_case_node *bodies = mor_case_node_find(root, "bodies");
    const mor_case_body *body = c->bodies;
    for (const mor_case_node *it = bodies == NULL ? NULL : bodies->first_child; it != NULL; it = it->next) {
        const unsigned own = given | (body->angle != 0.0 ? MOR_CASE_NEEDS_BODY_ROTATION : 0U) |
                             (body->spring_stiffness > 0.0 ? MOR_CASE_NEEDS_STIFF_SPRING : 0U);
        warn_of_group(reader, it, c, &mor_case_body_group, body, own);
        warn_of_group(reader, mor_case_node_find(it, "spring"), c, &mor_case_spring_group, body, own);
        ++body;
    }
}

/* ---- Settings that contradict one another ------------------------------------------------------------------------ */

static mor_status check_ramp(const mor_case_reader *reader, const mor_case_node *root, const mor_case *c)
{
    if (!(c->numerics.gravity_ramp > c->end)) {
        return MOR_OK;
    }
    const mor_case_node *node = mor_case_node_find(mor_case_node_find(root, "numerics"), "gravity_ramp");
    return MOR_CASE_NODE_FAIL(
        reader->context, node,
        "found numerics.gravity_ramp = %g s in a run of %g s, so that gravity reaches %.3g of its "
        "value only; allowed: up to end; shorten the ramp or lengthen end",
        c->numerics.gravity_ramp, c->end, c->end / c->numerics.gravity_ramp);
}

static mor_status check_series(const mor_case_reader *reader, const mor_case_node *root, const mor_case *c)
{
    if (!(c->output.series_interval > c->end)) {
        return MOR_OK;
    }
    const mor_case_node *node = mor_case_node_find(mor_case_node_find(root, "output"), "series_interval");
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found output.series_interval = %g s in a run of %g s, so that series.csv has no row "
                              "between the first and the last; allowed: up to end; shorten it or lengthen end",
                              c->output.series_interval, c->end);
}

/* Soil interacts with rocks within the support of its kernel. */
static mor_status check_barrier(const mor_case_reader *reader, const mor_case_node *root, const mor_case *c)
{
    const double support = MOR_KERNEL_SUPPORT * c->numerics.smoothing_ratio * c->spacing;
    if (!(c->numerics.barrier_stiffness > 0.0) || c->numerics.barrier_radius <= support) {
        return MOR_OK;
    }
    const mor_case_node *node = mor_case_node_find(mor_case_node_find(root, "numerics"), "barrier_radius");
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found numerics.barrier_radius = %g m; allowed: up to the support of the kernel, %g m; "
                              "the spacing, which is the default, is a good value",
                              c->numerics.barrier_radius, support);
}

/* Forces by sums are not adjoint to a gradient by a fit: what it gains at surfaces, only diffusion takes away. */
static void warn_of_fit(const mor_case_reader *reader, const mor_case *c)
{
    if (c->n_soils > 0 && c->numerics.velocity_gradient != 0 &&
        c->numerics.stress_diffusion < MOR_SCHEME_LEAST_DIFFUSION) {
        mor_context_log(
            reader->context, MOR_LOG_WARNING,
            "numerics.velocity_gradient = \"%s\" with stress_diffusion below %g: waves at surfaces and walls may gain "
            "energy and grow; set numerics.stress_diffusion to %g or more (0.1 by default), or velocity_gradient = "
            "\"sum\"",
            c->numerics.velocity_gradient == 1 ? "fit" : "transient", MOR_SCHEME_LEAST_DIFFUSION,
            MOR_SCHEME_LEAST_DIFFUSION);
    }
}

/* XSPH and shifting move particles by their neighbors, asleep or not. */
static mor_status check_sleep(const mor_case_reader *reader, const mor_case_node *root, const mor_case *c)
{
    if (!(c->numerics.sleep_after > 0.0) || !(c->numerics.xsph > 0.0 || c->numerics.shifting)) {
        return MOR_OK;
    }
    const mor_case_node *node = mor_case_node_find(mor_case_node_find(root, "numerics"), "sleep_after");
    return MOR_CASE_NODE_FAIL(
        reader->context, node,
        "found numerics.sleep_after = %g s with %s, which moves soil that sleeps; allowed: one of "
        "the two; leave out sleep_after or %s",
        c->numerics.sleep_after, c->numerics.shifting ? "shifting" : "xsph",
        c->numerics.shifting ? "shifting" : "xsph");
}

/* So do they with soil that is not released. */
static mor_status check_released(const mor_case_reader *reader, const mor_case_node *root, const mor_case *c)
{
    for (int k = 0; k < c->n_soils && (c->numerics.xsph > 0.0 || c->numerics.shifting); ++k) {
        if (c->soils[k].released > 0.0) {
            return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(root, "soil"),
                                      "found released = %g s of the soil '%s' with %s, which moves soil that stands; "
                                      "allowed: one of the two; "
                                      "leave out released or %s",
                                      c->soils[k].released, c->soils[k].name,
                                      c->numerics.shifting ? "shifting" : "xsph",
                                      c->numerics.shifting ? "shifting" : "xsph");
        }
    }
    return MOR_OK;
}

mor_status mor_case_reader_check(const mor_case_reader *reader, const mor_case_node *root, const mor_case *the_case)
{
    MOR_TRY(reader->context, check_ramp(reader, root, the_case));
    MOR_TRY(reader->context, check_series(reader, root, the_case));
    MOR_TRY(reader->context, check_barrier(reader, root, the_case));
    MOR_TRY(reader->context, check_sleep(reader, root, the_case));
    MOR_TRY(reader->context, check_released(reader, root, the_case));
    warn_of_idle_settings(reader, root, the_case);
    warn_of_fit(reader, the_case);
    return MOR_OK;
}
