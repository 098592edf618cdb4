#pragma once

#include <vector>

#include "core/breakable.h"
#include "core/fragments.h"

namespace fracbench {

/// Fragments as pieces of the unbroken body: both sides of a crack know each other.
std::vector<Piece> pieces_of_fragments(const Fragments& fragments);

}  // namespace fracbench
