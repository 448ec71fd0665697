// The points a surface is made of: where they are, what they were seen from, which way they face.
#pragma once

#include <span>
#include <vector>

#include "sim/core/parallel.hpp"
#include "tools/run/run_record.hpp"

namespace gnbv {

/// task(0) ... task(count - 1), some thousands at once on each thread.
template <typename Task>
void for_each_point(int threads, std::size_t count, const Task& task) {
  constexpr std::size_t kAtOnce = 4096;
  parallel_for_chunks(threads, count, kAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) task(i);
  });
}

/// Points with the place of the sensor that saw each.
struct SeenPoints {
  std::vector<Vec3f> points_world_m;
  std::vector<Vec3f> sensors_world_m;  // (points)
};

/// The points of a run. Those of a view were seen by the camera of the view's pose that has them in
/// its picture; or, when cameras run in flight, from somewhere on the leg that leads there. Those
/// of the profile, whose leaves are coarse, are used only where no view's point lies within a leaf.
/// Which pose of a profile, a leg, or the way after the last view saw a point is not on record: it
/// is taken for the nearest one between which and the point no other point lies. Throws BadInput,
/// naming the command that helps, for a cloud without points, and for points without a flight.
SeenPoints seen_points(const RunRecord& record, const RunCloud& cloud, int threads);

struct OrientedCloud {
  std::vector<Vec3f> points_world_m;
  std::vector<Vec3f> normals_world;  // (points), unit, out of the structure
  std::vector<float> spacing_m;      // (points), between neighbours there
};

/// Normals by principal components (Hoppe et al. 1992) of those of the 16 nearest points that were
/// seen from the same side, so that the two faces of a thin wing keep apart; pointing to the sensor
/// or, where they are nearly square to it, to the side of the neighbours that are not. Points whose
/// neighbours lie on one line are left out. Deterministic at any number of threads.
OrientedCloud oriented(const SeenPoints& seen, int threads);

/// The same of points of which nobody knows what saw them: normals agree from neighbour to
/// neighbour along the least turning ones (Hoppe et al. 1992), and each connected part's highest
/// point faces up.
OrientedCloud oriented_by_neighbours(std::span<const Vec3f> points_world_m, int threads);

}  // namespace gnbv
