// Fork and join. Results never depend on the number of threads: a task writes only what its own
// index owns, and whoever reduces does so in index order.
#pragma once

#include <cstddef>
#include <functional>

namespace gnbv {

/// Runs task(0) ... task(count - 1), each once, on up to `threads` threads, and waits for all.
/// The first exception by index is rethrown.
void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& task);

/// The same for work in small pieces: task(begin, end) for each range of `chunk` that [0, count) is
/// cut into; the last one may be shorter.
void parallel_for_chunks(int threads, std::size_t count, std::size_t chunk,
                         const std::function<void(std::size_t begin, std::size_t end)>& task);

}  // namespace gnbv
