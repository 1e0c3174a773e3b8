/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/body_kinds.h"

#include "bodies/elastic/elastic.h"
#include "bodies/rigid/rigid.h"
#include "cases/driver/case/schema/case_schema.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <string.h>

/* ---- Elastic ----------------------------------------------------------------------------------------------------- */

static mor_status make_elastic(mor_context *context, const mor_body_group_spec *spec, mor_body_group **group)
{
    const mor_case *c = spec->the_case;
    mor_elastic *elastic = NULL;
    MOR_TRY(context, MOR_NEW(context, &elastic, 1, "elastic bodies"));
    const mor_status status = mor_elastic_init(context, elastic, spec->name, &c->numerics, spec->material, c->dimension,
                                               c->spacing, spec->requests, spec->n_members);
    if (status != MOR_OK) {
        MOR_FREE(context, &elastic);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *group = &elastic->group;
    return MOR_OK;
}

/* ---- Rigid ------------------------------------------------------------------------------------------------------- */

/* How a rigid body moves, in the frame of the run. */
static void set_motion(const mor_case *c, const mor_case_body *it, const mor_body_request *request,
                       mor_rigid_motion *motion)
{
    memset(motion, 0, sizeof *motion);
    motion->is_prescribed = it->is_prescribed;
    memcpy(motion->velocity, request->velocity, sizeof motion->velocity);
    memcpy(motion->angular_velocity, request->angular_velocity, sizeof motion->angular_velocity);
    for (int k = 0; k < 6; ++k) {
        motion->locked |= it->is_locked[k] ? 1u << k : 0u;
    }
    motion->has_spring = it->has_spring;
    if (it->has_spring) {
        double offset[3];
        mor_matrix_apply(request->shape_rotation, it->spring_point, motion->spring_point);
        mor_matrix_apply(c->rotation, it->spring_anchor, motion->spring_anchor);
        for (int a = 0; a < 3; ++a) {
            motion->spring_point[a] += request->shape_translation[a];
            motion->spring_anchor[a] += c->translation[a];
            offset[a] = motion->spring_point[a] - motion->spring_anchor[a];
        }
        motion->spring_length = isnan(it->spring_length) ? mor_vector_length(offset) : it->spring_length;
        motion->spring_stiffness = it->spring_stiffness;
        motion->spring_damping = it->spring_damping;
    }
}

static mor_status make_rigid(mor_context *context, const mor_body_group_spec *spec, mor_body_group **group)
{
    const mor_case *c = spec->the_case;
    mor_rigid *rigid = NULL;
    mor_rigid_motion *motions = NULL;
    MOR_TRY(context, MOR_NEW(context, &motions, spec->n_members, "motions of rigid bodies"));
    for (int m = 0; m < spec->n_members; ++m) {
        set_motion(c, &c->bodies[spec->members[m]], &spec->requests[m], &motions[m]);
    }
    mor_status status = MOR_NEW(context, &rigid, 1, "rigid bodies");
    if (status == MOR_OK) {
        status = mor_rigid_init(context, rigid, spec->name, c->dimension, c->spacing, spec->requests, motions,
                                spec->n_members);
    }
    MOR_FREE(context, &motions);
    if (status != MOR_OK) {
        MOR_FREE(context, &rigid);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *group = &rigid->group;
    return MOR_OK;
}

/* ---- The list ---------------------------------------------------------------------------------------------------- */

const mor_body_kind mor_body_kinds[] = {{NULL, make_elastic}, {"rigid", make_rigid}, {NULL, NULL}};

bool mor_body_kind_is(const mor_body_kind *kind, const mor_case_body *body)
{
    return kind->word != NULL ? strcmp(kind->word, body->model) == 0 : !mor_case_body_is_rigid(body);
}
