// A mission flown into a run directory, as one that is stopped and resumed.
#pragma once

#include <filesystem>

#include "tests/support/flown.hpp"
#include "tools/run_files/run_directory.hpp"

namespace gnbv {

constexpr std::size_t kNeverStops = 1000;  // more views than any test's mission has

/// Asked to stop once `stop_after` views of its own were flown. Only its journal stays, as of one
/// that was killed.
inline MissionResult fly_into(const std::filesystem::path& folder, const Scenario& scenario,
                              bool resume, std::size_t stop_after = kNeverStops,
                              MissionHooks hooks = {}) {
  RunDirectory directory(folder, scenario, resume);
  std::size_t views = 0;
  hooks.on_view = [&](const ViewRecord& view) {
    directory.append(view);
    ++views;
  };
  hooks.should_stop = [&] { return views >= stop_after; };
  hooks.replay = directory.recorded_decisions();
  return Flown(scenario, hooks).result;
}

}  // namespace gnbv
