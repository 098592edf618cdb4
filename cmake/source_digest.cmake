# Digests of the sources that each method is built from, so that a record tells which version of a
# method made it.
#
# Included by the build, it defines fracbench_source_digests(): a header with one line per folder
# below methods/, made at build time whenever one of the sources changes. Run as a script (cmake -P),
# it makes that header.

if(CMAKE_SCRIPT_MODE_FILE)
  # In: ROOT, OUTPUT.
  function(digest_of_folders result)
    set(lines "")
    foreach(folder ${ARGN})
      file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${folder}/*)
      list(SORT files)
      foreach(file ${files})
        file(SHA256 ${ROOT}/${file} digest)
        string(APPEND lines "${file} ${digest}\n")
      endforeach()
    endforeach()
    string(SHA256 digest "${lines}")
    set(${result} ${digest} PARENT_SCOPE)
  endfunction()

  file(GLOB entries RELATIVE ${ROOT}/methods ${ROOT}/methods/*)
  list(SORT entries)
  set(text "// Made by cmake/source_digest.cmake from the sources of each method.\n")
  foreach(entry ${entries})
    if(IS_DIRECTORY ${ROOT}/methods/${entry})
      set(rooms core geometry)
      if(EXISTS ${ROOT}/methods/${entry}/digest_also.txt)  # further rooms, one a line
        file(STRINGS ${ROOT}/methods/${entry}/digest_also.txt further)
        list(APPEND rooms ${further})
      endif()
      digest_of_folders(digest ${rooms} methods/${entry})
      string(APPEND text "{\"${entry}\", \"${digest}\"},\n")
    endif()
  endforeach()
  file(WRITE ${OUTPUT}.new "${text}")
  file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
  return()
endif()

function(fracbench_source_digests target)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/core/* ${PROJECT_SOURCE_DIR}/geometry/* ${PROJECT_SOURCE_DIR}/methods/*
    ${PROJECT_SOURCE_DIR}/neural/* ${PROJECT_SOURCE_DIR}/training/*)
  set(folder ${PROJECT_BINARY_DIR}/generated)
  file(MAKE_DIRECTORY ${folder})
  set(script ${PROJECT_SOURCE_DIR}/cmake/source_digest.cmake)
  # The stamp is what the build compares; the header keeps its age while its text stays the same.
  add_custom_command(
    OUTPUT ${folder}/source_digests.stamp
    BYPRODUCTS ${folder}/source_digests.inc
    COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -DOUTPUT=${folder}/source_digests.inc
            -P ${script}
    COMMAND ${CMAKE_COMMAND} -E touch ${folder}/source_digests.stamp
    DEPENDS ${sources} ${script}
    COMMENT "Digesting the sources of the methods"
    VERBATIM)
  add_custom_target(${target}_digests DEPENDS ${folder}/source_digests.stamp)
  add_dependencies(${target} ${target}_digests)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
