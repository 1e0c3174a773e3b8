/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_style.h"

#include "cases/driver/map/map_classes.h"
#include "core/io/durable_file.h"

#include <math.h>
#include <string.h>

/* Maps lie over the hillshade of the ground. */
static const double opacity = 0.75;

static void write_color(FILE *out, const double *color)
{
    fprintf(out, "#%02x%02x%02x", (unsigned)lround(255.0 * color[0]), (unsigned)lround(255.0 * color[1]),
            (unsigned)lround(255.0 * color[2]));
}

/* The last class has no upper end, so that no value is left without a color. */
static void write_class(FILE *out, const mor_map_kind *kind, const mor_map_classes *it, int k)
{
    char label[MOR_TICKS_LABEL_BYTES];
    const bool is_count = strcmp(kind->unit, "1") == 0;
    mor_map_classes_label(kind, it, k, 1.0, label);
    fprintf(out, "          <item alpha=\"255\" color=\"");
    write_color(out, it->colors[k]);
    if (k + 1 < it->n) {
        fprintf(out, "\" value=\"%.17g\"", it->limits[k + 1]);
    } else {
        fprintf(out, "\" value=\"inf\"");
    }
    fprintf(out, " label=\"%s%s%s\"/>\n", label, is_count ? "" : " ", is_count ? "" : kind->unit);
}

static void write_classes(FILE *out, const mor_map_kind *kind, double largest)
{
    mor_map_classes classes;
    mor_map_classes_init(kind, largest, &classes);
    fprintf(
        out,
        "    <rasterrenderer type=\"singlebandpseudocolor\" band=\"1\" alphaBand=\"-1\" opacity=\"%g\" "
        "classificationMin=\"0\" "
        "classificationMax=\"%.17g\">\n"
        "      <rasterTransparency/>\n      <minMaxOrigin><limits>None</limits></minMaxOrigin>\n      <rastershader>\n"
        "        <colorrampshader colorRampType=\"DISCRETE\" classificationMode=\"1\" clip=\"0\" "
        "minimumValue=\"0\" maximumValue=\"%.17g\">\n",
        opacity, classes.limits[classes.n], classes.limits[classes.n]);
    if (!kind->is_early_dark) { /* 0 has no color, as in pictures */
        fprintf(out, "          <item alpha=\"0\" color=\"#ffffff\" value=\"0\" label=\"0\"/>\n");
    }
    for (int k = 0; k < classes.n; ++k) {
        write_class(out, kind, &classes, k);
    }
    fprintf(out, "        </colorrampshader>\n      </rastershader>\n    </rasterrenderer>\n");
}

static void write_style(FILE *out, const mor_map_kind *kind, double largest)
{
    fprintf(out, "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
                 "<qgis version=\"3.22\" styleCategories=\"Symbology\">\n  <pipe>\n");
    if (kind->needs == MOR_MAP_NEEDS_GROUND) {
        fprintf(out, "    <rasterrenderer type=\"hillshade\" band=\"1\" opacity=\"1\" alphaBand=\"-1\" "
                     "azimuth=\"315\" angle=\"45\" zfactor=\"1\" multidirection=\"0\"/>\n");
    } else {
        write_classes(out, kind, largest);
    }
    fprintf(out, "  </pipe>\n  <blendMode>0</blendMode>\n</qgis>\n");
}

mor_status mor_map_style_write(mor_context *context, const mor_map_kind *kind, double largest, const char *path)
{
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    write_style(file.stream, kind, largest);
    return mor_durable_file_commit(context, &file);
}
