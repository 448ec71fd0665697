// How wide what is printed may be.
#pragma once

#include <cstddef>

namespace gnbv {

/// Columns of the terminal that stdout is, or what the environment's COLUMNS asks for; 0 where
/// neither says so: files and pipes take lines of any length.
std::size_t stdout_columns();

}  // namespace gnbv
