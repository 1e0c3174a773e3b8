/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/hash.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#define PRIME_1 0x9E3779B185EBCA87u
#define PRIME_2 0xC2B2AE3D27D4EB4Fu
#define PRIME_3 0x165667B19E3779F9u
#define PRIME_4 0x85EBCA77C2B2AE63u
#define PRIME_5 0x27D4EB2F165667C5u

enum { FILE_BLOCK_BYTES = 65536 };

static uint64_t rotate_left(uint64_t x, int n_bits)
{
    return x << n_bits | x >> (64 - n_bits);
}

/* Little-endian number of n_bytes <= 8 bytes; compilers turn the fixed sizes into one load. */
static uint64_t load_little_endian(const unsigned char *bytes, int n_bytes)
{
    uint64_t value = 0;
    for (int k = 0; k < n_bytes; ++k) {
        value |= (uint64_t)bytes[k] << (8 * k);
    }
    return value;
}

static uint64_t mix_word(uint64_t lane, uint64_t word)
{
    return rotate_left(lane + word * PRIME_2, 31) * PRIME_1;
}

static void add_stripe(mor_hash *hash, const unsigned char *stripe)
{
    for (int lane = 0; lane < 4; ++lane) {
        hash->lanes[lane] = mix_word(hash->lanes[lane], load_little_endian(stripe + 8 * lane, 8));
    }
}

void mor_hash_init(mor_hash *hash)
{
    memset(hash, 0, sizeof *hash);
    hash->lanes[0] = PRIME_1 + PRIME_2;
    hash->lanes[1] = PRIME_2;
    hash->lanes[2] = 0;
    hash->lanes[3] = 0 - PRIME_1;
}

void mor_hash_add(mor_hash *hash, const void *bytes, size_t n_bytes)
{
    if (n_bytes == 0) {
        return;
    }
    const unsigned char *next = bytes;
    const size_t n_pending = (size_t)(hash->n_bytes % MOR_HASH_STRIPE_BYTES);
    hash->n_bytes += n_bytes;
    if (n_pending > 0) {
        const size_t n_missing = MOR_HASH_STRIPE_BYTES - n_pending;
        const size_t n_taken = n_bytes < n_missing ? n_bytes : n_missing;
        memcpy(hash->pending + n_pending, next, n_taken);
        next += n_taken;
        n_bytes -= n_taken;
        if (n_taken < n_missing) {
            return;
        }
        add_stripe(hash, hash->pending);
    }
    for (; n_bytes >= MOR_HASH_STRIPE_BYTES; n_bytes -= MOR_HASH_STRIPE_BYTES) {
        add_stripe(hash, next);
        next += MOR_HASH_STRIPE_BYTES;
    }
    memcpy(hash->pending, next, n_bytes);
}

/* The bytes that fill no stripe, and the final mixing. */
static uint64_t finish_value(uint64_t value, const unsigned char *rest, size_t n_rest)
{
    for (; n_rest >= 8; n_rest -= 8, rest += 8) {
        value = rotate_left(value ^ mix_word(0, load_little_endian(rest, 8)), 27) * PRIME_1 + PRIME_4;
    }
    for (; n_rest >= 4; n_rest -= 4, rest += 4) {
        value = rotate_left(value ^ load_little_endian(rest, 4) * PRIME_1, 23) * PRIME_2 + PRIME_3;
    }
    for (; n_rest > 0; --n_rest, ++rest) {
        value = rotate_left(value ^ *rest * PRIME_5, 11) * PRIME_1;
    }
    value = (value ^ value >> 33) * PRIME_2;
    value = (value ^ value >> 29) * PRIME_3;
    return value ^ value >> 32;
}

uint64_t mor_hash_value(const mor_hash *hash)
{
    uint64_t value = PRIME_5;
    if (hash->n_bytes >= MOR_HASH_STRIPE_BYTES) {
        value = rotate_left(hash->lanes[0], 1) + rotate_left(hash->lanes[1], 7) + rotate_left(hash->lanes[2], 12) +
                rotate_left(hash->lanes[3], 18);
        for (int lane = 0; lane < 4; ++lane) {
            value = (value ^ mix_word(0, hash->lanes[lane])) * PRIME_1 + PRIME_4;
        }
    }
    return finish_value(value + hash->n_bytes, hash->pending, (size_t)(hash->n_bytes % MOR_HASH_STRIPE_BYTES));
}

uint64_t mor_hash_bytes(const void *bytes, size_t n_bytes)
{
    mor_hash hash;
    mor_hash_init(&hash);
    mor_hash_add(&hash, bytes, n_bytes);
    return mor_hash_value(&hash);
}

mor_status mor_hash_file(mor_context *context, const char *path, uint64_t *value)
{
    *value = 0;
    FILE *file = fopen(path, "rb");
    MOR_CHECK(context, file != NULL, MOR_ERROR_IO, "cannot open '%s': %s", path, strerror(errno));
    mor_hash hash;
    mor_hash_init(&hash);
    unsigned char block[FILE_BLOCK_BYTES];
    size_t n_read = 0;
    while ((n_read = fread(block, 1, sizeof block, file)) > 0) {
        mor_hash_add(&hash, block, n_read);
    }
    const int error = ferror(file) != 0 ? errno : 0;
    fclose(file);
    MOR_CHECK(context, error == 0, MOR_ERROR_IO, "cannot read '%s': %s", path, strerror(error));
    *value = mor_hash_value(&hash);
    return MOR_OK;
}

void mor_hash_format(uint64_t value, char *text)
{
    static const char digits[] = "0123456789abcdef";
    for (int k = 0; k < MOR_HASH_TEXT_BYTES - 1; ++k) {
        text[k] = digits[value >> (60 - 4 * k) & 15u];
    }
    text[MOR_HASH_TEXT_BYTES - 1] = '\0';
}
