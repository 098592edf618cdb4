#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "neural/representation_study.h"

namespace fracbench::training {

/// The region of each pixel of a square image, row by row.
using Labels = std::vector<std::int32_t>;

/// A Voronoi diagram: regions 0 to n - 1, in random order.
Labels voronoi(const neural::StudySettings& settings, Random& random);

/// What stands for a divided image: a value in [0, 1] for each pixel.
std::vector<float> image_of(const Labels& labels, neural::Representation representation, int side);

/// Regions that an image stands for: by value (of `count` regions), what is connected away from
/// lines (whose pixels join the nearest region), or the basins of a distance.
Labels regions_of(const std::vector<float>& image, neural::Representation representation, int side,
                  int count);

/// The regions called 0, 1, 2, ... in the order in which they appear.
Labels in_order(const Labels& labels);

/// How many regions there are.
double count_of(const Labels& labels);

}  // namespace fracbench::training
