/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"

#include "cases/driver/case/schema/case_schema_words.h"
#include "core/particle/field.h"

#include <math.h>

/* Rocks packed into a region: what is packed, how, and what its bodies have in common. */
#define ROCKS(member) AT(mor_case_rocks, member)

enum { NUMBER_BYTES = 5 }; /* of the number after the name of a body: _4096 */

static const mor_case_key rocks_keys[] = {
    {{"name", WORDS, "1", REQUIRED, ANY, NULL, "the bodies are named after it: name_1, name_2, ..., largest first"},
     MOR_CASE_STORE_NAME,
     .offset = offsetof(mor_case_rocks, body.name),
     .size = MOR_FIELD_NAME_BYTES - NUMBER_BYTES},
    {{"content", SCALAR, "1", DEFAULT(NAN), INSIDE(0.0, 1.0), NULL,
      "volume of the rocks / volume of the region (areas in plane strain); give content, count or list"},
     MOR_CASE_STORE_REALS,
     ROCKS(content),
     .computed = "follows from the others"},
    {{"count", WHOLE, "1", DEFAULT(0.0), BETWEEN(0.0, MOR_CASE_BODIES_MAX), NULL,
      "number of rocks; give content, count or list"},
     MOR_CASE_STORE_INT,
     ROCKS(count),
     .computed = "follows from the others"},
    {{"list", WORDS, "1", DEFAULT(0.0), ANY, NULL,
      "table of rocks, a .csv with columns x, y, z, diameter and, optionally, density; path from the folder of the "
      "case "
      "file; give content, count or list"},
     MOR_CASE_STORE_TEXT,
     ROCKS(list)},
    {{"gap", SCALAR, "m", DEFAULT(NAN), NOT_NEGATIVE, NULL,
      "smallest distance between two rocks, and to listed bodies"},
     MOR_CASE_STORE_REALS,
     ROCKS(gap),
     .computed = "spacing"},
    {{"margin", SCALAR, "m", DEFAULT(NAN), ANY, NULL,
      "smallest distance of a rock from the surface of the region; negative: a rock may protrude by as much"},
     MOR_CASE_STORE_REALS,
     ROCKS(margin),
     .computed = "spacing"},
    {{"n_forms", WHOLE, "1", DEFAULT(8.0), BETWEEN(1.0, 16.0), NULL,
      "number of random rocks made from each form of type rock, with consecutive seeds"},
     MOR_CASE_STORE_INT,
     ROCKS(n_variants)},
    {{"seed", WHOLE, "1", DEFAULT(1.0), NOT_NEGATIVE, NULL, "seed of the random positions and orientations"},
     MOR_CASE_STORE_SEED,
     ROCKS(seed)},
    {{"velocity", VECTOR, "m/s", DEFAULT(0.0), ANY, NULL, "initial velocity of the centers of mass"},
     MOR_CASE_STORE_REALS,
     ROCKS(body.velocity)},
    {{"friction", CHOICE, "1", DEFAULT(0.0), ANY, "rough|smooth|coulomb", "with soil, as of a body"},
     MOR_CASE_STORE_CHOICE,
     ROCKS(body.soil_friction)},
    {{"friction_coefficient", SCALAR, "1", DEFAULT(0.0), NOT_NEGATIVE, NULL,
      "Coulomb friction coefficient with soil; required with coulomb, not allowed otherwise"},
     MOR_CASE_STORE_REALS,
     ROCKS(body.soil_friction_coefficient)},
    {{"contact_modulus", SCALAR, "Pa", DEFAULT(NAN), POSITIVE, NULL, "as of a body"},
     MOR_CASE_STORE_REALS,
     ROCKS(body.contact_modulus),
     .computed = "as of a body"},
    {{"contact_poissons_ratio", SCALAR, "1", DEFAULT(0.25), BELOW(0.0, 0.5), NULL, "as of a body"},
     MOR_CASE_STORE_REALS,
     ROCKS(body.contact_poisson)},
    {{"particles", CHOICE, "1", DEFAULT(0.0), ANY, "by_shape|lattice|relaxed", "as of a body"},
     MOR_CASE_STORE_CHOICE,
     ROCKS(body.particles)},
    END};

static const mor_case_part rocks_parts[] = {
    {"region", false, "shape",
     "where the rocks are packed, in the frame of the case; bounded in every direction; required unless list is given"},
    {"sizes", false, "list of groups",
     "size distribution curve, from the smallest; a single entry: all rocks have that size; required unless list is "
     "given"},
    {"forms", true, "list of groups",
     "rock, sphere, ellipsoid, outline or mesh; each rock gets one at random, scaled to its size"},
    {"material", true, "group", "as of a body"},
    {"friction_with", false, "list of groups", "as of a body"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_case_rocks_group = {"rocks", "Rocks packed into a region (list)", rocks_keys, rocks_parts,
                                             offsetof(mor_case_rocks, written)};

static const mor_case_key size_keys[] = {
    {{"diameter", SCALAR, "m", REQUIRED, POSITIVE, NULL, "diameter of the ball (disc) of the same volume (area)"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_size, diameter)},
    {{"passing", SCALAR, "1", REQUIRED, BETWEEN(0.0, 1.0), NULL,
      "volume fraction of the rocks up to this diameter; the last is 1"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_size, passing)},
    END};

const mor_case_group mor_case_size_group = {"sizes", "Size distribution curve (list)", size_keys, NULL,
                                            offsetof(mor_case_size, written)};

static const mor_case_key file_keys[] = {
    {{"file", WORDS, "1", REQUIRED, ANY, NULL, "path from the folder of the case file"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_shape, form.file)},
    END};

static const mor_case_key sphere_form_keys[] = {END};

static const mor_case_key ellipsoid_form_keys[] = {
    {{"elongation", SCALAR, "1", DEFAULT(0.75), BETWEEN(0.1, 1.0), NULL,
      "intermediate over longest axis; short over long axis in plane strain"},
     SHAPE(form.elongation)},
    {{"flatness", SCALAR, "1", DEFAULT(0.75), BETWEEN(0.1, 1.0), NULL,
      "shortest over intermediate axis; without effect in plane strain"},
     SHAPE(form.flatness)},
    END};

/* The keys of a rock but for its diameter, which is the first. */
const mor_case_group mor_case_rock_form_groups[MOR_CASE_ROCK_FORM_COUNT] = {
    {"rock", "Random form", mor_case_rock_keys + 1, NULL, offsetof(mor_case_shape, written)},
    {"sphere", "Form of a ball; a disc in plane strain", sphere_form_keys, NULL, offsetof(mor_case_shape, written)},
    {"ellipsoid", "Form of an ellipsoid; an ellipse in plane strain", ellipsoid_form_keys, NULL,
     offsetof(mor_case_shape, written)},
    {"outline", "Form of an outline from a file, in plane strain", file_keys, NULL, offsetof(mor_case_shape, written)},
    {"mesh", "Form of a mesh from a file, in space", file_keys, NULL, offsetof(mor_case_shape, written)}};

const mor_case_shape_kind mor_case_rock_form_kinds[MOR_CASE_ROCK_FORM_COUNT] = {
    MOR_CASE_SHAPE_ROCK, MOR_CASE_SHAPE_SPHERE, MOR_CASE_SHAPE_ELLIPSOID, MOR_CASE_SHAPE_OUTLINE, MOR_CASE_SHAPE_MESH};

const mor_case_group *mor_case_rock_form_group(mor_case_shape_kind kind)
{
    int k = 0;
    while (mor_case_rock_form_kinds[k] != kind) {
        ++k;
    }
    return &mor_case_rock_form_groups[k];
}
