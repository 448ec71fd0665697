#include "tools/plots/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "sim/core/error.hpp"
#include "sim/core/file.hpp"
#include "sim/core/text.hpp"

namespace gnbv {
namespace {

constexpr double kColumn_px = 1512.0;
constexpr double kColumn_in = 3.5;

constexpr const char* kStyle =
    R"(set encoding utf8
set minussign
set border 3 lc rgb '#5c6470' lw 0.8
set tics out nomirror scale 0.5 textcolor rgb '#3a424d'
set format x '%g'  # the default keeps room for a sign, left of the number
set grid lc rgb '#e4e7eb' lt 1 dt 1 lw 0.7
set key textcolor rgb '#262c36' samplen 1.4 spacing 1.05 reverse Left
set xlabel textcolor rgb '#262c36' offset 0,0.4
set ylabel textcolor rgb '#262c36'
)";

/// A file without a name, that is gone when it is closed.
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
File nameless_file(std::string_view content) {
  File file(std::tmpfile(), std::fclose);
  const bool is_written =
      file && std::fwrite(content.data(), 1, content.size(), file.get()) == content.size() &&
      std::fflush(file.get()) == 0;
  if (!is_written) refuse_to_write("a temporary file", errno);
  std::rewind(file.get());
  return file;
}

std::string content_of(std::FILE* file) {
  std::rewind(file);
  std::string content;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), file) != nullptr) {
    content += buffer.data();
  }
  return content;
}

std::string all_from(int pipe) {
  std::string content;
  std::array<char, std::size_t{1} << 16> block{};
  while (true) {
    const ssize_t count = read(pipe, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return content;
    content.append(block.data(), static_cast<std::size_t>(count));
  }
}

/// What gnuplot draws by the script. Through a pipe: on a full disk gnuplot itself ends well.
std::string picture_by_gnuplot(std::FILE* script, const std::filesystem::path& picture) {
  const File errors = nameless_file("");
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) refuse_to_write("a pipe", errno);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, fileno(script), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, fileno(errors.get()), STDERR_FILENO);
  // -d: what the user's own configuration sets would change the picture
  std::array<char, 8> name = {"gnuplot"};
  std::array<char, 3> no_defaults = {"-d"};
  std::array<char*, 3> arguments = {name.data(), no_defaults.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  std::string content = error == 0 ? all_from(ends[0]) : "";
  close(ends[0]);
  if (error == ENOENT) {
    throw BadInput("gnuplot is not installed; `apt-get install gnuplot-nox`, or tools/setup, does");
  }
  if (error != 0) refuse_to_write("gnuplot", error);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  GNBV_CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0,
             "gnuplot refuses the script of {}: status {}: {}", picture.string(), status,
             content_of(errors.get()));
  return content;
}

/// Cairo writes the time of day into a PDF. As long a date, so that the file's offsets stay right.
void fix_date(std::string& content) {
  constexpr std::string_view kKey = "/CreationDate (";
  const std::size_t key = content.starts_with("%PDF") ? content.rfind(kKey) : std::string::npos;
  if (key == std::string::npos) return;
  const std::size_t end = std::min(content.find(')', key), content.size());
  std::string_view date = "20000101000000";  // and nothing but zeros after it, as of a zone
  for (std::size_t i = key + kKey.size(); i < end; ++i) {
    if (content[i] < '0' || content[i] > '9') continue;
    content[i] = date.empty() ? '0' : date.front();
    date.remove_prefix(std::min<std::size_t>(date.size(), 1));
  }
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
  std::string quoted = "'";
  while (!text.empty()) {
    const std::string_view before = text;
    const char32_t code = take_code_point(text);
    if (code == U'\ufffd') {
      quoted += "\ufffd";
    } else if (code < 0x20 || code == 0x7f) {
      quoted += ' ';
    } else if (code == U'\'') {
      quoted += "''";
    } else {
      quoted += before.substr(0, before.size() - text.size());
    }
  }
  return quoted + "'";
}

std::string plot_script(const Plot& plot, PlotFormat format, const PlotSize& size) {
  const double scale = size.width_px / kColumn_px;
  const int height_px =
      size.height_px > 0 ? size.height_px : static_cast<int>(std::lround(scale * plot.height_px));
  std::string terminal;
  switch (format) {
    case PlotFormat::svg:
      terminal = fmt::format(
          "svg noenhanced rounded size {},{} fixed background rgb 'white' font 'Arial,{:.2f}' "
          "linewidth {:.4f}",
          size.width_px, height_px, 42.0 * scale, 4.5 * scale);
      break;
    case PlotFormat::png:
      terminal = fmt::format(
          "pngcairo noenhanced rounded size {},{} background rgb 'white' font 'Sans,12' fontscale "
          "{:.4f} "
          "linewidth {:.4f} pointscale {:.4f}",
          size.width_px, height_px, 3.0 * scale, 4.5 * scale, 4.0 * scale);
      break;
    case PlotFormat::pdf:
      terminal = fmt::format(
          "pdfcairo noenhanced rounded size {:.4f}in,{:.4f}in background rgb 'white' font 'Sans,8' "
          "fontscale {:.4f} linewidth {:.4f}",
          kColumn_in * scale, kColumn_in * height_px / kColumn_px, 0.8 * scale, scale);
      break;
  }
  return "set terminal " + terminal + "\n" + kStyle + plot.body;
}

void draw_plot(const std::string& script, const std::filesystem::path& picture) {
  const File input = nameless_file(script);
  std::string content = picture_by_gnuplot(input.get(), picture);
  fix_date(content);
  write_file_atomically(picture, content);
}

}  // namespace gnbv
