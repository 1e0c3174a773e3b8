/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The run that a case starts from, and what of both must agree. */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/io/checkpoint.h"

#include <stdio.h>
#include <string.h>

/* The case of the run: its settings, and its file as text. */
typedef struct earlier_run {
    mor_case *settings; /* those of the top level, placement and scale */
    mor_case_file *file;
} earlier_run;

/* ---- Agreement --------------------------------------------------------------------------------------------------- */

static mor_status refuse_number(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                                const char *what, double found, double allowed)
{
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found %s %.9g in this case, but %.9g in the case of the run '%s' that it starts from; "
                              "allowed: the same, because the particles are those of the run; correct it",
                              what, found, allowed, the_case->stage.run);
}

static mor_status check_settings(const mor_case_reader *reader, const mor_case_node *node, const mor_case *now,
                                 const mor_case *before)
{
    const struct {
        const char *what;
        double found, allowed;
    } numbers[] = {{"dimension =", now->dimension, before->dimension},
                   {"spacing [m] =", now->spacing, before->spacing},
                   {"placement.angle [rad] =", now->placement_angle, before->placement_angle},
                   {"placement.translation along x [m] =", now->translation[0], before->translation[0]},
                   {"placement.translation along y [m] =", now->translation[1], before->translation[1]},
                   {"placement.translation along z [m] =", now->translation[2], before->translation[2]},
                   {"scale.length =", now->scale_length, before->scale_length},
                   {"scale.time =", now->scale_time, before->scale_time},
                   {"scale.mass =", now->scale_mass, before->scale_mass}};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        if (numbers[k].found != numbers[k].allowed) {
            return refuse_number(reader, node, now, numbers[k].what, numbers[k].found, numbers[k].allowed);
        }
    }
    for (int a = 0; a < 3 && now->placement_angle != 0.0; ++a) {
        if (now->placement_axis[a] != before->placement_axis[a]) {
            return refuse_number(reader, node, now, "a component of placement.axis =", now->placement_axis[a],
                                 before->placement_axis[a]);
        }
    }
    return MOR_OK;
}

static const char *text_of(const mor_case_node *node)
{
    return node != NULL && node->kind == MOR_CASE_NODE_TEXT ? node->text : "";
}

/* Marks the fields of a soil whose parameters varied in the same soil of the run. */
static void mark_fields(mor_case_soil *soil, const mor_case_node *before)
{
    const mor_case_node *fields = mor_case_node_find(before, "fields");
    for (const mor_case_node *node = fields == NULL ? NULL : fields->first_child; node != NULL; node = node->next) {
        for (int k = 0; k < soil->n_fields; ++k) {
            const bool is_it = strcmp(text_of(mor_case_node_find(node, "parameter")), soil->fields[k].parameter) == 0;
            soil->fields[k].is_taken = soil->fields[k].is_taken || is_it;
        }
    }
}

/* Finds the density that a soil had in the run, kg/m3; leaves it where none is written. */
static mor_status read_density(const mor_case_reader *reader, const mor_case_node *before, double *density)
{
    const mor_case_node *node = mor_case_node_find(mor_case_node_find(before, "material"), "density");
    const mor_case_key *keys = mor_case_material_group.keys;
    const mor_schema *schema = &keys[mor_case_key_find(keys, "density")].schema;
    return node == NULL ? MOR_OK : mor_case_reader_numbers(reader, node, schema, false, density);
}

/* Finds the region of the run that has the name of a soil, and compares their laws. */
static mor_status find_region(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case, int soil,
                              const mor_case_node *soils, int *region)
{
    mor_case_soil *it = &the_case->soils[soil];
    double density = it->density;
    int index = 0;
    *region = -1;
    for (const mor_case_node *other = soils == NULL ? NULL : soils->first_child; other != NULL;
         other = other->next, ++index) {
        const char *model = text_of(mor_case_node_find(mor_case_node_find(other, "material"), "model"));
        if (strcmp(text_of(mor_case_node_find(other, "name")), it->name) != 0) {
            continue;
        }
        if (strcmp(model, it->model) != 0) {
            return MOR_CASE_NODE_FAIL(reader->context, node,
                                      "found the model '%s' of the soil '%s' in this case (line %d), but '%s' in the "
                                      "run '%s' that it starts from; allowed: the same model, whose state is taken "
                                      "over, with any parameters; correct it, or give the soil another name, which "
                                      "makes it new",
                                      it->model, it->name, it->place.line, model, the_case->stage.run);
        }
        mark_fields(it, other);
        MOR_TRY(reader->context, read_density(reader, other, &density));
        the_case->stage.density_ratio[soil] = it->density / density;
        *region = index;
    }
    return MOR_OK;
}

static mor_status check_region(const mor_case_reader *reader, const mor_case_node *node, const mor_case_soil *it,
                               int region)
{
    if (region >= 0 && it->initial_stress == MOR_CASE_STRESS_SETTLED) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a settled initial stress of the soil '%s' (line %d), which is taken over from "
                                  "a run with the stress that it has there; allowed: any other type, which has no "
                                  "effect on it; remove it, and let the run before end at rest",
                                  it->name, it->place.line);
    }
    if (region < 0 && (it->is_relaxed || it->initial_stress == MOR_CASE_STRESS_SETTLED)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found the soil '%s' (line %d), new in a case that starts from a run, with %s; "
                                  "allowed: particles on the lattice, with an initial stress that needs no settling; "
                                  "correct it",
                                  it->name, it->place.line,
                                  it->is_relaxed ? "relaxed particles" : "a settled initial stress");
    }
    return MOR_OK;
}

static mor_status find_regions(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case,
                               const mor_case_node *before)
{
    const mor_case_node *soils = mor_case_node_find(before, "soil");
    bool takes_any = the_case->n_soils == 0;
    for (int k = 0; k < the_case->n_soils; ++k) {
        int *region = &the_case->stage.region_of[k];
        MOR_TRY(reader->context, find_region(reader, node, the_case, k, soils, region));
        MOR_TRY(reader->context, check_region(reader, node, &the_case->soils[k], *region));
        takes_any = takes_any || *region >= 0;
    }
    if (!takes_any) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found no soil of this case with the name of one of the run '%s'; allowed: at least "
                                  "one, which is taken over; give it the name that it has there",
                                  the_case->stage.run);
    }
    return MOR_OK;
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static mor_status read_settings(const mor_case_reader *reader, const mor_case_node *root, mor_case *settings)
{
    mor_case_reader other = *reader;
    other.dimension = 3; /* vectors of the case as it was used have three numbers */
    MOR_TRY(reader->context, mor_case_reader_group(&other, root, &mor_case_root_group, settings));
    for (const mor_case_group *group = mor_case_settings_groups; group->name != NULL; ++group) {
        if (strcmp(group->name, "placement") == 0 || strcmp(group->name, "scale") == 0) {
            MOR_TRY(reader->context,
                    mor_case_reader_group(&other, mor_case_node_find(root, group->name), group, settings));
        }
    }
    return MOR_OK;
}

static mor_status open_run(const mor_case_reader *reader, const mor_case_node *node, const char *folder,
                           earlier_run *run)
{
    char *text = NULL;
    mor_status status = mor_checkpoint_read_identity(reader->context, folder, &text);
    if (status != MOR_OK && status != MOR_ERROR_MEMORY) {
        char why[MOR_CONTEXT_MESSAGE_BYTES];
        snprintf(why, sizeof why, "%.1500s", reader->context->message);
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found start_from = \"%s\", whose checkpoint cannot be used: %s; allowed: the folder "
                                  "of a run of this version of the program; run it again",
                                  folder, why);
    }
    MOR_TRY(reader->context, status);
    status = mor_case_file_parse(reader->context, folder, text, (int64_t)strlen(text), &run->file);
    MOR_FREE(reader->context, &text);
    MOR_TRY(reader->context, status);
    MOR_TRY(reader->context, MOR_NEW(reader->context, &run->settings, 1, "settings of a run"));
    return read_settings(reader, mor_case_file_root(run->file), run->settings);
}

/* The folder by its checkpoint, whose content is kept in mind. */
static mor_status locate_run(const mor_case_reader *reader, const mor_case_node *node, mor_case_stage *stage)
{
    char file[MOR_CASE_TEXT_BYTES];
    const int n = snprintf(file, sizeof file, "%s/%s", stage->run, MOR_CHECKPOINT_FILE);
    if (n >= (int)sizeof file) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a path of %d letters to a run; allowed: fewer than %d; shorten it", n,
                                  (int)sizeof file);
    }
    const mor_status status =
        mor_case_reader_locate(reader, node, "a run to start from without a checkpoint, or one", file, &stage->hash);
    if (status == MOR_ERROR_CONFIG) {
        mor_context *context = reader->context;
        const size_t used = strlen(context->message);
        snprintf(context->message + used, sizeof context->message - used,
                 ": start_from names the folder of the stage before, which has to run first; of a sweep, that of a "
                 "member");
    }
    MOR_TRY(reader->context, status);
    snprintf(stage->run, sizeof stage->run, "%.*s", (int)(strlen(file) - strlen("/" MOR_CHECKPOINT_FILE)), file);
    return MOR_OK;
}

static mor_status read_excavations(const mor_case_reader *reader, const mor_case_node *root, mor_case_stage *stage)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "excavate", MOR_CASE_EXCAVATIONS_MAX, &list));
    if (list != NULL && stage->run[0] == '\0') {
        return MOR_CASE_NODE_FAIL(reader->context, list,
                                  "found 'excavate' without 'start_from'; allowed: with the run whose soil is "
                                  "excavated; add start_from, or cut the shapes of soil with a difference");
    }
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        const int k = stage->n_excavations++;
        MOR_TRY(reader->context,
                mor_case_reader_shape(reader, node, &stage->excavation_outlines[k], &stage->excavations[k]));
    }
    return MOR_OK;
}

mor_status mor_case_reader_stage(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    mor_case_stage *stage = &the_case->stage;
    const mor_case_node *node = mor_case_node_find(root, "start_from");
    earlier_run run = {NULL, NULL};
    for (int k = 0; k < MOR_CASE_SOILS_MAX; ++k) {
        stage->region_of[k] = -1;
        stage->density_ratio[k] = 1.0;
    }
    MOR_TRY(reader->context, read_excavations(reader, root, stage));
    if (stage->run[0] == '\0') {
        return MOR_OK;
    }
    mor_case_reader_place(node, &stage->place);
    stage->place.line = node->line;
    MOR_TRY(reader->context, locate_run(reader, node, stage));
    mor_status status = open_run(reader, node, stage->run, &run);
    if (status == MOR_OK) {
        status = check_settings(reader, node, the_case, run.settings);
    }
    if (status == MOR_OK) {
        status = find_regions(reader, node, the_case, mor_case_file_root(run.file));
    }
    mor_case_file_free(reader->context, &run.file);
    MOR_FREE(reader->context, &run.settings);
    return status;
}
