/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/terrain/terrain.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Any bytes as an elevation raster: refused with a message, or read into finite heights that make a ground whose
 * distances are finite. The lowest bits of the first byte choose what is asked for. */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes);

enum { PATH_BYTES = 256, NODES_MAX = 4096 };

static void require(int condition, const char *what)
{
    if (!condition) {
        fprintf(stderr, "fuzz_raster: %s\n", what);
        abort();
    }
}

static void store_bytes(char *path, const uint8_t *data, size_t n_bytes)
{
    const char *parent = getenv("TMPDIR");
    snprintf(path, PATH_BYTES, "%.200s/raster_XXXXXX", parent != NULL ? parent : "/tmp");
    const int file = mkstemp(path);
    require(file >= 0, "no file can be made");
    require(write(file, data, n_bytes) == (ssize_t)n_bytes && close(file) == 0, "the file cannot be written");
}

static void use_terrain(mor_context *context, const mor_terrain *terrain)
{
    const int64_t n_nodes = (int64_t)terrain->n_x * terrain->n_y;
    require(terrain->n_x >= 2 && terrain->n_y >= 2 && terrain->cell[0] > 0.0 && terrain->cell[1] > 0.0, "no nodes");
    for (int64_t n = 0; n < n_nodes; ++n) {
        require(isfinite(terrain->heights[n]), "a height is not finite");
    }
    mor_shape *shape = NULL;
    if (n_nodes <= NODES_MAX &&
        mor_shape_new_terrain(context, terrain, terrain->cell[0], 2.0 * terrain->cell[0], &shape) == MOR_OK) {
        for (int k = 0; k < 9; ++k) {
            const double point[3] = {terrain->origin[0] + (k % 3) * 0.7 * terrain->cell[0],
                                     terrain->origin[1] + (k / 3) * 0.7 * terrain->cell[1], terrain->heights[k % 4]};
            require(!isnan(mor_shape_distance(shape, point)), "a distance is not a number");
        }
        mor_shape_free(context, &shape);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes)
{
    if (n_bytes == 0) {
        return 0;
    }
    char path[PATH_BYTES];
    store_bytes(path, data + 1, n_bytes - 1);
    mor_context context;
    mor_context_init(&context);
    mor_terrain_request request;
    mor_terrain_request_init(&request);
    request.path = path;
    request.fills_no_data = data[0] & 1;
    request.cell = data[0] & 2 ? 3.0 : NAN;
    mor_terrain terrain;
    const mor_status status = mor_terrain_read(&context, &request, &terrain);
    if (status == MOR_OK) {
        use_terrain(&context, &terrain);
        mor_terrain_clear(&context, &terrain);
    } else {
        require(context.message[0] != '\0' && terrain.heights == NULL, "refused without a message");
    }
    require(context.memory_bytes == 0, "memory is left");
    unlink(path);
    return 0;
}
