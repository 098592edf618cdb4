#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/plan.h"

namespace fracbench {

/// Where the learning data of a suite lies whose results are in `folder`.
std::filesystem::path learning_folder_in(const std::filesystem::path& folder);

/// The suite whose cells are the collisions to learn from. Its scenes differ from those that the
/// suite itself measures, unless it gives its learning data a seed. Throws InputError where the
/// suite has no table [learning].
Suite learning_suite(const Suite& suite);

/// The labels of the shapes that the suite makes learning data for, among those of this part of it
/// and those that its methods learn with them. Empty where nothing is to be made.
std::vector<std::string> learning_shapes(const Suite& suite, const PlanOptions& part = {});

/// The plan of that suite for some of its shapes, by label or name; none: all. Throws InputError
/// also where the method itself has to learn, and where no shape is left.
Plan make_learning_plan(const Suite& suite, const Catalog& catalog,
                        const std::vector<std::string>& shapes = {});

/// SHA-256 of everything that determines the learning data of one shape: the keys of its collisions
/// and how they are divided.
std::string learning_digest(const Plan& plan, std::size_t shape, const LearningSplit& split);

}  // namespace fracbench
