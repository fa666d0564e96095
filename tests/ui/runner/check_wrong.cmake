# SPDX-License-Identifier: MIT
# Runs the golden runner on cases that are wrong on purpose; the runner must report each of them.
execute_process(COMMAND ${EMULATOR} "${RUNNER}" --root "${ROOT}" OUTPUT_VARIABLE printed RESULT_VARIABLE status)
if(status EQUAL 0)
  message(FATAL_ERROR "the runner found nothing:\n${printed}")
endif()
foreach(expected
    "not_annotated.lsys: not annotated: line 3 error"
    "annotation_not_met.lsys: annotation of line 3 is not met: error: nothing of the kind .look-alike."
    "wrong_status.lsys: `lsc check` ended with status 0, not 1"
    "wrong_output.lsys: differs from wrong_output.stdout"
    "stray.stdout: no case owns this file"
    "no_run_line.lsys: the first lines hold no"
    "not_annotated.lsys: differs from not_annotated.stderr")
  if(NOT printed MATCHES "${expected}")
    message(FATAL_ERROR "the runner does not say \"${expected}\":\n${printed}")
  endif()
endforeach()
