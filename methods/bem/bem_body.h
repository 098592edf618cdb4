#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/breakable.h"
#include "core/target.h"
#include "methods/bem/bem_options.h"
#include "methods/bem/crack_fragments.h"
#include "methods/bem/crack_growth.h"
#include "methods/bem/cut_links.h"
#include "methods/bem/elastic_body.h"
#include "methods/bem/propagate.h"

namespace fracbench::bem {

/// All that determines how a body breaks under an impact, but for the seed of a target's strength.
struct BodyState {
  Settings settings;
  Target body;                                ///< the target, or a piece of it
  double target_volume = 0;                   ///< m^3
  double target_area = 0;                     ///< m^2
  std::optional<TriangleMesh> elements = {};  ///< remeshed for the boundary elements, once known
  // Of pieces:
  bool is_piece = false;
  std::uint64_t strength_seed = 0;  ///< that of the target's break
  std::vector<Crack> cracks = {};   ///< that did not separate the piece
};

/// A body that cracks run through. Made ready (remeshed, its operator assembled and factorised) by
/// prepare, or at the first break: the pieces of a break cost nothing until they break themselves.
class BemBody : public Breakable {
 public:
  explicit BemBody(BodyState state);
  ~BemBody() override;

  /// Throws InputError where the body cannot be remeshed, is thinner than the voxels or needs more
  /// memory than there is.
  void prepare(Context& context) const;

  std::vector<Piece> fracture(const Impact& impact, Context& context) const override;
  void save(const std::filesystem::path& folder) const override;

  const BodyState& state() const { return state_; }

 private:
  struct Ready {
    ElasticBody elastic;
    CutLinks links;
  };

  const Ready& ready(Context& context) const;
  std::vector<Piece> whole() const;
  void give_next(CrackFragments& fragments, const Propagation& growth, const CutLinks& links,
                 std::uint64_t strength_seed) const;

  BodyState state_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<const Ready> ready_;
  mutable std::optional<TriangleMesh> elements_;
  mutable std::string refusal_;  ///< of a piece that cannot be made ready
};

/// How many triangles the boundary elements of a body get: the target's share by area, at least 200
/// and at most the target's number.
int element_count(const BodyState& state);

}  // namespace fracbench::bem
