#pragma once

#include <string>
#include <vector>

#include "reports/picture/picture.h"

namespace fracbench {

/// A picture that belongs to a section, shown as a PNG file.
struct ReportPicture {
  std::string name;   ///< of its file
  std::string title;  ///< above it
  std::vector<std::string> notes = {};
  Picture picture;
};

}  // namespace fracbench
