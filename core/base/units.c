/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/units.h"

#include "core/base/memory.h"
#include "core/base/process_lock.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <udunits2.h>

enum { UNIT_BYTES = 64, EXPONENT_DIGITS = 2 };

struct mor_units {
    ut_system *system;
    locale_t locale; /* the one with a decimal point */
};

static const char *const base_symbols[MOR_BASE_COUNT] = {"m", "kg", "s", "rad", "K", "A", "mol", "cd"};

/* State of UDUNITS and the C library saved while a unit is read. */
typedef struct quiet {
    locale_t locale;
    ut_error_message_handler handler;
} quiet;

/* UDUNITS has one state per process: one thread at a time. */
static quiet enter_quiet(locale_t locale)
{
    mor_process_lock();
    return (quiet){uselocale(locale), ut_set_error_message_handler(ut_ignore)};
}

static void leave_quiet(quiet previous)
{
    ut_set_error_message_handler(previous.handler);
    uselocale(previous.locale);
    mor_process_unlock();
}

static bool map_degrees(ut_system *system)
{
    ut_unit *degree = ut_get_unit_by_name(system, "degree");
    if (degree == NULL) {
        return false;
    }
    const bool is_mapped = ut_map_symbol_to_unit("deg", UT_ASCII, degree) == UT_SUCCESS;
    ut_free(degree);
    return is_mapped;
}

mor_status mor_units_new(mor_context *context, mor_units **units)
{
    mor_status status = MOR_NEW(context, units, 1, "unit system");
    if (status != MOR_OK) {
        return mor_context_pass(context, status, MOR_HERE);
    }
    (*units)->locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if ((*units)->locale == (locale_t)0) {
        mor_units_free(context, units);
        return MOR_FAIL(context, MOR_ERROR_MEMORY,
                        "cannot make the locale that numbers are read with: not enough memory");
    }
    const quiet previous = enter_quiet((*units)->locale);
    (*units)->system = ut_read_xml(NULL);
    const bool is_ready = (*units)->system != NULL && map_degrees((*units)->system);
    leave_quiet(previous);
    if (!is_ready) {
        mor_units_free(context, units);
        return MOR_FAIL(context, MOR_ERROR_IO,
                        "the unit tables of UDUNITS-2 cannot be read; install them (Debian: libudunits2-data), and if "
                        "UDUNITS2_XML_PATH is set let it name a good udunits2.xml");
    }
    return MOR_OK;
}

void mor_units_free(mor_context *context, mor_units **units)
{
    if (*units == NULL) {
        return;
    }
    mor_process_lock();
    ut_free_system((*units)->system);
    mor_process_unlock();
    if ((*units)->locale != (locale_t)0) {
        freelocale((*units)->locale);
    }
    MOR_FREE(context, units);
}

/* ---- Dimensions -------------------------------------------------------------------------------------------------- */

bool mor_dimension_equal(const mor_dimension *a, const mor_dimension *b)
{
    return memcmp(a->power, b->power, sizeof a->power) == 0;
}

void mor_dimension_format(const mor_dimension *dimension, char *text, size_t text_bytes)
{
    static const mor_base_quantity order[MOR_BASE_COUNT] = {MOR_BASE_MASS,   MOR_BASE_LENGTH,      MOR_BASE_ANGLE,
                                                            MOR_BASE_TIME,   MOR_BASE_TEMPERATURE, MOR_BASE_CURRENT,
                                                            MOR_BASE_AMOUNT, MOR_BASE_LIGHT};
    size_t used = 0;
    text[0] = '\0';
    for (int k = 0; k < MOR_BASE_COUNT && used < text_bytes; ++k) {
        const int power = dimension->power[order[k]];
        const char *space = used > 0 ? " " : "";
        if (power == 1) {
            used += (size_t)snprintf(text + used, text_bytes - used, "%s%s", space, base_symbols[order[k]]);
        } else if (power != 0) {
            used += (size_t)snprintf(text + used, text_bytes - used, "%s%s%d", space, base_symbols[order[k]], power);
        }
    }
    if (used == 0) {
        snprintf(text, text_bytes, "1");
    }
}

int mor_dimension_scale(const mor_dimension *dimension, int length, int mass, int time)
{
    return dimension->power[MOR_BASE_LENGTH] * length + dimension->power[MOR_BASE_MASS] * mass +
           dimension->power[MOR_BASE_TIME] * time;
}

/* ---- Walking a unit of UDUNITS ----------------------------------------------------------------------------------- */

/* A unit taken apart: one of it is factor times the coherent SI unit of the dimension. The visitor comes first so that
 * the argument UDUNITS hands back also reaches the table of functions. */
typedef struct unit_parts {
    ut_visitor visitor;
    mor_dimension dimension;
    double factor;
} unit_parts;

static ut_status add_base(unit_parts *parts, const ut_unit *base, int power)
{
    const char *symbol = ut_get_symbol(base, UT_ASCII);
    for (int k = 0; symbol != NULL && k < MOR_BASE_COUNT; ++k) {
        if (strcmp(symbol, base_symbols[k]) == 0) {
            parts->dimension.power[k] += power;
            return UT_SUCCESS;
        }
    }
    return UT_MEANINGLESS;
}

static ut_status visit_basic(const ut_unit *unit, void *argument)
{
    return add_base(argument, unit, 1);
}

static ut_status visit_product(const ut_unit *unit, int count, const ut_unit *const *bases, const int *powers,
                               void *argument)
{
    (void)unit;
    for (int k = 0; k < count; ++k) {
        if (add_base(argument, bases[k], powers[k]) != UT_SUCCESS) {
            return UT_MEANINGLESS;
        }
    }
    return UT_SUCCESS;
}

static ut_status visit_galilean(const ut_unit *unit, double scale, const ut_unit *underlying, double offset,
                                void *argument)
{
    unit_parts *parts = argument;
    (void)unit;
    if (offset != 0.0) {
        return UT_MEANINGLESS;
    }
    parts->factor *= scale;
    return ut_accept_visitor(underlying, &parts->visitor, parts);
}

static ut_status visit_timestamp(const ut_unit *unit, const ut_unit *time_unit, double origin, void *argument)
{
    (void)unit, (void)time_unit, (void)origin, (void)argument;
    return UT_MEANINGLESS;
}

static ut_status visit_logarithmic(const ut_unit *unit, double base, const ut_unit *reference, void *argument)
{
    (void)unit, (void)base, (void)reference, (void)argument;
    return UT_MEANINGLESS;
}

/* Factors are products of rounded ones; one that means a short decimal number, as 1000 for g/cm3, becomes that. */
static double snap_to_decimal(double factor, locale_t locale)
{
    char text[32];
    const locale_t previous = uselocale(locale);
    snprintf(text, sizeof text, "%.12g", factor);
    const double decimal = strtod(text, NULL);
    uselocale(previous);
    return fabs(decimal - factor) <= 4.0e-16 * fabs(factor) ? decimal : factor; /* two units in the last place */
}

static bool is_in(char c, const char *set)
{
    return c != '\0' && strchr(set, c) != NULL;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Whether a digit at unit[k] belongs to an exponent: after a letter, ')', '^' or the sign of one, not a factor. */
static bool is_exponent(const char *unit, size_t k)
{
    while (k > 0 && is_digit(unit[k - 1])) {
        --k;
    }
    if (k > 0 && (unit[k - 1] == '-' || unit[k - 1] == '+')) {
        --k;
    }
    return k > 0 && !is_in(unit[k - 1], " \t./*(+-");
}

/* Returns what is wrong with the spelling of a unit, NULL when nothing is. It refuses what would have another
 * meaning in UDUNITS: dates, shifts, factors inside the unit, exponents without end. */
static const char *find_spelling_fault(const char *unit)
{
    size_t n_digits = 0;
    if (strlen(unit) >= UNIT_BYTES) {
        return "it is too long";
    }
    if (is_in(unit[0], "+-./*^")) {
        return "it starts with an operator";
    }
    const size_t start = strncmp(unit, "1/", 2) == 0 ? 2 : 0;
    for (size_t k = start; unit[k] != '\0'; ++k) {
        n_digits = is_digit(unit[k]) ? n_digits + 1 : 0;
        if (is_in(unit[k], "@:,;=!?<>|&\"'\\{}[]#$~`") || (unsigned char)unit[k] < 0x20) {
            return "it has a character that no unit has";
        }
        if (n_digits > EXPONENT_DIGITS || (is_digit(unit[k]) && !is_exponent(unit, k))) {
            return "a number inside it must be an exponent of at most two digits, as in kg/m3";
        }
    }
    return NULL;
}

/* A unit of the same letters in another case; NULL when there is none. Where two differ only in case, as MPa and mPa
 * do, it is the one common in soil mechanics. */
static const char *find_other_case(const char *unit)
{
    static const char *const known[] = {
        "Pa",  "kPa", "MPa", "GPa", "m",     "mm",    "cm",   "km",    "m2",    "m3",   "mm2", "cm2", "s", "ms",
        "min", "h",   "kg",  "g",   "t",     "kg/m3", "t/m3", "g/cm3", "kN/m3", "N",    "kN",  "MN",  "J", "kJ",
        "MJ",  "Hz",  "deg", "rad", "rad/s", "deg/s", "m/s",  "mm/s",  "km/h",  "m/s2", "1/s", "Pa s"};
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        if (strcasecmp(unit, known[k]) == 0 && strcmp(unit, known[k]) != 0) {
            return known[k];
        }
    }
    return NULL;
}

static mor_status take_apart(mor_context *context, const mor_units *units, const char *unit, unit_parts *parts)
{
    *parts = (unit_parts){.visitor = {visit_basic, visit_product, visit_galilean, visit_timestamp, visit_logarithmic},
                          .factor = 1.0};
    if (strcmp(unit, "1") == 0) {
        return MOR_OK;
    }
    const char *fault = find_spelling_fault(unit);
    MOR_CHECK(context, fault == NULL, MOR_ERROR_ARGUMENT, "'%.64s' cannot be a unit: %s", unit, fault);
    const quiet previous = enter_quiet(units->locale);
    ut_unit *parsed = ut_parse(units->system, unit, UT_UTF8);
    const ut_status walked = parsed == NULL ? UT_UNKNOWN : ut_accept_visitor(parsed, &parts->visitor, parts);
    ut_free(parsed);
    leave_quiet(previous);
    if (parsed == NULL) {
        const char *meant = find_other_case(unit);
        return meant == NULL
                   ? MOR_FAIL(context, MOR_ERROR_ARGUMENT, "'%s' is not a unit", unit)
                   : MOR_FAIL(context, MOR_ERROR_ARGUMENT, "'%s' is not a unit; did you mean '%s'?", unit, meant);
    }
    MOR_CHECK(context, walked == UT_SUCCESS, MOR_ERROR_ARGUMENT,
              "'%s' is a unit with a shifted zero, a logarithm or a date, which cannot be used", unit);
    MOR_CHECK(context, isfinite(parts->factor) && parts->factor > 0.0, MOR_ERROR_ARGUMENT,
              "'%s' is beyond the range of numbers", unit);
    parts->factor = snap_to_decimal(parts->factor, units->locale);
    return MOR_OK;
}

mor_status mor_units_dimension(mor_context *context, const mor_units *units, const char *unit, mor_dimension *dimension)
{
    unit_parts parts;
    MOR_TRY(context, take_apart(context, units, unit, &parts));
    *dimension = parts.dimension;
    return MOR_OK;
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

const char *mor_units_number(const mor_units *units, const char *text, double *value)
{
    const char *start = text + strspn(text, " \t");
    const char *digits = start + (*start == '+' || *start == '-');
    digits += *digits == '.';
    if (*digits < '0' || *digits > '9' || (digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X'))) {
        return NULL;
    }
    char *end = NULL;
    const locale_t previous = uselocale(units->locale);
    *value = strtod(start, &end);
    uselocale(previous);
    return end + strspn(end, " \t");
}

static double apply_factor(double number, double factor, locale_t locale)
{
    /* Dividing by 1000 rounds once where multiplying by 0.001 rounds twice: "35 mm" is 0.035. */
    const double inverse = snap_to_decimal(1.0 / factor, locale);
    return inverse > 1.0 && inverse == floor(inverse) ? number / inverse : number * factor;
}

mor_status mor_units_convert(mor_context *context, const mor_units *units, const char *text, const char *unit,
                             double *value)
{
    double number = 0.0;
    const char *found_unit = mor_units_number(units, text, &number);
    MOR_CHECK(context, found_unit != NULL, MOR_ERROR_ARGUMENT, "it does not start with a number");
    char trimmed[UNIT_BYTES];
    size_t length = strlen(found_unit);
    while (length > 0 && (found_unit[length - 1] == ' ' || found_unit[length - 1] == '\t')) {
        --length;
    }
    MOR_CHECK(context, length < sizeof trimmed, MOR_ERROR_ARGUMENT, "its unit is too long");
    memcpy(trimmed, found_unit, length);
    trimmed[length] = '\0';
    if (length == 0 || strcmp(trimmed, unit) == 0) {
        *value = number;
        return MOR_OK;
    }
    unit_parts wanted;
    MOR_CHECK(context, take_apart(context, units, unit, &wanted) == MOR_OK, MOR_ERROR_INTERNAL,
              "the wanted unit '%s' is not a unit; mend the schema that names it", unit);
    unit_parts found;
    MOR_TRY(context, take_apart(context, units, trimmed, &found));
    char dimension[MOR_UNITS_TEXT_BYTES];
    mor_dimension_format(&found.dimension, dimension, sizeof dimension);
    MOR_CHECK(context, mor_dimension_equal(&found.dimension, &wanted.dimension), MOR_ERROR_ARGUMENT,
              "'%s' is a unit of another kind (%s)", trimmed,
              strcmp(dimension, "1") == 0 ? "a plain number" : dimension);
    *value = apply_factor(number, found.factor / wanted.factor, units->locale);
    return MOR_OK;
}

void mor_units_format(const mor_units *units, double value, char *text, size_t text_bytes)
{
    const locale_t previous = uselocale(units->locale);
    for (int digits = 15; digits <= 17; ++digits) {
        snprintf(text, text_bytes, "%.*g", digits, value);
        if (strtod(text, NULL) == value) {
            break;
        }
    }
    uselocale(previous);
    if (text[strcspn(text, ".e")] == '\0') {
        strncat(text, ".0", text_bytes - strlen(text) - 1);
    }
}
