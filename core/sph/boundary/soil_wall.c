/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/boundary/soil_wall.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

/* BLOCK: clusters of the largest block. STACK: pending halves of 2^31 points. SLACK: spare room against regrowth,
 * 1/n. */
enum { BLOCK = 128, STACK = 64, RECORD = MOR_BOUNDARY_RECORD, SLACK = 4 };

/* When a block is filled, so are others within so many times the reach of the lists: filling is then rare. */
#define AHEAD 3.0

/* ---- Boxes ------------------------------------------------------------------------------------------------------- */

static void empty_box(double *box)
{
    for (int a = 0; a < 3; ++a) {
        box[a] = INFINITY;
        box[3 + a] = -INFINITY;
    }
}

static void widen_box(const double *point, double *box)
{
    for (int a = 0; a < 3; ++a) {
        box[a] = fmin(box[a], point[a]);
        box[3 + a] = fmax(box[3 + a], point[a]);
    }
}

/* Where a wall is at a time. */
static void find_pose(const mor_soil_contact *contact, double time, mor_pose *pose)
{
    const double none[3] = {0.0, 0.0, 0.0};
    if (isnan(time) || contact->base == NULL) {
        *pose = mor_pose_uniform(none, 0.0);
    } else if (contact->motion != NULL) {
        mor_motion_find(contact->motion, time, pose);
    } else {
        *pose = mor_pose_uniform(contact->velocity, time);
    }
}

static void find_corner(const double *box, int corner, double *place)
{
    for (int a = 0; a < 3; ++a) {
        place[a] = box[3 * (corner >> a & 1) + a];
    }
}

/* The box of a box that has been moved. */
static void pose_box(const mor_pose *pose, const double *box, double *posed)
{
    empty_box(posed);
    for (int corner = 0; corner < 8; ++corner) {
        double start[3];
        double place[3];
        find_corner(box, corner, start);
        mor_pose_place(pose, start, place);
        widen_box(place, posed);
    }
}

/* Whether a cluster of the soil is within a distance of a box. */
static bool is_near(const mor_tree *soil, const double *box, double distance)
{
    struct {
        int64_t node, n_clusters;
    } stack[STACK];
    int depth = 0;
    if (soil->n_clusters > 0) {
        stack[depth].node = 0;
        stack[depth++].n_clusters = soil->n_clusters;
    }
    while (depth > 0) {
        --depth;
        const int64_t node = stack[depth].node;
        const int64_t n = stack[depth].n_clusters;
        if (!(mor_tree_box_gap2(soil->boxes + 6 * node, box) <= distance * distance)) {
            continue;
        }
        if (n == 1) {
            return true;
        }
        const int64_t left = mor_tree_left(n);
        stack[depth].node = node + 2 * left;
        stack[depth++].n_clusters = n - left;
        stack[depth].node = node + 1;
        stack[depth++].n_clusters = left;
    }
    return false;
}

/* ---- Making ------------------------------------------------------------------------------------------------------ */

static mor_status make_scratch(mor_context *context, mor_wall_blocks *it, int64_t n)
{
    const int64_t n_directed = it->source.has_normals ? n : 0;
    MOR_TRY(context, MOR_NEW(context, &it->found.positions, 3 * n, "particles of a block of a wall"));
    MOR_TRY(context, MOR_NEW(context, &it->found.shares, n, "particles of a block of a wall"));
    MOR_TRY(context, MOR_NEW(context, &it->found.normals, 3 * n_directed, "particles of a block of a wall"));
    MOR_TRY(context, MOR_NEW(context, &it->found.depths, n_directed, "particles of a block of a wall"));
    MOR_TRY(context, MOR_NEW(context, &it->order, n, "particles of a block of a wall"));
    return MOR_NEW(context, &it->spare, n, "particles of a block of a wall");
}

static void divide(mor_wall_blocks *it, const mor_wall_request *request, const int32_t *order)
{
    empty_box(it->box);
    for (int64_t b = 0; b < it->n_blocks; ++b) {
        mor_wall_block *block = &it->blocks[b];
        empty_box(block->box);
        for (int64_t i = block->first; i < block->first + block->n; ++i) {
            const double *point = request->points + 3 * (int64_t)order[i];
            it->numbers[i] = request->numbers[order[i]];
            memcpy(it->start + 3 * i, point, 3 * sizeof *point);
            widen_box(point, block->box);
        }
        widen_box(block->box, it->box);
        widen_box(block->box + 3, it->box);
    }
}

static mor_status make_blocks(mor_context *context, mor_wall_blocks *it, const mor_wall_request *request)
{
    const int64_t n = request->n_points;
    const int64_t n_clusters = (n + MOR_CLUSTER - 1) / MOR_CLUSTER;
    const mor_tree_points points = {request->points, NULL, 3, n};
    int32_t *order = NULL;
    for (int64_t begin = 0; begin < n_clusters; begin = mor_tree_block_end(n_clusters, BLOCK, begin)) {
        it->n_blocks += 1;
    }
    MOR_TRY(context, MOR_NEW(context, &it->blocks, it->n_blocks, "blocks of a wall"));
    MOR_TRY(context, MOR_NEW(context, &it->numbers, n, "numbers of wall particles"));
    MOR_TRY(context, MOR_NEW(context, &it->start, 3 * n, "wall particles at the start"));
    MOR_TRY(context, MOR_NEW(context, &order, n, "order of wall particles"));
    mor_tree_order_blocks(&points, BLOCK, order);
    int64_t begin = 0;
    for (int64_t b = 0; b < it->n_blocks; ++b) {
        const int64_t end = mor_tree_block_end(n_clusters, BLOCK, begin);
        const int64_t last = end * MOR_CLUSTER < n ? end * MOR_CLUSTER : n;
        it->blocks[b] =
            (mor_wall_block){.first = begin * MOR_CLUSTER, .n = (int32_t)(last - begin * MOR_CLUSTER), .at = -1};
        begin = end;
    }
    divide(it, request, order);
    MOR_FREE(context, &order);
    return make_scratch(context, it, n < BLOCK * MOR_CLUSTER ? n : BLOCK * MOR_CLUSTER);
}

mor_status mor_wall_blocks_init(mor_context *context, mor_soil_contact *contact, const mor_wall_request *request)
{
    MOR_TRY(context, MOR_NEW(context, &contact->blocks, 1, "blocks of a wall"));
    mor_wall_blocks *it = contact->blocks;
    it->source = *request->source;
    it->point_volume = request->point_volume;
    memcpy(it->velocity, request->velocity, sizeof it->velocity);
    it->n_points = request->n_points;
    it->moved_to = NAN;
    it->built_at = NAN;
    return make_blocks(context, it, request);
}

void mor_wall_blocks_clear(mor_context *context, mor_soil_contact *contact)
{
    mor_wall_blocks *it = contact->blocks;
    if (it == NULL) {
        return;
    }
    MOR_FREE(context, &it->blocks);
    MOR_FREE(context, &it->numbers);
    MOR_FREE(context, &it->start);
    MOR_FREE(context, &it->found.positions);
    MOR_FREE(context, &it->found.shares);
    MOR_FREE(context, &it->found.normals);
    MOR_FREE(context, &it->found.depths);
    MOR_FREE(context, &it->order);
    MOR_FREE(context, &it->spare);
    MOR_FREE(context, &contact->blocks);
}

/* ---- Filling ----------------------------------------------------------------------------------------------------- */

/* Marks the blocks to fill by a place among those filled that they do not have yet; returns their particles. */
static int64_t choose_blocks(mor_soil_contact *contact, const mor_tree *soil, double distance)
{
    mor_wall_blocks *it = contact->blocks;
    mor_pose pose;
    int64_t n = 0;
    find_pose(contact, it->moved_to, &pose);
    for (int64_t b = 0; b < it->n_blocks; ++b) {
        mor_wall_block *block = &it->blocks[b];
        double box[6];
        if (block->is_filled) {
            continue;
        }
        pose_box(&pose, block->box, box);
        const bool is_wanted = is_near(soil, box, distance);
        block->at = is_wanted ? 0 : -1;
        n += is_wanted ? block->n : 0;
    }
    return n;
}

/* An array with so many doubles for each particle; NULL: the wall has none. */
typedef struct particle_array {
    double **data;
    int width;
} particle_array;

enum { ARRAYS = 6 };

static void list_arrays(mor_soil_contact *contact, particle_array *arrays)
{
    const particle_array all[ARRAYS] = {
        {&contact->boundary->records, RECORD}, {&contact->normals, 3}, {&contact->depths, 1}, {&contact->base, 3},
        {&contact->base_normals, 3},           {&contact->built, 3}};
    memcpy(arrays, all, sizeof all);
}

static mor_status make_room(mor_context *context, mor_soil_contact *contact, int64_t needed)
{
    mor_wall_blocks *it = contact->blocks;
    const int64_t spared = needed + needed / SLACK;
    const int64_t capacity = (spared < it->n_points ? spared : it->n_points) + MOR_CLUSTER;
    particle_array arrays[ARRAYS];
    list_arrays(contact, arrays);
    for (int k = 0; k < ARRAYS; ++k) {
        double *grown = NULL;
        if (*arrays[k].data == NULL) {
            continue;
        }
        MOR_TRY(context, MOR_NEW(context, &grown, capacity * arrays[k].width, "wall particles"));
        memcpy(grown, *arrays[k].data, (size_t)(contact->n_points * arrays[k].width) * sizeof *grown);
        MOR_FREE(context, arrays[k].data);
        *arrays[k].data = grown;
    }
    mor_tree_clear(context, &contact->tree);
    MOR_TRY(context, mor_tree_init(context, &contact->tree, capacity));
    MOR_FREE(context, &contact->farthest);
    MOR_TRY(context, MOR_NEW(context, &contact->farthest, mor_block_count(capacity) + 1, "blocks of boundary points"));
    it->capacity = capacity - MOR_CLUSTER;
    return MOR_OK;
}

/* Moves the particles that are there apart, so that those of new blocks fit between them. */
static void make_gaps(mor_soil_contact *contact, int64_t n)
{
    mor_wall_blocks *it = contact->blocks;
    particle_array arrays[ARRAYS];
    list_arrays(contact, arrays);
    int64_t at = n;
    for (int64_t b = it->n_blocks - 1; b >= 0; --b) {
        mor_wall_block *block = &it->blocks[b];
        at -= block->at >= 0 ? block->n : 0;
        for (int k = 0; k < ARRAYS && block->is_filled; ++k) {
            const int width = arrays[k].width;
            double *data = *arrays[k].data;
            if (data != NULL) {
                memmove(data + at * width, data + block->at * width, (size_t)(block->n * width) * sizeof *data);
            }
        }
        block->at = block->at >= 0 ? at : -1;
    }
}

/* Finds the particles of a block, sorted once and for all. */
static mor_status find_particles(mor_context *context, mor_wall_blocks *it, mor_wall_block *block)
{
    int64_t *numbers = it->numbers + block->first;
    MOR_TRY(context, it->source.place(context, it->source.owner, numbers, block->n, &it->found));
    const mor_tree_points points = {it->found.positions, numbers, 3, block->n};
    if (block->is_sorted) {
        for (int32_t i = 0; i < block->n; ++i) {
            it->order[i] = i;
        }
        return MOR_OK;
    }
    mor_tree_order_block(&points, it->order);
    return MOR_OK;
}

static void sort_numbers(mor_wall_blocks *it, mor_wall_block *block)
{
    int64_t *numbers = it->numbers + block->first;
    memcpy(it->spare, numbers, (size_t)block->n * sizeof *numbers);
    for (int32_t i = 0; i < block->n; ++i) {
        numbers[i] = it->spare[it->order[i]];
    }
    block->is_sorted = true;
}

static mor_status fill_block(mor_context *context, mor_soil_contact *contact, mor_wall_block *block)
{
    mor_wall_blocks *it = contact->blocks;
    MOR_TRY(context, find_particles(context, it, block));
    for (int32_t k = 0; k < block->n; ++k) {
        const int64_t from = it->order[k];
        const int64_t i = block->at + k;
        double *record = contact->boundary->records + RECORD * i;
        memset(record, 0, RECORD * sizeof *record);
        memcpy(record + MOR_BOUNDARY_POSITION, it->found.positions + 3 * from, 3 * sizeof *record);
        record[MOR_BOUNDARY_VOLUME] = it->point_volume * it->found.shares[from];
        memcpy(record + MOR_BOUNDARY_VELOCITY, it->velocity, 3 * sizeof *record);
        if (contact->normals != NULL) {
            memcpy(contact->normals + 3 * i, it->found.normals + 3 * from, 3 * sizeof *record);
            contact->depths[i] = it->found.depths[from];
        }
        if (contact->base_normals != NULL) {
            memcpy(contact->base_normals + 3 * i, contact->normals + 3 * i, 3 * sizeof *record);
        }
        if (contact->base != NULL) {
            memcpy(contact->base + 3 * i, record + MOR_BOUNDARY_POSITION, 3 * sizeof *record);
        }
    }
    sort_numbers(it, block);
    block->is_filled = true;
    return MOR_OK;
}

mor_status mor_wall_blocks_fill(mor_context *context, mor_soil_contact *contact, const mor_tree *soil, double reach,
                                bool *has_grown)
{
    mor_wall_blocks *it = contact->blocks;
    *has_grown = false;
    if (it == NULL || contact->n_points == it->n_points || choose_blocks(contact, soil, reach) == 0) {
        return MOR_OK;
    }
    const int64_t n = contact->n_points + choose_blocks(contact, soil, AHEAD * reach);
    if (n > it->capacity) {
        MOR_TRY(context, make_room(context, contact, n));
    }
    make_gaps(contact, n);
    contact->n_points = n;
    contact->boundary->n_points = n;
    contact->boundary->patches[0].n_points = n;
    mor_tree_resize(&contact->tree, n);
    for (int64_t b = 0; b < it->n_blocks; ++b) {
        if (it->blocks[b].at >= 0 && !it->blocks[b].is_filled) {
            MOR_TRY(context, fill_block(context, contact, &it->blocks[b]));
        }
    }
    *has_grown = true;
    return MOR_OK;
}

/* ---- What is not filled ------------------------------------------------------------------------------------------ */

/* How far the corners of a box move from one pose to another; nothing in it moves farther. */
static double find_way(const mor_pose *from, const mor_pose *to, const double *box)
{
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        double start[3], first[3], last[3];
        find_corner(box, corner, start);
        mor_pose_place(from, start, first);
        mor_pose_place(to, start, last);
        const double way[3] = {last[0] - first[0], last[1] - first[1], last[2] - first[2]};
        farthest = fmax(farthest, mor_vector_length(way));
    }
    return farthest;
}

double mor_wall_blocks_drift(const mor_soil_contact *contact)
{
    const mor_wall_blocks *it = contact->blocks;
    double farthest = 0.0;
    mor_pose from, to;
    if (it == NULL || contact->base == NULL) {
        return 0.0;
    }
    find_pose(contact, it->built_at, &from);
    find_pose(contact, it->moved_to, &to);
    for (int64_t b = 0; b < it->n_blocks; ++b) {
        if (!it->blocks[b].is_filled) {
            farthest = fmax(farthest, find_way(&from, &to, it->blocks[b].box));
        }
    }
    return farthest;
}

bool mor_wall_blocks_hold(mor_context *context, const mor_soil_contact *contact, const mor_skin_side *soil,
                          double displacement, double support, double reach)
{
    const mor_wall_blocks *it = contact->blocks;
    mor_pose pose;
    bool do_hold = true;
    if (it == NULL) {
        return true;
    }
    find_pose(contact, it->built_at, &pose);
    for (int64_t b = 0; b < it->n_blocks && do_hold; ++b) {
        double box[6];
        const mor_tree tree = {.n_points = 1, .n_clusters = 1, .boxes = box};
        const mor_skin_side block = {.tree = &tree, .displacement = displacement};
        pose_box(&pose, it->blocks[b].box, box);
        do_hold = it->blocks[b].is_filled || mor_skin_holds(context, soil, &block, support, reach);
    }
    return do_hold;
}

void mor_wall_blocks_bound(const mor_soil_contact *contact, double *box)
{
    mor_pose pose;
    find_pose(contact, contact->blocks->moved_to, &pose);
    pose_box(&pose, contact->blocks->box, box);
}

mor_status mor_wall_blocks_check(mor_context *context, const mor_soil_contact *contact, const mor_relation_points *soil,
                                 double support, double time)
{
    const mor_wall_blocks *it = contact->blocks;
    mor_pose pose;
    if (it == NULL) {
        return MOR_OK;
    }
    find_pose(contact, it->moved_to, &pose);
    for (int64_t b = 0; b < it->n_blocks; ++b) {
        double box[6];
        if (it->blocks[b].is_filled) {
            continue;
        }
        pose_box(&pose, it->blocks[b].box, box);
        for (int64_t i = 0; i < soil->tree->n_points; ++i) {
            const double *x = soil->records + i * soil->stride;
            const double point[6] = {x[0], x[1], x[2], x[0], x[1], x[2]};
            MOR_CHECK(context, !(mor_tree_box_gap2(point, box) < support * support), MOR_ERROR_INTERNAL,
                      "soil at (%g, %g, %g) m is in reach of a part of wall '%s' that holds no particles, at t = %.6g "
                      "s; this is an error of the program: please report it",
                      x[0], x[1], x[2], contact->name, time);
        }
    }
    return MOR_OK;
}
