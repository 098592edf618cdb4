#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/context.h"

namespace fracbench {

/// One line of a method's accuracy table: a computed value beside a known one.
struct Accuracy {
  std::string name;       ///< "penny crack, K_I"
  std::string reference;  ///< where the known value comes from: "closed form (Sneddon 1946)"
  double expected = 0;
  double computed = 0;
  double tolerance = 0;  ///< largest allowed error
  std::string unit = {};
  /// |computed - expected| over |expected|, or the plain difference where expected is 0.
  double error() const {
    const double difference = std::abs(computed - expected);
    return expected == 0 ? difference : difference / std::abs(expected);
  }
  /// False for NaN.
  bool pass() const { return error() <= tolerance; }
};

/// One case of a method's validation ladder: a computation that gives one or more accuracies. The
/// tests and `fracbench validate` run the same cases.
struct ValidationCase {
  std::string name;     ///< unique in the method: "penny-crack"
  std::string summary;  ///< one line
  double seconds = 1;   ///< about how long it takes on two cores
  std::function<std::vector<Accuracy>(Context&)> run;
};

}  // namespace fracbench
