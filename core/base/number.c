/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/number.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Longer numbers are refused, bytes. */
enum { NUMBER_BYTES = 512 };

static size_t skip_sign(const char *text, size_t at)
{
    return at + (text[at] == '+' || text[at] == '-');
}

static size_t skip_digits(const char *text, size_t at)
{
    return at + strspn(text + at, "0123456789");
}

bool mor_number_read(const char *text, size_t n_bytes, double *value)
{
    char number[NUMBER_BYTES];
    *value = 0.0;
    if (n_bytes == 0 || n_bytes >= sizeof number || memchr(text, '\0', n_bytes) != NULL) {
        return false;
    }
    memcpy(number, text, n_bytes);
    number[n_bytes] = '\0';
    const size_t first = skip_sign(number, 0);
    size_t at = skip_digits(number, first);
    size_t n_digits = at - first;
    if (number[at] == '.') {
        const size_t point = at;
        at = skip_digits(number, at + 1);
        n_digits += at - point - 1;
    }
    if (n_digits > 0 && (number[at] == 'e' || number[at] == 'E')) {
        const size_t exponent = skip_sign(number, at + 1);
        at = skip_digits(number, exponent);
        n_digits = at > exponent ? n_digits : 0;
    }
    if (n_digits == 0 || at != n_bytes) {
        return false;
    }
    char *end = NULL;
    *value = strtod(number, &end);
    return *end == '\0'; /* a locale of decimal commas stops at the point */
}

bool mor_number_is_nan(const char *text, size_t n_bytes)
{
    const size_t sign = n_bytes > 0 && (*text == '+' || *text == '-');
    return n_bytes - sign == 3 && strncasecmp(text + sign, "nan", 3) == 0;
}
