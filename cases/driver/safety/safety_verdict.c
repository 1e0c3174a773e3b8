/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/safety_verdict.h"

#include <math.h>
#include <string.h>

/* A speed that falls by less than this from window to window does not decay. */
static const double steady = 0.9;

/* Fewer samples than this in a window are not judged. */
enum { SAMPLES_LEAST = 4 };

void mor_safety_rules_init(double settlement, double period, mor_safety_rules *rules)
{
    const double window = fmax(1.0, period);
    *rules = (mor_safety_rules){.damped = fmax(1.0, 2.0 * period),
                                .window = window,
                                .least = 4.0 * window,
                                .longest = 30.0 * window,
                                .rest = 1.0e-4,
                                .motion = 1.0e-3,
                                .far = 0.01 + settlement,
                                .growth = 0.02};
}

/* Median of the speeds of samples: what rings or strays for less than half of the time does not lift it. */
static double find_median(const mor_safety_sample *samples, int n)
{
    double sorted[MOR_SAFETY_SAMPLES_MAX];
    for (int k = 0; k < n; ++k) {
        int place = k;
        for (; place > 0 && sorted[place - 1] > samples[k].speed; --place) {
            sorted[place] = sorted[place - 1];
        }
        sorted[place] = samples[k].speed;
    }
    return n % 2 == 1 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]);
}

/* First sample later than a time. */
static int find_after(const mor_safety_sample *samples, int n, double time)
{
    int first = n;
    while (first > 0 && samples[first - 1].time > time) {
        first -= 1;
    }
    return first;
}

static void judge_signs(const mor_safety_rules *rules, const mor_safety_sample *samples, int n,
                        mor_safety_finding *finding)
{
    const mor_safety_sample *last = &samples[n - 1];
    const int middle = find_after(samples, n, last->time - rules->window);
    const int first = find_after(samples, middle, last->time - 2.0 * rules->window);
    if (n - middle < SAMPLES_LEAST || middle - first < SAMPLES_LEAST ||
        last->time < rules->damped + 2.0 * rules->window) {
        return;
    }
    const double before = find_median(samples + first, middle - first);
    finding->speed = find_median(samples + middle, n - middle);
    finding->speed_ratio = before > 0.0 ? finding->speed / before : NAN;
    finding->growth = last->displacement - samples[middle - 1].displacement;
    if (finding->speed < rules->rest) {
        finding->by_speed = MOR_SAFETY_RESTS;
    } else if (finding->speed >= rules->motion && finding->speed >= steady * before) {
        finding->by_speed = MOR_SAFETY_MOVES;
    }
    const bool is_growing = finding->growth > rules->growth * rules->far;
    if (last->displacement > rules->far && is_growing) {
        finding->by_displacement = MOR_SAFETY_MOVES;
    } else if (last->displacement <= rules->far && !is_growing) {
        finding->by_displacement = MOR_SAFETY_RESTS;
    }
}

/* Why a trial that is at its end is neither stable nor failing. */
static const char *find_reason(const mor_safety_rules *rules, double displacement, const mor_safety_finding *finding)
{
    if (finding->by_speed == MOR_SAFETY_RESTS) {
        return displacement > rules->far ? "it has come to rest, but in another shape"
                                         : "it has come to rest, but its displacement grows";
    }
    if (finding->by_speed == MOR_SAFETY_MOVES) {
        return "it moves, but not far in the time given";
    }
    if (finding->speed_ratio > 1.0) {
        return displacement > rules->far ? "it has moved far, and its speed grows, but is below that of failure"
                                         : "it creeps, and its speed grows: look for a vibration in the chart of speed";
    }
    return displacement > rules->far ? "it has moved far, but its speed decays"
                                     : "it creeps: its speed neither decays to rest nor stays";
}

void mor_safety_judge(const mor_safety_rules *rules, const mor_safety_sample *samples, int n_samples,
                      mor_safety_finding *finding)
{
    *finding = (mor_safety_finding){.speed = NAN, .speed_ratio = NAN, .growth = NAN, .reason = ""};
    if (n_samples == 0) {
        return;
    }
    const mor_safety_sample *last = &samples[n_samples - 1];
    const double free = last->time - rules->damped;
    judge_signs(rules, samples, n_samples, finding);
    const bool rests = finding->by_speed == MOR_SAFETY_RESTS && free >= rules->least;
    if (finding->by_speed == MOR_SAFETY_MOVES && finding->by_displacement == MOR_SAFETY_MOVES) {
        finding->verdict = MOR_SAFETY_FAILS;
    } else if (rests && finding->by_displacement == MOR_SAFETY_RESTS) {
        finding->verdict = MOR_SAFETY_STABLE;
    } else if ((rests && last->displacement > rules->far) || free >= rules->longest ||
               n_samples >= MOR_SAFETY_SAMPLES_MAX) {
        finding->verdict = MOR_SAFETY_UNDECIDED;
        finding->reason = find_reason(rules, last->displacement, finding);
    }
}

const char *mor_safety_verdict_word(mor_safety_verdict verdict)
{
    static const char *const words[] = {[MOR_SAFETY_OPEN] = "open",
                                        [MOR_SAFETY_STABLE] = "stable",
                                        [MOR_SAFETY_FAILS] = "fails",
                                        [MOR_SAFETY_UNDECIDED] = "undecided",
                                        [MOR_SAFETY_BROKE_DOWN] = "broke down"};
    return words[verdict];
}

const char *mor_safety_sign_word(mor_safety_sign sign)
{
    static const char *const words[] = {
        [MOR_SAFETY_UNCLEAR] = "unclear", [MOR_SAFETY_RESTS] = "rests", [MOR_SAFETY_MOVES] = "moves"};
    return words[sign];
}
