// The latest depth frame of a camera, in memory that another process of this machine maps.
#pragma once

#include <span>
#include <string>

namespace gnbv {

class SharedDepth {
 public:
  /// Named after this process and the number; gone with this object.
  explicit SharedDepth(std::size_t number);
  ~SharedDepth();
  SharedDepth(const SharedDepth&) = delete;
  SharedDepth& operator=(const SharedDepth&) = delete;

  /// (height, width) row-major float32 in metres, as DepthFrame has them: in the place of the frame
  /// before. Whether there is such memory here.
  bool write(std::span<const float> depth_m);
  /// A file that may be mapped or read.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace gnbv
