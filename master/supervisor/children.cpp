// SPDX-License-Identifier: Apache-2.0
#include "master/supervisor/children.h"

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/cli/command_line.h"

namespace aquarama::supervisor {

namespace {

// Those that end a show, and that of a child's death.
sigset_t heardSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
    return signals;
}

// The argument list for execv(); points into the command.
std::vector<char*> argumentVector(const Command& command) {
    const char* name = command.name.empty() ? command.program.c_str() : command.name.c_str();
    std::vector<char*> vector{const_cast<char*>(name)};
    for (const std::string& argument : command.arguments)
        vector.push_back(const_cast<char*>(argument.c_str()));
    vector.push_back(nullptr);
    return vector;
}

// The children that have ended and were not yet reported.
std::vector<Ending> reap() {
    std::vector<Ending> endings;
    int status = 0;
    for (pid_t child = waitpid(-1, &status, WNOHANG); child > 0;
         child = waitpid(-1, &status, WNOHANG)) {
        endings.push_back({.child = child,
                           .exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                           .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0});
    }
    return endings;
}

}  // namespace

std::filesystem::path ownProgram() {
    return std::filesystem::read_symlink("/proc/self/exe");
}

std::filesystem::path siblingProgram(const std::string& name) {
    assert(!name.empty());
    auto program = ownProgram().parent_path() / ("aquarama-" + name);
    if (!std::filesystem::exists(program)) {
        throw Error(
            program.string() +
            " is missing; build or install all of Aquarama's programs into one folder" +
            (name == "calibrate" ? " (docs/calibration.md says how to build this one)" : ""));
    }
    return program;
}

// Blocked signals stay pending until sigtimedwait() takes them.
void listenForSignals() {
    const sigset_t signals = heardSignals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

// The arguments are made before fork(): the child allocates no memory.
pid_t start(const Command& command) {
    assert(command.program.is_absolute());
    const std::vector<char*> arguments = argumentVector(command);
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0)
        throw Error("cannot start " + command.program.string() + ": " +
                    std::system_category().message(errno));
    if (child > 0) return child;

    setpgid(0, 0);  // Ctrl-C is ours to pass on, once
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);  // we died before the line above
    const sigset_t signals = heardSignals();
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    execv(command.program.c_str(), arguments.data());
    _exit(127);
}

// One SIGCHLD may stand for several deaths: reap() asks until none is left.
Heard waitForChildren(std::chrono::milliseconds atMost) {
    const sigset_t signals = heardSignals();
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(atMost);
    const timespec timeout{.tv_sec = seconds.count(),
                           .tv_nsec = std::chrono::nanoseconds(atMost - seconds).count()};
    const int signal = sigtimedwait(&signals, nullptr, &timeout);
    return {.interrupted = signal > 0 && signal != SIGCHLD, .endings = reap()};
}

// execv() returns only where it fails.
void become(const Command& command) {
    const std::vector<char*> arguments = argumentVector(command);
    execv(command.program.c_str(), arguments.data());
    throw Error("cannot start " + command.program.string() + ": " +
                std::system_category().message(errno));
}

// Children inherit the writing end only. The reading end never blocks.
ErrorPipe::ErrorPipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw Error("no pipe can be made (" + std::system_category().message(errno) +
                    "); close other programs");
    reading_ = ends[0];
    writing_ = ends[1];
    fcntl(reading_, F_SETFL, O_NONBLOCK);
    fcntl(writing_, F_SETFD, 0);  // the children inherit it
    // NOLINTNEXTLINE(concurrency-mt-unsafe): this process has one thread
    setenv(cli::kErrorPipeVariable, std::to_string(writing_).c_str(), /*overwrite=*/1);
}

ErrorPipe::~ErrorPipe() {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): this process has one thread
    unsetenv(cli::kErrorPipeVariable);
    close(reading_);
    close(writing_);
}

// Text after the last line end counts as a line.
std::vector<std::string> ErrorPipe::heard() const {
    std::string text;
    std::array<char, 4096> bytes{};
    for (ssize_t count = 0; (count = read(reading_, bytes.data(), bytes.size())) > 0;)
        text.append(bytes.data(), static_cast<std::size_t>(count));
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace aquarama::supervisor
