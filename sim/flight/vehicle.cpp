// The only file that knows Bullet. Bullet finds contacts, answers them with impulses and moves the
// body; the free motion is ours, because Bullet's integrator is first order and does not conserve
// angular momentum and energy.
#include "sim/flight/vehicle.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/mesh/world.hpp"

namespace gnbv {
namespace {

btVector3 to_bullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const Isometry& T) {
  const Eigen::Matrix3d R = T.linear();
  return btTransform(
      btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
      to_bullet(Vec3(T.translation())));
}

Isometry from_bullet(const btTransform& transform) {
  Isometry T = Isometry::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      T.linear()(row, column) = transform.getBasis()[row][column];
    }
  }
  T.translation() = from_bullet(transform.getOrigin());
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
  explicit StaticMesh(const TriangleMesh& mesh) {
    for (const Vec3f& v : mesh.vertices_m) {
      coordinates_m.insert(coordinates_m.end(), {v.x(), v.y(), v.z()});
    }
    for (const auto& face : mesh.faces) {
      for (const std::uint32_t vertex : face) indices.push_back(static_cast<int>(vertex));
    }
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(mesh.faces.size());
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices.data());
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_numVertices = static_cast<int>(mesh.vertices_m.size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(coordinates_m.data());
    part.m_vertexStride = 3 * sizeof(float);
    part.m_vertexType = PHY_FLOAT;
    triangles.addIndexedMesh(part, PHY_INTEGER);
    shape = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
    shape->setMargin(0.0);  // contact where the triangles are, not 4 cm before
  }

  std::vector<int> indices;
  std::vector<float> coordinates_m;
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
  Scene(const AirframeParameters& airframe_in, const World& world_in, const VehicleState& start,
        const RotorSpeeds& start_rad_s);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void add_static(btCollisionShape* shape);
  /// The shape of a mesh that was added; none for one without faces.
  const btCollisionShape* add_static(const TriangleMesh& mesh);
  bool is_ground(const btCollisionShape* shape) const;
  /// Notes what the hull touches, and takes away the part of the velocity that leads into it.
  Vec3 feel_contacts(const Vec3& v_world_m_s);
  /// Turns the rotors through one tick; their mean wrench.
  Wrench turn_rotors(const RateControl& control, const Vec3& wind_world_m_s);
  /// Angular velocity, in world axes, of a body at attitude R with this angular momentum.
  Vec3 omega_world(const Eigen::Matrix3d& R_world_body, const Vec3& L_world) const {
    return R_world_body *
           (R_world_body.transpose() * L_world).cwiseQuotient(airframe.inertia_kg_m2);
  }

  AirframeParameters airframe;
  VehicleState state;
  // The momenta, kept so that rounding alone can change them. At rest on the ground the velocity
  // here is that of half a tick of free fall, which Bullet takes away in the middle of the tick.
  Vec3 v_world_m_s;
  Vec3 angular_momentum_world_n_m_s = Vec3::Zero();
  RotorSpeeds speeds_rad_s;
  double thrust_n = 0.0;
  bool has_touched_structure = false;
  bool has_touched_ground = false;

  // Bullet keeps pointers: declared in order of need, so destroyed in reverse.
  std::vector<std::unique_ptr<StaticMesh>> meshes;
  const btCollisionShape* terrain_shape = nullptr;
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

RigidVehicle::Scene::Scene(const AirframeParameters& airframe_in, const World& world_in,
                           const VehicleState& start, const RotorSpeeds& start_rad_s)
    : airframe(airframe_in),
      state(start),
      v_world_m_s(start.v_world_m_s),
      speeds_rad_s(start_rad_s),
      hull_shape(btVector3(airframe_in.hull_radius_m, airframe_in.hull_radius_m,
                           0.5 * airframe_in.hull_height_m)) {
  world.setGravity(btVector3(0, 0, 0));
  world.setForceUpdateAllAabbs(false);  // the boxes of what stands there never change
  if (world_in.has_ground) add_static(&ground_shape);

  add_static(world_in.structure);
  add_static(world_in.obstacles);
  terrain_shape = add_static(world_in.terrain);

  btRigidBody::btRigidBodyConstructionInfo info(airframe.mass_kg, nullptr, &hull_shape,
                                                to_bullet(airframe.inertia_kg_m2));
  info.m_startWorldTransform = to_bullet(state.T_world_body);
  body = std::make_unique<btRigidBody>(info);
  body->setDamping(0.0, 0.0);
  body->setFlags(BT_DISABLE_WORLD_GRAVITY);  // replaces the flags: no gyroscopic term either
  body->setActivationState(DISABLE_DEACTIVATION);
  world.addRigidBody(body.get());

  const Eigen::Matrix3d R = state.T_world_body.linear();
  angular_momentum_world_n_m_s = R * airframe.inertia_kg_m2.cwiseProduct(state.omega_body_rad_s);
}

RigidVehicle::Scene::~Scene() {
  world.removeRigidBody(body.get());
  for (const auto& fixed : statics) world.removeRigidBody(fixed.get());
}

void RigidVehicle::Scene::add_static(btCollisionShape* shape) {
  statics.push_back(
      std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0.0, nullptr, shape)));
  world.addRigidBody(statics.back().get());
}

const btCollisionShape* RigidVehicle::Scene::add_static(const TriangleMesh& mesh) {
  if (mesh.faces.empty()) return nullptr;
  meshes.push_back(std::make_unique<StaticMesh>(mesh));
  add_static(meshes.back()->shape.get());
  return meshes.back()->shape.get();
}

bool RigidVehicle::Scene::is_ground(const btCollisionShape* shape) const {
  return shape == &ground_shape || shape == terrain_shape;
}

Vec3 RigidVehicle::Scene::feel_contacts(const Vec3& v_free_world_m_s) {
  Vec3 v = v_free_world_m_s;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const bool is_first = manifold.getBody0() == body.get();
    const btCollisionObject* other = is_first ? manifold.getBody1() : manifold.getBody0();
    bool& has_touched =
        is_ground(other->getCollisionShape()) ? has_touched_ground : has_touched_structure;
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

RigidVehicle::RigidVehicle(const AirframeParameters& airframe, const World& world,
                           const VehicleState& start, const RotorSpeeds& start_rad_s) {
  GNBV_CHECK(start.T_world_body.matrix().allFinite() && start.v_world_m_s.allFinite() &&
                 start.omega_body_rad_s.allFinite(),
             "the vehicle starts at a pose or velocity that is not finite");
  scene_ = std::make_unique<Scene>(airframe, world, start, start_rad_s);
}

RigidVehicle::~RigidVehicle() = default;

const VehicleState& RigidVehicle::state() const { return scene_->state; }
const RotorSpeeds& RigidVehicle::rotor_speeds_rad_s() const { return scene_->speeds_rad_s; }
double RigidVehicle::thrust_n() const { return scene_->thrust_n; }
bool RigidVehicle::has_touched_structure() const { return scene_->has_touched_structure; }
bool RigidVehicle::has_touched_ground() const { return scene_->has_touched_ground; }

Wrench RigidVehicle::Scene::turn_rotors(const RateControl& control, const Vec3& wind_world_m_s) {
  // through the air, as gazebo_motor_model.cpp has it
  const Vec3 v_body_m_s =
      state.T_world_body.linear().transpose() * (state.v_world_m_s - wind_world_m_s);
  Vec3 omega = state.omega_body_rad_s;
  Wrench mean;
  for (int k = 0; k < kRateStepsPerTick; ++k) {
    const RotorSpeeds reference_rad_s = control(omega);
    const Wrench wrench = rotor_wrench(airframe, speeds_rad_s, v_body_m_s, omega);
    mean.force_body_n += wrench.force_body_n / kRateStepsPerTick;
    mean.torque_body_n_m += wrench.torque_body_n_m / kRateStepsPerTick;
    mean.thrust_n += wrench.thrust_n / kRateStepsPerTick;
    const Vec3 L_body = airframe.inertia_kg_m2.cwiseProduct(omega);
    omega += kRateStep_s *
             (wrench.torque_body_n_m - omega.cross(L_body)).cwiseQuotient(airframe.inertia_kg_m2);
    for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
      speeds_rad_s[i] =
          rotor_speed_after(airframe, speeds_rad_s[i], reference_rad_s[i], kRateStep_s);
    }
  }
  return mean;
}

void RigidVehicle::step(const RateControl& control, const Vec3& wind_world_m_s) {
  Scene& s = *scene_;
  const Eigen::Matrix3d R0 = s.state.T_world_body.linear();
  const Vec3 omega0_world = R0 * s.state.omega_body_rad_s;

  const Wrench wrench = s.turn_rotors(control, wind_world_m_s);
  const Vec3 a_world =
      R0 * wrench.force_body_n / s.airframe.mass_kg - s.airframe.gravity_m_s2 * Vec3::UnitZ();
  const Vec3 torque_world = R0 * wrench.torque_body_n_m;

  // Bullet moves the body with the velocities of mid-tick, found from the momenta: second order,
  // exact under constant force, and without torque the angular momentum stays what it is.
  const Vec3 v_mid_world = s.v_world_m_s + 0.5 * kTick_s * a_world;
  const Vec3 L_mid_world = s.angular_momentum_world_n_m_s + 0.5 * kTick_s * torque_world;
  Vec3 omega_mid_world = s.omega_world(rotation(0.5 * kTick_s * omega0_world) * R0, L_mid_world);
  omega_mid_world = s.omega_world(rotation(0.5 * kTick_s * omega_mid_world) * R0, L_mid_world);
  s.body->setLinearVelocity(to_bullet(v_mid_world));
  s.body->setAngularVelocity(to_bullet(omega_mid_world));
  s.world.stepSimulation(kTick_s, 0);

  s.state.T_world_body = from_bullet(s.body->getWorldTransform());
  Vec3 v_world = v_mid_world;
  s.angular_momentum_world_n_m_s += kTick_s * torque_world;
  if (s.dispatcher.getNumManifolds() > 0) {  // what the contacts changed
    v_world = from_bullet(s.body->getLinearVelocity());
    const Vec3 d_omega_world = from_bullet(s.body->getAngularVelocity()) - omega_mid_world;
    s.angular_momentum_world_n_m_s +=
        R0 * s.airframe.inertia_kg_m2.cwiseProduct(R0.transpose() * d_omega_world);
  }
  s.v_world_m_s = v_world + 0.5 * kTick_s * a_world;
  s.state.v_world_m_s = s.feel_contacts(s.v_world_m_s);
  const Eigen::Matrix3d R1 = s.state.T_world_body.linear();
  s.state.omega_body_rad_s = R1.transpose() * s.omega_world(R1, s.angular_momentum_world_n_m_s);
  s.thrust_n = wrench.thrust_n;
  GNBV_CHECK(s.state.T_world_body.matrix().allFinite() && s.state.v_world_m_s.allFinite() &&
                 s.state.omega_body_rad_s.allFinite() &&
                 std::ranges::all_of(s.speeds_rad_s, [](double x) { return std::isfinite(x); }),
             "the vehicle's state became NaN or infinite");
}

}  // namespace gnbv
