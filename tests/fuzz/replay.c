/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Feeds every file of the folders named on the command line to a fuzz target, so that compilers without libFuzzer run
 * the seeds too. A defect shows as a crash or a sanitizer report. */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes);

/* Runs the target on one file; returns the number of files that could not be read. */
static int replay_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        perror(path);
        return 1;
    }
    size_t n_bytes = 0;
    size_t capacity = 4096;
    uint8_t *data = malloc(capacity);
    while (data != NULL) {
        n_bytes += fread(data + n_bytes, 1, capacity - n_bytes, file);
        if (n_bytes < capacity) {
            break;
        }
        uint8_t *larger = realloc(data, 2 * capacity);
        if (larger == NULL) {
            free(data);
        }
        data = larger;
        capacity *= 2;
    }
    const int failed = data == NULL || ferror(file);
    fclose(file);
    if (failed) {
        fprintf(stderr, "%s: could not be read\n", path);
    } else {
        /* An exact copy, so that a sanitizer sees a read past the end. */
        uint8_t *exact = malloc(n_bytes > 0 ? n_bytes : 1);
        if (exact != NULL) {
            memcpy(exact, data, n_bytes);
            (void)LLVMFuzzerTestOneInput(exact, n_bytes);
            free(exact);
        }
    }
    free(data);
    return failed;
}

int main(int argc, char **argv)
{
    int n_files = 0;
    int n_failed = 0;
    for (int argument = 1; argument < argc; ++argument) {
        DIR *folder = opendir(argv[argument]);
        if (folder == NULL) {
            perror(argv[argument]);
            return 1;
        }
        for (const struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
            char path[4096];
            if (entry->d_name[0] == '.') {
                continue;
            }
            if (snprintf(path, sizeof path, "%s/%s", argv[argument], entry->d_name) >= (int)sizeof path) {
                fprintf(stderr, "%s/%s: the path is too long\n", argv[argument], entry->d_name);
                n_failed += 1;
                continue;
            }
            n_failed += replay_file(path);
            n_files += 1;
        }
        closedir(folder);
    }
    printf("%d seeds replayed\n", n_files);
    if (n_files == 0) {
        fprintf(stderr, "no seeds found: put at least one into the corpus folder of this fuzz target\n");
        return 1;
    }
    return n_failed > 0;
}
