// What a planner written in Python sees: what is believed, and what the planner of C++ asks of it.
// This file and its .cpp include nothing but the planner and the questions to it
// (tools/check_layers): no truth is in reach.
#pragma once

#include <memory>
#include <mutex>

#include "tools/mission/belief_questions.hpp"
#include "tools/python/arrays.hpp"

namespace gnbv {

struct AskedTools : BeliefTools {
  using BeliefTools::BeliefTools;
  std::mutex is_asked;  // Python may have threads
};

/// For one call of a planner, which end() ends: all that is asked afterwards raises ReferenceError.
/// Its arrays share the belief's memory; who made them asks is_shared() before the belief changes.
class BeliefView {
 public:
  BeliefView(const Belief& belief, AskedTools& tools, const ViewPose& current);
  /// Of a belief that never changes, which the view and its arrays keep.
  BeliefView(std::shared_ptr<const Belief> belief, std::shared_ptr<AskedTools> tools,
             const ViewPose& current);
  /// What was handed over is used no more; waits for what other threads still ask.
  void end();

  /// z, y, x; natural logarithm of the odds, float32.
  nb::object log_odds() const;
  /// z, y, x; map_kernels.hpp.
  nb::object words() const;
  /// points x 3, m, world ENU, float32.
  nb::object cloud() const;
  /// Flat indices (z, y, x) of the voxels that hold points, and the density of each.
  nb::tuple density() const;

  double resolution_m() const { return belief().grid.geometry().resolution_m(); }
  Point origin_m() const;
  double density_max() const { return belief().cloud.density_max(); }
  double entropy_nat() const { return belief().grid.total_entropy_nat(); }
  nb::object current() const;
  /// 2 x 3: the corners of where views may be.
  nb::object navigation_m() const;

  nb::object sample(double scale) const;
  nb::object sample_frontiers() const;
  /// For each view the name of what forbids it, or "", and the length of the way there (m), as the
  /// mission will find it.
  nb::tuple validate(const ViewRows& rows) const;
  /// A ViewStats a row, with rays, as bytes.
  nb::bytes evaluate(const ViewRows& rows) const;
  /// The points between the ends, or None.
  nb::object find_path(const Point& from_m, const Point& to_m) const;

  /// Whether any array that shares memory is still in use.
  bool is_shared() const;

 private:
  template <typename T>
  nb::object grid_array(std::span<const T> values) const;

  const Belief& belief() const;
  AskedTools& tools() const;

  const Belief* belief_;  // none after end()
  AskedTools* tools_;
  ViewPose current_;
  std::shared_ptr<AskedTools> kept_tools_;
  nb::object lease_;  // what the shared arrays keep alive
};

void bind_belief(nb::module_& m);

}  // namespace gnbv
