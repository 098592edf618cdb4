#pragma once

#include "reports/report_item.h"

namespace fracbench {

/// Normals and roughness of the fracture surfaces (figure 10, middle, by our own definitions).
class FractureSurfaces final : public ReportItem {
 public:
  ReportItemInfo info() const override;
  ReportSection render(const ReportInput& input) const override;
};

}  // namespace fracbench
