# SPDX-License-Identifier: GPL-3.0-or-later
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
run(${CMAKE_COMMAND} --install "${BUILD_FOLDER}" --prefix "${SCRATCH}/prefix")
# The simulation is not for users of the library.
if(NOT EXISTS "${SCRATCH}/prefix/include/lvcalib/base/rigid3.h" OR
   EXISTS "${SCRATCH}/prefix/include/lvcalib/simulation")
  message(FATAL_ERROR "the installed headers are not those of the core without its simulation")
endif()
run(${CMAKE_COMMAND} -S "${CONSUMER_SOURCE}" -B "${SCRATCH}/build" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${SCRATCH}/prefix" "-DCMAKE_CXX_COMPILER=${COMPILER}"
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
run(${CMAKE_COMMAND} --build "${SCRATCH}/build")
run("${SCRATCH}/build/consumer")
