// Fork and join. Results never depend on the number of threads as long as a task writes only what
// its index owns, and sums are taken in the order of the indices.
#pragma once

#include <cstddef>
#include <functional>

namespace gnbv {

/// Runs task(0) ... task(count - 1), each once, on up to `threads` threads, and waits for all.
/// The first exception by index is rethrown.
void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& task);

/// The same for small pieces: task(begin, end) for each range of `chunk` in [0, count), of which
/// the last may be shorter.
void parallel_for_chunks(int threads, std::size_t count, std::size_t chunk,
                         const std::function<void(std::size_t begin, std::size_t end)>& task);

}  // namespace gnbv
