/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_FULL_DISK_H
#define MOR_TESTS_COMMON_FULL_DISK_H

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/resource.h>

#include <cmocka.h>

/** @file
 *  A disk that is full, for tests of what happens then: files of this process end early. */

/** What was before. */
typedef struct full_disk {
    struct rlimit before;
    void (*handler)(int);
} full_disk;

/** Ends all files of this process after so many bytes: writing more fails with EFBIG.
 *  @param n_bytes [in]   number of bytes */
static inline void full_disk_begin(full_disk *disk, rlim_t n_bytes)
{
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &disk->before), 0);
    disk->handler = signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &(struct rlimit){n_bytes, disk->before.rlim_max}), 0);
}

/** Gives the room back. To be called before anything is asserted, or the report of the test may be cut. */
static inline void full_disk_end(const full_disk *disk)
{
    setrlimit(RLIMIT_FSIZE, &disk->before);
    signal(SIGXFSZ, disk->handler);
}

#endif
