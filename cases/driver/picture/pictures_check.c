/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Whether the pictures that a case asks for can be drawn. */
#include "cases/driver/picture/pictures.h"

#include "cases/driver/picture/picture_color.h"

#include <string.h>

mor_status mor_pictures_check(mor_context *context, const mor_case *the_case, mor_set *const *sets, int n_sets)
{
    const char *name = the_case->output.color_field;
    char names[MOR_PICTURE_COLOR_NAMES_BYTES];
    char advice[MOR_PICTURE_COLOR_NAMES_BYTES];
    mor_picture_color_words words = {.n = 0};
    bool has_soil = false;
    bool is_found = false;
    for (int k = 0; k < n_sets; ++k) {
        has_soil = has_soil || (strcmp(sets[k]->name, MOR_PICTURE_SOIL_SET) == 0 && sets[k]->n_particles > 0);
    }
    for (int k = 0; k < n_sets; ++k) {
        for (int f = 0; f < sets[k]->n_fields && mor_picture_color_is_for(sets[k]->name, has_soil); ++f) {
            if (sets[k]->data[f] != NULL && (sets[k]->fields[f].flags & MOR_FIELD_OUTPUT) != 0) {
                mor_picture_color_offer(sets[k]->fields[f].name, sets[k]->fields[f].n_components, &words);
            }
        }
    }
    for (int k = 0; k < words.n; ++k) {
        is_found = is_found || strcmp(words.of[k], name) == 0;
    }
    mor_picture_color_names(names);
    mor_picture_color_advise(&words, name, advice);
    MOR_CHECK(context, is_found, MOR_ERROR_CONFIG,
              "%s: found output.color = \"%s\", which is no number or vector of the snapshots of %s; allowed: %s (of "
              "stress only where there is stress) and the fields of 1 or 3 components that the list of fields shows as "
              "in snapshots; %s",
              the_case->path, name, has_soil ? "the soil" : "the bodies", names, advice);
    return MOR_OK;
}
