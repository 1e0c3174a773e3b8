/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_SCENE_VARIANT_H
#define MOR_TESTS_COMMON_SCENE_VARIANT_H

#include "tests/common/scene.h"

/** @file
 *  A soil between walls, in plane strain and in space, and every setting that changes what a step does, for laws that
 *  must hold with each of them. The soil moves at once in all directions and has an uneven start, so that nothing is
 *  zero by symmetry; sorts and density summations come often. */

static const char scene_plane[] =
    "title = 'plane'; dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '-9.81 m/s2', '0 m/s2'); end = '0.4 s';"
    "domain = { min = ('-0.05 m', '-0.05 m', '-1 m'); max = ('0.3 m', '0.2 m', '1 m'); };"
    "lattice = { jitter = 0.2; };"
    "soil = ( { name = 'sand'; velocity = ('0.5 m/s', '-0.3 m/s', '0 m/s');"
    "  shape = { type = 'polygon'; points = ( ('0 m', '0 m'), ('0.18 m', '0 m'), ('0.14 m', '0.16 m'),"
    "    ('0 m', '0.12 m') ); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '25 deg'; dilation_angle = '3 deg'; cohesion = '0.5 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; },"
    "  { name = 'back'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (1, 0, 0); }; } );"
    "numerics = { scheme = 'zhang2024';"
    "  density_reinitialization = 9; sort_interval = 13; lattice_normalization = false;"
    "  wall_stress = 'uniform'; };";

static const char scene_space[] =
    "title = 'space'; dimension = 3; spacing = '12 mm'; gravity = ('1 m/s2', '-2 m/s2', '-9.81 m/s2'); end = '0.4 s';"
    "domain = { min = ('-0.05 m', '-0.1 m', '-0.05 m'); max = ('0.16 m', '0.12 m', '0.15 m'); };"
    "lattice = { jitter = 0.2; };"
    "soil = ( { name = 'sand'; velocity = ('0.5 m/s', '0.2 m/s', '-0.3 m/s');"
    "  shape = { type = 'cylinder'; base = ('0.05 m', '0.01 m', '0 m'); axis = (0, 0, 1); radius = '0.05 m';"
    "    height = '0.09 m'; };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '25 deg'; dilation_angle = '3 deg'; cohesion = '0.5 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 0, 1); }; },"
    "  { name = 'back'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (1, 0, 0); }; } );"
    "numerics = { scheme = 'zhang2024';"
    "  density_reinitialization = 9; sort_interval = 13; lattice_normalization = false;"
    "  wall_stress = 'uniform'; };";

enum { SCENE_VARIANT_SETTINGS = 4, SCENE_VARIANTS = 34 };

/** One way to run the scenes. */
typedef struct scene_variant {
    const char *name;                                 /* zero-terminated */
    const char *settings[SCENE_VARIANT_SETTINGS + 1]; /* "key=value", ends with NULL */
} scene_variant;

static const scene_variant scene_variants[SCENE_VARIANTS] = {
    {"as it comes", {NULL}},
    {"artificial stress", {"numerics.artificial_stress=true", NULL}},
    {"gradient correction", {"numerics.gradient_correction=true", NULL}},
    {"xsph", {"numerics.xsph=0.3", NULL}},
    {"shifting", {"numerics.shifting=true", NULL}},
    {"xsph and shifting", {"numerics.xsph=0.3", "numerics.shifting=true", NULL}},
    {"no density summation", {"numerics.density_reinitialization=0", NULL}},
    {"no stress diffusion", {"numerics.stress_diffusion=0", NULL}},
    {"linear reconstruction", {"numerics.reconstruction=linear", NULL}},
    {"diffusion limited by motion", {"numerics.stress_diffusion_limiter=motion", NULL}},
    {"reconstruction of corrected gradients",
     {"numerics.reconstruction=linear", "numerics.stress_diffusion_limiter=motion", "numerics.dissipation=both",
      "numerics.gradient_correction=true", NULL}},
    {"lattice normalization", {"numerics.lattice_normalization=true", NULL}},
    {"wall stress along", {"numerics.wall_stress=along", NULL}},
    {"wall stress linear", {"numerics.wall_stress=linear", NULL}},
    {"density pressure term", {"numerics.density_pressure_term=true", NULL}},
    {"dissipation on approach", {"numerics.dissipation=approach", "numerics.wall_dissipation=approach", NULL}},
    {"dissipation on both", {"numerics.dissipation=both", "numerics.wall_dissipation=both", NULL}},
    {"damping", {"numerics.damping=20 1/s", NULL}},
    {"gravity ramp", {"numerics.gravity_ramp=50 ms", NULL}},
    {"wide kernel", {"numerics.smoothing_ratio=1.7", NULL}},
    {"geostatic stress", {"soil[0].initial_stress.type=k0", NULL}},
    {"settled stress",
     {"soil[0].initial_stress.type=settled", "soil[0].initial_stress.settle_speed_ratio=1",
      "soil[0].velocity=(0, 0, 0)", NULL}},
    {"coulomb walls",
     {"walls[0].friction=coulomb", "walls[0].friction_coefficient=0.2", "walls[1].friction=coulomb",
      "walls[1].friction_coefficient=0.4", NULL}},
    {"smooth walls", {"walls[0].friction=smooth", "walls[1].friction=smooth", NULL}},
    {"moving wall", {"walls[1].velocity=('0.4 m/s', '0.1 m/s', 0)", NULL}},
    {"moving coulomb wall",
     {"walls[1].velocity=('0.4 m/s', '0.1 m/s', 0)", "walls[1].friction=coulomb", "walls[1].friction_coefficient=0.3",
      NULL}},
    {"no friction", {"soil[0].material.friction_angle=0", "soil[0].material.dilation_angle=0", NULL}},
    {"no cohesion", {"soil[0].material.cohesion=0", NULL}},
    {"scheme moraine", {"numerics.scheme=moraine", NULL}},
    {"moraine with diffusion in every other step", {"numerics.scheme=moraine", "numerics.courant=0.5", NULL}},
    {"moraine on its lattice", {"numerics.scheme=moraine", "numerics.lattice_normalization=true", NULL}},
    {"moraine by present moments", {"numerics.scheme=moraine", "numerics.angular_momentum_by=present", NULL}},
    {"moraine with coulomb walls",
     {"numerics.scheme=moraine", "walls[0].friction=coulomb", "walls[0].friction_coefficient=0.2",
      "walls[1].friction=smooth", NULL}},
    {"moraine settled",
     {"numerics.scheme=moraine", "soil[0].initial_stress.type=settled", "soil[0].initial_stress.settle_force_ratio=1",
      "soil[0].velocity=(0, 0, 0)", NULL}},
};

#endif
