// SPDX-License-Identifier: Apache-2.0
#include "console/projectors/pjlink.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <string_view>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/evp.h>
#include <poll.h>
#include <spdlog/fmt/fmt.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/base/characters.h"

namespace aquarama::console {

namespace {

using std::chrono::milliseconds;

// ASCII: it is shown on pages and in logs.
bool isPrintable(const std::string& text) {
    return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

// Of ASCII alone, whatever the locale.
std::string inCapitals(std::string_view text) {
    std::string capitals(text);
    for (char& c : capitals)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return capitals;
}

// What ends a line: some send a line feed, both, or a zero after the carriage return.
bool endsLine(char c) {
    return c == '\r' || c == '\n' || c == '\0';
}

// "PJLINK ERRA", or a value ERRA: the password is wrong.
bool isPasswordRefusal(const std::string& line) {
    const std::string said = inCapitals(trimmed(line));
    return said == "PJLINK ERRA" || (said.starts_with('%') && said.ends_with("=ERRA"));
}

// The address of a projector for connect(); 0 where the text is none.
socklen_t addressOf(const config::ControlledProjector& projector, sockaddr_storage& address) {
    const in_port_t port = htons(static_cast<std::uint16_t>(projector.port));
    sockaddr_in four{};
    sockaddr_in6 six{};
    if (inet_pton(AF_INET, projector.host.c_str(), &four.sin_addr) == 1) {
        four.sin_family = AF_INET;
        four.sin_port = port;
        std::memcpy(&address, &four, sizeof four);
        return sizeof four;
    }
    if (inet_pton(AF_INET6, projector.host.c_str(), &six.sin6_addr) != 1) return 0;
    six.sin6_family = AF_INET6;
    six.sin6_port = port;
    std::memcpy(&address, &six, sizeof six);
    return sizeof six;
}

}  // namespace

// Anything else is another protocol, or noise.
std::optional<PjlinkGreeting> readGreeting(const std::string& line) {
    constexpr std::size_t kMostSalt = 32;
    const std::string said = inCapitals(trimmed(line));
    if (said == "PJLINK 0") return PjlinkGreeting{};
    if (said == "PJLINK ERRA") return PjlinkGreeting{.refuses = true, .salt = {}};
    const std::string start = "PJLINK 1 ";
    if (!said.starts_with(start)) return std::nullopt;
    const std::string salt{trimmed(trimmed(line).substr(start.size()))};
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

namespace {

// Whether a line in capitals begins as an answer to a command does. Projectors of class 2 name
// either class.
bool isAnswerTo(const std::string& said, const std::string& command) {
    constexpr std::size_t kHeader = 2, kName = 4;
    if (command.size() < kHeader + kName) return false;
    const std::string name = command.substr(kHeader, kName) + "=";
    return said.starts_with("%1" + name) || said.starts_with("%2" + name);
}

}  // namespace

// A value may stand after a blank.
std::optional<std::string> readPjlinkAnswer(const std::string& line, const std::string& command) {
    constexpr std::size_t kStart = 7;  // "%1POWR="
    if (line.size() > kMostPjlinkBytes) return std::nullopt;
    const std::string said = inCapitals(trimmed(line));
    if (!isAnswerTo(said, command)) return std::nullopt;
    std::string value{trimmed(std::string_view(said).substr(kStart))};
    if (value.empty() || !isPrintable(value)) return std::nullopt;
    return value;
}

// In the order of the standard.
std::optional<std::vector<std::string>> problemsIn(const std::string& digits) {
    constexpr std::array kParts{"fan", "lamp", "temperature", "cover", "filter", "other"};
    if (digits.size() != kParts.size()) return std::nullopt;
    if (digits.find_first_not_of("012") != std::string::npos) return std::nullopt;
    std::vector<std::string> problems;
    for (std::size_t i = 0; i < kParts.size(); ++i)
        if (digits[i] != '0')
            problems.push_back(std::string(kParts.at(i)) +
                               (digits[i] == '1' ? ": warning" : ": error"));
    return problems;
}

// "ERR1" of a projector without a lamp is no number.
std::optional<std::uint32_t> lampHoursIn(const std::string& value) {
    constexpr std::size_t kMostDigits = 6;
    const std::size_t end = std::min(value.find(' '), value.size());
    if (end == 0 || end > kMostDigits) return std::nullopt;
    std::uint32_t hours = 0;
    for (const char c : value.substr(0, end)) {
        if (c < '0' || c > '9') return std::nullopt;
        hours = 10 * hours + static_cast<std::uint32_t>(c - '0');
    }
    return hours;
}

// 1 is the picture, 2 the sound, 3 both; then whether it is muted.
std::optional<bool> shutIn(const std::string& value) {
    static const std::map<std::string, bool> kValues{
        {"31", true}, {"11", true}, {"30", false}, {"10", false}, {"20", false}, {"21", false}};
    const auto found = kValues.find(value);
    return found == kValues.end() ? std::nullopt : std::optional(found->second);
}

PjlinkConnection::PjlinkConnection(config::ControlledProjector projector, PjlinkPatience patience)
    : projector_{std::move(projector)}, patience_{patience}, stopped_{eventfd(0, EFD_CLOEXEC)} {}

PjlinkConnection::~PjlinkConnection() {
    close();
    if (stopped_ >= 0) ::close(stopped_);
}

// What was heard and not read belongs to this connection.
void PjlinkConnection::close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
    buffer_.clear();
    proof_.clear();
}

// It stays readable: nobody reads it.
void PjlinkConnection::stop() {
    const std::uint64_t one = 1;
    static_cast<void>(!write(stopped_, &one, sizeof one));
}

// False when the time is over, or stop() was called. Without events it only waits.
bool PjlinkConnection::waitFor(short what, Clock::time_point end) const {
    const auto left = std::chrono::ceil<milliseconds>(end - Clock::now()).count();
    std::array<pollfd, 2> waiting{{{stopped_, POLLIN, 0}, {what == 0 ? -1 : socket_, what, 0}}};
    return left > 0 && poll(waiting.data(), waiting.size(), static_cast<int>(left)) > 0 &&
           waiting[0].revents == 0;
}

// False where nobody accepts in time.
bool PjlinkConnection::connectTo(Clock::time_point end) {
    close();
    sockaddr_storage address{};
    const socklen_t size = addressOf(projector_, address);
    if (size == 0) return false;
    socket_ = socket(address.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const int begun = connect(socket_, reinterpret_cast<const sockaddr*>(&address), size);
    if (begun != 0 && errno != EINPROGRESS) return false;
    int problem = 0;
    socklen_t problemSize = sizeof problem;
    return waitFor(POLLOUT, std::min(end, Clock::now() + patience_.connect)) &&
           getsockopt(socket_, SOL_SOCKET, SO_ERROR, &problem, &problemSize) == 0 && problem == 0;
}

// The next line that is not empty. Nothing: none came in time, or it is too long.
PjlinkConnection::Heard PjlinkConnection::hear(std::string& line, Clock::time_point end) {
    std::array<char, kMostPjlinkBytes> part{};
    while (true) {
        const auto begin = std::ranges::find_if_not(buffer_, endsLine);
        const auto ended = std::find_if(begin, buffer_.end(), endsLine);
        if (ended != buffer_.end()) {
            line.assign(begin, ended);
            buffer_.erase(buffer_.begin(), ended);
            return Heard::Line;
        }
        if (buffer_.size() > kMostPjlinkBytes || !waitFor(POLLIN, end)) return Heard::Nothing;
        const ssize_t count = recv(socket_, part.data(), part.size(), 0);
        if (count <= 0) return Heard::Closed;
        buffer_.append(part.data(), static_cast<std::size_t>(count));
    }
}

// Its first line: the proof is of this connection alone.
PjlinkEnd PjlinkConnection::greet(Clock::time_point end) {
    std::string line;
    if (hear(line, std::min(end, Clock::now() + patience_.line)) != Heard::Line)
        return PjlinkEnd::Unreachable;
    const auto greeting = readGreeting(line);
    if (!greeting) return PjlinkEnd::Unreachable;
    if (greeting->refuses) return PjlinkEnd::Refused;
    if (greeting->wantsPassword) proof_ = pjlinkProof(greeting->salt, projector_.password);
    return PjlinkEnd::Answered;
}

// Twice, where nobody accepts at first: one that has just closed needs a moment.
PjlinkEnd PjlinkConnection::open(Clock::time_point end) {
    const bool hasJustClosed = socket_ >= 0;
    if (!connectTo(end)) {
        if (!hasJustClosed) return PjlinkEnd::Unreachable;
        static_cast<void>(waitFor(0, std::min(end, Clock::now() + patience_.reconnect)));
        if (!connectTo(end)) return PjlinkEnd::Unreachable;
    }
    return greet(end);
}

// The proof goes before the first command only. False where the line was not taken whole.
bool PjlinkConnection::say(const std::string& command) {
    const std::string line = std::exchange(proof_, {}) + command + "\r";
    return send(socket_, line.data(), line.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(line.size());
}

// Answers to other commands, which came too late, are passed over: some, not many.
PjlinkConnection::Heard PjlinkConnection::exchange(const std::string& command,
                                                   PjlinkReply& reply,
                                                   Clock::time_point end) {
    constexpr int kMostLines = 16;
    if (!say(command)) return Heard::Closed;
    const auto lineEnd = std::min(end, Clock::now() + patience_.line);
    std::string said;
    for (int i = 0; i < kMostLines; ++i) {
        const Heard heard = hear(said, lineEnd);
        if (heard != Heard::Line) return heard;
        const auto value = readPjlinkAnswer(said, command);
        if (isPasswordRefusal(said))
            reply = {PjlinkEnd::Refused};
        else if (value)
            reply = {PjlinkEnd::Answered, *value};
        if (reply.end != PjlinkEnd::Unanswered) return Heard::Line;
    }
    return Heard::Nothing;
}

// On the connection of an earlier command. Empty where it was closed since, or its password held
// for one command only.
std::optional<PjlinkReply> PjlinkConnection::askAgain(const std::string& command,
                                                      Clock::time_point end) {
    PjlinkReply reply{PjlinkEnd::Unanswered};
    const Heard heard = exchange(command, reply, end);
    if (reply.end == PjlinkEnd::Answered) return reply;
    if (heard != Heard::Nothing) return std::nullopt;
    close();  // a late answer would be taken for that to the next command
    return reply;
}

// On a connection that is made for it.
PjlinkReply PjlinkConnection::askAnew(const std::string& command, Clock::time_point end) {
    PjlinkReply reply{open(end)};
    if (reply.end == PjlinkEnd::Answered) {
        reply.end = PjlinkEnd::Unanswered;
        static_cast<void>(exchange(command, reply, end));
    }
    if (reply.end != PjlinkEnd::Answered) close();
    return reply;
}

PjlinkReply PjlinkConnection::ask(const std::string& command) {
    const auto end = Clock::now() + patience_.exchange;
    if (socket_ < 0) return askAnew(command, end);
    const auto reply = askAgain(command, end);
    return reply ? *reply : askAnew(command, end);
}

}  // namespace aquarama::console
