// Whether any legal viewpoint's cameras see a point of the surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bench/limits/free_yaw_camera.hpp"
#include "bench/limits/legal_viewpoints.hpp"
#include "sensors/ray_scene.hpp"

namespace gnbv {

/// A line of sight ends this share of its length before the point, which lies on the surface.
constexpr float kSightEnd = 0.9999F;

/// Some points of which one that is seen settles it: those of a voxel, say.
struct SightItem {
  std::span<const Vec3f> points_world_m;
  std::size_t seen = kUnseen;  // index of a point that is seen

  static constexpr std::size_t kUnseen = static_cast<std::size_t>(-1);
  bool is_seen() const { return seen != kUnseen; }
};

/// Const after construction: any number of threads may ask at once.
class SightSearch {
 public:
  /// Keeps references to scene and viewpoints.
  SightSearch(const RayScene& scene, std::span<const CameraModel> cameras,
              const LegalViewpoints& legal, const Box3& navigation_m, double radius_m);

  /// The positions of the lattice from which a camera reaches into the box, shuffled, so that the
  /// first few look from all sides.
  std::vector<Vec3> positions_near(const Eigen::AlignedBox3d& box_world_m) const;

  /// Settles what positions_near() the items see: the first few of them, or all the others. Most
  /// surface is settled by the former.
  enum class Positions { first_few, others };
  void look_from_lattice(std::span<const Vec3> near_world_m, Positions which,
                         std::span<SightItem> items) const;

  /// Whether a viewpoint anywhere sees the point, not just one of the lattice: looks out from the
  /// point in kDirections directions, and along each that is free for places that are in the
  /// navigation box, keep the radius, are reached from a legal position of the lattice on a clear
  /// leg of at most a cell, and have the point in a camera's image. What is found is certain. There
  /// are kTurns sets of directions, each in the gaps of the others: neighbouring points should be
  /// asked with different ones. `open`: not seen, but some direction is free as far as cameras
  /// reach.
  enum class Look { seen, open, closed };
  Look look_out(const Vec3f& point_world_m, std::size_t turn) const;

  static constexpr std::size_t kDirections = 256;
  static constexpr std::size_t kTurns = 16;

 private:
  void add_packets(std::vector<Vec3f> directions);
  void look(const Vec3& position_m, std::size_t first_point, std::size_t points,
            std::span<SightItem> items) const;
  bool is_seen_along(const Vec3f& point_m, const Vec3f& direction, double free_m) const;
  using Cell = std::array<std::int32_t, 3>;
  /// Whether one may be there, in the lattice's cell above `low`.
  bool is_legal(const Vec3& vehicle_m, const Cell& low) const;
  template <typename Use>
  bool any_corner(const Cell& low, const Use& use) const;
  std::size_t node(const Cell& cell) const;
  void map_lattice();

  const RayScene& scene_;
  const LegalViewpoints& legal_;
  Box3 navigation_m_;
  double radius_m_;
  std::vector<FreeYawCamera> cameras_;
  double reach_m_ = 0.0;
  Vec3 corner_m_ = Vec3::Zero();  // of the lattice
  Cell nodes_{};                  // along each axis
  // of each node, and of those that would be one before the first and after the last
  std::vector<std::uint32_t> position_at_;  // legal position, or none
  std::vector<std::uint8_t> is_near_;       // whether a corner of the cell above it is legal
  std::vector<Vec3> shuffled_m_;            // the legal positions
  std::vector<RayPacket> directions_;       // unit vectors spread over the sphere
};

}  // namespace gnbv
