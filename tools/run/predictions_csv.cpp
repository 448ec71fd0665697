#include "tools/run/predictions_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "tools/run/separated_text.hpp"

namespace gnbv {
namespace {

constexpr std::string_view kPredictionsHeader =
    "iteration,source,looks,incidence_deg,patches,missing,promised,found";

/// The number of what equals the value; throws BadInput when none does.
template <typename Values, typename Value>
std::size_t index_in(const Values& values, const Value& value, const TextPlace& place,
                     const char* what) {
  const auto at = std::find(values.begin(), values.end(), value);
  if (at != values.end()) return static_cast<std::size_t>(at - values.begin());
  throw BadInput(fmt::format("{}: '{}' is no {}", to_string(place), value, what));
}

std::array<std::string_view, kPatchSources> source_names() {
  std::array<std::string_view, kPatchSources> names;
  for (std::size_t i = 0; i < kPatchSources; ++i) names[i] = name_of(static_cast<PatchSource>(i));
  return names;
}

ViewOutcome outcome_of(std::string_view row, const TextPlace& place) {
  const std::vector<std::string_view> cells = split(row, ',');
  if (cells.size() != split(kPredictionsHeader, ',').size()) {
    throw BadInput(
        fmt::format("{}: '{}' is no row of {}", to_string(place), row, kPredictionsHeader));
  }
  GainOutcome gain;
  gain.source =
      static_cast<PatchSource>(index_in(source_names(), cells[1], place, "source of patches"));
  gain.observations = static_cast<std::size_t>(to_count(cells[2], place, "looks"));
  if (gain.observations >= kObservationBins) {
    throw BadInput(fmt::format("{}: looks {} must be less than {}", to_string(place),
                               gain.observations, kObservationBins));
  }
  gain.incidence = index_in(kIncidenceFrom_deg, to_count(cells[3], place, "incidence_deg"), place,
                            "beginning of a bin of incidence");
  gain.patches = to_count(cells[4], place, "patches");
  gain.missing = to_number(cells[5], place, "missing");
  gain.predicted = to_number(cells[6], place, "promised");
  gain.found = to_number(cells[7], place, "found");
  return {static_cast<std::size_t>(to_count(cells[0], place, "iteration")), gain};
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
