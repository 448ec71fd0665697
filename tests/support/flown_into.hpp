// A mission flown into a run directory, as one that is stopped and resumed.
#pragma once

#include <filesystem>

#include "tests/support/flown.hpp"
#include "tests/support/watch.hpp"
#include "tools/run/run_directory.hpp"

namespace gnbv {

constexpr std::size_t kNeverStops = 1000;  // more views than any test's mission has

/// Asked to stop once `stop_after` views of its own were flown. Only its journal stays, as of one
/// that was killed.
inline MissionResult fly_into(const std::filesystem::path& folder, const Scenario& scenario,
                              bool resume, std::size_t stop_after = kNeverStops,
                              MissionInputs inputs = {}) {
  RunDirectory directory(folder, scenario, resume);
  std::size_t views = 0;
  Watch watch;
  watch.view = [&](const ViewRecord& view, const Belief&) {
    directory.append(view);
    ++views;
  };
  inputs.observers = {&watch};
  inputs.should_stop = [&] { return views >= stop_after; };
  inputs.replay = directory.recorded_decisions();
  return Flown(scenario, inputs).result;
}

}  // namespace gnbv
