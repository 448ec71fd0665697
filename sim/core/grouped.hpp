// Numbers as people read them.
#pragma once

#include <cstddef>
#include <string>

namespace gnbv {

/// "1,234,567".
std::string grouped(std::size_t count);

/// With so many decimals, thousands grouped as the paper does: "10,970", "-1,234.5"; never "-0".
std::string grouped(double value, int decimals);

}  // namespace gnbv
