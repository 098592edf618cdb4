#pragma once

/// Makes the compiler build a function for each of these kinds of processors, of which the program
/// chooses one as it starts. Not under the thread sanitizer: the choice is made before that is
/// ready, and calls into it.
#if defined(__SANITIZE_THREAD__)
#define FRACBENCH_PROCESSOR_CLONES(...)
#else
#define FRACBENCH_PROCESSOR_CLONES(...) __attribute__((target_clones(__VA_ARGS__)))
#endif
