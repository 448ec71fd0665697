#include "tools/python/env_mission.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "bench/score/coverage_curve.hpp"
#include "scenarios/load.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/reference.hpp"

namespace gnbv {
namespace {

Scenario flown_by_agent(const std::string& name, std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), "planner.utility.name=route");
  return load_scenario(name, overrides);
}

World world_of(const Scenario& scenario) {
  std::vector<std::string> warnings;
  return load_world(scenario, warnings);
}

}  // namespace

KeptMoment KeptProfiles::find(std::uint64_t key) const {
  const std::lock_guard lock(mutex_);
  const auto found = kept_.find(key);
  return found == kept_.end() ? nullptr : found->second;
}

void KeptProfiles::keep(std::uint64_t key, const std::function<KeptMoment()>& made) {
  const std::lock_guard lock(mutex_);
  if (kept_.size() < most_ && !kept_.contains(key)) kept_.emplace(key, made());
}

EnvStage::EnvStage(const std::string& scenario_name, const std::vector<std::string>& overrides,
                   double goal, std::size_t seeds)
    : scenario(flown_by_agent(scenario_name, overrides)),
      world(world_of(scenario)),
      scene(world),
      reference(reference_of(scenario, world, scene, 2)),
      ceiling(goal > 0.0 ? run_ceiling(scenario, world, scene, CeilingFrom::search, 2).value_or(1.0)
                         : 1.0),
      goal_coverage(goal > 0.0 ? goal * ceiling : 2.0),
      scales({1.0, 3.0}),
      profile_differs(profile_reads_seed(scenario)),
      profiles(std::make_unique<KeptProfiles>(profile_differs ? seeds : 1)) {}

void Permits::take() {
  std::unique_lock lock(mutex_);
  given_.wait(lock, [this] { return left_ > 0; });
  --left_;
}

void Permits::give() {
  const std::lock_guard lock(mutex_);
  ++left_;
  given_.notify_one();
}

EnvMission::EnvMission(std::shared_ptr<const EnvStage> stage, std::shared_ptr<Permits> permits,
                       const EnvWishes& wishes)
    : stage_(std::move(stage)),
      permits_(std::move(permits)),
      wishes_(wishes),
      observer_(stage_->scenario.planner, planner_model(stage_->scenario), stage_->scales),
      process_(getpid()) {}

EnvMission::~EnvMission() {
  while (!close()) continue;
  static_cast<void>(thread_.release());  // a parent's can be neither joined nor detached
}

void EnvMission::check_process() const {
  if (getpid() == process_) return;
  throw std::runtime_error(fmt::format(
      "the environment was made in process {}, and its mission does not fly in a forked "
      "child: make environments in the child, or start children by spawn",
      process_));
}

bool EnvMission::close() {
  if (!thread_ || getpid() != process_) return true;
  std::unique_lock lock(mutex_);
  is_closing_ = true;
  turned_.notify_all();
  const auto is_over = [this] { return turn_ == Turn::over; };
  if (!turned_.wait_for(lock, std::chrono::duration<double>(kSlice_s), is_over)) return false;
  lock.unlock();
  thread_->join();
  thread_.reset();
  is_closing_ = false;
  return true;
}

void EnvMission::begin(std::uint64_t seed) {
  check_process();
  if (thread_) throw std::runtime_error("the mission before has not ended");
  state_ = {};
  from_.reset();
  start(seed);
}

void EnvMission::begin(std::shared_ptr<const EnvMoment> from) {
  check_process();
  if (thread_) throw std::runtime_error("the mission before has not ended");
  state_ = from->state;
  from_ = std::move(from);
  failure_ = nullptr;
  if (!state_.ended) start(from_->seed);
}

std::shared_ptr<const EnvMoment> EnvMission::keep() {
  check_process();
  const std::lock_guard lock(mutex_);
  if (turn_ == Turn::mission || (turn_ == Turn::over && !state_.ended) || failure_) {
    throw std::runtime_error("the mission does not wait for a view");
  }
  return std::make_shared<const EnvMoment>(
      EnvMoment{seed_, state_.ended ? nullptr : keep_(), tried_, state_});
}

std::string EnvMission::result_sha256() {
  const std::lock_guard lock(mutex_);
  return state_.result ? gnbv::result_sha256(*state_.result) : "";
}

void EnvMission::start(std::uint64_t seed) {
  Scenario scenario = stage_->scenario;
  scenario.seed = seed;
  seed_ = seed;
  repeated_ = 0;
  action_.reset();
  failure_ = nullptr;
  turn_ = Turn::mission;
  try {
    thread_ =
        std::make_unique<std::thread>([this, scenario = std::move(scenario)] { fly(scenario); });
  } catch (...) {
    turn_ = Turn::over;  // nobody would wait for what does not fly
    throw;
  }
}

void EnvMission::act(const ViewPose& view) {
  check_process();
  const std::lock_guard lock(mutex_);
  if (turn_ != Turn::agent) throw std::runtime_error("the mission does not wait for a view");
  action_ = view;
  state_.refused.clear();
  turn_ = Turn::mission;
  turned_.notify_all();
}

const EnvState* EnvMission::wait() {
  check_process();
  std::unique_lock lock(mutex_);
  const auto has_turned = [this] { return turn_ != Turn::mission; };
  if (!turned_.wait_for(lock, std::chrono::duration<double>(kSlice_s), has_turned)) return nullptr;
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return &state_;
}

void EnvMission::observe(const Belief& belief) {
  if (state_.views <= 1) state_.first_entropy_nat = belief.grid.total_entropy_nat();
  state_.entropy_nat = belief.grid.total_entropy_nat();
  state_.cloud_points = belief.cloud.points_world_m().size();
  if (wishes_.top) {
    state_.grid = belief.grid.geometry();
    state_.top = top_view(belief.grid);
  }
  state_.seen =
      observer_.observe(belief, state_.pose, state_.first_entropy_nat, wishes_.candidates);
  if (wishes_.crop > 0) state_.crop = local_crop(belief, state_.pose.p_world_m, wishes_.crop);
}

/// The mission's turn ends here, and begins again with the agent's view.
std::optional<ViewPose> EnvMission::ask() {
  if (from_ && repeated_ < from_->refused.size()) {
    tried_.push_back(from_->refused[repeated_++]);
    return tried_.back();
  }
  permits_->give();
  std::unique_lock lock(mutex_);
  turn_ = Turn::agent;
  turned_.notify_all();
  turned_.wait(lock, [this] { return turn_ == Turn::mission || is_closing_; });
  lock.unlock();
  permits_->take();
  if (is_closing_ || !action_) return std::nullopt;
  tried_.push_back(*action_);
  return std::exchange(action_, std::nullopt);
}

/// Before the first view the profile is kept, later how to keep the mission.
void EnvMission::on_pause(const MissionPause& pause) {
  tried_.clear();
  keep_ = pause.keep;
  if (pause.views == 0) stage_->profiles->keep(stage_->profile_differs ? seed_ : 0, pause.keep);
}

void EnvMission::on_view(const ViewRecord& view, const Belief& belief) {
  state_.pose = view.decision.view;
  state_.flown_m = view.flown_m;
  state_.time_s = view.time_s;
  ++state_.views;
  observe(belief);
  state_.coverage = coverage_of_(belief);
}

void EnvMission::fly(Scenario scenario) {
  permits_->take();
  try {
    coverage_of_ = coverage_meter(stage_->reference, stage_->scene);
    MissionInputs inputs = {.observers = {this}};
    inputs.should_stop = [this] { return is_closing_.load(); };
    inputs.is_covered = [&](const Belief&) { return state_.coverage >= stage_->goal_coverage; };
    inputs.sources.on_refused = [this](std::size_t, Rejection reason) {
      state_.refused = name_of(reason);
    };
    inputs.sources.next_view = [this] { return ask(); };
    inputs.from =
        from_ ? from_->mission : stage_->profiles->find(stage_->profile_differs ? seed_ : 0);
    inputs.on_pause = [this](const MissionPause& pause) { on_pause(pause); };
    state_.result = std::make_shared<const MissionResult>(
        run_mission(scenario, stage_->world, stage_->scene, inputs, 1));
    state_.termination = name_of(state_.result->termination);
    observe(state_.result->belief);
  } catch (...) {
    failure_ = std::current_exception();
  }
  permits_->give();
  const std::lock_guard lock(mutex_);
  state_.ended = true;
  turn_ = Turn::over;
  turned_.notify_all();
}

}  // namespace gnbv
