#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/breakable.h"
#include "core/fragments.h"
#include "core/impact.h"
#include "core/target.h"
#include "core/trajectory.h"
#include "scenarios/rigid/world.h"
#include "scenarios/scenario.h"
#include "scenarios/scene.h"

namespace fracbench {

/// The bodies of a scene while it runs: the balls, and the target or what became of it.
class SceneBodies {
 public:
  /// Sets up the start of the scene. `surface` is that of the target's mesh. Throws InputError for
  /// a ball that starts in the target or in another ball.
  SceneBodies(const Scenario& scenario, const Target& target,
              std::shared_ptr<const SurfaceTree> surface,
              std::shared_ptr<const Breakable> breakable);

  struct Solid {
    Fragment fragment;  ///< its mesh and tags in the frame of the target; the target's own piece is
                        ///< -1 and generation 0
    std::shared_ptr<const Breakable> breakable;  ///< null: cannot break
    RigidSolid rigid;
    std::size_t track = 0;
  };

  /// Solids by their number in the world: the order in which they came to be.
  const std::map<int, Solid>& solids() const { return solids_; }

  /// Moves on by one time step; remembers the states before it.
  std::vector<BodyContact> advance();
  /// Back to the start of the step that was made last.
  void rewind();

  /// What the contacts of the last step mean for a solid; nothing where none is its own.
  std::optional<Impact> impact_on(int solid, const std::vector<BodyContact>& contacts,
                                  double time) const;

  /// At the start of a step: puts the pieces in the place of the solid.
  Replacement replace(int solid, std::vector<Piece> pieces, double time);

  /// Appends where everything is now, as the poses of frame `frame`.
  void record(int frame);

  Fragments fragments() const;
  Trajectory take_trajectory() { return std::move(trajectory_); }

 private:
  struct BallBody {
    int body = -1;
    Ball ball;
    std::size_t track = 0;
  };

  void add_solid(Solid solid, const BodyState& state);
  std::size_t new_track(Track::Kind kind, std::int32_t index);

  const Scenario& scenario_;
  double size_;
  RigidWorld world_;
  std::vector<BallBody> balls_;
  std::map<int, Solid> solids_;
  std::shared_ptr<const RigidWorld::Snapshot> before_;
  std::map<int, BodyState> states_before_;
  Trajectory trajectory_;
  std::int32_t next_piece_ = 0;
  std::int32_t next_interface_ = 0;
};

}  // namespace fracbench
