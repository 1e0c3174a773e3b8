/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What a case owns, and its end. */
#include "cases/driver/case/case.h"

#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

void mor_case_shape_clear(mor_context *context, mor_case_shape *outline)
{
    for (int k = 0; k < outline->n_children; ++k) {
        mor_case_shape_clear(context, &outline->children[k]);
    }
    MOR_FREE(context, &outline->children);
    MOR_FREE(context, &outline->points);
    outline->n_children = 0;
    outline->n_points = 0;
}

static void clear_rocks(mor_context *context, mor_case_rocks *rocks)
{
    mor_shape_free(context, &rocks->region);
    mor_case_shape_clear(context, &rocks->region_outline);
    for (int k = 0; k < rocks->n_shapes; ++k) {
        mor_shape_free(context, &rocks->shapes[k]);
    }
    for (int k = 0; k < rocks->n_forms; ++k) {
        mor_case_shape_clear(context, &rocks->forms[k]);
    }
}

static void clear_external(mor_context *context, mor_case_external *external)
{
    mor_external_free(context, &external->made);
    MOR_FREE(context, &external->constants);
    MOR_FREE(context, &external->state_start);
}

void mor_case_clear(mor_context *context, mor_case *the_case)
{
    for (int k = 0; k < the_case->n_soils; ++k) {
        mor_shape_free(context, &the_case->soils[k].shape);
        mor_case_shape_clear(context, &the_case->soils[k].outline);
        clear_external(context, &the_case->soils[k].external);
    }
    for (int k = 0; k < the_case->n_walls; ++k) {
        mor_shape_free(context, &the_case->walls[k].shape);
        mor_case_shape_clear(context, &the_case->walls[k].outline);
        MOR_FREE(context, &the_case->walls[k].path.rows);
    }
    for (int k = 0; k < the_case->n_bodies; ++k) {
        mor_case_body *body = &the_case->bodies[k];
        mor_shape_free(context, &body->shape);
        mor_shape_free(context, &body->clamp);
        mor_case_shape_clear(context, &body->outline);
        mor_case_shape_clear(context, &body->clamp_outline);
        MOR_FREE(context, &body->path.rows);
    }
    for (int k = 0; k < the_case->stage.n_excavations; ++k) {
        mor_shape_free(context, &the_case->stage.excavations[k]);
        mor_case_shape_clear(context, &the_case->stage.excavation_outlines[k]);
    }
    MOR_FREE(context, &the_case->bodies);
    for (int k = 0; k < the_case->n_rocks; ++k) {
        clear_rocks(context, &the_case->rocks[k]); /* after the bodies, which view their shapes */
    }
    for (int k = 0; k < the_case->n_gauges; ++k) {
        mor_shape_free(context, &the_case->gauges[k].region);
        mor_case_shape_clear(context, &the_case->gauges[k].region_outline);
    }
    for (int k = 0; k < the_case->n_probes; ++k) {
        mor_shape_free(context, &the_case->probes[k].region);
        mor_case_shape_clear(context, &the_case->probes[k].region_outline);
        MOR_FREE(context, &the_case->probes[k].path);
    }
    mor_registry_free(context, &the_case->registry);
    for (int k = 0; k < the_case->n_plugins; ++k) {
        mor_plugin_unload(context, &the_case->plugins[k].plugin);
    }
    memset(the_case, 0, sizeof *the_case);
}
