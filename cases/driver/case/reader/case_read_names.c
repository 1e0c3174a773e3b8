/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/reader/case_reader.h"

#include "core/base/nearest.h"
#include "core/material/params.h"

#include <stdio.h>
#include <string.h>

/* Names and structure: which members a group has, lists of groups, words out of a list. */

enum { NAMES_MAX = 96, LIST_BYTES = 1024 };

/* Words with commas; of many, those that fit, and the number of the others. */
static void join_words(const char *const *words, int n_words, char *text, size_t text_bytes)
{
    const size_t room = text_bytes - sizeof ", and 1000 more";
    size_t used = 0;
    text[0] = '\0';
    for (int k = 0; k < n_words; ++k) {
        if (used + strlen(words[k]) + 2 > room) {
            snprintf(text + used, text_bytes - used, ", and %d more", n_words - k);
            return;
        }
        used += (size_t)snprintf(text + used, text_bytes - used, "%s%s", k > 0 ? ", " : "", words[k]);
    }
}

/* Of the words the one nearest to another, or NULL when none is near. */
static const char *nearest_word(const char *word, const char *const *words, int n_words)
{
    const int nearest = mor_nearest_find(word, words, n_words);
    return nearest >= 0 ? words[nearest] : NULL;
}

/* Proposes a word, or says something else when there is none. */
static void propose_word(const char *meant, const char *otherwise, char *text, size_t text_bytes)
{
    if (meant != NULL) {
        snprintf(text, text_bytes, "did you mean '%s'?", meant);
    } else {
        snprintf(text, text_bytes, "%s", otherwise);
    }
}

static int add_name(const char **names, int n, const char *name)
{
    if (n < NAMES_MAX) {
        names[n++] = name;
    }
    return n;
}

static int collect_names(const mor_case_group *group, const char *extra, const mor_schema *more, const char **names)
{
    int n = extra == NULL ? 0 : add_name(names, 0, extra);
    for (const mor_case_key *key = group->keys; key->schema.key != NULL; ++key) {
        n = add_name(names, n, key->schema.key);
    }
    for (const mor_case_part *part = group->parts; part != NULL && part->name != NULL; ++part) {
        n = add_name(names, n, part->name);
    }
    for (const mor_schema *entry = more; entry != NULL && entry->key != NULL; ++entry) {
        n = add_name(names, n, entry->key);
    }
    return n;
}

static bool is_among(const char *word, const char *const *words, int n_words)
{
    for (int k = 0; k < n_words; ++k) {
        if (strcmp(words[k], word) == 0) {
            return true;
        }
    }
    return false;
}

static bool is_former(const char *word, const mor_case_group *group)
{
    for (const mor_case_key *key = group->keys; key->schema.key != NULL; ++key) {
        if (key->former != NULL && strcmp(key->former, word) == 0) {
            return true;
        }
    }
    return false;
}

/* Keeps the mistake that the last error is about, and forgets that error.
 * group: that has the name; meant: the name that was proposed, or NULL. */
static void keep_mistake(const mor_case_reader *reader, const mor_case_node *group, const mor_case_node *node,
                         const char *path, const char *meant)
{
    mor_case_mistakes *mistakes = reader->mistakes;
    bool is_told = true;
    if (mistakes->n++ == 0) {
        mistakes->first = *reader->context;
    } else {
        char place[MOR_CASE_NODE_TEXT_BYTES];
        char advice[MOR_CASE_NODE_TEXT_BYTES];
        const size_t used = strlen(mistakes->others);
        const size_t room = sizeof mistakes->others - used;
        mor_case_node_place(node, place, sizeof place);
        propose_word(meant, "'list keys' tells what there is", advice, sizeof advice);
        const int n = snprintf(mistakes->others + used, room, "\n%s: found '%.80s' in %s, unknown, too; %s", place,
                               node->name, path, advice);
        if (n < 0 || (size_t)n >= room) {
            mistakes->others[used] = '\0';
            mistakes->n_untold += 1;
            is_told = false;
        }
    }
    if (meant != NULL && is_told && mistakes->n_proposals < MOR_CASE_PROPOSALS_MAX) {
        mistakes->proposals[mistakes->n_proposals++] = (mor_case_proposal){.group = group, .name = meant};
    }
    mor_context_clear_error(reader->context);
}

mor_status mor_case_reader_names(const mor_case_reader *reader, const mor_case_node *node, const mor_case_group *group,
                                 const char *extra, const mor_schema *more)
{
    const char *names[NAMES_MAX];
    const int n_names = collect_names(group, extra, more, names);
    for (const mor_case_node *child = node == NULL ? NULL : node->first_child; child != NULL; child = child->next) {
        if (is_among(child->name, names, n_names) || is_former(child->name, group)) {
            continue;
        }
        char path[MOR_CASE_NODE_TEXT_BYTES];
        char allowed[LIST_BYTES];
        char advice[MOR_CASE_NODE_TEXT_BYTES];
        mor_case_node_path(node, path, sizeof path);
        join_words(names, n_names, allowed, sizeof allowed);
        const int entry = more == NULL ? -1 : mor_params_find_symbol(more, child->name);
        const char *meant = entry >= 0 ? more[entry].key : nearest_word(child->name, names, n_names);
        propose_word(meant, "use one of these", advice, sizeof advice);
        const mor_status status =
            MOR_CASE_NODE_FAIL(reader->context, child, "found the unknown name '%.80s' in %s; allowed: %s; %s",
                               child->name, path, allowed, advice);
        if (reader->mistakes == NULL) {
            return status;
        }
        keep_mistake(reader, node, child, path, meant);
    }
    return MOR_OK;
}

mor_status mor_case_reader_finish(const mor_case_reader *reader, mor_status status)
{
    const mor_case_mistakes *mistakes = reader->mistakes;
    char last[MOR_CONTEXT_MESSAGE_BYTES] = "";
    char untold[64] = "";
    if (mistakes == NULL || mistakes->n == 0) {
        return status;
    }
    if (status != MOR_OK && !mistakes->ends_with_misspelled) {
        snprintf(last, sizeof last, "\n%.*s", (int)(sizeof last - 2), reader->context->message);
    }
    if (mistakes->n_untold > 0) {
        snprintf(untold, sizeof untold, "\nand %d more unknown names", mistakes->n_untold);
    }
    mor_context_restore_error(reader->context, &mistakes->first);
    const size_t used = strlen(reader->context->message);
    snprintf(reader->context->message + used, sizeof reader->context->message - used, "%s%s%s", mistakes->others,
             untold, last);
    return MOR_ERROR_CONFIG;
}

mor_status mor_case_reader_refuse_missing(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                          const char *allowed)
{
    char path[MOR_CASE_NODE_TEXT_BYTES];
    mor_case_mistakes *mistakes = reader->mistakes;
    for (int k = 0; mistakes != NULL && k < mistakes->n_proposals; ++k) {
        const mor_case_proposal *proposal = &mistakes->proposals[k];
        if (proposal->group == group && strcmp(proposal->name, name) == 0) {
            mistakes->ends_with_misspelled = true;
        }
    }
    mor_case_node_path(group, path, sizeof path);
    return MOR_CASE_NODE_FAIL(reader->context, group, "found no '%s' in %s; allowed: %s; add it", name, path, allowed);
}

mor_status mor_case_reader_refuse(const mor_case_reader *reader, const mor_case_node *node, const char *what,
                                  const char *const *words, int n_words)
{
    char path[MOR_CASE_NODE_TEXT_BYTES];
    char found[MOR_CASE_NODE_TEXT_BYTES];
    char allowed[LIST_BYTES];
    char advice[MOR_CASE_NODE_TEXT_BYTES];
    mor_case_node_path(node, path, sizeof path);
    mor_case_node_format(node, found, sizeof found);
    join_words(words, n_words, allowed, sizeof allowed);
    propose_word(nearest_word(node->kind == MOR_CASE_NODE_TEXT ? node->text : "", words, n_words), "use one of these",
                 advice, sizeof advice);
    return MOR_CASE_NODE_FAIL(reader->context, node, "found %s = %s; allowed: %s (%s); %s", path, found,
                              n_words > 0 ? allowed : "none, there are none yet", what, advice);
}

static const char *name_kind(mor_case_node_kind kind)
{
    switch (kind) {
    case MOR_CASE_NODE_GROUP:
        return "a group { name = value; ... }";
    case MOR_CASE_NODE_LIST:
        return "a list ( ..., ... )";
    case MOR_CASE_NODE_TEXT:
        return "a text in quotes";
    case MOR_CASE_NODE_INTEGER:
    case MOR_CASE_NODE_REAL:
        return "a number";
    case MOR_CASE_NODE_BOOLEAN:
        return "true or false";
    }
    return "a value";
}

static mor_status check_kind(const mor_case_reader *reader, const mor_case_node *node, mor_case_node_kind kind)
{
    if (node->kind == kind) {
        return MOR_OK;
    }
    char path[MOR_CASE_NODE_TEXT_BYTES];
    char found[MOR_CASE_NODE_TEXT_BYTES];
    mor_case_node_path(node, path, sizeof path);
    mor_case_node_format(node, found, sizeof found);
    return MOR_CASE_NODE_FAIL(reader->context, node, "found %s = %s; allowed: %s; write it in that form", path, found,
                              name_kind(kind));
}

mor_status mor_case_reader_member(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                  mor_case_node_kind kind, const mor_case_node **child)
{
    *child = mor_case_node_find(group, name);
    if (*child == NULL) {
        return mor_case_reader_refuse_missing(reader, group, name, name_kind(kind));
    }
    return check_kind(reader, *child, kind);
}

mor_status mor_case_reader_list(const mor_case_reader *reader, const mor_case_node *root, const char *name, int n_max,
                                const mor_case_node **list)
{
    *list = mor_case_node_find(root, name);
    if (*list == NULL) {
        return MOR_OK;
    }
    char found[MOR_CASE_NODE_TEXT_BYTES];
    mor_case_node_format(*list, found, sizeof found);
    if ((*list)->kind != MOR_CASE_NODE_LIST || (*list)->n_children < 1 || (*list)->n_children > n_max) {
        return MOR_CASE_NODE_FAIL(reader->context, *list,
                                  "found %s = %s; allowed: a list of 1 to %d groups; write %s = "
                                  "( { ... }, { ... } )%s",
                                  name, found, n_max, name,
                                  (*list)->kind == MOR_CASE_NODE_LIST && (*list)->n_children == 0 ? " or leave it out"
                                                                                                  : "");
    }
    for (const mor_case_node *child = (*list)->first_child; child != NULL; child = child->next) {
        MOR_TRY(reader->context, check_kind(reader, child, MOR_CASE_NODE_GROUP));
    }
    return MOR_OK;
}
