/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_SCHEMA_H
#define MOR_CORE_BASE_SCHEMA_H

/** @file
 *  One record type for everything a user may set and everything a material declares: case keys, material parameters,
 *  material state variables. The program reads, checks and converts; the owner of the schema gets plain numbers in
 *  SI. */

typedef enum mor_schema_kind {
    MOR_SCHEMA_REAL,    /* one number with a unit */
    MOR_SCHEMA_INTEGER, /* one whole number */
    MOR_SCHEMA_BOOLEAN, /* true or false */
    MOR_SCHEMA_TEXT,    /* free text */
    MOR_SCHEMA_CHOICE,  /* one of the words in choices */
    MOR_SCHEMA_VECTOR   /* n_components numbers with one unit */
} mor_schema_kind;

/** What a parameter of a material means, whatever its key: how others find it. Units: mor_role_unit. */
typedef enum mor_role {
    MOR_ROLE_NONE,           /* of no interest to others */
    MOR_ROLE_YOUNGS_MODULUS, /* E, Pa */
    MOR_ROLE_POISSONS_RATIO, /* nu, 1 */
    MOR_ROLE_SHEAR_MODULUS,  /* G, Pa */
    MOR_ROLE_BULK_MODULUS,   /* K, Pa */
    MOR_ROLE_FRICTION_ANGLE, /* phi, rad */
    MOR_ROLE_COHESION,       /* c of Mohr and Coulomb; the undrained strength where phi is zero; Pa */
    MOR_ROLE_DILATION_ANGLE, /* psi, rad */
    MOR_ROLE_TENSION_RATIO,  /* largest mean tension as a part of that at the apex, 1 */
    /* How the rates of a law are integrated: core/material/kit/integration.h. */
    MOR_ROLE_INTEGRATION_METHOD, /* a choice, 1 */
    MOR_ROLE_RELATIVE_TOLERANCE, /* 1 */
    MOR_ROLE_ABSOLUTE_TOLERANCE, /* of the stress, Pa */
    MOR_ROLE_SUB_STEPS_MAX,      /* a whole number, 1 */
    MOR_ROLE_GAS_DENSITY_RATIO,  /* density below which soil has no stress, over its first one; 0: none; 1 */
    MOR_ROLE_FIELD_TIME_SCALE,   /* of the field of a nonlocal law, s: soils that share the field share it */
    /* Strength once softening is complete. */
    MOR_ROLE_RESIDUAL_FRICTION_ANGLE, /* 0: the friction angle stays; rad */
    MOR_ROLE_RESIDUAL_COHESION,       /* Pa */
    MOR_ROLE_RESIDUAL_DILATION_ANGLE, /* rad */
    MOR_ROLE_COUNT
} mor_role;

/** One entry. A table of entries ends with key == NULL. All strings are static. */
typedef struct mor_schema {
    const char *key;      /* as written in the case file */
    mor_schema_kind kind; /* type of the value */
    int n_components;     /* of a vector or a state variable; 1 otherwise */
    const char *unit;     /* SI unit the owner wants, "1" for dimensionless */
    int is_required;      /* non-zero: there is no default */
    double default_value; /* in unit; used when not required and not written (every component of a vector) */
    double minimum;       /* smallest allowed value in unit, -INFINITY for none */
    double maximum;       /* largest allowed value in unit, INFINITY for none */
    int excludes_minimum; /* non-zero: value must be > minimum */
    int excludes_maximum; /* non-zero: value must be < maximum */
    mor_role role;        /* of a parameter of a material; at most one parameter has each */
    const char *choices;  /* for a choice: words separated by '|'; the first is the default */
    const char *text;     /* one line for people */
} mor_schema;

#endif
