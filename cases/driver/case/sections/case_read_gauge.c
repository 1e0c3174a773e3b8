/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_sections.h"

#include "core/base/math.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Gauges, and what they have in common with probes: names of what is measured, regions, directions. */

/* ---- Shared with probes ------------------------------------------------------------------------------------------ */

/* Child: the key that holds the name; NULL when it was not written. */
static mor_status check_known(const mor_case_reader *reader, const mor_case_node *child, const char *what,
                              const char *name, const char *const *words, int n_words)
{
    for (int k = 0; k < n_words; ++k) {
        if (strcmp(words[k], name) == 0) {
            return MOR_OK;
        }
    }
    return child == NULL ? MOR_OK : mor_case_reader_refuse(reader, child, what, words, n_words);
}

/* The names of bodies without the long list of rocks. */
static void list_bodies(const mor_case *the_case, char *text, size_t text_bytes)
{
    enum { LISTED_MAX = 8 };
    size_t used = 0;
    const int n_listed = the_case->n_listed_bodies < LISTED_MAX ? the_case->n_listed_bodies : LISTED_MAX;
    text[0] = '\0';
    for (int k = 0; k < n_listed && used < text_bytes; ++k) {
        used += (size_t)snprintf(text + used, text_bytes - used, "%s%s", k > 0 ? ", " : "", the_case->bodies[k].name);
    }
    if (n_listed < the_case->n_listed_bodies && used < text_bytes) {
        used += (size_t)snprintf(text + used, text_bytes - used, " and %d more", the_case->n_listed_bodies - n_listed);
    }
    for (int k = 0; k < the_case->n_rocks && used < text_bytes; ++k) {
        const mor_case_rocks *rocks = &the_case->rocks[k];
        used += (size_t)snprintf(text + used, text_bytes - used, "%s%s_1 to %s_%d", used > 0 ? ", " : "",
                                 rocks->body.name, rocks->body.name, rocks->n_rocks);
    }
}

static mor_status check_body(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                             const char *name, const char *const *bodies)
{
    char found[MOR_CASE_NODE_TEXT_BYTES];
    char path[MOR_CASE_NODE_TEXT_BYTES];
    char allowed[MOR_CASE_NODE_TEXT_BYTES];
    const mor_case_node *child = mor_case_node_find(node, "body");
    if (the_case->n_rocks == 0) {
        return check_known(reader, child, "name of a body", name, bodies, the_case->n_bodies);
    }
    for (int k = 0; k < the_case->n_bodies; ++k) {
        if (strcmp(bodies[k], name) == 0) {
            return MOR_OK;
        }
    }
    if (child == NULL) {
        return MOR_OK;
    }
    mor_case_node_path(child, path, sizeof path);
    mor_case_node_format(child, found, sizeof found);
    list_bodies(the_case, allowed, sizeof allowed);
    return MOR_CASE_NODE_FAIL(
        reader->context, child,
        "found %s = %s; allowed: %s (name of a body; rocks are numbered from the largest of those "
        "that were placed); use one of these",
        path, found, allowed);
}

mor_status mor_case_reader_known(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                                 const char *key, const char *name)
{
    const char *names[MOR_CASE_BODIES_MAX];
    const mor_case_node *child = mor_case_node_find(node, key);
    int n = 0;
    if (strcmp(key, "wall") == 0) {
        for (; n < the_case->n_walls; ++n) {
            names[n] = the_case->walls[n].name;
        }
        return check_known(reader, child, "name of a wall", name, names, n);
    }
    if (strcmp(key, "soil") == 0) {
        for (; n < the_case->n_soils; ++n) {
            names[n] = the_case->soils[n].name;
        }
        return check_known(reader, child, "name of a soil", name, names, n);
    }
    if (strcmp(key, "gauge") == 0) {
        for (; n < the_case->n_gauges; ++n) {
            names[n] = the_case->gauges[n].name;
        }
        return check_known(reader, child, "name of a gauge", name, names, n);
    }
    for (; n < the_case->n_bodies; ++n) {
        names[n] = the_case->bodies[n].name;
    }
    return check_body(reader, node, the_case, name, names);
}

mor_status mor_case_reader_region(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline,
                                  mor_shape **region)
{
    const mor_case_node *child = mor_case_node_find(node, "region");
    if (child == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "region", MOR_CASE_NODE_GROUP, &child));
    return mor_case_reader_shape(reader, child, outline, region);
}

void mor_case_reader_unit_vector(double *direction)
{
    const double largest = fmax(fabs(direction[0]), fmax(fabs(direction[1]), fabs(direction[2])));
    double scaled[3];
    for (int a = 0; a < 3; ++a) {
        scaled[a] = direction[a] / largest; /* so that squares neither vanish nor overflow */
    }
    const double length = mor_vector_length(scaled) * largest;
    if (fabs(length - 1.0) <= 1.0e-15) { /* a few units in the last place: what a second pass would change */
        return;
    }
    for (int a = 0; a < 3; ++a) {
        direction[a] /= length;
    }
}

/* ---- Gauges ------------------------------------------------------------------------------------------------------ */

/* Of two keys that exclude each other at most one may be there, or exactly one. */
static mor_status check_either(const mor_case_reader *reader, const mor_case_node *node, const char *first,
                               const char *second, bool is_required)
{
    const mor_case_node *one = mor_case_node_find(node, first);
    const mor_case_node *other = mor_case_node_find(node, second);
    if (one != NULL && other != NULL) {
        return MOR_CASE_NODE_FAIL(reader->context, other,
                                  "found '%s' beside '%s' in a gauge; allowed: one of them; remove the other", second,
                                  first);
    }
    if (is_required && one == NULL && other == NULL) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found neither '%s' nor '%s' in a gauge; allowed: one of them, the structure that "
                                  "it measures; add it",
                                  first, second);
    }
    return MOR_OK;
}

static mor_status check_cell(const mor_case_reader *reader, const mor_case_node *node, const mor_case_gauge *gauge)
{
    if (!isnan(gauge->cell) && gauge->cell < reader->spacing) {
        return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(node, "cell"),
                                  "found cells of %g m in a gauge; allowed: no smaller than the spacing, %g m, which "
                                  "is all that the soil resolves; use larger cells",
                                  gauge->cell, reader->spacing);
    }
    return MOR_OK;
}

static mor_status read_gauge(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                             mor_case_gauge *gauge)
{
    mor_case_reader_place(node, &gauge->place);
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_gauge_group, NULL, NULL));
    MOR_TRY(reader->context, check_either(reader, node, "wall", "body", true));
    MOR_TRY(reader->context, check_either(reader, node, "filter", "cutoff", false));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_gauge_group, gauge));
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "direction", gauge->direction));
    MOR_TRY(reader->context, mor_case_reader_known(reader, node, the_case, "wall", gauge->wall));
    MOR_TRY(reader->context, mor_case_reader_known(reader, node, the_case, "body", gauge->body));
    MOR_TRY(reader->context, check_cell(reader, node, gauge));
    mor_case_reader_unit_vector(gauge->direction);
    for (const mor_case_gauge *other = the_case->gauges; other < gauge; ++other) {
        if (strcmp(other->name, gauge->name) == 0) {
            return mor_case_reader_refuse_duplicate(reader, node, gauge->name, &other->place);
        }
    }
    return mor_case_reader_region(reader, node, &gauge->region_outline, &gauge->region);
}

mor_status mor_case_reader_gauges(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case)
{
    const mor_case_node *list = NULL;
    MOR_TRY(reader->context, mor_case_reader_list(reader, root, "gauges", MOR_CASE_GAUGES_MAX, &list));
    for (const mor_case_node *node = list == NULL ? NULL : list->first_child; node != NULL; node = node->next) {
        /* Counted before it is read, so that a half-read one is freed, too. */
        mor_case_gauge *gauge = &the_case->gauges[the_case->n_gauges++];
        MOR_TRY(reader->context, read_gauge(reader, node, the_case, gauge));
    }
    return MOR_OK;
}
