// SPDX-License-Identifier: Apache-2.0
#include "console/pjlink.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <openssl/evp.h>
#include <poll.h>
#include <spdlog/fmt/fmt.h>
#include <sys/socket.h>
#include <unistd.h>

namespace aquarama::console {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr auto kBetweenLooks = std::chrono::seconds(20);   // more often, and some of them hang
constexpr auto kAfterACommand = std::chrono::seconds(10);  // which some need to themselves
// For the connection, and for each answer.
constexpr milliseconds kPatience{2000};

// False when the time is over.
bool waitFor(int socket, short what, Clock::time_point end) {
    const auto left = std::chrono::duration_cast<milliseconds>(end - Clock::now()).count();
    pollfd waiting{socket, what, 0};
    return left > 0 && poll(&waiting, 1, static_cast<int>(left)) > 0;
}

// A connection that never waits longer than it is told.
class Line {
  public:
    // Takes numeric IPv4 addresses only. isOpen() is false where nobody accepts in time.
    Line(const config::ControlledProjector& projector, milliseconds patience)
        : patience_{patience},
          socket_{socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)} {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(static_cast<std::uint16_t>(projector.port));
        if (inet_pton(AF_INET, projector.host.c_str(), &to.sin_addr) != 1) return;
        const int begun = connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to);
        if (begun != 0 && errno != EINPROGRESS) return;
        int problem = 0;
        socklen_t size = sizeof problem;
        isOpen_ = waitFor(socket_, POLLOUT, Clock::now() + patience_) &&
                  getsockopt(socket_, SOL_SOCKET, SO_ERROR, &problem, &size) == 0 && problem == 0;
    }
    ~Line() {
        if (socket_ >= 0) close(socket_);
    }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    [[nodiscard]] bool isOpen() const { return isOpen_; }

    // PJLink ends a command by a carriage return. False where the line was not taken whole.
    bool say(const std::string& text) {
        const std::string line = text + "\r";
        return send(socket_, line.data(), line.size(), MSG_NOSIGNAL) ==
               static_cast<ssize_t>(line.size());
    }

    // Up to the next carriage return; empty where none comes in time, or the line is too long.
    std::optional<std::string> hear() {
        const auto end = Clock::now() + patience_;
        std::array<char, kMostPjlinkBytes> part{};
        while (true) {
            const std::size_t found = buffer_.find('\r');
            if (found != std::string::npos) {
                std::string line = buffer_.substr(0, found);
                buffer_.erase(0, found + 1);
                return line;
            }
            if (buffer_.size() >= kMostPjlinkBytes || !waitFor(socket_, POLLIN, end))
                return std::nullopt;
            const ssize_t count = recv(socket_, part.data(), part.size(), 0);
            if (count <= 0) return std::nullopt;
            buffer_.append(part.data(), static_cast<std::size_t>(count));
        }
    }

  private:
    milliseconds patience_;
    int socket_;
    bool isOpen_ = false;
    std::string buffer_;
};

// ASCII: it is shown on pages and in logs.
bool isPrintable(const std::string& text) {
    return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

// ERR3 and the like: it is there, and not able to say so now.
std::string powerWord(const PjlinkAnswers& answers) {
    if (answers.refusesPassword) return "refuses the password";
    if (!answers.isThere || answers.values[0].empty()) return "no answer";
    constexpr std::array kWords{"off", "on", "cooling", "warming"};
    const std::string& value = answers.values[0];
    if (value.size() == 1 && value[0] >= '0' && value[0] <= '3')
        return kWords[static_cast<std::size_t>(value[0] - '0')];
    return "not now";
}

}  // namespace

// Anything else is another protocol, or noise.
std::optional<PjlinkGreeting> readGreeting(const std::string& line) {
    constexpr std::size_t kMostSalt = 32;
    if (line == "PJLINK 0") return PjlinkGreeting{};
    if (line == "PJLINK ERRA") return PjlinkGreeting{.refuses = true, .salt = {}};
    const std::string start = "PJLINK 1 ";
    if (!line.starts_with(start)) return std::nullopt;
    const std::string salt = line.substr(start.size());
    if (salt.empty() || salt.size() > kMostSalt || !isPrintable(salt)) return std::nullopt;
    return PjlinkGreeting{.wantsPassword = true, .salt = salt};
}

// MD5, because the standard says so; it keeps out mistakes, not attackers.
std::string pjlinkProof(const std::string& salt, const std::string& password) {
    const std::string text = salt + password;
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_md5(), nullptr);
    std::string proof;
    for (unsigned i = 0; i < size; ++i) proof += fmt::format("{:02x}", digest.at(i));
    return proof;
}

// To this command, and to no other.
std::optional<std::string> readPjlinkAnswer(const std::string& line, const std::string& command) {
    const std::string start = "%1" + command.substr(0, 4) + "=";
    if (line.size() > kMostPjlinkBytes || !line.starts_with(start)) return std::nullopt;
    std::string value = line.substr(start.size());
    if (value.empty() || !isPrintable(value)) return std::nullopt;
    return value;
}

// In the order of the standard.
std::vector<std::string> problemsIn(const std::string& digits) {
    constexpr std::array kParts{"fan", "lamp", "temperature", "cover", "filter", "other"};
    std::vector<std::string> problems;
    for (std::size_t i = 0; i < std::min(kParts.size(), digits.size()); ++i) {
        if (digits[i] == '1') problems.push_back(std::string(kParts.at(i)) + ": warning");
        if (digits[i] == '2') problems.push_back(std::string(kParts.at(i)) + ": error");
    }
    return problems;
}

// The proof goes before the first command only.
PjlinkAnswers askProjector(const config::ControlledProjector& projector,
                           const std::vector<std::string>& commands,
                           milliseconds patience) {
    PjlinkAnswers answers{.values = std::vector<std::string>(commands.size())};
    Line line(projector, patience);
    if (!line.isOpen()) return answers;
    const auto first = line.hear();
    const auto greeting = first ? readGreeting(*first) : std::nullopt;
    if (!greeting || greeting->refuses) {
        answers.refusesPassword = greeting.has_value();
        return answers;
    }
    answers.isThere = true;
    for (std::size_t i = 0; i < commands.size(); ++i) {
        const bool isProved = i == 0 && greeting->wantsPassword;
        const std::string proof = isProved ? pjlinkProof(greeting->salt, projector.password) : "";
        if (!line.say(proof + "%1" + commands[i])) return answers;
        const auto said = line.hear();
        if (said == "PJLINK ERRA") {
            answers.refusesPassword = true;
            return answers;
        }
        if (!said) return answers;
        answers.values[i] = readPjlinkAnswer(*said, commands[i]).value_or("");
    }
    return answers;
}

// What is not answered is as if nothing were wrong.
ProjectorFacts lookAtProjector(const config::ControlledProjector& projector,
                               milliseconds patience) {
    const PjlinkAnswers answers =
        askProjector(projector, {"POWR ?", "AVMT ?", "ERST ?", "LAMP ?"}, patience);
    ProjectorFacts facts{.power = powerWord(answers), .problems = {}};
    facts.isShut = answers.values[1] == "31" || answers.values[1] == "11";
    if (!answers.values[2].starts_with("ERR")) facts.problems = problemsIn(answers.values[2]);
    constexpr std::uint32_t kMostHours = 1'000'000;
    for (const char c : answers.values[3]) {
        if (c < '0' || c > '9' || facts.lampHours > kMostHours) break;
        facts.lampHours = 10 * facts.lampHours + static_cast<std::uint32_t>(c - '0');
    }
    return facts;
}

ProjectorWatch::ProjectorWatch(config::ControlledProjector projector)
    : projector_{std::move(projector)}, thread_{[this] { run(); }} {}

// Returns when the exchange that is under way has ended.
ProjectorWatch::~ProjectorWatch() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

// The same again wakes nobody.
void ProjectorWatch::want(std::optional<bool> power, std::optional<bool> shut) {
    {
        const std::lock_guard lock(mutex_);
        const auto before = std::pair{power_, shut_};
        if (power) power_ = power;
        if (shut) shut_ = shut;
        isNew_ = isNew_ || before != std::pair{power_, shut_};
    }
    changed_.notify_all();
}

// A copy: the thread of the watch replaces what is kept.
ProjectorFacts ProjectorWatch::facts() const {
    const std::lock_guard lock(mutex_);
    return facts_;
}

// Looks, brings it to what is wanted, and rests.
void ProjectorWatch::run() {
    std::unique_lock lock(mutex_);
    while (!ended_) {
        isNew_ = false;
        lock.unlock();
        const ProjectorFacts facts = lookAtProjector(projector_, kPatience);
        press(facts);
        lock.lock();
        facts_ = facts;
        changed_.wait_for(lock, kBetweenLooks, [this] { return ended_ || isNew_; });
    }
}

namespace {

// What brings a projector from what it is to what is wanted. The shutter is set while the lamp is
// on; a projector that warms or cools is left alone.
std::vector<std::string> commandsFor(const ProjectorFacts& facts,
                                     std::optional<bool> power,
                                     std::optional<bool> shut) {
    std::vector<std::string> commands;
    const bool isOn = facts.power == "on";
    if (isOn && shut.value_or(facts.isShut) != facts.isShut)
        commands.emplace_back(*shut ? "AVMT 31" : "AVMT 30");
    if ((isOn || facts.power == "off") && power.value_or(isOn) != isOn)
        commands.emplace_back(*power ? "POWR 1" : "POWR 0");
    return commands;
}

}  // namespace

// Some need some seconds to themselves after that.
void ProjectorWatch::press(const ProjectorFacts& facts) {
    std::vector<std::string> commands;
    {
        const std::lock_guard lock(mutex_);
        commands = commandsFor(facts, power_, shut_);
    }
    if (commands.empty()) return;
    static_cast<void>(askProjector(projector_, commands, kPatience));
    const bool isPower = commands.back().starts_with("POWR");
    std::unique_lock lock(mutex_);
    changed_.wait_for(
        lock, isPower ? kAfterACommand : std::chrono::seconds(1), [this] { return ended_; });
}

}  // namespace aquarama::console
