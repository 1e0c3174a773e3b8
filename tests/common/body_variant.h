/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_BODY_VARIANT_H
#define MOR_TESTS_COMMON_BODY_VARIANT_H

#include "tests/common/scene_variant.h"

/** @file
 *  Soil that runs into rocks, in plane strain and in space: elastic rocks of two materials and rigid ones, lying on
 *  one another, on the floor and in the soil, some thrown, one on a spring, one moved as prescribed. For laws that must
 *  hold with everything that rocks bring with them. */

static const char body_plane[] =
    "title = 'plane'; dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '-9.81 m/s2', '0 m/s2'); end = '60 ms';"
    "domain = { min = ('-0.3 m', '-0.1 m', '-1 m'); max = ('0.7 m', '0.5 m', '1 m'); };"
    "lattice = { jitter = 0.1; };"
    "soil = ( { name = 'sand'; velocity = ('0.6 m/s', '-0.2 m/s', '0 m/s');"
    "  shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.16 m', '0.1 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '25 deg'; cohesion = '0.5 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; },"
    "  { name = 'back'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (1, 0, 0); }; } );"
    "bodies = ( { name = 'buried'; shape = { type = 'sphere'; center = ('0 m', '0 m', '0 m'); radius = '25 mm'; };"
    "    position = ('0.07 m', '0.05 m', '0 m'); friction = 'coulomb'; friction_coefficient = 0.3;"
    "    material = { model = 'neo_hookean'; density = '2500 kg/m3'; youngs_modulus = '20 MPa'; poissons_ratio = 0.25; "
    "}; },"
    "  { name = 'lower'; shape = { type = 'box'; min = ('-30 mm', '-20 mm'); max = ('30 mm', '20 mm'); };"
    "    position = ('0.2 m', '0.02 m', '0 m');"
    "    material = { model = 'saint_venant_kirchhoff'; density = '2400 kg/m3'; youngs_modulus = '30 MPa';"
    "      poissons_ratio = 0.2; }; },"
    "  { name = 'upper'; shape = { type = 'box'; min = ('-20 mm', '-20 mm'); max = ('20 mm', '20 mm'); };"
    "    position = ('0.205 m', '0.062 m', '0 m'); angle = '2 deg'; velocity = ('0.2 m/s', '-0.4 m/s', '0 m/s');"
    "    friction = 'smooth'; contact_modulus = '20 MPa'; material = { model = 'rigid'; density = '2600 kg/m3'; }; },"
    "  { name = 'hung'; shape = { type = 'sphere'; center = ('0 m', '0 m', '0 m'); radius = '22 mm'; };"
    "    position = ('0.08 m', '0.13 m', '0 m'); contact_modulus = '20 MPa'; material = { model = 'rigid'; density = "
    "'2600 kg/m3'; };"
    "    spring = { point = ('0 m', '10 mm', '0 m'); anchor = ('0.08 m', '0.3 m', '0 m'); stiffness = '2 kN/m2';"
    "      damping = '5 N s/m2'; }; },"
    "  { name = 'plow'; shape = { type = 'box'; min = ('-20 mm', '-20 mm'); max = ('20 mm', '20 mm'); };"
    "    position = ('0.29 m', '0.03 m', '0 m'); velocity = ('-0.3 m/s', '0 m/s', '0 m/s'); motion = 'prescribed';"
    "    contact_modulus = '20 MPa'; material = { model = 'rigid'; density = '2600 kg/m3'; }; } );"
    "contact = { friction_coefficient = 0.4; restitution = 0.5; };"
    "numerics = { scheme = 'zhang2024';"
    "  narrow_gaps = 'allow'; density_reinitialization = 9; sort_interval = 13; lattice_normalization = "
    "false;"
    "  wall_stress = 'uniform'; };";

static const char body_space[] =
    "title = 'space'; dimension = 3; spacing = '12 mm'; gravity = ('1 m/s2', '-2 m/s2', '-9.81 m/s2'); end = '60 ms';"
    "domain = { min = ('-0.1 m', '-0.15 m', '-0.05 m'); max = ('0.3 m', '0.15 m', '0.3 m'); };"
    "lattice = { jitter = 0.1; };"
    "soil = ( { name = 'sand'; velocity = ('0.5 m/s', '0.2 m/s', '-0.3 m/s');"
    "  shape = { type = 'box'; min = ('0 m', '-0.05 m', '0 m'); max = ('0.1 m', '0.05 m', '0.07 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '25 deg'; cohesion = '0.5 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 0, 1); }; },"
    "  { name = 'back'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (1, 0, 0); }; } );"
    "bodies = ( { name = 'ball'; shape = { type = 'sphere'; center = ('0 m', '0 m', '0 m'); radius = '30 mm'; };"
    "    position = ('0.05 m', '0 m', '0.1 m'); velocity = ('0 m/s', '0 m/s', '-1 m/s');"
    "    angular_velocity = ('0 rad/s', '5 rad/s', '2 rad/s'); friction = 'coulomb'; friction_coefficient = 0.3;"
    "    material = { model = 'neo_hookean'; density = '2500 kg/m3'; youngs_modulus = '20 MPa'; poissons_ratio = 0.25; "
    "}; },"
    "  { name = 'block'; shape = { type = 'box'; min = ('-25 mm', '-25 mm', '-25 mm'); max = ('25 mm', '25 mm', '25 "
    "mm'); };"
    "    position = ('0.13 m', '0.01 m', '0.026 m'); axis = (0, 0, 1); angle = '20 deg';"
    "    velocity = ('-0.2 m/s', '0 m/s', '-0.1 m/s'); contact_modulus = '20 MPa'; material = { model = 'rigid'; "
    "density = '2600 kg/m3'; }; },"
    "  { name = 'top'; shape = { type = 'box'; min = ('-25 mm', '-25 mm', '-25 mm'); max = ('25 mm', '25 mm', '25 "
    "mm'); };"
    "    position = ('0.135 m', '0.02 m', '0.077 m'); velocity = ('0 m/s', '0.1 m/s', '-0.2 m/s');"
    "    material = { model = 'saint_venant_kirchhoff'; density = '2400 kg/m3'; youngs_modulus = '30 MPa';"
    "      poissons_ratio = 0.2; }; } );"
    "contact = { friction_coefficient = 0.4; restitution = 0.5; };"
    "numerics = { scheme = 'zhang2024';"
    "  density_reinitialization = 9; sort_interval = 13; lattice_normalization = false;"
    "  wall_stress = 'uniform'; };";

enum { BODY_VARIANTS = 16 };

static const scene_variant body_variants[BODY_VARIANTS] = {
    {"as it comes", {NULL}},
    {"single rate", {"numerics.single_rate=true", NULL}},
    {"no hourglass control", {"numerics.hourglass=0", NULL}},
    {"no viscous damping", {"numerics.body_damping=0", NULL}},
    {"uniform body stress", {"numerics.body_stress=uniform", NULL}},
    {"body stress along", {"numerics.body_stress=along", NULL}},
    {"barrier", {"numerics.barrier_stiffness=20", NULL}},
    {"barrier that limits the step", {"numerics.barrier_stiffness=1e6", NULL}},
    {"angular momentum", {"numerics.angular_momentum=true", NULL}},
    {"reconstruction and limited diffusion",
     {"numerics.reconstruction=linear", "numerics.stress_diffusion_limiter=motion", NULL}},
    {"rough contact", {"contact.friction_coefficient=5", "contact.restitution=1", NULL}},
    {"damping and ramp", {"numerics.damping=20 1/s", "numerics.gravity_ramp=10 ms", NULL}},
    {"settled stress",
     {"soil[0].initial_stress.type=settled", "soil[0].initial_stress.settle_speed_ratio=1",
      "soil[0].velocity=(0, 0, 0)", NULL}},
    {"scheme moraine", {"numerics.scheme=moraine", NULL}},
    {"moraine with diffusion in every other step", {"numerics.scheme=moraine", "numerics.courant=0.5", NULL}},
    {"moraine on its lattice", {"numerics.scheme=moraine", "numerics.lattice_normalization=true", NULL}},
};

#endif
