/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* User materials of Abaqus/Standard: subroutine UMAT of a Fortran (or C) library. Arguments, their order and meaning:
 * Abaqus User Subroutines Reference Guide, section UMAT. Three-dimensional elements, NDI = NSHR = 3, NTENS = 6:
 * components 11, 22, 33, 12, 13, 23; shear strains are engineering ones; stress is positive in tension. */
#include "materials/interfaces/interface.h"

#include <string.h>

enum { NORMAL = 3, COMPONENTS = 6, NAME_LETTERS = 80 };

/* Place in the order of core/base/math.h (xx, yy, zz, xy, yz, zx) of a component of theirs. */
static const int PLACE[COMPONENTS] = {0, 1, 2, 3, 5, 4};

/* All arguments by reference; the length of CMNAME, hidden in Fortran, by value behind them. */
typedef void (*umat_function)(double *stress, double *statev, double *ddsdde, double *sse, double *spd, double *scd,
                              double *rpl, double *ddsddt, double *drplde, double *drpldt, const double *stran,
                              const double *dstran, const double *time, const double *dtime, const double *temp,
                              const double *dtemp, const double *predef, const double *dpred, const char *cmname,
                              const int *ndi, const int *nshr, const int *ntens, const int *nstatv, const double *props,
                              const int *nprops, const double *coords, const double *drot, double *pnewdt,
                              const double *celent, const double *dfgrd0, const double *dfgrd1, const int *noel,
                              const int *npt, const int *layer, const int *kspt, const int *jstep, const int *kinc,
                              size_t cmname_letters);

/* Everything that is handed out by reference. Bands of not-a-numbers stand between the arrays, which a law may take to
 * be longer. */
typedef struct arguments {
    umat_function function;
    double stress[COMPONENTS + MOR_EXTERNAL_BAND]; /* the band behind the last that there is */
    double ddsdde[COMPONENTS * COMPONENTS + MOR_EXTERNAL_BAND];
    double statev[MOR_EXTERNAL_STATE_VALUES_MAX + MOR_EXTERNAL_BAND];
    double energies[3], behind_energies[MOR_EXTERNAL_NARROW_BAND]; /* SSE, SPD, SCD */
    double rpl, ddsddt[COMPONENTS], drplde[COMPONENTS], drpldt, behind_heat[MOR_EXTERNAL_NARROW_BAND];
    double stran[COMPONENTS], dstran[COMPONENTS], behind_strain[MOR_EXTERNAL_NARROW_BAND];
    double time[2], dtime, temp, dtemp, predef[1], dpred[1], behind_time[MOR_EXTERNAL_NARROW_BAND];
    double props[MOR_EXTERNAL_CONSTANTS_MAX + MOR_EXTERNAL_BAND];
    double coords[3], drot[9], pnewdt, celent, dfgrd0[9], dfgrd1[9], behind_motion[MOR_EXTERNAL_NARROW_BAND];
    char cmname[NAME_LETTERS];
    int nstatv, nprops;
} arguments;

enum { BANDS = 9, WIDE_BANDS = 4 };

/* The wide ones first. */
static void list_bands(const mor_interface_law *law, arguments *a, double **bands)
{
    double *const all[BANDS] = {a->statev + law->n_state_values,
                                a->stress + COMPONENTS,
                                a->ddsdde + COMPONENTS * COMPONENTS,
                                a->props + law->n_constants,
                                a->behind_energies,
                                a->behind_heat,
                                a->behind_strain,
                                a->behind_time,
                                a->behind_motion};
    memcpy(bands, all, sizeof all);
}

static void call_umat(void *job)
{
    static const int ndi = NORMAL;
    static const int nshr = COMPONENTS - NORMAL;
    static const int ntens = COMPONENTS;
    static const int one = 1;
    /* Step 1, procedure 1 (static), finite strain, no perturbation. */
    static const int jstep[4] = {1, 1, 1, 0};
    arguments *a = job;
    a->function(a->stress, a->statev, a->ddsdde, &a->energies[0], &a->energies[1], &a->energies[2], &a->rpl, a->ddsddt,
                a->drplde, &a->drpldt, a->stran, a->dstran, a->time, &a->dtime, &a->temp, &a->dtemp, a->predef,
                a->dpred, a->cmname, &ndi, &nshr, &ntens, &a->nstatv, a->props, &a->nprops, a->coords, a->drot,
                &a->pnewdt, &a->celent, a->dfgrd0, a->dfgrd1, &one, &one, &one, &one, jstep, &one, NAME_LETTERS);
}

/* Fortran stores columns one after the other. */
static void transpose(const double *matrix, double *to)
{
    for (int k = 0; k < 9; ++k) {
        to[3 * (k % 3) + k / 3] = matrix[k];
    }
}

/* What is not set below; the long arrays are read as far as they are filled. */
static void clear_outputs(arguments *a)
{
    memset(a->ddsdde, 0, COMPONENTS * COMPONENTS * sizeof *a->ddsdde);
    memset(a->energies, 0, sizeof a->energies);
    memset(a->ddsddt, 0, sizeof a->ddsddt);
    memset(a->drplde, 0, sizeof a->drplde);
    memset(a->coords, 0, sizeof a->coords);
    a->rpl = a->drpldt = a->temp = a->dtemp = a->predef[0] = a->dpred[0] = 0.0;
}

static void load_arguments(const mor_interface_law *law, const mor_external_point *p, arguments *a)
{
    const size_t letters = strlen(law->law);
    double *bands[BANDS];
    clear_outputs(a);
    a->function = (umat_function)law->function;
    list_bands(law, a, bands);
    for (int k = 0; k < BANDS; ++k) {
        mor_external_band_fill(bands[k], k < WIDE_BANDS ? MOR_EXTERNAL_BAND : MOR_EXTERNAL_NARROW_BAND);
    }
    for (int k = 0; k < COMPONENTS; ++k) {
        const double factor = k < NORMAL ? 1.0 : 2.0;
        a->stress[k] = p->stress[PLACE[k]];
        a->stran[k] = factor * p->strain[PLACE[k]];
        a->dstran[k] = factor * p->strain_increment[PLACE[k]];
    }
    memcpy(a->statev, p->state, (size_t)law->n_state_values * sizeof *a->statev);
    for (int k = 0; k < law->n_constants; ++k) {
        a->props[k] = law->constants[k];
    }
    a->nstatv = law->n_state_values;
    a->nprops = law->n_constants;
    a->time[0] = a->time[1] = p->time;
    a->dtime = p->time_step;
    a->celent = p->length;
    a->pnewdt = 1.0;
    transpose(p->rotation, a->drot);
    transpose(p->deformation[0], a->dfgrd0);
    transpose(p->deformation[1], a->dfgrd1);
    memset(a->cmname, ' ', sizeof a->cmname);
    memcpy(a->cmname, law->law, letters);
}

static bool are_bands_whole(const mor_interface_law *law, arguments *a)
{
    double *bands[BANDS];
    bool are_whole = true;
    list_bands(law, a, bands);
    for (int k = 0; k < BANDS; ++k) {
        are_whole = are_whole &&
                    mor_external_band_is_whole(bands[k], k < WIDE_BANDS ? MOR_EXTERNAL_BAND : MOR_EXTERNAL_NARROW_BAND);
    }
    return are_whole;
}

static mor_status update(const mor_interface_law *law, mor_external_point *p)
{
    arguments a;
    load_arguments(law, p, &a);
    if (mor_guard_run(law->guard, call_umat, &a) != 0) {
        return MOR_ERROR_CRASH;
    }
    if (!are_bands_whole(law, &a)) {
        return MOR_ERROR_BOUNDS;
    }
    for (int k = 0; k < COMPONENTS; ++k) {
        p->stress[PLACE[k]] = a.stress[k];
        for (int m = 0; m < COMPONENTS; ++m) {
            p->stiffness[6 * k + m] = a.ddsdde[k + COMPONENTS * m];
        }
    }
    memcpy(p->state, a.statev, (size_t)law->n_state_values * sizeof *p->state);
    return a.pnewdt < 1.0 ? MOR_RETRY_SMALLER_STEP : MOR_OK;
}

static const mor_external_kind kind = {.update = update,
                                       .literature = "Abaqus User Subroutines Reference Guide, UMAT",
                                       .symbol = "umat_",
                                       .usual_law = "UMAT",
                                       .first_step = 1.0};

static mor_status make(mor_context *context, const mor_external_request *request, mor_external_law **law)
{
    return mor_external_make(context, "umat", &kind, request, law);
}

const mor_external_interface mor_interface_umat = {
    .name = "umat",
    .text = "user material of Abaqus/Standard: subroutine UMAT of a shared library",
    .make = make,
    .parameters = mor_external_parameters};
