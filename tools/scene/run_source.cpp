#include "tools/scene/run_source.hpp"

#include <utility>

#include "planner/guided/view_sampling.hpp"
#include "sim/core/error.hpp"
#include "tools/mission/load_world.hpp"
#include "tools/mission/reference.hpp"
#include "tools/run/decision_lines.hpp"
#include "tools/run/run_inputs.hpp"

namespace gnbv {
namespace {

std::string why_no_profile(const RunRecord& record) {
  const ProfilingMethod method = record.scenario.planner.profiling.method;
  if (method != ProfilingMethod::none && method != ProfilingMethod::saved) {
    return fmt::format("{}: its profile ended before its first waypoint: nothing to draw",
                       record.folder.string());
  }
  return fmt::format(
      "{}: flew no profile of its own: planner.profiling.method is {}; {} flies one",
      record.folder.string(), method == ProfilingMethod::none ? "none" : "saved",
      command_to_fly_again(record.folder, "--set planner.profiling.method=bounding_box"));
}

/// Adds to a decision that was read its clusters, of which candidates.jsonl has the numbers only.
/// Those of bursts leave others out that were tried before, and are planned anew by every replay.
void add_clusters(const RecordedMission& mission, std::size_t iteration,
                  const ReplayedDecision& again, Plan& plan) {
  const FvsConfig& fvs = mission.scenario.planner.fvs;
  if (fvs.mode == FvsMode::burst) {
    plan.clusters = again.plan.clusters;
    plan.frontier = again.plan.frontier;
    return;
  }
  std::vector<Decision> decisions;
  for (const ViewRecord& view : mission.views.first(iteration)) decisions.push_back(view.decision);
  FrontierMarks marks(again.belief.grid.geometry().voxel_count());
  find_clusters_to_try(fvs, again.belief, decisions, decisions.back().view.p_world_m, marks, plan);
}

/// One flight for all of that, with the candidates that the run kept. Where those of a decision
/// cannot be had, throws only when somebody waits for it.
Replayed flown_again(const RecordedMission& mission, const std::filesystem::path& folder,
                     ReplayRequest request, bool is_for_decision) {
  std::optional<Plan> plan;
  if (request.decision) {
    try {
      plan = read_candidates(folder, *request.decision);
    } catch (const BadInput&) {
      if (is_for_decision) throw;
      request.decision.reset();  // who asks for it will be told
    }
  }
  request.plans = !plan;
  Replayed again = replay(mission, request);
  if (plan) {
    add_clusters(mission, *request.decision, *again.decision, *plan);
    again.decision->plan = std::move(*plan);
  }
  return again;
}

}  // namespace

RunSource::RunSource(const std::filesystem::path& folder, int threads, SourceProgress on_progress)
    : record_(read_run(folder)), threads_(threads), on_progress_(std::move(on_progress)) {}

RunSource::RunSource(RunRecord record, World world)
    : record_(std::move(record)), world_(std::move(world)) {}

const World& RunSource::world() {
  if (!world_) {
    std::vector<std::string> told_by_run;  // the mesh's faults were told when it was flown
    World world = load_world(record_.scenario, told_by_run);
    need_same_inputs(record_.folder, world_inputs(record_.scenario, world),
                     "pictures would show another structure; put it back");
    world_ = std::move(world);
  }
  return *world_;
}

const RayScene& RunSource::scene() {
  if (!scene_) scene_.emplace(world());
  return *scene_;
}

const RunCloud& RunSource::cloud() {
  if (!cloud_) cloud_ = read_run_cloud(record_);
  return *cloud_;
}

const std::vector<MadePlan>& RunSource::plans() {
  if (!plans_) plans_ = read_plans(record_);
  return *plans_;
}

const SurfaceReference& RunSource::reference() {
  if (!reference_) {
    on_progress_(0.0, "true surface");
    reference_ =
        cached_surface_reference(world(), scene(), reference_config(record_.scenario), threads_);
  }
  return *reference_;
}

RecordedMission RunSource::mission() {
  need_same_inputs(record_.folder, run_inputs(record_.scenario, world()),
                   "the mission cannot be flown again; put it back");
  return {.scenario = record_.scenario,
          .world = world(),
          .scene = scene(),
          .views = record_.views,
          .threads = threads_};
}

void RunSource::expect(const ReplayRequest& request) {
  expected_ = request;
  if (request.decision) expected_.decision = record_.views[*request.decision].planned_at();
  expected_.waypoints = {1, 3};
}

ReplayRequest RunSource::lacking() const {
  ReplayRequest request = expected_;
  request.has_profile = request.has_profile && !known_.has_profile;
  if (request.belief == known_.belief) request.belief.reset();
  if (request.decision == known_.decision) request.decision.reset();
  return request;
}

void RunSource::keep(const ReplayRequest& request, Replayed again) {
  if (request.has_profile) again_.profile = std::move(again.profile);
  known_.has_profile = known_.has_profile || request.has_profile;
  if (again.belief) {
    again_.belief.reset();
    again_.belief.emplace(std::move(*again.belief));
    known_.belief = request.belief;
  }
  if (again.decision) {
    again_.decision.reset();
    again_.decision.emplace(std::move(*again.decision));
    known_.decision = request.decision;
  }
}

void RunSource::fly_ahead() {
  land();
  const ReplayRequest request = lacking();
  if (!request.has_profile && !request.belief && !request.decision) return;
  try {
    asked_ahead_ = request;
    ahead_ = std::async(std::launch::async, [again = mission(), request, this] {
      return flown_again(again, record_.folder, request, false);
    });
  } catch (const BadInput&) {  // who asks for it will be told
  }
}

void RunSource::land() {
  if (!ahead_.valid()) return;
  on_progress_(0.0, "flying again");
  try {
    keep(asked_ahead_, ahead_.get());
  } catch (const BadInput&) {  // who asks for it will be told
  }
}

void RunSource::fly_again(bool is_for_decision) {
  land();
  const ReplayRequest request = lacking();
  if (!request.has_profile && !request.belief && !request.decision) return;
  RecordedMission again = mission();
  again.on_progress = [this](double share) { on_progress_(share, "flying again"); };
  keep(request, flown_again(again, record_.folder, request, is_for_decision));
}

const std::vector<ProfileStage>& RunSource::profile() {
  expected_.has_profile = true;
  try {
    if (!known_.has_profile) fly_again(false);
  } catch (const BadInput&) {
    if (!expected_.belief && !expected_.decision) throw;
    expected_.belief.reset();  // the profile needs no view that can be flown again
    expected_.decision.reset();
    fly_again(false);
  }
  if (again_.profile.empty()) throw BadInput(why_no_profile(record_));
  return again_.profile;
}

const Belief& RunSource::belief_after(std::size_t iteration) {
  expected_.belief = iteration;
  if (known_.belief != iteration) fly_again(false);
  expected_.belief.reset();
  return *again_.belief;
}

const ReplayedDecision& RunSource::decision(std::size_t iteration) {
  expected_.decision = record_.views[iteration].planned_at();
  if (known_.decision != expected_.decision) fly_again(true);
  expected_.decision.reset();
  return *again_.decision;
}

void RunSource::forget() {
  land();
  scene_.reset();
  cloud_.reset();
  plans_.reset();
  reference_.reset();
  if (!expected_.belief) {
    known_.belief.reset();
    again_.belief.reset();
  }
  if (!expected_.decision) {
    known_.decision.reset();
    again_.decision.reset();
  }
}

}  // namespace gnbv
