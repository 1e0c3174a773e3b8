/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PROBE_PROBE_ROW_INTERNAL_H
#define MOR_CASES_DRIVER_PROBE_PROBE_ROW_INTERNAL_H

#include "cases/driver/probe/probe_measure.h"

/** @file
 *  Short names for the rows of the tables of probes. A row begins with what a case may say: name, unit, unit in plane
 *  strain, keys allowed, keys required, traits, default percentile, text. */

#define WALL MOR_CASE_PROBE_WALL
#define PERCENTILE MOR_CASE_PROBE_PERCENTILE
#define THICKNESS MOR_CASE_PROBE_THICKNESS
#define ORIGIN MOR_CASE_PROBE_ORIGIN
#define DIRECTION MOR_CASE_PROBE_DIRECTION
#define ALONG (ORIGIN | DIRECTION | MOR_CASE_PROBE_RADIAL)
#define SOIL MOR_CASE_PROBE_SOIL
#define GAUGE MOR_CASE_PROBE_GAUGE
#define REGION MOR_CASE_PROBE_REGION
#define PATH MOR_CASE_PROBE_PATH
#define SPEED MOR_CASE_PROBE_SPEED
#define STRAIN MOR_CASE_PROBE_STRAIN
#define FRICTION MOR_CASE_PROBE_FRICTION
#define FRONT (SOIL | ALONG | MOR_CASE_PROBE_MEASURE | PERCENTILE | THICKNESS)

#define BODY MOR_CASE_PROBE_BODY
#define OF_SOIL MOR_CASE_PROBE_OF_SOIL
#define OF_BODIES MOR_CASE_PROBE_OF_BODIES
#define OF_BOTH (OF_SOIL | OF_BODIES)
#define OF_ROTATION MOR_CASE_PROBE_OF_ROTATION
#define AUDIT MOR_CASE_PROBE_OF_AUDIT
#define PAST MOR_CASE_PROBE_OF_PAST
#define PLANE MOR_CASE_PROBE_OF_PLANE
#define POINT MOR_CASE_PROBE_OF_POINT
#define DATUM MOR_CASE_PROBE_OF_DATUM
#define STEP MOR_CASE_PROBE_OF_STEP
#define FORCE (STEP | MOR_CASE_PROBE_OF_FORCE)
#define CONTACT MOR_CASE_PROBE_OF_CONTACT

#endif
