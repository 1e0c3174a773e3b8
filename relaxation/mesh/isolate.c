/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/mesh/isolate_internal.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* Bytes of address space the process has now; 0 when that is not known. */
static size_t find_size(void)
{
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "re");
    if (file != NULL) {
        const int n = fscanf(file, "%llu", &pages);
        pages = n == 1 ? pages : 0;
        fclose(file);
    }
    return (size_t)pages * (size_t)sysconf(_SC_PAGESIZE);
}

static void limit_resource(int resource, size_t value)
{
    struct rlimit limit;
    if (getrlimit(resource, &limit) == 0 && (limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur > value)) {
        limit.rlim_cur = value;
        (void)setrlimit(resource, &limit);
    }
}

/* Signals as the system has them, no core file, no output, bounded time and memory. */
static void settle_child(unsigned seconds, size_t extra_bytes)
{
    static const int signals[] = {SIGSEGV, SIGBUS,  SIGABRT, SIGFPE,  SIGILL, SIGTRAP,
                                  SIGALRM, SIGXCPU, SIGTERM, SIGPIPE, SIGINT, SIGHUP};
    const size_t size = find_size();
    sigset_t none;
    for (size_t k = 0; k < sizeof signals / sizeof *signals; ++k) {
        (void)signal(signals[k], SIG_DFL);
    }
    sigemptyset(&none);
    (void)sigprocmask(SIG_SETMASK, &none, NULL);
    const int nowhere = open("/dev/null", O_RDWR);
    if (nowhere >= 0) {
        (void)dup2(nowhere, STDIN_FILENO);
        (void)dup2(nowhere, STDOUT_FILENO);
        (void)dup2(nowhere, STDERR_FILENO);
    }
    limit_resource(RLIMIT_CORE, 0);
    if (size > 0) {
        limit_resource(RLIMIT_AS, size + extra_bytes);
    }
    (void)alarm(seconds);
}

static void run_child(mor_isolate_work work, const void *user, int file)
{
    FILE *result = fdopen(file, "wb");
    if (result != NULL) {
        work(user, result);
        (void)fflush(result);
    }
    /* Not exit: what the parent has open, registered or not yet written is not the child's. */
    _exit(0);
}

/* A pipe whose ends are none of the three standard files, which the child points elsewhere. */
static bool open_pipe(int *ends)
{
    if (pipe2(ends, O_CLOEXEC) != 0) {
        return false;
    }
    for (int k = 0; k < 2; ++k) {
        if (ends[k] <= STDERR_FILENO) {
            const int raised = fcntl(ends[k], F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
            const int code = errno;
            (void)close(ends[k]);
            if (raised < 0) {
                (void)close(ends[1 - k]);
                errno = code;
                return false;
            }
            ends[k] = raised;
        }
    }
    return true;
}

mor_status mor_isolate_start(mor_context *context, mor_isolate *it, mor_isolate_work work, const void *user,
                             unsigned seconds, size_t extra_bytes)
{
    int ends[2];
    *it = (mor_isolate){.child = -1};
    MOR_CHECK(context, open_pipe(ends), MOR_ERROR_IO, "a pipe cannot be opened: %s", strerror(errno));
    it->child = fork();
    if (it->child == 0) {
        (void)close(ends[0]);
        settle_child(seconds, extra_bytes);
        run_child(work, user, ends[1]);
    }
    const int code = errno;
    (void)close(ends[1]);
    it->result = it->child > 0 ? fdopen(ends[0], "rb") : NULL;
    if (it->result == NULL) {
        char ending[8];
        (void)close(ends[0]);
        mor_isolate_finish(it, ending, sizeof ending);
        return MOR_FAIL(context, MOR_ERROR_IO, "a process cannot be started: %s; free some memory", strerror(code));
    }
    return MOR_OK;
}

bool mor_isolate_read(mor_isolate *it, void *bytes, size_t n)
{
    return fread(bytes, 1, n, it->result) == n;
}

void mor_isolate_finish(mor_isolate *it, char *ending, size_t room)
{
    int code = 0;
    snprintf(ending, room, "ended");
    if (it->result != NULL) {
        fclose(it->result);
    }
    if (it->child > 0) {
        /* Without a reader it has nothing more to do. One that is ending already keeps its own end. */
        (void)kill(it->child, SIGKILL);
        while (waitpid(it->child, &code, 0) < 0 && errno == EINTR) {
        }
        if (WIFSIGNALED(code)) {
            const int number = WTERMSIG(code);
            snprintf(ending, room, number == SIGALRM ? "took too long" : "crashed (%s)", strsignal(number));
        }
    }
    *it = (mor_isolate){.child = -1};
}
