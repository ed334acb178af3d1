// SPDX-License-Identifier: Apache-2.0
#include "common/ask/drawing_reader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/wire/messages.h"

namespace aquarama::ask {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kProgram = "aquarama-drawings";
constexpr std::size_t kMostAnswerBytes = wire::kMostSkinBytes + 256;

// Beside the running program, else in PATH; empty: nowhere.
fs::path decoder() {
    std::error_code none;
    std::vector<fs::path> folders{fs::read_symlink("/proc/self/exe", none).parent_path()};
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets it
    const char* path = std::getenv("PATH");
    std::istringstream list(path != nullptr ? path : "");
    for (std::string folder; std::getline(list, folder, ':');) folders.emplace_back(folder);
    for (const fs::path& folder : folders)
        if (folder.is_absolute() && access((folder / kProgram).c_str(), X_OK) == 0)
            return folder / kProgram;
    return {};
}

// A program that hears and speaks by one socket, its standard input and output. It has no other
// file of this process but standard error, and nothing of its environment.
class Child {
  public:
    explicit Child(const fs::path& program) {
        std::array<int, 2> ends{};
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
        socket_ = ends[0];
        spawn(program, ends[1]);
        close(ends[1]);
    }
    ~Child() {
        if (process_ > 0) {
            kill(process_, SIGKILL);
            waitpid(process_, nullptr, 0);
        }
        if (socket_ >= 0) close(socket_);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    [[nodiscard]] bool runs() const { return process_ > 0; }
    [[nodiscard]] int socket() const { return socket_; }

  private:
    void spawn(const fs::path& program, int end) {
        posix_spawn_file_actions_t files;
        posix_spawn_file_actions_init(&files);
        posix_spawn_file_actions_adddup2(&files, end, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&files, end, STDOUT_FILENO);
        posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
        std::string name = program.string(), command = "decode";
        std::array<char*, 3> arguments{name.data(), command.data(), nullptr};
        std::array<char*, 1> environment{nullptr};
        if (posix_spawn(&process_,
                        name.c_str(),
                        &files,
                        &attributes,
                        arguments.data(),
                        environment.data()) != 0)
            process_ = 0;
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&files);
    }
    pid_t process_ = 0;
    int socket_ = -1;
};

// Sends a picture and takes the answer, both as far as they come.
class Exchange {
  public:
    Exchange(int socket, std::string_view picture) : socket_{socket}, left_{picture} {}
    // Waits for a tenth of a second at most. False: the answer has ended.
    bool goOn() {
        constexpr int kMilliseconds = 100;
        pollfd waiting{socket_, static_cast<short>(hasSaidAll_ ? POLLIN : POLLIN | POLLOUT), 0};
        if (poll(&waiting, 1, kMilliseconds) <= 0) return true;
        if ((waiting.revents & POLLOUT) != 0) say();
        return (waiting.revents & (POLLIN | POLLHUP | POLLERR)) == 0 || hear();
    }
    [[nodiscard]] const std::string& answer() const { return answer_; }

  private:
    void say() {
        const ssize_t count =
            send(socket_, left_.data(), left_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (count > 0) left_.remove_prefix(static_cast<std::size_t>(count));
        const bool isOver = count < 0 && errno != EAGAIN && errno != EINTR;
        if (!left_.empty() && !isOver) return;
        hasSaidAll_ = true;
        shutdown(socket_, SHUT_WR);
    }
    bool hear() {
        std::array<char, 65536> piece{};
        const ssize_t count = recv(socket_, piece.data(), piece.size(), MSG_DONTWAIT);
        if (count < 0) return errno == EAGAIN || errno == EINTR;
        answer_.append(piece.data(), static_cast<std::size_t>(count));
        return count > 0 && answer_.size() <= kMostAnswerBytes;
    }
    int socket_;
    std::string_view left_;  // of the picture
    bool hasSaidAll_ = false;
    std::string answer_;
};

// Small letters, digits and underscores.
bool isWord(std::string_view text) {
    constexpr std::size_t kMostLetters = 64;
    return !text.empty() && text.size() <= kMostLetters &&
           text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") ==
               std::string_view::npos;
}

// What follows a beginning; nothing where a text begins otherwise.
std::optional<std::string_view> after(std::string_view beginning, std::string_view text) {
    if (!text.starts_with(beginning)) return std::nullopt;
    return text.substr(beginning.size());
}

// "SPECIES BYTES", and the skin behind it.
std::optional<DrawingOutcome> drawingIn(std::string_view head, std::string_view skin) {
    const std::string_view species = head.substr(0, head.find(' '));
    const bool isWhole = isWord(species) && !skin.empty() && skin.size() <= wire::kMostSkinBytes &&
                         head == std::string(species) + ' ' + std::to_string(skin.size());
    if (!isWhole) return std::nullopt;
    return ReadDrawing{std::string(species), std::string(skin)};
}

}  // namespace

std::optional<DrawingOutcome> outcomeIn(std::string_view answer) {
    const std::size_t end = answer.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = answer.substr(0, end);
    if (const auto head = after("drawing ", line)) return drawingIn(*head, answer.substr(end + 1));
    const auto word = after("refused ", line);
    if (!word || !isWord(*word)) return std::nullopt;
    return DrawingRefused{std::string(*word)};
}

DrawingReader::DrawingReader() : DrawingReader(decoder()) {
    if (!isInstalled())
        logWarning(
            "visitors' drawings cannot be read: there is no {} beside this program, nor in PATH; "
            "install the package {}",
            kProgram,
            kProgram);
}

DrawingReader::DrawingReader(fs::path program, double mostSeconds)
    : program_{std::move(program)}, mostSeconds_{mostSeconds}, thread_{[this] { run(); }} {}

DrawingReader::~DrawingReader() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

bool DrawingReader::read(std::string picture, std::function<void(const DrawingOutcome&)> done) {
    if (!isInstalled() || picture.size() > kMostPictureBytes) return false;
    {
        const std::lock_guard lock(mutex_);
        if (jobs_.size() >= kMostWaiting) return false;
        jobs_.push_back({std::move(picture), std::move(done)});
    }
    changed_.notify_all();
    return true;
}

bool DrawingReader::hasEnded() {
    const std::lock_guard lock(mutex_);
    return ended_;
}

// The first picture is removed after its answer, so that it counts among those that wait.
void DrawingReader::run() {
    while (true) {
        const Job* job = nullptr;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return ended_ || !jobs_.empty(); });
            if (ended_) return;
            job = &jobs_.front();
        }
        const DrawingOutcome outcome = outcomeOf(job->picture);
        if (hasEnded()) return;
        job->done(outcome);
        const std::lock_guard lock(mutex_);
        jobs_.pop_front();
    }
}

std::string DrawingReader::answerTo(const std::string& picture) {
    const auto giveUp = Clock::now() + std::chrono::duration<double>(mostSeconds_);
    const Child child(program_);
    Exchange exchange(child.socket(), picture);
    while (child.runs() && exchange.goOn() && !hasEnded() && Clock::now() < giveUp) {
    }
    return exchange.answer();
}

DrawingOutcome DrawingReader::outcomeOf(const std::string& picture) {
    if (auto outcome = outcomeIn(answerTo(picture))) return *std::move(outcome);
    if (hasEnded()) return DrawingRefused{"unreadable"};
    ++failures_;
    logWarning(
        "a visitor's picture of {} bytes could not be read: {} was killed or failed; it is "
        "number {} since the start",
        picture.size(),
        kProgram,
        failures_);
    return DrawingRefused{"unreadable"};
}

}  // namespace aquarama::ask
