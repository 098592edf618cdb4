#pragma once

#include <vector>

#include "core/breakable.h"
#include "core/fragments.h"

namespace fracbench {

/// The pieces of a single break of a body as fragments; each pair of neighbours has one crack.
/// Throws MethodFailure where tags and faces do not match.
Fragments fragments_of(const TriangleMesh& body, std::vector<Piece> pieces);

}  // namespace fracbench
