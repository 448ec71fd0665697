#include "tools/live/live_report.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

#include "sim/core/error.hpp"
#include "tools/page/report.hpp"
#include "tools/run/run_files.hpp"
#include "tools/terminal/interrupt.hpp"
// last: it defines macros by which Eigen names things
#include <httplib.h>

namespace gnbv {
namespace {

using httplib::Request;
using httplib::Response;

constexpr std::chrono::milliseconds kLook{100};
constexpr int kLooksBetweenPages = 15;

constexpr const char* kHost = "127.0.0.1";
constexpr int kPatience_s = 5;         // with who neither sends nor takes
constexpr std::size_t kListeners = 8;  // at once; others wait
constexpr std::size_t kMostBody_bytes = 1024;

constexpr const char* kNothing = "default-src 'none'";  // may be loaded or run

struct Shown {
  // looks again by itself until there is a page
  std::string html =
      "<!doctype html><meta http-equiv=\"refresh\" content=\"1\"><title>gnbv</title>"
      "<p>Nothing flown yet.";
  std::string policy = kNothing;
  std::string views = "0";
};

/// In the place of any before: of two, a browser would keep both.
void set_policy(const std::string& policy, Response& response) {
  constexpr const char* kName = "Content-Security-Policy";
  response.headers.erase(kName);
  response.set_header(kName, policy + "; frame-ancestors 'none'");
}

void set_headers(Response& response) {
  set_policy(kNothing, response);
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("X-Frame-Options", "DENY");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cross-Origin-Opener-Policy", "same-origin");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.set_header("Cache-Control", "no-store");
}

void answer(int status, const std::string& text, Response& response) {
  response.status = status;
  response.set_content(text, "text/plain; charset=utf-8");
}

BadInput port_is_taken(int port) {
  return BadInput(
      "--live {}: this port of {} cannot be had: it is taken, or yours begin at 1024; 0 takes a "
      "free one",
      port, kHost);
}

/// Serves on 127.0.0.1 from threads of its own: `/` is the page, `/views` the number of views it
/// shows, with " finished" behind when they are all. Answers nothing but GET and HEAD, and only to
/// those who asked for this machine by name, so that no page of another site can read it. Who is
/// silent is dropped after seconds; eight who trickle keep others waiting.
class LiveServer {
 public:
  /// Port 0: any free one. Throws BadInput when the port cannot be had.
  explicit LiveServer(int port) {
    server_.new_task_queue = [] { return new httplib::ThreadPool(kListeners); };
    server_.set_read_timeout(kPatience_s);
    server_.set_write_timeout(kPatience_s);
    server_.set_keep_alive_timeout(kPatience_s);
    server_.set_payload_max_length(kMostBody_bytes);
    server_.set_pre_routing_handler(
        [this](const Request& request, Response& response) { return refuse(request, response); });
    server_.Get("/", [this](const Request&, Response& response) {
      const std::shared_ptr<const Shown> shown = now();  // the page and its policy of one moment
      set_policy(shown->policy, response);
      response.set_content(shown->html, "text/html; charset=utf-8");
    });
    server_.Get("/views", [this](const Request&, Response& response) {
      answer(200, now()->views + "\n", response);
    });
    // a port is not shared with who listens there already, as the library would
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    port_ = port == 0 ? server_.bind_to_any_port(kHost) : port;
    if (port_ <= 0 || (port != 0 && !server_.bind_to_port(kHost, port))) throw port_is_taken(port);
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();  // a stop() before that stops nothing
  }
  ~LiveServer() {
    server_.stop();
    thread_.join();
  }

  std::string url() const { return fmt::format("http://{}:{}/", kHost, port_); }

  /// What is served from now on.
  void show(Shown shown) {
    const std::lock_guard lock(mutex_);
    shown_ = std::make_shared<const Shown>(std::move(shown));
  }

 private:
  std::shared_ptr<const Shown> now() {
    const std::lock_guard lock(mutex_);
    return shown_;
  }

  /// A name of another site that was made to point here asks for itself.
  bool is_for_us(const Request& request) const {
    const std::string host = request.get_header_value("Host");
    const std::string end = fmt::format(":{}", port_);
    const auto is = [&](const std::string& name) {
      return host == name + end || (port_ == 80 && host == name);  // browsers leave that one out
    };
    return is(kHost) || is("localhost");
  }

  httplib::Server::HandlerResponse refuse(const Request& request, Response& response) const {
    using Done = httplib::Server::HandlerResponse;
    set_headers(response);
    if (!is_for_us(request)) {
      answer(403, "asked by another name\n", response);
    } else if (request.method != "GET" && request.method != "HEAD") {
      answer(405, "GET and HEAD only\n", response);
    } else {
      return Done::Unhandled;
    }
    return Done::Handled;
  }

  httplib::Server server_;
  int port_ = 0;
  std::mutex mutex_;  // of `shown_`, held only to copy the pointer
  std::shared_ptr<const Shown> shown_ = std::make_shared<Shown>();
  std::thread thread_;
};

/// What of the run there was when it was read last.
struct Stage {
  std::size_t views = 0;
  bool is_finished = false;

  bool operator==(const Stage&) const = default;
};

/// Nothing while the run has not begun, or is between two states of its files.
std::optional<RunRecord> read_growing(const std::filesystem::path& run) {
  try {
    return read_run(run);
  } catch (const BadInput&) {
    return std::nullopt;
  }
}

}  // namespace

void serve_report(const std::filesystem::path& run, const LiveReportOptions& options,
                  const std::function<void(const std::string& url)>& ready) {
  const InterruptGuard interrupt;
  LiveServer server(options.port);
  ready(server.url());
  std::optional<Stage> shown;
  for (int look = 0; !InterruptGuard::requested(); ++look) {
    if (look % kLooksBetweenPages == 0) {
      const bool was_finished =
          RunFiles(run).is_finished();  // asked first: the record has what it says
      const std::optional<RunRecord> record = read_growing(run);
      if (record && !record->views.empty()) {
        const Stage stage{record->views.size(), was_finished};
        if (shown != stage) {
          Report report =
              make_report({*record}, {.threads = options.threads, .is_live = true}, [](double) {});
          server.show(
              {.html = std::move(report.html),
               .policy = std::move(report.policy),
               .views = fmt::format("{}{}", stage.views, record->figures ? " finished" : "")});
          shown = stage;
        }
      }
    }
    std::this_thread::sleep_for(kLook);
  }
  std::_Exit(0);  // nothing is left to be put in order, and who trickles would hold us up
}

LiveChild::LiveChild(const std::filesystem::path& run, int port)
    : child_({"gnbv", "report", run.string(), "--live", std::to_string(port), "--threads", "1",
              "--quiet"},
             {.out = ChildStream::pipe,
              .err = ChildStream::nothing,
              .program = "/proc/self/exe",
              .is_apart = true,
              .niceness = 19}) {
  url_ = child_.read_line();
  if (child_.start_error() != 0) {
    throw std::system_error(child_.start_error(), std::generic_category(),
                            fmt::format("--live {}", port));
  }
  if (url_.empty()) throw port_is_taken(port);
}

LiveChild::~LiveChild() { child_.send(SIGKILL); }

}  // namespace gnbv
