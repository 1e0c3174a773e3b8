/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_boulders.h"

#include "cases/driver/probe/probe_boulder.h"
#include "cases/driver/probe/probe_track.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <math.h>
#include <string.h>

enum { COLUMN_BYTES = MOR_CASE_NAME_BYTES + 8 };

/* First probe of a type from a number on; -1: there is none. */
static int find_probe(const mor_case *c, const char *type, int first)
{
    for (int k = first; k < c->n_probes; ++k) {
        if (strcmp(c->probes[k].type, type) == 0) {
            return k;
        }
    }
    return -1;
}

static const mor_body *find_body(const mor_simulation *s, int k)
{
    return &s->bodies.of[k].group->bodies[s->bodies.of[k].index];
}

/* Bodies that move freely, but for those that were removed before this run began. */
static bool is_listed(const mor_simulation *s, int k)
{
    return !find_body(s, k)->is_held && !find_body(s, k)->is_absent;
}

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

/* Names of the columns: NAME_x, NAME_y, NAME_z. */
static mor_status open_table(mor_context *context, mor_run_boulders *it, const mor_simulation *s, const char *path,
                             bool is_resume)
{
    const int n = 1 + 3 * it->n;
    mor_table_column *columns = NULL;
    char(*names)[COLUMN_BYTES] = NULL;
    mor_status status = MOR_NEW(context, &columns, n, "columns of a table");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &names, n, "columns of a table");
    }
    if (status == MOR_OK) {
        columns[0] = (mor_table_column){"time", "s"};
        for (int k = 1; k < n; ++k) {
            const char *name = s->the_case->bodies[it->bodies[(k - 1) / 3]].name;
            snprintf(names[k], COLUMN_BYTES, "%s_%c", name, "xyz"[(k - 1) % 3]);
            columns[k] = (mor_table_column){names[k], "m"};
        }
        status = is_resume ? mor_table_resume(context, &it->table, path, columns, n, mor_schedule_time(&s->schedule))
                           : mor_table_create(context, &it->table, path, columns, n);
    }
    MOR_FREE(context, &columns);
    MOR_FREE(context, &names);
    return status;
}

mor_status mor_run_boulders_open(mor_context *context, mor_run_boulders *it, const mor_simulation *simulation,
                                 const char *folder, bool is_resume)
{
    char path[MOR_PATH_BYTES];
    const mor_case *c = simulation->the_case;
    if (find_probe(c, MOR_PROBE_TRAVEL, 0) < 0) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &it->bodies, c->n_bodies, "free bodies"));
    for (int k = 0; k < c->n_bodies; ++k) {
        if (is_listed(simulation, k)) {
            it->bodies[it->n++] = k;
        }
    }
    MOR_TRY(context, MOR_NEW(context, &it->row, 1 + 3 * (int64_t)it->n, "a row of a table"));
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_RUN_BOULDER_PATHS_FILE));
    return open_table(context, it, simulation, path, is_resume);
}

mor_status mor_run_boulders_add_row(mor_context *context, mor_run_boulders *it, const mor_simulation *simulation)
{
    if (it->table.stream == NULL) {
        return MOR_OK;
    }
    it->row[0] = mor_schedule_time(&simulation->schedule);
    for (int k = 0; k < it->n; ++k) {
        double *place = it->row + 1 + 3 * (int64_t)k;
        mor_simulation_take_point_back(simulation->the_case, find_body(simulation, it->bodies[k])->center, place);
        if (!mor_simulation_body_is_there(&simulation->bodies, it->bodies[k])) {
            place[0] = place[1] = place[2] = NAN;
        }
    }
    return mor_table_append(context, &it->table, it->row);
}

mor_status mor_run_boulders_sync(mor_context *context, mor_run_boulders *it)
{
    return it->table.stream != NULL ? mor_table_sync(context, &it->table) : MOR_OK;
}

void mor_run_boulders_close(mor_context *context, mor_run_boulders *it)
{
    if (it->table.stream != NULL) {
        mor_table_close(context, &it->table);
    }
    MOR_FREE(context, &it->bodies);
    MOR_FREE(context, &it->row);
    it->n = 0;
}

/* ---- At the end -------------------------------------------------------------------------------------------------- */

static void print_number(FILE *stream, double value)
{
    if (isfinite(value)) {
        fprintf(stream, ",%.9g", value);
    } else {
        fputc(',', stream); /* it did not happen */
    }
}

static void print_place(const mor_simulation *s, const double *placed, FILE *stream)
{
    double point[3];
    mor_simulation_take_point_back(s->the_case, placed, point);
    for (int a = 0; a < 3; ++a) {
        print_number(stream, point[a]);
    }
}

/* Diameter of the ball (disc) of the same volume (area), m. */
static double find_diameter(const mor_body *body, int dimension)
{
    const double pi = 3.14159265358979323846;
    const double volume = body->mass / body->density;
    return dimension == 2 ? 2.0 * sqrt(volume / pi) : 2.0 * cbrt(0.75 * volume / pi);
}

static void print_header(const mor_case *c, FILE *stream)
{
    const bool is_plane = c->dimension == 2;
    fprintf(stream,
            "boulder,diameter [m],mass [%s],x_start [m],y_start [m],z_start [m],x_end [m],y_end [m],z_end [m],"
            "path_length [m],largest_speed [m/s],time_of_it [s],last_speed [m/s],at_rest [1],removed [s]",
            is_plane ? "kg/m" : "kg");
    for (int k = find_probe(c, MOR_PROBE_PASSAGES, 0); k >= 0; k = find_probe(c, MOR_PROBE_PASSAGES, k + 1)) {
        fprintf(stream, ",%s_beyond [1],%s_time [s],%s_energy [%s]", c->probes[k].name, c->probes[k].name,
                c->probes[k].name, is_plane ? "J/m" : "J");
    }
    fputc('\n', stream);
}

static void print_boulder(const mor_simulation *s, int number, const mor_case_probe *travel, const double *own,
                          FILE *stream)
{
    const mor_case *c = s->the_case;
    const mor_body *body = find_body(s, number);
    const double nowhere[3] = {NAN, NAN, NAN};
    const double removed_at = c->bodies[number].removed_at;
    const bool is_removed = !mor_simulation_body_is_there(&s->bodies, number);
    const double speed = is_removed ? NAN : mor_vector_length(body->velocity);
    fprintf(stream, "%s,%.9g,%.9g", c->bodies[number].name, find_diameter(body, c->dimension), body->mass);
    print_place(s, own + MOR_PROBE_TRAVEL_START, stream);
    print_place(s, is_removed ? nowhere : body->center, stream);
    print_number(stream, own[MOR_PROBE_TRAVEL_LENGTH]);
    print_number(stream, own[MOR_PROBE_TRAVEL_FASTEST]);
    print_number(stream, own[MOR_PROBE_TRAVEL_TIME]);
    print_number(stream, speed);
    fprintf(stream, is_removed ? "," : ",%d", speed <= travel->speed);
    print_number(stream, is_removed ? removed_at : NAN);
    for (int k = find_probe(c, MOR_PROBE_PASSAGES, 0); k >= 0; k = find_probe(c, MOR_PROBE_PASSAGES, k + 1)) {
        const double *passage = s->probes->memory[k] + (int64_t)MOR_PROBE_PASSAGE_NUMBERS * number;
        fprintf(stream, ",%d", passage[MOR_PROBE_PASSAGE_SIDE] > 0.0);
        print_number(stream, passage[MOR_PROBE_PASSAGE_TIME]);
        print_number(stream, passage[MOR_PROBE_PASSAGE_ENERGY]);
    }
    fputc('\n', stream);
}

static void write_boulders(const mor_simulation *s, int probe, FILE *stream)
{
    print_header(s->the_case, stream);
    for (int k = 0; k < s->the_case->n_bodies; ++k) {
        if (is_listed(s, k)) {
            print_boulder(s, k, &s->the_case->probes[probe],
                          s->probes->memory[probe] + (int64_t)MOR_PROBE_TRAVEL_NUMBERS * k, stream);
        }
    }
}

/* By the numbers of the particles, which rise whatever their order in memory is; those that left are missing. */
static mor_status write_displacements(mor_context *context, const mor_simulation *s, int probe, FILE *stream)
{
    const mor_set *set = &s->soil.set;
    int64_t *places = NULL;
    MOR_TRY(context, MOR_NEW(context, &places, set->n_created + 1, "places of particles"));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        places[set->id[i]] = i + 1;
    }
    fprintf(stream, "particle,soil,x_start [m],y_start [m],z_start [m],x_end [m],y_end [m],z_end [m]\n");
    for (int64_t id = 0; id < set->n_created; ++id) {
        const int64_t i = places[id] - 1;
        if (i >= 0) {
            const int field = s->soil.region_field;
            double end[3];
            mor_soil_find_unwrapped(&s->soil, i, end); /* as the start */
            fprintf(stream, "%lld,%s", (long long)id,
                    s->the_case->soils[field < 0 ? 0 : (int)set->data[field][i]].name);
            print_place(s, s->probes->memory[probe] + 3 * id, stream);
            print_place(s, end, stream);
            fputc('\n', stream);
        }
    }
    MOR_FREE(context, &places);
    return MOR_OK;
}

mor_status mor_run_boulders_conclude(mor_context *context, const mor_simulation *simulation, const char *folder)
{
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    const int travel = find_probe(simulation->the_case, MOR_PROBE_TRAVEL, 0);
    const int displacement = find_probe(simulation->the_case, MOR_PROBE_DISPLACEMENT, 0);
    if (travel >= 0) {
        MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_RUN_BOULDERS_FILE));
        MOR_TRY(context, mor_durable_file_open(context, &file, path));
        write_boulders(simulation, travel, file.stream);
        MOR_TRY(context, mor_durable_file_commit(context, &file));
    }
    if (displacement < 0) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_RUN_DISPLACEMENTS_FILE));
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    const mor_status status = write_displacements(context, simulation, displacement, file.stream);
    if (status != MOR_OK) {
        mor_durable_file_discard(&file);
        return status;
    }
    return mor_durable_file_commit(context, &file);
}
