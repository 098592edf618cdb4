#pragma once

#include <optional>
#include <vector>

#include "harness/record.h"
#include "reports/picture/draw.h"

namespace fracbench {

struct RecordPictureOptions {
  int width = 480;
  int height = 480;
  double apart = 0.25;      ///< moves fragments apart, in their distances from the middle
  bool by_surface = false;  ///< original and fracture surface in two colours, else by fragment
  bool wireframe = false;
  std::optional<int> frame = {};  ///< of the recorded motion; none: at rest, seen from the impact
};

/// The fragments of a record, or the target where it did not break. At rest the view depends on the
/// target and the impact alone, so that methods under one impact are seen from one side.
Picture picture_of(const Record& record, const TriangleMesh& target,
                   const RecordPictureOptions& options = {});

/// The target before it broke, with an arrow along each impulse of the first impact that ends where
/// it acts; from the side of picture_of.
Picture collision_picture_of(const Record& record, const TriangleMesh& target,
                             const RecordPictureOptions& options = {});

/// The place in `fragments` of the one with the largest fracture surface; none where nothing broke.
std::optional<std::size_t> most_cracked(const Fragments& fragments);

/// A fragment alone, seen against its largest crack; fracture surface is in a colour of its own.
Picture fracture_picture_of(const Fragment& fragment, const RecordPictureOptions& options = {});

/// How many frames of motion a record has.
int frames_of(const Record& record);

}  // namespace fracbench
