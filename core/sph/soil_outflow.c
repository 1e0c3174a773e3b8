/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil that leaves the domain: it stops the run, or is removed at the end of the step in which it left. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

static bool is_inside(const mor_soil_settings *s, const double *x)
{
    double local[3];
    mor_domain_localize(s->placement, x, local);
    return mor_domain_holds(s->domain_minimum, s->domain_maximum, 3, local);
}

static mor_status report_density(mor_context *context, const mor_soil *soil, const mor_view *view, const mor_step *step,
                                 int64_t i)
{
    const double *x = mor_view_quote(view, MOR_FIELD_POSITION, i);
    const mor_status status =
        MOR_FAIL(context, MOR_ERROR_NUMERIC,
                 "particle %lld of set '%s' has density %.4g kg/m3 at (%.6g, %.6g, %.6g) m, t = %.6g s, step %llu; it "
                 "must be positive. A smaller 'courant' or 'density_reinitialization' more often may help",
                 (long long)soil->set.id[i], soil->set.name, mor_view_quote(view, MOR_FIELD_DENSITY, i)[0], x[0], x[1],
                 x[2], step->time + step->length, (unsigned long long)step->number);
    return mor_context_name_particle(context, status, soil->set.name, soil->set.id[i]);
}

static mor_status report_stray(mor_context *context, const mor_soil *soil, const mor_view *view, const mor_step *step,
                               int64_t i)
{
    const mor_soil_settings *s = &soil->settings;
    double x[3];
    mor_domain_localize(s->placement, mor_view_quote(view, MOR_FIELD_POSITION, i), x);
    const mor_status status = MOR_FAIL(
        context, MOR_ERROR_NUMERIC,
        "particle %lld of set '%s' left the domain: position (%.6g, %.6g, %.6g) m%s at t = %.6g s, step "
        "%llu; the domain is (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g) m. Enlarge 'domain', close the walls, "
        "or let soil leave with domain.outflow = \"remove\"",
        (long long)soil->set.id[i], soil->set.name, x[0], x[1], x[2], s->placement != NULL ? " before 'placement'" : "",
        step->time + step->length, (unsigned long long)step->number, s->domain_minimum[0], s->domain_minimum[1],
        s->domain_minimum[2], s->domain_maximum[0], s->domain_maximum[1], s->domain_maximum[2]);
    return mor_context_name_particle(context, status, soil->set.name, soil->set.id[i]);
}

/* What the check of positions and densities reads. */
typedef struct domain_check {
    const mor_soil_settings *settings;
    const double *position, *density;
} domain_check;

/* Checks the particles from the first that was found on: which stop the run, and which leave. */
static mor_status check_particles(mor_context *context, mor_soil *soil, const domain_check *job, const mor_view *view,
                                  const mor_step *step, int64_t first)
{
    for (int64_t i = first; i < soil->set.n_particles; ++i) {
        const double *x = job->position + 3 * i;
        if (!(job->density[i] > 0.0)) {
            return report_density(context, soil, view, step, i);
        }
        if (!is_inside(&soil->settings, x)) {
            if (!soil->settings.removes_outflow || !isfinite(x[0] + x[1] + x[2])) {
                return report_stray(context, soil, view, step, i);
            }
            soil->has_outflow = true;
        }
    }
    return MOR_OK;
}

static int64_t find_stray(const void *job, int64_t first, int64_t last)
{
    const domain_check *it = job;
    for (int64_t i = first; i < last; ++i) {
        if (!(is_inside(it->settings, it->position + 3 * i) && it->density[i] > 0.0)) {
            return i;
        }
    }
    return -1;
}

mor_status mor_soil_check_domain(mor_context *context, mor_soil *soil, mor_view *view, const mor_step *step)
{
    const domain_check job = {&soil->settings, mor_view_read(view, MOR_FIELD_POSITION),
                              mor_view_read(view, MOR_FIELD_DENSITY)};
    const mor_blocks blocks = mor_soil_blocks(soil, MOR_BLOCK, 1);
    const int64_t stray = mor_reduce_first(&blocks, context->n_threads, find_stray, &job, soil->room.indices);
    soil->has_outflow = false;
    return stray < 0 ? MOR_OK : check_particles(context, soil, &job, view, step, stray);
}

/* Adds mass, momentum and energy of a particle. */
static void count_out(mor_soil *soil, const mor_soil_powers *from, int64_t i)
{
    const double mass = from->mass[i];
    double stored = NAN;
    const double *v = from->velocity + 3 * i;
    double *out = soil->outflow;
    double x[3];
    mor_soil_find_unwrapped(soil, i, x);
    mor_soil_find_stored(from, i, 1, from->stress + 6 * i, &stored);
    soil->n_outflow += 1;
    out[MOR_SOIL_OUTFLOW_MASS] += mass;
    out[MOR_SOIL_OUTFLOW_KINETIC] += 0.5 * mass * mor_vector_dot(v, v);
    out[MOR_SOIL_OUTFLOW_ELASTIC] += stored * mass / from->density[i];
    for (int a = 0; a < 3; ++a) {
        out[MOR_SOIL_OUTFLOW_MOMENTUM + a] += mass * v[a];
        out[MOR_SOIL_OUTFLOW_MOMENT + a] += mass * x[a];
    }
}

void mor_soil_fit(mor_soil *soil)
{
    mor_tree_resize(&soil->tree, soil->set.n_particles);
    soil->inner.n_clusters = soil->tree.n_clusters;
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        mor_soil_contact_at(soil, k)->relation.n_clusters = soil->tree.n_clusters;
    }
    mor_soil_forget_lists(soil);
}

mor_status mor_soil_remove_outflow(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    int64_t n_out = 0;
    if (!soil->has_outflow) {
        return MOR_OK;
    }
    const double *position = mor_view_read(view, MOR_FIELD_POSITION);
    mor_soil_powers from = {.soil = soil,
                            .step = step,
                            .velocity = mor_view_read(view, MOR_FIELD_VELOCITY),
                            .mass = mor_view_read(view, MOR_FIELD_MASS),
                            .density = mor_view_read(view, MOR_FIELD_DENSITY),
                            .stress = mor_view_read(view, MOR_FIELD_STRESS)};
    mor_view_read_state(view, soil->state_fields, soil->material->n_state, from.state);
    int32_t *removed = mor_view_write_shared(view, MOR_RESOURCE_ORDER, soil->order);
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        if (!is_inside(&soil->settings, position + 3 * i)) {
            removed[n_out++] = (int32_t)i;
        }
    }
    MOR_CHECK(context, n_out < soil->set.n_particles, MOR_ERROR_NUMERIC,
              "the last particle of set '%s' left the domain at t = %.6g s, step %llu; nothing is left to compute. "
              "Enlarge 'domain', or let the run end before",
              soil->set.name, step->time + step->length, (unsigned long long)step->number);
    for (int64_t k = 0; k < n_out; ++k) {
        if (soil->watch.leave != NULL) {
            soil->watch.leave(soil->watch.owner, removed[k]);
        }
        count_out(soil, &from, removed[k]);
    }
    mor_set_remove(&soil->set, removed, n_out);
    mor_view_renew(view);
    mor_soil_fit(soil);
    return MOR_OK;
}

void mor_soil_outflow_energies(const mor_soil *soil, const double *datum, double *energies)
{
    const double *out = soil->outflow;
    energies[0] = out[MOR_SOIL_OUTFLOW_KINETIC];
    energies[1] = 0.0;
    energies[2] = out[MOR_SOIL_OUTFLOW_ELASTIC];
    for (int a = 0; a < 3; ++a) {
        energies[1] -=
            soil->settings.gravity[a] * (out[MOR_SOIL_OUTFLOW_MOMENT + a] - out[MOR_SOIL_OUTFLOW_MASS] * datum[a]);
    }
}
