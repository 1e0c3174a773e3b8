/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

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
    const int exit_code = mor_command_main(argc, argv, mor_commands, made);
    session = NULL; /* there is nothing left to keep */
    mor_session_free(&made);
    return exit_code;
}
