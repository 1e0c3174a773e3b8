/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"

#include "cases/driver/case/schema/case_schema_words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Probes and expectations: the tables. Entries follow mor_schema as in case_schema.c. */

static const mor_case_key probe_keys[] = {
    {{"name", MOR_SCHEMA_TEXT, 1, "1", 0, NAN, ANY, NULL, "name of the result"},
     MOR_CASE_STORE_NAME,
     AT(mor_case_probe, name),
     .computed = "the type"},
    {{"type", MOR_SCHEMA_TEXT, 1, "1", 1, 0.0, ANY, NULL, "what is measured; see the table of types"},
     MOR_CASE_STORE_NAME,
     AT(mor_case_probe, type)},
    {{"wall", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "name of the wall on which the force acts"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_probe, wall)},
    {{"body", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "name of the body that is measured"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_probe, body)},
    {{"soil", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "name of the soil that is measured; without it, all soil"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_probe, soil)},
    {{"gauge", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "name of the gauge that is read"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_probe, gauge)},
    {{"measure", MOR_SCHEMA_CHOICE, 1, "1", 0, 0.0, ANY, "mass_percentile|thickness",
      "definition of the edge of the deposit: distance that contains percentile of the mass, or where it becomes "
      "thinner "
      "than thickness"},
     MOR_CASE_STORE_WORD,
     AT(mor_case_probe, measure)},
    {{"percentile", MOR_SCHEMA_REAL, 1, "%", 0, NAN, ABOVE(0.0, 100.0), NULL,
      "percentile of the mass (or of the particles)"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, percentile),
     .computed = "see the table of types"},
    {{"thickness", MOR_SCHEMA_REAL, 1, "m", 0, NAN, ABOVE(0.0, INFINITY), NULL, "thickness at the edge of the deposit"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, thickness),
     .computed = "spacing / 2"},
    {{"origin", MOR_SCHEMA_VECTOR, 3, "m", 0, 0.0, ANY, NULL, "origin of distances and heights"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, origin)},
    {{"direction", MOR_SCHEMA_VECTOR, 3, "1", 0, NAN, ANY, NULL,
      "direction of the measured component, or axis of rotation"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, direction),
     .computed = "(1, 0, 0); (0, 0, 1) of a rotation in plane strain",
     .is_direction = true},
    {{"radial", MOR_SCHEMA_BOOLEAN, 1, "1", 0, NAN, ANY, NULL,
      "whether distance is measured from the vertical line through origin instead of along direction"},
     MOR_CASE_STORE_BOOL,
     AT(mor_case_probe, is_radial),
     .computed = "true in 3D unless direction or path is given"},
    {{"speed", MOR_SCHEMA_REAL, 1, "m/s", 0, NAN, NOT_NEGATIVE, NULL, "speed up to which soil or a body is at rest"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, speed),
     .computed = "sqrt(gravity * spacing) / 10"},
    {{"strain", MOR_SCHEMA_REAL, 1, "1", 0, 0.05, ABOVE(0.0, INFINITY), NULL,
      "plastic shear strain from which on soil counts as yielded"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, strain)},
    {{"friction_coefficient", MOR_SCHEMA_REAL, 1, "1", 0, 0.0, NOT_NEGATIVE, NULL,
      "Coulomb friction coefficient of the ground"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, friction_coefficient)},
    {{"window", MOR_SCHEMA_VECTOR, 2, "s", 0, NAN, NOT_NEGATIVE, NULL,
      "first and last time of the interval for maximum, minimum, mean and impulse"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, window),
     .computed = "the whole run"},
    END};

static const mor_case_key maps_keys[] = {
    {{"ground", WORDS, "1", DEFAULT(NAN), ANY, NULL,
      "name of the wall of type terrain whose raster gives the grid and the georeference; without such a wall the grid "
      "covers the domain"},
     MOR_CASE_STORE_NAME,
     AT(mor_case_maps, ground),
     .computed = "the wall of type terrain where there is one"},
    {{"cell", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL,
      "size of the cells; on terrain a whole multiple, or a whole fraction, of the cells of its raster"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_maps, cell),
     .computed = "as in the raster; spacing without terrain",
     .keeps_scale = true},
    {{"threshold", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL,
      "depth from which soil counts as arrived, and from which its speed, pressure and flow per width are mapped"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_maps, threshold),
     .computed = "spacing / 2"},
    {{"duration_depth", SCALAR, "m", DEFAULT(NAN), POSITIVE, NULL, "depth whose duration is mapped"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_maps, duration_depth),
     .computed = "threshold"},
    {{"interval", WHOLE, "1", DEFAULT(0.0), BETWEEN(0.0, 1.0e6), NULL,
      "steps from one measurement to the next; 0: as many as it takes to spend at most 2 % of the time on it"},
     MOR_CASE_STORE_INT,
     AT(mor_case_maps, interval)},
    END};

const mor_case_group mor_case_maps_group = {"maps", "Maps of a run", maps_keys, NULL, offsetof(mor_case_maps, written)};

static const mor_case_part probe_parts[] = {
    {"region", false, "shape", "part of space to which the measurement is restricted"},
    {"path", false, "list of points [m]",
     "corners of a line that the flow follows, as a thalweg, two or more; distances count along it"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_case_probe_group = {"probes", "Results to measure (list)", probe_keys, probe_parts,
                                             offsetof(mor_case_probe, written)};

static const mor_case_key gauge_keys[] = {
    {{"name", MOR_SCHEMA_TEXT, 1, "1", 1, 0.0, ANY, NULL, "name of the gauge"},
     MOR_CASE_STORE_NAME,
     AT(mor_case_gauge, name)},
    {{"wall", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "name of the wall on which forces are measured"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_gauge, wall)},
    {{"body", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "name of the body, instead of a wall"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_gauge, body)},
    {{"direction", MOR_SCHEMA_VECTOR, 3, "1", 1, 0.0, ANY, NULL,
      "direction of the normal force: into the structure, as a rule that of the flow; the rest of a force is shear"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_gauge, direction),
     .is_direction = true},
    {{"origin", MOR_SCHEMA_VECTOR, 3, "m", 0, 0.0, ANY, NULL,
      "point about which moments are taken and over which heights count, against gravity"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_gauge, origin)},
    {{"filter", MOR_SCHEMA_REAL, 1, "s", 0, NAN, ABOVE(0.0, INFINITY), NULL,
      "peaks are those of the running mean over this time, which looks back only"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_gauge, filter),
     .computed = "none: peaks of single steps"},
    {{"cutoff", MOR_SCHEMA_REAL, 1, "1/s", 0, NAN, ABOVE(0.0, INFINITY), NULL,
      "or of a Butterworth low pass of second order with this cut-off frequency"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_gauge, cutoff),
     .computed = "none"},
    {{"cell", MOR_SCHEMA_REAL, 1, "m", 0, NAN, ABOVE(0.0, INFINITY), NULL,
      "about the side of the cells of a map of pressure, in the plane across direction: they divide its extent "
      "evenly; no less than a spacing resolves anything"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_gauge, cell),
     .computed = "no map"},
    END};

static const mor_case_part gauge_parts[] = {
    {"region", false, "shape", "part of space to which it is restricted, by the places where forces act"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_case_gauge_group = {"gauges", "Forces on structures (list)", gauge_keys, gauge_parts,
                                             offsetof(mor_case_gauge, written)};

const char mor_case_statistic_words[] = "value|maximum|minimum|mean|impulse";

/* value and tolerance are in the unit of the probe or of its impulse, which replaces the one that stands here. */
static const mor_case_key expectation_keys[] = {
    {{"probe", MOR_SCHEMA_TEXT, 1, "1", 1, 0.0, ANY, NULL, "name of a probe"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_expectation, probe)},
    {{"statistic", MOR_SCHEMA_CHOICE, 1, "1", 0, 0.0, ANY, mor_case_statistic_words,
      "what is compared: the last value, or a statistic over the window of the probe; impulse: of forces only"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case_expectation, statistic)},
    {{"value", MOR_SCHEMA_REAL, 1, "1", 1, 0.0, ANY, NULL,
      "reference value, in the unit of the probe (of its impulse)"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_expectation, value)},
    {{"tolerance", MOR_SCHEMA_REAL, 1, "1", 1, 0.0, NOT_NEGATIVE, NULL,
      "allowed deviation / value; with absolute, allowed deviation in the unit of the probe"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_expectation, tolerance)},
    {{"tolerance_low", MOR_SCHEMA_REAL, 1, "1", 0, NAN, NOT_NEGATIVE, NULL, "likewise for results below the value"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_expectation, tolerance_low),
     .computed = "tolerance"},
    {{"absolute", MOR_SCHEMA_BOOLEAN, 1, "1", 0, 0.0, ANY, NULL, "whether tolerances are absolute instead of relative"},
     MOR_CASE_STORE_BOOL,
     AT(mor_case_expectation, is_absolute)},
    {{"source", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "source of the reference value"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_expectation, source)},
    END};

const mor_case_group mor_case_expectation_group = {"expect", "Reference values (list)", expectation_keys, NULL,
                                                   offsetof(mor_case_expectation, written)};

/* ---- Types of probes --------------------------------------------------------------------------------------------- */

const mor_case_own_column mor_case_own_columns[] = {
    {"time", "s"}, {"step", "1"}, {"step_length", "s"}, {"rate_ratio", "1"}, {NULL, NULL}};

const char *const mor_case_probe_key_names[] = {
    "wall",      "measure", "percentile", "thickness", "origin",
    "direction", "radial",  "body",       "soil",      "gauge",
    "region",    "path",    "speed",      "strain",    "friction_coefficient",
    NULL};

const mor_case_probe_type *mor_case_probe_type_find(mor_case_probe_catalog catalog, const char *name)
{
    const mor_case_probe_type *type = NULL;
    for (int k = 0; catalog != NULL && (type = catalog(k)) != NULL; ++k) {
        if (strcmp(type->name, name) == 0) {
            return type;
        }
    }
    return NULL;
}

unsigned mor_case_probe_required(const mor_case_probe_type *type, int dimension)
{
    const bool is_rotation_in_plane = dimension == 2 && (type->traits & MOR_CASE_PROBE_OF_ROTATION) != 0;
    return is_rotation_in_plane ? type->required & ~(unsigned)MOR_CASE_PROBE_DIRECTION : type->required;
}

const char *mor_case_probe_replacement(const mor_case_probe_type *type, const char *key, bool has_path, bool has_region)
{
    const bool is_line = strcmp(key, "direction") == 0 || strcmp(key, "radial") == 0;
    const bool is_origin = strcmp(key, "origin") == 0;
    const bool is_datum = is_origin && (type->traits & MOR_CASE_PROBE_OF_DATUM) != 0;
    const bool is_point = is_origin && (type->traits & MOR_CASE_PROBE_OF_POINT) != 0;
    return has_path && (is_line || (is_origin && !is_datum)) ? "path" : has_region && is_point ? "region" : NULL;
}

void mor_case_probe_list_keys(const mor_case_probe_type *type, char *text, size_t text_bytes)
{
    size_t used = (size_t)snprintf(text, text_bytes, "name, type");
    for (int k = 0; mor_case_probe_key_names[k] != NULL && used < text_bytes; ++k) {
        if ((type->allowed >> k & 1U) != 0) {
            used += (size_t)snprintf(text + used, text_bytes - used, ", %s", mor_case_probe_key_names[k]);
        }
    }
    if (used < text_bytes) {
        snprintf(text + used, text_bytes - used, ", window");
    }
}

const char *mor_case_probe_impulse_unit(const mor_case_probe_type *type, int dimension)
{
    if ((type->traits & MOR_CASE_PROBE_OF_FORCE) == 0) {
        return NULL;
    }
    return dimension == 2 ? "N s/m" : "N s";
}

const char *mor_case_statistic_unit(const mor_case_probe_type *type, mor_case_statistic statistic, int dimension)
{
    return statistic == MOR_CASE_STATISTIC_IMPULSE ? mor_case_probe_impulse_unit(type, dimension)
                                                   : mor_case_probe_unit(type, dimension);
}

const char *mor_case_probe_unit(const mor_case_probe_type *type, int dimension)
{
    return dimension == 2 ? type->unit_plane : type->unit;
}
