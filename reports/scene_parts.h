#pragma once

#include <vector>

#include "harness/record.h"

namespace fracbench {

/// What there is to see of a record: its fragments, or the target as one where it did not break.
Fragments shown_fragments(const Record& record, const TriangleMesh& target);

/// Of a fragment's faces that the fracture made, m^2.
double fracture_area(const Fragment& fragment);

/// The radii of the balls of its scene, m, by their index.
std::vector<double> ball_radii(const Record& record);

}  // namespace fracbench
