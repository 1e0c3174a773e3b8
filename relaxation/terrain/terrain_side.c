/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Files beside a raster: the reference system that a .prj states, and others with its position and units. The library
 * that reads rasters uses a .prj for one format only, ignores one that it does not understand without a message, and
 * ignores units of heights. */
#include "relaxation/terrain/terrain_internal.h"

#include "core/base/memory.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { BYTES_MAX = 65536, WORD_BYTES = 32 };

/* Puts the path of the file beside a raster into path; false when there is none. */
static bool find_file(const char *raster, char *path, size_t n_bytes)
{
    static const char *const endings[] = {".prj", ".PRJ", ".Prj"};
    const char *slash = strrchr(raster, '/');
    const char *dot = strrchr(slash != NULL ? slash : raster, '.');
    const int n_stem = dot != NULL ? (int)(dot - raster) : (int)strlen(raster);
    for (size_t k = 0; k < sizeof endings / sizeof *endings; ++k) {
        struct stat status;
        const int n = snprintf(path, n_bytes, "%.*s%s", n_stem, raster, endings[k]);
        if (n < (int)n_bytes && stat(path, &status) == 0 && S_ISREG(status.st_mode)) {
            return true;
        }
    }
    path[0] = '\0';
    return false;
}

/* The end of the first statement with brackets, "PROJCS[...]"; the end of the text where there is none. */
static size_t find_end(const char *text)
{
    int depth = 0;
    bool is_quoted = false;
    for (size_t k = 0; text[k] != '\0'; ++k) {
        is_quoted = is_quoted != (text[k] == '"');
        depth += !is_quoted && (text[k] == '[' || text[k] == '(');
        if (!is_quoted && (text[k] == ']' || text[k] == ')') && --depth <= 0) {
            return k + 1;
        }
    }
    return strlen(text);
}

/* The value of a line "key value"; false when there is none. */
static bool find_value(const char *text, const char *key, char *value)
{
    const size_t n_key = strlen(key);
    for (const char *line = text; *line != '\0'; line += strspn(line, "\r\n")) {
        const char *word = line + strspn(line, " \t");
        if (strncasecmp(word, key, n_key) == 0 && isspace((unsigned char)word[n_key])) {
            word += n_key;
            word += strspn(word, " \t");
            snprintf(value, WORD_BYTES, "%.*s", (int)strcspn(word, " \t\r\n"), word);
            return true;
        }
        line += strcspn(line, "\r\n");
    }
    return false;
}

static mor_status load(mor_context *context, mor_terrain_prj *it)
{
    static const char mark[] = "\xef\xbb\xbf"; /* of bytes in UTF-8, which some editors put first */
    FILE *file = fopen(it->path, "rb");
    MOR_CHECK(context, file != NULL, MOR_ERROR_IO, "%s: cannot be read; allow that, or remove it", it->path);
    mor_status status = MOR_NEW(context, &it->memory, BYTES_MAX + 2, "a reference system");
    const size_t n = status == MOR_OK ? fread(it->memory, 1, BYTES_MAX, file) : 0;
    fclose(file);
    MOR_TRY(context, status);
    MOR_CHECK(context, n < BYTES_MAX, MOR_ERROR_ARGUMENT,
              "%s: found %d bytes or more; allowed is the text of one reference system; correct or remove it", it->path,
              BYTES_MAX);
    it->first = it->memory + (strncmp(it->memory, mark, sizeof mark - 1) == 0 ? sizeof mark - 1 : 0);
    it->first += strspn(it->first, " \t\r\n");
    return MOR_OK;
}

/* Heights of the old form, "Zunits FEET". */
static mor_status check_heights(mor_context *context, const mor_terrain_prj *it)
{
    static const char *const meters[] = {"NO", "METERS", "METER", "METRES", "METRE", "M", NULL};
    char unit[WORD_BYTES] = "";
    if (!find_value(it->first, "Zunits", unit)) {
        return MOR_OK;
    }
    bool is_meter = strtod(unit, NULL) == 1.0;
    for (int k = 0; meters[k] != NULL && !is_meter; ++k) {
        is_meter = strcasecmp(unit, meters[k]) == 0;
    }
    MOR_CHECK(context, is_meter, MOR_ERROR_ARGUMENT,
              "%s: heights are in '%s' (Zunits); allowed are meters: convert them with gdal_calc.py, and correct it",
              it->path, unit);
    return MOR_OK;
}

mor_status mor_terrain_prj_load(mor_context *context, const char *raster, mor_terrain_prj *prj)
{
    char word[WORD_BYTES];
    *prj = (mor_terrain_prj){0};
    if (!find_file(raster, prj->path, sizeof prj->path)) {
        return MOR_OK;
    }
    MOR_TRY(context, load(context, prj));
    prj->is_keywords = find_value(prj->first, "Projection", word);
    if (prj->is_keywords) {
        prj->rest = prj->first + strlen(prj->first);
        return check_heights(context, prj);
    }
    const size_t end = find_end(prj->first);
    prj->rest = prj->first + end + 1;
    memmove(prj->rest, prj->first + end, strlen(prj->first + end) + 1);
    prj->first[end] = '\0';
    prj->rest += strspn(prj->rest, " \t\r\n,");
    return MOR_OK;
}

void mor_terrain_prj_clear(mor_context *context, mor_terrain_prj *prj)
{
    MOR_FREE(context, &prj->memory);
    *prj = (mor_terrain_prj){0};
}

bool mor_terrain_side_is_relevant(const char *path)
{
    static const char *const words[] = {"<SRS",   "<GeoTransform", "<GCPList",  "<NoDataValue",
                                        "<Scale", "<Offset",       "<UnitType", NULL};
    const char *dot = strrchr(path, '.');
    if (dot == NULL || strcasecmp(dot, ".xml") != 0) {
        return dot == NULL || (strcasecmp(dot, ".ovr") != 0 && strcasecmp(dot, ".msk") != 0);
    }
    char *line = NULL;
    size_t room = 0;
    bool is_relevant = false;
    FILE *file = fopen(path, "rb");
    while (file != NULL && !is_relevant && getline(&line, &room, file) > 0) {
        for (int k = 0; words[k] != NULL && !is_relevant; ++k) {
            is_relevant = strstr(line, words[k]) != NULL;
        }
    }
    free(line);
    if (file != NULL) {
        fclose(file);
    }
    return is_relevant;
}
