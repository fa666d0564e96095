# SPDX-License-Identifier: MIT
# Every library, named by its folder, and the folders that the library may include. The build links libraries by
# this table (LsysTargets.cmake), and the test of include rules reads it (tests/layering/check_includes.cmake).
#
# One folder is one library. Headers directly in the folder are public; headers in its sub-folders
# (impl/, engine/, a dialect's name) are private. A line is `folder: folders it may include`. A folder
# is listed after all folders that it includes, so the table has no cycle.
set(LSYS_LAYERS
  "grammar/base:"
  "grammar/rendering: grammar/base"
  "grammar/ast: grammar/base"
  "grammar/lsys: grammar/base grammar/ast"
  "grammar/format: grammar/base grammar/lsys"
  "grammar/dialects: grammar/base grammar/ast grammar/lsys"
  "compiler/bytecode: grammar/base"
  "compiler/growth: grammar/base compiler/bytecode"
  "compiler/program: grammar/base grammar/ast compiler/bytecode"
  "compiler/resolve: grammar/base grammar/ast compiler/bytecode compiler/program"
  "compiler/lint: grammar/base compiler/bytecode compiler/growth compiler/program compiler/resolve"
  "compiler/lower: grammar/base compiler/bytecode compiler/program"
  "compiler: grammar/base grammar/ast compiler/bytecode compiler/program compiler/resolve compiler/lint compiler/lower"
  "compiler/instancing: grammar/base compiler/bytecode compiler/program compiler/lower"
  "runtime/platform:"
  "runtime/base: grammar/base runtime/platform"
  "runtime/derive: grammar/base compiler/bytecode runtime/base"
  "runtime/turtle: grammar/base compiler/bytecode runtime/base runtime/derive"
  "runtime/meshing: grammar/base runtime/base runtime/turtle"
  "runtime/environment: grammar/base compiler/bytecode runtime/base runtime/derive runtime/turtle runtime/meshing"
  "runtime/physics: grammar/base runtime/base runtime/turtle"
  "runtime/forest: grammar/base compiler/bytecode runtime/base runtime/derive runtime/turtle runtime/meshing"
  "runtime/terrain: grammar/base runtime/base runtime/meshing"
  "runtime/placement: grammar/base runtime/base runtime/forest runtime/terrain"
  "runtime/scene: grammar/base runtime/base runtime/derive runtime/forest runtime/terrain runtime/placement"
  "runtime/export: grammar/base runtime/base runtime/turtle runtime/meshing runtime/physics runtime/forest"
  "runtime/pipeline: grammar/base grammar/ast grammar/lsys grammar/dialects compiler/bytecode compiler/growth compiler/program compiler compiler/instancing runtime/base runtime/derive runtime/turtle runtime/meshing runtime/environment runtime/forest runtime/terrain runtime/placement runtime/scene"
  "runtime/tiles: grammar/base runtime/base runtime/turtle runtime/meshing runtime/forest runtime/terrain runtime/placement runtime/scene runtime/export runtime/pipeline"
  "runtime/serve: grammar/base runtime/base runtime/tiles"
  "runtime/names: grammar/base grammar/ast grammar/lsys grammar/dialects compiler/bytecode compiler/resolve"
  "runtime/languageserver: grammar/base grammar/ast grammar/lsys grammar/format grammar/dialects compiler/bytecode compiler/growth compiler/program compiler/resolve runtime/base runtime/derive runtime/turtle runtime/meshing runtime/export runtime/pipeline runtime/names"
  "runtime/program: grammar/base grammar/rendering grammar/dialects compiler/bytecode compiler/program runtime/platform runtime/base runtime/derive runtime/turtle runtime/meshing runtime/environment runtime/physics runtime/placement runtime/scene runtime/pipeline"
  "runtime/repair: grammar/base grammar/rendering grammar/ast grammar/lsys grammar/dialects compiler/program runtime/pipeline runtime/program"
  "runtime/output: grammar/base runtime/base runtime/derive runtime/turtle runtime/meshing runtime/physics runtime/forest runtime/terrain runtime/placement runtime/scene runtime/export runtime/pipeline runtime/program"
  "runtime/cli: grammar/base grammar/rendering grammar/ast grammar/lsys grammar/format grammar/dialects compiler/bytecode compiler/growth compiler/program compiler/instancing runtime/platform runtime/base runtime/derive runtime/turtle runtime/meshing runtime/environment runtime/physics runtime/forest runtime/terrain runtime/placement runtime/scene runtime/export runtime/pipeline runtime/tiles runtime/serve runtime/languageserver runtime/program runtime/repair runtime/output"
  "runtime/mpi: grammar/base runtime/platform runtime/base runtime/tiles runtime/program runtime/cli"
  "runtime/library: grammar/base grammar/rendering compiler/bytecode compiler/growth compiler/program runtime/base runtime/derive runtime/environment runtime/turtle runtime/meshing runtime/forest runtime/terrain runtime/scene runtime/export runtime/pipeline runtime/program runtime/output"
  "runtime/python:"
  "web/binding: grammar/base grammar/rendering grammar/ast grammar/lsys grammar/format compiler/bytecode compiler/program runtime/base runtime/derive runtime/turtle runtime/meshing runtime/forest runtime/terrain runtime/placement runtime/scene runtime/export runtime/pipeline runtime/program runtime/output"
  "packaging/pages: grammar/base grammar/dialects runtime/export runtime/cli runtime/mpi viewer/app"
  "viewer/scene: grammar/base runtime/base runtime/turtle runtime/physics runtime/forest runtime/terrain runtime/scene"
  "viewer/gl: grammar/base runtime/platform runtime/meshing runtime/physics viewer/scene"
  "viewer/app: grammar/base runtime/platform runtime/base runtime/turtle runtime/meshing runtime/forest runtime/placement runtime/physics runtime/scene runtime/names runtime/pipeline runtime/program runtime/repair runtime/export runtime/output viewer/scene viewer/gl")

# lsys_layer(PATH RESULT): sets RESULT to the innermost folder of the table that contains PATH.
function(lsys_layer path result)
  set(found "")
  set(longest 0)
  foreach(line IN LISTS LSYS_LAYERS)
    string(REGEX REPLACE ":.*" "" folder "${line}")
    string(FIND "${path}" "${folder}/" position)
    string(LENGTH "${folder}" length)
    if(position EQUAL 0 AND length GREATER longest)
      set(found "${folder}")
      set(longest ${length})
    endif()
  endforeach()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# lsys_layer_includes(FOLDER RESULT): sets RESULT to the list of folders that FOLDER may include.
function(lsys_layer_includes folder result)
  foreach(line IN LISTS LSYS_LAYERS)
    if(line MATCHES "^${folder}:(.*)$")
      string(STRIP "${CMAKE_MATCH_1}" included)
      string(REPLACE " " ";" included "${included}")
      set(${result} "${included}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "${folder} is not in cmake/Layers.cmake")
endfunction()
