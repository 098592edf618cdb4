#pragma once

#include <string>
#include <vector>

#include "core/fragments.h"
#include "core/impact.h"
#include "core/trajectory.h"
#include "harness/data_tree.h"
#include "metrics/metric.h"
#include "scenarios/scene.h"

namespace fracbench {

// How the parts of a record are laid out as arrays below `prefix`. Lists of lists are one list and
// the starts of its parts. Readers throw DataError.

void put_mesh(DataTree& tree, const std::string& prefix, const TriangleMesh& mesh);
TriangleMesh get_mesh(const DataTree& tree, const std::string& prefix);

void put_fragments(DataTree& tree, const std::string& prefix, const Fragments& fragments);
Fragments get_fragments(const DataTree& tree, const std::string& prefix);

void put_impacts(DataTree& tree, const std::string& prefix, const std::vector<Impact>& impacts);
std::vector<Impact> get_impacts(const DataTree& tree, const std::string& prefix);

void put_trajectory(DataTree& tree, const std::string& prefix, const Trajectory& trajectory);
Trajectory get_trajectory(const DataTree& tree, const std::string& prefix);

void put_replacements(DataTree& tree, const std::string& path,
                      const std::vector<Replacement>& replacements);
std::vector<Replacement> get_replacements(const DataTree& tree, const std::string& path);

void put_measurement(DataTree& tree, const std::string& prefix, const Measurement& measurement);
Measurement get_measurement(const DataTree& tree, const std::string& prefix);

}  // namespace fracbench
