/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_sections.h"

#include <stdio.h>
#include <string.h>

/* The wall that gives the grid: the one named, else the only terrain there is. */
static mor_status find_ground(const mor_case_reader *reader, const mor_case_node *node, mor_case *the_case)
{
    const char *words[MOR_CASE_WALLS_MAX];
    int n_words = 0;
    mor_case_maps *maps = &the_case->maps;
    const bool is_given = mor_case_reader_has(&mor_case_maps_group, maps->written, "ground");
    for (int k = 0; k < the_case->n_walls; ++k) {
        if (the_case->walls[k].outline.kind == MOR_CASE_SHAPE_TERRAIN) {
            words[n_words++] = the_case->walls[k].name;
        }
    }
    for (int k = 0; k < n_words; ++k) {
        if (is_given && strcmp(words[k], maps->ground) == 0) {
            return MOR_OK;
        }
    }
    if (is_given && n_words > 0) {
        return mor_case_reader_refuse(reader, mor_case_node_find(node, "ground"), "wall of type terrain", words,
                                      n_words);
    }
    if (is_given) {
        return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(node, "ground"),
                                  "found ground = \"%s\", but no wall has a shape of type \"terrain\"; allowed: the "
                                  "name of such a wall; leave it out for a grid over the domain",
                                  maps->ground);
    }
    if (n_words > 1) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found maps without 'ground' and %d walls of type terrain; allowed: the name of one; "
                                  "add ground = \"%s\"",
                                  n_words, words[0]);
    }
    snprintf(maps->ground, sizeof maps->ground, "%s", n_words == 1 ? words[0] : "");
    return MOR_OK;
}

mor_status mor_case_reader_maps(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    const mor_case_node *node = mor_case_node_find(root, "maps");
    mor_case_maps *maps = &the_case->maps;
    if (node == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, mor_case_reader_member(reader, root, "maps", MOR_CASE_NODE_GROUP, &node));
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_maps_group, NULL, NULL));
    if (reader->dimension == 2) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found maps in plane strain; allowed: with dimension = 3; use probes of height and "
                                  "run-out instead");
    }
    maps->is_wanted = true;
    mor_case_reader_place(node, &maps->place);
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_maps_group, maps));
    if (!mor_case_reader_has(&mor_case_maps_group, maps->written, "threshold")) {
        maps->threshold = 0.5 * the_case->spacing;
    }
    if (!mor_case_reader_has(&mor_case_maps_group, maps->written, "duration_depth")) {
        maps->duration_depth = maps->threshold;
    }
    return find_ground(reader, node, the_case);
}
