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

/// How many frames of motion a record has.
int frames_of(const Record& record);

}  // namespace fracbench
