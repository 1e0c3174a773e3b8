/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/hash.h"
#include "tests/common/run_folder.h"

enum { N_BYTES = 200 };

static void fill_bytes(unsigned char *bytes)
{
    for (int k = 0; k < N_BYTES; ++k) {
        bytes[k] = (unsigned char)(k * 7);
    }
}

static void published_values_are_met(void **state)
{
    (void)state;
    char text[MOR_HASH_TEXT_BYTES];
    assert_true(mor_hash_bytes(NULL, 0) == 0xEF46DB3751D8E999u);
    assert_true(mor_hash_bytes("abc", 3) == 0x44BC2CF5AD770999u);
    /* Over one stripe: printf 'Nobody inspects the spammish repetition' | xxhsum -H64 */
    assert_true(mor_hash_bytes("Nobody inspects the spammish repetition", 39) == 0xFBCEA83C8A378BF1u);
    mor_hash_format(0x0123456789ABCDEFu, text);
    assert_string_equal(text, "0123456789abcdef");
}

static void pieces_do_not_matter(void **state)
{
    (void)state;
    unsigned char bytes[N_BYTES];
    fill_bytes(bytes);
    for (size_t n = 0; n <= N_BYTES; ++n) {
        const uint64_t whole = mor_hash_bytes(bytes, n);
        for (size_t cut = 0; cut <= n; ++cut) {
            mor_hash hash;
            mor_hash_init(&hash);
            mor_hash_add(&hash, bytes, cut / 2);
            mor_hash_add(&hash, bytes + cut / 2, cut - cut / 2);
            mor_hash_add(&hash, bytes + cut, n - cut);
            assert_true(mor_hash_value(&hash) == whole);
        }
    }
}

static void every_single_bit_matters(void **state)
{
    (void)state;
    unsigned char bytes[N_BYTES];
    fill_bytes(bytes);
    const uint64_t whole = mor_hash_bytes(bytes, N_BYTES);
    for (int bit = 0; bit < 8 * N_BYTES; ++bit) {
        bytes[bit / 8] ^= (unsigned char)(1u << (bit % 8));
        assert_true(mor_hash_bytes(bytes, N_BYTES) != whole);
        bytes[bit / 8] ^= (unsigned char)(1u << (bit % 8));
    }
}

static void file_hashes_like_its_bytes(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    uint64_t value = 0;
    const size_t n_bytes = 200000; /* more than one block of reading */
    unsigned char *bytes = calloc(n_bytes, 1);
    assert_non_null(bytes);
    fill_bytes(bytes + n_bytes - N_BYTES);
    run_folder_store(run_folder_file(folder, path, "content"), bytes, n_bytes);
    assert_int_equal(mor_hash_file(&folder->context, path, &value), MOR_OK);
    assert_true(value == mor_hash_bytes(bytes, n_bytes));
    free(bytes);
    run_folder_file(folder, path, "missing");
    assert_int_equal(mor_hash_file(&folder->context, path, &value), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, path));
    assert_int_equal(mor_hash_file(&folder->context, folder->path, &value), MOR_ERROR_IO); /* a folder */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_values_are_met),
        cmocka_unit_test(pieces_do_not_matter),
        cmocka_unit_test(every_single_bit_matters),
        cmocka_unit_test_setup_teardown(file_hashes_like_its_bytes, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
