// SPDX-License-Identifier: Apache-2.0
#include "console/access.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include <nlohmann/json.hpp>

#include "common/base/dates.h"
#include "common/base/digest.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/output_file.h"
#include "common/base/random_bytes.h"
#include "common/base/typed_code.h"

namespace aquarama::console {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Ten minutes, as the text beside the code says.
constexpr double kCodeSeconds = 600;
// 30 days, as long as the cookie that cookieOf() makes.
constexpr double kSessionSeconds = 30.0 * 86400;
// The code ends with this wrong guess.
constexpr int kMostWrong = 5;
// Seconds. The pause after a code that was spent by wrong guesses doubles up to this.
constexpr double kLongestPause = 3600;
// Of sessions and of tokens each. The oldest session gives way; another token is refused.
constexpr std::size_t kMostHolders = 256;
// Of addresses that have spent a code.
constexpr std::size_t kMostRefusals = 1024;
constexpr std::uintmax_t kMostFileBytes = 1U << 20U;
// A longer name is cut; see shownName().
constexpr std::size_t kMostNameBytes = 40;

// Names in the state folder. Other runs of the program write the codes and the tokens as well.
constexpr const char* kCodeFile = "pairing.json";
constexpr const char* kSessionFile = "sessions.json";
constexpr const char* kTokenFile = "tokens.json";

// What a page or a terminal may show: no control characters, not long.
std::string shownName(std::string name) {
    name.resize(std::min(name.size(), kMostNameBytes));
    std::ranges::replace_if(
        name, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
    return name.empty() ? "browser" : name;
}

// An empty list where there is no file. Throws Error where it is damaged.
json read(const fs::path& path) {
    std::error_code none;
    if (!fs::exists(path, none)) return json::array();
    const std::vector<std::byte> bytes = readWhole(path, kMostFileBytes);
    const auto* const begin = reinterpret_cast<const char*>(bytes.data());
    json parsed = json::parse(begin, begin + bytes.size(), nullptr, false);
    if (parsed.is_discarded())
        throw Error(path.string() + ": is damaged; remove it, and let everybody in again");
    return parsed;
}

constexpr const char* kLoss = "who is let in or out is forgotten with the end of the console";

// Whole or not at all; the folder lets nobody else in. Whether it was written.
bool write(const fs::path& path, const json& content) {
    const std::string text = content.dump(1);
    return keepIfPossible(path, std::as_bytes(std::span(text)), kLoss);
}

// The people or machines of a file.
std::vector<Holder> holdersIn(const fs::path& path) {
    std::vector<Holder> holders;
    try {
        for (const json& one : read(path)) {
            Holder holder{.id = {},
                          .hash = one.at("hash").get<std::string>(),
                          .name = one.at("name").get<std::string>(),
                          .role = roleNamed(one.at("role").get<std::string>()).value(),
                          .since = one.at("since").get<double>(),
                          .until = one.at("until").get<double>()};
            holder.id = holder.hash.substr(0, 12);
            holders.push_back(std::move(holder));
        }
    } catch (const std::exception& problem) {
        throw Error(path.string() + ": is damaged; remove it, and let everybody in again (" +
                    problem.what() + ")");
    }
    return holders;
}

// Hashes only: whoever reads the file cannot come in with it.
void writeHolders(const fs::path& path, const std::vector<Holder>& holders) {
    json all = json::array();
    for (const Holder& one : holders)
        all.push_back({{"hash", one.hash},
                       {"name", one.name},
                       {"role", nameOf(one.role)},
                       {"since", one.since},
                       {"until", one.until}});
    write(path, all);
}

// The holder of a secret; by its hash, so that how long a comparison takes tells nothing of it.
std::optional<Holder> holderOf(const std::vector<Holder>& holders, std::string_view secret) {
    const auto found = std::ranges::find(holders, hashOfSecret(secret), &Holder::hash);
    return found == holders.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

// The words of the files and of the pages; roleNamed() reads them.
std::string_view nameOf(ConsoleRole role) {
    switch (role) {
        case ConsoleRole::Watcher:
            return "watcher";
        case ConsoleRole::Operator:
            return "operator";
        default:
            return "crew";
    }
}

// Nothing where no role has this name.
std::optional<ConsoleRole> roleNamed(std::string_view name) {
    for (const ConsoleRole role : {ConsoleRole::Watcher, ConsoleRole::Operator, ConsoleRole::Crew})
        if (nameOf(role) == name) return role;
    return std::nullopt;
}

UnixSeconds unixNow() {
    return systemSeconds();
}

// OpenSSL's generator, seeded by the kernel.
std::string freshSecret() {
    const auto bytes = randomBytes<32>();
    std::string text;
    for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

// In hexadecimal, without a salt: what is hashed is random.
std::string hashOfSecret(std::string_view secret) {
    return toHex(digestOf(std::string(secret)));
}

// Others may neither list nor read the folder.
Access::Access(fs::path folder, UnixSeconds built) : folder_{std::move(folder)}, built_{built} {
    std::error_code failure;
    fs::create_directories(folder_, failure);
    fs::permissions(folder_, fs::perms::owner_all, failure);
    if (failure)
        warnOnceOf(folder_, folder_.string() + ": " + whyNotWritten(failure.value()), kLoss);
    sessions_ = holdersIn(folder_ / kSessionFile);
}

std::string Access::makeCode(ConsoleRole role, UnixSeconds now) {
    const std::string code = freshCode();
    const json content{{"hash", hashOfSecret(code)},
                       {"role", nameOf(role)},
                       {"since", now},
                       {"until", now + kCodeSeconds}};
    code_ = content.dump();
    std::error_code none;
    if (!write(folder_ / kCodeFile, content)) fs::remove(folder_ / kCodeFile, none);
    wrong_ = 0;
    return shownCode(code);
}

// A clock that was set back would refuse it for years: no longer than the longest pause.
bool Access::isRefused(const std::string& client, UnixSeconds now) const {
    const auto refusal = refusals_.find(client);
    return refusal != refusals_.end() && now < refusal->second.until &&
           refusal->second.until <= now + kLongestPause;
}

// Bounded: a flood of addresses forgets the oldest by name, which guess no code the more often.
void Access::refuse(const std::string& client, UnixSeconds now) {
    if (refusals_.size() >= kMostRefusals && !refusals_.contains(client))
        refusals_.erase(refusals_.begin());
    Refusal& refusal = refusals_[client];
    refusal.until = now + refusal.pauseSeconds;
    refusal.pauseSeconds = std::min(2 * refusal.pauseSeconds, kLongestPause);
}

// The code is read again: another run of the program may have made it. One from the future was made
// before the clock was set back. Where it could not be written it is that of this run.
std::optional<std::string> Access::pair(const std::string& code,
                                        const Applicant& who,
                                        UnixSeconds now,
                                        bool& spent) {
    spent = false;
    json valid = read(folder_ / kCodeFile);
    if (!valid.is_object()) valid = json::parse(code_, nullptr, false);
    if (isRefused(who.client, now) || !valid.is_object() || valid.value("until", 0.0) < now ||
        valid.value("since", now) > now)
        return std::nullopt;
    if (valid.value("hash", "") != hashOfSecret(plainCode(code))) {
        if (++wrong_ < kMostWrong) return std::nullopt;
        spent = true;
        refuse(who.client, now);
        forgetCode();
        return std::nullopt;
    }
    forgetCode();
    std::string secret = freshSecret();
    const std::string hash = hashOfSecret(secret);
    const UnixSeconds since = std::max(now, built_);
    std::erase_if(sessions_, [&](const Holder& one) { return one.until < since; });
    if (sessions_.size() == kMostHolders) sessions_.erase(sessions_.begin());
    sessions_.push_back({hash.substr(0, 12),
                         hash,
                         shownName(who.name),
                         roleNamed(valid.value("role", "")).value_or(ConsoleRole::Watcher),
                         since,
                         since + kSessionSeconds});
    writeHolders(folder_ / kSessionFile, sessions_);
    return secret;
}

void Access::forgetCode() {
    std::error_code none;
    fs::remove(folder_ / kCodeFile, none);
    code_.clear();
}

// One that has run out is none, nor one that a clock far ahead has dated.
std::optional<Holder> Access::session(std::string_view secret, UnixSeconds now) const {
    const auto holder = holderOf(sessions_, secret);
    if (!holder || holder->until <= std::max(now, built_)) return std::nullopt;
    const bool isFromFuture = holder->since > now + kSecondsOfDay;
    return isFromFuture && clockDoubt(now, built_).empty() ? std::nullopt : holder;
}

// Its cookie means nothing any more.
void Access::revoke(const std::string& id) {
    std::erase_if(sessions_, [&](const Holder& one) { return one.id == id; });
    writeHolders(folder_ / kSessionFile, sessions_);
}

// The last one of the same name ends.
std::string Access::makeToken(const std::string& name, ConsoleRole role, UnixSeconds now) {
    std::vector<Holder> tokens = holdersIn(folder_ / kTokenFile);
    std::erase_if(tokens, [&](const Holder& one) { return one.name == name; });
    if (tokens.size() == kMostHolders)
        throw Error("there are " + std::to_string(kMostHolders) + " tokens already; remove " +
                    (folder_ / kTokenFile).string() + " and make those anew that are used");
    std::string secret = freshSecret().substr(0, 32);
    const std::string hash = hashOfSecret(secret);
    tokens.push_back({hash.substr(0, 12), hash, shownName(name), role, now, 0});
    writeHolders(folder_ / kTokenFile, tokens);
    return secret;
}

// Read each time: tokens are made by other runs of the program.
std::optional<Holder> Access::token(std::string_view secret) const {
    try {
        return holderOf(holdersIn(folder_ / kTokenFile), secret);
    } catch (const Error& problem) {
        logWarning("{}", problem.what());
        return std::nullopt;
    }
}

}  // namespace aquarama::console
