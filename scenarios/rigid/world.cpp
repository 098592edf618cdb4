#include "scenarios/rigid/world.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "scenarios/rigid/first_touch.h"
#include "scenarios/rigid/sphere_contact.h"

namespace fracbench {

namespace {

constexpr int kSolverIterations = 50;
// Share of an overlap that is undone in a step: fast enough to keep heaps apart, slow enough that
// nothing jumps.
constexpr double kOverlapCorrection = 0.2;
// How far two solids that are near each other may move within one engine step, as share of the
// target's size: the depth that they can overlap by before they are stopped. No step is shorter
// than what was asked for over kMaxSteps.
constexpr double kStepShare = 0.02;
constexpr int kMaxSteps = 16;
// First touches that time is cut at within one call; those beyond are found with some overlap.
constexpr int kMaxTouches = 12;

btVector3 to_bullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation;
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), to_bullet(pose.position));
}

Pose from_bullet(const btTransform& transform) {
  const btQuaternion q = transform.getRotation();
  return {.position = from_bullet(transform.getOrigin()),
          .orientation = Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z()).normalized()};
}

using BodyPair = std::pair<int, int>;

struct Body {
  ContactSurface contact;  // what the engine's user pointer points to
  std::shared_ptr<const SurfaceTree> surface;
  MassFrame frame;
  double reach = 0;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;  // the last one is the body's
  std::unique_ptr<btRigidBody> rigid;

  bool is_ball() const { return surface == nullptr; }
};

int number(const btCollisionObject* object) {
  return static_cast<const ContactSurface*>(object->getUserPointer())->body;
}

bool is_ball(const btCollisionObject* object) {
  return static_cast<const ContactSurface*>(object->getUserPointer())->surface == nullptr;
}

/// The engine's world, which forgives the overlap that two solids had when they were made.
class ForgivingWorld final : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;

  std::map<BodyPair, double> allowed;  // overlap of a pair of solids that is left alone, m
  std::set<int> newborn;               // solids that were not yet looked at

  void performDiscreteCollisionDetection() override {
    btDiscreteDynamicsWorld::performDiscreteCollisionDetection();
    std::map<BodyPair, double> still_allowed;
    for (int m = 0; m < getDispatcher()->getNumManifolds(); ++m) {
      btPersistentManifold& manifold = *getDispatcher()->getManifoldByIndexInternal(m);
      if (is_ball(manifold.getBody0()) || is_ball(manifold.getBody1())) continue;
      double depth = 0;
      for (int c = 0; c < manifold.getNumContacts(); ++c) {
        depth = std::max(depth, -manifold.getContactPoint(c).getDistance());
      }
      const BodyPair pair = std::minmax(number(manifold.getBody0()), number(manifold.getBody1()));
      const bool is_new = newborn.contains(pair.first) || newborn.contains(pair.second);
      const auto known = allowed.find(pair);
      if (!is_new && known == allowed.end()) continue;
      // Compounds of parts have several manifolds per pair: the deepest counts.
      double& left = still_allowed[pair];
      left = std::max(left, is_new ? depth : std::min(depth, known->second));
    }
    allowed = std::move(still_allowed);
    newborn.clear();
    for (int m = 0; m < getDispatcher()->getNumManifolds(); ++m) {
      btPersistentManifold& manifold = *getDispatcher()->getManifoldByIndexInternal(m);
      const auto pair =
          allowed.find(std::minmax(number(manifold.getBody0()), number(manifold.getBody1())));
      if (pair == allowed.end()) continue;
      for (int c = 0; c < manifold.getNumContacts(); ++c) {
        btManifoldPoint& point = manifold.getContactPoint(c);
        point.setDistance(point.getDistance() + pair->second);
      }
    }
  }
};

}  // namespace

struct RigidWorld::Snapshot {
  struct Motion {
    btTransform transform;
    btVector3 velocity;
    btVector3 angular_velocity;
  };
  std::map<int, Motion> motions;
  std::map<BodyPair, double> allowed;
  std::set<int> newborn;
};

struct RigidWorld::State {
  explicit State(double size_) : size(size_) {
    register_sphere_contact(dispatcher);
    world.setGravity({0, 0, 0});
    world.getDispatchInfo().m_deterministicOverlappingPairs = true;
    btContactSolverInfo& solving = world.getSolverInfo();
    solving.m_numIterations = kSolverIterations;
    // The engine reports impulses only where it may start from the last ones: it may, with none of
    // them, so that a step depends on nothing but the motions before it.
    solving.m_solverMode = SOLVER_USE_WARMSTARTING;
    solving.m_warmstartingFactor = 0;
    solving.m_erp2 = kOverlapCorrection;
    solving.m_splitImpulse = 1;
    solving.m_splitImpulsePenetrationThreshold = 0;
  }
  ~State() {
    for (auto& [id, body] : bodies) world.removeRigidBody(body->rigid.get());
  }

  int add(std::unique_ptr<Body> body, const Material& material, const BodyState& state);
  double longest_step(double seconds) const;
  double fastest_ball() const;
  std::optional<double> next_touch(double seconds) const;
  void step(double seconds, std::vector<BodyContact>& contacts);
  BodyState state_of(const Body& body) const;

  double size;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  ForgivingWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::map<int, std::unique_ptr<Body>> bodies;
  int next_body = 0;
};

int RigidWorld::State::add(std::unique_ptr<Body> body, const Material& material,
                           const BodyState& state) {
  const int id = next_body++;
  body->contact.body = id;
  body->contact.surface = body->surface.get();
  body->contact.mesh_from_body = {.position = body->frame.center, .orientation = body->frame.axes};
  btRigidBody::btRigidBodyConstructionInfo info(
      body->frame.mass, nullptr, body->shapes.back().get(), to_bullet(body->frame.inertia));
  info.m_startWorldTransform = to_bullet(body->frame.body_pose(state.pose));
  // The engine multiplies the two bodies' values.
  info.m_restitution = std::sqrt(material.restitution);
  info.m_friction = std::sqrt(material.friction);
  body->rigid = std::make_unique<btRigidBody>(info);
  body->rigid->setUserPointer(&body->contact);
  body->rigid->setActivationState(DISABLE_DEACTIVATION);
  body->rigid->setLinearVelocity(to_bullet(state.velocity));
  body->rigid->setAngularVelocity(to_bullet(state.angular_velocity));
  world.addRigidBody(body->rigid.get());
  if (!body->is_ball()) world.newborn.insert(id);
  bodies.emplace(id, std::move(body));
  return id;
}

BodyState RigidWorld::State::state_of(const Body& body) const {
  return {.pose = body.frame.mesh_pose(from_bullet(body.rigid->getWorldTransform())),
          .velocity = from_bullet(body.rigid->getLinearVelocity()),
          .angular_velocity = from_bullet(body.rigid->getAngularVelocity())};
}

/// How long an engine step within `seconds` may be, so that solids that may meet do not pass
/// through each other.
double RigidWorld::State::longest_step(double seconds) const {
  double fastest = 0;
  for (auto a = bodies.begin(); a != bodies.end(); ++a) {
    if (a->second->is_ball()) continue;
    for (auto b = std::next(a); b != bodies.end(); ++b) {
      if (b->second->is_ball()) continue;
      const btRigidBody& first = *a->second->rigid;
      const btRigidBody& second = *b->second->rigid;
      const double speed = (first.getLinearVelocity() - second.getLinearVelocity()).length() +
                           first.getAngularVelocity().length() * a->second->reach +
                           second.getAngularVelocity().length() * b->second->reach;
      const double gap =
          (first.getWorldTransform().getOrigin() - second.getWorldTransform().getOrigin())
              .length() -
          a->second->reach - b->second->reach;
      if (gap < speed * seconds) fastest = std::max(fastest, speed);
    }
  }
  return fastest * seconds > kStepShare * size ? kStepShare * size / fastest : seconds;
}

double RigidWorld::State::fastest_ball() const {
  double fastest = 0;
  for (const auto& [id, body] : bodies) {
    if (body->is_ball()) fastest = std::max(fastest, body->rigid->getLinearVelocity().length());
  }
  return fastest;
}

std::optional<double> RigidWorld::State::next_touch(double seconds) const {
  std::optional<double> first;
  for (const auto& [id, body] : bodies) {
    if (!body->is_ball()) continue;
    const BodyState motion = state_of(*body);
    const FlyingBall ball = {.center = motion.pose.position,
                             .velocity = motion.velocity,
                             .radius = body->contact.radius};
    for (const auto& [other_id, other] : bodies) {
      if (other->is_ball() && other_id <= id) continue;
      const BodyState other_motion = state_of(*other);
      const double limit = first.value_or(seconds);
      const std::optional<double> touch = other->is_ball()
                                              ? first_touch(ball,
                                                            {.center = other_motion.pose.position,
                                                             .velocity = other_motion.velocity,
                                                             .radius = other->contact.radius},
                                                            limit)
                                              : first_touch(ball,
                                                            {.surface = other->surface.get(),
                                                             .frame = &other->frame,
                                                             .reach = other->reach,
                                                             .state = other_motion},
                                                            limit);
      if (touch) first = touch;
    }
  }
  return first;
}

void RigidWorld::State::step(double seconds, std::vector<BodyContact>& contacts) {
  std::map<int, btMatrix3x3> basis;
  for (const auto& [id, body] : bodies) basis[id] = body->rigid->getWorldTransform().getBasis();
  world.stepSimulation(seconds, 0);
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const int a = number(manifold.getBody0());
    const int b = number(manifold.getBody1());
    for (int c = 0; c < manifold.getNumContacts(); ++c) {
      const btManifoldPoint& point = manifold.getContactPoint(c);
      if (!(point.m_appliedImpulse > 0)) continue;
      const btVector3 on_a = point.m_normalWorldOnB * point.m_appliedImpulse +
                             point.m_lateralFrictionDir1 * point.m_appliedImpulseLateral1;
      const auto add = [&](int id, int other, const btVector3& where, const btVector3& impulse) {
        const Pose& mesh_from_body = bodies.at(id)->contact.mesh_from_body;
        const Vec3 local = from_bullet(basis.at(id).transpose() * impulse);
        contacts.push_back({.body = id,
                            .other = other,
                            .point = mesh_from_body.to_world(from_bullet(where)),
                            .impulse = mesh_from_body.orientation * local});
      };
      add(a, b, point.m_localPointA, on_a);
      add(b, a, point.m_localPointB, -on_a);
    }
  }
}

RigidWorld::RigidWorld(double size) : state_(std::make_unique<State>(size)) {}
RigidWorld::~RigidWorld() = default;

int RigidWorld::add_ball(const Ball& ball) {
  auto body = std::make_unique<Body>();
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(ball.radius, 3);
  body->frame.mass = ball.material.density * volume;
  body->frame.inertia = Vec3::Constant(0.4 * body->frame.mass * ball.radius * ball.radius);
  body->reach = ball.radius;
  body->contact.radius = ball.radius;
  body->shapes.push_back(std::make_unique<btSphereShape>(ball.radius));
  return state_->add(std::move(body), ball.material,
                     {.pose = {.position = ball.position}, .velocity = ball.velocity});
}

int RigidWorld::add_solid(const RigidSolid& solid, const BodyState& state) {
  auto body = std::make_unique<Body>();
  body->surface = solid.surface;
  body->frame = solid.frame;
  for (const Collider::Part& part : solid.collider.parts) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& vertex : part.vertices) {
      const Vec3 local = solid.frame.to_body(vertex);
      body->reach = std::max(body->reach, local.norm());
      hull->addPoint(to_bullet(local), false);
    }
    hull->recalcLocalAabb();
    hull->setMargin(part.margin);
    body->shapes.push_back(std::move(hull));
  }
  body->reach = std::max(body->reach, solid.surface->farthest_from(solid.frame.center));
  if (body->shapes.size() > 1) {
    auto compound = std::make_unique<btCompoundShape>();
    for (const auto& part : body->shapes) {
      compound->addChildShape(btTransform::getIdentity(), part.get());
    }
    body->shapes.push_back(std::move(compound));
  }
  return state_->add(std::move(body), solid.material, state);
}

void RigidWorld::remove(int body) {
  const auto found = state_->bodies.find(body);
  state_->world.removeRigidBody(found->second->rigid.get());
  state_->bodies.erase(found);
}

BodyState RigidWorld::state(int body) const { return state_->state_of(*state_->bodies.at(body)); }

const MassFrame& RigidWorld::frame(int body) const { return state_->bodies.at(body)->frame; }

std::shared_ptr<const RigidWorld::Snapshot> RigidWorld::save() const {
  auto snapshot = std::make_shared<Snapshot>();
  for (const auto& [id, body] : state_->bodies) {
    snapshot->motions[id] = {.transform = body->rigid->getWorldTransform(),
                             .velocity = body->rigid->getLinearVelocity(),
                             .angular_velocity = body->rigid->getAngularVelocity()};
  }
  snapshot->allowed = state_->world.allowed;
  snapshot->newborn = state_->world.newborn;
  return snapshot;
}

void RigidWorld::restore(const Snapshot& snapshot) {
  for (const auto& [id, motion] : snapshot.motions) {
    const auto found = state_->bodies.find(id);
    if (found == state_->bodies.end()) continue;
    btRigidBody& rigid = *found->second->rigid;
    rigid.setCenterOfMassTransform(motion.transform);
    rigid.setLinearVelocity(motion.velocity);
    rigid.setAngularVelocity(motion.angular_velocity);
    rigid.setInterpolationWorldTransform(motion.transform);
    rigid.setInterpolationLinearVelocity(motion.velocity);
    rigid.setInterpolationAngularVelocity(motion.angular_velocity);
  }
  for (int m = 0; m < state_->dispatcher.getNumManifolds(); ++m) {
    state_->dispatcher.getManifoldByIndexInternal(m)->clearManifold();
  }
  state_->world.allowed = snapshot.allowed;
  state_->world.newborn = snapshot.newborn;
}

std::vector<BodyContact> RigidWorld::advance(double seconds) {
  std::vector<BodyContact> contacts;
  const double shortest = seconds / kMaxSteps;
  double left = seconds;
  int touches = 0;
  bool ball_touches = false;
  while (left > 1e-9 * seconds) {
    double longest = state_->longest_step(left);
    // The solid that a ball touches leaves this step at about the ball's speed.
    if (ball_touches && state_->bodies.size() > 2) {
      longest = std::min(longest, kStepShare * state_->size / state_->fastest_ball());
    }
    longest = std::max(longest, shortest);
    // A rest that is much shorter than a step would be lost to rounding.
    double span = left < 1.0001 * longest ? left : longest;
    ball_touches = false;
    if (touches < kMaxTouches) {
      if (const auto touch = state_->next_touch(span)) {
        ++touches;
        ball_touches = true;
        span = *touch;
      }
    }
    state_->step(span, contacts);
    left -= span;
  }
  return contacts;
}

double RigidWorld::deepest_overlap() const {
  double deepest = 0;
  for (int m = 0; m < state_->dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *state_->dispatcher.getManifoldByIndexInternal(m);
    if (is_ball(manifold.getBody0()) || is_ball(manifold.getBody1())) continue;
    for (int c = 0; c < manifold.getNumContacts(); ++c) {
      deepest = std::max(deepest, -manifold.getContactPoint(c).getDistance());
    }
  }
  return deepest;
}

}  // namespace fracbench
