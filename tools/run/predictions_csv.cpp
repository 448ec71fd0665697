#include "tools/run/predictions_csv.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kPredictionsHeader =
    "iteration,source,looks,incidence_deg,patches,missing,promised,found";

PatchSource patch_source_named(std::string_view name, const TextPlace& place) {
  for (std::size_t i = 0; i < kPatchSources; ++i) {
    if (name_of(static_cast<PatchSource>(i)) == name) return static_cast<PatchSource>(i);
  }
  throw BadInput(fmt::format("{}: '{}' is no source of patches", to_string(place), name));
}

std::size_t incidence_bin_from(int from_deg, const TextPlace& place) {
  const auto* const bin = std::find(kIncidenceFrom_deg.begin(), kIncidenceFrom_deg.end(), from_deg);
  if (bin != kIncidenceFrom_deg.end()) {
    return static_cast<std::size_t>(bin - kIncidenceFrom_deg.begin());
  }
  throw BadInput(fmt::format("{}: no bin of incidence begins at {}", to_string(place), from_deg));
}

ViewOutcome outcome_of(std::string_view row, const TextPlace& place) {
  if (std::count(row.begin(), row.end(), ',') !=
      std::count(kPredictionsHeader.begin(), kPredictionsHeader.end(), ',')) {
    throw BadInput(
        fmt::format("{}: '{}' is no row of {}", to_string(place), row, kPredictionsHeader));
  }
  ViewOutcome outcome;
  GainOutcome& gain = outcome.gain;
  const auto count = [&](std::string_view what) {
    return to_count(next_part(row, ','), place, what);
  };
  outcome.iteration = static_cast<std::size_t>(count("iteration"));
  gain.source = patch_source_named(next_part(row, ','), place);
  gain.observations = static_cast<std::size_t>(count("looks"));
  if (gain.observations >= kObservationBins) {
    throw BadInput(fmt::format("{}: looks {} must be less than {}", to_string(place),
                               gain.observations, kObservationBins));
  }
  gain.incidence = incidence_bin_from(count("incidence_deg"), place);
  gain.patches = count("patches");
  gain.missing = to_number(next_part(row, ','), place, "missing");
  gain.predicted = to_number(next_part(row, ','), place, "promised");
  gain.found = to_number(next_part(row, ','), place, "found");
  return outcome;
}

}  // namespace

std::string predictions_csv(std::span<const ViewOutcome> outcomes) {
  std::string csv = fmt::format("{}\n", kPredictionsHeader);
  for (const auto& [iteration, gain] : outcomes) {
    csv += fmt::format("{},{},{},{},{},{:.1f},{:.1f},{:.1f}\n", iteration, name_of(gain.source),
                       gain.observations, kIncidenceFrom_deg[gain.incidence], gain.patches,
                       gain.missing, gain.predicted, gain.found);
  }
  return csv;
}

std::vector<ViewOutcome> read_predictions_csv(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  std::string_view rest = text;
  need_header(next_part(rest, '\n'), kPredictionsHeader, {file, 1});
  std::vector<ViewOutcome> outcomes;
  for (int line = 2; !rest.empty(); ++line) {
    outcomes.push_back(outcome_of(next_part(rest, '\n'), {file, line}));
  }
  return outcomes;
}

}  // namespace gnbv
