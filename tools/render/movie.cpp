#include "tools/render/movie.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"

namespace gnbv {
namespace {

/// The same images give the same bytes: two threads whatever the machine has, no dates inside.
std::vector<std::string> ffmpeg_command(const std::string& format, const std::string& out,
                                        int width_px, int height_px, int images_per_s) {
  std::vector<std::string> words = {"ffmpeg",
                                    "-v",
                                    "error",
                                    "-y",
                                    "-f",
                                    "rawvideo",
                                    "-pixel_format",
                                    "rgb24",
                                    "-video_size",
                                    fmt::format("{}x{}", width_px, height_px),
                                    "-framerate",
                                    std::to_string(images_per_s),
                                    "-i",
                                    "-",
                                    "-threads",
                                    "2",
                                    "-fflags",
                                    "+bitexact",
                                    "-flags:v",
                                    "+bitexact"};
  const std::vector<std::string> last =
      format == "gif"
          ? std::vector<std::string>{"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse"}
          : std::vector<std::string>{"-vf",       "crop=trunc(iw/2)*2:trunc(ih/2)*2",
                                     "-c:v",      "libx264",
                                     "-preset",   "veryfast",
                                     "-crf",      "18",
                                     "-pix_fmt",  "yuv420p",
                                     "-movflags", "+faststart"};
  words.insert(words.end(), last.begin(), last.end());
  // plain, "a:b" would be a protocol to ffmpeg, and "-a" an option
  words.insert(words.end(), {"-f", format, "file:" + out});
  return words;
}

}  // namespace

bool has_ffmpeg() {
  const char* const path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "" : path;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const std::filesystem::path program = std::filesystem::path(folders.substr(0, end)) / "ffmpeg";
    if (::access(program.c_str(), X_OK) == 0) return true;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return false;
}

Movie::Movie(std::filesystem::path path, int width_px, int height_px, int images_per_s)
    : path_(std::move(path)),
      part_(path_.string() + ".part"),
      width_px_(width_px),
      height_px_(height_px) {
  const std::string extension = extension_of(path_);
  if (extension == ".apng") {
    apng_.emplace(images_per_s);
    return;
  }
  if (extension != ".mp4" && extension != ".gif") {
    throw BadInput(fmt::format("{}: a movie's name ends in .mp4, .gif or .apng", path_.string()));
  }
  int ends[2] = {-1, -1};  // a socket, not a pipe: writing to a dead one is an error, no signal
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw BadInput(
        fmt::format("{}: no socket for ffmpeg: {}", path_.string(), std::strerror(errno)));
  }
  const std::vector<std::string> words =
      ffmpeg_command(extension.substr(1), part_.string(), width_px, height_px, images_per_s);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = posix_spawnp(&ffmpeg_, "ffmpeg", &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  ::close(ends[0]);
  pipe_ = ends[1];
  if (error == 0) return;
  ffmpeg_ = 0;
  close();
  throw BadInput(
      fmt::format("{}: a movie needs ffmpeg on the PATH, Debian package ffmpeg: {}; "
                  "one that ends in .apng does not",
                  path_.string(), std::strerror(error)));
}

Movie::~Movie() {
  if (pipe_ < 0) return;
  close();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void Movie::add(const Image& image) {
  GNBV_CHECK(image.width_px == width_px_ && image.height_px == height_px_,
             "image of {} x {} px in a movie of {} x {}", image.width_px, image.height_px,
             width_px_, height_px_);
  if (apng_) return apng_->add(image);
  for (std::size_t done = 0; done < image.rgb.size();) {
    const ssize_t sent =
        send(pipe_, image.rgb.data() + done, image.rgb.size() - done, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw BadInput(fmt::format("{}: ffmpeg gave up", path_.string()));
    done += static_cast<std::size_t>(sent);
  }
}

void Movie::finish() {
  if (apng_) return write_file_atomically(path_, apng_->bytes());
  if (!close()) {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    throw BadInput(fmt::format("{}: ffmpeg could not write it", path_.string()));
  }
  sync_to_disk(part_);
  std::filesystem::rename(part_, path_);
}

bool Movie::close() {
  if (pipe_ >= 0) ::close(pipe_);
  pipe_ = -1;
  if (ffmpeg_ == 0) return false;
  int status = 0;
  while (waitpid(ffmpeg_, &status, 0) < 0 && errno == EINTR) {
  }
  ffmpeg_ = 0;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace gnbv
