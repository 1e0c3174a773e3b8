/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/formula/formula.h"

#include "core/base/math.h"
#include "core/base/memory.h"

#include <muParserDLL.h>
#include <string.h>

struct mor_formula {
    char text[MOR_FORMULA_BYTES_MAX];
    muParserHandle_t parser;
    double place[3]; /* the variables */
};

/* The library's own texts lie in one buffer for all parsers; numbers of errors do not. */
static const char *describe_error(int code)
{
    static const struct {
        int code;
        const char *text;
    } errors[] = {{0, "an operator is out of place"},
                  {1, "something is unknown"},
                  {2, "the formula ends too early"},
                  {3, "a comma is out of place"},
                  {4, "an argument is out of place"},
                  {5, "a number is out of place"},
                  {6, "a variable is out of place"},
                  {7, "a parenthesis is out of place"},
                  {11, "a parenthesis is missing"},
                  {12, "a function is out of place"},
                  {14, "a function has too many arguments"},
                  {15, "a function has too few arguments"},
                  {25, "there is nothing"},
                  {32, "a '?' or ':' is out of place"},
                  {33, "a ':' is missing"},
                  {34, "a ':' is out of place"}};
    for (size_t k = 0; k < sizeof errors / sizeof *errors; ++k) {
        if (errors[k].code == code) {
            return errors[k].text;
        }
    }
    return "something is wrong";
}

static mor_status refuse(mor_context *context, const char *text, int at, const char *why)
{
    const int n = (int)strlen(text);
    const int place = at < 0 || at > n ? n : at;
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "found the formula '%s', in which %s at letter %d, before '%.20s'; allowed: " MOR_FORMULA_ALLOWED
                    "; correct it",
                    text, why, place + 1, text + place);
}

/* A single '=' would change a variable. Bytes that are no letters have no place in a formula. */
static mor_status check_letters(mor_context *context, const char *text)
{
    for (int k = 0; text[k] != '\0'; ++k) {
        const bool follows = k > 0 && strchr("=<>!", text[k - 1]) != NULL;
        if (text[k] == '=' && text[k + 1] != '=' && !follows) {
            return refuse(context, text, k, "a variable is assigned");
        }
        if (text[k] < ' ' || text[k] > '~' || text[k] == '"') {
            return refuse(context, text, k, "a byte is out of place");
        }
    }
    return MOR_OK;
}

/* The library parses when it evaluates first. */
static mor_status check_error(mor_context *context, mor_formula *formula)
{
    if (!mupError(formula->parser)) {
        return MOR_OK;
    }
    const int at = mupGetErrorPos(formula->parser);
    const int code = mupGetErrorCode(formula->parser);
    mupErrorReset(formula->parser);
    return refuse(context, formula->text, at, describe_error(code));
}

static mor_status parse(mor_context *context, mor_formula *formula)
{
    static const char *const names[] = {"x", "y", "z"};
    formula->parser = mupCreate(muBASETYPE_FLOAT);
    MOR_CHECK(context, formula->parser != NULL, MOR_ERROR_MEMORY, "there is no memory for the formula '%s'",
              formula->text);
    for (int a = 0; a < 3; ++a) {
        mupDefineVar(formula->parser, names[a], &formula->place[a]);
    }
    mupDefineConst(formula->parser, "pi", MOR_PI);
    mupSetExpr(formula->parser, formula->text);
    MOR_TRY(context, check_error(context, formula));
    int n_values = 0;
    mupEvalMulti(formula->parser, &n_values);
    MOR_TRY(context, check_error(context, formula));
    return n_values == 1 ? MOR_OK : refuse(context, formula->text, 0, "there are several values");
}

mor_status mor_formula_new(mor_context *context, const char *text, mor_formula **formula)
{
    *formula = NULL;
    MOR_CHECK(context, strlen(text) < MOR_FORMULA_BYTES_MAX, MOR_ERROR_CONFIG,
              "found a formula of %zu letters; allowed: fewer than %d; shorten it", strlen(text),
              MOR_FORMULA_BYTES_MAX);
    MOR_TRY(context, check_letters(context, text));
    MOR_TRY(context, MOR_NEW(context, formula, 1, "formula"));
    memcpy((*formula)->text, text, strlen(text) + 1);
    const mor_status status = parse(context, *formula);
    if (status != MOR_OK) {
        mor_formula_free(context, formula);
    }
    return status;
}

void mor_formula_free(mor_context *context, mor_formula **formula)
{
    if (*formula != NULL && (*formula)->parser != NULL) {
        mupRelease((*formula)->parser);
    }
    MOR_FREE(context, formula);
}

mor_status mor_formula_evaluate(mor_context *context, mor_formula *formula, const double *place, double *value)
{
    memcpy(formula->place, place, sizeof formula->place);
    *value = mupEval(formula->parser);
    MOR_TRY(context, check_error(context, formula));
    MOR_CHECK(context, isfinite(*value), MOR_ERROR_CONFIG,
              "found the formula '%s', which is %g at x = %.6g, y = %.6g, z = %.6g; allowed: finite values everywhere; "
              "correct it",
              formula->text, *value, place[0], place[1], place[2]);
    return MOR_OK;
}
