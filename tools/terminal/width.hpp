// How wide what is printed may be.
#pragma once

#include <cstddef>

namespace gnbv {

/// Columns of the terminal that stdout is, or what the environment's COLUMNS asks for; 0 where
/// neither says so: files and pipes take lines of any length.
std::size_t stdout_columns();

/// Columns of the terminal that stderr is, 80 where it does not say so; 0 where it is none.
std::size_t stderr_columns();

}  // namespace gnbv
