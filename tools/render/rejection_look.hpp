// How pictures and pages name and colour the reasons for which candidates were rejected.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "planner/motion/paths.hpp"
#include "tools/render/colour.hpp"

namespace gnbv {

struct RejectionLook {
  Rejection rejection;
  std::string_view words;
  std::uint32_t rrggbb;  // as pages have it
  Rgb colour = srgb(rrggbb);
};

/// Of all reasons, in their order. The colours stand apart from each other and from the marks of
/// the chosen view, for people with colour blindness, too.
std::span<const RejectionLook> rejection_looks();

}  // namespace gnbv
