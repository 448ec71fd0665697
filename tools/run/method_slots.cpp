#include "tools/run/method_slots.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace gnbv {
namespace {

/// Whose each of the first numbers is.
constexpr std::array<std::string_view, 7> kOwners = {
    "proposed", "bircher", "isler", "tour", "oracle_metres", "oracle_views", "released"};

std::string method_of(const RunRecord& run) {
  const PlannerConfig& planner = run.scenario.planner;
  return planner.preset == "released" ? planner.preset : planner.utility.name;
}

}  // namespace

std::vector<std::string> methods_of(std::span<const RunRecord> runs) {
  std::vector<std::string> methods;
  for (const RunRecord& run : runs) methods.push_back(method_of(run));
  return methods;
}

std::vector<std::string> methods_of(std::span<const RunGroup> groups) {
  std::vector<std::string> methods;
  for (const RunGroup& group : groups) methods.push_back(method_of(*group.runs.front()));
  return methods;
}

std::vector<std::size_t> method_slots(std::span<const std::string> methods) {
  constexpr std::size_t kNone = kOwners.size();
  std::vector<std::size_t> slots(methods.size(), kNone);
  std::vector<bool> is_taken(kOwners.size() + methods.size(), false);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const auto owner = static_cast<std::size_t>(
        std::find(kOwners.begin(), kOwners.end(), methods[i]) - kOwners.begin());
    if (owner == kNone || is_taken[owner]) continue;
    is_taken[owner] = true;
    slots[i] = owner;
  }
  for (std::size_t& slot : slots) {
    if (slot != kNone) continue;
    slot = static_cast<std::size_t>(std::find(is_taken.begin(), is_taken.end(), false) -
                                    is_taken.begin());
    is_taken[slot] = true;
  }
  return slots;
}

}  // namespace gnbv
