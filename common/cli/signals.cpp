// SPDX-License-Identifier: Apache-2.0
#include "common/cli/signals.h"

#include <utility>

#include <signal.h>

namespace aquarama::cli {

namespace {

sigset_t watchedSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    return signals;
}

}  // namespace

void holdSignals() {
    const sigset_t signals = watchedSignals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

SignalWatch::SignalWatch(std::function<void()> onSignal) {
    const sigset_t signals = watchedSignals();
    thread_ = std::jthread([signals, call = std::move(onSignal)](const std::stop_token& ended) {
        constexpr timespec kPollInterval{.tv_sec = 0, .tv_nsec = 50'000'000};
        while (!ended.stop_requested())
            if (sigtimedwait(&signals, nullptr, &kPollInterval) > 0) call();
    });
}

}  // namespace aquarama::cli
