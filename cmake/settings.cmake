# Compiler settings of the project's own code.

add_library(fracbench_settings INTERFACE)
target_compile_options(fracbench_settings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Werror
  # A fused multiply-add rounds once where two operations round twice: without it the same source
  # gives the same bytes at every optimisation level.
  -ffp-contract=off)
if(FRACBENCH_NATIVE)
  target_compile_options(fracbench_settings INTERFACE -march=native)
endif()
if(FRACBENCH_SANITIZE)
  target_compile_options(fracbench_settings INTERFACE
    -fsanitize=${FRACBENCH_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(fracbench_settings INTERFACE -fsanitize=${FRACBENCH_SANITIZE})
  # GCC's flow analysis sees impossible paths once the sanitizers have instrumented the code.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(fracbench_settings INTERFACE -Wno-maybe-uninitialized -Wno-stringop-overflow)
  endif()
endif()
target_include_directories(fracbench_settings INTERFACE ${PROJECT_SOURCE_DIR})
