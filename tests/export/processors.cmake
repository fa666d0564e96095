# SPDX-License-Identifier: MIT
# Compares two sets of files that lsc writes: with the mathematical functions that glibc selects on this processor, and
# with its functions for processors without AVX2 and FMA, whose results differ in the last bits.
# Usage: cmake -D LSC=FILE -D SAMPLES=FOLDER -D OUT=FOLDER -P processors.cmake
file(MAKE_DIRECTORY "${OUT}")
foreach(sample abop-1-24a abop-1-24c crankshaw-2-8-bush)
  set(grammar "${SAMPLES}/${sample}/${sample}.lsys")
  foreach(variant "" "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX")
    set(ENV{GLIBC_TUNABLES} "${variant}")
    execute_process(COMMAND "${LSC}" export "${grammar}" -n 5 -q --gravity 9.81 --wind 5,0,2 -o "${OUT}/a.obj"
      RESULT_VARIABLE status ERROR_VARIABLE error)
    if(NOT status EQUAL 0)
      message(FATAL_ERROR "${grammar}: exit status ${status}: ${error}")
    endif()
    file(SHA256 "${OUT}/a.obj" digest)
    if(variant STREQUAL "")
      set(expected "${digest}")
    elseif(NOT digest STREQUAL expected)
      message(SEND_ERROR "${grammar}: the file depends on the processor")
    endif()
  endforeach()
endforeach()
file(REMOVE_RECURSE "${OUT}")
