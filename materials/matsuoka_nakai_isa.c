/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Elastic, perfectly plastic soil with the smooth surface I1 I2 / I3 = const of Matsuoka and Nakai (1974) and
 * non-associated flow, returned exactly. docs/theory/mohr_coulomb.md.
 *
 * With r = sqrt(J2), the Lode angle t (0 in triaxial compression, pi/3 in extension) and the pressure q above the apex,
 * the surface is a cubic in q, whose largest root gives f = r y(t) - slope q, y = cos(acos(-corner cos 3t) / 3). The
 * function r y is a convex norm of the deviator; its gradient is the deviatoric flow. Backward Euler then leaves one
 * equation in the Lode angle, with a zero between compression and the angle of the trial. */
#include "materials/frame/frictional.h"
#include "materials/frame/principal_lanes.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Places of the parameters in the value array. */
enum { YOUNGS_MODULUS, POISSONS_RATIO, FRICTION_ANGLE, COHESION, DILATION_ANGLE, PARAMETER_COUNT };

/* Constants of one instance. */
typedef struct matsuoka_nakai {
    mor_hooke elastic; /* first, for the operations of hooke.h */
    mor_principal_bound bound;
    double slope;    /* r y over the pressure above the apex, 1 */
    double corner;   /* 0: a circle, 1: a triangle; 1 */
    double gap;      /* 1 - corner, 1 */
    double apex;     /* c / tan(phi), Pa */
    double dilation; /* part of the associated dilation, 0 to 1 */
    double opening;  /* rise of slope q by what r loses, K slope^2 dilation / G, 1 */
} matsuoka_nakai;

/* The norm's factor y and its derivatives by the Lode angle; unit 1. */
typedef struct shape {
    double y, first, second;
} shape;

/* y(w) = cos(acos(w)/3) is the largest root of 4 y^3 - 3 y = w, w = -corner cos(3t). With y = 1/2 + z that is
 * z^2 (6 + 4 z) = 1 + w, in which nothing cancels at the corner of a triangle, where both sides vanish. In
 * u = sqrt((1 + w)/2) z is smooth: Newton's method starts from the quadratic with the value and slope of z at u = 0 and
 * its value at u = 1, off by less than 2e-3 of z; three steps leave rounding, and one more is taken. */
static MOR_LANES_INLINE shape find_shape(const matsuoka_nakai *m, double cosine, double sine)
{
    enum { STEPS = 4 };
    const double turn = 2.0 * cosine + 1.0;
    /* 1 - cos(3t) = (1 - cos t)(2 cos t + 1)^2 */
    const double rise = m->gap + m->corner * (sine * sine / (1.0 + cosine)) * (turn * turn);
    const double u = sqrt(0.5 * rise);
    double z = u * (MOR_INVERSE_SQRT3 + u * (0.5 - MOR_INVERSE_SQRT3));
    for (int k = 0; k < STEPS; ++k) {
        const double slope = 12.0 * z * (1.0 + z);
        z -= (z * z * (6.0 + 4.0 * z) - rise) / (slope > 0.0 ? slope : 1.0);
    }
    const double slope = 1.0 / (12.0 * z * (1.0 + z));
    const double w1 = 3.0 * m->corner * sine * (3.0 - 4.0 * sine * sine);
    const double w2 = 9.0 * (1.0 - rise);
    const double y = 0.5 + z;
    return (shape){.y = y, .first = slope * w1, .second = slope * (w2 - 24.0 * y * slope * slope * w1 * w1)};
}

/* Unknowns of the return in all lanes. The Lode angle t goes as tan(t/2): no trigonometric function is needed. */
typedef struct solution {
    double root[MOR_LANES];    /* r of the trial, Pa */
    double lift[MOR_LANES];    /* slope q of the trial, Pa */
    double cosine[MOR_LANES];  /* of the trial's Lode angle, 1 */
    double sine[MOR_LANES];    /* likewise, 1 */
    double half[MOR_LANES];    /* tan(t/2), 1 */
    double low[MOR_LANES];     /* bracket of it, 1 */
    double high[MOR_LANES];    /* 1 */
    double is_open[MOR_LANES]; /* 1 while not solved, 0 */
} solution;

static MOR_LANES_INLINE void read_trial(const matsuoka_nakai *m, const mor_principal_block *p, solution *s)
{
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const mor_principal t = mor_principal_read(p, lane);
        const double range = t.first - t.third;
        const double inverse = 1.0 / (range > DBL_MIN ? range : 1.0);
        const double upper = (t.first - t.second) * inverse;
        const double lower = (t.second - t.third) * inverse;
        /* r over the range of the stresses: no square of a stress, which might overflow or vanish */
        const double unit = sqrt((upper * upper + lower * lower + 1.0) * (1.0 / 6.0));
        const double mean = (t.first + t.second + t.third) * (1.0 / 3.0);
        s->root[lane] = range > DBL_MIN ? range * unit : 0.0;
        s->lift[lane] = m->slope * (m->apex - mean);
        s->cosine[lane] = range > DBL_MIN ? (1.0 + lower) * 0.5 * MOR_INVERSE_SQRT3 / unit : 1.0;
        s->sine[lane] = range > DBL_MIN ? 0.5 * upper / unit : 0.0;
        s->half[lane] = s->sine[lane] / (1.0 + s->cosine[lane]);
        s->low[lane] = 0.0;
        s->high[lane] = s->half[lane];
        const shape at = find_shape(m, s->cosine[lane], s->sine[lane]);
        const double outer = s->root[lane] * at.y;
        const double rounding = MOR_PRINCIPAL_ROUNDING * (outer + m->slope * (m->apex + fabs(mean)));
        s->is_open[lane] = outer - s->lift[lane] > rounding ? 1.0 : 0.0;
    }
}

/* What the trial's r loses to the flow, mu, at a Lode angle turned from the trial's by an angle with cosine turned:
 * the component of the trial along the end deviator is r + mu y, and r y = lift + opening mu. Unit Pa. */
static MOR_LANES_INLINE double find_loss(const matsuoka_nakai *m, const solution *s, int lane, double y, double turned)
{
    return (s->root[lane] * y * turned - s->lift[lane]) / (m->opening + y * y);
}

/* One step of Newton's method in all lanes that are not solved, inside the bracket: the component of the trial across
 * the end deviator, r sin(t_trial - t), is what the flow took, mu dy/dt. Returns: how many remain. */
static MOR_LANES_INLINE int improve(const matsuoka_nakai *m, solution *s)
{
    static const double TOLERANCE = 4.0 * DBL_EPSILON;
    double n_open = 0.0;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const double half = s->half[lane];
        const double norm = 1.0 / (1.0 + half * half);
        const double cosine = (1.0 - half * half) * norm;
        const double sine = 2.0 * half * norm;
        const double turned = s->cosine[lane] * cosine + s->sine[lane] * sine;
        const double across = s->sine[lane] * cosine - s->cosine[lane] * sine;
        const shape at = find_shape(m, cosine, sine);
        const double root = s->root[lane];
        const double loss = find_loss(m, s, lane, at.y, turned);
        const double loss_slope =
            (root * (at.first * turned + at.y * across) - 2.0 * at.y * at.first * loss) / (m->opening + at.y * at.y);
        const double miss = root * across - loss * at.first;
        const double slope = -root * turned - loss_slope * at.first - loss * at.second;
        const double low = miss > 0.0 ? half : s->low[lane];
        const double high = miss > 0.0 ? s->high[lane] : half;
        const double newton = half - miss / (slope < 0.0 ? slope : -1.0) * (0.5 / norm);
        const int is_inside = (slope < 0.0) & (newton >= low) & (newton <= high);
        const double next = is_inside ? newton : 0.5 * (low + high);
        const int was_open = s->is_open[lane] != 0.0;
        const double rounding = TOLERANCE * (root + fabs(loss * at.first));
        const int stays_open = was_open & (fabs(next - half) > TOLERANCE) & (fabs(miss) > rounding);
        s->half[lane] = was_open ? next : half;
        s->low[lane] = low;
        s->high[lane] = high;
        s->is_open[lane] = stays_open ? 1.0 : 0.0;
        n_open += s->is_open[lane];
    }
    return n_open > 0.0;
}

/* The end stress of a lane from its Lode angle; the apex where the pressure above it would be negative. */
static MOR_LANES_INLINE mor_principal find_end(const matsuoka_nakai *m, const solution *s, int lane)
{
    const double half = s->half[lane];
    const double norm = 1.0 / (1.0 + half * half);
    const double cosine = (1.0 - half * half) * norm;
    const double sine = 2.0 * half * norm;
    const double turned = s->cosine[lane] * cosine + s->sine[lane] * sine;
    const double y = find_shape(m, cosine, sine).y;
    const double lift = s->lift[lane] + m->opening * find_loss(m, s, lane, y, turned);
    const double kept = lift > 0.0 ? lift : 0.0;
    const double mean = m->apex - kept / m->slope;
    const double root = kept / y;
    const double shared = root * cosine * MOR_INVERSE_SQRT3;
    return (mor_principal){mean + shared + root * sine, mean + shared - root * sine, mean - 2.0 * shared};
}

static MOR_LANES_INLINE void advance_lanes(const void *constants, mor_rate_block *b)
{
    enum { ITERATIONS = 60 };
    const matsuoka_nakai m = *(const matsuoka_nakai *)constants;
    mor_principal_block p;
    mor_principal_predict(&m.elastic, b, &p);
    if (!mor_principal_may_yield(&m.bound, &p)) {
        mor_principal_keep(&p, b);
        return;
    }
    mor_principal_split(&p);
    solution s;
    read_trial(&m, &p, &s);
    double is_plastic[MOR_LANES];
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        is_plastic[lane] = s.is_open[lane];
    }
    for (int k = 0; k < ITERATIONS && improve(&m, &s); ++k) {
    }
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        mor_principal_write(&p, lane, find_end(&m, &s, lane), is_plastic[lane] != 0.0);
        b->is_unsolved[lane] = s.is_open[lane] != 0.0;
        b->n_unsolved += b->is_unsolved[lane];
    }
    mor_principal_merge(&m.elastic, &p, b);
}

static mor_status matsuoka_nakai_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    return mor_rate_run(instance->data, batch, advance_lanes, 1);
}

static mor_status matsuoka_nakai_admissible(const mor_material_instance *instance, const mor_batch *batch,
                                            double *distance)
{
    const matsuoka_nakai *model = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        mor_principal_block p = {0};
        solution s;
        for (int a = 0; a < 6; ++a) {
            p.trial[a][0] = batch->stress_in[6 * i + a];
        }
        mor_principal_split(&p);
        read_trial(model, &p, &s);
        distance[i] = s.root[0] * find_shape(model, s.cosine[0], s.sine[0]).y - s.lift[0];
    }
    return MOR_OK;
}

/* The surface of an angle: with k the constant of I1 I2 / I3, (k - 9) q^3 - (k - 3) J2 q + k J3 = 0. */
static void set_surface(matsuoka_nakai *model, double friction_angle, double dilation_angle)
{
    const double tangent = tan(friction_angle);
    const double minus_9 = 8.0 * tangent * tangent;
    const double minus_3 = 6.0 + minus_9;
    const double constant = 9.0 + minus_9;
    model->slope = sqrt(0.75 * minus_9 / minus_3);
    model->corner = constant / minus_3 * sqrt(minus_9 / minus_3);
    /* 1 - corner^2 = 27 (k - 1) / (k - 3)^3 */
    model->gap = 27.0 * (constant - 1.0) / (minus_3 * minus_3 * minus_3 * (1.0 + model->corner));
    /* In triaxial compression flow dilates as Mohr-Coulomb does with the dilation angle. */
    const double sine = sin(friction_angle);
    const double sine_dilation = sin(dilation_angle);
    model->dilation = sine_dilation * (3.0 - sine) / (sine * (3.0 - sine_dilation));
    model->opening = model->elastic.bulk * model->slope * model->slope * model->dilation / model->elastic.shear;
}

static mor_status matsuoka_nakai_create(const mor_services *services, mor_material_instance *instance)
{
    const double *value = instance->parameters;
    const double friction_angle = value[FRICTION_ANGLE];
    mor_status status = mor_frictional_check_dilation(services, "matsuoka_nakai", "dilation_angle",
                                                      value[DILATION_ANGLE], "friction_angle", friction_angle);
    if (status == MOR_OK) {
        status = services->memory_new(services->context, &instance->data, 1, sizeof(matsuoka_nakai),
                                      "matsuoka_nakai constants");
    }
    if (status != MOR_OK) {
        return status;
    }
    matsuoka_nakai *model = instance->data;
    mor_hooke_derive(&model->elastic, value[YOUNGS_MODULUS], value[POISSONS_RATIO], instance->density);
    model->apex = value[COHESION] / tan(friction_angle);
    set_surface(model, friction_angle, value[DILATION_ANGLE]);
    model->bound = (mor_principal_bound){
        .sine = sin(friction_angle), .strength = 2.0 * value[COHESION] * cos(friction_angle), .tension = INFINITY};
    return MOR_OK;
}

static const mor_schema PARAMETERS[] = {
    [YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,         [POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [FRICTION_ANGLE] = MOR_FRICTIONAL_FRICTION_ANGLE_SCHEMA(1), [COHESION] = MOR_FRICTIONAL_COHESION_SCHEMA,
    [DILATION_ANGLE] = MOR_FRICTIONAL_DILATION_ANGLE_SCHEMA,    [PARAMETER_COUNT] = {.key = NULL},
};

static const mor_schema STATE[] = {MOR_PLASTIC_STRAIN_SCHEMA, {.key = NULL}};

const mor_material MOR_ISA_NAME(mor_matsuoka_nakai) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "matsuoka_nakai",
    .version = "1.0",
    .text = "elastic, perfectly plastic soil with a smooth surface through all edges of Mohr-Coulomb's",
    .literature = "Matsuoka and Nakai (1974); Borja, Sama and Sanz (2003); Hughes and Winget (1980)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = matsuoka_nakai_create,
            .destroy = mor_hooke_destroy,
            .wave_speed = mor_hooke_wave_speed,
            .advance_rate = matsuoka_nakai_advance_rate,
            .energy = mor_hooke_energy,
            .admissible = matsuoka_nakai_admissible,
        },
};
