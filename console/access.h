// SPDX-License-Identifier: Apache-2.0
// Who may use the console: pairing codes, sessions of people, tokens of machines. Only hashes of
// secrets are kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace aquarama::console {

// What somebody may do, each more than the one before; numbered as in console.proto.
enum class ConsoleRole : std::uint8_t { Watcher = 1, Operator = 2, Crew = 3 };
[[nodiscard]] std::string_view nameOf(ConsoleRole role);
[[nodiscard]] std::optional<ConsoleRole> roleNamed(std::string_view name);

// Seconds of Unix time.
using UnixSeconds = double;
// By the system's clock, which somebody may set.
[[nodiscard]] UnixSeconds unixNow();

// Whoever has been let in: a browser by a session, a machine by a token.
struct Holder {
    std::string id;  // the first letters of `hash`: names it to people
    std::string hash;
    std::string name;
    ConsoleRole role = ConsoleRole::Watcher;
    UnixSeconds since = 0, until = 0;
};

// 256 random bits, as 64 hexadecimal digits.
[[nodiscard]] std::string freshSecret();
// What the files hold instead of a secret, in hexadecimal.
[[nodiscard]] std::string hashOfSecret(std::string_view secret);

// Who shows a code: the name that was typed, and the address it comes from.
struct Applicant {
    std::string name, client = {};
};

// The lists of a rig's console in one folder, readable by its owner only. One thread uses it.
// Sessions are written by the running console alone; codes and tokens also by other runs of the
// program, so both are read again whenever they matter. A clock that is wrong lengthens nothing:
// see session().
class Access {
  public:
    // Makes the folder. Where it cannot be written, a warning says so, and who is let in is kept in
    // memory. `built`: when this program was; no clock before that is right. Throws Error where
    // what the folder holds cannot be read.
    explicit Access(std::filesystem::path folder, UnixSeconds built = 0);

    // A code of eight letters and digits that lets one browser in within ten minutes, as `role`;
    // the last one ends.
    std::string makeCode(ConsoleRole role, UnixSeconds now);
    // The secret of a new session; empty where this is not the code that is valid now. After five
    // wrong ones the code ends, from whatever addresses, and whoever guessed last is refused for a
    // while that doubles each time. `spent` becomes true where this try ended the code.
    std::optional<std::string> pair(const std::string& code,
                                    const Applicant& who,
                                    UnixSeconds now,
                                    bool& spent);
    [[nodiscard]] bool hasPeople() const { return !sessions_.empty(); }

    // The holder of a session's secret, where it is valid. By a clock before the program's build
    // those are that were at that time; later, none that begins in the future.
    [[nodiscard]] std::optional<Holder> session(std::string_view secret, UnixSeconds now) const;
    // All sessions, also those that have run out.
    [[nodiscard]] std::vector<Holder> people() const { return sessions_; }
    // Ends a session.
    void revoke(const std::string& id);

    // A new token for a machine; its secret is shown once.
    std::string makeToken(const std::string& name, ConsoleRole role, UnixSeconds now);
    // The holder of a machine's token. A file that cannot be read lets nobody in, and is logged.
    [[nodiscard]] std::optional<Holder> token(std::string_view secret) const;

  private:
    // Of whoever spent a code. `pauseSeconds`: for the next one.
    struct Refusal {
        UnixSeconds until = 0;
        double pauseSeconds = 30;
    };
    [[nodiscard]] bool isRefused(const std::string& client, UnixSeconds now) const;
    void refuse(const std::string& client, UnixSeconds now);

    void forgetCode();

    std::filesystem::path folder_;
    std::string code_;  // the last that this run has made, as its file has it
    UnixSeconds built_;
    std::vector<Holder> sessions_;
    int wrong_ = 0;
    std::map<std::string, Refusal> refusals_;  // by address
};

}  // namespace aquarama::console
