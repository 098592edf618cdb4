# Writes build_info_values.h at every build, and touches it only where something changed, so that
# one small file is compiled again and nothing else. Included by CMakeLists.txt it makes the target;
# run as a script it does the work.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(folder ${PROJECT_BINARY_DIR}/build_info)
  file(MAKE_DIRECTORY ${folder})
  add_custom_target(fracbench_build_info
    COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR} -D FOLDER=${folder}
            -D VERSION=${PROJECT_VERSION} -D BUILD_TYPE=${CMAKE_BUILD_TYPE}
            -P ${CMAKE_CURRENT_LIST_FILE}
    BYPRODUCTS ${folder}/build_info_values.h
    COMMENT "Looking at the revision")
  add_dependencies(fracbench_harness fracbench_build_info)
  target_include_directories(fracbench_harness PRIVATE ${folder})
  fracbench_path_for(harness/suite_files.cpp FRACBENCH_SUITE_FOLDER ${PROJECT_SOURCE_DIR}/scenarios/suites)
  return()
endif()

set(revision unknown)
set(dirty 0)
execute_process(COMMAND git -C ${SOURCE} rev-parse HEAD
  OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
if(NOT failed)
  set(revision ${head})
  execute_process(COMMAND git -C ${SOURCE} status --porcelain
    OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(dirty 1)
  endif()
endif()

set(sums "")
foreach(room core geometry scenarios metrics)
  file(GLOB_RECURSE sources RELATIVE ${SOURCE} ${SOURCE}/${room}/*.h ${SOURCE}/${room}/*.cpp)
  list(SORT sources)
  foreach(source ${sources})
    file(SHA256 ${SOURCE}/${source} sum)
    string(APPEND sums "${source} ${sum}\n")
  endforeach()
endforeach()
string(SHA256 digest "${sums}")

set(text "#define FRACBENCH_VERSION \"${VERSION}\"
#define FRACBENCH_REVISION \"${revision}\"
#define FRACBENCH_DIRTY ${dirty}
#define FRACBENCH_SOURCE_DIGEST \"${digest}\"
#define FRACBENCH_BUILD_TYPE \"${BUILD_TYPE}\"
")
set(file ${FOLDER}/build_info_values.h)
set(old "")
if(EXISTS ${file})
  file(READ ${file} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${file} "${text}")
endif()
