/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_compare.h"

#include "cases/driver/case/schema/case_schema.h"
#include "core/base/hash.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Mark of the comment that tells what a file held, see case_write.c. */
#define CONTENT_MARK "# content of the file: "
/* Mark of a value that the case file did not give. */
#define DEFAULT_MARK " # default"

/* Over before a run begins; its default follows the end. */
#define SETTLE_TIME ".settle_time"

enum { DEPTH_MAX = 32, PATH_BYTES = 192, LINE_BYTES = 4096, PERIOD_BYTES = 3 * LINE_BYTES + 16 };

/* In place of a number of probes: nothing may differ. */
enum { NOTHING_IS_FREE = -1 };

/* A walk over the lines of a case. Groups and lists that are open have a name or, in a list, a number. */
typedef struct walk {
    const char *at; /* next line */
    char names[DEPTH_MAX][MOR_CASE_NAME_BYTES];
    int counts[DEPTH_MAX]; /* entries so far */
    int depth;
    /* The present entry. */
    char path[PATH_BYTES];
    char value[LINE_BYTES];
    bool is_content; /* the hash of a file's content */
    bool is_over;
} walk;

/* The next line without its indent, its end and the mark of a default; false behind the last one. */
static bool read_line(walk *w, char *line)
{
    if (*w->at == '\0') {
        return false;
    }
    const size_t n = strcspn(w->at, "\n");
    const size_t indent = strspn(w->at, " ");
    snprintf(line, LINE_BYTES, "%.*s", n > indent ? (int)(n - indent) : 0, w->at + indent);
    w->at += n + (w->at[n] == '\n');
    const size_t mark = strlen(DEFAULT_MARK);
    const size_t length = strlen(line);
    if (length > mark && strcmp(line + length - mark, DEFAULT_MARK) == 0) {
        line[length - mark] = '\0';
    }
    return true;
}

/* "soil[0].material", then the name of an entry where there is one. */
static void set_path(walk *w, const char *name)
{
    size_t used = 0;
    w->path[0] = '\0';
    for (int d = 0; d < w->depth && d < DEPTH_MAX && used < sizeof w->path; ++d) {
        const bool is_entry = w->names[d][0] == '\0';
        const int n = is_entry
                          ? snprintf(w->path + used, sizeof w->path - used, "[%d]", d > 0 ? w->counts[d - 1] - 1 : 0)
                          : snprintf(w->path + used, sizeof w->path - used, "%s%s", used > 0 ? "." : "", w->names[d]);
        used += n > 0 ? (size_t)n : 0;
    }
    if (used < sizeof w->path && name[0] != '\0') {
        snprintf(w->path + used, sizeof w->path - used, "%s%s", used > 0 ? "." : "", name);
    }
}

/* Number of the next entry of the group; groups deeper than those that are followed count as one. */
static int next_number(walk *w)
{
    return w->depth > 0 && w->depth <= DEPTH_MAX ? w->counts[w->depth - 1]++ : 0;
}

static void open_group(walk *w, const char *name, size_t n_name)
{
    next_number(w);
    if (w->depth < DEPTH_MAX) {
        snprintf(w->names[w->depth], MOR_CASE_NAME_BYTES, "%.*s", (int)n_name, name);
        w->counts[w->depth] = 0;
    }
    w->depth += 1;
}

/* Takes "key = value;" apart. */
static void take_entry(walk *w, char *line)
{
    char *equals = strstr(line, " = ");
    const size_t length = strlen(line);
    if (length > 0 && (line[length - 1] == ';' || line[length - 1] == ',')) {
        line[length - 1] = '\0';
    }
    w->is_content = false;
    if (equals == NULL || line[0] == '(') { /* a point of a list */
        char number[16];
        snprintf(number, sizeof number, "[%d]", next_number(w));
        set_path(w, "");
        strncat(w->path, number, sizeof w->path - strlen(w->path) - 1);
        snprintf(w->value, sizeof w->value, "%s", line);
        return;
    }
    *equals = '\0';
    set_path(w, line);
    snprintf(w->value, sizeof w->value, "%s", equals + strlen(" = "));
}

/* Goes on to the next value. */
static void step_on(walk *w)
{
    char line[LINE_BYTES];
    while (read_line(w, line)) {
        const size_t n = strlen(line);
        const char *equals = strstr(line, " = ");
        if (strncmp(line, CONTENT_MARK, strlen(CONTENT_MARK)) == 0) {
            set_path(w, "content of its file");
            snprintf(w->value, sizeof w->value, "%s", line + strlen(CONTENT_MARK));
            w->is_content = true;
            return;
        }
        if (n == 0 || line[0] == '#') {
            continue;
        }
        if (line[0] == '}' || line[0] == ')') {
            w->depth -= w->depth > 0;
        } else if (strcmp(line, "{") == 0) {
            open_group(w, "", 0);
        } else if (equals != NULL && (strcmp(equals, " = {") == 0 || strcmp(equals, " = (") == 0)) {
            open_group(w, line, (size_t)(equals - line));
        } else {
            take_entry(w, line);
            return;
        }
    }
    w->is_over = true;
}

static bool starts_with(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

static bool ends_with(const char *text, const char *end)
{
    const size_t n = strlen(text);
    return n >= strlen(end) && strcmp(text + n - strlen(end), end) == 0;
}

/* Number of the probe that a path belongs to; -1: to none. */
static int find_probe(const char *path)
{
    return starts_with(path, "probes[") ? atoi(path + strlen("probes[")) : -1;
}

/* Values that may differ, or are judged by themselves. */
static bool is_free(const walk *w, int n_probes)
{
    if (n_probes == NOTHING_IS_FREE) {
        return false;
    }
    return strcmp(w->path, "end") == 0 || starts_with(w->path, "domain.") || starts_with(w->path, "output.") ||
           starts_with(w->path, "expect[") || find_probe(w->path) >= n_probes || ends_with(w->path, SETTLE_TIME);
}

/* Goes on to the next value that may not differ. */
static void step_to_fixed(walk *w, int n_probes)
{
    do {
        step_on(w);
    } while (!w->is_over && is_free(w, n_probes));
}

/* Writes a value by its path; false when there is none. */
static bool find_value(const char *text, const char *path, char *value)
{
    walk w = {.at = text};
    bool is_found = false;
    value[0] = '\0';
    for (step_on(&w); !w.is_over && !is_found; step_on(&w)) {
        is_found = strcmp(w.path, path) == 0;
        if (is_found) {
            snprintf(value, LINE_BYTES, "%s", w.value);
        }
    }
    return is_found;
}

/* Number of probes, and whether one of them needs the audit of the soil's energy; of those from a first one on, whether
 * one remembers from the start of a run on. */
static int count_probes(mor_case_probe_catalog probe_types, const char *text, int first, bool *has_audit,
                        bool *has_past)
{
    walk w = {.at = text};
    int n = 0;
    *has_audit = false;
    *has_past = false;
    for (step_on(&w); !w.is_over; step_on(&w)) {
        const int probe = find_probe(w.path);
        n = probe >= n ? probe + 1 : n;
        if (probe >= 0 && ends_with(w.path, ".type")) {
            char name[MOR_CASE_NAME_BYTES];
            snprintf(name, sizeof name, "%.*s", (int)strcspn(w.value + 1, "\""), w.value + 1);
            const mor_case_probe_type *type = mor_case_probe_type_find(probe_types, name);
            *has_past = *has_past || (probe >= first && type != NULL && (type->traits & MOR_CASE_PROBE_OF_PAST) != 0);
            *has_audit = *has_audit || (type != NULL && (type->traits & MOR_CASE_PROBE_OF_AUDIT) != 0);
        }
    }
    return n;
}

static void set_difference(mor_case_difference *it, const walk *given, const walk *saved, const char *reason)
{
    it->is_found = true;
    it->reason = reason;
    snprintf(it->found, sizeof it->found, given->is_over ? "nothing" : "%.120s = %.120s", given->path, given->value);
    snprintf(it->expected, sizeof it->expected, saved->is_over ? "nothing" : "%.120s = %.120s", saved->path,
             saved->value);
}

/* Reads up to three numbers, each with or without a unit: ("0 m", "1 m"). */
static int read_numbers(const char *value, double *numbers)
{
    int n = 0;
    while (*value != '\0' && n < 3) {
        char *end = NULL;
        value += strspn(value, "(\", ");
        numbers[n] = strtod(value, &end);
        if (end == value) {
            break;
        }
        n += 1;
        value = end + strcspn(end, ",");
    }
    return n;
}

/* Whether a corner of the domain has moved inwards; sign -1: the lowest, 1: the highest. */
static bool is_smaller(const char *given, const char *saved, double sign)
{
    double one[3] = {0.0};
    double other[3] = {0.0};
    const int n = read_numbers(given, one);
    bool is_inwards = read_numbers(saved, other) != n;
    for (int a = 0; a < n; ++a) {
        is_inwards = is_inwards || sign * one[a] < sign * other[a];
    }
    return is_inwards;
}

/* What a domain that repeats itself is, and its corners, in one text. */
static void read_period(const char *text, char *period, size_t n_bytes)
{
    static const char *const paths[] = {"domain.periodic", "domain.min", "domain.max"};
    char values[3][LINE_BYTES];
    for (int k = 0; k < 3; ++k) {
        if (!find_value(text, paths[k], values[k])) {
            snprintf(values[k], sizeof values[k], "%s", k == 0 ? "\"none\"" : "");
        }
    }
    const bool has_none = strcmp(values[0], "\"none\"") == 0;
    snprintf(period, n_bytes, "%s%s%s%s%s", values[0], has_none ? "" : " from ", has_none ? "" : values[1],
             has_none ? "" : " to ", has_none ? "" : values[2]);
}

/* Whether a domain repeats itself otherwise. */
static bool compare_periods(const char *given, const char *saved, mor_case_difference *it)
{
    char one[PERIOD_BYTES];
    char other[PERIOD_BYTES];
    read_period(given, one, sizeof one);
    read_period(saved, other, sizeof other);
    if (strcmp(one, other) == 0) {
        return false;
    }
    *it = (mor_case_difference){.is_found = true, .reason = "; a run goes on with the period it began with"};
    snprintf(it->found, sizeof it->found, "domain.periodic = %.*s", MOR_CASE_DIFFERENCE_BYTES - 24, one);
    snprintf(it->expected, sizeof it->expected, "domain.periodic = %.*s", MOR_CASE_DIFFERENCE_BYTES - 24, other);
    return true;
}

/* A value of the domain that is not what a run may go on with. */
static bool compare_domain(const char *given, const char *saved, mor_case_difference *it)
{
    static const char *const paths[] = {"domain.min", "domain.max", "domain.outflow"};
    static const char *const reasons[] = {"; the domain can only become larger", "; the domain can only become larger",
                                          "; soil that has left cannot be restored"};
    walk one = {.at = given};
    walk other = {.at = saved};
    for (int k = 0; k < 3; ++k) {
        snprintf(one.path, sizeof one.path, "%s", paths[k]);
        snprintf(other.path, sizeof other.path, "%s", paths[k]);
        one.is_over = !find_value(given, paths[k], one.value);
        other.is_over = !find_value(saved, paths[k], other.value);
        const bool is_refused = k < 2 ? is_smaller(one.value, other.value, k == 0 ? -1.0 : 1.0)
                                      : strcmp(one.value, other.value) != 0 && strcmp(other.value, "\"stop\"") != 0;
        if (is_refused) {
            set_difference(it, &one, &other, reasons[k]);
            return true;
        }
    }
    return false;
}

/* Walks over both cases side by side. */
static void compare_fixed(const char *given, const char *saved, int n_probes, mor_case_difference *it)
{
    walk one = {.at = given};
    walk other = {.at = saved};
    do {
        step_to_fixed(&one, n_probes);
        step_to_fixed(&other, n_probes);
        if (one.is_over != other.is_over ||
            (!one.is_over && (strcmp(one.path, other.path) != 0 || strcmp(one.value, other.value) != 0))) {
            const bool is_probe =
                n_probes != NOTHING_IS_FREE && find_probe(one.path) >= 0 && find_probe(other.path) >= 0;
            set_difference(it, &one, &other,
                           is_probe                         ? "; append new probes behind the existing ones"
                           : one.is_content && !one.is_over ? "; the file has changed since"
                                                            : "");
            return;
        }
    } while (!one.is_over);
}

void mor_case_compare(mor_case_probe_catalog probe_types, const char *given, const char *saved,
                      mor_case_difference *difference)
{
    bool has_audit = false;
    bool had_audit = false;
    bool has_past = false;
    const int n_probes = count_probes(probe_types, saved, 0, &had_audit, &has_past);
    const int n_given = count_probes(probe_types, given, n_probes, &has_audit, &has_past);
    *difference = (mor_case_difference){.is_found = false};
    compare_fixed(given, saved, n_probes, difference);
    if (difference->is_found || compare_domain(given, saved, difference) || compare_periods(given, saved, difference)) {
        return;
    }
    if (has_audit && !had_audit) {
        *difference = (mor_case_difference){
            .is_found = true,
            .reason = "; the audit of energy begins at the start of a run, so that such a probe cannot be added later"};
        snprintf(difference->found, sizeof difference->found, "a probe of the audit of energy among %d", n_given);
        snprintf(difference->expected, sizeof difference->expected, "none among %d", n_probes);
    } else if (has_past) {
        *difference = (mor_case_difference){
            .is_found = true,
            .reason = "; what such a probe tells begins at the start of a run, so that it cannot be added later"};
        snprintf(difference->found, sizeof difference->found, "a probe that looks back to the start among %d", n_given);
        snprintf(difference->expected, sizeof difference->expected, "%d probes", n_probes);
    }
}

void mor_case_compare_whole(const char *given, const char *saved, mor_case_difference *difference)
{
    *difference = (mor_case_difference){.is_found = false, .reason = ""};
    compare_fixed(given, saved, NOTHING_IS_FREE, difference);
}

uint64_t mor_case_compare_hash(const char *text)
{
    const size_t mark = strlen(DEFAULT_MARK);
    mor_hash hash;
    mor_hash_init(&hash);
    while (*text != '\0') {
        const size_t n = strcspn(text, "\n");
        const bool is_default = n > mark && strncmp(text + n - mark, DEFAULT_MARK, mark) == 0;
        mor_hash_add(&hash, text, is_default ? n - mark : n);
        mor_hash_add(&hash, "\n", 1);
        text += n + (text[n] == '\n');
    }
    return mor_hash_value(&hash);
}

bool mor_case_compare_domains(const char *given, const char *saved)
{
    static const char *const paths[] = {"domain.min", "domain.max"};
    char one[LINE_BYTES];
    char other[LINE_BYTES];
    bool is_same = true;
    for (int k = 0; k < 2; ++k) {
        is_same = find_value(given, paths[k], one) && find_value(saved, paths[k], other) && strcmp(one, other) == 0 &&
                  is_same;
    }
    return !is_same;
}
