// Laws of films: whole or not there.
#include <gtest/gtest.h>

#include <cstdlib>

#include "sim/core/error.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/render/movie.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

Image grey(int width_px, int height_px) {
  return {width_px, height_px,
          std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width_px * height_px), 128)};
}

bool has_ffmpeg() { return std::system("command -v ffmpeg >/dev/null") == 0; }

TEST(Movie, AppearsWholeUnderNamesThatFfmpegWouldReadOtherwise) {
  if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg";
  const TempFolder temp;
  const fs::path before = fs::current_path();
  fs::current_path(temp.path());
  for (const char* const name : {"http:film.mp4", "-film.mp4"}) {
    Movie movie(name, 32, 24, 24);
    movie.add(grey(32, 24));
    EXPECT_FALSE(fs::exists(name));
    movie.finish();
    EXPECT_GT(fs::file_size(name), 100U);
  }
  fs::current_path(before);
  EXPECT_EQ(std::distance(fs::directory_iterator(temp.path()), {}), 2);  // no parts are left
}

/// What a browser shows of an APNG, image by image: patches laid over what was there.
std::vector<Image> images_of(const std::string& apng) {
  std::vector<Image> images;
  const auto number = [](const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k)
      value = (value << 8) | static_cast<std::uint8_t>(bytes[at + k]);
    return static_cast<int>(value);
  };
  const std::string controls = png_chunks(apng, "fcTL");
  constexpr std::size_t kControl = 26;
  for (std::size_t i = 0; i < controls.size() / kControl; ++i) {
    const std::string control = controls.substr(kControl * i, kControl);
    images.push_back({number(control, 4), number(control, 8), {}});
  }
  return images;
}

TEST(Movie, AnimatedPngNeedsNoFfmpegAndHoldsEveryImage) {
  const TempFolder temp;
  const fs::path path = temp.path() / "film.apng";
  Movie movie(path, 32, 24, 24);
  Image image = grey(32, 24);
  movie.add(image);
  for (int i = 0; i < 3; ++i) image.rgb[3 * (32 * 5 + 7) + static_cast<std::size_t>(i)] = 9;
  movie.add(image);
  movie.add(image);  // nothing moves, time does
  EXPECT_FALSE(fs::exists(path));
  movie.finish();
  const std::string apng = read_file(path);
  const std::vector<Image> images = images_of(apng);
  ASSERT_EQ(images.size(), 3U);
  EXPECT_EQ(images[0].width_px, 32);
  EXPECT_EQ(images[1].width_px, 1);  // the pixel that changed
  EXPECT_EQ(images[1].height_px, 1);
  // who knows no animation sees the first image
  EXPECT_EQ(read_png(path).rgb, grey(32, 24).rgb);
}

TEST(Movie, HalfWrittenLeavesNothing) {
  if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg";
  const TempFolder temp;
  {
    Movie movie(temp.path() / "film.gif", 32, 24, 24);
    movie.add(grey(32, 24));
  }
  EXPECT_TRUE(fs::is_empty(temp.path()));
}

TEST(Movie, WithoutFfmpegNamesThePackage) {
  const TempFolder temp;
  const char* const path = std::getenv("PATH");
  const std::string before = path == nullptr ? "" : path;
  ::setenv("PATH", temp.path().c_str(), 1);
  std::string complaint;
  try {
    const Movie movie(temp.path() / "film.mp4", 32, 24, 24);
  } catch (const BadInput& error) {
    complaint = error.what();
  }
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_NE(complaint.find("Debian package ffmpeg"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(temp.path()));
  EXPECT_THROW(Movie(temp.path() / "film.avi", 32, 24, 24), BadInput);
}

}  // namespace
}  // namespace gnbv
