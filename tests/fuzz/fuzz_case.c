/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/case/write/case_write.h"
#include "cases/driver/probe/probe.h"
#include "materials/builtin.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Any bytes as a case file: read without a crash, a leak or a hang, refused with a message or accepted; an accepted
 * case, written and read again, is accepted again. The first line may be a setting of the command line:
 * "#--set key=value". */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes);

enum { SETTING_BYTES = 512 };

/* libconfig loses the text that it was collecting when its parser gives up, UDUNITS the word of its scanner. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libconfig\nleak:libudunits2\n";
}

static void require(int condition, const char *what, const char *message)
{
    if (!condition) {
        fprintf(stderr, "%s: %s\n", what, message);
        abort();
    }
}

static int take_setting(const uint8_t *data, size_t n_bytes, char *setting)
{
    static const char mark[] = "#--set ";
    const size_t n_mark = sizeof mark - 1;
    if (n_bytes < n_mark || memcmp(data, mark, n_mark) != 0) {
        return 0;
    }
    size_t length = 0;
    while (n_mark + length < n_bytes && length < SETTING_BYTES - 1 && data[n_mark + length] != '\n') {
        setting[length] = (char)data[n_mark + length];
        ++length;
    }
    setting[length] = '\0';
    return 1;
}

static void check_again(mor_context *context, mor_case *the_case, mor_case_text text)
{
    char *written = NULL;
    size_t n_written = 0;
    FILE *stream = open_memstream(&written, &n_written);
    require(stream != NULL, "open_memstream", "no memory");
    require(mor_case_write_stream(context, the_case, text.registry, stream) == MOR_OK, "write", context->message);
    fclose(stream);
    mor_case_clear(context, the_case);
    text.text = written;
    text.n_bytes = (int64_t)n_written;
    text.n_settings = 0;
    require(mor_case_read_text(context, &text, the_case) == MOR_OK, "read again", context->message);
    mor_case_clear(context, the_case);
    free(written);
}

/* Loaded once: the tables take longer to read than a case. */
static const mor_units *get_units(void)
{
    static mor_context context;
    static mor_units *units;
    if (units == NULL) {
        mor_context_init(&context);
        require(mor_units_new(&context, &units) == MOR_OK, "units", context.message);
    }
    return units;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes)
{
    static mor_case the_case;
    char setting[SETTING_BYTES];
    const char *settings[] = {setting};
    mor_context context;
    mor_registry *registry = NULL;
    mor_context_init(&context);
    require(mor_registry_new(&context, &registry) == MOR_OK, "registry", context.message);
    require(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)) == MOR_OK, "registry",
            context.message);
    const mor_case_text text = {.name = "fuzz.cfg",
                                .text = (const char *)data,
                                .n_bytes = (int64_t)n_bytes,
                                .settings = settings,
                                .n_settings = take_setting(data, n_bytes, setting),
                                .registry = registry,
                                .probe_types = mor_probe_type_at,
                                .units = get_units()};
    const mor_status status = mor_case_read_text(&context, &text, &the_case);
    if (status == MOR_OK) {
        check_again(&context, &the_case, text);
    } else {
        require(status == MOR_ERROR_CONFIG, "status", context.message);
        require(strstr(context.message, ": found ") != NULL, "message", context.message);
    }
    mor_registry_free(&context, &registry);
    require(context.memory_bytes == 0, "memory", "something was not freed");
    return 0;
}
