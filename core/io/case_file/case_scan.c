/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/case_file/case_scan.h"

#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TOKEN_BYTES = 64 };

typedef struct scan {
    mor_context *context;
    const char *name;
    const char *text;
    int64_t n_bytes;
    int64_t at; /* next byte */
    int line;
    int depth;
    int n_settings;
    int n_values;
    char before; /* first byte of the last token, '\0' at the start */
    char open[MOR_CASE_SCAN_DEPTH_MAX];
    int open_line[MOR_CASE_SCAN_DEPTH_MAX];
    int n_inside[MOR_CASE_SCAN_DEPTH_MAX + 1]; /* settings of the open bracket at each depth */
} scan;

#define SCAN_FAIL(s, at_line, format, ...)                                                                             \
    MOR_FAIL((s)->context, MOR_ERROR_CONFIG, "%s:%d: " format, (s)->name, (at_line), __VA_ARGS__)

static char peek(const scan *s, int64_t ahead)
{
    return s->at + ahead < s->n_bytes ? s->text[s->at + ahead] : '\0';
}

static void step(scan *s)
{
    s->line += s->text[s->at] == '\n';
    s->at += 1;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static mor_status skip_string(scan *s)
{
    const int opened = s->line;
    if (s->before == '\0' || strchr("=:,([\"", s->before) == NULL) {
        return SCAN_FAIL(s, opened, "found a text where none can stand; allowed: %s",
                         "name = \"text\"; or a list of "
                         "texts; look for a missing '=', ',' or ';' before it");
    }
    step(s);
    while (s->at < s->n_bytes && peek(s, 0) != '"') {
        if (peek(s, 0) == '\n') {
            return SCAN_FAIL(s, opened, "found a text whose closing quote is not on its line; allowed: %s",
                             "\"text\" on "
                             "one line; add the quote");
        }
        if (peek(s, 0) == '\\' && s->at + 1 < s->n_bytes) {
            step(s);
        }
        step(s);
    }
    if (s->at >= s->n_bytes) {
        return SCAN_FAIL(s, opened, "found a text that is still open at the end of the file; allowed: %s",
                         "\"text\" on one line; add the quote, or fetch the file again if it was cut");
    }
    step(s);
    return MOR_OK;
}

static mor_status skip_block_comment(scan *s)
{
    const int opened = s->line;
    step(s);
    step(s);
    while (s->at < s->n_bytes && !(peek(s, 0) == '*' && peek(s, 1) == '/')) {
        step(s);
    }
    if (s->at >= s->n_bytes) {
        return SCAN_FAIL(s, opened, "found a comment that is still open at the end of the file; allowed: %s",
                         "/* comment */; add the closing mark");
    }
    step(s);
    step(s);
    return MOR_OK;
}

static void skip_line(scan *s)
{
    while (s->at < s->n_bytes && peek(s, 0) != '\n') {
        step(s);
    }
}

static mor_status open_bracket(scan *s, char c)
{
    if (s->depth >= MOR_CASE_SCAN_DEPTH_MAX) {
        return SCAN_FAIL(s, s->line, "found brackets nested more than %d deep; allowed: at most %d; remove some",
                         MOR_CASE_SCAN_DEPTH_MAX, MOR_CASE_SCAN_DEPTH_MAX);
    }
    s->open[s->depth] = c;
    s->open_line[s->depth] = s->line;
    s->depth += 1;
    s->n_inside[s->depth] = 0;
    step(s);
    return MOR_OK;
}

static char closing_of(char c)
{
    return c == '(' ? ')' : c == '{' ? '}' : ']';
}

static mor_status close_bracket(scan *s, char c)
{
    if (s->depth == 0) {
        return SCAN_FAIL(s, s->line, "found '%c' without its opening bracket; allowed: brackets in pairs; remove it",
                         c);
    }
    const char expected = closing_of(s->open[s->depth - 1]);
    if (c != expected) {
        return SCAN_FAIL(s, s->line, "found '%c'; allowed: '%c' to close the '%c' of line %d; put that first", c,
                         expected, s->open[s->depth - 1], s->open_line[s->depth - 1]);
    }
    s->depth -= 1;
    step(s);
    return MOR_OK;
}

/* ---- Number literals --------------------------------------------------------------------------------------------- */

static const char *skip_digits(const char *text)
{
    while (is_digit(*text)) {
        ++text;
    }
    return text;
}

/* The grammar of real literals: digits with a point or an exponent. */
static bool is_real_literal(const char *token)
{
    const char *start = token + (*token == '+' || *token == '-');
    const char *end = skip_digits(start);
    bool has_digit = end > start;
    if (*end == '.') {
        const char *fraction = end + 1;
        end = skip_digits(fraction);
        has_digit = has_digit || end > fraction;
    }
    if (*end == 'e' || *end == 'E') {
        const char *exponent = end + 1 + (end[1] == '+' || end[1] == '-');
        end = skip_digits(exponent);
        has_digit = has_digit && end > exponent;
    }
    return has_digit && *end == '\0';
}

static const char *skip_long_suffix(const char *text)
{
    text += *text == 'L';
    return text + (*text == 'L' && text[-1] == 'L');
}

/* Returns 0 when token is no whole-number literal, 1 when it is one in range, -1 when it is out of range. */
static int classify_integer(const char *token)
{
    const bool is_hex = token[0] == '0' && (token[1] == 'x' || token[1] == 'X');
    const char *digits = is_hex ? token + 2 : token + (*token == '+' || *token == '-');
    const char *end = is_hex ? digits + strspn(digits, "0123456789abcdefABCDEF") : skip_digits(digits);
    const bool is_long = *end == 'L';
    if (end == digits || *skip_long_suffix(end) != '\0') {
        return 0;
    }
    errno = 0;
    const long long value = strtoll(token, NULL, is_hex ? 16 : 10);
    return errno == 0 && (is_long || (value >= INT_MIN && value <= INT_MAX)) ? 1 : -1;
}

static mor_status check_number(scan *s)
{
    char token[TOKEN_BYTES];
    int length = 0;
    while (is_digit(peek(s, 0)) || is_letter(peek(s, 0)) || strchr("._+-%", peek(s, 0)) != NULL) {
        if (s->at >= s->n_bytes || length == TOKEN_BYTES - 1) {
            break;
        }
        token[length++] = peek(s, 0);
        step(s);
    }
    token[length] = '\0';
    const int is_integer = classify_integer(token);
    if (is_integer < 0) {
        return SCAN_FAIL(s, s->line,
                         "found the whole number %s; allowed: -2147483648 to 2147483647, beyond that up to 19 "
                         "digits with L after them, or a decimal point; write it in one of these ways",
                         token);
    }
    if (is_integer == 0 && !is_real_literal(token)) {
        return SCAN_FAIL(s, s->line,
                         "found '%s'; allowed: a number, or a text such as \"5 mm\" for a value with a unit; "
                         "put a value with a unit into quotes",
                         token);
    }
    return MOR_OK;
}

/* ---- The pass ---------------------------------------------------------------------------------------------------- */

static void skip_word(scan *s)
{
    while (is_letter(peek(s, 0)) || is_digit(peek(s, 0)) || (peek(s, 0) != '\0' && strchr("-_*", peek(s, 0)) != NULL)) {
        step(s);
    }
}

static mor_status count_mark(scan *s, char c)
{
    s->n_settings += c != ',';
    s->n_values += c == ',';
    s->n_inside[s->depth] += c != ',';
    if (s->n_inside[s->depth] > MOR_CASE_SCAN_GROUP_MAX) {
        return SCAN_FAIL(s, s->line,
                         "found more than %d settings in one group; allowed: at most these; is this a "
                         "case file?",
                         MOR_CASE_SCAN_GROUP_MAX);
    }
    if (s->n_settings > MOR_CASE_SCAN_SETTINGS_MAX || s->n_values > MOR_CASE_SCAN_VALUES_MAX) {
        return SCAN_FAIL(s, s->line,
                         "found more than %d settings or %d list entries; allowed: at most these; is this a "
                         "case file?",
                         MOR_CASE_SCAN_SETTINGS_MAX, MOR_CASE_SCAN_VALUES_MAX);
    }
    step(s);
    return MOR_OK;
}

static mor_status scan_significant(scan *s)
{
    const char c = peek(s, 0);
    if (c == '"') {
        return skip_string(s);
    }
    if (c == '(' || c == '{' || c == '[') {
        return open_bracket(s, c);
    }
    if (c == ')' || c == '}' || c == ']') {
        return close_bracket(s, c);
    }
    if (c == '=' || c == ':' || c == ',') {
        return count_mark(s, c);
    }
    if (c == '@') {
        return SCAN_FAIL(s, s->line,
                         "found '@'%s; allowed: one file that holds the whole case; put the included settings "
                         "into this file",
                         peek(s, 1) == 'i' ? " of an @include" : "");
    }
    if (is_digit(c) || c == '+' || c == '-' || c == '.') {
        return check_number(s);
    }
    if (is_letter(c) || c == '*') {
        skip_word(s);
        return MOR_OK;
    }
    step(s);
    return MOR_OK;
}

static mor_status scan_token(scan *s)
{
    const char c = peek(s, 0);
    if (c == '/' && peek(s, 1) == '*') {
        return skip_block_comment(s);
    }
    if (c == '#' || (c == '/' && peek(s, 1) == '/')) {
        skip_line(s);
        return MOR_OK;
    }
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        step(s);
        return MOR_OK;
    }
    MOR_TRY(s->context, scan_significant(s));
    s->before = c;
    return MOR_OK;
}

static mor_status check_bytes(const scan *s)
{
    int line = 1;
    for (int64_t k = 0; k < s->n_bytes; ++k) {
        const unsigned char c = (unsigned char)s->text[k];
        line += c == '\n';
        if ((c < 0x20 && c != '\n' && c != '\t' && c != '\r') || c == 0x7f) {
            return SCAN_FAIL(s, line, "found the control byte 0x%02x; allowed: plain text; is this a case file?", c);
        }
    }
    return MOR_OK;
}

mor_status mor_case_scan(mor_context *context, const char *name, const char *text, int64_t n_bytes)
{
    scan s = {.context = context, .name = name, .text = text, .n_bytes = n_bytes, .line = 1};
    if (n_bytes > MOR_CASE_SCAN_BYTES_MAX) {
        return SCAN_FAIL(&s, 0, "found %lld bytes; allowed: at most %d; is this a case file?", (long long)n_bytes,
                         MOR_CASE_SCAN_BYTES_MAX);
    }
    MOR_TRY(context, check_bytes(&s));
    while (s.at < s.n_bytes) {
        MOR_TRY(context, scan_token(&s));
    }
    if (s.depth > 0) {
        const int last = s.depth - 1;
        return SCAN_FAIL(&s, s.open_line[last],
                         "found '%c' that is still open at the end of the file; allowed: brackets "
                         "in pairs; add '%c', or fetch the file again if it was cut",
                         s.open[last], closing_of(s.open[last]));
    }
    return MOR_OK;
}

/* ---- Names that a group has twice -------------------------------------------------------------------------------- */

/* A setting: its name, and the depth of its group. */
typedef struct setting {
    int64_t at;     /* of the name */
    int64_t length; /* of it */
    int line, depth;
} setting;

/* Goes on behind the name of the next setting; begins, if not NULL, gets where the bracket at each depth begins. */
static bool find_setting(scan *s, int64_t *begins, setting *found)
{
    setting word = {0, 0, 0, 0};
    while (s->at < s->n_bytes) {
        const int64_t at = s->at;
        const int line = s->line;
        const char c = peek(s, 0);
        if (scan_token(s) != MOR_OK) {
            return false; /* not of a text that was passed */
        }
        if (begins != NULL && (c == '{' || c == '(' || c == '[')) {
            begins[s->depth] = s->at;
        }
        if (is_letter(c) || c == '*') {
            word = (setting){at, s->at - at, line, s->depth};
        }
        if ((c == '=' || c == ':') && word.length > 0) {
            *found = word;
            return true;
        }
    }
    return false;
}

/* Line of the setting of the same name that begins before, in a group that begins at a place; 0: none. */
static int find_first(const scan *s, int64_t begin, const setting *it)
{
    scan group = {.context = s->context, .name = s->name, .text = s->text, .n_bytes = it->at, .at = begin, .line = 1};
    setting other;
    for (int64_t k = 0; k < begin; ++k) {
        group.line += s->text[k] == '\n';
    }
    while (find_setting(&group, NULL, &other)) {
        if (other.depth == 0 && other.length == it->length &&
            memcmp(s->text + other.at, s->text + it->at, (size_t)it->length) == 0) {
            return other.line;
        }
    }
    return 0;
}

int mor_case_scan_duplicate(mor_context *context, const char *text, int64_t n_bytes, int line, char *key,
                            size_t key_bytes)
{
    scan s = {.context = context, .name = "", .text = text, .n_bytes = n_bytes, .line = 1};
    int64_t begins[MOR_CASE_SCAN_DEPTH_MAX + 1] = {0};
    setting it;
    key[0] = '\0';
    while (find_setting(&s, begins, &it) && it.line <= line) {
        const int first = it.line == line ? find_first(&s, begins[it.depth], &it) : 0;
        if (first > 0) {
            snprintf(key, key_bytes, "%.*s", (int)it.length, text + it.at);
            return first;
        }
    }
    return 0;
}
