// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/wait_for_key.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include "common/base/log.h"
#include "common/cli/command_line.h"
#include "common/config/keys.h"
#include "common/enrol/node_door.h"
#include "common/machine/service_notifier.h"
#include "render_node/gl/monitor_windows.h"
#include "render_node/show/node_card.h"

namespace aquarama::show {

namespace {

using namespace std::chrono_literals;

// Where the sign is seen: on the screens, or in the log.
class Board {
  public:
    Board(bool isHeadless, const std::string& connector) {
        if (isHeadless) return;
        windows_ = std::make_unique<gl::MonitorWindows>("Aquarama", connector);
        if (windows_->isSeen()) return;
        logWarning("there is no monitor{}; the letter is on it once it is there",
                   connector.empty() ? "" : " " + connector);
    }
    // True: somebody at the machine has ended it.
    [[nodiscard]] bool show(const enrol::NodeSign& sign) {
        if (windows_) {
            windows_->draw([&](glm::ivec2 size) { drawCard(sign, size); });
            return windows_->pumpEvents(0ms);
        }
        if (!sign.letter.empty() && (sign.letter != said_.letter || sign.code != said_.code))
            logInfo("waits for a channel as {}, code {}", sign.letter, sign.code);
        said_ = sign;
        return false;
    }

  private:
    std::unique_ptr<gl::MonitorWindows> windows_;  // null: headless
    enrol::NodeSign said_;
};

}  // namespace

bool waitForKey(const std::filesystem::path& keyFile,
                bool isHeadless,
                const std::string& connector) {
    cli::holdSignals();
    machine::ServiceNotifier service;
    std::atomic<bool> isOver = false;
    const cli::SignalWatch watch([&] { isOver = true; });
    Board board(isHeadless, connector);
    enrol::NodeDoor door([&](const config::KeyFile& key) { config::writeKeyFile(keyFile, key); });
    while (!isOver) {
        if (const auto key = door.serve(50ms)) {
            logInfo("is given the channel {}", key->name);
            return true;
        }
        const enrol::NodeSign sign = door.sign();
        if (board.show(sign)) return false;
        service.status("waits for a channel" + (sign.letter.empty() ? "" : " as " + sign.letter));
        service.alive(0);
    }
    service.stopping();
    return false;
}

}  // namespace aquarama::show
