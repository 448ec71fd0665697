#include "sensors/ray_scene.hpp"

#include <algorithm>
#include <cstring>

#include "sensors/embree_scene.hpp"
#include "sensors/frames.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kPacket = RayPacket::kRays;

using Lanes = std::array<int, kPacket>;  // -1 for those that Embree traces

void trace(const EmbreeScene& world, const Lanes& valid, float far_m, RTCRayHit16& packet) {
  std::fill_n(packet.ray.tfar, kPacket, far_m);
  std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
  intersect16(valid.data(), world.scene.get(), packet, !world.is_portable);
}

// These two read everything first and then choose, so that the compiler can do 16 lanes at once.
float distance_of(const RTCRayHit16& answer, std::size_t lane) {
  const float tfar = answer.ray.tfar[lane];
  return answer.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ? kNoReturn : tfar;
}
std::int32_t face_of(const EmbreeScene& world, const RTCRayHit16& answer, std::size_t lane) {
  const unsigned id = answer.hit.geomID[lane];
  const std::uint32_t obstacle = id == EmbreeScene::obstacles ? world.first_face[1] : 0;
  const std::uint32_t terrain = id == EmbreeScene::terrain ? world.first_face[2] : 0;
  const auto hit = static_cast<std::int32_t>(answer.hit.primID[lane] + obstacle + terrain);
  const std::int32_t of_something = id == EmbreeScene::ground ? kGroundFace : hit;
  return id == RTC_INVALID_GEOMETRY_ID ? kNoFace : of_something;
}

/// Calls store(i, answer) for each packet of rays from the origin; also(valid, answer) before it
/// may change the answer.
template <typename Also, typename Store>
void trace_packets(const EmbreeScene& world, const Also& also, const Vec3f& origin_world_m,
                   std::span<const RayPacket> directions_world, float near_m, float far_m,
                   const Store& store) {
  RTCRayHit16 packet{};  // Embree writes only tfar and the hit
  std::fill_n(packet.ray.org_x, kPacket, origin_world_m.x());
  std::fill_n(packet.ray.org_y, kPacket, origin_world_m.y());
  std::fill_n(packet.ray.org_z, kPacket, origin_world_m.z());
  std::fill_n(packet.ray.tnear, kPacket, near_m);
  std::fill_n(packet.ray.mask, kPacket, kAllParts);
  alignas(64) Lanes valid{};
  valid.fill(-1);
  for (std::size_t i = 0; i < directions_world.size(); ++i) {
    // memcpy, which unlike copy_n becomes a few moves in place
    std::memcpy(packet.ray.dir_x, directions_world[i].x.data(), sizeof packet.ray.dir_x);
    std::memcpy(packet.ray.dir_y, directions_world[i].y.data(), sizeof packet.ray.dir_y);
    std::memcpy(packet.ray.dir_z, directions_world[i].z.data(), sizeof packet.ray.dir_z);
    trace(world, valid, far_m, packet);
    also(valid, packet);
    store(i, packet);
  }
}

/// Loads the rays of the parts into `ray`, up to 16 at a time, calls trace(valid), and store(i,
/// lane) for each of them. Lanes left over repeat the last ray, and `valid` leaves them out.
template <typename Trace, typename Store>
void for_each_ray(std::span<const Vec3f> origins_world_m, std::span<const Vec3f> directions_world,
                  float near_m, unsigned parts, RTCRay16& ray, const Trace& trace,
                  const Store& store) {
  const std::size_t count = directions_world.size();
  GNBV_CHECK(origins_world_m.size() == count || origins_world_m.size() == 1,
             "{} origins for {} directions", origins_world_m.size(), count);
  std::fill_n(ray.tnear, kPacket, near_m);
  std::fill_n(ray.mask, kPacket, parts);
  alignas(64) Lanes valid{};
  for (std::size_t begin = 0; begin < count; begin += kPacket) {
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      const std::size_t i = std::min(begin + lane, count - 1);
      valid[lane] = begin + lane < count ? -1 : 0;
      const Vec3f& origin = origins_world_m[origins_world_m.size() == 1 ? 0 : i];
      ray.org_x[lane] = origin.x();
      ray.org_y[lane] = origin.y();
      ray.org_z[lane] = origin.z();
      ray.dir_x[lane] = directions_world[i].x();
      ray.dir_y[lane] = directions_world[i].y();
      ray.dir_z[lane] = directions_world[i].z();
    }
    trace(valid);
    for (std::size_t lane = 0; lane < std::min(kPacket, count - begin); ++lane) {
      store(begin + lane, lane);
    }
  }
}

void need_answers(std::size_t answers, std::size_t questions) {
  GNBV_CHECK(answers == questions, "{} answers for {} rays or packets", answers, questions);
}

/// So that rays meet a body that has moved by the offset where it stood.
void move_back(const Vec3& by_m, RTCRay16& rays) {
  const Vec3f offset_m = by_m.cast<float>();
  for (std::size_t lane = 0; lane < kPacket; ++lane) {
    rays.org_x[lane] -= offset_m.x();
    rays.org_y[lane] -= offset_m.y();
    rays.org_z[lane] -= offset_m.z();
  }
}

/// From which share of the edge to which a box that moves along it, from where it stands, holds the
/// point; from more than to where it never does.
std::pair<double, double> passage(const Vec3& p_m, const Vec3& edge_m, const Box3& box_m) {
  double from = 0.0, to = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low_m = p_m[axis] - box_m.max()[axis], high_m = p_m[axis] - box_m.min()[axis];
    if (edge_m[axis] == 0.0) {
      if (low_m > 0.0 || high_m < 0.0) return {1.0, 0.0};
      continue;
    }
    const double a = low_m / edge_m[axis], b = high_m / edge_m[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return {from, to};
}

/// All that is so near to the body, where it stands at time 0, and a little more.
Box3 surroundings_m(const EmbreeScene& body, double distance_m) {
  RTCBounds b{};
  rtcGetSceneBounds(body.scene.get(), &b);
  const Vec3 by_m = Vec3::Constant(distance_m + 1e-3);
  return {Vec3f(b.lower_x, b.lower_y, b.lower_z).cast<double>() - by_m,
          Vec3f(b.upper_x, b.upper_y, b.upper_z).cast<double>() + by_m};
}

}  // namespace

RayScene::RayScene(const World& world) : embree_(std::make_shared<const EmbreeScene>(world)) {
  auto first_face = static_cast<std::uint32_t>(embree_->meshes.faces.size());
  for (const MovingBody& mover : world.movers) {
    const World alone{.structure = {},
                      .has_ground = false,
                      .obstacles = mover.mesh,
                      .is_portable = world.is_portable};
    movers_.push_back(
        {std::make_shared<const EmbreeScene>(alone), mover.motion, Vec3::Zero(), first_face});
    first_face += static_cast<std::uint32_t>(mover.mesh.faces.size());
  }
}

RayScene RayScene::at(double time_s) const {
  RayScene now = *this;
  now.has_time_ = true;
  for (Mover& mover : now.movers_) mover.offset_m = mover.motion.offset_at(time_s);
  return now;
}

/// What the rays meet nearer than all else becomes a face of the obstacles, numbered on.
void RayScene::trace_movers(std::span<const int, kPacket> valid, float far_m,
                            RTCRayHit16& packet) const {
  if (!has_time_) return;
  Lanes lanes;
  std::ranges::copy(valid, lanes.begin());
  for (const Mover& mover : movers_) {
    RTCRayHit16 other = packet;
    move_back(mover.offset_m, other.ray);
    trace(*mover.body, lanes, far_m, other);
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      if (other.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
      const bool is_first = packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ||
                            other.ray.tfar[lane] < packet.ray.tfar[lane];
      if (lanes[lane] == 0 || !is_first) continue;
      packet.ray.tfar[lane] = other.ray.tfar[lane];
      packet.hit.geomID[lane] = EmbreeScene::obstacles;
      packet.hit.primID[lane] = other.hit.primID[lane] + mover.first_face - embree_->first_face[1];
    }
  }
}

void RayScene::find_blocked_by_movers(std::span<const int, kPacket> valid, RTCRay16& packet) const {
  if (!has_time_) return;
  Lanes lanes;
  std::ranges::copy(valid, lanes.begin());
  for (const Mover& mover : movers_) {
    RTCRay16 other = packet;
    move_back(mover.offset_m, other);
    occluded16(lanes.data(), mover.body->scene.get(), other, !mover.body->is_portable);
    std::ranges::copy(other.tfar, std::begin(packet.tfar));
  }
}

RayScene::MeshFace RayScene::mesh_of(std::int32_t face) const {
  GNBV_CHECK(face >= 0, "face {} is no mesh's", face);
  const auto index = static_cast<std::uint32_t>(face);
  const auto after =
      std::ranges::find_if(movers_, [&](const Mover& mover) { return mover.first_face > index; });
  if (after == movers_.begin()) return {&embree_->meshes, index};
  const Mover& mover = *std::prev(after);
  return {&mover.body->meshes, index - mover.first_face, mover.offset_m.cast<float>()};
}

void RayScene::first_hits(const Vec3f& origin_world_m, std::span<const RayPacket> directions_world,
                          float near_m, float far_m, std::span<HitPacket> hits) const {
  need_answers(hits.size(), directions_world.size());
  const auto also = [&](const Lanes& valid, RTCRayHit16& packet) {
    trace_movers(valid, far_m, packet);
  };
  trace_packets(*embree_, also, origin_world_m, directions_world, near_m, far_m,
                [&](std::size_t i, const RTCRayHit16& answer) {
                  HitPacket& out = hits[i];
                  for (std::size_t lane = 0; lane < kPacket; ++lane) {
                    out.distance_m[lane] = distance_of(answer, lane);
                    out.face[lane] = face_of(*embree_, answer, lane);
                  }
                });
}

void RayScene::first_distances(const Vec3f& origin_world_m,
                               std::span<const RayPacket> directions_world, float near_m,
                               float far_m,
                               std::span<std::array<float, kPacket>> distances_m) const {
  need_answers(distances_m.size(), directions_world.size());
  const auto also = [&](const Lanes& valid, RTCRayHit16& packet) {
    trace_movers(valid, far_m, packet);
  };
  trace_packets(*embree_, also, origin_world_m, directions_world, near_m, far_m,
                [&](std::size_t i, const RTCRayHit16& answer) {
                  std::array<float, kPacket>& out = distances_m[i];
                  for (std::size_t lane = 0; lane < kPacket; ++lane) {
                    out[lane] = distance_of(answer, lane);
                  }
                });
}

void RayScene::first_hits(std::span<const Vec3f> origins_world_m,
                          std::span<const Vec3f> directions_world, float near_m, float far_m,
                          std::span<RayHit> hits) const {
  need_answers(hits.size(), directions_world.size());
  RTCRayHit16 packet{};
  for_each_ray(
      origins_world_m, directions_world, near_m, kAllParts, packet.ray,
      [&](const Lanes& valid) {
        trace(*embree_, valid, far_m, packet);
        trace_movers(valid, far_m, packet);
      },
      [&](std::size_t i, std::size_t lane) {
        hits[i] = {distance_of(packet, lane), face_of(*embree_, packet, lane)};
      });
}

void RayScene::find_blocked(unsigned parts, std::span<const Vec3f> origins_world_m,
                            std::span<const Vec3f> directions_world, float near_m, float far_m,
                            std::span<std::uint8_t> blocked) const {
  need_answers(blocked.size(), directions_world.size());
  RTCRay16 packet{};
  for_each_ray(
      origins_world_m, directions_world, near_m, parts, packet,
      [&](const Lanes& valid) {
        std::fill_n(packet.tfar, kPacket, far_m);
        occluded16(valid.data(), embree_->scene.get(), packet, !embree_->is_portable);
        if ((parts & kObstaclePart) != 0) find_blocked_by_movers(valid, packet);
      },
      [&](std::size_t i, std::size_t lane) {
        blocked[i] = packet.tfar[lane] < 0.0F ? 1 : 0;  // occluded: Embree says -infinity
      });
}

bool RayScene::has_obstacles() const {
  return embree_->first_face[2] > embree_->first_face[1] || !movers_.empty();
}
bool RayScene::has_terrain() const { return embree_->first_face[3] > embree_->first_face[2]; }

Vec3f RayScene::normal_world(std::int32_t face) const {
  if (face == kGroundFace) return Vec3f::UnitZ();
  const auto [mesh, index, offset_m] = mesh_of(face);
  const auto& [a, b, c] = mesh->faces[index];
  const std::vector<Vec3f>& p = mesh->vertices_m;
  return (p[b] - p[a]).cross(p[c] - p[a]).stableNormalized();
}

const Material& RayScene::material(std::int32_t face) const {
  const auto [mesh, index, offset_m] = mesh_of(face);
  return mesh->materials[material_of(*mesh, index)];
}

double RayScene::distance_to_known_movers_m(const Vec3& p_world_m, double time_s,
                                            double limit_m) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Mover& mover : movers_) {
    if (!mover.motion.known) continue;
    const Vec3 p_m = p_world_m - mover.motion.offset_at(time_s);
    nearest_m = std::min(nearest_m, mover.body->distance_m(kObstaclePart, p_m, limit_m));
  }
  return nearest_m;
}

double RayScene::distance_to_surroundings_m(const Vec3& p_world_m, double limit_m) const {
  constexpr double kApart_m = 0.02;  // of a body's places
  double nearest_m = distance_m(kObstaclePart | kTerrainPart, p_world_m, limit_m);
  for (const Mover& mover : movers_) {
    const auto look_from = [&](double along_m) {
      const Vec3 p_m = p_world_m - mover.motion.offset_after(along_m);
      nearest_m = std::min(nearest_m, mover.body->distance_m(kObstaclePart, p_m, limit_m));
    };
    look_from(0.0);
    const std::vector<Vec3> corners_m = mover.motion.corners_m();
    const double length_m = mover.motion.length_m();
    double begin_m = 0.0;  // of the edge, along the way
    for (std::size_t i = 1; i < corners_m.size(); ++i) {
      const Vec3 edge_m = corners_m[i] - corners_m[i - 1];
      const double edge = edge_m.norm();
      const auto [from, to] = passage(p_world_m - corners_m[i - 1], edge_m,
                                      surroundings_m(*mover.body, std::min(limit_m, nearest_m)));
      if (from <= to) {  // and a place more at either end, for what is rounded
        const double last = std::ceil((begin_m + to * edge) / kApart_m) + 1.0;
        double k = std::max(0.0, std::floor((begin_m + from * edge) / kApart_m) - 1.0);
        for (; k <= last && (k - 1.0) * kApart_m < length_m; ++k) {
          look_from(std::min(k * kApart_m, length_m));
        }
      }
      begin_m += edge;
    }
  }
  return nearest_m;
}

std::array<float, 3> RayScene::albedo(std::int32_t face, const Vec3f& p_world_m,
                                      const Vec3f& normal_world) const {
  const auto [mesh, index, offset_m] = mesh_of(face);
  return gnbv::albedo(*mesh, index, p_world_m - offset_m, normal_world);
}

double RayScene::distance_m(unsigned parts, const Vec3& p_world_m, double limit_m) const {
  return embree_->distance_m(parts, p_world_m, limit_m);
}

}  // namespace gnbv
