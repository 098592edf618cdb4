#include "harness/conformance.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "harness/conformance/cancel.h"
#include "harness/conformance/confined.h"
#include "harness/conformance/memory.h"
#include "harness/conformance/repeatability.h"
#include "harness/conformance/sound_fragments.h"
#include "harness/conformance/tidy.h"

namespace fracbench {

using namespace conformance;

namespace {

struct Known {
  Check check;
  CheckResult (*make)(const Bench&);
  bool needs_fragments = false;  ///< says nothing where no blow broke the body
};

const std::vector<Known>& known_checks() {
  static const std::vector<Known> all = {
      // First: a file that is there already, from an earlier check, is not left a second time.
      {{"confined", "no file is left, changed or removed anywhere but where it works"},
       check_confined},
      {{"tags", "every face says where it comes from, every vertex is a number"}, check_tags},
      {{"closed", "fragments are closed, oriented, free of self-intersections"},
       check_closed,
       true},
      {{"disjoint", "fragments do not overlap"}, check_disjoint, true},
      {{"volume", "they fill the body within the tolerance that the method declares"},
       check_volume,
       true},
      {{"surface", "the original surface is kept, where the method says so"}, check_surface, true},
      {{"same-seed", "the same seed gives the same bytes"}, check_same_seed},
      {{"other-seed", "another seed gives other fragments just where the method says so"},
       check_other_seed,
       true},
      {{"const-use", "a prepared body may be used twice"}, check_const_use},
      {{"other-impact", "an answer does not depend on earlier impacts"}, check_other_impact},
      {{"save-load", "a body that was saved and loaded is the same"}, check_save_load},
      {{"weak-blow", "a blow that is too weak to matter has a sound answer, too"}, check_weak_blow},
      {{"memory", "it needs no more memory than allowed, and gives it back after each blow"},
       check_memory},
      {{"tidy", "nothing is left in the current folder, HOME, TMPDIR or beside its own files"},
       check_tidy},
      {{"cancel", "work ends within a second when it is asked to"}, check_cancel}};
  return all;
}

}  // namespace

const std::vector<Check>& conformance_checks() {
  static const std::vector<Check> all = [] {
    std::vector<Check> list;
    for (const Known& known : known_checks()) list.push_back(known.check);
    return list;
  }();
  return all;
}

CheckResult make_check(const std::string& name, const CheckSubject& subject) {
  const auto& all = known_checks();
  const auto found =
      std::ranges::find_if(all, [&](const Known& known) { return known.check.name == name; });
  if (found == all.end()) {
    std::vector<std::string> names;
    for (const Known& known : all) names.push_back(known.check.name);
    throw InputError(fmt::format("there is no check '{}'{}", name, did_you_mean(name, names)));
  }
  const Bench bench(subject);
  try {
    if (found->needs_fragments && bench.broken().size() < 2) {
      return skipped("four blows left the body whole; a larger --impulse helps");
    }
    return found->make(bench);
  } catch (const MethodFailure& failure) {
    return failed(failure.what());
  }
}

}  // namespace fracbench
