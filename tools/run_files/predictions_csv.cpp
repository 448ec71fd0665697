#include "tools/run_files/predictions_csv.hpp"

#include <fmt/format.h>

namespace gnbv {

std::string predictions_csv(std::span<const ViewOutcome> outcomes) {
  std::string csv = "iteration,source,looks,incidence_deg,patches,missing,promised,found\n";
  for (const auto& [iteration, look] : outcomes) {
    csv += fmt::format("{},{},{},{},{},{:.1f},{:.1f},{:.1f}\n", iteration, name_of(look.source),
                       look.looks, kIncidenceFrom_deg[look.incidence], look.patches, look.missing,
                       look.promised, look.found);
  }
  return csv;
}

}  // namespace gnbv
