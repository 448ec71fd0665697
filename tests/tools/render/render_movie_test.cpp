// Laws of films: whole or not there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "sim/core/child_process.hpp"
#include "sim/core/file.hpp"
#include "tests/tools/render/laid_out.hpp"
#include "tools/render/film.hpp"

namespace gnbv {
namespace {

namespace fs = std::filesystem;

const Image kGrey = paper(32, 24, 128);

TEST(Film, AppearsWholeUnderNamesThatFfmpegWouldReadOtherwise) {
  if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg";
  const TempFolder temp;
  const fs::path before = fs::current_path();
  fs::current_path(temp.path());
  for (const char* const name : {"http:film.mp4", "-film.mp4"}) {
    Film movie(name, 32, 24, 24);
    movie.add(kGrey);
    EXPECT_FALSE(fs::exists(name));
    movie.finish();
    EXPECT_GT(fs::file_size(name), 100U);
  }
  fs::current_path(before);
  EXPECT_EQ(std::distance(fs::directory_iterator(temp.path()), {}), 2);  // no parts are left
}

bool has_pillow() {
  return std::system((python_program() + " -c 'import PIL' 2>/dev/null").c_str()) == 0;
}

/// What Pillow says of a file: images, width, height, milliseconds of all, the red of a pixel of
/// the first and the last.
std::string told_by_pillow(const fs::path& film) {
  ChildProcess pillow({python_program(), "-c", R"(
import sys
from PIL import Image
film = Image.open(sys.argv[1])
length, reds = 0, []
for i in range(film.n_frames):
    film.seek(i)
    film.load()
    length += film.info["duration"]
    reds.append(film.convert("RGB").getpixel((7, 5))[0])
print(film.n_frames, *film.size, round(length), reds[0], reds[-1])
)",
                       film.string()},
                      {.out = ChildStream::pipe});
  return pillow.read_line();
}

TEST(Film, OfPillowHoldsEveryImageAndRepeatsByteForByte) {
  if (!has_pillow()) GTEST_SKIP() << "no Pillow";
  const TempFolder temp;
  for (const char* const name : {"film.apng", "film.webp"}) {
    std::string bytes;
    for (const bool is_again : {false, true}) {
      Film film(temp.path() / name, 32, 24, 20);
      Image image = kGrey;
      film.add(image);
      for (int i = 0; i < 3; ++i) image.rgb[3 * (32 * 5 + 7) + static_cast<std::size_t>(i)] = 9;
      film.add(image);
      EXPECT_EQ(fs::exists(temp.path() / name), is_again);
      film.finish();
      EXPECT_TRUE(!is_again || read_file(temp.path() / name) == bytes) << name;
      bytes = read_file(temp.path() / name);
    }
    EXPECT_EQ(told_by_pillow(temp.path() / name), "2 32 24 100 128 9") << name;
  }
}

TEST(Film, HalfWrittenLeavesNothing) {
  const TempFolder temp;
  for (const char* const name : {"film.gif", "film.mp4"}) {
    if (std::string(name) == "film.gif" ? !has_pillow() : !has_ffmpeg()) continue;
    Film film(temp.path() / name, 32, 24, 24);
    film.add(kGrey);
  }
  EXPECT_TRUE(fs::is_empty(temp.path()));
}

/// One line, before anything is drawn, that says what to install.
TEST(Film, NamesWhatIsMissing) {
  const TempFolder temp;
  const auto said = [&](const char* name) {
    return test::fault_of([&] { const Film film(temp.path() / name, 32, 24, 24); });
  };
  const std::string path = std::getenv("PATH");
  const std::string python = python_program();
  ::setenv("PATH", temp.path().c_str(), 1);
  EXPECT_NE(said("film.mp4").find("Debian package ffmpeg"), std::string::npos);
  ::setenv("PATH", path.c_str(), 1);
  ::setenv("GNBV_PYTHON", "/nowhere/python", 1);
  EXPECT_NE(said("film.apng").find("Debian package python3-pil"), std::string::npos);
  // a Python that knows no Pillow
  write_file_atomically(temp.path() / "bare", "#!/bin/sh\nexec python3 -I -S \"$@\"\n");
  fs::permissions(temp.path() / "bare", fs::perms::owner_all);
  ::setenv("GNBV_PYTHON", (temp.path() / "bare").c_str(), 1);
  EXPECT_NE(said("film.webp").find("Debian package python3-pil"), std::string::npos);
  ::setenv("GNBV_PYTHON", python.c_str(), 1);
  EXPECT_NE(said("film.avi").find("film.avi"), std::string::npos);
}

}  // namespace
}  // namespace gnbv
