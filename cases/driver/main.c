/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command.h"

#include <stdlib.h>
#include <unistd.h>

enum { PATH_BYTES = 4096 };

static volatile sig_atomic_t stop_requested;

/* The first signal asks for a checkpoint and an orderly end, the second ends the program at once. */
static void request_stop(int number)
{
    (void)number;
    if (stop_requested) {
        _exit(MOR_EXIT_INTERRUPTED);
    }
    stop_requested = 1;
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
    struct sigaction action = {.sa_handler = request_stop};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    /* A file beyond the limit of the shell (ulimit -f) is told as a full disk is: the write fails, with a message. */
    action.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &action, NULL);
    return mor_command_main(argc, argv, &stop_requested);
}
