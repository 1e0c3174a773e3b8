/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Laws as MFront's generic interface has them, written by hand: a shared object for tests. The record is laid out anew
 * from the documentation of that interface, apart from the one in the product. Vectors are 11, 22, 33, sqrt 2 12,
 * sqrt 2 13, sqrt 2 23. */
#include <math.h>

typedef struct generic_state {
    const double *strain;
    double *stress;
    const double *density;
    const double *property;
    double *variable;
    double *stored, *dissipated;
    const double *outer;
} generic_state;

typedef struct generic_data {
    char *message;
    double dt;
    double *K;
    double *rdt;
    double *sound;
    generic_state s0;
    generic_state s1;
} generic_data;

int Orthotropic_Tridimensional(generic_data *d);
int VonMises_Tridimensional(generic_data *d);
int Impatient_Tridimensional(generic_data *d);
int Overflow_Tridimensional(generic_data *d);

static int is_step(const generic_data *d)
{
    const double asked = d->K[0] > 50.0 ? d->K[0] - 100.0 : d->K[0];
    return asked > -0.5 && asked < 0.5;
}

/* Properties: D1111, D1122, D2222, D1133, D2233, D3333, 2 G12, 2 G13, 2 G23. */
int Orthotropic_Tridimensional(generic_data *d)
{
    const double *p = d->s1.property;
    double e[6];
    if (!is_step(d)) {
        return -1;
    }
    for (int k = 0; k < 6; ++k) {
        e[k] = d->s1.strain[k] - d->s0.strain[k];
    }
    d->s1.stress[0] = d->s0.stress[0] + p[0] * e[0] + p[1] * e[1] + p[3] * e[2];
    d->s1.stress[1] = d->s0.stress[1] + p[1] * e[0] + p[2] * e[1] + p[4] * e[2];
    d->s1.stress[2] = d->s0.stress[2] + p[3] * e[0] + p[4] * e[1] + p[5] * e[2];
    for (int k = 3; k < 6; ++k) {
        d->s1.stress[k] = d->s0.stress[k] + p[k + 3] * e[k];
    }
    if (d->K[0] > 50.0) {
        *d->sound = sqrt(p[0] / *d->s0.density);
    }
    return 1;
}

/* Perfect plasticity that keeps its elastic strain. Properties: E, nu, yield stress. Variables: elastic strain [6],
 * equivalent plastic strain. */
int VonMises_Tridimensional(generic_data *d)
{
    const double shear = d->s1.property[0] / (2.0 * (1.0 + d->s1.property[1]));
    const double bulk = d->s1.property[0] / (3.0 * (1.0 - 2.0 * d->s1.property[1]));
    const double limit = d->s1.property[2];
    double deviator[6];
    double norm2 = 0.0;
    double *elastic = d->s1.variable;
    if (!is_step(d) || d->s1.outer[0] != 293.15) {
        return -1;
    }
    for (int k = 0; k < 6; ++k) {
        elastic[k] = d->s0.variable[k] + d->s1.strain[k] - d->s0.strain[k];
    }
    const double volume = elastic[0] + elastic[1] + elastic[2];
    for (int k = 0; k < 6; ++k) {
        deviator[k] = 2.0 * shear * (elastic[k] - (k < 3 ? volume / 3.0 : 0.0));
        norm2 += deviator[k] * deviator[k];
    }
    const double equivalent = sqrt(1.5 * norm2);
    const double slip = equivalent > limit ? (equivalent - limit) / (3.0 * shear) : 0.0;
    for (int k = 0; k < 6; ++k) {
        const double flow = slip > 0.0 ? 1.5 * deviator[k] / equivalent : 0.0;
        elastic[k] -= slip * flow;
        d->s1.stress[k] = deviator[k] - 2.0 * shear * slip * flow + (k < 3 ? bulk * volume : 0.0);
    }
    d->s1.variable[6] = d->s0.variable[6] + slip;
    if (d->K[0] > 50.0) {
        *d->sound = sqrt(bulk / *d->s0.density);
    }
    return 1;
}

/* As above, but no strain increment above 1e-3 is taken. */
int Impatient_Tridimensional(generic_data *d)
{
    if (fabs(d->s1.strain[0] - d->s0.strain[0]) > 1.0e-3) {
        *d->rdt = 0.25;
        return -1;
    }
    return VonMises_Tridimensional(d);
}

/* As above, but behind its variables. */
int Overflow_Tridimensional(generic_data *d)
{
    d->s1.variable[7] = 1.0;
    return VonMises_Tridimensional(d);
}
