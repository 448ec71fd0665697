#include "tools/report/candidate_pack.hpp"

#include "planner/core/plan.hpp"
#include "sim/core/error.hpp"
#include "tools/run/candidates_jsonl.hpp"
#include "tools/run/file_names.hpp"
#include "tools/run/words.hpp"

namespace gnbv {
namespace {

constexpr std::size_t kRejections = kRejectionNames.size();
constexpr std::size_t kCandidateBytes = 15;
constexpr std::size_t kTermBytes = 20;

std::uint8_t kind_of(const Candidate& candidate, bool is_chosen) {
  if (candidate.rejected) return static_cast<std::uint8_t>(*candidate.rejected);
  return is_chosen ? kChosenCandidate : kValidCandidate;
}

}  // namespace

std::optional<PackedCandidates> pack_candidates(const RunRecord& record, std::size_t max_bytes,
                                                BytePack& bytes) {
  const std::vector<Plan> plans = read_all_candidates(record.folder, record.views.size());
  if (plans.empty()) return std::nullopt;
  std::vector<Vec3f> points;
  std::vector<float> angles_rad;
  std::vector<std::uint8_t> kind;
  std::vector<float> terms;
  std::vector<std::uint32_t> begins;
  for (const Plan& plan : plans) {
    begins.push_back(static_cast<std::uint32_t>(kind.size()));
    for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
      const Candidate& c = plan.candidates[i];
      points.push_back(c.view.p_world_m.cast<float>());
      angles_rad.push_back(static_cast<float>(c.view.yaw_rad));
      angles_rad.push_back(static_cast<float>(c.view.gimbal_pitch_rad));
      kind.push_back(kind_of(c, plan.is_chosen(i)));
      if (c.rejected) continue;
      for (const double term : {c.score.value, c.score.information, c.score.density,
                                c.score.prediction, c.score.distance}) {
        terms.push_back(static_cast<float>(term));
      }
    }
  }
  begins.push_back(static_cast<std::uint32_t>(kind.size()));
  const std::size_t needed = kCandidateBytes * kind.size() + kTermBytes * terms.size() / 5;
  if (needed > max_bytes) {
    throw BadInput(
        fmt::format("{}: {} candidates are too many for the page: {:.1f} MB, {:.1f} MB "
                    "are left; `gnbv render --what candidates` draws any decision",
                    (record.folder / kCandidatesFile).string(), grouped(kind.size()),
                    1e-6 * static_cast<double>(needed), 1e-6 * static_cast<double>(max_bytes)));
  }
  return PackedCandidates{.points = pack_points(points, bytes),
                          .angles_rad = bytes.add(angles_rad),
                          .kind = bytes.add(kind),
                          .terms = bytes.add(terms),
                          .begins = bytes.add(begins)};
}

}  // namespace gnbv
