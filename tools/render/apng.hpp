// Images as an animated PNG, which browsers play and which needs no program but this one.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/core/image.hpp"

namespace gnbv {

/// The bytes of an APNG (W3C PNG, third edition, 2025), grown image by image. Each holds what has
/// changed since the one before, and that again only where it changed. It repeats for ever.
class Apng {
 public:
  explicit Apng(int images_per_s) : images_per_s_(images_per_s) {}

  /// Requires the size of the first one.
  void add(const Image& image);
  /// The whole file. Requires an image.
  std::string bytes() const;

 private:
  int images_per_s_;
  Image before_;
  std::uint32_t images_ = 0;
  std::uint32_t sequence_ = 0;  // of the chunks that APNG numbers
  std::string chunks_;          // of all images
};

/// The chunks of a PNG by that name, one after the other, their contents alone.
std::string png_chunks(std::string_view png, std::string_view name);

}  // namespace gnbv
