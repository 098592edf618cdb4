#pragma once

#include <memory>
#include <vector>

#include "harness/catalog.h"
#include "harness/suite.h"

namespace fracbench {

/// A complete, small world for tests of the harness: boxes that are cut in two by a random plane,
/// hit by an impact that is made up.
///
/// Method "halves": options `margin` (m), `pieces`, `trouble` (none, failure, memory, error, leak)
/// and `wait` (s for each fracture); notes the device where it is not the processor. Family
/// "shove": options `count`, `speed` (below 10 m/s nothing breaks). Method "hostile": see
/// hostile_method.h. Shapes "box" and "slab". Metrics "size" and "clock", the latter of the
/// machine.
class ToyWorld {
 public:
  ToyWorld();
  Catalog catalog() const;

 private:
  std::vector<std::unique_ptr<Method>> methods_;
  std::vector<std::unique_ptr<ScenarioFamily>> families_;
  std::vector<std::unique_ptr<Metric>> metrics_;
};

/// The mesh of an axis-aligned box, two triangles a side: -x, +x, -y, +y, -z, +z.
TriangleMesh box_mesh(const Vec3& low, const Vec3& high);

/// A suite of the toy world in TOML: two shapes, three impacts, two variants of the method.
std::string toy_suite_text();
Suite toy_suite(const Catalog& catalog);

}  // namespace fracbench
