// SPDX-License-Identifier: Apache-2.0
// `aquarama doctor`: checks a wall before a show: the rig, its keys and ports, this machine and,
// through the running master, every node and its connection.
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <ifaddrs.h>
#include <netdb.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "commands/commands.h"
#include "commands/doctor.h"
#include "commands/doctor_journal.h"
#include "commands/findings.h"
#include "common/ask/request_client.h"
#include "common/base/counted.h"
#include "common/base/dates.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/net/clock.h"
#include "common/wall/wall.h"
#include "common/wire/journal_text.h"
#include "common/wire/wanted_show.h"
#include "master/supervisor/preflight.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// Options of `doctor`. `json`: for other programs, as the console.
struct DoctorOptions {
    std::string rig = supervisor::kDefaultRig;
    std::string keyFolder;  // empty: the user's
    bool json = false;
};

// 2^30 bytes, for repertoires, keys and logs; here and on the machines of nodes.
constexpr std::uint64_t kLeastDiskBytes = std::uint64_t{1} << 30U;
// An older key is still valid, and gets a warning.
constexpr double kOldKeyDays = 365;
constexpr float kSlowRoundTripMs = 5;  // a frame's release is announced 2 ms before it
// Share of lost pings; more is a warning.
constexpr float kMostUnansweredPercent = 1;

// Advice about a wrong clock, for this machine and for each node's.
constexpr const char* kSynchronise =
    "install chrony or linuxptp, so that the logs of all machines agree; frames do not need it";

// A number of bytes in units of 10^9.
std::string gigabytes(std::uint64_t bytes) {
    return fmt::format("{:.0f} GB free", static_cast<double>(bytes) / 1e9);
}

// Judges the age of a key. It is unknown where the key's date is later than the clock.
void judgeAge(Findings& findings, const config::KeyFile& key) {
    const std::string subject = "key " + key.name;
    const double now = systemSeconds();
    const auto made = secondsOfDay(key.made);
    const bool isKnown = made && *made <= now;
    if (!isKnown)
        return findings.judge(
            false,
            Verdict::Warn,
            subject,
            "made on " + key.made + ", and the clock of this machine says " + dayOf(now),
            "its age is not known: set the clock of this machine, or make another key (aquarama "
            "keys rotate)");
    const double days = (now - *made) / kSecondsOfDay;
    findings.judge(days <= kOldKeyDays,
                   Verdict::Warn,
                   subject,
                   counted(static_cast<std::uint64_t>(days), "day") + " old",
                   "older than a year: aquarama keys rotate makes another");
}

// A key that is missing or revoked fails; an old one is a warning.
void lookAtKey(Findings& findings, const fs::path& folder, const std::string& name) {
    try {
        const config::KeyFile key = config::readKeyFile(config::keyFileIn(folder, name));
        if (!key.revoked.empty())
            throw Error("was revoked on " + key.revoked + "; aquarama keys rotate makes another");
        judgeAge(findings, key);
    } catch (const Error& problem) {
        findings.fail("key " + name, problem.what());
    }
}

// Resolves a numeric address of the rig; null where it is not numeric.
using NumericAddress = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;
NumericAddress numericAddress(std::string host) {
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    addrinfo numeric{};
    numeric.ai_flags = AI_NUMERICHOST;
    numeric.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (getaddrinfo(host.c_str(), nullptr, &numeric, &found) != 0) found = nullptr;
    return {found, &freeaddrinfo};
}

// Version 4 or 6, without the port; empty for other families.
std::string_view bytesOf(const sockaddr* address) {
    const auto view = [](const auto& bytes) {
        return std::string_view(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    };
    if (address == nullptr) return {};
    if (address->sa_family == AF_INET)
        return view(reinterpret_cast<const sockaddr_in*>(address)->sin_addr);
    if (address->sa_family == AF_INET6)
        return view(reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr);
    return {};
}

// All of 127.0.0.0/8 is this machine, whether an interface names it or not (Debian gives the host's
// name 127.0.1.1), and so is ::1.
bool isLoopbackAddress(std::string_view bytes) {
    constexpr std::size_t kBytes4 = 4;
    constexpr unsigned char kLoopbackNet = 127;
    if (bytes.size() == kBytes4) return static_cast<unsigned char>(bytes[0]) == kLoopbackNet;
    return bytes == std::string_view(reinterpret_cast<const char*>(&in6addr_loopback),
                                     sizeof in6addr_loopback);
}

// Whether the rig's address belongs to this machine: its loopback or an interface.
bool isOwnAddress(const std::string& address) {
    const std::size_t begin = address.find("//") + 2;
    const std::string host = address.substr(begin, address.rfind(':') - begin);
    if (host == "localhost") return true;
    const NumericAddress numeric = numericAddress(host);
    const std::string_view bytes = numeric ? bytesOf(numeric->ai_addr) : std::string_view{};
    if (bytes.empty()) return false;
    if (isLoopbackAddress(bytes)) return true;
    ifaddrs* list = nullptr;
    if (getifaddrs(&list) != 0) return false;
    const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, &freeifaddrs);
    for (const ifaddrs* one = list; one != nullptr; one = one->ifa_next)
        if (bytesOf(one->ifa_addr) == bytes) return true;
    return false;
}

// Checks the clock: with a date before the program's own, hours, certificates and logs are wrong.
void lookAtClock(Findings& findings, bool isAlone) {
    const double now = systemSeconds();
    const std::string doubt = clockDoubt(now, static_cast<double>(builtAt()));
    findings.judge(doubt.empty(),
                   Verdict::Fail,
                   "clock",
                   doubt.empty() ? "says " + dayOf(now) + " (UTC)" : doubt,
                   kSetTheClock);
    if (isAlone) return;
    findings.judge(net::isClockSynchronised(),
                   Verdict::Warn,
                   "clock",
                   net::isClockSynchronised() ? "synchronised" : "not synchronised",
                   kSynchronise);
}

// Checks a certificate, of the console or of its authority, where this user can see its file.
void lookAtCertificate(Findings& findings,
                       const fs::path& file,
                       double noticeDays,
                       const std::string& todo) {
    std::error_code hidden;
    if (!fs::exists(file, hidden)) return;
    const std::string subject = file.stem().string();
    try {
        const Validity validity = validityOf(file);
        const auto concern = concernAbout(validity, systemSeconds(), noticeDays);
        findings.judge(!concern,
                       concern && concern->isUrgent ? Verdict::Fail : Verdict::Warn,
                       subject,
                       concern ? concern->what : "valid until " + dayOf(validity.until),
                       todo);
    } catch (const Error& problem) {
        findings.fail(subject, problem.what());
    }
}

// Checks the certificates of this rig's console, in the folder of console/files_of_show.h. With a
// wrong clock their ends cannot be judged.
void lookAtCertificates(Findings& findings, const std::string& rig) {
    if (!clockDoubt(systemSeconds(), static_cast<double>(builtAt())).empty()) return;
    const fs::path folder =
        userFolder("XDG_STATE_HOME", ".local/state") / "console" / fs::path(rig).stem() / "tls";
    lookAtCertificate(findings,
                      folder / "certificate.pem",
                      kCertificateNoticeDays,
                      "a console that runs renews it where its authority's key is (" +
                          (folder / "authority.key").string() +
                          "): start it, and see its log; else make another: aquarama console " +
                          rig + " --certify ADDRESS");
    lookAtCertificate(findings,
                      folder / "authority.pem",
                      kAuthorityNoticeDays,
                      "make another and install it on each tablet: aquarama console " + rig +
                          " --certify ADDRESS --new-authority");
}

// Checks what a show needs on this machine, whether one runs or not.
void lookAtMachine(Findings& findings, const DoctorOptions& options, const config::Rig& rig) {
    findings.attempt("scene", [&] {
        const std::string path = config::scenePathOf(rig, options.rig);
        return path + ", " + std::to_string(config::readScene(path).cast.size()) + " species";
    });
    findings.judge(
        isOwnAddress(rig.controlAddress),
        Verdict::Fail,
        "address",
        rig.controlAddress,
        "no network interface here has it: this is not the master's machine, its cable is "
        "out, or the rig names another");
    const std::uint64_t free = freeBytesAt(cacheFolder());
    findings.judge(free > kLeastDiskBytes,
                   Verdict::Warn,
                   "disk",
                   gigabytes(free) + " at " + cacheFolder().string(),
                   "repertoires, keys and logs need a gigabyte: make room");
    const bool isAlone = std::ranges::all_of(
        rig.channels, [](const config::Channel& channel) { return channel.machine.empty(); });
    lookAtJournal(findings, wire::journalOf(options.rig));
    lookAtClock(findings, isAlone);
    lookAtCertificates(findings, options.rig);
    if (!config::needsKeys(rig)) return findings.pass("keys", "none are needed on one machine");
    const fs::path folder = config::keyFolderOf(options.rig, options.keyFolder);
    lookAtKey(findings, folder, "master");
    for (const config::Channel& channel : rig.channels) lookAtKey(findings, folder, channel.name);
}

// The monitor at this connector, or the only one where the name is empty; empty where there is
// none.
std::optional<std::string> monitorIn(const v1::NodeReport& report, const std::string& connector) {
    if (connector.empty() && report.monitors_size() != 1) return std::nullopt;
    for (const std::string& monitor : report.monitors())
        if (connector.empty() || monitor.starts_with(connector + " ")) return monitor;
    return std::nullopt;
}

// Compares the monitors of a node's machine with the channel of the rig.
void lookAtMonitors(Findings& findings,
                    const std::string& subject,
                    const config::Channel& channel,
                    const v1::NodeReport& report) {
    for (const std::string& monitor : report.monitors())
        findings.pass(subject, "monitor " + monitor);
    if (channel.display.mode != config::DisplayMode::Fullscreen) return;
    const std::string& wanted = channel.display.connector;
    const auto found = monitorIn(report, wanted);
    const std::string name = wanted.empty() ? "its only monitor" : "monitor " + wanted;
    findings.judge(found.has_value(),
                   Verdict::Warn,
                   subject,
                   fmt::format("the rig wants {}, of {}", name, report.monitors_size()),
                   "see its cables, or correct display.connector; without a display (--headless) "
                   "nothing is shown there");
    if (!found) return;
    const std::string size = fmt::format("{}x{}", channel.sizePixels.x, channel.sizePixels.y);
    findings.judge(found->find(" " + size + " ") != std::string::npos,
                   Verdict::Warn,
                   subject,
                   fmt::format("{} is to show {}", name, size),
                   "it is at another size now: correct the channel's, or the monitor's mode");
}

// Checks the timing of a node: round trips, lost pings, real-time priority and clock.
void lookAtTime(Findings& findings, const std::string& subject, const v1::NodeStatus& node) {
    const v1::NodeReport& report = node.report();
    // On the master's own machine only a busy processor delays an answer.
    const bool isFar = !node.machine().empty();
    findings.judge(
        !isFar || (report.round_trip_p99_ms() < kSlowRoundTripMs &&
                   report.unanswered_percent() < kMostUnansweredPercent),
        Verdict::Warn,
        subject,
        fmt::format("round trip {:.2f} ms, 99 % within {:.2f} ms, jitter {:.2f} ms, "
                    "{:.1f} % of pings unanswered, the master's clock {:+.1f} ppm faster",
                    report.round_trip_median_ms(),
                    report.round_trip_p99_ms(),
                    report.jitter_ms(),
                    report.unanswered_percent(),
                    report.clock_drift_ppm()),
        "use a cable and a switch of its own for the wall; wireless is too uneven");
    findings.judge(report.real_time(),
                   Verdict::Warn,
                   subject,
                   report.real_time() ? "real-time priority" : "no real-time priority",
                   "frames are late where its machine is busy: allow it, as docs/cluster.md says");
    if (isFar)
        findings.judge(
            report.clock_synchronised(),
            Verdict::Warn,
            subject,
            report.clock_synchronised() ? "clock synchronised" : "clock not synchronised",
            kSynchronise);
}

// llvmpipe is Mesa's renderer for machines without a graphics card.
void lookAtReport(Findings& findings, const std::string& subject, const v1::NodeStatus& node) {
    const v1::NodeReport& report = node.report();
    const bool isSoftware = report.renderer().find("llvmpipe") != std::string::npos;
    findings.judge(!isSoftware,
                   Verdict::Warn,
                   subject,
                   "machine " + report.host() + ", " + report.renderer(),
                   "it draws on the processor: install its card's driver, or accept a slow wall");
    findings.judge(report.build() == cli::buildText(),
                   Verdict::Warn,
                   subject,
                   "build " + report.build(),
                   "this machine has " + cli::buildText() + ": install the same on both");
    findings.judge(report.free_disk_bytes() > kLeastDiskBytes,
                   Verdict::Warn,
                   subject,
                   gigabytes(report.free_disk_bytes()),
                   "make room on its disk");
}

// Checks a node. Without a report it is judged by what the master knows of it.
void lookAtNode(Findings& findings, const config::Rig& rig, const v1::NodeStatus& node) {
    const std::string subject = "node " + node.name();
    const std::string machine =
        node.machine().empty() ? "this machine" : "machine " + node.machine();
    findings.judge(node.condition() == v1::NODE_IN_STEP,
                   node.condition() == v1::NODE_ABSENT ? Verdict::Fail : Verdict::Warn,
                   subject,
                   wire::wordFor(node.condition()) + ", " + machine,
                   node.condition() == v1::NODE_ABSENT
                       ? "start it there: aquarama-node --key FILE; see its output"
                       : "it draws more slowly than the others: see its frame times");
    findings.judge(node.hash_mismatches() == 0,
                   Verdict::Fail,
                   subject,
                   node.hash_mismatches() == 0 ? "decodes the fish as they were sent"
                                               : "decodes other fish than were sent",
                   "check its memory and its version");
    if (!node.has_report()) return;
    lookAtReport(findings, subject, node);
    lookAtTime(findings, subject, node);
    const auto channel = std::ranges::find(rig.channels, node.name(), &config::Channel::name);
    if (channel != rig.channels.end()) lookAtMonitors(findings, subject, *channel, node.report());
}

MasterAnswer answerOf(ask::RequestClient client) {
    MasterAnswer answer;
    try {
        answer.status = client.status();
    } catch (const Error&) {
        answer.preparing = client.preparing();
    }
    return answer;
}

// Checks the running show through its master. False: none runs.
bool lookAtShow(Findings& findings, const DoctorOptions& options, const config::Rig& rig) {
    const MasterAnswer answer = answerOfMaster(options.rig, options.keyFolder);
    if (!answer.preparing.empty()) {
        findings.judge(false,
                       Verdict::Warn,
                       "show",
                       answer.preparing,
                       "nothing is known of the nodes yet: ask again in a while");
        return true;
    }
    if (!answer.status) return false;
    const v1::StatusReply& status = *answer.status;
    findings.pass("show",
                  fmt::format("runs, frame {}: median {:.1f} ms, 99 % {:.1f} ms; release skew "
                              "{:.2f} ms, 99 % {:.2f} ms",
                              status.frame(),
                              status.frame_median_ms(),
                              status.frame_p99_ms(),
                              status.skew_median_ms(),
                              status.skew_p99_ms()));
    if (status.has_journal()) lookAtJournal(findings, status.journal());
    if (status.has_standby())
        findings.judge(
            wire::standbyProblem(status.standby()).empty(),
            Verdict::Warn,
            "standby",
            wire::standbyText(status.standby()),
            "start Aquarama on the other machine; its log says why it does not simulate along");
    for (const v1::NodeStatus& node : status.nodes()) lookAtNode(findings, rig, node);
    return true;
}

// Checks that the rig's ports are free. Only where no show runs, since a running master holds both.
void lookAtPorts(Findings& findings, const config::Rig& rig) {
    findings.attempt("ports", [&] {
        for (const std::string& address : {rig.controlAddress, rig.stateAddress})
            supervisor::requireFreePort(address);
        return std::string("free");
    });
    findings.judge(false,
                   Verdict::Warn,
                   "show",
                   "none runs, so nothing is known of the nodes",
                   "start it (aquarama run, or the services of all machines) and ask again");
}

// Reads the rig first: all other checks need it.
Findings lookOver(const DoctorOptions& options) {
    Findings findings;
    config::Rig rig;
    const bool isRig = findings.attempt("rig", [&] {
        rig = config::readRig(options.rig);
        wall::checkGeometry(rig, options.rig);
        return options.rig + ", " + counted(rig.channels.size(), "channel");
    });
    if (!isRig) return findings;
    lookAtMachine(findings, options, rig);
    if (!lookAtShow(findings, options, rig)) lookAtPorts(findings, rig);
    return findings;
}

// In the order of Verdict.
constexpr std::array kVerdicts{"pass", "warn", "fail"};

// Prints a line for each finding, the verdict first.
void printTable(const Findings& findings) {
    for (const Finding& finding : findings.all())
        std::cout << fmt::format("{}  {:<14} {}{}{}\n",
                                 kVerdicts.at(static_cast<std::size_t>(finding.verdict)),
                                 finding.subject,
                                 finding.what,
                                 finding.todo.empty() ? "" : ": ",
                                 finding.todo);
}

// The console reads these fields by name: files_of_show.cpp.
void printJson(const Findings& findings) {
    nlohmann::json list = nlohmann::json::array();
    for (const Finding& finding : findings.all())
        list.push_back({{"verdict", kVerdicts.at(static_cast<std::size_t>(finding.verdict))},
                        {"subject", finding.subject},
                        {"what", finding.what},
                        {"todo", finding.todo}});
    std::cout << list.dump(2) << '\n';
}

// Exit status 1 where a check fails.
int doctor(const DoctorOptions& options) {
    const Findings findings = findingsOfDoctor(options.rig, options.keyFolder);
    (options.json ? printJson : printTable)(findings);
    return std::ranges::any_of(
        findings.all(), [](const Finding& finding) { return finding.verdict == Verdict::Fail; });
}

}  // namespace

MasterAnswer answerOfMaster(const std::string& rigPath, const std::string& keyFolder) {
    try {
        return answerOf(connectToMaster(rigPath, keyFolder));
    } catch (const Error& problem) {
        return {.problem = problem.what()};
    }
}

Findings findingsOfDoctor(const std::string& rigPath, const std::string& keyFolder) {
    return lookOver({.rig = rigPath, .keyFolder = keyFolder});
}

void addDoctor(CommandLine& line) {
    const auto [command, options] = line.add<DoctorOptions>(
        "doctor", "check that a wall is ready: rig, keys, network, machines", doctor);
    command.add_option("RIG", options.rig, "the rig's file")->capture_default_str();
    command.add_option(
        "--keys", options.keyFolder, "folder of the rig's keys, instead of the user's");
    command.add_flag("--json",
                     options.json,
                     "output for programs: verdict, subject, what and todo of each finding");
    command.footer(
        "A line for each finding: pass, warn or fail, what was found, and what to do. The exit "
        "status is 1 "
        "where something\nfails. With a running show it tells of every node as well.");
}

}  // namespace aquarama
