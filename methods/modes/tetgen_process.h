#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

struct TetgenOutput {
  std::vector<Vec3> vertices;
  std::vector<Tet> tets;
  std::vector<double> regions;  ///< per tet
  /// 0: good; 1 to 10: what TetGen ended with; -1: it crashed.
  int code = 0;
  std::string messages;  ///< what it printed
};

/// Runs TetGen with these switches in a process of its own: where TetGen 1.5 gives up, it releases
/// its memory twice, which may end the process that it runs in, and it prints to standard output.
/// Throws MethodFailure where no process can be started.
TetgenOutput run_tetgen(const TriangleMesh& surface, const std::string& switches);

}  // namespace fracbench::modes
