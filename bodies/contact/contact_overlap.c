/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* How far the windows around the nodes of a surface add up to one: docs/theory/contact.md, "Between nodes". */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"
#include "core/base/memory.h"

/* Nodes farther than this from one another share no point of a window, widened by its contact; spacings. */
#define OVERLAP_REACH 2.75

/* Bounds of a sum of windows, 1: behind an edge there are no nodes. */
#define LEAST_SUM 0.5
#define LARGEST_SUM 2.0

enum { FOUND_MAX = 128 };

/* Counts the nodes around each smooth node of a body, itself among them; with `first`, lists them from there on. */
static mor_status visit_nodes(mor_context *context, mor_contact *contact, const mor_contact_body *c,
                              const int64_t *first, int64_t *counts)
{
    mor_contact_work *work = contact->work;
    const mor_body_group *group = c->group;
    const mor_body *body = &group->bodies[c->body];
    mor_tree tree;
    MOR_TRY(context, mor_tree_init(context, &tree, body->n_nodes));
    mor_tree_fit(&tree, group->node_reference + 3 * body->first_node, 3);
    for (int64_t node = body->first_node; node < body->first_node + body->n_nodes; ++node) {
        const int64_t entry = work->first_node[c->group_index] + node;
        int32_t found[FOUND_MAX];
        const int n = work->is_smooth[entry] ? mor_body_find_near(&tree, group->node_reference, body->first_node,
                                                                  group->node_reference + 3 * node,
                                                                  OVERLAP_REACH * group->spacing, 0.0, found, FOUND_MAX)
                                             : 0;
        for (int k = 0; k < n && first != NULL; ++k) {
            work->neighbors[first[entry] + k] = found[k];
        }
        counts[entry] = n;
    }
    mor_tree_clear(context, &tree);
    return MOR_OK;
}

static mor_status visit_bodies(mor_context *context, mor_contact *contact, const int64_t *first, int64_t *counts)
{
    for (int b = 0; b < contact->work->n_bodies; ++b) {
        if (!contact->work->bodies[b].group->operations->is_deformable) {
            MOR_TRY(context, visit_nodes(context, contact, &contact->work->bodies[b], first, counts));
        }
    }
    return MOR_OK;
}

mor_status mor_contact_list_neighbors(mor_context *context, mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    const int64_t n = contact->history.n_particles;
    int64_t *counts = NULL;
    MOR_TRY(context, MOR_NEW(context, &work->first_neighbor, n + 1, "contact"));
    MOR_TRY(context, MOR_NEW(context, &counts, n, "contact"));
    mor_status status = visit_bodies(context, contact, NULL, counts);
    for (int64_t k = 0; k < n; ++k) {
        work->first_neighbor[k + 1] = work->first_neighbor[k] + counts[k];
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &work->neighbors, work->first_neighbor[n], "contact");
    }
    if (status == MOR_OK) {
        status = visit_bodies(context, contact, work->first_neighbor, counts);
    }
    MOR_FREE(context, &counts);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

double mor_contact_overlap(const mor_contact *contact, const mor_contact_body *owner, int64_t node,
                           const double *offset, double variance)
{
    const mor_contact_work *work = contact->work;
    const mor_body_group *group = owner->group;
    const int64_t entry = work->first_node[owner->group_index] + node;
    double place[3];
    double sum = 0.0;
    mor_matrix_apply_transposed(group->bodies[owner->body].rotation, offset, place);
    for (int a = 0; a < 3; ++a) {
        place[a] += group->node_reference[3 * node + a];
    }
    for (int64_t k = work->first_neighbor[entry]; k < work->first_neighbor[entry + 1]; ++k) {
        const double *other = group->node_reference + 3 * (int64_t)work->neighbors[k];
        const double d[3] = {other[0] - place[0], other[1] - place[1], other[2] - place[2]};
        const double area = group->node_area[work->neighbors[k]];
        const double length2 = group->dimension == 3 ? area : area * area;
        const double spread2 = MOR_CONTACT_DEVIATION * MOR_CONTACT_DEVIATION * length2 + variance;
        const double norm = 2.0 * MOR_PI * spread2;
        sum += area / (group->dimension == 3 ? norm : sqrt(norm)) * exp(-0.5 * mor_vector_dot(d, d) / spread2);
    }
    return fmin(fmax(sum, LEAST_SUM), LARGEST_SUM);
}
