/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_schema.h"

#include "cases/driver/case/schema/case_schema_words.h"
#include "cases/driver/sweep/sweep.h"

#include <math.h>

/* Entries follow mor_schema: key, kind, components, unit, required, default, range, choices, text. */

static const mor_case_key root_keys[] = {
    {{"title", WORDS, "1", DEFAULT(0.0), ANY, NULL, "one line that names the sweep in tables and pictures"},
     MOR_CASE_STORE_TEXT,
     AT(mor_sweep, title)},
    {{"case", WORDS, "1", REQUIRED, ANY, NULL, "the case; path from the folder of the sweep file"},
     MOR_CASE_STORE_TEXT,
     AT(mor_sweep, case_file)},
    {{"members", WHOLE, "1", DEFAULT(NAN), BETWEEN(1.0, MOR_SWEEP_MEMBERS_MAX), NULL,
      "samples of all distributions in each combination of the other variables, for each value of replicates, too: "
      "these are samples of their own; required with a distribution, not allowed otherwise"},
     MOR_CASE_STORE_INT,
     AT(mor_sweep, n_samples),
     .computed = "none"},
    {{"seed", WHOLE, "1", DEFAULT(1.0), NOT_NEGATIVE, NULL, "seed of the Latin hypercube"},
     MOR_CASE_STORE_SEED,
     AT(mor_sweep, seed)},
    {{"refused_cases", CHOICE, "1", DEFAULT(0.0), ANY, "stop|skip",
      "members whose case is refused before anything runs; stop: nothing runs; skip: the others run, and these count "
      "as failed"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_sweep, refused)},
    END};

static const mor_case_part root_parts[] = {
    {"set", false, "list of texts", "settings of all members, each \"key=value\", such as \"spacing=0.7 m\""},
    {"vary", true, "list of groups", "what varies; members are all combinations, the first variable slowest"},
    {"results", false, "list of groups", "results to tabulate and draw; without it the last value of each probe"},
    {"exceed", false, "list of groups", "thresholds: how often is a result above, or below?"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_sweep_root_group = {"", "Top level", root_keys, root_parts, offsetof(mor_sweep, written)};

static const mor_case_key variable_keys[] = {
    {{"key", WORDS, "1", DEFAULT(0.0), ANY, NULL,
      "key of the case that takes the values, such as \"rocks[0].content\"; required unless choices say what is set"},
     MOR_CASE_STORE_TEXT,
     AT(mor_sweep_variable, key)},
    {{"name", WORDS, "1", DEFAULT(0.0), ANY, NULL, "name in tables and pictures; required with choices"},
     MOR_CASE_STORE_NAME,
     AT(mor_sweep_variable, name),
     .computed = "the last name of the key"},
    {{"replicates", SWITCH, "1", DEFAULT(0.0), ANY, NULL,
      "values are repetitions, such as seeds, that statistics are taken over; samples of a distribution always are, "
      "and "
      "each repetition gets others"},
     MOR_CASE_STORE_BOOL,
     AT(mor_sweep_variable, is_replicate)},
    {{"distribution", CHOICE, "1", DEFAULT(0.0), ANY, "none|normal|lognormal|uniform|triangular",
      "random values: normal and lognormal by mean and deviation, uniform by min and max, triangular by min, mode and "
      "max"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_sweep_variable, distribution.law)},
    END};

static const mor_case_part variable_parts[] = {
    {"values", false, "list",
     "numbers, texts with units, words, true or false, lists; give values, from and to, choices or distribution"},
    {"from", false, "number with its unit", "first value of a range"},
    {"to", false, "number with its unit", "last value of a range, not exceeded"},
    {"step", false, "number with its unit", "difference of two values of a range; without it 1, in the unit of from"},
    {"choices", false, "list of groups", "values that set several keys, or have a name"},
    {"mean", false, "number with its unit", "of the variable, were it not cut off at min and max"},
    {"deviation", false, "number with its unit",
     "standard deviation of the variable itself (of lognormal, too, not of its logarithm), were it not cut off; > 0"},
    {"mode", false, "number with its unit", "of triangular: where the density is largest"},
    {"min", false, "number with its unit", "smallest value; of normal and lognormal optional: the rest is cut off"},
    {"max", false, "number with its unit", "largest value; likewise"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_sweep_variable_group = {"vary", "What varies (list)", variable_keys, variable_parts,
                                                 offsetof(mor_sweep_variable, written)};

static const mor_case_key choice_keys[] = {
    {{"label", WORDS, "1", REQUIRED, ANY, NULL, "name of this choice in tables and pictures"},
     MOR_CASE_STORE_TEXT,
     AT(mor_sweep_choice, label)},
    {{"case", WORDS, "1", DEFAULT(0.0), ANY, NULL, "case file in place of that of the sweep, likewise"},
     MOR_CASE_STORE_TEXT,
     AT(mor_sweep_choice, case_file)},
    END};

static const mor_case_part choice_parts[] = {
    {"set", false, "list of texts", "settings of this choice, each \"key=value\""},
    {"value", false, "number with its unit", "where the choice lies on the axis of a picture"},
    {"without", false, "list of names",
     "variables, listed later in vary, that have no meaning with this choice: it is not combined with them"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_sweep_choice_group = {"choices", "Values that set several keys (list)", choice_keys,
                                               choice_parts, offsetof(mor_sweep_choice, written)};

/* Keys of a measure in a record that has it as the member named; the texts are the same in both lists. */
#define PROBE(record, member)                                                                                          \
    {                                                                                                                  \
        {"probe", WORDS, "1", REQUIRED, ANY, NULL, "name of a probe of the case"}, MOR_CASE_STORE_NAME,                \
            AT(record, member)                                                                                         \
    }
#define STATISTIC(record, member)                                                                                      \
    {                                                                                                                  \
        {"statistic",                                                                                                  \
         CHOICE,                                                                                                       \
         "1",                                                                                                          \
         DEFAULT(0.0),                                                                                                 \
         ANY,                                                                                                          \
         mor_case_statistic_words,                                                                                     \
         "of the probe during the run; value: its last value"},                                                        \
            MOR_CASE_STORE_CHOICE, AT(record, member)                                                                  \
    }

static const mor_case_key result_keys[] = {PROBE(mor_sweep_measure, probe), STATISTIC(mor_sweep_measure, statistic),
                                           END};

const mor_case_group mor_sweep_result_group = {"results", "Results (list)", result_keys, NULL,
                                               offsetof(mor_sweep_measure, written)};

static const mor_case_key exceed_keys[] = {
    PROBE(mor_sweep_exceed, measure.probe),
    STATISTIC(mor_sweep_exceed, measure.statistic),
    {{"absent", CHOICE, "1", DEFAULT(0.0), ANY, "miss|hit|left_out",
      "members where there was nothing to measure, as where nothing arrived; miss: counted, not beyond the threshold; "
      "hit: counted, beyond it; left_out: not counted, so that the probability is that of the others"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_sweep_exceed, absent),
     .computed = "miss with above; with below no probability where there are such members"},
    END};

static const mor_case_part exceed_parts[] = {
    {"above", false, "number with its unit", "counts results above it; give above or below"},
    {"below", false, "number with its unit", "counts results below it"},
    {NULL, false, NULL, NULL}};

const mor_case_group mor_sweep_exceed_group = {"exceed", "Thresholds (list)", exceed_keys, exceed_parts,
                                               offsetof(mor_sweep_exceed, measure.written)};

void mor_sweep_schema_print(FILE *stream)
{
    const mor_case_group *const groups[] = {&mor_sweep_root_group, &mor_sweep_variable_group, &mor_sweep_choice_group,
                                            &mor_sweep_result_group, &mor_sweep_exceed_group};
    static const int levels[] = {2, 2, 3, 2, 2};
    fprintf(stream,
            "# Sweep files\n\nA sweep file is in the language of [case files](case_file.md): a bare number is in SI, a "
            "value with another unit is a\ntext. How to use it is in [sweep.md](../guide/sweep.md). A name that is not "
            "listed here is refused.\n");
    for (size_t k = 0; k < sizeof groups / sizeof *groups; ++k) {
        mor_case_schema_print_group(groups[k], levels[k], NULL, stream);
    }
}
