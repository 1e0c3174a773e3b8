/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What a variable takes. */
#include "cases/driver/sweep/sweep_quantity.h"
#include "cases/driver/sweep/sweep_read.h"
#include "cases/driver/sweep/sweep_schema.h"
#include "core/base/memory.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/* ---- Texts ------------------------------------------------------------------------------------------------------- */

const char *mor_sweep_texts_get(const mor_sweep_texts *texts, int index)
{
    const char *text = texts->bytes;
    for (int k = 0; k < index; ++k) {
        text += strlen(text) + 1;
    }
    return text;
}

/* A setting has a key and a value; what they are, the case says. */
static mor_status check_setting(const mor_case_reader *reader, const mor_case_node *node)
{
    char found[MOR_CASE_NODE_TEXT_BYTES];
    const char *equals = node->kind == MOR_CASE_NODE_TEXT ? strchr(node->text, '=') : NULL;
    if (equals != NULL && equals > node->text && equals[1] != '\0' && strlen(node->text) < MOR_SWEEP_SETTING_BYTES) {
        return MOR_OK;
    }
    mor_case_node_format(node, found, sizeof found);
    return MOR_CASE_NODE_FAIL(reader->context, node,
                              "found the setting %s; allowed: texts \"key=value\" of fewer than %d bytes, such as "
                              "\"spacing=0.7 m\"; correct it",
                              found, MOR_SWEEP_SETTING_BYTES);
}

mor_status mor_sweep_read_settings(const mor_case_reader *reader, const mor_case_node *group, const char *name,
                                   mor_sweep_texts *texts)
{
    const mor_case_node *list = mor_case_node_find(group, name);
    int64_t n_bytes = 0;
    if (list == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, mor_case_reader_member(reader, group, name, MOR_CASE_NODE_LIST, &list));
    if (list->n_children < 1 || list->n_children > MOR_SWEEP_SETTINGS_MAX) {
        return MOR_CASE_NODE_FAIL(reader->context, list,
                                  "found %d settings in '%s'; allowed: 1 to %d; correct the list", list->n_children,
                                  name, MOR_SWEEP_SETTINGS_MAX);
    }
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next) {
        MOR_TRY(reader->context, check_setting(reader, child));
        n_bytes += (int64_t)strlen(child->text) + 1;
    }
    MOR_TRY(reader->context, MOR_NEW(reader->context, &texts->bytes, n_bytes, "settings of a sweep"));
    char *end = texts->bytes;
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next) {
        end = stpcpy(end, child->text) + 1;
        ++texts->n;
    }
    return MOR_OK;
}

/* Gives a choice the setting "key=text". */
static mor_status set_choice(const mor_case_reader *reader, const char *key, const char *text, mor_sweep_choice *choice)
{
    const size_t n_bytes = strlen(key) + strlen(text) + 2;
    MOR_TRY(reader->context, MOR_NEW(reader->context, &choice->settings.bytes, (int64_t)n_bytes, "a setting"));
    snprintf(choice->settings.bytes, n_bytes, "%s=%s", key, text);
    choice->settings.n = 1;
    snprintf(choice->label, sizeof choice->label, "%.*s", (int)sizeof choice->label - 1, text);
    return MOR_OK;
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

/* A value as a case would write it; texts in lists keep their quotes. Returns false when it has no room. */
static bool write_value(const mor_case_reader *reader, const mor_case_node *node, bool is_inside, char *text,
                        size_t text_bytes)
{
    size_t used = 0;
    int n = 0;
    switch (node->kind) {
    case MOR_CASE_NODE_INTEGER:
        n = snprintf(text, text_bytes, "%" PRId64 "%s", node->integer,
                     mor_sweep_quantity_suffix((double)node->integer));
        break;
    case MOR_CASE_NODE_REAL:
        n = text_bytes < 32 || !isfinite(node->real) ? -1 : 0;
        if (n == 0) {
            mor_units_format(reader->units, node->real, text, text_bytes);
        }
        break;
    case MOR_CASE_NODE_BOOLEAN:
        n = snprintf(text, text_bytes, "%s", node->truth ? "true" : "false");
        break;
    case MOR_CASE_NODE_TEXT:
        n = snprintf(text, text_bytes, is_inside ? "\"%s\"" : "%s", node->text);
        break;
    case MOR_CASE_NODE_LIST:
        for (const mor_case_node *child = node->first_child; child != NULL && used + 4 < text_bytes;
             child = child->next) {
            used += (size_t)snprintf(text + used, text_bytes - used, used == 0 ? "(" : ", ");
            if (!write_value(reader, child, true, text + used, text_bytes - used)) {
                return false;
            }
            used += strlen(text + used);
        }
        n = used > 0 && used + 2 < text_bytes ? snprintf(text + used, text_bytes - used, ")") : -1;
        break;
    case MOR_CASE_NODE_GROUP:
        return false;
    }
    return n >= 0 && (size_t)n < text_bytes;
}

/* Beside percents a bare number is a share. */
static bool has_dimension(const mor_case_reader *reader, const char *unit)
{
    char one[MOR_SWEEP_SETTING_BYTES];
    double factor = 0.0;
    snprintf(one, sizeof one, "1 %.64s", unit);
    return mor_units_convert(reader->context, reader->units, one, "1", &factor) != MOR_OK;
}

/* The unit of the first number that has one, into which the others are converted; none of them is a number where one is
 * not. */
static mor_status find_unit(const mor_case_reader *reader, const mor_case_node *list, mor_sweep_variable *variable)
{
    mor_sweep_quantity found;
    int k = 0;
    variable->is_number = true;
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next) {
        variable->is_number = variable->is_number && mor_sweep_quantity_is(reader, child, &found);
        if (variable->is_number && variable->unit[0] == '\0') {
            memcpy(variable->unit, found.unit, sizeof variable->unit);
        }
    }
    if (!variable->is_number) {
        variable->unit[0] = '\0';
    }
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next, ++k) {
        mor_sweep_choice *choice = &variable->choices[k];
        choice->value = NAN;
        if (variable->is_number && mor_sweep_quantity_is(reader, child, &found) &&
            mor_sweep_quantity_convert(reader->context, reader->units, &found, variable->unit, &choice->value) !=
                MOR_OK) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found a value of '%s' in '%s' beside one in '%s'; allowed: units of one kind; "
                                      "correct it",
                                      variable->key, found.unit, variable->unit);
        }
        if (isfinite(choice->value) && found.unit[0] == '\0' && variable->unit[0] != '\0') {
            if (choice->value != 0.0 && has_dimension(reader, variable->unit)) { /* more likely forgotten than SI */
                return MOR_CASE_NODE_FAIL(
                    reader->context, child,
                    "found a bare number in the values of '%s' beside one in '%s'; allowed: units "
                    "of one kind, or none at all; give all the same unit",
                    variable->key, variable->unit);
            }
            snprintf(choice->label, sizeof choice->label, "%.6g %s", choice->value, variable->unit);
        }
    }
    return MOR_OK;
}

static mor_status make_choices(const mor_case_reader *reader, const mor_case_node *node, int n,
                               mor_sweep_variable *variable)
{
    if (n < 1 || n > MOR_SWEEP_CHOICES_MAX) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found %d values of a variable; allowed: 1 to %d; correct them", n,
                                  MOR_SWEEP_CHOICES_MAX);
    }
    MOR_TRY(reader->context, MOR_NEW(reader->context, &variable->choices, n, "values of a sweep"));
    variable->n_choices = n;
    return MOR_OK;
}

static mor_status read_list(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_variable *variable)
{
    char text[MOR_SWEEP_SETTING_BYTES];
    const mor_case_node *list = NULL;
    int k = 0;
    MOR_TRY(reader->context, mor_case_reader_member(reader, node, "values", MOR_CASE_NODE_LIST, &list));
    MOR_TRY(reader->context, make_choices(reader, list, list->n_children, variable));
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next, ++k) {
        if (!write_value(reader, child, false, text, sizeof text) || text[0] == '\0') {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found a group, an empty value or one of more than %d bytes among the values of "
                                      "'%s'; allowed: numbers, texts, true, false and lists; use choices with set",
                                      MOR_SWEEP_SETTING_BYTES, variable->key);
        }
        MOR_TRY(reader->context, set_choice(reader, variable->key, text, &variable->choices[k]));
    }
    return find_unit(reader, list, variable);
}

/* ---- Ranges ------------------------------------------------------------------------------------------------------ */

static mor_status read_range(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_variable *variable)
{
    static const char *const names[] = {"from", "to", "step"};
    const double rounding = 1.0e-9; /* of a step: ends that are decimal fractions are reached */
    double it[3];
    char text[MOR_SWEEP_UNIT_BYTES + 64];
    MOR_TRY(reader->context, mor_sweep_quantity_members(reader, node, names, 3, variable->unit, it));
    it[2] = isnan(it[2]) ? 1.0 : it[2];
    if (!(it[2] > 0.0 && it[1] >= it[0])) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found the range from %g to %g by %g of '%s'; allowed: from <= to and step > 0, both "
                                  "ends given; correct it",
                                  it[0], it[1], it[2], variable->key);
    }
    const double n = floor((it[1] - it[0]) / it[2] + rounding) + 1.0;
    if (fabs((it[1] - it[0]) / it[2] - (n - 1.0)) > rounding * fmax(n, 1.0)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found the range from %g to %g by %g of '%s', whose steps end at %.9g and miss 'to'; "
                                  "allowed: a whole number of steps between both ends; correct to or step",
                                  it[0], it[1], it[2], variable->key, it[0] + (n - 1.0) * it[2]);
    }
    MOR_TRY(reader->context, make_choices(reader, node, n < 1e6 ? (int)n : 1000000, variable));
    for (int k = 0; k < variable->n_choices; ++k) {
        mor_sweep_choice *choice = &variable->choices[k];
        choice->value = it[0] + k * it[2];
        if (choice->value != nearbyint(choice->value)) { /* twelve digits: 0.1 + 2 * 0.1 is written as 0.3 */
            snprintf(text, sizeof text, "%.12g", choice->value);
            (void)mor_units_number(reader->units, text, &choice->value);
        }
        mor_sweep_quantity_format(reader->units, choice->value, variable->unit, text, sizeof text);
        MOR_TRY(reader->context, set_choice(reader, variable->key, text, choice));
    }
    variable->is_number = true;
    return MOR_OK;
}

/* ---- Choices ----------------------------------------------------------------------------------------------------- */

static mor_status read_choice(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_choice *choice)
{
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_sweep_choice_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_sweep_choice_group, choice));
    return mor_sweep_read_settings(reader, node, "set", &choice->settings);
}

/* A list of all the members `value`, in place of the list of values. */
static mor_status find_values(const mor_case_reader *reader, const mor_case_node *list, mor_sweep_variable *variable)
{
    int k = 0;
    bool is_first = true;
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next, ++k) {
        const mor_case_node *node = mor_case_node_find(child, "value");
        mor_sweep_quantity found;
        variable->choices[k].value = NAN;
        if (node == NULL) {
            continue;
        }
        MOR_TRY(reader->context, mor_sweep_quantity_read(reader, node, &found));
        if (is_first) {
            memcpy(variable->unit, found.unit, sizeof variable->unit);
        }
        is_first = false;
        variable->is_number = true;
        if (mor_sweep_quantity_convert(reader->context, reader->units, &found, variable->unit,
                                       &variable->choices[k].value) != MOR_OK) {
            return MOR_CASE_NODE_FAIL(
                reader->context, node,
                "found a value in '%s' beside one in '%s'; allowed: units of one kind; correct it", found.unit,
                variable->unit);
        }
    }
    return MOR_OK;
}

static mor_status read_choices(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_variable *variable)
{
    const mor_case_node *list = NULL;
    int k = 0;
    MOR_TRY(reader->context, mor_case_reader_list(reader, node, "choices", MOR_SWEEP_CHOICES_MAX, &list));
    MOR_TRY(reader->context, make_choices(reader, node, list->n_children, variable));
    for (const mor_case_node *child = list->first_child; child != NULL; child = child->next, ++k) {
        MOR_TRY(reader->context, read_choice(reader, child, &variable->choices[k]));
        for (int other = 0; other < k; ++other) {
            if (strcmp(variable->choices[other].label, variable->choices[k].label) == 0) {
                return MOR_CASE_NODE_FAIL(reader->context, child,
                                          "found the label '%s' twice; allowed: a label of its own for each choice; "
                                          "rename one",
                                          variable->choices[k].label);
            }
        }
    }
    return find_values(reader, list, variable);
}

/* ---- Distributions ----------------------------------------------------------------------------------------------- */

enum { MEAN, DEVIATION, MODE, LEAST, LARGEST, NUMBERS };

/* What each distribution is told. */
static mor_status check_numbers(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_law law,
                                const char *const *names, const double *it)
{
    static const struct {
        const char *word;
        bool needs[NUMBERS], takes[NUMBERS];
    } laws[] = {[MOR_SWEEP_LAW_NORMAL] = {"normal", {1, 1, 0, 0, 0}, {1, 1, 0, 1, 1}},
                [MOR_SWEEP_LAW_LOGNORMAL] = {"lognormal", {1, 1, 0, 0, 0}, {1, 1, 0, 1, 1}},
                [MOR_SWEEP_LAW_UNIFORM] = {"uniform", {0, 0, 0, 1, 1}, {0, 0, 0, 1, 1}},
                [MOR_SWEEP_LAW_TRIANGULAR] = {"triangular", {0, 0, 1, 1, 1}, {0, 0, 1, 1, 1}}};
    for (int k = 0; k < NUMBERS; ++k) {
        if (isnan(it[k]) ? laws[law].needs[k] : !laws[law].takes[k]) {
            return MOR_CASE_NODE_FAIL(reader->context, node, "found %s '%s' with distribution = \"%s\"; %s it",
                                      isnan(it[k]) ? "no" : "also", names[k], laws[law].word,
                                      isnan(it[k]) ? "add" : "it has no effect; remove");
        }
    }
    return MOR_OK;
}

/* The numbers that were given. */
static void describe_distribution(const mor_sweep_distribution *it, char *text, size_t n_bytes)
{
    const struct {
        const char *name;
        double value;
    } all[] = {{"mean", it->mean},
               {"deviation", it->deviation},
               {"mode", it->mode},
               {"min", it->minimum},
               {"max", it->maximum}};
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < sizeof all / sizeof *all && used < n_bytes; ++k) {
        if (isfinite(all[k].value)) {
            used += (size_t)snprintf(text + used, n_bytes - used, "%s%s %g", used > 0 ? ", " : "", all[k].name,
                                     all[k].value);
        }
    }
}

static mor_status check_distribution(const mor_case_reader *reader, const mor_case_node *node,
                                     const mor_sweep_variable *variable)
{
    const mor_sweep_distribution *it = &variable->distribution;
    const double least_share = 1.0e-6; /* beyond it the tails of double precision are cut, not the distribution */
    const double rare = 1.0e-9;
    const char *why = NULL;
    if (!(it->minimum < it->maximum)) {
        why = "min is not below its max; exchange or correct them";
    } else if (it->law == MOR_SWEEP_LAW_TRIANGULAR && !(it->mode >= it->minimum && it->mode <= it->maximum)) {
        why = "mode lies outside of min and max; correct it";
    } else if (it->law == MOR_SWEEP_LAW_NORMAL || it->law == MOR_SWEEP_LAW_LOGNORMAL) {
        if (!(it->deviation > 0.0)) {
            why = "deviation is not above zero; correct it, or give one value";
        } else if (it->law == MOR_SWEEP_LAW_LOGNORMAL && !(it->mean > 0.0)) {
            why = "mean is not above zero, as it is of a lognormal variable; correct it";
        } else if (!(mor_sweep_distribution_below(it, it->maximum) - mor_sweep_distribution_below(it, it->minimum) >=
                     least_share)) {
            why = "range from min to max holds less than a millionth of it; correct them";
        }
    }
    if (why == NULL && !(isfinite(mor_sweep_distribution_quantile(it, rare)) &&
                         isfinite(mor_sweep_distribution_quantile(it, 1.0 - rare)))) {
        why = "values are beyond the range of numbers; correct mean and deviation";
    }
    if (why != NULL) {
        char told[MOR_CASE_NODE_TEXT_BYTES];
        describe_distribution(it, told, sizeof told);
        return MOR_CASE_NODE_FAIL(reader->context, node, "found a distribution of '%s' with %s%s%s, whose %s",
                                  variable->name, told, variable->unit[0] != '\0' ? " in " : "", variable->unit, why);
    }
    return MOR_OK;
}

static mor_status read_distribution(const mor_case_reader *reader, const mor_case_node *node,
                                    mor_sweep_variable *variable)
{
    static const char *const names[NUMBERS] = {"mean", "deviation", "mode", "min", "max"};
    mor_sweep_distribution *it = &variable->distribution;
    double numbers[NUMBERS];
    MOR_TRY(reader->context, mor_sweep_quantity_members(reader, node, names, NUMBERS, variable->unit, numbers));
    MOR_TRY(reader->context, check_numbers(reader, node, it->law, names, numbers));
    it->mean = numbers[MEAN];
    it->deviation = numbers[DEVIATION];
    it->mode = numbers[MODE];
    it->minimum = isnan(numbers[LEAST]) ? -INFINITY : numbers[LEAST];
    it->maximum = isnan(numbers[LARGEST]) ? INFINITY : numbers[LARGEST];
    variable->is_number = true;
    variable->is_replicate = true;
    return check_distribution(reader, node, variable);
}

/* ---- One of them ------------------------------------------------------------------------------------------------- */

/* Members that belong to another way of varying. */
static mor_status check_ways(const mor_case_reader *reader, const mor_case_node *node, int way)
{
    static const struct {
        const char *name;
        unsigned ways; /* bit k: way k takes it */
    } members[] = {{"values", 1}, {"from", 2},      {"to", 2},   {"step", 2}, {"choices", 4},
                   {"mean", 8},   {"deviation", 8}, {"mode", 8}, {"min", 8},  {"max", 8}};
    static const char *const words[] = {"values", "a range", "choices", "a distribution"};
    for (size_t k = 0; k < sizeof members / sizeof *members; ++k) {
        const mor_case_node *child = mor_case_node_find(node, members[k].name);
        if (child != NULL && (members[k].ways >> way & 1u) == 0) {
            return MOR_CASE_NODE_FAIL(reader->context, child,
                                      "found '%s' beside %s; allowed: values, from and to, choices or distribution; "
                                      "remove what is too much",
                                      members[k].name, words[way]);
        }
    }
    return MOR_OK;
}

mor_status mor_sweep_read_values(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_variable *variable)
{
    static mor_status (*const readers[])(const mor_case_reader *, const mor_case_node *, mor_sweep_variable *) = {
        read_list, read_range, read_choices, read_distribution};
    const bool is_given[] = {mor_case_node_find(node, "values") != NULL, mor_case_node_find(node, "from") != NULL,
                             mor_case_node_find(node, "choices") != NULL,
                             variable->distribution.law != MOR_SWEEP_LAW_NONE};
    int way = 0;
    while (way < 4 && !is_given[way]) {
        ++way;
    }
    if (way == 4) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a variable that takes no values; allowed: values, from and to, choices or "
                                  "distribution; add one of them");
    }
    MOR_TRY(reader->context, check_ways(reader, node, way));
    const bool has_key = variable->key[0] != '\0';
    if (has_key == (way == 2)) {
        return MOR_CASE_NODE_FAIL(reader->context, node, "found %s; %s",
                                  has_key ? "a key beside choices" : "no 'key' of the case that takes the values",
                                  has_key ? "remove the key: choices say with set what they set"
                                          : "add it, such as key = \"rocks[0].content\"");
    }
    return readers[way](reader, node, variable);
}
