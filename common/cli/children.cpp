// SPDX-License-Identifier: Apache-2.0
#include "common/cli/children.h"

#include <cerrno>
#include <system_error>

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/units/log.h"

namespace aquarama::cli {

namespace {

sigset_t heardSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
    return signals;
}

std::vector<char*> argumentVector(const Command& command) {
    std::vector<char*> vector{const_cast<char*>(command.program.c_str())};
    for (const std::string& argument : command.arguments)
        vector.push_back(const_cast<char*>(argument.c_str()));
    vector.push_back(nullptr);
    return vector;
}

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

void listenForSignals() {
    const sigset_t signals = heardSignals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

pid_t start(const Command& command) {
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

Heard waitForChildren(std::chrono::milliseconds atMost) {
    const sigset_t signals = heardSignals();
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(atMost);
    const timespec timeout{.tv_sec = seconds.count(),
                           .tv_nsec = std::chrono::nanoseconds(atMost - seconds).count()};
    const int signal = sigtimedwait(&signals, nullptr, &timeout);
    return {.interrupted = signal > 0 && signal != SIGCHLD, .endings = reap()};
}

void become(const Command& command) {
    const std::vector<char*> arguments = argumentVector(command);
    execv(command.program.c_str(), arguments.data());
    throw Error("cannot start " + command.program.string() + ": " +
                std::system_category().message(errno));
}

}  // namespace aquarama::cli
