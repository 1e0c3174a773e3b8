/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/nearest.h"

#include <ctype.h>
#include <limits.h>
#include <string.h>

static int fold(char letter)
{
    return letter == '-' ? '_' : tolower((unsigned char)letter);
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static int bounded_length(const char *word)
{
    return (int)strnlen(word, MOR_NEAREST_BYTES);
}

int mor_nearest_distance(const char *a, const char *b)
{
    /* Three rows suffice: a swap of neighbors looks back two. */
    int rows[3][MOR_NEAREST_BYTES + 1];
    const int a_length = bounded_length(a);
    const int b_length = bounded_length(b);
    for (int column = 0; column <= b_length; ++column) {
        rows[0][column] = column;
    }
    for (int row = 1; row <= a_length; ++row) {
        int *now = rows[row % 3];
        const int *before = rows[(row + 2) % 3];
        const int *second = rows[(row + 1) % 3];
        now[0] = row;
        for (int column = 1; column <= b_length; ++column) {
            const int is_other = fold(a[row - 1]) != fold(b[column - 1]);
            int best = smaller(before[column], now[column - 1]) + 1;
            best = smaller(best, before[column - 1] + is_other);
            const int is_swap = row > 1 && column > 1 && fold(a[row - 1]) == fold(b[column - 2]) &&
                                fold(a[row - 2]) == fold(b[column - 1]);
            now[column] = is_swap ? smaller(best, second[column - 2] + 1) : best;
        }
    }
    return rows[a_length % 3][b_length];
}

int mor_nearest_is_close(const char *word, int distance)
{
    const int allowed = bounded_length(word) / 3;
    return distance <= (allowed > 1 ? allowed : 1);
}

int mor_nearest_find(const char *word, const char *const *words, int n_words)
{
    int best = -1;
    int best_distance = INT_MAX;
    for (int i = 0; i < n_words; ++i) {
        const int distance = mor_nearest_distance(word, words[i]);
        if (distance < best_distance && mor_nearest_is_close(word, distance)) {
            best = i;
            best_distance = distance;
        }
    }
    return best;
}
