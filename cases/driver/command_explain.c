/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What `moraine explain` prints: sizes, clocks, expected time, warnings, stages. */
#include "cases/driver/command.h"

#include "cases/driver/clock.h"
#include "cases/driver/rocks_report.h"
#include "cases/driver/simulation.h"
#include "core/base/math.h"

static void print_stages(FILE *out, const mor_stepper *stepper, const mor_set *set)
{
    fprintf(out, "\nStages of a step of '%s'\n", stepper->name);
    for (int k = 0; k < stepper->n_stages; ++k) {
        const mor_stage *stage = &stepper->stages[k];
        fprintf(out, "  %2d %-20s %s\n", k + 1, stage->name, stage->text);
        const uint64_t bits[3] = {stage->reads, stage->writes, stage->accumulates};
        static const char *const verbs[3] = {"reads", "writes", "updates"};
        for (int verb = 0; verb < 3; ++verb) {
            if (bits[verb] == 0) {
                continue;
            }
            fprintf(out, "       %-8s", verbs[verb]);
            for (int bit = 0; bit < 64; ++bit) {
                if (bits[verb] >> bit & 1u) {
                    fprintf(out, " %s",
                            bit < set->n_fields               ? set->fields[bit].name
                            : bit == MOR_RESOURCE_RECORDS     ? "(records)"
                            : bit == MOR_RESOURCE_LISTS       ? "(lists)"
                            : bit == MOR_RESOURCE_SHORT_LISTS ? "(short lists)"
                                                              : "(wall sums)");
                }
            }
            fprintf(out, "\n");
        }
    }
}

/* Smallest distance of a soil particle from the face of a wall, in spacings. */
static double find_gap(const mor_simulation *s, int wall)
{
    const mor_case *c = s->the_case;
    const mor_shape *shape = c->walls[wall].shape;
    double nearest = INFINITY;
    for (int64_t i = 0; i < s->soil.set.n_particles; ++i) {
        const double *position = s->soil.set.data[MOR_FIELD_POSITION] + 3 * i;
        double moved[3];
        double local[3];
        for (int a = 0; a < 3; ++a) {
            moved[a] = position[a] - c->move[a];
        }
        mor_matrix_apply_transposed(c->turn, moved, local);
        nearest = fmin(nearest, shape->operations->distance(shape, local));
    }
    return nearest / c->spacing;
}

/* Soil that rests on a wall begins half a spacing off its face; nearer it is thrown off, farther it falls first. Soil
 * more than a spacing off, and a little for rounding, is not meant to touch. */
static void print_gaps(FILE *out, const mor_simulation *s)
{
    const double allowed = 0.2;
    const double touching = 1.01;
    for (int w = 0; w < s->the_case->n_walls && s->has_soil; ++w) {
        const double gap = find_gap(s, w);
        if (gap <= touching && fabs(gap - 0.5) > allowed) {
            fprintf(out,
                    "warning: the soil begins %.2f spacings off wall '%s', not 0.5, and will %s; put faces of walls "
                    "and soil a whole number of spacings from lattice.origin\n",
                    gap, s->the_case->walls[w].name, gap < 0.5 ? "be pushed away" : "fall against it");
        }
    }
}

/* Thinnest extent of the soil in spacings; warnings about what the method cannot resolve. */
static void print_warnings(FILE *out, const mor_simulation *s)
{
    enum { THIN = 8 };
    const mor_case *c = s->the_case;
    const double *position = s->soil.set.data[MOR_FIELD_POSITION];
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int64_t k = 0; k < 3 * s->soil.set.n_particles; ++k) {
        low[k % 3] = fmin(low[k % 3], position[k]);
        high[k % 3] = fmax(high[k % 3], position[k]);
    }
    for (int a = 0; a < c->dimension && s->has_soil; ++a) {
        const double n = (high[a] - low[a]) / c->spacing + 1.0;
        if (n < THIN) {
            fprintf(out,
                    "warning: the soil is only %.0f particles wide along %c; at least %d are advisable: choose a "
                    "smaller spacing\n",
                    n, "xyz"[a], THIN);
        }
    }
    print_gaps(out, s);
    if (c->n_walls == 0 && mor_vector_length(c->gravity) > 0.0) {
        fprintf(out, "warning: there is no wall; everything falls freely\n");
    }
    if (c->n_probes == 0) {
        fprintf(out, "warning: there is no probe; the run will report no result\n");
    }
}

/* Times a few steps on a state that is thrown away. */
static mor_status time_steps(mor_context *context, mor_simulation *s, double *seconds_per_step)
{
    enum { WARM_UP = 2, TIMED = 4 };
    for (int k = 0; k < WARM_UP; ++k) {
        MOR_TRY(context, mor_schedule_step(context, &s->schedule, s->schedule.end));
    }
    const double before = mor_clock_now();
    for (int k = 0; k < TIMED; ++k) {
        MOR_TRY(context, mor_schedule_step(context, &s->schedule, s->schedule.end));
    }
    *seconds_per_step = (mor_clock_now() - before) / TIMED;
    return MOR_OK;
}

static void print_sizes(FILE *out, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    int64_t n_walls = 0;
    for (int w = 0; w < s->soil.n_walls; ++w) {
        n_walls += s->soil.walls[w].n_points;
    }
    fprintf(out, "%s\n", c->title);
    fprintf(out, "  dimension            %d\n", c->dimension);
    fprintf(out, "  spacing              %g m\n", c->spacing);
    if (s->has_soil) {
        fprintf(out, "  soil                 %lld particles, smoothing length %g m, sound speed %.4g m/s\n",
                (long long)s->soil.set.n_particles, s->soil.smoothing_length, s->soil.sound_speed);
    }
    for (int g = 0; g < s->bodies.n_groups; ++g) {
        const mor_body_group *group = s->bodies.groups[g];
        fprintf(out, "  %-20s %d bodies, %lld particles, %lld surface nodes", group->set.name, group->n_bodies,
                (long long)group->set.n_particles, (long long)group->n_nodes);
        if (g < s->bodies.n_elastics) {
            fprintf(out, ", smoothing length %g m, sound speed %.4g m/s", s->bodies.elastics[g].smoothing_length,
                    s->bodies.elastics[g].sound_speed);
        }
        fprintf(out, "\n");
    }
    fprintf(out, "  walls                %d, %lld particles\n", c->n_walls, (long long)n_walls);
    mor_rocks_report_print(c, out);
}

/* The longest step of each stepper, and how often it moves in a common step. */
static void print_clocks(FILE *out, const mor_simulation *s, double length)
{
    const mor_schedule *schedule = &s->schedule;
    fprintf(out, "  time step            about %.4g s, limited by %s%s\n", length, schedule->limit,
            schedule->is_single_rate ? " (single rate)" : "");
    fprintf(out, "  steps                about %.0f for %g s\n", ceil(s->the_case->end / length), s->the_case->end);
    for (int k = 0; k < schedule->n_steppers; ++k) {
        fprintf(out, "  clock of %-11s ", schedule->steppers[k].name);
        if (schedule->proposals[k] < INFINITY) {
            fprintf(out, "longest step %.4g s, limited by %s; ", schedule->proposals[k], schedule->limits[k]);
        } else {
            fprintf(out, "any step; ");
        }
        fprintf(out, "%d sub-step%s per step\n", schedule->substeps[k], schedule->substeps[k] == 1 ? "" : "s");
    }
}

/* The set that a stepper works on; steppers stand in the order of the sets. */
static const mor_set *set_of(const mor_simulation *s, int stepper)
{
    const int g = stepper - (s->has_soil ? 1 : 0);
    return g < 0 ? &s->soil.set : &s->bodies.groups[g]->set;
}

mor_status mor_command_print_explanation(mor_command *command, mor_simulation *s)
{
    FILE *out = command->output;
    double length = 0.0;
    double seconds = 0.0;
    MOR_TRY(command->context, mor_schedule_preview(command->context, &s->schedule, &length));
    print_sizes(out, s);
    print_clocks(out, s, length);
    MOR_TRY(command->context, time_steps(command->context, s, &seconds));
    fprintf(out, "  memory               %.1f MiB", (double)command->context->memory_peak_bytes / 1048576.0);
    if (s->has_soil) {
        fprintf(out, ", %.0f bytes per soil particle", mor_soil_bytes_per_particle(&s->soil));
    }
    const int64_t n = s->has_soil ? s->soil.set.n_particles : mor_simulation_particles(s);
    fprintf(out, "\n  speed now            %.2f M particle-steps/s with %d threads (%s)\n", 1e-6 * (double)n / seconds,
            command->context->n_threads, mor_pair_select(NULL)->instruction_set);
    const double expected = ceil(s->the_case->end / length) * seconds;
    fprintf(out, "  expected time        %.1f %s\n", expected < 60.0 ? expected : expected / 60.0,
            expected < 60.0 ? "s" : "min");
    print_warnings(out, s);
    for (int k = 0; k < s->schedule.n_steppers; ++k) {
        print_stages(out, &s->schedule.steppers[k], set_of(s, k));
    }
    return MOR_OK;
}
