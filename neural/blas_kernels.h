#pragma once

#include <string>

namespace fracbench::neural {

/// Which kernels OpenBLAS multiplies matrices with: "SkylakeX", for instance.
std::string blas_kernels();

/// OpenBLAS chooses its kernels by the processor's model when it is loaded, and gives a model that
/// is younger than itself the oldest ones it has, which take five times as long. Where that has
/// happened, this starts the program anew, with OPENBLAS_CORETYPE naming those of the processor's
/// instructions; a value that the user gave stays. To be called first of all in main.
void use_fitting_blas_kernels(char** argv);

}  // namespace fracbench::neural
