# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
#
# Writes OUTPUT, a header with MOR_VERSION and MOR_COMMIT (the commit, "+" when the files differ from it, or "unknown").
cmake_minimum_required(VERSION 3.25)
set(commit unknown)
find_program(git git)
if(git)
  execute_process(COMMAND ${git} -C ${SOURCE} rev-parse HEAD
    OUTPUT_VARIABLE head ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
  if(NOT failed)
    execute_process(COMMAND ${git} -C ${SOURCE} status --porcelain
      OUTPUT_VARIABLE changes ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(changes)
      set(commit ${head}+)
    else()
      set(commit ${head})
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MORAINE_BUILD_H
#define MORAINE_BUILD_H

#define MOR_VERSION \"@VERSION@\"
#define MOR_COMMIT \"@commit@\"

#endif
")
