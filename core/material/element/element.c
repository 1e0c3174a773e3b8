/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/element/element.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/material/element/newton.h"
#include "core/material/guarded.h"

#include <math.h>
#include <string.h>

enum { POINTS_MAX = MOR_NEWTON_MAX + 1, HALVINGS = 24, ITERATIONS = 40, TEXT_BYTES = 512 };

/* Stresses below this part of the stiffness count as none where an error is called small. */
static const double SMALLEST_STRESS = 1e-6;

/* Steps of the differences, in parts of the strain increment: large against the rounding of the stress, and small where
 * the stress is a smooth function of the strain; Newton's method mends the rest. */
static const double DIFFERENCE = 1e-3;

/* Where an increment counts that drives nothing by itself, 1. */
static const double SMALLEST_INCREMENT = 1e-9;

struct mor_element_driver {
    const mor_material_instance *instance;
    mor_guard guard;  /* of updates; NULL: none */
    double tolerance; /* 1 */
    mor_newton *newton;
    mor_element_control control;
    int unknowns[6]; /* shape [n_unknowns]; components under stress control */
    int n_unknowns;
    double start_time;       /* of the control, s */
    double start_values[6];  /* shape [6]; of the conditions, Pa */
    double guess[6];         /* shape [6]; strain rate found last, 1/s */
    double step;             /* length that was accepted last, s */
    double stiffness;        /* density times squared wave speed, Pa */
    const mor_element *from; /* the update under way: its start */
    double length;           /* its length, s */
    double time;             /* its end, s */
    double stress_scale;     /* Pa */
    double strain_scale;     /* 1 */
    double densities[POINTS_MAX];
    double gradients[9 * POINTS_MAX];
    double stress_in[6 * POINTS_MAX];
    double stress_out[6 * POINTS_MAX];
    double state_in[MOR_ELEMENT_STATE_MAX * POINTS_MAX];
    double state_out[MOR_ELEMENT_STATE_MAX * POINTS_MAX];
};

void mor_element_control_stress(mor_element_control *control, int component, double rate)
{
    control->is_stress[component] = true;
    control->condition[component][component] = 1.0;
    control->stress_rate[component] = rate;
}

/* ---- Batches ----------------------------------------------------------------------------------------------------- */

/* The state variables of n_points points, variable after variable as a batch wants them. */
static void list_state(const mor_material_instance *instance, double *numbers, int n_points, double **pointers)
{
    for (int k = 0; k < instance->n_state; ++k) {
        pointers[k] = numbers;
        numbers += n_points * instance->material->state[k].n_components;
    }
}

/* Runs an operation on one specimen; NULL stands for a law without it. */
typedef mor_status (*point_operation)(const mor_material_instance *instance, const mor_batch *batch, double *value);

static mor_status measure_point(const mor_material_instance *instance, point_operation operation,
                                const mor_element *element, double *value)
{
    double numbers[MOR_ELEMENT_STATE_MAX];
    double *state[MOR_MATERIAL_STATES_MAX];
    memcpy(numbers, element->state, sizeof numbers);
    list_state(instance, numbers, 1, state);
    const mor_batch batch = {
        .n = 1, .density = &element->density, .stress_in = element->stress, .state_in = (const double *const *)state};
    return operation(instance, &batch, value);
}

/* ---- Making ------------------------------------------------------------------------------------------------------ */

mor_status mor_element_driver_new(mor_context *context, const mor_material_instance *instance, double tolerance,
                                  mor_element_driver **driver)
{
    *driver = NULL;
    MOR_CHECK(context, instance->material->form == MOR_MATERIAL_RATE, MOR_ERROR_ARGUMENT,
              "'%s' gives the stress from the deformation gradient; an element test needs a law that gives it from the "
              "velocity gradient, as all models of soil do",
              instance->material->name);
    MOR_CHECK(context, tolerance > 0.0 && tolerance < 1.0, MOR_ERROR_ARGUMENT,
              "found a tolerance of %g for the stress; allowed: > 0 and < 1", tolerance);
    MOR_TRY(context, MOR_NEW(context, driver, 1, "driver of an element test"));
    (*driver)->instance = instance;
    (*driver)->tolerance = tolerance;
    return MOR_OK;
}

void mor_element_driver_set_guard(mor_element_driver *driver, mor_guard guard)
{
    driver->guard = guard;
}

void mor_element_driver_free(mor_context *context, mor_element_driver **driver)
{
    if (*driver != NULL) {
        mor_newton_free(context, &(*driver)->newton);
        MOR_FREE(context, driver);
    }
}

mor_status mor_element_check(mor_context *context, const mor_element_driver *driver, const mor_element *element)
{
    const mor_material_instance *instance = driver->instance;
    double distance = 0.0;
    double speed = 0.0;
    const mor_status status = measure_point(instance, instance->operations.admissible, element, &distance);
    MOR_CHECK(context, status == MOR_OK, status, "'%s' cannot tell whether it admits the stress of the specimen: %s",
              instance->material->name, mor_status_text(status));
    MOR_TRY(context, measure_point(instance, instance->operations.wave_speed, element, &speed));
    const double *s = element->stress;
    /* Above the rounding of the largest stress, in which distances are computed. */
    const double allowed = 1e-9 * (fabs(s[0]) + fabs(s[1]) + fabs(s[2]) + element->density * speed * speed * 1e-6);
    MOR_CHECK(context, distance <= allowed, MOR_ERROR_ARGUMENT,
              "found a specimen with a stress of (%g, %g, %g, %g, %g, %g) Pa, which lies %g Pa outside of what '%s' "
              "admits; start from a stress inside",
              s[0], s[1], s[2], s[3], s[4], s[5], distance, instance->material->name);
    return MOR_OK;
}

mor_status mor_element_init(mor_context *context, const mor_element_driver *driver, double density,
                            const double *stress, mor_element *element)
{
    const mor_material_instance *instance = driver->instance;
    double *state[MOR_MATERIAL_STATES_MAX];
    *element = (mor_element){.start_density = density, .density = density};
    MOR_CHECK(context, isfinite(density) && density > 0.0, MOR_ERROR_ARGUMENT,
              "found a density of %g kg/m3; allowed: > 0", density);
    for (int k = 0; k < 6; ++k) {
        MOR_CHECK(context, isfinite(stress[k]), MOR_ERROR_ARGUMENT, "found a stress component of %g Pa", stress[k]);
    }
    memcpy(element->stress, stress, sizeof element->stress);
    list_state(instance, element->state, 1, state);
    const mor_batch batch = {.n = 1, .density = &element->density, .stress_in = element->stress, .state_out = state};
    const mor_status status = instance->operations.init_state(instance, &batch);
    MOR_CHECK(context, status == MOR_OK, status, "'%s' cannot start from the stress of the specimen: %s",
              instance->material->name, mor_status_text(status));
    return mor_element_check(context, driver, element);
}

/* ---- Control ----------------------------------------------------------------------------------------------------- */

static double weigh_stress(const double *factors, const double *stress)
{
    double sum = 0.0;
    for (int k = 0; k < 6; ++k) {
        sum += factors[k] * stress[k];
    }
    return sum;
}

static mor_status check_control(mor_context *context, const mor_element_control *control)
{
    for (int k = 0; k < 6; ++k) {
        double largest = control->is_stress[k] ? 0.0 : 1.0;
        for (int a = 0; a < 6; ++a) {
            largest = fmax(largest, fabs(control->condition[k][a]));
        }
        MOR_CHECK(context, isfinite(control->strain_rate[k]) && isfinite(control->stress_rate[k]) && isfinite(largest),
                  MOR_ERROR_ARGUMENT, "found a rate that is not finite for component %d of the control", k);
        MOR_CHECK(context, largest > 0.0, MOR_ERROR_ARGUMENT,
                  "component %d is under stress control without a condition on the stress", k);
    }
    for (int k = 0; k < 3; ++k) {
        MOR_CHECK(context, isfinite(control->spin[k]), MOR_ERROR_ARGUMENT, "found a spin that is not finite");
    }
    return MOR_OK;
}

mor_status mor_element_begin(mor_context *context, mor_element_driver *driver, const mor_element *element,
                             const mor_element_control *control)
{
    double speed = 0.0;
    MOR_TRY(context, check_control(context, control));
    mor_newton_free(context, &driver->newton);
    driver->control = *control;
    driver->n_unknowns = 0;
    driver->start_time = element->time;
    driver->step = INFINITY;
    memset(driver->guess, 0, sizeof driver->guess);
    for (int k = 0; k < 6; ++k) {
        driver->start_values[k] = weigh_stress(control->condition[k], element->stress);
        if (control->is_stress[k]) {
            driver->unknowns[driver->n_unknowns++] = k;
        }
    }
    MOR_TRY(context, measure_point(driver->instance, driver->instance->operations.wave_speed, element, &speed));
    driver->stiffness = element->density * speed * speed;
    const mor_newton_settings settings = {.n = driver->n_unknowns,
                                          .tolerance = driver->tolerance,
                                          .difference = DIFFERENCE,
                                          .n_iterations_max = ITERATIONS};
    return driver->n_unknowns > 0 ? mor_newton_new(context, &settings, &driver->newton) : MOR_OK;
}

/* ---- Updates ----------------------------------------------------------------------------------------------------- */

/* Start of one point of the update under way, deformed by a strain increment, shape [6]. */
static void fill_point(mor_element_driver *driver, int n_points, int point, const double *increment)
{
    const mor_element *from = driver->from;
    const double *spin = driver->control.spin;
    const double per_time = 1.0 / driver->length;
    const double d[6] = {increment[0] * per_time, increment[1] * per_time, increment[2] * per_time,
                         increment[3] * per_time, increment[4] * per_time, increment[5] * per_time};
    const double gradient[9] = {d[0],           d[3] + spin[0], d[5] - spin[2],
                                d[3] - spin[0], d[1],           d[4] + spin[1],
                                d[5] + spin[2], d[4] - spin[1], d[2]};
    memcpy(driver->gradients + 9 * point, gradient, sizeof gradient);
    memcpy(driver->stress_in + 6 * point, from->stress, sizeof from->stress);
    driver->densities[point] = from->density * exp(-(increment[0] + increment[1] + increment[2]));
    const double *state = from->state;
    double *to = driver->state_in;
    for (int k = 0; k < driver->instance->n_state; ++k) {
        const int n = driver->instance->material->state[k].n_components;
        memcpy(to + n * point, state, (size_t)n * sizeof *to);
        state += n;
        to += n * n_points;
    }
}

static mor_status update_points(mor_element_driver *driver, int n_points)
{
    double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    list_state(driver->instance, driver->state_in, n_points, state_in);
    list_state(driver->instance, driver->state_out, n_points, state_out);
    const mor_batch batch = {.n = n_points,
                             .time_step = driver->length,
                             .density = driver->densities,
                             .velocity_gradient = driver->gradients,
                             .stress_in = driver->stress_in,
                             .stress_out = driver->stress_out,
                             .state_in = (const double *const *)state_in,
                             .state_out = state_out};
    return mor_material_advance_guarded(driver->guard, driver->instance, &batch);
}

/* The strain increment of the update: given components, and unknowns in units of strain_scale. */
static void fill_increment(const mor_element_driver *driver, const double *x, double *increment)
{
    for (int k = 0; k < 6; ++k) {
        increment[k] = driver->control.strain_rate[k] * driver->length;
    }
    for (int u = 0; u < driver->n_unknowns; ++u) {
        increment[driver->unknowns[u]] = x[u] * driver->strain_scale;
    }
}

/* How far the conditions on the stress are from holding at the end of the update. */
static mor_status evaluate_conditions(int n_points, const double *x, double *residual, void *user)
{
    mor_element_driver *driver = user;
    const int n = driver->n_unknowns;
    for (int point = 0; point < n_points; ++point) {
        double increment[6];
        fill_increment(driver, x + n * point, increment);
        fill_point(driver, n_points, point, increment);
    }
    const mor_status status = update_points(driver, n_points);
    for (int point = 0; point < n_points && status == MOR_OK; ++point) {
        for (int u = 0; u < n; ++u) {
            const int k = driver->unknowns[u];
            const double wanted =
                driver->start_values[k] + driver->control.stress_rate[k] * (driver->time - driver->start_time);
            const double found = weigh_stress(driver->control.condition[k], driver->stress_out + 6 * point);
            residual[n * point + u] = (found - wanted) / driver->stress_scale;
        }
    }
    return status;
}

/* What is large in the update under way. */
static void find_scales(mor_element_driver *driver)
{
    const mor_element_control *control = &driver->control;
    double stress = SMALLEST_STRESS * driver->stiffness;
    double strain = SMALLEST_INCREMENT;
    for (int k = 0; k < 6; ++k) {
        stress = fmax(stress, fabs(driver->from->stress[k]));
        strain = fmax(strain, fabs(control->is_stress[k] ? control->stress_rate[k] / driver->stiffness
                                                         : control->strain_rate[k]) *
                                  driver->length);
    }
    driver->stress_scale = stress;
    driver->strain_scale = strain;
}

/* One update of a given length; the specimen is untouched unless it is accepted. */
static mor_status try_update(mor_element_driver *driver, double length, mor_element *element)
{
    double x[MOR_NEWTON_MAX] = {0.0};
    double increment[6];
    int64_t n_iterations = 0;
    mor_status status = MOR_OK;
    driver->from = element;
    driver->length = length;
    driver->time = element->time + length;
    find_scales(driver);
    for (int u = 0; u < driver->n_unknowns; ++u) {
        x[u] = driver->guess[driver->unknowns[u]] * length / driver->strain_scale;
    }
    if (driver->n_unknowns > 0) {
        status = mor_newton_solve(driver->newton, evaluate_conditions, driver, x, &n_iterations);
        element->n_iterations += n_iterations;
        fill_increment(driver, x, increment);
    } else {
        fill_increment(driver, x, increment);
        fill_point(driver, 1, 0, increment);
        status = update_points(driver, 1);
    }
    if (status != MOR_OK) {
        return status;
    }
    for (int k = 0; k < 6; ++k) {
        element->strain[k] += increment[k];
        driver->guess[k] = increment[k] / length;
    }
    memcpy(element->stress, driver->stress_out, sizeof element->stress);
    memcpy(element->state, driver->state_out, sizeof element->state);
    element->density = element->start_density * exp(-(element->strain[0] + element->strain[1] + element->strain[2]));
    element->time = driver->time;
    element->n_steps += 1;
    return MOR_OK;
}

static mor_status report_failure(mor_context *context, const mor_element_driver *driver, mor_status status,
                                 const mor_element *element)
{
    const double *s = element->stress;
    const double *e = element->strain;
    const bool is_solved = driver->n_unknowns > 0;
    const char *reason = is_solved ? mor_newton_reason(driver->newton) : "";
    return MOR_FAIL(context, status,
                    "the specimen of '%s' cannot follow its path: %s%s%s%s; strain (xx, yy, zz, xy, yz, zx) = (%.5g, "
                    "%.5g, %.5g, %.5g, %.5g, %.5g), stress = (%.5g, %.5g, %.5g, %.5g, %.5g, %.5g) Pa, step %lld of "
                    "%.3g s%s",
                    driver->instance->material->name, mor_status_text(status), reason[0] != '\0' ? " (" : "", reason,
                    reason[0] != '\0' ? ")" : "", e[0], e[1], e[2], e[3], e[4], e[5], s[0], s[1], s[2], s[3], s[4],
                    s[5], (long long)element->n_steps, driver->length,
                    is_solved ? ". A stress that is asked for may lie beyond the strength" : "");
}

mor_status mor_element_advance(mor_context *context, mor_element_driver *driver, double length, mor_element *element)
{
    const mor_material_instance *instance = driver->instance;
    const double smallest = ldexp(length, -HALVINGS);
    double left = length;
    double step = fmin(driver->step, length);
    while (left > 0.0) {
        double longest = INFINITY;
        MOR_TRY(context, measure_point(instance, instance->operations.max_step, element, &longest));
        step = fmin(step, longest);
        /* No sliver is left over by rounding. */
        const double taken = step >= left * (1.0 - 1e-9) ? left : step;
        const mor_status status = try_update(driver, taken, element);
        if (status == MOR_OK) {
            left -= taken;
            driver->step = taken;
            step = 2.0 * taken;
            continue;
        }
        element->n_rejected += 1;
        if (status < MOR_OK || taken <= smallest) {
            return report_failure(context, driver, status, element);
        }
        step = 0.5 * taken;
    }
    driver->step = fmax(step, driver->step);
    return MOR_OK;
}
