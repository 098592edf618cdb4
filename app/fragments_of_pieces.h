#pragma once

#include <vector>

#include "core/breakable.h"
#include "core/fragments.h"

namespace fracbench {

/// The pieces of a single break as fragments; each pair of neighbours has one crack.
Fragments fragments_of(std::vector<Piece> pieces);

}  // namespace fracbench
