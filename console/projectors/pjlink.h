// SPDX-License-Identifier: Apache-2.0
// PJLink (JBMIA), classes 1 and 2: what projectors say is read within bounds, in letters of any
// case; and one exchange at a time over TCP. One that is silent or odd is a state, never an error.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/hours.h"

namespace aquarama::console {

// The longest line of PJLink, with its end.
inline constexpr std::size_t kMostPjlinkBytes = 136;

// The first line of a projector: whether it wants a password, and the random number for it.
struct PjlinkGreeting {
    bool wantsPassword = false;
    bool refuses = false;  // the password was wrong
    std::string salt;      // its letters as they were sent: the proof is made of them
};
[[nodiscard]] std::optional<PjlinkGreeting> readGreeting(const std::string& line);
// What goes before the first command: MD5 of salt and password.
[[nodiscard]] std::string pjlinkProof(const std::string& salt, const std::string& password);

// The answer to a command, as "%1POWR ?": its value in capitals ("1", "OK", "ERR3"). Empty where it
// is none, or one to another command.
[[nodiscard]] std::optional<std::string> readPjlinkAnswer(const std::string& line,
                                                          const std::string& command);

// "100002": fan, lamp, temperature, cover, filter, other; 1 warns, 2 fails. Empty where the text is
// anything else.
[[nodiscard]] std::optional<std::vector<std::string>> problemsIn(const std::string& digits);
// "1234 1 5678 0": the hours of the first lamp.
[[nodiscard]] std::optional<std::uint32_t> lampHoursIn(const std::string& value);
// "31": whether there is no picture. Sound alone ("21") leaves the picture.
[[nodiscard]] std::optional<bool> shutIn(const std::string& value);

// How an exchange ended.
enum class PjlinkEnd : std::uint8_t {
    Answered,
    Unanswered,   // it greets, and does not answer this
    Unreachable,  // nobody accepts, or what does is no projector
    Refused       // the password is wrong, or there is none
};
struct PjlinkReply {
    PjlinkEnd end = PjlinkEnd::Unreachable;
    std::string value = {};  // in capitals; of Answered only
};

// How long is waited, at most. PJLink asks for an answer within two seconds; real projectors take
// up to eight.
struct PjlinkPatience {
    std::chrono::milliseconds connect{3000};
    std::chrono::milliseconds line{10'000};      // for a greeting, and for an answer
    std::chrono::milliseconds exchange{25'000};  // all of it, connecting once more included
    std::chrono::milliseconds reconnect{1000};   // for a projector that has just closed
};

// Exchanges with one projector, by one thread. The connection is kept between them; where the
// projector closes it, or wants the password again, it is made anew.
class PjlinkConnection {
  public:
    explicit PjlinkConnection(config::ControlledProjector projector, PjlinkPatience patience = {});
    ~PjlinkConnection();
    PjlinkConnection(const PjlinkConnection&) = delete;
    PjlinkConnection& operator=(const PjlinkConnection&) = delete;

    // Takes patience.exchange at most, and never throws.
    [[nodiscard]] PjlinkReply ask(const std::string& command);
    // Some projectors take one connection only: it is given back between looks.
    void close();
    // From any thread: an exchange that is under way ends at once, and so do all later ones.
    void stop();

  private:
    using Clock = std::chrono::steady_clock;
    enum class Heard : std::uint8_t { Line, Nothing, Closed };

    // All of them end at `end`, of a clock that never goes back.
    [[nodiscard]] bool waitFor(short what, Clock::time_point end) const;
    [[nodiscard]] bool connectTo(Clock::time_point end);
    [[nodiscard]] PjlinkEnd greet(Clock::time_point end);
    [[nodiscard]] PjlinkEnd open(Clock::time_point end);
    [[nodiscard]] Heard hear(std::string& line, Clock::time_point end);
    [[nodiscard]] bool say(const std::string& command);
    // Into `reply`, which stays Unanswered where nothing comes.
    [[nodiscard]] Heard exchange(const std::string& command,
                                 PjlinkReply& reply,
                                 Clock::time_point end);
    [[nodiscard]] std::optional<PjlinkReply> askAgain(const std::string& command,
                                                      Clock::time_point end);
    [[nodiscard]] PjlinkReply askAnew(const std::string& command, Clock::time_point end);

    config::ControlledProjector projector_;
    PjlinkPatience patience_;
    int socket_ = -1;
    int stopped_;         // an eventfd: readable when stop() was called
    std::string buffer_;  // heard, and not read yet
    std::string proof_;   // goes before the next command; empty after the first
};

}  // namespace aquarama::console
