/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_CASE_FILE_CASE_FILE_H
#define MOR_CORE_IO_CASE_FILE_CASE_FILE_H

#include "core/base/context.h"

#include <stdbool.h>

/** @file
 *  A case file as a tree of settings with their places in the file. Only case_file.c calls libconfig: the file is
 *  parsed and copied into the tree. Which settings exist, and their meaning, is defined elsewhere.
 *
 *  Every message has the form "place: found ...; allowed ...; do ...", where place is "file:line" (line 0: the file as
 *  a whole) or "override 'key=value'". */

enum { MOR_CASE_NODE_TEXT_BYTES = 160, MOR_CASE_PLACE_BYTES = 320 };

typedef enum mor_case_node_kind {
    MOR_CASE_NODE_GROUP,   /* { name = value; ... } */
    MOR_CASE_NODE_LIST,    /* ( value, ... ) or [ value, ... ] */
    MOR_CASE_NODE_INTEGER, /* 20 */
    MOR_CASE_NODE_REAL,    /* 0.4 */
    MOR_CASE_NODE_BOOLEAN, /* true */
    MOR_CASE_NODE_TEXT     /* "5 mm" */
} mor_case_node_kind;

typedef struct mor_case_file mor_case_file;
typedef struct mor_case_node mor_case_node;

/** One setting. Owned by its file; constant after mor_case_file_set. */
struct mor_case_node {
    const char *name;   /* zero-terminated; NULL for the root and in lists */
    const char *origin; /* zero-terminated; the file, or the text of the --set that wrote it */
    int line;           /* 1-based; 0 when origin is a --set */
    mor_case_node_kind kind;
    int64_t integer;             /* of an integer */
    double real;                 /* of a real or an integer, unit 1 */
    bool truth;                  /* of a boolean */
    const char *text;            /* of a text; zero-terminated */
    int n_children;              /* of a group or a list */
    mor_case_node *first_child;  /* NULL when there is none */
    mor_case_node *next;         /* next child of the parent, NULL for the last */
    const mor_case_node *parent; /* NULL for the root */
};

/** Parses the text of a case file.
 *  @param name    [in]      zero-terminated; the file's name, for messages; copied
 *  @param text    [in]      shape [n_bytes]; need not be zero-terminated; a byte order mark is skipped
 *  @param n_bytes [in]      length of text, >= 0
 *  @param file    [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for anything that is not a well-formed, reasonably small case file without
 *  @include; MOR_ERROR_MEMORY.
 *  Cost: O(n_bytes), allocates. Threads: neither. */
mor_status mor_case_file_parse(mor_context *context, const char *name, const char *text, int64_t n_bytes,
                               mor_case_file **file);

/** Reads and parses a case file.
 *  @param path    [in]      zero-terminated
 *  @param file    [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: as mor_case_file_parse; MOR_ERROR_CONFIG also when path is missing, unreadable or not a regular file. */
mor_status mor_case_file_load(mor_context *context, const char *path, mor_case_file **file);

/** Writes one setting over those of the file, as the command line does: "numerics.courant=0.2",
 *  "soil[0].material.friction_angle=30 deg", "gravity[2]=0". Groups on the way are made when missing. The value is read
 *  as in the file; what is no value there becomes a text; the word default leaves a member of a group out, as if the
 *  file did not have it.
 *  @param setting [in]      zero-terminated "key=value"; copied
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. After a failure the tree may hold groups made on the way. */
mor_status mor_case_file_set(mor_context *context, mor_case_file *file, const char *setting);

/** Frees the tree and sets the pointer to NULL; NULL is accepted.
 *  @param file    [in,out]  the address of one pointer */
void mor_case_file_free(mor_context *context, mor_case_file **file);

/** Returns the root group; it lives as long as the file. */
const mor_case_node *mor_case_file_root(const mor_case_file *file);

/** Returns the member of a group, or NULL.
 *  @param group [in]  NULL and nodes that are no group have no members
 *  @param name  [in]  zero-terminated */
const mor_case_node *mor_case_node_find(const mor_case_node *group, const char *name);

/** Writes the value of a setting as text: "5 kg", 0.4, true, "a list of 3", "a group".
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0 */
void mor_case_node_format(const mor_case_node *node, char *text, size_t text_bytes);

/** Writes where in the tree a setting is: "soil[0].material.density"; "the file" for the root.
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0 */
void mor_case_node_path(const mor_case_node *node, char *text, size_t text_bytes);

/** Writes where a setting was written: "case.cfg:12" or "override 'spacing=5 mm'".
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0 */
void mor_case_node_place(const mor_case_node *node, char *text, size_t text_bytes);

/** Records an error about a setting, its place in front. Use MOR_CASE_NODE_FAIL.
 *  @param place   [in]      where in the program the error arose
 *  @param format  [in]      printf format, then its arguments; zero-terminated
 *  Returns: MOR_ERROR_CONFIG. */
mor_status mor_case_node_fail(mor_context *context, const mor_case_node *node, const mor_frame *place,
                              const char *format, ...) __attribute__((format(printf, 4, 5)));

/** Records an error about a setting: MOR_CASE_NODE_FAIL(context, node, "found %s; allowed: %s; ...", ...). */
#define MOR_CASE_NODE_FAIL(context, node, ...) mor_case_node_fail((context), (node), MOR_HERE, __VA_ARGS__)

#endif
