#include "tools/render/film.hpp"

#include <iterator>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "sim/core/child_process.hpp"
#include "sim/core/embed.hpp"
#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

GNBV_EMBED(write_film_py, GNBV_WRITE_FILM_PY);

const ChildOptions kFed = {.in = ChildStream::pipe, .out = ChildStream::pipe};

/// Pillow's formats by endings.
const std::map<std::string, std::string>& pillow_formats() {
  static const std::map<std::string, std::string> all = {
      {".gif", "GIF"}, {".apng", "PNG"}, {".webp", "WEBP"}};
  return all;
}

/// The same images give the same bytes: two threads whatever the machine has, no dates inside.
std::vector<std::string> ffmpeg_command(const std::string& out, const std::string& size,
                                        const std::string& images_per_s) {
  std::istringstream words(
      "ffmpeg -v error -y -f rawvideo -pixel_format rgb24 -video_size " + size + " -framerate " +
      images_per_s +
      " -i - -threads 2 -fflags +bitexact -flags:v +bitexact -vf crop=trunc(iw/2)*2:trunc(ih/2)*2"
      " -c:v libx264 -preset veryfast -crf 18 -pix_fmt yuv420p -movflags +faststart -f mp4");
  std::vector<std::string> command(std::istream_iterator<std::string>(words), {});
  // plain, "a:b" would be a protocol to ffmpeg, and "-a" an option
  command.push_back("file:" + out);
  return command;
}

}  // namespace

bool has_ffmpeg() {
  return ChildProcess({"ffmpeg", "-version"}, {.out = ChildStream::nothing}).end().is_success();
}

bool is_film_ending(const std::string& ending) {
  return ending == ".mp4" || pillow_formats().contains(ending);
}

Film::Film(std::filesystem::path path, int width_px, int height_px, int images_per_s)
    : path_(std::move(path)),
      part_(path_.string() + ".part"),
      width_px_(width_px),
      height_px_(height_px),
      is_by_ffmpeg_(extension_of(path_) == ".mp4") {
  const std::string ending = extension_of(path_);
  need(is_film_ending(ending), "a film's name ends in .mp4, .gif, .apng or .webp");
  const std::string width = std::to_string(width_px);
  const std::string height = std::to_string(height_px);
  const std::string speed = std::to_string(images_per_s);
  if (is_by_ffmpeg_) {
    program_ = std::make_unique<ChildProcess>(
        ffmpeg_command(part_.string(), width + "x" + height, speed), kFed);
    need(program_->start_error() == 0,
         "needs ffmpeg on the PATH, Debian package ffmpeg; an .apng does without");
    return;
  }
  program_ = std::make_unique<ChildProcess>(
      std::vector<std::string>{python_program(), "-c", std::string(write_film_py()), part_.string(),
                               pillow_formats().at(ending), width, height, speed},
      kFed);
  const std::string complaint = program_->read_line();
  need(program_->is_open(), fmt::format("needs Python with Pillow, Debian package python3-pil: {} "
                                        "does not run; GNBV_PYTHON names another",
                                        python_program()));
  need(complaint.empty(), complaint);
}

Film::~Film() {
  program_.reset();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void Film::need(bool is_content, const std::string& why) const {
  if (!is_content) throw BadInput("{}: {}", path_.string(), why);
}

void Film::add(const Image& image) {
  GNBV_CHECK(image.width_px == width_px_ && image.height_px == height_px_,
             "image of {} x {} px in a film of {} x {}", image.width_px, image.height_px, width_px_,
             height_px_);
  if (!is_by_ffmpeg_) program_->write("\1");
  program_->write({reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size()});
  need(program_->is_open(), is_by_ffmpeg_ ? "ffmpeg gave up" : "Pillow gave up");
}

void Film::finish() {
  if (is_by_ffmpeg_) {
    need(program_->end().is_success(), "ffmpeg could not write it");
  } else {
    program_->write({"\0", 1});
    const std::string complaint = program_->read_line();
    need(complaint.empty() && program_->is_open(), "Pillow could not write it: " + complaint);
  }
  sync_to_disk(part_);
  std::filesystem::rename(part_, path_);
}

}  // namespace gnbv
