// How pictures name and colour the reasons for which candidates were rejected.
#pragma once

#include <span>
#include <string_view>

#include "planner/view_validity.hpp"
#include "tools/render/colour.hpp"

namespace gnbv {

struct RejectionLook {
  Rejection rejection;
  std::string_view words;
  Rgb colour;
};

/// Of all reasons, in their order. The colours stand apart from each other and from the marks of
/// the chosen view, for people with colour blindness, too.
std::span<const RejectionLook> rejection_looks();

}  // namespace gnbv
