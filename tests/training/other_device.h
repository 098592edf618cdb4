#pragma once

namespace fracbench::test {

/// A device of libtorch's that tests have instead of a GPU. Its memory is the processor's and so
/// are its results, but as with a GPU, an operation that is given tensors of both is an error,
/// unless those of the processor are single numbers. It is there in every program that this is
/// linked to.
inline constexpr const char* kOtherDevice = "privateuseone";

}  // namespace fracbench::test
