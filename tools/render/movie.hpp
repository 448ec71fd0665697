// Images as a film: by ffmpeg, or without it as an animated PNG.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>

#include "tools/render/apng.hpp"

namespace gnbv {

/// Whether there is an ffmpeg on the PATH.
bool has_ffmpeg();

/// Hands images to an ffmpeg of its own, or keeps them for an APNG; the film appears by rename when
/// it is finished.
class Movie {
 public:
  /// `path` ends in .mp4 (H.264; sizes are cut to even numbers), .gif or .apng. Throws BadInput
  /// naming the path for another ending, and the Debian package when the first two find no ffmpeg
  /// on the PATH.
  Movie(std::filesystem::path path, int width_px, int height_px, int images_per_s);
  /// Without finish(), nothing is left.
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// Requires the size of the film. Throws BadInput when ffmpeg has ended.
  void add(const Image& image);
  /// Throws BadInput naming the path when ffmpeg failed.
  void finish();

 private:
  bool close();  // whether ffmpeg was content

  std::filesystem::path path_;
  std::filesystem::path part_;
  std::optional<Apng> apng_;
  int width_px_;
  int height_px_;
  pid_t ffmpeg_ = 0;
  int pipe_ = -1;
};

}  // namespace gnbv
