// SPDX-License-Identifier: Apache-2.0
// aquarama-console: the operator's console of a rig, for browsers.
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>

#include "common/base/dates.h"
#include "common/base/log.h"
#include "common/base/output_file.h"
#include "common/cli/command_line.h"
#include "common/cli/commands.h"
#include "common/config/host.h"
#include "common/config/hours.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/machine/service_notifier.h"
#include "common/web/server.h"
#include "console/access.h"
#include "console/certificate.h"
#include "console/console.h"
#include "console/files_of_show.h"
#include "console/gate.h"
#include "console/touch/touch_command.h"

namespace {

using namespace aquarama;

// Where neither the option nor the rig's console_port says another.
constexpr std::uint16_t kDefaultPort = 7480;
constexpr const char* kLoopback = "127.0.0.1";

// What the command line says; empty where an option was not given.
struct Options {
    std::string rig, keys, key, listen = kLoopback, pair, token;
    std::string role = "watcher";
    std::string publicUrl, proxy;
    std::vector<std::string> certify, names;
    bool takesNewAuthority = false;
    int port = -1;  // the rig's
};

// Both or neither: whose headers count, and by which name browsers come.
void describeProxy(CLI::App& app, Options& options) {
    CLI::Option* url = app.add_option("--public",
                                      options.publicUrl,
                                      "https://NAME by which browsers reach a proxy that ends TLS");
    CLI::Option* proxy =
        app.add_option("--proxy", options.proxy, "address that this proxy connects from");
    url->needs(proxy);
    proxy->needs(url);
}

// Its options; what is printed and ends goes before what serves.
void describe(CLI::App& app, Options& options) {
    const auto role = CLI::IsMember({"watcher", "operator", "crew"});
    // CLI11 would take the name of a command for a rig that is required.
    app.add_option("RIG", options.rig, "whose show is watched; needed unless a command follows");
    app.add_option("--port", options.port, "instead of the rig's console_port; 0: any free one")
        ->check(cli::wholeNumber(0, 65535));
    app.add_option("--listen", options.listen, "address of a network card, for other machines")
        ->capture_default_str();
    app.add_option("--name", options.names, "another name of this machine that browsers may use")
        ->check(cli::plainWord());
    app.add_option("--keys", options.keys, "folder of the master's keys, where the rig needs them");
    app.add_option("--key", options.key, "file of the operator's key; else that of the folder");
    app.add_option("--pair", options.pair, "print a code that lets one more browser in, and end")
        ->check(role);
    app.add_option(
           "--token", options.token, "print a new token for a machine of this name, and end")
        ->check(cli::plainWord());
    app.add_option("--role", options.role, "of that token")->check(role)->capture_default_str();
    app.add_option("--certify",
                   options.certify,
                   "make the certificate for these addresses and names, and end");
    app.add_flag("--new-authority",
                 options.takesNewAuthority,
                 "with --certify: another authority too, to be installed on every tablet")
        ->needs("--certify");
    describeProxy(app, options);
    app.footer(
        "Prints the address and, as long as nobody is let in, a code. The console never costs the "
        "wall a frame;\nit may be ended and started again at any time.");
}

// Beside the sessions, which lie as safely.
std::filesystem::path certificateFolder(const Options& options) {
    return config::consoleFolderOf(options.rig) / "tls";
}

// Past this machine only over TLS.
web::ServerOptions serverOptions(const Options& options, const config::Rig& rig) {
    web::ServerOptions server{.address = options.listen, .certificateFile = {}, .keyFile = {}};
    const int ofRig = rig.consolePort != 0 ? rig.consolePort : kDefaultPort;
    server.port = static_cast<std::uint16_t>(options.port >= 0 ? options.port : ofRig);
    if (options.listen == kLoopback) return server;
    const auto files = console::certificateFilesIn(certificateFolder(options));
    if (!std::filesystem::exists(files.certificate))
        throw Error("--listen " + options.listen +
                    ": past this machine a console needs a certificate; make it by aquarama "
                    "console " +
                    options.rig + " --certify " + options.listen);
    server.certificateFile = files.certificate.string();
    server.keyFile = files.key.string();
    return server;
}

// Said with the fingerprint, which people compare on the tablet.
void certify(const Options& options) {
    std::filesystem::create_directories(certificateFolder(options));
    std::filesystem::permissions(certificateFolder(options), std::filesystem::perms::owner_all);
    const auto files = console::certificateFilesIn(certificateFolder(options));
    const console::MadeCertificate made =
        console::makeCertificate(files,
                                 options.certify,
                                 {console::unixNow(), static_cast<double>(builtAt())},
                                 options.takesNewAuthority);
    std::cout << "certificate until " << dayOf(made.until) << ": " << files.certificate.string()
              << "\ninstall on each tablet, once: " << files.authority.string()
              << (made.isNewAuthority ? " (new)" : "")
              << "\nits SHA-256 fingerprint: " << made.fingerprint
              << "\na console that runs with --listen takes it within ten seconds, and renews it a "
                 "month before its end\n";
}

// Of a console over TLS. One that has run out is renewed before a browser sees it.
std::unique_ptr<console::CertificateKeeper> keeperOf(const Options& options, bool isTls) {
    if (!isTls) return nullptr;
    auto keeper = std::make_unique<console::CertificateKeeper>(
        console::certificateFilesIn(certificateFolder(options)),
        "aquarama console " + options.rig + " --certify " + options.listen,
        static_cast<double>(builtAt()));
    static_cast<void>(keeper->tend(console::unixNow()));
    keeper->taken();
    return keeper;
}

// The doors of the server, and of the proxy before it where there is one.
console::Doors doorsOf(const Options& options, const web::ServerOptions& where, int port) {
    console::Doors doors = console::doorsOf(where.address,
                                            static_cast<std::uint16_t>(port),
                                            !where.certificateFile.empty(),
                                            options.names);
    if (!options.publicUrl.empty())
        doors.proxy = console::proxyAt(options.publicUrl, options.proxy);
    return doors;
}

// The operator's, of the folder that was given; empty: of the rig's own folder, where one is
// needed.
std::string keyOf(const Options& options) {
    if (!options.key.empty() || options.keys.empty()) return options.key;
    return config::keyFileIn(options.keys, "operator").string();
}

// Until a signal.
void serve(const Options& options, const config::Rig& rig, console::Access& access) {
    cli::holdSignals();
    constexpr int kNice = 5;  // the wall goes before
    setpriority(PRIO_PROCESS, 0, kNice);
    machine::ServiceNotifier service;
    const web::ServerOptions where = serverOptions(options, rig);
    const bool isTls = !where.certificateFile.empty();
    const auto keeper = keeperOf(options, isTls);
    console::Console desk({.rig = rig,
                           .master = {.rig = options.rig, .address = {}, .key = keyOf(options)},
                           .keyFolder = options.keys,
                           .build = cli::buildText(),
                           .service = &service,
                           .certificate = keeper.get(),
                           .built = static_cast<double>(builtAt())},
                          access);
    web::WebServer server(where, desk);
    console::Doors doors = doorsOf(options, where, server.port());
    logInfo("console at {}://{}:{}",
            isTls ? "https" : "http",
            config::bracketed(where.address),
            server.port());
    if (doors.proxy) logInfo("behind the proxy at https://{}", doors.proxy->host);
    desk.begin(server, std::move(doors));
    const cli::SignalWatch watch([&] { server.stop(); });
    service.ready();
    server.run();
    service.stopping();
    desk.end();
}

// What the options ask for.
void run(const Options& options) {
    const config::Rig rig = config::readRig(options.rig);
    if (!options.certify.empty()) return certify(options);
    const auto folder = config::consoleFolderOf(options.rig);
    // What these two print only counts where the running console reads it.
    if (!options.pair.empty() || !options.token.empty()) requireWritableFolder(folder);
    console::Access access(folder, static_cast<double>(builtAt()));
    if (!options.pair.empty()) {
        std::cout << access.makeCode(*console::roleNamed(options.pair), console::unixNow())
                  << "  lets one browser in as " << options.pair << ", within ten minutes\n";
    } else if (!options.token.empty()) {
        const auto role = *console::roleNamed(options.role);
        std::cout << access.makeToken(options.token, role, console::unixNow()) << '\n';
    } else {
        serve(options, rig, access);
    }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): outside runProgram() only a lack of memory throws
int main(int count, char** arguments) {
    Options options;
    CLI::App app("The operator's console of a show, for browsers.", "aquarama-console");
    cli::CommandLine line(app);
    console::addTouch(line);
    describe(app, options);
    return cli::runProgram(app, count, arguments, [&] {
        if (line.isChosen()) return line.runChosen();
        if (options.rig.empty()) throw CLI::RequiredError("RIG");
        spdlog::set_default_logger(spdlog::stdout_color_mt("console"));
        run(options);
        return 0;
    });
}
