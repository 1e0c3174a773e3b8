/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/hash.h"
#include "relaxation/mesh/mesh.h"
#include "tests/common/run_folder.h"

/* The hash of a mesh covers every file that its corners come from. */

static void store(run_folder *folder, const char *name, const char *text)
{
    char path[MOR_PATH_BYTES];
    run_folder_store(run_folder_file(folder, path, name), text, strlen(text));
}

static uint64_t hash_mesh(run_folder *folder, const char *name)
{
    char path[MOR_PATH_BYTES];
    uint64_t hash = 0;
    if (mor_mesh_hash(&folder->context, run_folder_file(folder, path, name), &hash) != MOR_OK) {
        fail_msg("%s", folder->context.message);
    }
    return hash;
}

/* Whether a change of a file beside it changes the hash of a mesh. */
static bool depends_on(run_folder *folder, const char *mesh, const char *other)
{
    store(folder, other, "one");
    const uint64_t before = hash_mesh(folder, mesh);
    store(folder, other, "two");
    return hash_mesh(folder, mesh) != before;
}

static void hash_of_a_mesh_of_one_file_is_that_of_the_file(void **state)
{
    run_folder *folder = *state;
    static const char text[] = "{\"buffers\": [{\"uri\": \"data:application/octet-stream;base64,AAAA\"}],"
                               " \"images\": [{\"uri\": \"missing.png\"}]}";
    store(folder, "mesh.gltf", text);
    store(folder, "mesh.obj", text);
    assert_true(hash_mesh(folder, "mesh.gltf") == mor_hash_bytes(text, strlen(text)));
    assert_true(hash_mesh(folder, "mesh.obj") == mor_hash_bytes(text, strlen(text)));
}

static void hash_covers_the_buffers_of_a_gltf_file(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    store(folder, "a.gltf",
          "{\"x\": {\"uri\": \"no\"}, \"buffers\" : [ {\"byteLength\": 3, \"uri\" : \"a.bin\"}, "
          "{\"extras\": {\"uri\": \"no\"}, \"uri\": \"b%20c.bin\"}, {\"uri\": \"d\\u0065\\/f.bin\"} ]}");
    store(folder, "b c.bin", "");
    assert_int_equal(mor_durable_file_make_folder(&folder->context, run_folder_file(folder, path, "de")), MOR_OK);
    store(folder, "de/f.bin", "");
    assert_true(depends_on(folder, "a.gltf", "a.bin"));
    assert_true(depends_on(folder, "a.gltf", "b c.bin"));
    assert_true(depends_on(folder, "a.gltf", "de/f.bin"));
}

static void hash_covers_the_buffers_of_a_glb_file(void **state)
{
    static const char json[] = "{\"buffers\":[{\"uri\":\"a.bin\"}]}";
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char bytes[20 + sizeof json - 1] = "glTF\2";
    bytes[8] = (char)sizeof bytes;
    bytes[12] = (char)(sizeof json - 1);
    memcpy(bytes + 16, "JSON", 4);
    memcpy(bytes + 20, json, sizeof json - 1);
    run_folder_store(run_folder_file(folder, path, "a.glb"), bytes, sizeof bytes);
    assert_true(depends_on(folder, "a.glb", "a.bin"));
}

static void missing_buffer_is_refused_by_name(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    uint64_t hash = 0;
    store(folder, "a.gltf", "{\"buffers\": [{\"uri\": \"gone.bin\"}]}");
    assert_int_equal(mor_mesh_hash(&folder->context, run_folder_file(folder, path, "a.gltf"), &hash), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, "gone.bin"));
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)
    const struct CMUnitTest tests[] = {
        TEST(hash_of_a_mesh_of_one_file_is_that_of_the_file),
        TEST(hash_covers_the_buffers_of_a_gltf_file),
        TEST(hash_covers_the_buffers_of_a_glb_file),
        TEST(missing_buffer_is_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
