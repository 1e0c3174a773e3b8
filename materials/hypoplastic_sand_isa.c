/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Hypoplastic sand: von Wolffersdorff (1996), with the intergranular strain of Niemunis and Herle (1997). The law gives
 * rates only; they are integrated by the host. docs/theory/hypoplastic.md has the equations, numbered (H1) to (H14). */
#include "core/material/kit/integration.h"
#include "core/material/kit/lanes.h"
#include "core/material/kit/material.h"
#include "materials/frame/entries.h"
#include "materials/frame/invariants.h"
#include "materials/frame/lane_math.h"

#include <math.h>
#include <stddef.h>

enum {
    FRICTION_ANGLE,
    GRANULATE_HARDNESS,
    EXPONENT,
    DENSEST_VOID_RATIO,
    CRITICAL_VOID_RATIO,
    LOOSEST_VOID_RATIO,
    ALPHA,
    BETA,
    VOID_RATIO,
    ELASTIC_RANGE,
    REVERSAL_FACTOR,
    TURN_FACTOR,
    EVOLUTION_EXPONENT,
    STIFFNESS_EXPONENT,
    MINIMUM_PRESSURE,
    WAVE_PRESSURE,
    INTEGRATION,
    N_PARAMETERS = INTEGRATION + MOR_INTEGRATION_COUNT
};

/* State variables; the intergranular strain is stored over the elastic range R, so that its length is at most one. */
enum { STATE_VOID_RATIO, STATE_INTERGRANULAR };

/* Constants of one instance. */
typedef struct sand {
    double hardness;         /* h_s, Pa */
    double exponent;         /* n */
    double densest;          /* e_d0 */
    double critical;         /* e_c0 */
    double alpha, beta;      /* exponents of density, 1 */
    double cone;             /* a of (H5), 1 */
    double barotropy;        /* of (H9) without the pressure and e_i, Pa */
    double loosest;          /* e_i0 */
    double void_ratio;       /* at the start */
    double range;            /* R; 0: no intergranular strain */
    double reversal, turn;   /* m_R, m_T */
    double evolution;        /* beta_r */
    double stiffness;        /* chi */
    double shift;            /* minimum pressure p_t, Pa */
    double wave_pressure;    /* Pa */
    double largest_deviator; /* |s| of the critical cone in triaxial compression at the minimum pressure, Pa */
} sand;

static const double SQRT2 = 1.41421356237309504880;
static const double SQRT3 = 1.73205080756887729353;
static const double SQRT6 = 2.44948974278317809820;

/* tan(psi) is sqrt(2) where a principal stress vanishes; beyond this part of it the law is evaluated there. */
static const double LARGEST_TANGENT = 1.35;

/* Where the pressure has fallen below this part of the minimum pressure, the law is evaluated there. */
static const double LEAST_PRESSURE = 0.1;

/* Void ratio at which a law without any pores is still defined. */
static const double LEAST_VOID_RATIO = 1e-3;

static MOR_LANES_INLINE mor_symmetric scale(double factor, mor_symmetric a)
{
    return (mor_symmetric){factor * a.xx, factor * a.yy, factor * a.zz, factor * a.xy, factor * a.yz, factor * a.zx};
}

/* tr(a a a) of a deviator is three times its determinant. */
static MOR_LANES_INLINE double trace_of_cube(mor_symmetric a)
{
    return 3.0 * (a.xx * (a.yy * a.zz - a.yz * a.yz) + a.xy * (a.yz * a.zx - a.xy * a.zz) +
                  a.zx * (a.xy * a.yz - a.yy * a.zx));
}

/* What stress and void ratio make of the law: L = scale (F2 I + a2 T T), N = loosening (T + T*). Selections instead of
 * branches throughout, so that all lanes run the same instructions. */
typedef struct stiffness {
    mor_symmetric direction; /* T over its trace, 1 */
    mor_symmetric deviator;  /* its deviator, 1 */
    double scale;            /* f_b f_e / (T:T), Pa */
    double factor2;          /* F^2, 1 */
    double cone2;            /* a^2, 1 */
    double loosening;        /* scale f_d a F, Pa */
} stiffness;

/* (H6) to (H8): the factor of Matsuoka and Nakai for a deviator with square s2. */
static MOR_LANES_INLINE double find_factor(mor_symmetric deviator, double s2)
{
    const double safe2 = s2 > 1e-30 ? s2 : 1.0;
    const double tangent = SQRT3 * sqrt(s2);
    const double lode = -SQRT6 * trace_of_cube(deviator) / (safe2 * sqrt(safe2));
    const double below = lode < 1.0 ? lode : 1.0;
    const double cosine = below > -1.0 ? below : -1.0;
    const double root = 0.125 * tangent * tangent + (2.0 - tangent * tangent) / (2.0 + SQRT2 * tangent * cosine);
    return sqrt(root) - tangent * (0.5 / SQRT2);
}

/* Direction, pressure and density; pressure and deviator are kept inside the law's domain. (H9) to (H11). */
static MOR_LANES_INLINE stiffness find_stiffness(const sand *m, mor_symmetric stress, double void_ratio)
{
    stiffness k;
    const double mean = mor_invariant_i1(stress) * (1.0 / 3.0);
    const double least = LEAST_PRESSURE * m->shift;
    const double pressure = m->shift - mean > least ? m->shift - mean : least;
    const mor_symmetric free = mor_symmetric_rescale(stress, -1.0 / (3.0 * pressure), 0.0);
    const double largest2 = LARGEST_TANGENT * LARGEST_TANGENT / 3.0;
    const double free2 = mor_symmetric_product(free, free);
    const int is_beyond = free2 > largest2;
    const double s2 = is_beyond ? largest2 : free2;
    k.deviator = scale(is_beyond ? sqrt(largest2 / free2) : 1.0, free);
    k.direction = k.deviator;
    k.direction.xx += 1.0 / 3.0;
    k.direction.yy += 1.0 / 3.0;
    k.direction.zz += 1.0 / 3.0;
    const double factor = find_factor(k.deviator, s2);
    k.factor2 = factor * factor;
    k.cone2 = m->cone * m->cone;

    const double relative = 3.0 * pressure / m->hardness;
    const double power = mor_lane_exp(m->exponent * mor_lane_log(relative));
    const double decay = mor_lane_exp(-power);
    const double e = void_ratio > LEAST_VOID_RATIO ? void_ratio : LEAST_VOID_RATIO;
    const double loosest = m->loosest * decay;
    const double density = (e - m->densest * decay) / ((m->critical - m->densest) * decay);
    const int is_possible = density > 1e-300;
    const double raised = mor_lane_exp(m->alpha * mor_lane_log(is_possible ? density : 1.0));
    const double stiffening = mor_lane_exp(m->beta * mor_lane_log(m->critical * decay / e));
    k.scale = m->barotropy * (1.0 + loosest) / loosest * (relative / power) * stiffening / (s2 + 1.0 / 3.0);
    k.loosening = m->cone * factor * k.scale * (is_possible ? raised : 0.0);
    return k;
}

static MOR_LANES_INLINE mor_symmetric apply(const stiffness *k, mor_symmetric d)
{
    return mor_symmetric_add(scale(k->scale * k->factor2, d),
                             k->scale * k->cone2 * mor_symmetric_product(k->direction, d), k->direction);
}

/* (H12): stress rate without intergranular strain. */
static MOR_LANES_INLINE mor_symmetric find_plain_rate(const stiffness *k, mor_symmetric d)
{
    return mor_symmetric_add(apply(k, d), k->loosening * sqrt(mor_symmetric_product(d, d)),
                             mor_symmetric_add(k->direction, 1.0, k->deviator));
}

/* (H13), (H14): stress rate and rate of the intergranular strain over R, h. */
static MOR_LANES_INLINE mor_symmetric find_rate(const sand *m, const stiffness *k, mor_symmetric d, mor_symmetric h,
                                                mor_symmetric *h_rate)
{
    const double length = sqrt(mor_symmetric_product(h, h));
    const double below = length < 1.0 ? length : 1.0;
    const double logarithm = mor_lane_log(below > 1e-300 ? below : 1e-300);
    const mor_symmetric along = scale(length > 1e-300 ? 1.0 / length : 0.0, h);
    const double weight = mor_lane_exp(m->stiffness * logarithm);
    const double slowing = mor_lane_exp(m->evolution * logarithm);
    const double advance = mor_symmetric_product(along, d);
    const double forward = advance > 0.0 ? advance : 0.0;
    const double elastic = weight * m->turn + (1.0 - weight) * m->reversal;
    const double rest = weight * ((advance > 0.0 ? 1.0 : m->reversal) - m->turn);
    const mor_symmetric linear = apply(k, d);
    const mor_symmetric stiff = apply(k, along);
    const mor_symmetric loosening = mor_symmetric_add(k->direction, 1.0, k->deviator);
    *h_rate = scale(1.0 / m->range, mor_symmetric_add(d, -forward * slowing, along));
    return mor_symmetric_add(mor_symmetric_add(scale(elastic, linear), rest * advance, stiff),
                             weight * k->loosening * forward, loosening);
}

/* Operations. */

/* A block of particles, one array per number. */
typedef struct block {
    double gradient[9][MOR_LANES]; /* 1/s */
    double stress[6][MOR_LANES];   /* Pa; then its rate, Pa/s */
    double strain[6][MOR_LANES];   /* intergranular, over R, 1; then its rate, 1/s */
    double void_ratio[MOR_LANES];  /* 1; then its rate, 1/s */
} block;

static MOR_LANES_INLINE mor_symmetric read_lane(double (*from)[MOR_LANES], int lane)
{
    return (mor_symmetric){from[0][lane], from[1][lane], from[2][lane], from[3][lane], from[4][lane], from[5][lane]};
}

static MOR_LANES_INLINE void write_lane(mor_symmetric a, double (*to)[MOR_LANES], int lane)
{
    to[0][lane] = a.xx;
    to[1][lane] = a.yy;
    to[2][lane] = a.zz;
    to[3][lane] = a.xy;
    to[4][lane] = a.yz;
    to[5][lane] = a.zx;
}

static MOR_LANES_INLINE void find_block_rates(const sand *constants, block *b, int has_strain, int n_lanes)
{
    /* A copy, so that the compiler can rely on it not being changed by stores to the block. */
    const sand m = *constants;
    for (int lane = 0; lane < n_lanes; ++lane) {
        const mor_symmetric d = {b->gradient[0][lane],
                                 b->gradient[4][lane],
                                 b->gradient[8][lane],
                                 0.5 * (b->gradient[1][lane] + b->gradient[3][lane]),
                                 0.5 * (b->gradient[5][lane] + b->gradient[7][lane]),
                                 0.5 * (b->gradient[6][lane] + b->gradient[2][lane])};
        const double e = b->void_ratio[lane];
        const stiffness k = find_stiffness(&m, read_lane(b->stress, lane), e);
        mor_symmetric h_rate = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        const mor_symmetric rate =
            has_strain ? find_rate(&m, &k, d, read_lane(b->strain, lane), &h_rate) : find_plain_rate(&k, d);
        write_lane(rate, b->stress, lane);
        write_lane(h_rate, b->strain, lane);
        b->void_ratio[lane] = (1.0 + e) * mor_invariant_i1(d);
    }
}

/* Constant arguments, so that each becomes a function of its own; sub-steps come one particle at a time. */
static void find_rates(const sand *m, block *b, int64_t n)
{
    if (n > 1 && m->range > 0.0) {
        find_block_rates(m, b, 1, MOR_LANES);
    } else if (n > 1) {
        find_block_rates(m, b, 0, MOR_LANES);
    } else if (m->range > 0.0) {
        find_block_rates(m, b, 1, 1);
    } else {
        find_block_rates(m, b, 0, 1);
    }
}

static MOR_LANES_INLINE void load(const double *from, int64_t n_lanes, int n_components, double (*to)[MOR_LANES])
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < n_components; ++a) {
            to[a][lane] = from[n_components * lane + a];
        }
    }
}

static MOR_LANES_INLINE void store(double (*from)[MOR_LANES], int64_t n_lanes, int n_components, double *to)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < n_components; ++a) {
            to[n_components * lane + a] = from[a][lane];
        }
    }
}

/* The last block has empty lanes: a result must not depend on a particle's index. */
static mor_status sand_stress_rate(const mor_material_instance *instance, const mor_batch *batch, double *stress_rate,
                                   double *const *state_rate)
{
    const sand *m = instance->data;
    for (int64_t first = 0; first < batch->n; first += MOR_LANES) {
        const int64_t left = batch->n - first;
        const int64_t n = left < MOR_LANES ? left : MOR_LANES;
        block b = {0};
        load(batch->velocity_gradient + 9 * first, n, 9, b.gradient);
        load(batch->stress_in + 6 * first, n, 6, b.stress);
        load(batch->state_in[STATE_INTERGRANULAR] + 6 * first, n, 6, b.strain);
        load(batch->state_in[STATE_VOID_RATIO] + first, n, 1, &b.void_ratio);
        find_rates(m, &b, n);
        store(b.stress, n, 6, stress_rate + 6 * first);
        store(b.strain, n, 6, state_rate[STATE_INTERGRANULAR] + 6 * first);
        store(&b.void_ratio, n, 1, state_rate[STATE_VOID_RATIO] + first);
    }
    return MOR_OK;
}

/* Compression beyond the densest packing is none of the soil's: velocity gradients of particles at a surface have such
 * errors, and would leave a void ratio at which the law has no strength limit. */
static double keep_possible(const sand *m, double void_ratio, double pressure)
{
    if (void_ratio >= m->densest) {
        return void_ratio;
    }
    const double least = LEAST_PRESSURE * m->shift;
    const double relative = 3.0 * (pressure > least ? pressure : least) / m->hardness;
    const double densest = m->densest * mor_lane_exp(-mor_lane_exp(m->exponent * mor_lane_log(relative)));
    return void_ratio > densest ? void_ratio : densest;
}

/* Sand has no tension: a mean stress above zero becomes zero, and what remains of the deviator is what the minimum
 * pressure can hold. Continuous, so that a small change of the start makes a small change of the end. */
static mor_status sand_limit(const mor_material_instance *instance, const mor_batch *batch)
{
    const sand *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        if (mor_invariant_i1(stress) > 0.0) {
            const double length = sqrt(2.0 * mor_invariant_j2(stress));
            stress =
                mor_symmetric_rescale(stress, length > m->largest_deviator ? m->largest_deviator / length : 1.0, 0.0);
        }
        mor_symmetric_write(stress, batch->stress_out + 6 * i);
        mor_symmetric_write(mor_symmetric_read(batch->state_in[STATE_INTERGRANULAR] + 6 * i),
                            batch->state_out[STATE_INTERGRANULAR] + 6 * i);
        batch->state_out[STATE_VOID_RATIO][i] =
            keep_possible(m, batch->state_in[STATE_VOID_RATIO][i], m->shift - mor_invariant_i1(stress) * (1.0 / 3.0));
    }
    return MOR_OK;
}

static mor_status sand_init_state(const mor_material_instance *instance, const mor_batch *batch)
{
    const sand *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        batch->state_out[STATE_VOID_RATIO][i] = m->void_ratio;
        mor_symmetric_write((mor_symmetric){0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
                            batch->state_out[STATE_INTERGRANULAR] + 6 * i);
    }
    return MOR_OK;
}

/* Bulk modulus at a pressure: the linear part of (H4) in isotropic compression, times m_R (or m_T where that is more)
 * after a reversal of strain; or that of extension, where both parts add, if it is more. */
static MOR_LANES_INLINE double find_bulk(const sand *m, double pressure, double void_ratio)
{
    const double stiffest = m->reversal > m->turn ? m->reversal : m->turn;
    const double factor = m->range > 0.0 && stiffest > 1.0 ? stiffest : 1.0;
    const stiffness k = find_stiffness(m, (mor_symmetric){-pressure, -pressure, -pressure, 0.0, 0.0, 0.0}, void_ratio);
    const double linear = k.scale * (3.0 + k.cone2) * (1.0 / 9.0);
    const double extension = linear + k.loosening * (SQRT3 / 9.0);
    return factor * linear > extension ? factor * linear : extension;
}

/* sqrt(K / rho) with the bulk modulus at no less than the pressure of reference. Where that is beyond what the grains
 * bear, the modulus falls with pressure, and that at the pressure of the soil may be the larger one. */
static mor_status sand_wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    const sand m = *(const sand *)instance->data;
    for (int64_t first = 0; first < batch->n; first += MOR_LANES) {
        const int64_t n = batch->n - first < MOR_LANES ? batch->n - first : MOR_LANES;
        double stress[6][MOR_LANES] = {0};
        double e[MOR_LANES] = {0};
        double bulk[MOR_LANES];
        load(batch->stress_in + 6 * first, n, 6, stress);
        load(batch->state_in[STATE_VOID_RATIO] + first, n, 1, &e);
        for (int lane = 0; lane < MOR_LANES; ++lane) {
            const double p = (stress[0][lane] + stress[1][lane] + stress[2][lane]) * (-1.0 / 3.0);
            const double at_reference = find_bulk(&m, p > m.wave_pressure ? p : m.wave_pressure, e[lane]);
            const double here = find_bulk(&m, p > 0.0 ? p : 0.0, e[lane]);
            bulk[lane] = here > at_reference ? here : at_reference;
        }
        for (int64_t lane = 0; lane < n; ++lane) {
            speed[first + lane] = sqrt(bulk[lane] / batch->density[first + lane]);
        }
    }
    return MOR_OK;
}

static mor_status sand_admissible(const mor_material_instance *instance, const mor_batch *batch, double *distance)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        distance[i] = mor_invariant_i1(mor_symmetric_read(batch->stress_in + 6 * i)) * (1.0 / 3.0);
    }
    return MOR_OK;
}

static mor_status check_void_ratios(const mor_services *services, const double *value)
{
    const double densest = value[DENSEST_VOID_RATIO];
    const double critical = value[CRITICAL_VOID_RATIO];
    const double loosest = value[LOOSEST_VOID_RATIO];
    const double start = value[VOID_RATIO];
    if (!(densest < critical && critical < loosest)) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "hypoplastic_sand: densest_void_ratio, critical_void_ratio and loosest_void_ratio are "
                                 "%g, %g and %g; allowed: each larger than the one before",
                                 densest, critical, loosest);
    }
    if (!(start >= densest && start <= loosest)) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "hypoplastic_sand: void_ratio is %g; allowed: from densest_void_ratio %g to "
                                 "loosest_void_ratio %g",
                                 start, densest, loosest);
    }
    return MOR_OK;
}

static mor_status sand_create(const mor_services *services, mor_material_instance *instance)
{
    const double *value = instance->parameters;
    mor_status status = check_void_ratios(services, value);
    if (status == MOR_OK) {
        status =
            services->memory_new(services->context, &instance->data, 1, sizeof(sand), "hypoplastic_sand constants");
    }
    if (status != MOR_OK) {
        return status;
    }
    sand *m = instance->data;
    const double sine = sin(value[FRICTION_ANGLE]);
    const double cone = SQRT3 * (3.0 - sine) / (2.0 * SQRT2 * sine);
    const double loose = pow((value[LOOSEST_VOID_RATIO] - value[DENSEST_VOID_RATIO]) /
                                 (value[CRITICAL_VOID_RATIO] - value[DENSEST_VOID_RATIO]),
                             value[ALPHA]);
    const double bracket = 3.0 + cone * cone - cone * SQRT3 * loose;
    if (!(bracket > 0.0)) {
        return MOR_SERVICES_FAIL(
            services, MOR_ERROR_ARGUMENT,
            "hypoplastic_sand: with alpha %g and these void ratios the loosest sand would not resist "
            "compression (3 + a^2 - a sqrt(3) ((e_i0 - e_d0)/(e_c0 - e_d0))^alpha is %g; allowed: "
            "> 0); lower alpha or raise critical_void_ratio",
            value[ALPHA], bracket);
    }
    *m = (sand){.hardness = value[GRANULATE_HARDNESS],
                .exponent = value[EXPONENT],
                .densest = value[DENSEST_VOID_RATIO],
                .critical = value[CRITICAL_VOID_RATIO],
                .loosest = value[LOOSEST_VOID_RATIO],
                .alpha = value[ALPHA],
                .beta = value[BETA],
                .cone = cone,
                .barotropy = value[GRANULATE_HARDNESS] / value[EXPONENT] *
                             pow(value[LOOSEST_VOID_RATIO] / value[CRITICAL_VOID_RATIO], value[BETA]) / bracket,
                .void_ratio = value[VOID_RATIO],
                .range = value[ELASTIC_RANGE],
                .reversal = value[REVERSAL_FACTOR],
                .turn = value[TURN_FACTOR],
                .evolution = value[EVOLUTION_EXPONENT],
                .stiffness = value[STIFFNESS_EXPONENT],
                .shift = value[MINIMUM_PRESSURE],
                .wave_pressure = value[WAVE_PRESSURE],
                .largest_deviator = value[MINIMUM_PRESSURE] * 2.0 * SQRT6 * sine / (3.0 - sine)};
    return MOR_OK;
}

static void sand_destroy(const mor_services *services, mor_material_instance *instance)
{
    services->memory_free(services->context, &instance->data);
}

static const mor_schema PARAMETERS[] = {
    [FRICTION_ANGLE] = {MOR_POSITIVE_ENTRY("critical_friction_angle", "rad", 1.57079632679489662,
                                           "critical friction angle phi_c"),
                        .role = MOR_ROLE_FRICTION_ANGLE, .is_required = 1, .excludes_maximum = 1},
    [GRANULATE_HARDNESS] = {MOR_POSITIVE_ENTRY("granulate_hardness", "Pa", INFINITY, "granulate hardness h_s"),
                            .is_required = 1},
    [EXPONENT] = {MOR_POSITIVE_ENTRY("exponent", "1", 1.0, "exponent n of the compression law"), .is_required = 1},
    [DENSEST_VOID_RATIO] = {MOR_POSITIVE_ENTRY("densest_void_ratio", "1", 5.0,
                                               "void ratio e_d0 of the densest packing at zero pressure"),
                            .is_required = 1},
    [CRITICAL_VOID_RATIO] = {MOR_POSITIVE_ENTRY("critical_void_ratio", "1", 5.0,
                                                "critical void ratio e_c0 at zero pressure"),
                             .is_required = 1},
    [LOOSEST_VOID_RATIO] = {MOR_POSITIVE_ENTRY("loosest_void_ratio", "1", 5.0,
                                               "void ratio e_i0 of the loosest packing at zero pressure"),
                            .is_required = 1},
    [ALPHA] = {MOR_REAL_ENTRY("alpha", "1", 0.0, 1.0, "exponent alpha: peak friction by density"), .is_required = 1},
    [BETA] = {MOR_REAL_ENTRY("beta", "1", 0.0, 5.0, "exponent beta: stiffness by density"), .is_required = 1},
    [VOID_RATIO] = {MOR_POSITIVE_ENTRY("void_ratio", "1", 5.0, "void ratio at the start"), .is_required = 1},
    [ELASTIC_RANGE] = {MOR_REAL_ENTRY("elastic_range", "1", 0.0, 0.01,
                                      "size R of the elastic range in strain; 0: no intergranular strain"),
                       .default_value = 1e-4},
    [REVERSAL_FACTOR] = {MOR_REAL_ENTRY("reversal_factor", "1", 1.0, 50.0,
                                        "stiffness m_R after a reversal of strain over that of continued strain"),
                         .default_value = 5.0},
    [TURN_FACTOR] = {MOR_REAL_ENTRY("turn_factor", "1", 1.0, 50.0,
                                    "the same, m_T, after a turn of strain by 90 degrees"),
                     .default_value = 2.0},
    [EVOLUTION_EXPONENT] = {MOR_POSITIVE_ENTRY("evolution_exponent", "1", 10.0,
                                               "exponent beta_r of the evolution of intergranular strain"),
                            .default_value = 0.5},
    [STIFFNESS_EXPONENT] = {MOR_POSITIVE_ENTRY("stiffness_exponent", "1", 20.0,
                                               "exponent chi of the loss of stiffness with intergranular strain"),
                            .default_value = 6.0},
    [MINIMUM_PRESSURE] =
        {MOR_POSITIVE_ENTRY("minimum_pressure", "Pa", INFINITY,
                            "pressure p_t that the law adds to that of the soil; it keeps stiffness at a free surface"),
         .default_value = 100.0},
    [WAVE_PRESSURE] = {MOR_POSITIVE_ENTRY(
                           "wave_pressure", "Pa", INFINITY,
                           "usual pressure: dissipation, stress diffusion and the longest step follow from the "
                           "stiffness there; under more pressure steps are shorter"),
                       .default_value = 1e5},
    [INTEGRATION] = MOR_INTEGRATION_SCHEMAS("explicit|implicit|bdf", 1e-4, 1.0, 10000.0),
    [N_PARAMETERS] = {.key = NULL},
};

static const mor_schema STATE[] = {
    [STATE_VOID_RATIO] = {MOR_REAL_ENTRY("void_ratio", "1", 0.0, INFINITY, "void ratio e")},
    [STATE_INTERGRANULAR] = {.key = "intergranular_strain",
                             .kind = MOR_SCHEMA_VECTOR,
                             .n_components = 6,
                             .unit = "1",
                             .minimum = -INFINITY,
                             .maximum = INFINITY,
                             .text = "intergranular strain over the elastic range R, (xx, yy, zz, xy, yz, zx)"},
    {.key = NULL},
};

const mor_material MOR_ISA_NAME(mor_hypoplastic_sand) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "hypoplastic_sand",
    .version = "1.0",
    .text = "sand whose stiffness and strength follow from pressure and void ratio, with intergranular strain",
    .literature = "von Wolffersdorff (1996); Niemunis and Herle (1997)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_STIFFENS,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = sand_create,
            .destroy = sand_destroy,
            .init_state = sand_init_state,
            .wave_speed = sand_wave_speed,
            .stress_rate = sand_stress_rate,
            .limit = sand_limit,
            .admissible = sand_admissible,
        },
};
