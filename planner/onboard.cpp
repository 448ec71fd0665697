#include "planner/onboard.hpp"

#include <algorithm>
#include <utility>

#include "planner/core/belief.hpp"
#include "planner/planners.hpp"
#include "planner/symmetry/symmetry.hpp"
#include "sim/core/error.hpp"

namespace gnbv {
namespace {

PlannerConfig checked(const OnboardSettings& settings) {
  if (settings.cameras.empty() && settings.lidars.empty()) {
    throw BadInput("a planner needs a camera or a LIDAR");
  }
  if (settings.workspace_m.isEmpty()) throw BadInput("a planner needs a workspace");
  PlannerConfig config = settings.planner;
  if (settings.utility) {
    config.utility.name = kUserUtilityName;
    config.utility.python = {.function = settings.utility->name, .source = settings.utility->reads};
    return config;
  }
  const std::vector<std::string_view> names = planner_names();
  if (std::find(names.begin(), names.end(), config.utility.name) == names.end()) {
    throw BadInput(fmt::format("{} is no planner and no utility: {} are", config.utility.name,
                               fmt::join(names, ", ")));
  }
  return config;
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

PlannerModel model_of(const OnboardSettings& settings, const PlannerConfig& config) {
  PlannerModel model = make_model(config, settings.workspace_m, settings.cameras, settings.lidars,
                                  settings.seed, settings.no_fly);
  model.travel = settings.travel;
  return model;
}

}  // namespace

Onboard::Onboard(OnboardSettings settings)
    : config_(checked(settings)),
      model_(model_of(settings, config_)),
      planner_(make_planner(config_, model_, sources_of(settings))),
      scratch_(model_, settings.threads),
      belief_(model_) {
  scratch_.should_stop = std::move(settings.should_stop);
  remember_start(belief_, history_);
}

void Onboard::add_profile(std::span<const LidarScan> sweeps) {
  integrate_profile(model_, sweeps, scratch_, belief_);
  begin_from_profile();
}

void Onboard::load_profile(const std::filesystem::path& file) {
  belief_ = read_belief(file, model_);
  begin_from_profile();
}

void Onboard::begin_from_profile() {
  if (traits_of(config_).reads_prediction) {
    const Symmetry symmetry = find_symmetry(config_.symmetry, belief_.cloud.points_world_m(),
                                            belief_.grid, scratch_.threads);
    predict_surface(symmetry, belief_.grid);
  }
  remember_start(belief_, history_);
}

void Onboard::add_frames(std::span<const DepthFrame> frames) {
  integrate_view(model_, frames, scratch_, belief_);
}

void Onboard::add_looks(std::span<const LidarScan> sweeps) {
  integrate_looks(model_, sweeps, scratch_, belief_);
}

void Onboard::add_view(const ViewPose& pose, std::span<const DepthFrame> frames,
                       std::span<const LidarScan> sweeps) {
  if (history_.decisions.empty()) {
    planner_->begin(belief_, pose);
    current_ = pose;
    flown_to_ = {.view = pose};
  }
  const double straight_m = planned_m(history_, current_.p_world_m, flown_to_);
  current_ = pose;
  add_frames(frames);
  add_looks(sweeps);
  remember(flown_to_, belief_, straight_m, history_);
}

std::optional<Decision> Onboard::next_view() {
  const TerminationConfig& rules = config_.termination;
  std::optional<Termination> end = end_after_view(rules, planner_->end_rules(), history_);
  if (!end) {
    auto next = next_decision(rules, current_, history_, [&] {
      return planner_->next(belief_, history_, current_, scratch_);
    });
    if (auto* const decision = std::get_if<Decision>(&next)) return flown_to_ = *decision;
    end = std::get<Termination>(next);
  }
  end_ = *end;
  return std::nullopt;
}

}  // namespace gnbv
