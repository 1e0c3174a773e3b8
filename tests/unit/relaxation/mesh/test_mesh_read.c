/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/mesh/mesh.h"
#include "tests/common/mesh_forms.h"
#include "tests/common/near.h"
#include "tests/common/run_folder.h"

#include <sys/stat.h>
#include <sys/wait.h>

enum { TEXT_BYTES = 16384 };

/* A cube of side 1 m as a file, and what reading gave. */
typedef struct written {
    char bytes[TEXT_BYTES];
    size_t n_bytes;
} written;

static void append_text(written *it, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const int n = vsnprintf(it->bytes + it->n_bytes, TEXT_BYTES - it->n_bytes, format, list);
    va_end(list);
    assert_true(n >= 0 && it->n_bytes + (size_t)n < TEXT_BYTES);
    it->n_bytes += (size_t)n;
}

static void append_bytes(written *it, const void *bytes, size_t n_bytes)
{
    assert_true(it->n_bytes + n_bytes <= TEXT_BYTES);
    memcpy(it->bytes + it->n_bytes, bytes, n_bytes);
    it->n_bytes += n_bytes;
}

static void write_stl_text(written *it, const mor_mesh *mesh)
{
    append_text(it, "solid cube\n");
    for (int64_t t = 0; t < mesh->n_triangles; ++t) {
        append_text(it, "facet normal 0 0 0\nouter loop\n");
        for (int c = 0; c < 3; ++c) {
            const double *x = mesh->vertices + 3 * (ptrdiff_t)mesh->triangles[3 * t + c];
            append_text(it, "vertex %.9g %.9g %.9g\n", x[0], x[1], x[2]);
        }
        append_text(it, "endloop\nendfacet\n");
    }
    append_text(it, "endsolid cube\n");
}

static void write_stl_binary(written *it, const mor_mesh *mesh)
{
    const char header[80] = "solid that is none";
    const uint32_t n = (uint32_t)mesh->n_triangles;
    append_bytes(it, header, sizeof header);
    append_bytes(it, &n, sizeof n);
    for (int64_t t = 0; t < mesh->n_triangles; ++t) {
        float numbers[12] = {0};
        for (int k = 0; k < 9; ++k) {
            numbers[3 + k] = (float)mesh->vertices[3 * (ptrdiff_t)mesh->triangles[3 * t + k / 3] + k % 3];
        }
        append_bytes(it, numbers, sizeof numbers);
        append_bytes(it, "\0", 2);
    }
}

static void write_obj(written *it, const mor_mesh *mesh)
{
    append_text(it, "# a cube\nmtllib missing.mtl\no cube\n");
    for (int64_t v = 0; v < mesh->n_vertices; ++v) {
        append_text(it, "v %.9g %.9g %.9g\n", mesh->vertices[3 * v], mesh->vertices[3 * v + 1],
                    mesh->vertices[3 * v + 2]);
    }
    for (int64_t t = 0; t < mesh->n_triangles; ++t) {
        append_text(it, "f %d %d %d\r\n", mesh->triangles[3 * t] + 1, mesh->triangles[3 * t + 1] + 1,
                    mesh->triangles[3 * t + 2] + 1);
    }
}

static void write_ply(written *it, const mor_mesh *mesh)
{
    append_text(it,
                "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                "element face %d\nproperty list uchar int vertex_indices\nend_header\n",
                (int)mesh->n_vertices, (int)mesh->n_triangles);
    for (int64_t v = 0; v < mesh->n_vertices; ++v) {
        append_text(it, "%.9g %.9g %.9g\n", mesh->vertices[3 * v], mesh->vertices[3 * v + 1],
                    mesh->vertices[3 * v + 2]);
    }
    for (int64_t t = 0; t < mesh->n_triangles; ++t) {
        append_text(it, "3 %d %d %d\n", mesh->triangles[3 * t], mesh->triangles[3 * t + 1], mesh->triangles[3 * t + 2]);
    }
}

/* The numbers of a glTF buffer: corners as float, then indices as 16 bits. */
static void write_buffer(written *it, const mor_mesh *mesh)
{
    for (int64_t k = 0; k < 3 * mesh->n_vertices; ++k) {
        const float x = (float)mesh->vertices[k];
        append_bytes(it, &x, sizeof x);
    }
    for (int64_t k = 0; k < 3 * mesh->n_triangles; ++k) {
        const uint16_t corner = (uint16_t)mesh->triangles[k];
        append_bytes(it, &corner, sizeof corner);
    }
}

/* A node that doubles the length in x and moves it, so that transforms are seen to be used. */
static void write_gltf_json(written *it, const mor_mesh *mesh, const char *uri)
{
    const int n_corners = (int)mesh->n_vertices;
    const int n_indices = (int)(3 * mesh->n_triangles);
    append_text(it,
                "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
                "\"nodes\":[{\"children\":[1],\"scale\":[2,1,1]},{\"mesh\":0,\"translation\":[5,0,0]}],"
                "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
                "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\","
                "\"min\":[-1,-1,-1],\"max\":[1,1,1]},"
                "{\"bufferView\":1,\"componentType\":5123,\"count\":%d,\"type\":\"SCALAR\"}],"
                "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":%d},"
                "{\"buffer\":0,\"byteOffset\":%d,\"byteLength\":%d}],\"buffers\":[{%s\"byteLength\":%d}]}",
                n_corners, n_indices, 12 * n_corners, 12 * n_corners, 2 * n_indices, uri,
                12 * n_corners + 2 * n_indices);
}

static void write_glb(written *it, const mor_mesh *mesh)
{
    written json = {.n_bytes = 0};
    written buffer = {.n_bytes = 0};
    write_gltf_json(&json, mesh, "");
    while (json.n_bytes % 4 != 0) {
        append_text(&json, " ");
    }
    write_buffer(&buffer, mesh);
    const uint32_t n_all = (uint32_t)(12 + 8 + json.n_bytes + 8 + buffer.n_bytes);
    const uint32_t head[5] = {0x46546C67u, 2, n_all, (uint32_t)json.n_bytes, 0x4E4F534Au};
    const uint32_t middle[2] = {(uint32_t)buffer.n_bytes, 0x004E4942u};
    append_bytes(it, head, sizeof head);
    append_bytes(it, json.bytes, json.n_bytes);
    append_bytes(it, middle, sizeof middle);
    append_bytes(it, buffer.bytes, buffer.n_bytes);
}

static mor_status read_bytes(run_folder *folder, const char *name, const written *it, mor_mesh *mesh,
                             mor_mesh_report *report)
{
    char path[MOR_PATH_BYTES];
    run_folder_store(run_folder_file(folder, path, name), it->bytes, it->n_bytes);
    return mor_mesh_read(&folder->context, path, mesh, report);
}

static void expect_cube(run_folder *folder, const char *name, const written *it, double volume, double center)
{
    mor_mesh mesh;
    mor_mesh_report report;
    mor_shape_moments moments;
    if (read_bytes(folder, name, it, &mesh, &report) != MOR_OK) {
        fail_msg("%s: %s", name, folder->context.message);
    }
    assert_int_equal(mesh.n_vertices, 8);
    assert_int_equal(mesh.n_triangles, 12);
    assert_int_equal(report.n_triangles_read, 12);
    assert_int_equal(report.n_flipped + report.n_holes_filled + report.n_duplicate + report.n_degenerate, 0);
    mor_mesh_moments(&mesh, &moments);
    assert_near(moments.volume, volume, 1e-14);    /* corners are exact in single precision */
    assert_near(moments.center[0], center, 1e-14); /* likewise */
    mor_mesh_clear(&folder->context, &mesh);
}

static void expect_refusal(run_folder *folder, const char *name, const written *it, mor_status status,
                           const char *words)
{
    mor_mesh mesh;
    mor_mesh_report report;
    const mor_status found = read_bytes(folder, name, it, &mesh, &report);
    if (found != status || strstr(folder->context.message, words) == NULL) {
        fail_msg("%s: status %d, no \"%s\" in \"%s\"", name, found, words, folder->context.message);
    }
    assert_null(mesh.vertices);
    assert_null(mesh.triangles);
    assert_non_null(strstr(folder->context.message, name)); /* the file is named */
}

/* ---- Kinds of files ---------------------------------------------------------------------------------------------- */

static void every_kind_of_file_gives_the_same_cube(void **state)
{
    run_folder *folder = *state;
    static const struct {
        const char *name;
        void (*write)(written *it, const mor_mesh *mesh);
        double volume, center;
    } kinds[] = {{"text.stl", write_stl_text, 1.0, 0.0},
                 {"binary.STL", write_stl_binary, 1.0, 0.0},
                 {"cube.obj", write_obj, 1.0, 0.0},
                 {"cube.ply", write_ply, 1.0, 0.0},
                 {"cube.glb", write_glb, 2.0, 10.0}};
    mor_mesh cube = mesh_cube(&folder->context, 0.5);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
        written it = {.n_bytes = 0};
        kinds[k].write(&it, &cube);
        expect_cube(folder, kinds[k].name, &it, kinds[k].volume, kinds[k].center);
    }
    assert_int_equal(folder->n_logged, 0);
    written json = {.n_bytes = 0};
    written buffer = {.n_bytes = 0};
    char path[MOR_PATH_BYTES];
    write_buffer(&buffer, &cube);
    run_folder_store(run_folder_file(folder, path, "cube.bin"), buffer.bytes, buffer.n_bytes);
    write_gltf_json(&json, &cube, "\"uri\":\"cube.bin\",");
    expect_cube(folder, "cube.gltf", &json, 2.0, 10.0);
    mor_mesh_clear(&folder->context, &cube);
}

static void polygons_are_divided_into_triangles(void **state)
{
    run_folder *folder = *state;
    written it = {.n_bytes = 0};
    append_text(&it, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                     "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    expect_cube(folder, "quads.obj", &it, 1.0, 0.5);
}

static void what_is_repaired_is_logged(void **state)
{
    run_folder *folder = *state;
    mor_mesh cube = mesh_cube(&folder->context, 0.5);
    mor_mesh mesh;
    mor_mesh_report report;
    written it = {.n_bytes = 0};
    cube.n_triangles = 11; /* a hole */
    const int32_t corner = cube.triangles[0];
    cube.triangles[0] = cube.triangles[1];
    cube.triangles[1] = corner;
    write_stl_binary(&it, &cube);
    assert_int_equal(read_bytes(folder, "torn.stl", &it, &mesh, &report), MOR_OK);
    assert_int_equal(report.n_flipped, 1);
    assert_int_equal(report.n_holes_filled, 1);
    assert_int_equal(folder->n_logged, 1);
    assert_non_null(strstr(folder->log, "repaired: 1 triangle reversed, 1 hole filled"));
    mor_mesh_clear(&folder->context, &mesh);
    mor_mesh_clear(&folder->context, &cube);
}

/* ---- Refusals ---------------------------------------------------------------------------------------------------- */

static void files_without_an_inside_are_refused(void **state)
{
    run_folder *folder = *state;
    written it = {.n_bytes = 0};
    mor_mesh cube = mesh_cube(&folder->context, 0.5);
    append_text(&it, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
    expect_refusal(folder, "sheet.obj", &it, MOR_ERROR_ARGUMENT, "no inside");
    it.n_bytes = 0;
    write_obj(&it, &cube);
    append_text(&it, "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 9 11 10\nf 9 10 12\nf 10 11 12\nf 11 9 12\n");
    expect_refusal(folder, "two.obj", &it, MOR_ERROR_ARGUMENT, "2 parts");
    it.n_bytes = 0;
    const float not_a_number = NAN;
    write_stl_binary(&it, &cube);
    memcpy(it.bytes + 84 + 12, &not_a_number, sizeof not_a_number); /* the first corner, behind header and normal */
    expect_refusal(folder, "nan.stl", &it, MOR_ERROR_ARGUMENT, "is not finite");
    mor_mesh_clear(&folder->context, &cube);
}

/* A word that is no number, at a place that a reader of meshes takes for 0 or for its first digits. */
static void places_that_are_no_numbers_are_refused(void **state)
{
    static const struct {
        const char *name, *text, *word;
    } all[] = {
        {"a.obj", "v abc 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
         "line 1, column 3: found 'abc'"},
        {"b.obj", "v 0 0 0\nv 1,5 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
         "line 2, column 3: found '1,5'"},
        {"c.obj", "v 0 0 0\nv 1.5m 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
         "found '1.5m', which is no number"},
        {"d.obj", "v 0 0 0\nv 1 0 0\nv 0 1e999 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
         "line 3, column 5: found '1e999', which is beyond the range"},
        {"e.obj", "v 0 0 0\nv 1 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n", "fewer than three numbers"},
        {"f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4x\nf 2 3 4\nf 3 1 4\n",
         "line 6, column 7: found '4x'"},
        {"g.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 5\n",
         "refers to vertex 5, but there are 4"},
        {"h.stl", "solid rock of vertex x\nfacet normal 0 0 0\nouter loop\nvertex 0 x 0\n",
         "line 4, column 10: found 'x'"},
        {"i.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "end_header\n0 #N/A 0\n",
         "line 8, column 3: found '#N/A'"},
        {"j.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "end_header\n0 0 0\n5\n",
         "line 9, column 1: found '5'"},
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        written it = {.n_bytes = 0};
        append_text(&it, "%s", all[k].text);
        expect_refusal(*state, all[k].name, &it, MOR_ERROR_IO, all[k].word);
    }
}

static void meshes_too_far_away_for_single_precision_are_refused(void **state)
{
    run_folder *folder = *state;
    /* Allowed are 1e-5 of the diagonal, sqrt(3), and rounding is 2^-24 of the way: 290.6 m. */
    static const double ways[] = {290.0, 290.25, 5e6};
    for (int k = 0; k < 3; ++k) {
        written obj = {.n_bytes = 0};
        written stl = {.n_bytes = 0};
        mor_mesh cube = mesh_cube(&folder->context, 0.5);
        for (int64_t v = 0; v < cube.n_vertices; ++v) {
            cube.vertices[3 * v] += ways[k];
        }
        write_obj(&obj, &cube);
        write_stl_binary(&stl, &cube);
        if (k == 0) { /* its far side lies at 290.5 m */
            expect_cube(folder, "near.obj", &obj, 1.0, ways[k]);
            expect_cube(folder, "near.stl", &stl, 1.0, ways[k]);
        } else { /* at 290.75 m */
            expect_refusal(folder, "far.obj", &obj, MOR_ERROR_ARGUMENT, "translate it to the origin");
            expect_refusal(folder, "far.stl", &stl, MOR_ERROR_ARGUMENT, "allowed is 1.73205e-05");
        }
        mor_mesh_clear(&folder->context, &cube);
    }
}

static void nodes_too_deep_in_each_other_are_refused(void **state)
{
    run_folder *folder = *state;
    written it = {.n_bytes = 0};
    written buffer = {.n_bytes = 0};
    char path[MOR_PATH_BYTES];
    mor_mesh cube = mesh_cube(&folder->context, 0.5);
    write_buffer(&buffer, &cube);
    run_folder_store(run_folder_file(folder, path, "cube.bin"), buffer.bytes, buffer.n_bytes);
    write_gltf_json(&it, &cube, "\"uri\":\"cube.bin\",");
    expect_cube(folder, "two.gltf", &it, 2.0, 10.0);
    /* The same with 300 nodes between the first and the mesh. */
    char *tail = strstr(it.bytes, "\"meshes\"");
    char *nodes = strstr(it.bytes, "[{\"children\"");
    char rest[TEXT_BYTES];
    assert_true(tail != NULL && nodes != NULL);
    snprintf(rest, sizeof rest, "%s", tail);
    it.n_bytes = (size_t)(nodes - it.bytes);
    append_text(&it, "[");
    for (int k = 1; k <= 300; ++k) {
        append_text(&it, "{\"children\":[%d]},", k);
    }
    append_text(&it, "{\"mesh\":0}],%s", rest);
    expect_refusal(folder, "deep.gltf", &it, MOR_ERROR_IO, "more than 256 deep");
    mor_mesh_clear(&folder->context, &cube);
}

/* A pipe then gets the descriptors of input and output, which the reader's process points elsewhere. */
static void a_process_without_input_and_output_reads_meshes(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    int code = 0;
    written it = {.n_bytes = 0};
    mor_mesh cube = mesh_cube(&folder->context, 0.5);
    write_obj(&it, &cube);
    run_folder_store(run_folder_file(folder, path, "cube.obj"), it.bytes, it.n_bytes);
    const pid_t child = fork();
    if (child == 0) {
        mor_mesh mesh;
        (void)close(STDIN_FILENO);
        (void)close(STDOUT_FILENO);
        _exit(mor_mesh_read(&folder->context, path, &mesh, NULL) == MOR_OK && mesh.n_triangles == 12 ? 0 : 1);
    }
    assert_true(child > 0);
    assert_int_equal(waitpid(child, &code, 0), child);
    assert_true(WIFEXITED(code));
    assert_int_equal(WEXITSTATUS(code), 0);
    mor_mesh_clear(&folder->context, &cube);
}

static void what_is_no_mesh_is_refused(void **state)
{
    run_folder *folder = *state;
    static const struct {
        const char *name, *text, *words;
    } bad[] = {
        {"empty.obj", "", "is empty"},
        {"empty.stl", "", "is empty"},
        {"prose.obj", "Once upon a time there was a rock.\n", "no keyword of an OBJ file"},
        {"prose.stl", "Once upon a time there was a rock.\n", "no STL file"},
        {"long.stl", "Once upon a time there was a rock, and it lay in a field for so long that moss grew over it all.",
         "no STL file"},
        {"prose.ply", "ply is wood\n", "no PLY file"},
        {"prose.gltf", "[1, 2]", "no glTF file"},
        {"prose.glb", "glTF but not really, in so many bytes", "no GLB file"},
        {"corners.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "is no mesh"},
        {"liar.ply",
         "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
         "'4000000000' of element 'vertex'"},
        {"minus.ply", "ply\nformat ascii 1.0\nelement vertex -3\nend_header\n", "'-3' of element 'vertex'"},
        {"rock.fbx", "v 0 0 0\n", "extension 'fbx'"},
        {"rock", "v 0 0 0\n", "extension ''"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        written it = {.n_bytes = 0};
        append_text(&it, "%s", bad[k].text);
        expect_refusal(folder, bad[k].name, &it, MOR_ERROR_IO, bad[k].words);
    }
}

static void a_count_that_lies_and_a_file_cut_off_are_refused(void **state)
{
    run_folder *folder = *state;
    written it = {.n_bytes = 0};
    mor_mesh cube = mesh_cube(&folder->context, 0.5);
    write_stl_binary(&it, &cube);
    memset(it.bytes, 0, 80);
    memset(it.bytes + 80, 0xff, 4);
    expect_refusal(folder, "liar.stl", &it, MOR_ERROR_IO, "4294967295 triangles in 214748364834 bytes");
    it.n_bytes = 0;
    write_glb(&it, &cube);
    it.n_bytes -= 100;
    expect_refusal(folder, "cut.glb", &it, MOR_ERROR_IO, "truncated");
    it.n_bytes = 0;
    write_ply(&it, &cube);
    it.n_bytes = 250;
    expect_refusal(folder, "cut.ply", &it, MOR_ERROR_IO, "cut.ply");
    mor_mesh_clear(&folder->context, &cube);
}

static void what_is_no_file_is_refused(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_mesh mesh;
    assert_int_equal(mor_mesh_read(&folder->context, run_folder_file(folder, path, "none.obj"), &mesh, NULL),
                     MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, "cannot be read"));
    assert_int_equal(mkdir(run_folder_file(folder, path, "folder.obj"), 0700), 0);
    assert_int_equal(mor_mesh_read(&folder->context, path, &mesh, NULL), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, "is no file"));
    assert_int_equal(mkfifo(run_folder_file(folder, path, "pipe.obj"), 0600), 0);
    assert_int_equal(mor_mesh_read(&folder->context, path, &mesh, NULL), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, "is no file"));
    run_folder_store(run_folder_file(folder, path, "huge.stl"), "solid", 5);
    assert_int_equal(truncate(path, ((off_t)1 << 30) + 1), 0);
    assert_int_equal(mor_mesh_read(&folder->context, path, &mesh, NULL), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, "1073741825 bytes"));
}

/* ---- Rocks ------------------------------------------------------------------------------------------------------- */

static void scanned_rocks_have_their_volumes(void **state)
{
    run_folder *folder = *state;
    static const double volumes[] = {0.45576, 1.17584, 0.70792};
    if (access(MOR_SOURCE_DIR "/../shared/data/rocks/rock1.obj", R_OK) != 0) {
        print_message("the scanned rocks are not at hand: skipped\n");
        skip();
    }
    for (int k = 0; k < 3; ++k) {
        char path[MOR_PATH_BYTES];
        mor_mesh mesh;
        mor_mesh_report report;
        mor_shape_moments moments;
        snprintf(path, sizeof path, MOR_SOURCE_DIR "/../shared/data/rocks/rock%d.obj", k + 1);
        assert_int_equal(mor_mesh_read(&folder->context, path, &mesh, &report), MOR_OK);
        mor_mesh_moments(&mesh, &moments);
        assert_near(moments.volume, volumes[k], 5e-6); /* the volumes are given to five places */
        assert_int_equal(report.n_holes_filled + report.n_flipped, 0);
        mor_mesh_clear(&folder->context, &mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_kind_of_file_gives_the_same_cube, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(polygons_are_divided_into_triangles, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(what_is_repaired_is_logged, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(files_without_an_inside_are_refused, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(places_that_are_no_numbers_are_refused, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(meshes_too_far_away_for_single_precision_are_refused, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(nodes_too_deep_in_each_other_are_refused, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_process_without_input_and_output_reads_meshes, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(what_is_no_mesh_is_refused, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_count_that_lies_and_a_file_cut_off_are_refused, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(what_is_no_file_is_refused, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(scanned_rocks_have_their_volumes, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
