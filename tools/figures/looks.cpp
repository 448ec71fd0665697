#include "tools/figures/looks.hpp"

#include <algorithm>

namespace gnbv {
namespace {

/// Whose each of the first numbers is.
constexpr std::array<std::string_view, 7> kOwners = {
    "proposed", "bircher", "isler", "tour", "oracle_metres", "oracle_views", "released"};

}  // namespace

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
  auto free = is_taken.begin();
  for (std::size_t& slot : slots) {
    if (slot != kNone) continue;
    free = std::find(free, is_taken.end(), false);
    *free = true;
    slot = static_cast<std::size_t>(free - is_taken.begin());
  }
  return slots;
}

SeriesLook look_of_slot(std::size_t slot) {
  static const std::array<std::vector<double>, 5> kDashes = {
      {{}, {5.0, 2.5}, {1.8, 2.0}, {0.8, 2.0}, {5.0, 2.0, 0.8, 2.0}}};
  constexpr std::array<std::string_view, 6> kMarkers = {"circle",   "square",  "triangle",
                                                        "downward", "diamond", "pentagon"};
  return {.colour = std::string(kPalette[slot % kPalette.size()]),
          .dashes = kDashes[slot % kDashes.size()],
          .marker = std::string(kMarkers[slot % kMarkers.size()])};
}

std::vector<SeriesLook> method_looks(std::span<const std::string> methods) {
  std::vector<SeriesLook> looks;
  for (const std::size_t slot : method_slots(methods)) looks.push_back(look_of_slot(slot));
  return looks;
}

}  // namespace gnbv
