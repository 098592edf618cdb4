#pragma once

#include <filesystem>

#include "core/target.h"
#include "methods/bem/bem_body.h"

namespace fracbench::bem {

/// Writes what a body needs beside its mesh, material and options into `folder`/bem.json: a digest
/// of these three, the mesh of its boundary elements, and for a piece the cracks in it. The
/// operator is not in it: assembling it anew takes about as long as reading it from a slow disk,
/// and gives the same bytes. Throws InputError where the file cannot be written.
void write_body(const std::filesystem::path& folder, const BodyState& state);

/// The state of the body that write_body wrote. Throws InputError where the file is missing,
/// damaged or of another target or other options.
BodyState read_body(const std::filesystem::path& folder, const Target& target,
                    const Settings& settings);

}  // namespace fracbench::bem
