#include "bench/score/point_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nanoflann.hpp>

#include "sim/core/error.hpp"

namespace gnbv {
namespace {

/// What nanoflann asks of a point set.
struct TreePoints {
  std::span<const Vec3f> points_m;
  std::size_t kdtree_get_point_count() const { return points_m.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points_m[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // let it look itself
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, TreePoints>,
                                                 TreePoints, 3, std::uint32_t>;

/// The nearest so far, nearest first, as nanoflann wants its result sets. Ties go to the lower
/// index, so that the answer does not depend on the tree.
class NearestSet {
 public:
  using DistanceType = float;
  NearestSet(std::span<Neighbour> found, float below_m)
      : found_(found), worst_m2_(below_m * below_m) {}

  bool addPoint(float distance_m2, std::uint32_t point) {
    const auto is_before = [&](const Neighbour& other) {
      return distance_m2 < other.distance_m ||
             (distance_m2 == other.distance_m && point < other.point);
    };
    if (full() && !is_before(found_.back())) return true;
    if (!full()) ++count_;
    std::size_t slot = count_ - 1;
    for (; slot > 0 && is_before(found_[slot - 1]); --slot) found_[slot] = found_[slot - 1];
    found_[slot] = {point, distance_m2};
    // the search leaves out what is not nearer than this: a tie with the last must not be
    if (full()) {
      worst_m2_ = std::min(worst_m2_, std::nextafter(found_.back().distance_m, kFarthest));
    }
    return true;  // go on
  }
  float worstDist() const { return worst_m2_; }
  bool full() const { return count_ == found_.size(); }
  void sort() {}  // they are; nanoflann asks since 1.5
  std::size_t count() const { return count_; }

 private:
  static constexpr float kFarthest = std::numeric_limits<float>::infinity();
  std::span<Neighbour> found_;  // their distances are squared until the search is over
  std::size_t count_ = 0;
  float worst_m2_;
};

}  // namespace

struct PointTree::Impl {
  explicit Impl(std::span<const Vec3f> points_m)
      : points{points_m}, tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {}
  TreePoints points;
  Tree tree;
};

PointTree::PointTree(std::span<const Vec3f> points_m) {
  GNBV_CHECK(points_m.size() <= std::numeric_limits<std::uint32_t>::max(), "{} points",
             points_m.size());
  impl_ = std::make_unique<Impl>(points_m);
}
PointTree::~PointTree() = default;

std::span<const Neighbour> PointTree::nearest(const Vec3f& p_m, std::span<Neighbour> found,
                                              float below_m) const {
  if (found.empty() || impl_->points.points_m.empty()) return found.first(0);
  NearestSet set(found, below_m);
  impl_->tree.findNeighbors(set, p_m.data(), {});
  for (Neighbour& neighbour : found.first(set.count())) {
    neighbour.distance_m = std::sqrt(neighbour.distance_m);
  }
  return found.first(set.count());
}

std::optional<Neighbour> PointTree::nearest(const Vec3f& p_m) const {
  std::array<Neighbour, 1> found{};
  return nearest(p_m, found).empty() ? std::nullopt : std::optional(found[0]);
}

}  // namespace gnbv
