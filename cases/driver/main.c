/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

#include <setjmp.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

enum { PATH_BYTES = 4096 };

/* A step may go on for so long after a signal, in microseconds. */
enum { PATIENCE = 700000 };

static mor_session *volatile session; /* what a signal handler must know of */

static void say(const char *text)
{
    const ssize_t n = write(STDERR_FILENO, text, strlen(text));
    (void)n; /* there is nobody else to tell */
}

/* The first signal asks for a checkpoint and an orderly end where there is something to keep; else, and when it is the
 * second, it ends the program at once. */
static void request_stop(int number)
{
    static const struct itimerval patience = {.it_value = {.tv_usec = PATIENCE}};
    (void)number;
    if (session == NULL || mor_session_is_stopping(session) || mor_session_find_phase(session) == MOR_SESSION_IDLE) {
        say("moraine: stopped by a signal\n");
        _exit(MOR_EXIT_INTERRUPTED);
    }
    mor_session_request_stop(session);
    setitimer(ITIMER_REAL, &patience, NULL);
}

/* A step that takes too long is given up; what is being written is finished. */
static void lose_patience(int number)
{
    (void)number;
    if (session != NULL && mor_session_find_phase(session) == MOR_SESSION_STEPPING) {
        say("moraine: stopped by a signal within a long step; go on from the last checkpoint with --resume\n");
        _exit(MOR_EXIT_INTERRUPTED);
    }
}

/* Where code of others is left when it crashes; NULL: this thread calls none. */
static _Thread_local sigjmp_buf *volatile way_back;

static const int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
enum { CRASHES = sizeof crashes / sizeof *crashes };
static struct sigaction crash_before[CRASHES];

/* A fault of the program itself goes its ordinary way, when the instruction is tried again. */
static void leave_crash(int number)
{
    if (way_back != NULL) {
        siglongjmp(*way_back, number);
    }
    for (int k = 0; k < CRASHES; ++k) {
        if (crashes[k] == number) {
            sigaction(number, &crash_before[k], NULL);
        }
    }
}

/* A stack of its own for the handler, since the crash may be that of a stack that is full. */
static void prepare_thread(void)
{
    enum { STACK_BYTES = 65536 };
    static _Thread_local char stack[STACK_BYTES];
    static _Thread_local bool is_prepared;
    stack_t present;
    if (!is_prepared && sigaltstack(NULL, &present) == 0 && (present.ss_flags & SS_DISABLE) != 0) {
        const stack_t own = {.ss_sp = stack, .ss_size = sizeof stack};
        sigaltstack(&own, NULL);
    }
    is_prepared = true;
}

static int run_guarded(void (*work)(void *job), void *job)
{
    sigjmp_buf here;
    sigjmp_buf *const before = way_back;
    prepare_thread();
    const int number = sigsetjmp(here, 0);
    if (number == 0) {
        way_back = &here;
        work(job);
    }
    way_back = before;
    return number;
}

/* A library may end the process, as STOP of Fortran does. */
static void report_exit(void)
{
    if (way_back != NULL) {
        say("moraine: the library of a material ended the program, as STOP does; go on from the last checkpoint with "
            "--resume once it does not\n");
        _exit(MOR_EXIT_FAILED);
    }
}

static void handle_crashes(void)
{
    const struct sigaction action = {.sa_handler = leave_crash, .sa_flags = SA_NODEFER | SA_ONSTACK};
    for (int k = 0; k < CRASHES; ++k) {
        sigaction(crashes[k], &action, &crash_before[k]);
    }
    atexit(report_exit);
}

static void handle_signals(void)
{
    struct sigaction action = {.sa_handler = lose_patience, .sa_flags = SA_RESTART};
    struct sigaction before;
    sigaction(SIGALRM, &action, NULL);
    action.sa_handler = request_stop;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    /* A terminal that closes; ignored under nohup, which says so before. */
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
        sigaction(SIGHUP, &action, NULL);
    }
    /* A file beyond the limit of the shell (ulimit -f) is told as a full disk is: the write fails, with a message. */
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, NULL);
}

/* Threads that wait for each other spin for a while before they sleep. On a machine that others use as well, the
 * default of some milliseconds lets them spin away the very time the slower thread needs: measured 26 times slower than
 * with a short spin. The run-time library reads its setting before main, so the program starts itself once more. */
static void shorten_waiting(char **argv)
{
    if (getenv("GOMP_SPINCOUNT") == NULL && getenv("OMP_WAIT_POLICY") == NULL &&
        setenv("GOMP_SPINCOUNT", "1000", 1) == 0) {
        char path[PATH_BYTES];
        const ssize_t n = readlink("/proc/self/exe", path, sizeof path - 1);
        if (n > 0) {
            path[n] = '\0';
            execv(path, argv); /* comes back only when it cannot; the program then runs as it is */
        }
    }
}

int main(int argc, char **argv)
{
    shorten_waiting(argv);
    mor_session *made = NULL;
    if (mor_session_new(&made) != MOR_OK) {
        say("moraine: there is not enough memory to begin\n");
        return MOR_EXIT_FAILED;
    }
    session = made;
    handle_signals();
    handle_crashes();
    mor_session_set_guard(made, run_guarded);
    const int exit_code = mor_command_main(argc, argv, mor_commands, made);
    session = NULL; /* there is nothing left to keep */
    mor_session_free(&made);
    return exit_code;
}
