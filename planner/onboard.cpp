#include "planner/onboard.hpp"

#include <algorithm>
#include <utility>

#include "planner/core/belief_file.hpp"
#include "planner/motion/path_search.hpp"
#include "planner/planners.hpp"
#include "planner/symmetry/symmetry.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

PlannerConfig checked(const OnboardSettings& settings) {
  if (settings.cameras.empty()) throw BadInput("a planner needs a camera");
  if (settings.workspace_m.isEmpty()) throw BadInput("a planner needs a workspace");
  PlannerConfig config = settings.planner;
  if (settings.utility) {
    config.utility.name = kUserUtilityName;
    config.utility.python = {settings.utility->name, settings.utility->reads};
    return config;
  }
  const std::vector<std::string_view> names = planner_names();
  if (std::find(names.begin(), names.end(), config.utility.name) == names.end()) {
    throw BadInput(fmt::format("{} is no planner and no utility: {} are", config.utility.name,
                               fmt::join(names, ", ")));
  }
  return config;
}

PlannerModel model_of(const OnboardSettings& settings, const PlannerConfig& config) {
  std::vector<CameraModel> cameras;
  for (const CameraConfig& camera : settings.cameras) cameras.push_back(make_camera_model(camera));
  std::vector<LidarModel> lidars;
  for (const LidarConfig& lidar : settings.lidars) lidars.push_back(make_lidar_model(lidar));
  return make_model(config, settings.workspace_m, cameras, lidars, settings.seed, settings.no_fly);
}

PlannerSources sources_of(OnboardSettings& settings) {
  if (!settings.utility) return {};
  const auto scores = [value = std::move(settings.utility->value)](const UserQuestion& question) {
    std::vector<double> all;
    for (const UserCandidate& row : question.rows) {
      all.push_back(
          value(row.stats, {Vec3(row.x_m, row.y_m, row.z_m), row.yaw_rad, row.gimbal_pitch_rad}));
    }
    return all;
  };
  return {.user_scores = scores};
}

}  // namespace

Onboard::Onboard(OnboardSettings settings)
    : config_(checked(settings)),
      model_(model_of(settings, config_)),
      planner_(make_planner(config_, model_, sources_of(settings))),
      scratch_(model_, settings.threads),
      belief_(model_),
      entropy_before_nat_(belief_.grid.total_entropy_nat()) {
  scratch_.should_stop = std::move(settings.should_stop);
}

void Onboard::add_profile(std::span<const LidarScan> sweeps) {
  integrate_profile(model_, sweeps, scratch_, belief_);
  predict_from_profile();
}

void Onboard::load_profile(const std::filesystem::path& file) {
  belief_ = read_belief(file, model_);
  predict_from_profile();
}

void Onboard::predict_from_profile() {
  if (traits_of(config_).reads_prediction) {
    const Symmetry symmetry = find_symmetry(config_.symmetry, belief_.cloud.points_world_m(),
                                            belief_.grid, scratch_.threads);
    predict_surface(symmetry, belief_.grid);
  }
  entropy_before_nat_ = belief_.grid.total_entropy_nat();
}

void Onboard::add_frames(std::span<const DepthFrame> frames) {
  integrate_view(model_, frames, scratch_, belief_);
}

void Onboard::add_view(const ViewPose& pose, std::span<const DepthFrame> frames) {
  if (history_.decisions.empty()) {
    planner_->begin(belief_, pose);
    flown_to_ = {.view = pose};
  } else {
    straight_m_ += way_m(flown_to_);
  }
  current_ = pose;
  add_frames(frames);
  remember_entropy(belief_, entropy_before_nat_, history_);
  history_.decisions.push_back(flown_to_);
  remember_progress(belief_, straight_m_, history_);
  entropy_before_nat_ = belief_.grid.total_entropy_nat();
}

double Onboard::way_m(const Decision& next) const {
  return path_length_m(current_.p_world_m, next.via_world_m, next.view.p_world_m);
}

std::optional<Decision> Onboard::next_view() {
  const TerminationConfig& rules = config_.termination;
  const bool are_enough =
      history_.decisions.size() >= static_cast<std::size_t>(rules.max_iterations);
  const std::optional<Termination> end =
      are_enough ? Termination::max_iterations
                 : believed_end(rules, planner_->end_rules(), history_.entropies_nat,
                                history_.progress, positions_of(history_));
  if (end) {
    end_ = *end;
    return std::nullopt;
  }
  if (ahead_.empty()) {
    Plan plan = planner_->next(belief_, history_, current_, scratch_);
    end_ = plan.end;
    ahead_.assign(plan.views.rbegin(), plan.views.rend());
    if (ahead_.empty()) return std::nullopt;
  }
  if (is_too_far(rules, straight_m_, way_m(ahead_.back()))) {
    end_ = Termination::max_distance;
    return std::nullopt;
  }
  flown_to_ = std::move(ahead_.back());
  ahead_.pop_back();
  return flown_to_;
}

}  // namespace gnbv
