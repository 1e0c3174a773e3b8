/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_SEAL_H
#define MOR_CORE_IO_SEAL_H

#include "core/base/context.h"

/** @file
 *  The seal in the first 512 bytes of a file: what it holds, its size and a hash of all other bytes, so that damage is
 *  found before the content is parsed. A text of four lines, padded with zero bytes; head -n 4 shows it:
 *
 *      moraine <what> <version>     what the file holds and the number of its layout
 *      bytes <20 digits>            size of the whole file
 *      xxh64 <16 hex digits>        hash of all bytes after the seal (core/base/hash.h)
 *      seal <16 hex digits>         hash of the three lines above
 *
 *  Every byte of the file is covered: a seal that is not, byte for byte, the one its own numbers make is damaged. It
 *  finds damage; it is no protection against forgery. */

enum { MOR_SEAL_BYTES = 512, MOR_SEAL_WHAT_BYTES = 48 };

/** How much of a file is checked. */
typedef enum mor_seal_check {
    MOR_SEAL_CHECK_SIZE, /* the seal itself and the size of the file: constant cost */
    MOR_SEAL_CHECK_ALL   /* every byte: reads the file once */
} mor_seal_check;

/** Seals the content of a file, writes it and syncs it to the disk. On failure there is no file of that name.
 *  @param path    [in]      zero-terminated; a temporary name, see mor_durable_file_temporary
 *  @param what    [in]      zero-terminated word of letters and hyphens, shorter than MOR_SEAL_WHAT_BYTES
 *  @param version [in]      number of the layout, > 0
 *  @param bytes   [in,out]  shape [n_bytes]; the whole content; its first 512 bytes are overwritten by the seal
 *  @param n_bytes [in]      >= MOR_SEAL_BYTES
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_seal_write(mor_context *context, const char *path, const char *what, int version, void *bytes,
                          size_t n_bytes);

/** Checks a file against its seal.
 *  @param path    [in]      zero-terminated
 *  @param what    [in]      zero-terminated; what the file must hold
 *  @param version [in]      number of the only layout that is understood
 *  @param check   [in]      how much to check
 *  Returns: MOR_OK; MOR_ERROR_IO when the file cannot be read, is damaged or holds something else;
 *           MOR_ERROR_UNSUPPORTED when its seal is intact and names another version. */
mor_status mor_seal_verify(mor_context *context, const char *path, const char *what, int version, mor_seal_check check);

#endif
