# A room is a top-level folder: one library of all the sources below it, named fracbench::<folder>.
# A new source file, method or metric needs no change to any CMake file.

function(fracbench_room name)
  cmake_parse_arguments(ARG "" "" "USES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${name}/*.cpp)
  add_library(fracbench_${name} STATIC ${sources})
  add_library(fracbench::${name} ALIAS fracbench_${name})
  target_link_libraries(fracbench_${name} PUBLIC ${ARG_USES} PRIVATE fracbench_settings)
  target_include_directories(fracbench_${name} PUBLIC ${PROJECT_SOURCE_DIR})
endfunction()

function(fracbench_program name)
  cmake_parse_arguments(ARG "" "FOLDER" "USES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${ARG_FOLDER}/*.cpp)
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARG_USES} fracbench_settings)
endfunction()

# Lets the target include "source_folder.h", which defines FRACBENCH_SOURCE_DIR. A header and not a
# definition for the whole target, so that the compiler cache serves every clone: only the few files
# that name a folder of this machine differ between two of them.
function(fracbench_source_folder_header target)
  set(folder ${PROJECT_BINARY_DIR}/source_folder)
  file(CONFIGURE OUTPUT ${folder}/source_folder.h
    CONTENT "#pragma once\n#define FRACBENCH_SOURCE_DIR \"@PROJECT_SOURCE_DIR@\"\n" @ONLY)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()

# Defines a path of this machine for one source file of a room, for the same reason.
function(fracbench_path_for source definition path)
  set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS ${definition}="${path}")
endfunction()

# All files tests/<room>/**/*_test.cpp make one test program, test_<room>; helpers that several of
# its files share stand beside them as ordinary sources.
function(fracbench_tests room)
  cmake_parse_arguments(ARG "" "" "USES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${room}/*.cpp)
  add_executable(test_${room} ${sources})
  target_link_libraries(test_${room} PRIVATE ${ARG_USES} third_party::gtest fracbench_settings)
  fracbench_source_folder_header(test_${room})
  gtest_discover_tests(test_${room} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 600 LABELS ${room} ENVIRONMENT FRACBENCH_CACHE=)
endfunction()

# Every file benchmarks/<name>_bench.cpp is a Google Benchmark program of its own.
function(fracbench_benchmarks)
  cmake_parse_arguments(ARG "" "" "USES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/benchmarks/*_bench.cpp)
  # A library, of which those with a main of their own take nothing.
  add_library(fracbench_benchmark_main STATIC ${PROJECT_SOURCE_DIR}/benchmarks/main.cpp)
  target_link_libraries(fracbench_benchmark_main PRIVATE fracbench::core third_party::benchmark fracbench_settings)
  foreach(source ${sources})
    get_filename_component(name ${source} NAME_WE)
    add_executable(${name} ${source})
    target_link_libraries(${name} PRIVATE fracbench_benchmark_main ${ARG_USES} third_party::benchmark fracbench_settings)
    fracbench_source_folder_header(${name})
  endforeach()
endfunction()
