// The only file that knows Bullet. Bullet finds contacts, answers them with impulses and moves the
// body; the free motion is ours, because Bullet's integrator is first order and does not conserve
// angular momentum and energy.
#include "sim/flight/vehicle.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {
namespace {

btVector3 to_bullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const Isometry& T) {
  btTransform transform;
  transform.setFromOpenGLMatrix(T.data());
  return transform;
}

Isometry from_bullet(const btTransform& transform) {
  Isometry T;
  transform.getOpenGLMatrix(T.data());
  return T;
}

/// exp(rotation vector).
Eigen::Matrix3d rotation(const Vec3& rotation_vector_rad) {
  const double angle_rad = rotation_vector_rad.norm();
  if (angle_rad < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle_rad, rotation_vector_rad / angle_rad).toRotationMatrix();
}

/// Triangles that never move; Bullet keeps pointers to the numbers.
struct StaticMesh {
  explicit StaticMesh(const TriangleMesh& from) : vertices_m(from.vertices_m), faces(from.faces) {
    // Bullet's tree names a face by its part and 21 bits, and counts two nodes a face in an int
    constexpr std::size_t kMostInPart = std::size_t{1} << 21U;
    constexpr std::size_t kMost = (std::size_t{1} << 30U) - 1;
    if (faces.size() > kMost) {
      throw BadInput(
          fmt::format("a mesh of {} faces: at most {} can be flown at", faces.size(), kMost));
    }
    for (std::size_t first = 0; first < faces.size(); first += kMostInPart) {
      btIndexedMesh part;
      part.m_numTriangles = static_cast<int>(std::min(kMostInPart, faces.size() - first));
      part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(&faces[first]);
      part.m_triangleIndexStride = sizeof faces[0];
      part.m_numVertices = static_cast<int>(vertices_m.size());
      part.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices_m.data());
      part.m_vertexStride = sizeof vertices_m[0];
      part.m_vertexType = PHY_FLOAT;
      triangles.addIndexedMesh(part, PHY_INTEGER);
    }
    shape = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
    shape->setMargin(0.0);  // contact where the triangles are, not 4 cm before
  }

  std::vector<Vec3f> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> faces;
  btTriangleIndexVertexArray triangles;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
};

void* allocate(std::size_t size) {
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

/// Bullet's settings; from now on it throws for want of memory instead of writing to address 0.
btDefaultCollisionConstructionInfo settings_of_bullet() {
  [[maybe_unused]] static const bool is_set = (btAlignedAllocSetCustom(allocate, std::free), true);
  return {};
}

}  // namespace

struct RigidVehicle::Scene {
  Scene(const AirframeParameters& airframe, const World& world_in, const Isometry& T_world_body)
      : hull_shape(btVector3(airframe.hull_radius_m, airframe.hull_radius_m,
                             0.5 * airframe.hull_height_m)) {
    has_ground = world_in.has_ground;
    if (has_ground) add_static(&ground_shape);
    add_static(world_in.structure);
    add_static(world_in.obstacles);
    terrain_shape = add_static(world_in.terrain);
    for (const MovingBody& mover : world_in.movers) {
      if (add_static(mover.mesh) == nullptr) continue;
      movers.push_back({statics.size() - 1, boxes_m.size() - 1, mover.motion});
    }
    begin_motion();
    add_body(airframe, T_world_body);
  }
  /// With the same meshes.
  Scene(const Scene& other, const AirframeParameters& airframe, const Isometry& T_world_body)
      : meshes(other.meshes),
        terrain_shape(other.terrain_shape),
        has_ground(other.has_ground),
        movers(other.movers),
        ticks(other.ticks),
        hull_shape(other.hull_shape) {
    if (has_ground) add_static(&ground_shape);
    for (const auto& mesh : meshes) add_static(*mesh);
    begin_motion();
    add_body(airframe, T_world_body);
  }
  ~Scene() {
    world.removeRigidBody(body.get());
    for (const auto& fixed : statics) world.removeRigidBody(fixed.get());
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void add_body(const AirframeParameters& airframe, const Isometry& T_world_body) {
    world.setGravity(btVector3(0, 0, 0));
    world.setForceUpdateAllAabbs(false);  // the boxes of what stands there never change
    reach_of_hull_m = std::hypot(airframe.hull_radius_m, 0.5 * airframe.hull_height_m);
    btRigidBody::btRigidBodyConstructionInfo info(airframe.mass_kg, nullptr, &hull_shape,
                                                  to_bullet(airframe.inertia_kg_m2));
    info.m_startWorldTransform = to_bullet(T_world_body);
    body = std::make_unique<btRigidBody>(info);
    body->setDamping(0.0, 0.0);
    body->setFlags(BT_DISABLE_WORLD_GRAVITY);  // replaces the flags: no gyroscopic term either
    body->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(body.get());
  }
  void add_static(btCollisionShape* shape) {
    statics.push_back(std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(0.0, nullptr, shape)));
    world.addRigidBody(statics.back().get());
  }
  /// The shape of a mesh that was added; none for one without faces.
  const btCollisionShape* add_static(const TriangleMesh& mesh) {
    if (mesh.faces.empty()) return nullptr;
    meshes.push_back(std::make_shared<StaticMesh>(mesh));
    add_static(*meshes.back());
    return meshes.back()->shape.get();
  }
  void add_static(const StaticMesh& mesh) {
    add_static(mesh.shape.get());
    auto& [low_m, high_m] = boxes_m.emplace_back();
    mesh.shape->getAabb(btTransform::getIdentity(), low_m, high_m);
  }

  struct Mover {
    std::size_t fixed, box;  // into `statics` and `boxes_m`
    BodyMotion motion;
    std::array<btVector3, 2> box_at_rest_m = {};
  };
  void begin_motion() {
    for (Mover& mover : movers) {
      mover.box_at_rest_m = boxes_m[mover.box];
      statics[mover.fixed]->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    }
    move_bodies();
  }
  /// Where they are at this tick.
  void move_bodies() {
    for (const Mover& mover : movers) {
      const btVector3 offset_m =
          to_bullet(mover.motion.offset_at(static_cast<double>(ticks) * kTick_s));
      btTransform T = btTransform::getIdentity();
      T.setOrigin(offset_m);
      statics[mover.fixed]->setWorldTransform(T);
      world.updateSingleAabb(statics[mover.fixed].get());
      for (int i = 0; i < 2; ++i) boxes_m[mover.box][i] = mover.box_at_rest_m[i] + offset_m;
    }
  }

  /// Whether the hull could come near anything that stands there within a tick.
  bool is_near_something(const btVector3& v_m_s) const {
    constexpr double kMargin_m = 0.1;  // above Bullet's margin of shapes and threshold of contacts
    const btVector3 center_m = body->getWorldTransform().getOrigin();
    const double reach_m = reach_of_hull_m + kTick_s * v_m_s.length() + kMargin_m;
    const btVector3 reach(reach_m, reach_m, reach_m);
    if (has_ground && center_m.z() <= reach_m) return true;
    return std::ranges::any_of(boxes_m, [&](const auto& box) {
      return TestAabbAgainstAabb2(center_m - reach, center_m + reach, box[0], box[1]);
    });
  }

  // Bullet keeps pointers: declared in order of need, so destroyed in reverse.
  std::vector<std::shared_ptr<StaticMesh>> meshes;
  const btCollisionShape* terrain_shape = nullptr;
  bool has_ground = false;
  std::vector<Mover> movers;
  std::int64_t ticks = 0;
  double reach_of_hull_m = 0.0;
  std::vector<std::array<btVector3, 2>> boxes_m;  // of the meshes
  btStaticPlaneShape ground_shape{btVector3(0, 0, 1), 0.0};
  btCylinderShapeZ hull_shape;
  btDefaultCollisionConfiguration configuration{settings_of_bullet()};
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btRigidBody>> statics;
  std::unique_ptr<btRigidBody> body;
};

RigidVehicle::RigidVehicle(const AirframeParameters& airframe, const World& world,
                           const VehicleState& start, const RotorSpeeds& start_rad_s)
    : airframe_(airframe),
      lag_(rotor_lag(airframe, kRateStep_s)),
      state_(start),
      v_world_m_s_(start.v_world_m_s),
      speeds_rad_s_(start_rad_s) {
  check();
  const Eigen::Matrix3d R = state_.T_world_body.linear();
  angular_momentum_world_n_m_s_ = R * airframe_.inertia_kg_m2.cwiseProduct(state_.omega_body_rad_s);
  scene_ = std::make_unique<Scene>(airframe, world, start.T_world_body);
}

RigidVehicle::RigidVehicle(const RigidVehicle& other)
    : airframe_(other.airframe_),
      lag_(other.lag_),
      state_(other.state_),
      v_world_m_s_(other.v_world_m_s_),
      angular_momentum_world_n_m_s_(other.angular_momentum_world_n_m_s_),
      speeds_rad_s_(other.speeds_rad_s_),
      thrust_n_(other.thrust_n_),
      has_touched_structure_(other.has_touched_structure_),
      has_touched_ground_(other.has_touched_ground_) {
  btCollisionDispatcher& dispatcher = other.scene_->dispatcher;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    if (dispatcher.getManifoldByIndexInternal(i)->getNumContacts() > 0) {
      throw std::runtime_error("a vehicle that touches something cannot be copied");
    }
  }
  scene_ = std::make_unique<Scene>(*other.scene_, airframe_, state_.T_world_body);
}

RigidVehicle::~RigidVehicle() = default;

void RigidVehicle::check() const {
  GNBV_CHECK(state_.T_world_body.matrix().allFinite() && state_.v_world_m_s.allFinite() &&
                 state_.omega_body_rad_s.allFinite() &&
                 std::ranges::all_of(speeds_rad_s_, [](double x) { return std::isfinite(x); }),
             "the vehicle's state became NaN or infinite");
}

Vec3 RigidVehicle::omega_world(const Eigen::Matrix3d& R_world_body, const Vec3& L_world) const {
  return R_world_body * (R_world_body.transpose() * L_world).cwiseQuotient(airframe_.inertia_kg_m2);
}

Wrench RigidVehicle::turn_rotors(const RateControl& control, const Vec3& wind_world_m_s) {
  // through the air, as gazebo_motor_model.cpp has it
  const Vec3 v_body_m_s =
      state_.T_world_body.linear().transpose() * (state_.v_world_m_s - wind_world_m_s);
  Vec3 omega = state_.omega_body_rad_s;
  Wrench mean;
  for (int k = 0; k < kRateStepsPerTick; ++k) {
    const RotorSpeeds reference_rad_s = control(omega);
    const Wrench wrench = rotor_wrench(airframe_, speeds_rad_s_, v_body_m_s, omega);
    mean.force_body_n += wrench.force_body_n / kRateStepsPerTick;
    mean.torque_body_n_m += wrench.torque_body_n_m / kRateStepsPerTick;
    mean.thrust_n += wrench.thrust_n / kRateStepsPerTick;
    const Vec3 L_body = airframe_.inertia_kg_m2.cwiseProduct(omega);
    omega += kRateStep_s *
             (wrench.torque_body_n_m - omega.cross(L_body)).cwiseQuotient(airframe_.inertia_kg_m2);
    for (std::size_t i = 0; i < airframe_.rotors.size(); ++i) {
      speeds_rad_s_[i] = rotor_speed_after(lag_, speeds_rad_s_[i], reference_rad_s[i]);
    }
  }
  return mean;
}

Vec3 RigidVehicle::feel_contacts(const Vec3& v_free_world_m_s) {
  Vec3 v = v_free_world_m_s;
  for (int i = 0; i < scene_->dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *scene_->dispatcher.getManifoldByIndexInternal(i);
    const bool is_first = manifold.getBody0() == scene_->body.get();
    const btCollisionShape* const other =
        (is_first ? manifold.getBody1() : manifold.getBody0())->getCollisionShape();
    const bool is_ground = other == &scene_->ground_shape || other == scene_->terrain_shape;
    bool& has_touched = is_ground ? has_touched_ground_ : has_touched_structure_;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      has_touched = has_touched || point.getDistance() <= 0.0;
      if (point.getAppliedImpulse() <= 0.0) continue;
      const Vec3 outwards = (is_first ? 1.0 : -1.0) * from_bullet(point.m_normalWorldOnB);
      v -= std::min(0.0, v.dot(outwards)) * outwards;
    }
  }
  return v;
}

void RigidVehicle::step(const RateControl& control, const Vec3& wind_world_m_s) {
  const Eigen::Matrix3d R0 = state_.T_world_body.linear();
  const Vec3 omega0_world = R0 * state_.omega_body_rad_s;

  const Wrench wrench = turn_rotors(control, wind_world_m_s);
  const Vec3 a_world =
      R0 * wrench.force_body_n / airframe_.mass_kg - airframe_.gravity_m_s2 * Vec3::UnitZ();
  const Vec3 torque_world = R0 * wrench.torque_body_n_m;

  // Bullet moves the body with the velocities of mid-tick, found from the momenta: second order,
  // exact under constant force, and without torque the angular momentum stays what it is.
  const Vec3 v_mid_world = v_world_m_s_ + 0.5 * kTick_s * a_world;
  const Vec3 L_mid_world = angular_momentum_world_n_m_s_ + 0.5 * kTick_s * torque_world;
  Vec3 omega_mid_world = omega_world(rotation(0.5 * kTick_s * omega0_world) * R0, L_mid_world);
  omega_mid_world = omega_world(rotation(0.5 * kTick_s * omega_mid_world) * R0, L_mid_world);
  btRigidBody& body = *scene_->body;
  ++scene_->ticks;
  scene_->move_bodies();
  body.setLinearVelocity(to_bullet(v_mid_world));
  body.setAngularVelocity(to_bullet(omega_mid_world));
  const bool is_near = scene_->is_near_something(body.getLinearVelocity());
  if (is_near) {
    scene_->world.stepSimulation(kTick_s, 0);
  } else {  // the same motion, without a search for contacts
    btTransform after;
    body.predictIntegratedTransform(kTick_s, after);
    body.proceedToTransform(after);
  }

  state_.T_world_body = from_bullet(body.getWorldTransform());
  Vec3 v_world = v_mid_world;
  angular_momentum_world_n_m_s_ += kTick_s * torque_world;
  if (is_near && scene_->dispatcher.getNumManifolds() > 0) {  // what the contacts changed
    v_world = from_bullet(body.getLinearVelocity());
    const Vec3 d_omega_world = from_bullet(body.getAngularVelocity()) - omega_mid_world;
    angular_momentum_world_n_m_s_ +=
        R0 * airframe_.inertia_kg_m2.cwiseProduct(R0.transpose() * d_omega_world);
  }
  v_world_m_s_ = v_world + 0.5 * kTick_s * a_world;
  state_.v_world_m_s = is_near ? feel_contacts(v_world_m_s_) : v_world_m_s_;
  const Eigen::Matrix3d R1 = state_.T_world_body.linear();
  state_.omega_body_rad_s = R1.transpose() * omega_world(R1, angular_momentum_world_n_m_s_);
  thrust_n_ = wrench.thrust_n;
  check();
}

}  // namespace gnbv
