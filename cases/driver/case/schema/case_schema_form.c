/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"

#include "cases/driver/case/schema/case_schema_words.h"

#include <math.h>

/* Keys of the shapes of rocks: from a mesh, from an outline, of a random form. */

#define FORM(member) SHAPE(form.member)
#define FOLLOWS "follows from the other sizes"

#define FILE_KEY(text)                                                                                                 \
    {                                                                                                                  \
        {"file", WORDS, "1", REQUIRED, ANY, NULL, text "; path from the folder of the case file"},                     \
            MOR_CASE_STORE_TEXT, AT(mor_case_shape, form.file)                                                         \
    }

const mor_case_key mor_case_mesh_keys[] = {
    FILE_KEY("closed mesh of triangles (.stl, .obj, .ply, .gltf, .glb)"),
    {{"scale", SCALAR, "1", DEFAULT(NAN), POSITIVE, NULL, "factor on the lengths in the file, which are in meters"},
     FORM(scale),
     .computed = "1 if no other size is given"},
    {{"length", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL, "longest side of its bounding box"},
     FORM(length),
     .computed = FOLLOWS},
    {{"volume", SCALAR, "m3", DEFAULT(NAN), POSITIVE, NULL, "volume"}, FORM(volume), .computed = FOLLOWS},
    {{"diameter", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL, "diameter of the ball of the same volume"},
     FORM(diameter),
     .computed = FOLLOWS},
    END};

const mor_case_key mor_case_outline_keys[] = {
    FILE_KEY("text with one corner \"x y\" per line"),
    {{"scale", SCALAR, "1", DEFAULT(NAN), POSITIVE, NULL, "factor on the lengths in the file, which are in meters"},
     FORM(scale),
     .computed = "1 if no other size is given"},
    {{"diameter", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL, "diameter of the disc of the same area"},
     FORM(diameter),
     .computed = FOLLOWS},
    END};

const mor_case_key mor_case_rock_keys[] = {
    {{"diameter", SCALAR, "m", REQUIRED, POSITIVE, NULL, "diameter of the ball (disc) of the same volume (area)"},
     FORM(diameter)},
    {{"elongation", SCALAR, "1", DEFAULT(0.75), BETWEEN(0.3, 1.0), NULL,
      "intermediate over longest axis; short over long axis in plane strain"},
     FORM(elongation)},
    {{"flatness", SCALAR, "1", DEFAULT(0.75), BETWEEN(0.3, 1.0), NULL,
      "shortest over intermediate axis; without effect in plane strain"},
     FORM(flatness)},
    {{"angularity", SCALAR, "1", DEFAULT(0.5), BETWEEN(0.0, 1.0), NULL, "0: rounded; 1: angular"}, FORM(angularity)},
    {{"roughness", SCALAR, "1", DEFAULT(0.2), BETWEEN(0.0, 1.0), NULL, "0: smooth; 1: rough"}, FORM(roughness)},
    {{"seed", WHOLE, "1", DEFAULT(1.0), NOT_NEGATIVE, NULL, "seed of the random form"},
     MOR_CASE_STORE_SEED,
     AT(mor_case_shape, form.seed)},
    END};
