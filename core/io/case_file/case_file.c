/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/case_file/case_file.h"

#include "core/base/memory.h"
#include "core/io/case_file/case_scan.h"

#include <errno.h>
#include <fcntl.h>
#include <libconfig.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The word for a value that leaves a key out. */
#define LEFT_OUT "default"

enum { CHUNK_BYTES = 1 << 16, SETTING_BYTES_MAX = 4096, SNIPPET_BYTES = 60, INDEX_DIGITS = 6 };

/* Nodes and strings live in chunks that are freed together. */
typedef struct chunk {
    struct chunk *previous;
    size_t used;
    size_t size;
    char *bytes;
} chunk;

struct mor_case_file {
    mor_case_node *root;
    chunk *last;
    const char *name;
    int n_nodes; /* made so far */
};

static mor_status add_chunk(mor_context *context, mor_case_file *file, size_t size)
{
    chunk *added = NULL;
    MOR_TRY(context, MOR_NEW(context, &added, 1, "case file"));
    const mor_status status = MOR_NEW(context, &added->bytes, (int64_t)size, "case file");
    if (status != MOR_OK) {
        MOR_FREE(context, &added);
        return mor_context_pass(context, status, MOR_HERE);
    }
    added->size = size;
    added->previous = file->last;
    file->last = added;
    return MOR_OK;
}

static mor_status take_bytes(mor_context *context, mor_case_file *file, size_t n_bytes, void **block)
{
    const size_t rounded = (n_bytes + 15) / 16 * 16;
    if (file->last == NULL || file->last->size - file->last->used < rounded) {
        MOR_TRY(context, add_chunk(context, file, rounded > CHUNK_BYTES ? rounded : CHUNK_BYTES));
    }
    *block = file->last->bytes + file->last->used;
    file->last->used += rounded;
    return MOR_OK;
}

static mor_status copy_text(mor_context *context, mor_case_file *file, const char *text, const char **copy)
{
    void *block = NULL;
    const size_t n_bytes = strlen(text) + 1;
    *copy = "";
    MOR_TRY(context, take_bytes(context, file, n_bytes, &block));
    memcpy(block, text, n_bytes);
    *copy = block;
    return MOR_OK;
}

static mor_status add_node(mor_context *context, mor_case_file *file, mor_case_node *parent, const char *name,
                           mor_case_node **node)
{
    void *block = NULL;
    MOR_TRY(context, take_bytes(context, file, sizeof(mor_case_node), &block));
    *node = block;
    (*node)->parent = parent;
    file->n_nodes += 1;
    if (name != NULL) {
        MOR_TRY(context, copy_text(context, file, name, &(*node)->name));
    }
    if (parent == NULL) {
        return MOR_OK;
    }
    mor_case_node **link = &parent->first_child;
    while (*link != NULL) {
        link = &(*link)->next;
    }
    *link = *node;
    parent->n_children += 1;
    return MOR_OK;
}

/* ---- From libconfig to the tree ---------------------------------------------------------------------------------- */

/* Where the settings being copied come from. */
typedef struct source {
    mor_case_file *file;
    const char *origin;
    bool has_lines;
} source;

static mor_status copy_value(mor_context *context, const source *from, config_setting_t *setting, mor_case_node *node);

static mor_status copy_children(mor_context *context, const source *from, config_setting_t *setting,
                                mor_case_node *node)
{
    mor_case_node *last = NULL;
    const int n_children = config_setting_length(setting);
    for (int k = 0; k < n_children; ++k) {
        config_setting_t *member = config_setting_get_elem(setting, (unsigned)k);
        mor_case_node *child = NULL;
        MOR_TRY(context, add_node(context, from->file, NULL, config_setting_name(member), &child));
        child->parent = node;
        MOR_TRY(context, copy_value(context, from, member, child));
        /* Linked here and not by add_node: walking to the end for each of many children would be quadratic. */
        *(last == NULL ? &node->first_child : &last->next) = child;
        last = child;
        node->n_children += 1;
    }
    return MOR_OK;
}

static mor_status copy_value(mor_context *context, const source *from, config_setting_t *setting, mor_case_node *node)
{
    node->origin = from->origin;
    const int line = from->has_lines ? (int)config_setting_source_line(setting) : 0;
    node->line = from->has_lines && line == 0 ? 1 : line; /* the root begins where the file does */
    switch (config_setting_type(setting)) {
    case CONFIG_TYPE_INT:
    case CONFIG_TYPE_INT64:
        node->kind = MOR_CASE_NODE_INTEGER;
        node->integer = config_setting_type(setting) == CONFIG_TYPE_INT ? config_setting_get_int(setting)
                                                                        : config_setting_get_int64(setting);
        node->real = (double)node->integer;
        return MOR_OK;
    case CONFIG_TYPE_FLOAT:
        node->kind = MOR_CASE_NODE_REAL;
        node->real = config_setting_get_float(setting);
        return MOR_OK;
    case CONFIG_TYPE_BOOL:
        node->kind = MOR_CASE_NODE_BOOLEAN;
        node->truth = config_setting_get_bool(setting) != 0;
        return MOR_OK;
    case CONFIG_TYPE_STRING:
        node->kind = MOR_CASE_NODE_TEXT;
        return copy_text(context, from->file, config_setting_get_string(setting), &node->text);
    case CONFIG_TYPE_GROUP:
        node->kind = MOR_CASE_NODE_GROUP;
        return copy_children(context, from, setting, node);
    default:
        node->kind = MOR_CASE_NODE_LIST;
        return copy_children(context, from, setting, node);
    }
}

/* Copies the line an error is on, blanks at both ends dropped, cut when long. */
static void copy_snippet(const char *text, int line, char *snippet, size_t snippet_bytes)
{
    for (int k = 1; k < line && text != NULL; ++k) {
        text = strchr(text, '\n');
        text += text != NULL;
    }
    text = text == NULL ? "" : text + strspn(text, " \t\r\n");
    size_t length = strcspn(text, "\r\n");
    while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\t')) {
        --length;
    }
    const bool is_long = length > SNIPPET_BYTES;
    snprintf(snippet, snippet_bytes, "%.*s%s", is_long ? SNIPPET_BYTES : (int)length, text, is_long ? "..." : "");
}

/* Runs libconfig on zero-terminated, scanned text with a decimal point whatever the locale of the process. */
static bool parse_text(config_t *config, const char *text, locale_t locale)
{
    config_init(config);
    const locale_t previous = uselocale(locale);
    const bool is_parsed = config_read_string(config, text) == CONFIG_TRUE;
    uselocale(previous);
    return is_parsed;
}

static mor_status report_syntax(mor_context *context, const char *name, const char *text, config_t *config)
{
    char snippet[SNIPPET_BYTES + 8];
    const int line = config_error_line(config);
    const char *what = config_error_text(config);
    copy_snippet(text, line, snippet, sizeof snippet);
    if (what != NULL && strstr(what, "duplicate") != NULL) {
        char key[SNIPPET_BYTES + 8];
        const int first = mor_case_scan_duplicate(context, text, (int64_t)strlen(text), line, key, sizeof key);
        return first > 0
                   ? MOR_FAIL(context, MOR_ERROR_CONFIG,
                              "%s:%d: found '%s' again, which this group has in line %d; allowed: each name once; "
                              "remove one",
                              name, line, key, first)
                   : MOR_FAIL(context, MOR_ERROR_CONFIG,
                              "%s:%d: found '%s', a name that this group already has; allowed: each name once; "
                              "remove one",
                              name, line, snippet);
    }
    if (what != NULL && strstr(what, "mismatched") != NULL) {
        return MOR_FAIL(context, MOR_ERROR_CONFIG,
                        "%s:%d: found '%s', an array [ ] of different types; allowed: one type in [ ]; write ( )", name,
                        line, snippet);
    }
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "%s:%d: found '%s', which does not parse; allowed: 'name = value;' with groups { }, lists ( ) and "
                    "texts in quotes; look here and one line up for a missing ';', ',', '=' or quote",
                    name, line, snippet);
}

static mor_status make_locale(mor_context *context, locale_t *locale)
{
    *locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    MOR_CHECK(context, *locale != (locale_t)0, MOR_ERROR_MEMORY,
              "cannot make the locale that numbers are read with: "
              "not enough memory");
    return MOR_OK;
}

/* text is zero-terminated. */
static mor_status parse_into(mor_context *context, mor_case_file *file, const char *text)
{
    locale_t locale = (locale_t)0;
    MOR_TRY(context, make_locale(context, &locale));
    config_t config;
    const bool is_parsed = parse_text(&config, text, locale);
    freelocale(locale);
    mor_status status = is_parsed ? MOR_OK : report_syntax(context, file->name, text, &config);
    if (status == MOR_OK) {
        status = add_node(context, file, NULL, NULL, &file->root);
    }
    if (status == MOR_OK) {
        const source from = {file, file->name, true};
        status = copy_value(context, &from, config_root_setting(&config), file->root);
    }
    config_destroy(&config);
    return status;
}

mor_status mor_case_file_parse(mor_context *context, const char *name, const char *text, int64_t n_bytes,
                               mor_case_file **file)
{
    *file = NULL;
    if (n_bytes >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) {
        text += 3;
        n_bytes -= 3;
    }
    MOR_TRY(context, mor_case_scan(context, name, text, n_bytes));
    mor_case_file *made = NULL;
    MOR_TRY(context, MOR_NEW(context, &made, 1, "case file"));
    void *copy = NULL;
    mor_status status = copy_text(context, made, name, &made->name);
    if (status == MOR_OK) {
        status = take_bytes(context, made, (size_t)n_bytes + 1, &copy);
    }
    if (status == MOR_OK) {
        memcpy(copy, text, (size_t)n_bytes);
        status = parse_into(context, made, copy);
    }
    if (status != MOR_OK) {
        mor_case_file_free(context, &made);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *file = made;
    return MOR_OK;
}

void mor_case_file_free(mor_context *context, mor_case_file **file)
{
    while (*file != NULL && (*file)->last != NULL) {
        chunk *freed = (*file)->last;
        (*file)->last = freed->previous;
        MOR_FREE(context, &freed->bytes);
        MOR_FREE(context, &freed);
    }
    MOR_FREE(context, file);
}

/* ---- Reading the file -------------------------------------------------------------------------------------------- */

static mor_status check_regular(mor_context *context, const char *path, int descriptor)
{
    struct stat information;
    MOR_CHECK(context, fstat(descriptor, &information) == 0, MOR_ERROR_CONFIG,
              "%s: found a file that cannot be examined (%s); allowed: a readable case file; check the path", path,
              strerror(errno));
    MOR_CHECK(context, !S_ISDIR(information.st_mode), MOR_ERROR_CONFIG,
              "%s: found a folder; allowed: a case file; name the file in it, such as %s/case.cfg", path, path);
    MOR_CHECK(context, S_ISREG(information.st_mode), MOR_ERROR_CONFIG,
              "%s: found a device, pipe or socket; allowed: a regular file; save the case to a file first", path);
    MOR_CHECK(context, information.st_size <= MOR_CASE_SCAN_BYTES_MAX, MOR_ERROR_CONFIG,
              "%s: found %lld bytes; allowed: at most %d; is this a case file?", path, (long long)information.st_size,
              MOR_CASE_SCAN_BYTES_MAX);
    return MOR_OK;
}

static mor_status read_bytes(mor_context *context, const char *path, int descriptor, char *bytes, int64_t *n_bytes)
{
    *n_bytes = 0;
    while (*n_bytes <= MOR_CASE_SCAN_BYTES_MAX) {
        const ssize_t n = read(descriptor, bytes + *n_bytes, (size_t)(MOR_CASE_SCAN_BYTES_MAX + 1 - *n_bytes));
        if (n < 0 && errno == EINTR) {
            continue;
        }
        MOR_CHECK(context, n >= 0, MOR_ERROR_CONFIG,
                  "%s: found a file that cannot be read (%s); allowed: a readable case file; check the disk", path,
                  strerror(errno));
        if (n == 0) {
            break;
        }
        *n_bytes += n;
    }
    return MOR_OK;
}

mor_status mor_case_file_load(mor_context *context, const char *path, mor_case_file **file)
{
    *file = NULL;
    /* Without blocking, or a pipe without a writer would hold us here. */
    const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    MOR_CHECK(context, descriptor >= 0, MOR_ERROR_CONFIG,
              "%s: found no file that can be opened (%s); allowed: a readable case file; check the path", path,
              strerror(errno));
    char *bytes = NULL;
    int64_t n_bytes = 0;
    mor_status status = check_regular(context, path, descriptor);
    if (status == MOR_OK) {
        status = MOR_NEW(context, &bytes, MOR_CASE_SCAN_BYTES_MAX + 1, "bytes of the case file");
    }
    if (status == MOR_OK) {
        status = read_bytes(context, path, descriptor, bytes, &n_bytes);
    }
    close(descriptor);
    if (status == MOR_OK) {
        status = mor_case_file_parse(context, path, bytes, n_bytes, file);
    }
    MOR_FREE(context, &bytes);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

/* ---- Overriding -------------------------------------------------------------------------------------------------- */

static bool is_name_byte(char c, bool is_first)
{
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '*';
    return is_letter || (!is_first && ((c >= '0' && c <= '9') || c == '_' || c == '-'));
}

static mor_status fail_key(mor_context *context, const char *setting, const char *at)
{
    return MOR_FAIL(
        context, MOR_ERROR_CONFIG,
        "override '%s': found the key '%.*s', not understood from '%.20s' on; allowed: key=value with a key "
        "such as spacing, numerics.courant or soil[0].material.density; write one of that form",
        setting, (int)strcspn(setting, "="), setting, at);
}

static mor_case_node *find_child(mor_case_node *group, const char *name, size_t length)
{
    for (mor_case_node *child = group->first_child; child != NULL; child = child->next) {
        if (child->name != NULL && strlen(child->name) == length && strncmp(child->name, name, length) == 0) {
            return child;
        }
    }
    return NULL;
}

/* Follows one name of a key, making the member when it is missing. */
static mor_status follow_name(mor_context *context, const source *from, const char **at, mor_case_node **node)
{
    char name[MOR_CASE_NODE_TEXT_BYTES];
    size_t length = 0;
    while (is_name_byte((*at)[length], length == 0)) {
        ++length;
    }
    if (length == 0 || length >= sizeof name) {
        return fail_key(context, from->origin, *at);
    }
    if ((*node)->kind != MOR_CASE_NODE_GROUP) {
        char path[MOR_CASE_NODE_TEXT_BYTES];
        mor_case_node_path(*node, path, sizeof path);
        return MOR_FAIL(context, MOR_ERROR_CONFIG,
                        "override '%s': found the name '%.*s' in %s, which is no group; allowed: a name in a group%s; "
                        "correct the key",
                        from->origin, (int)length, *at, path,
                        (*node)->kind == MOR_CASE_NODE_LIST ? ", or [0], [1], ... in a list" : "");
    }
    memcpy(name, *at, length);
    name[length] = '\0';
    *at += length;
    mor_case_node *child = find_child(*node, name, length);
    if (child == NULL) {
        MOR_TRY(context, add_node(context, from->file, *node, name, &child));
        child->kind = MOR_CASE_NODE_GROUP;
        child->origin = from->origin;
    }
    *node = child;
    return MOR_OK;
}

static mor_status follow_index(mor_context *context, const source *from, const char **at, mor_case_node **node)
{
    const char *digits = *at + 1;
    const size_t length = strspn(digits, "0123456789");
    if (length == 0 || length > INDEX_DIGITS || digits[length] != ']') {
        return fail_key(context, from->origin, *at);
    }
    const int index = atoi(digits);
    if ((*node)->kind != MOR_CASE_NODE_LIST || index >= (*node)->n_children) {
        char path[MOR_CASE_NODE_TEXT_BYTES];
        char held[MOR_CASE_NODE_TEXT_BYTES];
        mor_case_node_path(*node, path, sizeof path);
        mor_case_node_format(*node, held, sizeof held);
        return MOR_FAIL(
            context, MOR_ERROR_CONFIG,
            "override '%s': found entry [%d] of %s, which is %s; allowed: an entry that the file has, counted "
            "from 0; correct the key",
            from->origin, index, path, held);
    }
    mor_case_node *child = (*node)->first_child;
    for (int k = 0; k < index; ++k) {
        child = child->next;
    }
    *node = child;
    *at = digits + length + 1;
    return MOR_OK;
}

static mor_status follow_key(mor_context *context, const source *from, mor_case_node **node)
{
    const char *at = from->origin;
    *node = from->file->root;
    MOR_TRY(context, follow_name(context, from, &at, node));
    while (*at != '=') {
        if (*at == '[') {
            MOR_TRY(context, follow_index(context, from, &at, node));
        } else if (*at == '.') {
            ++at;
            MOR_TRY(context, follow_name(context, from, &at, node));
        } else {
            return fail_key(context, from->origin, at);
        }
    }
    return MOR_OK;
}

/* Tries the value as the file would; anything else, more than one setting included, is a text. */
static mor_status assign_value(mor_context *context, const source *from, const char *value, mor_case_node *node)
{
    char line[SETTING_BYTES_MAX + 16];
    locale_t locale = (locale_t)0;
    const int length = snprintf(line, sizeof line, "value = %s\n;", value);
    node->n_children = 0;
    node->first_child = NULL;
    MOR_TRY(context, make_locale(context, &locale));
    mor_status status = MOR_OK;
    if (mor_case_scan(context, "override", line, length) == MOR_OK) {
        config_t config;
        const bool is_one =
            parse_text(&config, line, locale) && config_setting_length(config_root_setting(&config)) == 1;
        if (is_one) {
            status = copy_value(context, from, config_setting_get_elem(config_root_setting(&config), 0), node);
        }
        config_destroy(&config);
        freelocale(locale);
        if (is_one) {
            return status;
        }
    } else {
        mor_context_clear_error(context);
        freelocale(locale);
    }
    node->kind = MOR_CASE_NODE_TEXT;
    return copy_text(context, from->file, value + strspn(value, " \t"), &node->text);
}

static bool is_word(const char *value, const char *word)
{
    const char *start = value + strspn(value, " \t");
    const size_t length = strlen(word);
    return strncmp(start, word, length) == 0 && start[length + strspn(start + length, " \t")] == '\0';
}

/* Takes a member out of its group. */
static mor_status leave_out(mor_context *context, const source *from, bool is_made, mor_case_node *node)
{
    mor_case_node *group = (mor_case_node *)node->parent;
    mor_case_node **link = &group->first_child;
    MOR_CHECK(context, !is_made, MOR_ERROR_CONFIG,
              "override '%s': found no such key in the file; allowed with " LEFT_OUT
              ": a key that the file has, which is then left out; one that it does not have is at its default already; "
              "leave the override out, or correct the key",
              from->origin);
    MOR_CHECK(context, group->kind == MOR_CASE_NODE_GROUP, MOR_ERROR_CONFIG,
              "override '%s': found " LEFT_OUT " for an entry of a list; allowed: for a member of a group, for entries "
              "have no defaults; write the list without the entry",
              from->origin);
    while (*link != node) {
        link = &(*link)->next;
    }
    *link = node->next;
    group->n_children -= 1;
    return MOR_OK;
}

mor_status mor_case_file_set(mor_context *context, mor_case_file *file, const char *setting)
{
    const char *equals = strchr(setting, '=');
    MOR_CHECK(context, strlen(setting) < SETTING_BYTES_MAX, MOR_ERROR_CONFIG,
              "override '%.40s...': found %zu bytes; allowed: fewer than %d; put the setting into the case file",
              setting, strlen(setting), SETTING_BYTES_MAX);
    MOR_CHECK(context, equals != NULL && equals[1 + strspn(equals + 1, " \t")] != '\0', MOR_ERROR_CONFIG,
              "override '%s': found no %s; allowed: key=value, such as numerics.courant=0.2; add it", setting,
              equals == NULL ? "'='" : "value after '='");
    source from = {file, NULL, false};
    MOR_TRY(context, copy_text(context, file, setting, &from.origin));
    mor_case_node *node = NULL;
    const int n_before = file->n_nodes;
    MOR_TRY(context, follow_key(context, &from, &node));
    if (is_word(equals + 1, LEFT_OUT)) {
        return leave_out(context, &from, file->n_nodes > n_before, node);
    }
    node->origin = from.origin;
    node->line = 0;
    return assign_value(context, &from, equals + 1, node);
}

const mor_case_node *mor_case_file_root(const mor_case_file *file)
{
    return file->root;
}
