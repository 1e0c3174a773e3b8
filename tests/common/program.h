/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_PROGRAM_H
#define MOR_TESTS_COMMON_PROGRAM_H

#include "tests/common/run_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>

/** @file
 *  The built program as a child process, as a user's shell starts it. */

#ifndef MOR_BUILD_DIR
#define MOR_BUILD_DIR "build/release"
#endif

#define PROGRAM_PATH MOR_BUILD_DIR "/moraine"

enum { PROGRAM_ARGUMENTS_MAX = 32 };

/** How it ended and what it said. Owner: the test, which ends it with program_clear. */
typedef struct program_outcome {
    int exit_code; /* -1 when a signal ended it */
    int signal;    /* 0 when it ended by itself */
    char *output;  /* zero-terminated; what it wrote to standard output */
    char *errors;  /* zero-terminated; what it wrote to standard error */
} program_outcome;

/** In the child: lets a stream write into a file of the scratch folder. */
static inline void program_redirect(const char *path, int stream)
{
    const int file = open(path, O_CREAT | O_TRUNC | O_WRONLY, 0600);
    if (file < 0 || dup2(file, stream) < 0) {
        _exit(127);
    }
    close(file);
}

/** In the child: Fontconfig, behind the pictures, keeps what it knows of fonts; leak sanitizers are to ignore that. */
static inline void program_ignore_fonts(const char *path)
{
    char options[MOR_PATH_BYTES + 64];
    run_folder_store(path, "leak:libfontconfig\n", 19);
    snprintf(options, sizeof options, "print_suppressions=0:suppressions=%s", path);
    setenv("LSAN_OPTIONS", options, 1);
}

/** Starts the program with arguments, zero-terminated texts up to a NULL, in the scratch folder; returns its number. */
static inline pid_t program_start(run_folder *folder, const char *const *arguments)
{
    char output[MOR_PATH_BYTES];
    char errors[MOR_PATH_BYTES];
    char leaks[MOR_PATH_BYTES];
    char *words[PROGRAM_ARGUMENTS_MAX + 2] = {strdup(PROGRAM_PATH)};
    int n = 1;
    run_folder_file(folder, output, "output.txt");
    run_folder_file(folder, errors, "errors.txt");
    run_folder_file(folder, leaks, "leaks.txt");
    for (; arguments[n - 1] != NULL; ++n) {
        assert_true(n <= PROGRAM_ARGUMENTS_MAX);
        words[n] = strdup(arguments[n - 1]);
    }
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        program_ignore_fonts(leaks);
        program_redirect(output, STDOUT_FILENO);
        program_redirect(errors, STDERR_FILENO);
        if (chdir(folder->path) == 0) {
            execv(words[0], words);
        }
        _exit(127);
    }
    for (int k = 0; k < n; ++k) {
        free(words[k]);
    }
    return child;
}

/** Waits until the program has ended. */
static inline program_outcome program_finish(run_folder *folder, pid_t child)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    int ending = 0;
    program_outcome outcome;
    assert_int_equal(waitpid(child, &ending, 0), child);
    outcome.exit_code = WIFEXITED(ending) ? WEXITSTATUS(ending) : -1;
    outcome.signal = WIFSIGNALED(ending) ? WTERMSIG(ending) : 0;
    outcome.output = (char *)run_folder_load(run_folder_file(folder, path, "output.txt"), &n_bytes);
    outcome.errors = (char *)run_folder_load(run_folder_file(folder, path, "errors.txt"), &n_bytes);
    assert_non_null(outcome.output);
    assert_non_null(outcome.errors);
    return outcome;
}

/** Frees what an outcome owns. */
static inline void program_clear(program_outcome *outcome)
{
    free(outcome->output);
    free(outcome->errors);
    memset(outcome, 0, sizeof *outcome);
}

/** Runs the program to its end and fails unless it ends with an exit code; the caller clears the outcome. */
static inline program_outcome program_run(run_folder *folder, const char *const *arguments, int exit_code)
{
    const program_outcome outcome = program_finish(folder, program_start(folder, arguments));
    if (outcome.exit_code != exit_code) {
        fail_msg("'moraine %s %s ...' ended with code %d (signal %d), not %d: %s", arguments[0],
                 arguments[0] != NULL && arguments[1] != NULL ? arguments[1] : "", outcome.exit_code, outcome.signal,
                 exit_code, outcome.errors);
    }
    return outcome;
}

/** Fails unless a text, zero-terminated, holds another. */
static inline void program_expect_text(const char *text, const char *part)
{
    if (strstr(text, part) == NULL) {
        fail_msg("found no \"%s\" in \"%s\"", part, text);
    }
}

/** Starts the program as program_start does and kills it after some seconds; false when it had ended before, which must
 *  have been well. */
static inline bool program_kill_after(run_folder *folder, const char *const *arguments, double seconds)
{
    const pid_t child = program_start(folder, arguments);
    usleep((useconds_t)(1e6 * seconds));
    assert_int_equal(kill(child, SIGKILL), 0);
    program_outcome outcome = program_finish(folder, child);
    const bool is_killed = outcome.signal == SIGKILL;
    if (!is_killed && outcome.exit_code != 0) {
        fail_msg("the run ended with code %d: %s", outcome.exit_code, outcome.errors);
    }
    program_clear(&outcome);
    return is_killed;
}

#endif
