/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/builtin.h"

#include "core/base/isa.h"

/* The only place that names all built-in models: each is one file <law>_isa.c and one line here. */
#define LAWS(LAW, isa)                                                                                                 \
    LAW(drucker_prager, isa)                                                                                           \
    LAW(neo_hookean, isa)                                                                                              \
    LAW(saint_venant_kirchhoff, isa)                                                                                   \
    LAW(hypoelastic, isa)                                                                                              \
    LAW(mu_i, isa)                                                                                                     \
    LAW(modified_cam_clay, isa)                                                                                        \
    LAW(bingham, isa)                                                                                                  \
    LAW(herschel_bulkley, isa)                                                                                         \
    LAW(hencky_drucker_prager, isa)                                                                                    \
    LAW(mohr_coulomb, isa)                                                                                             \
    LAW(matsuoka_nakai, isa)                                                                                           \
    LAW(tresca, isa)                                                                                                   \
    LAW(hypoplastic_sand, isa)                                                                                         \
    LAW(nonlocal_fluidity, isa)

#define DECLARE(law, isa) extern const mor_material mor_##law##_##isa;
#define ADDRESS(law, isa) &mor_##law##_##isa,
#define LIST(isa)                                                                                                      \
    LAWS(DECLARE, isa)                                                                                                 \
    static const mor_material *const laws_##isa[] = {LAWS(ADDRESS, isa)};                                              \
    static const mor_plugin_list list_##isa = {                                                                        \
        .abi = MOR_MATERIAL_ABI, .n_materials = sizeof laws_##isa / sizeof *laws_##isa, .materials = laws_##isa};

LIST(baseline)
#if defined(MOR_HAS_ISA_AVX2)
LIST(avx2)
#endif
#if defined(MOR_HAS_ISA_AVX512)
LIST(avx512)
#endif

const mor_plugin_list *mor_materials_builtin(const char *instruction_set)
{
    static const mor_plugin_list *const lists[MOR_ISA_COUNT] = MOR_ISA_VARIANTS(&list);
    const int isa = mor_isa_select(instruction_set);
    return isa < 0 ? NULL : lists[isa];
}
