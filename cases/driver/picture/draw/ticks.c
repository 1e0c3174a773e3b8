/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/draw/ticks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double round_off = 1e-9;       /* of a step: a tick this close to the edge of the range belongs to it */
static const double smallest_size = 1e-100; /* anything below counts as zero: its powers would underflow */

static int count_multiples(double low, double high, double step)
{
    const double n = floor(high / step + round_off) - ceil(low / step - round_off) + 1.0;
    return n > 1e6 ? 1000000 : (int)n;
}

/* Powers of ten up to 22 are exact; dividing by them keeps 0.1 and 0.2 correctly rounded. */
static double make_step(double multiple, int exponent)
{
    return exponent >= 0 ? multiple * pow(10.0, exponent) : multiple / pow(10.0, -exponent);
}

mor_ticks mor_ticks_choose(double low, double high, int limit)
{
    static const double multiples[3] = {1.0, 2.0, 5.0};
    int exponent = (int)floor(log10((high - low) / limit)) - 1;
    int choice = 0;
    double step = make_step(multiples[choice], exponent);
    while (count_multiples(low, high, step) > limit) {
        choice = (choice + 1) % 3;
        exponent += choice == 0;
        step = make_step(multiples[choice], exponent);
    }
    mor_ticks ticks = {.first = ceil(low / step - round_off) * step, .step = step};
    ticks.n_ticks = count_multiples(low, high, step);
    if (ticks.n_ticks < 1) {
        ticks.first = low;
        ticks.n_ticks = 1;
    }
    return ticks;
}

double mor_ticks_value(const mor_ticks *ticks, int k)
{
    const double value = ticks->first + k * ticks->step;
    return fabs(value) < 1e-6 * ticks->step ? 0.0 : value;
}

void mor_ticks_round_out(double *low, double *high, int limit)
{
    const double size = fmax(fabs(*low), fabs(*high));
    if (size < smallest_size) {
        *low = 0.0;
        *high = 1.0;
    } else if (*high - *low < 1e-9 * size) {
        *low -= 0.5 * size;
        *high += 0.5 * size;
    }
    if (*low > 0.0 && *low < 0.3 * *high) {
        *low = 0.0;
    }
    if (*high < 0.0 && *high > 0.3 * *low) {
        *high = 0.0;
    }
    const double half = 0.5 * mor_ticks_choose(*low, *high, limit).step;
    *low = floor(*low / half + round_off) * half;
    *high = ceil(*high / half - round_off) * half;
}

static void append(char *text, size_t bytes, const char *more)
{
    const size_t used = strlen(text);
    if (used + strlen(more) < bytes) {
        memcpy(text + used, more, strlen(more) + 1);
    }
}

static void append_superscript(char *text, size_t bytes, int number)
{
    static const char *const digits[10] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char plain[16];
    snprintf(plain, sizeof plain, "%d", number);
    for (const char *c = plain; *c != '\0'; ++c) {
        append(text, bytes, *c == '-' ? "⁻" : digits[*c - '0']);
    }
}

/* printf writes ASCII '-'; the typographic minus is as wide as a digit. */
static void append_number(char *text, size_t bytes, double value, int decimals)
{
    char plain[MOR_TICKS_TEXT_BYTES];
    snprintf(plain, sizeof plain, "%.*f", decimals, fabs(value));
    if (value < 0.0) {
        append(text, bytes, "\u2212");
    }
    append(text, bytes, plain);
}

void mor_ticks_format(double value, double step, char *text)
{
    text[0] = '\0';
    const int step_exponent = (int)floor(log10(step) + round_off);
    const double size = fmax(fabs(value), step);
    if (size >= 1e6 || step < 1e-5) {
        if (value == 0.0) {
            append(text, MOR_TICKS_TEXT_BYTES, "0");
            return;
        }
        const int exponent = (int)floor(log10(fabs(value)) + round_off);
        const int decimals = exponent - step_exponent;
        append_number(text, MOR_TICKS_TEXT_BYTES, value / pow(10.0, exponent), decimals < 0 ? 0 : decimals);
        append(text, MOR_TICKS_TEXT_BYTES, "·10");
        append_superscript(text, MOR_TICKS_TEXT_BYTES, exponent);
        return;
    }
    append_number(text, MOR_TICKS_TEXT_BYTES, value, step_exponent < 0 ? -step_exponent : 0);
}

/* "m2" in field tables is "m²" in print, and "*" a raised dot. */
static void append_unit(char *text, size_t bytes, const char *unit)
{
    for (const char *c = unit; *c != '\0'; ++c) {
        const bool is_exponent = c > unit && *c >= '0' && *c <= '9' &&
                                 ((c[-1] >= 'a' && c[-1] <= 'z') || (c[-1] >= 'A' && c[-1] <= 'Z') || c[-1] == '^');
        if (is_exponent) {
            append_superscript(text, bytes, *c - '0');
        } else if (*c == '*') {
            append(text, bytes, "·");
        } else if (*c != '^') {
            append(text, bytes, (const char[2]){*c, '\0'});
        }
    }
}

static bool takes_prefix(const char *unit)
{
    static const char *const symbols[6] = {"m", "s", "Pa", "J", "N", "W"};
    for (int k = 0; k < 6; ++k) {
        const size_t length = strlen(symbols[k]);
        const bool starts = strncmp(unit, symbols[k], length) == 0;
        if (starts && (unit[length] == '\0' || strchr("/ *", unit[length]) != NULL)) {
            return true;
        }
    }
    return false;
}

/* Meters and seconds read well over a wide span, pascals and joules do not: hence the two lower edges. */
static int choose_exponent(const char *unit, double largest)
{
    if (largest == 0.0) {
        return 0;
    }
    const bool has_prefix = takes_prefix(unit);
    const bool is_everyday = unit[0] == 'm' || unit[0] == 's';
    const double lower = !has_prefix ? 1e-3 : (is_everyday ? 0.0999 : 0.999);
    const double upper = !has_prefix ? 1e5 : (is_everyday ? 9999.0 : 999.9);
    if (largest >= lower && largest <= upper) {
        return 0;
    }
    const int thousand = 3 * (int)floor(log10(largest * (1.0 + round_off)) / 3.0);
    if (!has_prefix) {
        return thousand;
    }
    if (unit[0] == 's' && thousand > 0) {
        return 0;
    }
    return thousand < -9 ? -9 : (thousand > 9 ? 9 : thousand);
}

double mor_ticks_prefix(const char *unit, double largest, char *text)
{
    static const char *const prefixes[7] = {"n", "µ", "m", "", "k", "M", "G"};
    text[0] = '\0';
    const int exponent = choose_exponent(unit, largest);
    const bool is_plain = strcmp(unit, "1") == 0 || unit[0] == '\0';
    if (takes_prefix(unit)) {
        append(text, MOR_TICKS_TEXT_BYTES, prefixes[exponent / 3 + 3]);
    } else if (exponent != 0) {
        append(text, MOR_TICKS_TEXT_BYTES, "10");
        append_superscript(text, MOR_TICKS_TEXT_BYTES, exponent);
        append(text, MOR_TICKS_TEXT_BYTES, is_plain ? "" : " ");
    } else if (is_plain) {
        append(text, MOR_TICKS_TEXT_BYTES, "–");
    }
    if (!is_plain) {
        append_unit(text, MOR_TICKS_TEXT_BYTES, unit);
    }
    return pow(10.0, -exponent);
}

void mor_ticks_label(const char *name, const char *unit, char *label)
{
    const char *text = name == NULL ? "" : name;
    const size_t room = MOR_TICKS_LABEL_BYTES - strlen(unit) - 4;
    size_t n_bytes = strlen(text);
    if (n_bytes > room) {
        n_bytes = room;
        while (n_bytes > 0 && ((unsigned char)text[n_bytes] & 0xC0u) == 0x80u) {
            n_bytes -= 1;
        }
    }
    snprintf(label, MOR_TICKS_LABEL_BYTES, "%.*s%s[%s]", (int)n_bytes, text, n_bytes > 0 ? " " : "", unit);
}
