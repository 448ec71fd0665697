#include "planner/guided/user_utility.hpp"

#include <algorithm>
#include <cctype>

#include "planner/view/view_fields.hpp"

namespace gnbv {
namespace {

/// As a whole word, also in a comment: what costs time there costs no result.
bool names(std::string_view source, std::string_view word) {
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (std::size_t at = source.find(word); at != std::string_view::npos;
       at = source.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !is_part(source[at - 1]);
    if (begins && (end == source.size() || !is_part(source[end]))) return true;
  }
  return false;
}

bool names_any(const UserUtilityConfig& config, ViewFieldNeeds least) {
  return std::any_of(kViewFields.begin(), kViewFields.end(), [&](const ViewField& field) {
    return field.needs >= least && names(config.source, field.name);
  });
}

}  // namespace

bool names_ray_fields(const UserUtilityConfig& config) {
  return names_any(config, ViewFieldNeeds::rays);
}

bool names_prediction(const UserUtilityConfig& config) {
  return names(config.source, "predicted_voxels");
}

bool names_shadow_fields(const UserUtilityConfig& config) {
  return names_any(config, ViewFieldNeeds::shadow);
}

}  // namespace gnbv
