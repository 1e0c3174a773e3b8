/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/checkpoint.h"
#include "core/io/durable_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Damaged checkpoints. An even first byte: the rest is the whole file. An odd one: the rest is a list of edits of a
 * good checkpoint, six bytes each: what to do, where (four bytes, little-endian, modulo the size), a byte. Whatever the
 * bytes, reading must give back the saved state when they are the good ones and must refuse them otherwise. */

enum { N_PARTICLES = 3, EDIT_BYTES = 6, FILE_BYTES_MAX = 1 << 16 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes);

/* A small set, a clock, and the file they make. */
typedef struct fixture {
    mor_context context;
    mor_set set;
    double clock;
    mor_state_list list;
    mor_checkpoint view;
    char folder[64];
    char path[MOR_PATH_BYTES];
    uint8_t good[FILE_BYTES_MAX];
    size_t n_good;
} fixture;

/* A failure of the fuzzer itself or of the law must stop it with a trace. */
static void require(bool holds)
{
    if (!holds) {
        abort();
    }
}

static void store_bytes(const char *path, const uint8_t *bytes, size_t n_bytes)
{
    FILE *file = fopen(path, "wb");
    require(file != NULL && fwrite(bytes, 1, n_bytes, file) == n_bytes && fclose(file) == 0);
}

static void fill_state(fixture *base, double start)
{
    base->clock = start;
    for (int k = 0; k < 3 * N_PARTICLES; ++k) {
        base->set.data[MOR_FIELD_POSITION][k] = start + 0.25 * k;
    }
}

static void make_fixture(fixture *base)
{
    mor_context_init(&base->context);
    require(mor_set_init(&base->context, &base->set, "soil", N_PARTICLES, 1u << MOR_FIELD_POSITION) == MOR_OK);
    base->list = (mor_state_list){0};
    require(mor_state_add_set(&base->context, &base->list, &base->set) == MOR_OK);
    require(mor_state_add(&base->context, &base->list, "run", "clock", MOR_STATE_DOUBLE, 1, &base->clock) == MOR_OK);
    base->view = (mor_checkpoint){&base->list, NULL};
    fill_state(base, 1.0);
    const char *parent = getenv("TMPDIR");
    snprintf(base->folder, sizeof base->folder, "%s", "/tmp/moraine_fuzz_XXXXXX");
    if (parent != NULL && strlen(parent) + sizeof "/fuzz_XXXXXX" <= sizeof base->folder) {
        snprintf(base->folder, sizeof base->folder, "%s/fuzz_XXXXXX", parent);
    }
    require(mkdtemp(base->folder) != NULL);
    require(mor_checkpoint_write(&base->context, base->folder, &base->view) == MOR_OK);
    require(mor_durable_file_join(&base->context, base->path, base->folder, MOR_CHECKPOINT_FILE) == MOR_OK);
    FILE *file = fopen(base->path, "rb");
    require(file != NULL);
    base->n_good = fread(base->good, 1, sizeof base->good, file);
    require(fclose(file) == 0 && base->n_good > 0 && base->n_good < sizeof base->good);
}

static void clear_fixture(fixture *base)
{
    unlink(base->path);
    rmdir(base->folder);
    mor_set_clear(&base->context, &base->set);
    mor_state_clear(&base->context, &base->list);
}

/* Applies one edit to n_bytes bytes; returns the new size. */
static size_t apply_edit(const uint8_t *edit, uint8_t *bytes, size_t n_bytes)
{
    const size_t where = edit[1] | (size_t)edit[2] << 8 | (size_t)edit[3] << 16 | (size_t)edit[4] << 24;
    if (edit[0] % 4 == 0 && n_bytes < FILE_BYTES_MAX) {
        bytes[n_bytes] = edit[5];
        return n_bytes + 1;
    }
    if (n_bytes == 0) {
        return 0;
    }
    switch (edit[0] % 4) {
    case 1:
        bytes[where % n_bytes] ^= edit[5];
        break;
    case 2:
        return where % n_bytes;
    default:
        bytes[where % n_bytes] = edit[5];
        break;
    }
    return n_bytes;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes)
{
    fixture *base = calloc(1, sizeof *base);
    uint8_t *bytes = calloc(1, FILE_BYTES_MAX);
    require(base != NULL && bytes != NULL);
    make_fixture(base);
    size_t n_file = 0;
    if (n_bytes > 0 && data[0] % 2 == 1) {
        memcpy(bytes, base->good, base->n_good);
        n_file = base->n_good;
        for (size_t k = 1; k + EDIT_BYTES <= n_bytes; k += EDIT_BYTES) {
            n_file = apply_edit(data + k, bytes, n_file);
        }
    } else if (n_bytes > 1) {
        n_file = n_bytes - 1 < FILE_BYTES_MAX ? n_bytes - 1 : FILE_BYTES_MAX;
        memcpy(bytes, data + 1, n_file);
    }
    store_bytes(base->path, bytes, n_file);
    fill_state(base, 2.0);
    const bool is_good = n_file == base->n_good && memcmp(bytes, base->good, n_file) == 0;
    const mor_status status = mor_checkpoint_read(&base->context, base->path, &base->view);
    require(status == (is_good ? MOR_OK : MOR_ERROR_IO));
    require(base->clock == (is_good ? 1.0 : 2.0));
    require(base->set.data[MOR_FIELD_POSITION][1] == base->clock + 0.25);
    clear_fixture(base);
    free(base);
    free(bytes);
    return 0;
}
