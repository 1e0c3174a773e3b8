/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command.h"

#include <unistd.h>

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

int main(int argc, char **argv)
{
    struct sigaction action = {.sa_handler = request_stop};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    return mor_command_main(argc, argv, &stop_requested);
}
