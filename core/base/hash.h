/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_HASH_H
#define MOR_CORE_BASE_HASH_H

#include "core/base/context.h"

/** @file
 *  64-bit content hash of bytes and files: XXH64 with seed 0 (Collet 2014), so that `xxhsum -H64 FILE` gives the same
 *  number. Words are read as little-endian whatever the machine: equal bytes hash equal everywhere. It finds damage; it
 *  is no defense against somebody who forges. */

enum { MOR_HASH_STRIPE_BYTES = 32, MOR_HASH_TEXT_BYTES = 17 };

/** A hash in the making; bytes may come in pieces of any size. Owned by the caller, holds no other resource. */
typedef struct mor_hash {
    uint64_t lanes[4];                            /* shape [4]; running sums of the four word columns */
    unsigned char pending[MOR_HASH_STRIPE_BYTES]; /* bytes that do not fill a stripe yet */
    uint64_t n_bytes;                             /* bytes so far; n_bytes % 32 of them are pending */
} mor_hash;

/** Starts a hash of no bytes. */
void mor_hash_init(mor_hash *hash);

/** Adds bytes to the hash.
 *  @param bytes   [in]      shape [n_bytes]; may be NULL when n_bytes is 0
 *  @param n_bytes [in]      number of bytes */
void mor_hash_add(mor_hash *hash, const void *bytes, size_t n_bytes);

/** Returns the hash of all bytes added so far; more may be added afterwards. */
uint64_t mor_hash_value(const mor_hash *hash);

/** Returns the hash of an array of bytes.
 *  @param bytes   [in]  shape [n_bytes]; may be NULL when n_bytes is 0
 *  @param n_bytes [in]  number of bytes
 *  Threads: safe to call concurrently. */
uint64_t mor_hash_bytes(const void *bytes, size_t n_bytes);

/** Computes the hash of a file's content.
 *  @param path    [in]      zero-terminated path of the file
 *  @param value   [out]     one number; 0 on failure
 *  Returns: MOR_OK; MOR_ERROR_IO when the file cannot be read. */
mor_status mor_hash_file(mor_context *context, const char *path, uint64_t *value);

/** Writes a hash as 16 lower-case hexadecimal digits, most significant first.
 *  @param value [in]   the hash
 *  @param text  [out]  shape [MOR_HASH_TEXT_BYTES]; zero-terminated */
void mor_hash_format(uint64_t value, char *text);

#endif
