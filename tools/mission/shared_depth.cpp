#include "tools/mission/shared_depth.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace gnbv {

SharedDepth::SharedDepth(std::size_t number)
    : path_(fmt::format("/dev/shm/gnbv-{}-{}.f32", getpid(), number)) {
  ::unlink(path_.c_str());  // what a killed process of that number left
  descriptor_ = open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0600);
}

SharedDepth::~SharedDepth() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(path_.c_str());
}

bool SharedDepth::write(std::span<const float> depth_m) {
  const auto bytes = std::as_bytes(depth_m);
  std::size_t done = 0;
  while (descriptor_ >= 0 && done < bytes.size()) {
    const ssize_t count =
        pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return descriptor_ >= 0;
}

}  // namespace gnbv
