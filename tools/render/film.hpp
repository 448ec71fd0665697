// Images as a film, by ffmpeg or by Pillow in Python.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "sim/core/image.hpp"

namespace gnbv {

class ChildProcess;

/// Whether there is an ffmpeg on the PATH.
bool has_ffmpeg();

/// Of a film: .mp4 (by ffmpeg; H.264, sizes are cut to even numbers), .gif, .apng or .webp (by
/// Pillow).
bool is_film_ending(const std::string& ending);

/// Hands images to a program of its own; the film appears by rename when it is finished.
class Film {
 public:
  /// Throws BadInput naming the path for another ending, and what installs the program that is
  /// missing.
  Film(std::filesystem::path path, int width_px, int height_px, int images_per_s);
  /// Without finish(), nothing is left.
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// Requires the size of the film. Throws BadInput when the program has ended.
  void add(const Image& image);
  /// Requires an image. Throws BadInput naming the path when the program failed.
  void finish();

 private:
  void need(bool is_content, const std::string& why) const;

  std::filesystem::path path_;
  std::filesystem::path part_;
  int width_px_;
  int height_px_;
  bool is_by_ffmpeg_;
  std::unique_ptr<ChildProcess> program_;
};

}  // namespace gnbv
