# SPDX-License-Identifier: MIT
# Makes a wheel of the sources without a network, installs it in a new environment and runs a recipe.
# Usage: cmake -D PYTHON=... -D SOURCE=... -D FOLDER=... -P wheel.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}\n${out}\n${err}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
# A copy, because skbuild builds within the sources.
set(copy "${FOLDER}/source")
file(MAKE_DIRECTORY "${copy}")
foreach(name CMakeLists.txt LICENSE README.md CHANGELOG.md pyproject.toml setup.py cmake grammar compiler runtime docs packaging)
  if(EXISTS "${SOURCE}/${name}")
    file(COPY "${SOURCE}/${name}" DESTINATION "${copy}")
  endif()
endforeach()
set(ENV{CMAKE_BUILD_PARALLEL_LEVEL} 2)
run("${PYTHON}" -m pip wheel "${copy}" --no-build-isolation --no-deps --no-index -w "${FOLDER}")
file(GLOB wheels "${FOLDER}/lsys-*.whl")
list(LENGTH wheels count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "wheels: ${wheels}")
endif()
run("${PYTHON}" -m zipfile -l "${wheels}")
foreach(name lsys/__init__.py lsys/__init__.pyi lsys/py.typed lsys/_lsys.)
  string(FIND "${out}" "${name}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "${wheels} has no ${name}:\n${out}")
  endif()
endforeach()
if(out MATCHES "bin/lsc|dist-packages")
  message(FATAL_ERROR "${wheels} has other files:\n${out}")
endif()

run("${PYTHON}" -m venv --system-site-packages "${FOLDER}/environment")
set(python "${FOLDER}/environment/bin/python")
run("${python}" -m pip install --no-index --no-deps "${wheels}")
file(WRITE "${FOLDER}/tree.lsys" "#n = 4; #w : A(1); #p : A(x) : * : !(x/10) F(x) [ +(30) A(x/2) ] A(x*0.8);\n")
file(WRITE "${FOLDER}/recipe.py" "import lsys
assert 'environment' in lsys.__file__, lsys.__file__
rows = [lsys.compile('tree.lsys', generations=n).grow().measure().height for n in range(1, 5)]
assert rows == sorted(rows) and rows[0] > 0, rows
print(lsys.compile('tree.lsys').grow().save('tree.glb', preset='web'))
")
unset(ENV{PYTHONPATH})
execute_process(COMMAND "${python}" recipe.py WORKING_DIRECTORY "${FOLDER}" RESULT_VARIABLE status
  OUTPUT_VARIABLE out ERROR_VARIABLE err)
if(NOT status EQUAL 0 OR NOT out STREQUAL "['tree.glb']\n" OR NOT EXISTS "${FOLDER}/tree.glb")
  message(FATAL_ERROR "the recipe ends with ${status}:\n${out}\n${err}")
endif()
