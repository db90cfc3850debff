# SPDX-License-Identifier: MIT
# Installs the build BUILD_DIR into WORK_DIR/prefix, compiles the C++ programs of README.md
# against that copy in projects of their own, and compares what they print with the README's listings.
#   cmake -DSOURCE_DIR=... -DBUILD_DIR=... -DWORK_DIR=... -DCOMPONENTS="vtk;open_mesh" -P install_test.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "failed (${code}): ${command}\n${out}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

file(READ ${SOURCE_DIR}/README.md readme)
# Programs follow each other, each with what it prints.
set(rest "${readme}")
foreach(number IN ITEMS 1 2)
  if(NOT rest MATCHES "```cpp\n([^`]*)```")
    message(FATAL_ERROR "README.md has no C++ program ${number}")
  endif()
  set(program "${CMAKE_MATCH_1}")
  if(NOT rest MATCHES "It prints\n\n```text\n([^`]*)```")
    message(FATAL_ERROR "README.md does not show what its program ${number} prints")
  endif()
  set(expected "${CMAKE_MATCH_1}")
  string(FIND "${rest}" "It prints\n\n```text\n${expected}" at)
  math(EXPR at "${at} + 16")
  string(SUBSTRING "${rest}" ${at} -1 rest)
  set(project ${WORK_DIR}/program_${number})
  file(WRITE ${project}/program.cpp "${program}")
  file(WRITE ${project}/CMakeLists.txt "cmake_minimum_required(VERSION 3.20)
project(program LANGUAGES CXX)
find_package(encase 0.1 CONFIG REQUIRED COMPONENTS core)
if(VTK_FOUND OR OpenMesh_FOUND OR CGAL_FOUND)
  message(FATAL_ERROR \"the core looked for an optional library\")
endif()
add_executable(program program.cpp)
target_link_libraries(program encase::core)
")
  run(${CMAKE_COMMAND} -S ${project} -B ${project}/build -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
  run(${CMAKE_COMMAND} --build ${project}/build)
  execute_process(COMMAND ${project}/build/program RESULT_VARIABLE code OUTPUT_VARIABLE printed)
  if(NOT code EQUAL 0 OR NOT printed STREQUAL expected)
    message(FATAL_ERROR "the README's program ${number} printed (exit code ${code})\n${printed}\n"
      "instead of\n${expected}")
  endif()
endforeach()

# The optional components link too, if they were built.
foreach(component IN LISTS COMPONENTS)
  set(project ${WORK_DIR}/${component})
  file(WRITE ${project}/main.cpp "#include <encase/${component}.hpp>
encase::Status written(const encase::Encasement& e) { return encase::write_${component}(e, \"\"); }
auto function = &written;
int main() { return function == nullptr; }
")
  file(WRITE ${project}/CMakeLists.txt "cmake_minimum_required(VERSION 3.20)
project(component LANGUAGES C CXX)
find_package(encase CONFIG REQUIRED COMPONENTS core ${component})
add_executable(main main.cpp)
target_link_libraries(main encase::${component})
")
  run(${CMAKE_COMMAND} -S ${project} -B ${project}/build -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
  run(${CMAKE_COMMAND} --build ${project}/build)
  run(${project}/build/main)
endforeach()

# A component that was not installed is refused with a sentence that names it.
set(project ${WORK_DIR}/missing)
file(WRITE ${project}/CMakeLists.txt "cmake_minimum_required(VERSION 3.20)
project(missing LANGUAGES CXX)
find_package(encase CONFIG REQUIRED COMPONENTS teapot)
")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${project} -B ${project}/build
  -DCMAKE_PREFIX_PATH=${prefix} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
if(code EQUAL 0 OR NOT out MATCHES "built without its component[ \n]+teapot")
  message(FATAL_ERROR "an unknown component was not refused clearly:\n${out}")
endif()
