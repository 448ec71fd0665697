// A chosen view, why it was chosen, and what else there was to choose from.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "planner/map/frontiers.hpp"
#include "planner/utility.hpp"
#include "planner/view_validity.hpp"
#include "sim/core/pose.hpp"

namespace gnbv {

/// A chosen view and why.
struct Decision {
  ViewPose view;
  std::string_view sampler = "start";
  double scale = 1.0;
  int candidates = 0;  // sampled
  int valid = 0;       // of them not rejected
  Score score = {};
  std::vector<Vec3> via_world_m = {};  // points on the way there; none: straight
};

/// A sampled view with what became of it.
struct Candidate {
  ViewPose view;
  std::string_view sampler;
  double scale = 1.0;                      // of the AGVS grid
  int cluster = -1;                        // FVS: the cluster it looks at, 0 = the first tried
  std::optional<Rejection> rejected = {};  // nothing: it competed with `score`
  std::vector<Vec3> via_world_m = {};      // points on the way there
  double path_m = 0.0;                     // length of the way
  Score score = {};
};

/// The next view, if any, and all candidates of this decision in the order they were sampled.
struct Plan {
  std::optional<Decision> next;
  std::optional<std::size_t> chosen;  // of the candidates
  std::vector<Candidate> candidates;
  std::vector<FrontierCluster> clusters = {};  // FVS: those it may try, by Candidate::cluster
};

}  // namespace gnbv
