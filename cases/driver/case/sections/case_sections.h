/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_SECTIONS_CASE_SECTIONS_H
#define MOR_CASES_DRIVER_CASE_SECTIONS_CASE_SECTIONS_H

#include "cases/driver/case/reader/case_reader.h"

/** @file
 *  The sections of a case file; used by the files of this folder only. Every error names the place in the file, what
 *  was found, what is allowed and what to do, and is MOR_ERROR_CONFIG. */

/** Where the group material of a soil or a body goes. */
typedef struct mor_case_material_slot {
    const mor_case_group *group;   /* its keys are model and density */
    void *record;                  /* of the struct that the group's offsets refer to */
    mor_material_form form;        /* of the models allowed */
    const char *const *bare_words; /* models that have no parameters and no code; ends with NULL; NULL: none */
    const double *density;         /* one number, member of the record, unit kg/m3 */
    double *parameters;       /* shape [MOR_CASE_PARAMETERS_MAX], member of the record; units of the model's schema */
    uint64_t *written;        /* one number, member of the record: which parameters were given */
    const mor_material **law; /* one pointer, member of the record: the model; NULL: not kept */
    mor_case_external *external;       /* member of the record: law of another program; NULL: none are allowed */
    const mor_case_group *outer_group; /* its keys; NULL: likewise */
    const char *what;                  /* zero-terminated; for messages: "material model of a soil" */
} mor_case_material_slot;

/** Reads the group material and lets the model check it.
 *  @param owner  [in]  the soil or body
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_PLUGIN for a model of too many parameters; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_material(const mor_case_reader *reader, const mor_case_node *owner,
                                    const mor_case_material_slot *slot);

/** Reads what an interface is told and lets it make the law.
 *  @param interface [in]      of the model's name
 *  @param node      [in]      the group material, of known names
 *  @param external  [in,out]  file and law are read; completed; owned by the case
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_external(const mor_case_reader *reader, const mor_external_interface *interface,
                                    const mor_case_node *node, mor_case_external *external);

/** Gives the case a registry of its own, loads its plug-ins into it, and reads with that one from here on.
 *  @param root     [in]      the whole file
 *  @param the_case [in,out]  gets the registry and the list of plug-ins
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_plugins(mor_case_reader *reader, const mor_case_node *root, mor_case *the_case);

/** Refuses Coulomb friction without friction_coefficient, and that key with any other friction.
 *  @param node     [in]  a wall or a body
 *  @param friction [in]  what it was read to be
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_friction(const mor_case_reader *reader, const mor_case_node *node,
                                    mor_case_friction friction);

/** Reads the list friction_with of a wall, a body or a group of rocks.
 *  @param owner     [in]      its group
 *  @param the_case  [in]      soils are known
 *  @param frictions [in,out]  zeroed before
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_frictions(const mor_case_reader *reader, const mor_case_node *owner,
                                     const mor_case *the_case, mor_case_frictions *frictions);

/** Reads a list of formulas of a place and checks that each can be parsed.
 *  @param owner    [in]   the group that has the list
 *  @param name     [in]   zero-terminated; of the list, which exists
 *  @param what     [in]   zero-terminated; what the formulas are, for messages
 *  @param n        [in]   number of formulas that are allowed
 *  @param formulas [out]  shape [n, MOR_CASE_TEXT_BYTES]; zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_formulas(const mor_case_reader *reader, const mor_case_node *owner, const char *name,
                                    const char *what, int n, char (*formulas)[MOR_CASE_TEXT_BYTES]);

/** Reads the list fields of a soil: parameters that vary in space.
 *  @param owner [in]      the soil
 *  @param soil  [in,out]  its law and parameters are read; zeroed fields
 *  Returns: MOR_OK, also when there is none; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_fields(const mor_case_reader *reader, const mor_case_node *owner, mor_case_soil *soil);

/** Reads the run that a case starts from, and compares both.
 *  @param the_case [in,out]  its soils and settings are read
 *  Returns: MOR_OK, also when there is none; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_stage(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case);

/** Reads the group path of a wall or a body.
 *  @param owner [in]      its group
 *  @param path  [in,out]  zeroed before; owned by the case, also after a failure
 *  Returns: MOR_OK, also when there is none; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_path(const mor_case_reader *reader, const mor_case_node *owner, mor_case_path *path);

/** Reads the lists soil, walls and bodies, and the group contact.
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_scene(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case);

/** Reads the list bodies and the group contact.
 *  @param the_case [in,out]  walls are known
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_bodies(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case);

/** Reads one item of the list bodies, but for its height over the ground.
 *  @param body   [out]  zeroed before; counted as one of the case's, which frees it
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_body(const mor_case_reader *reader, const mor_case_node *node, mor_case_body *body);

/** Refuses the name of a body that a wall or a body before it has.
 *  @param node     [in]  the body's group
 *  @param body     [in]  of the case's bodies
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_body_name(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                                     const mor_case_body *body);

/** Reads the model, the density and the parameters of a body, and checks what depends on them.
 *  @param node   [in]      the body's group
 *  @param body   [in,out]  its own keys are read
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_body_material(const mor_case_reader *reader, const mor_case_node *node, mor_case_body *body);

/** Reads the list rocks, packs them, and adds them to the bodies of the case.
 *  @param the_case [in,out]  walls and the list bodies are known
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_rocks(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case);

/** Refuses settings that contradict one another, and warns of those that have no effect together.
 *  @param the_case [in]  read whole, but for probes and expectations
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_check(const mor_case_reader *reader, const mor_case_node *root, const mor_case *the_case);

/** Refuses a domain that repeats itself where the scene cannot.
 *  @param the_case [in]  read whole
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_periodic(const mor_case_reader *reader, const mor_case_node *root, const mor_case *the_case);

/** Refuses a probe that would measure where faces have put soil, not where it has come; docs/theory/periodic.md.
 *  @param the_case [in]  whose domain is periodic; the gravity is known
 *  Returns: MOR_OK; MOR_ERROR_CONFIG, with the place of the probe. */
mor_status mor_case_reader_periodic_probe(mor_context *context, const mor_case *the_case, const mor_case_probe *probe);

/** Refuses the name of a wall, soil, gauge or body that the case does not have.
 *  @param node     [in]  the group that holds the key
 *  @param the_case [in]  walls, soils, bodies and gauges are known
 *  @param key      [in]  zero-terminated: "wall", "soil", "gauge" or "body"
 *  @param name     [in]  zero-terminated; of no meaning where the key was not written
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_known(const mor_case_reader *reader, const mor_case_node *node, const mor_case *the_case,
                                 const char *key, const char *name);

/** Reads the shape `region` of a probe or a gauge, where there is one.
 *  @param node    [in]      its group
 *  @param outline [in,out]  zeroed before; owned by the case
 *  @param region  [in,out]  NULL before; owned by the case
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_region(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline,
                                  mor_shape **region);

/** Brings a direction to length 1, leaving one that has it as it is, so that reading it again changes no bit.
 *  @param direction [in,out]  shape [3], any length but zero, unit 1 */
void mor_case_reader_unit_vector(double *direction);

/** Reads the list gauges.
 *  @param the_case [in,out]  walls and bodies are known
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_MEMORY. */
mor_status mor_case_reader_gauges(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case);

/** Reads the lists gauges, probes and expect.
 *  @param the_case [in,out]  walls and bodies are known
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_results(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case);

/** Reads the group maps.
 *  @param the_case [in,out]  walls are known
 *  Returns: MOR_OK; MOR_ERROR_CONFIG. */
mor_status mor_case_reader_maps(const mor_case_reader *reader, const mor_case_node *root, mor_case *the_case);

#endif
