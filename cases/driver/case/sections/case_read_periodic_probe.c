/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes that have no meaning along an axis on which soil comes back to the places it was at. */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/math.h"

#include <math.h>
#include <string.h>

/* Cosines below this are rounding of directions that are across an axis. */
#define ACROSS 1.0e-12

/* What a type of probe does not go with. */
enum {
    ALONG = 1,  /* a direction, or a radius, with a part along a periodic axis */
    LEVEL = 2,  /* likewise its level part */
    TILT = 4,   /* gravity with a part along a periodic axis: heights go on with the way along it */
    PLANE = 8,  /* a plane that is inclined to a periodic axis */
    ARM = 16,   /* arms of a moment along a periodic axis */
    SHAPE = 32, /* any periodic axis: it takes the form of what may lie on both sides of a face */
    PART = 64,  /* a region, where the direction has a part along a periodic axis: who is in it changes */
    HIGH = 128  /* a region with TILT, of what takes heights as well */
};

typedef struct rule {
    const char *type;
    unsigned refused;
    const char *remedy;
} rule;

static const char follow[] = "use center_of_mass or displacement, which follow soil through the faces";
static const char across[] = "use another direction, or remove the probe";
static const char normal[] = "measure along the normal of the layer, as by center_of_mass, or remove the probe";
static const char without[] = "leave out 'region', so that it is of all soil";

static const rule rules[] = {
    {"run_out", ALONG, follow},
    {"toe", ALONG | TILT, follow},
    {"front_speed", ALONG, "use soil_velocity or largest_speed"},
    {"stray_share", ALONG | TILT, "remove the probe"},
    {"repose_angle", ALONG | TILT, "remove the probe"},
    {"height", TILT, normal},
    {"volume_beyond", ALONG, "use mass_passed, which counts each passage"},
    {"boulders_in_front", ALONG, across},
    {"boulder_height", TILT, normal},
    {"angle_of_reach", LEVEL | TILT, "use angle_of_centers, which follows soil through the faces"},
    {"stress_error", TILT, "use soil_stress"},
    {"stress_noise", TILT, "use soil_stress"},
    {"mass_passed", PLANE, "correct its direction"},
    {"mass_flow", PLANE, "correct its direction"},
    {"angular_momentum", ARM, "use momentum"},
    {"plastic_width", SHAPE, "use plastic_volume, over the extent of the domain along its periodic axes"},
    {"center_of_mass", PART, without},
    {"spread", PART, without},
    {"angle_of_centers", PART | HIGH, without},
    {"energy_line", PART | HIGH, without}};

/* Against gravity; as where a simulation finds it, for a case without placement. */
static void find_up(const mor_case *c, double *up)
{
    const double strength = mor_vector_length(c->gravity);
    for (int a = 0; a < 3; ++a) {
        up[a] = strength > 0.0 ? -c->gravity[a] / strength : (a == c->dimension - 1 ? 1.0 : 0.0);
    }
}

/* How a probe lies to one periodic axis: what of the list above it has. */
static unsigned find_relations(const mor_case_probe *probe, const double *up, int axis)
{
    const double rise = mor_vector_dot(probe->direction, up);
    const double level = probe->direction[axis] - rise * up[axis];
    const double along = fabs(probe->direction[axis]);
    const double radial = 1.0 - up[axis] * up[axis];
    unsigned relations = SHAPE;
    relations |= (probe->is_radial ? radial : along) > ACROSS ? ALONG : 0U;
    relations |= fabs(level) > ACROSS ? LEVEL : 0U;
    relations |= fabs(up[axis]) > ACROSS ? TILT : 0U;
    relations |= along > ACROSS && along < 1.0 - ACROSS ? PLANE : 0U;
    relations |= along < 1.0 - ACROSS ? ARM : 0U;
    relations |= probe->region != NULL && (along > ACROSS || fabs(level) > ACROSS) ? PART : 0U;
    relations |= probe->region != NULL && (relations & TILT) != 0 ? HIGH : 0U;
    return relations;
}

static const char *tell_relation(unsigned relations)
{
    return (relations & PLANE) != 0           ? "whose plane is inclined to"
           : (relations & ARM) != 0           ? "which counts arms of a moment along"
           : (relations & SHAPE) != 0         ? "which takes the form of a zone that may go on through a face across"
           : (relations & (PART | HIGH)) != 0 ? "of the places in a region, which soil leaves and comes back to, along"
           : (relations & (ALONG | LEVEL)) != 0
               ? "of places along"
               : "of heights against a gravity that is inclined, so that soil comes back higher than it left, to";
}

/* The profile of a deposit is of its heights as well. */
static unsigned find_refused(const rule *it, const mor_case_probe *probe)
{
    return it->refused | (strcmp(probe->measure, "thickness") == 0 ? TILT : 0U);
}

mor_status mor_case_reader_periodic_probe(mor_context *context, const mor_case *the_case, const mor_case_probe *probe)
{
    double up[3];
    find_up(the_case, up);
    if (probe->n_path > 0) {
        return MOR_FAIL(
            context, MOR_ERROR_CONFIG,
            "%s:%d: found domain.periodic with probe '%s' of type %s on a path; allowed is one of both, for "
            "soil comes back to the path; give it a direction in place of the path",
            probe->place.file, probe->place.line, probe->name, probe->type);
    }
    for (size_t k = 0; k < sizeof rules / sizeof *rules; ++k) {
        for (int a = 0; a < 3 && strcmp(rules[k].type, probe->type) == 0; ++a) {
            const unsigned found =
                mor_case_is_periodic(the_case, a) ? find_relations(probe, up, a) & find_refused(&rules[k], probe) : 0U;
            if (found != 0) {
                return MOR_FAIL(
                    context, MOR_ERROR_CONFIG,
                    "%s:%d: found probe '%s' of type %s, %s the periodic axis %c; soil comes back to places "
                    "along it, so that this has no meaning; allowed are probes that do not ask for it; %s",
                    probe->place.file, probe->place.line, probe->name, probe->type, tell_relation(found), "xyz"[a],
                    rules[k].remedy);
            }
        }
    }
    return MOR_OK;
}
