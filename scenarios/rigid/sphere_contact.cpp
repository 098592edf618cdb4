#include "scenarios/rigid/sphere_contact.h"

#include <BulletCollision/CollisionDispatch/btActivatingCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <btBulletCollisionCommon.h>

#include <cmath>

namespace fracbench {

namespace {

constexpr double kCosineBetweenContacts = 0.819;  // 35 degrees
constexpr std::size_t kMaxContacts = 4;           // what one of the engine's manifolds holds

class SphereSurfaceAlgorithm final : public btActivatingCollisionAlgorithm {
 public:
  SphereSurfaceAlgorithm(const btCollisionAlgorithmConstructionInfo& info,
                         const btCollisionObjectWrapper* first,
                         const btCollisionObjectWrapper* second, bool sphere_is_second)
      : btActivatingCollisionAlgorithm(info, first, second),
        manifold_(m_dispatcher->getNewManifold(first->getCollisionObject(),
                                               second->getCollisionObject())),
        sphere_is_second_(sphere_is_second) {}
  ~SphereSurfaceAlgorithm() override { m_dispatcher->releaseManifold(manifold_); }

  void processCollision(const btCollisionObjectWrapper* first,
                        const btCollisionObjectWrapper* second, const btDispatcherInfo&,
                        btManifoldResult* result) override {
    const auto* sphere = (sphere_is_second_ ? second : first)->getCollisionObject();
    const auto* solid = (sphere_is_second_ ? first : second)->getCollisionObject();
    const auto& ball = *static_cast<const ContactSurface*>(sphere->getUserPointer());
    const auto& body = *static_cast<const ContactSurface*>(solid->getUserPointer());
    result->setPersistentManifold(manifold_);
    manifold_->clearManifold();
    if (body.surface == nullptr) return;

    const btTransform& world_from_body = solid->getWorldTransform();
    const btVector3 local = world_from_body.invXform(sphere->getWorldTransform().getOrigin());
    const Vec3 center = body.mesh_from_body.to_world({local.x(), local.y(), local.z()});
    for (const SphereContact& contact : sphere_contacts(*body.surface, center, ball.radius)) {
      const Vec3 p = body.mesh_from_body.to_local(contact.point);
      const Vec3 n = body.mesh_from_body.orientation.conjugate() * contact.normal;
      const btVector3 on_solid = world_from_body * btVector3(p.x(), p.y(), p.z());
      const btVector3 normal = world_from_body.getBasis() * btVector3(n.x(), n.y(), n.z());
      const double gap = std::abs(contact.gap) <= 2 * kTouch ? 0.0 : contact.gap;
      // The engine wants the point on its second body and the normal from the second to the first.
      if (sphere_is_second_) {
        result->addContactPoint(-normal, on_solid + normal * gap, gap);
      } else {
        result->addContactPoint(normal, on_solid, gap);
      }
    }
  }

  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    manifolds.push_back(manifold_);
  }

  struct Create final : public btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm* CreateCollisionAlgorithm(
        btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* first,
        const btCollisionObjectWrapper* second) override {
      void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(SphereSurfaceAlgorithm));
      return new (memory) SphereSurfaceAlgorithm(info, first, second, m_swapped);
    }
  };

 private:
  btPersistentManifold* manifold_;
  bool sphere_is_second_;
};

btCollisionAlgorithmCreateFunc* create_function(bool sphere_is_second) {
  static SphereSurfaceAlgorithm::Create sphere_first;
  static SphereSurfaceAlgorithm::Create sphere_last = [] {
    SphereSurfaceAlgorithm::Create create;
    create.m_swapped = true;
    return create;
  }();
  return sphere_is_second ? &sphere_last : &sphere_first;
}

}  // namespace

std::vector<SphereContact> sphere_contacts(const SurfaceTree& surface, const Vec3& center,
                                           double radius, double reach) {
  std::vector<SphereContact> contacts;
  for (const SurfacePoint& near : surface.within(center, radius + reach)) {
    if (contacts.size() == kMaxContacts) break;
    if (!(near.distance > 0)) continue;
    const Vec3 normal = (center - near.point) / near.distance;
    bool is_new = true;
    for (const SphereContact& other : contacts) {
      is_new = is_new && normal.dot(other.normal) < kCosineBetweenContacts;
    }
    if (is_new) {
      contacts.push_back({.point = near.point, .normal = normal, .gap = near.distance - radius});
    }
  }
  return contacts;
}

void register_sphere_contact(btCollisionDispatcher& dispatcher) {
  for (const int solid : {CONVEX_HULL_SHAPE_PROXYTYPE, COMPOUND_SHAPE_PROXYTYPE}) {
    dispatcher.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, solid, create_function(false));
    dispatcher.registerCollisionCreateFunc(solid, SPHERE_SHAPE_PROXYTYPE, create_function(true));
  }
}

}  // namespace fracbench
