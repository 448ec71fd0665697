// Pictures as JPEG, for pages that have to stay small.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/core/image.hpp"

namespace gnbv {

/// Baseline JPEG. `quality` from 1 to 100.
std::vector<std::uint8_t> jpeg_bytes(const Image& image, int quality);

/// The picture at a whole fraction of its size, each pixel the mean of the square it replaces; what
/// remains at the right and the bottom is cut off. Requires factor >= 1 and a picture that large.
Image shrunk(const Image& image, int factor);

}  // namespace gnbv
